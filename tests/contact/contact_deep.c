static char help[] = "Bodies that overlap at the start: deeper than contact looks is an error, and nothing else is.\n";

#include "../lib/contact_problem.h"
#include "../lib/attempt.h"

/* Turns about the y axis, so that the boxes about the bodies overlap where the bodies touch */
static void PlaceTurned(const PetscReal x[3], PetscInt body, const void *ctx, PetscReal y[3])
{
  (void)body, (void)ctx;
  y[0] = 0.8 * x[0] + 0.6 * x[2];
  y[1] = x[1];
  y[2] = 0.8 * x[2] - 0.6 * x[0];
}

/* The upper body starts at this height over the lower one's bottom; both unit cubes unless the lower one is thinner */
static PetscErrorCode Try(const char what[], PetscReal thickness, PetscReal height, char mortar[], char nonmortar[],
  GapType gap, const char depth[])
{
  const SceneContactPair pair   = {.name = "pair", .mortar = mortar, .nonmortar = nonmortar, .gap = gap};
  Box                    box[2] = {
                       {"lower", {0, 0, 0}, {1, 1, thickness}, {3, 2, 2}},
                       {"upper", {0.125, 0.25, height}, {0.875, 1, 1.0 + height}, {2, 3, 2}},
  };
  Contact              contact = NULL;
  ContactLinearization lin     = NULL;
  DM                   dm;
  Vec                  u;
  PetscInt             nrows;
  PetscErrorCode       ierr;

  PetscFunctionBeginUser;
  if (depth) PetscCall(PetscOptionsSetValue(NULL, "-contact_search_depth", depth));
  PetscCall(CreateBoxes(PETSC_COMM_WORLD, 2, box, 0, &dm));
  PetscCall(SetPlaces(dm, PlaceTurned, NULL));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecSet(u, 0.0));
  PetscCall(ContactCreate(dm, 1, &pair, &contact));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(ContactLinearize(contact, u, CONTACT_FORCES, &lin));
  PetscCall(VecGetSize(lin->g, &nrows));
  PetscCall(AttemptBegin());
  ierr = ContactCheckDepth(contact);
  PetscCall(AttemptEnd());
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s, %s: ", what, GapTypes[gap], nrows ? "rows" : "no rows"));
  PetscCall(AttemptPrint(ierr));
  if (depth) PetscCall(PetscOptionsClearValue(NULL, "-contact_search_depth"));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(ContactDestroy(&contact));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (GapType gap = GAP_MORTAR; gap <= GAP_NODE; ++gap) {
    PetscCall(Try("touching", 1.0, 1.0, "lower.zmax", "upper.zmin", gap, NULL));
    PetscCall(Try("touching, the faces turned away", 1.0, 1.0, "lower.zmin", "upper.zmax", gap, NULL));
    /* an edge of the nonmortar face lies in the plane in which the bodies touch */
    PetscCall(Try("touching beside the face", 1.0, 1.0, "lower.ymin", "upper.ymin", gap, NULL));
    PetscCall(Try("apart", 1.0, 1.5, "lower.zmax", "upper.zmin", gap, NULL));
    PetscCall(Try("overlap that contact sees", 1.0, 0.75, "lower.zmax", "upper.zmin", gap, NULL));
    PetscCall(Try("deeper", 1.0, 0.5, "lower.zmax", "upper.zmin", gap, NULL));
    PetscCall(Try("deeper, searched", 1.0, 0.5, "lower.zmax", "upper.zmin", gap, "0.55"));
    PetscCall(Try("through a plate", 0.1, -0.25, "lower.zmax", "upper.zmin", gap, NULL));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 3}}
      output_file: output/contact_deep_1.out

TEST*/
