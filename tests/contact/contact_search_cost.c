static char help[] = "The comparisons of the contact search grow like N log N in the number N of facets.\n";

#include "src/contact/contactimpl.h"
#include "contact_report.h"

/* Fills a wavy grid of n x n facets over the unit square, or n^2 facets scattered in the unit cube, all at this height
   above the xy plane and shifted along x */
static void Fill(PetscInt n, PetscBool scattered, PetscReal height, PetscReal shift, PetscBool up, PetscReal x[])
{
  const PetscReal size = 1.0 / n;

  for (PetscInt f = 0; f < n * n; ++f) {
    const PetscReal golden = 0.6180339887498949 * f, layer = scattered ? golden - PetscFloorReal(golden) : 0.0;

    for (PetscInt a = 0; a < 4; ++a) {
      const PetscInt i = f % n + (a == 1 || a == 2), j = f / n + (a == 2 || a == 3);
      PetscReal     *y = &x[12 * f + 3 * (up ? a : 3 - a)];

      y[0] = size * i + shift;
      y[1] = size * j;
      y[2] = height + layer + 0.02 * PetscSinReal(5.0 * y[0]) * PetscCosReal(3.0 * y[1]);
    }
  }
}

/* Number of comparisons of a search between two faces of n x n facets each */
static PetscErrorCode Count(PetscInt n, PetscBool scattered, PetscLogDouble *count, PetscReal *found)
{
  ContactSurface    nonmortar = {.nfacets = n * n};
  ContactCandidates mortar    = {.n = n * n};
  ContactNear       near;
  PetscLogDouble    before, after;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(12 * n * n, &nonmortar.x));
  PetscCall(PetscMalloc1(12 * n * n, &mortar.x));
  Fill(n, scattered, 0.001, 0.3 / n, PETSC_FALSE, nonmortar.x);
  Fill(n, scattered, 0.0, 0.0, PETSC_TRUE, mortar.x);
  PetscCall(PetscGetFlops(&before));
  PetscCall(ContactSearch(&nonmortar, 0.01, 0.01, &mortar, &near));
  PetscCall(PetscGetFlops(&after));
  *count = after - before;
  *found = (PetscReal)near.offset[n * n] / (n * n);
  PetscCall(ContactNearDestroy(&near));
  PetscCall(PetscFree(nonmortar.x));
  PetscCall(PetscFree(mortar.x));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (PetscInt kind = 0; kind < 2; ++kind) {
    const PetscBool scattered = (PetscBool)kind;
    PetscReal       found[2]  = {0.0, 0.0}, growth;
    PetscLogDouble  count[2]  = {0.0, 0.0};

    PetscCall(Count(24, scattered, &count[0], &found[0]));
    PetscCall(Count(192, scattered, &count[1], &found[1]));
    growth = count[1] / count[0] / (64.0 * PetscLogReal(192.0 * 192.0) / PetscLogReal(24.0 * 24.0));
    PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s: ", scattered ? "scattered facets" : "faces that touch"));
    if (found[0] < 1.0 || found[1] < 1.0 || found[1] > 10.0 || growth > 1.2 || growth < 0.4)
      PetscCall(PetscPrintf(PETSC_COMM_SELF, "NO, %g and %g facets found a facet, %g and %g comparisons, %g\n",
        (double)found[0], (double)found[1], count[0], count[1], (double)growth));
    else PetscCall(PetscPrintf(PETSC_COMM_SELF, "comparisons grow like N log N\n"));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:

TEST*/
