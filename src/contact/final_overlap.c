/* Finds bodies of a pair that have passed into each other through faces that are not the pair's */
#include "contactimpl.h"
#include "src/mesh/query/queryimpl.h"

#define FINAL_MOST  200 /* largest number of points of a rank that are tested */
#define FINAL_REALS 7   /* a point: coordinates at the start and at the end [length], and the other body */

/* Collects points of the boundary of a body at the end that are in the box of the other body, with their places at the
   start. *n: number of points; point: [FINAL_MOST][FINAL_REALS] */
static void FinalCollect(const ContactBoundary at[2], const PetscReal box[], PetscInt body, PetscInt other, PetscInt *n,
  PetscReal point[][FINAL_REALS])
{
  PetscInt found = 0, every;

  for (PetscInt pass = 0; pass < 2; ++pass) {
    every = PetscMax(1, (2 * found + FINAL_MOST - 1) / FINAL_MOST);
    found = 0;
    for (PetscInt i = 0; i < 4 * at[1].n; ++i) {
      const PetscReal *x = &at[1].x[3 * i], *limit = &box[6 * other];
      PetscBool        inside = (PetscBool)(at[1].body[i / 4] == body);

      for (PetscInt c = 0; c < 3; ++c) inside = (PetscBool)(inside && x[c] > limit[c] && x[c] < limit[3 + c]);
      if (!inside || (found++ % every && pass) || !pass || *n == FINAL_MOST) continue;
      for (PetscInt c = 0; c < 3; ++c) {
        point[*n][c]     = at[0].x[3 * i + c];
        point[*n][3 + c] = x[c];
      }
      point[(*n)++][6] = (PetscReal)other;
    }
  }
}

/* Collective. Finds a point that is outside the other body at the start, and inside it by more than `margin` at the
   end: the point and its neighbours at this distance along the axes are inside */
static PetscErrorCode FinalTest(MPI_Comm comm, const ContactBoundary at[2], PetscReal margin, PetscInt n,
  const PetscReal point[][FINAL_REALS], PetscBool *entered, PetscReal place[3])
{
  const PetscReal whole = 4.0 * PETSC_PI;
  PetscReal      *angle;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(8 * n, &angle));
  for (PetscInt k = 0; k < n; ++k) {
    const PetscInt other = (PetscInt)point[k][6];

    angle[8 * k] = ContactBoundarySolidAngle(&at[0], other, point[k]);
    for (PetscInt j = 0; j < 7; ++j) {
      PetscReal x[3] = {point[k][3], point[k][4], point[k][5]};

      if (j) x[(j - 1) / 2] += j % 2 ? margin : -margin;
      angle[8 * k + 1 + j] = ContactBoundarySolidAngle(&at[1], other, x);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, angle, (PetscMPIInt)(8 * n), MPIU_REAL, MPIU_SUM, comm));
  *entered = PETSC_FALSE;
  for (PetscInt k = 0; k < n && !*entered; ++k) {
    *entered = (PetscBool)(angle[8 * k] < 0.6 * whole);
    for (PetscInt j = 1; j < 8; ++j) *entered = (PetscBool)(*entered && angle[8 * k + j] > 0.9 * whole);
    for (PetscInt c = 0; c < 3; ++c) place[c] = point[k][c];
  }
  PetscCall(PetscFree(angle));
  PetscFunctionReturn(0);
}

/*
   Collective. Finds whether one of the bodies of pair p, which were apart at the start, is inside the other one at the
   global displacement u.

   - margin: depth that does not count [length]
   - entered: whether a vertex is deeper
   - place: where this vertex was at the start [length]

   It is meant for pairs without contact: at most 200 vertices of each rank are tested, and nothing is done if the
   bounding boxes of the bodies do not overlap.
*/
PetscErrorCode ContactGetEntered(Contact contact, PetscInt p, Vec u, PetscReal margin, PetscBool *entered,
  PetscReal place[3])
{
  const ContactPairData *pair = &contact->pairs[p];
  ContactBoundary        at[2];
  PetscReal             *box, (*point)[FINAL_REALS];
  PetscInt               n = 0;

  PetscFunctionBegin;
  *entered = PETSC_FALSE;
  if (pair->formula || pair->mortar.body == pair->nonmortar.body) PetscFunctionReturn(0);
  for (PetscInt k = 0; k < 2; ++k) PetscCall(ContactBoundaryCreate(contact->dm, &at[k]));
  PetscCall(ContactBoundaryDeform(contact->dm, u, &at[1]));
  PetscCall(PetscMalloc1(6 * at[1].nbodies, &box));
  PetscCall(PetscMalloc1(FINAL_MOST, &point));
  PetscCall(ContactBoundaryBoxes(&at[1], box));
  FinalCollect(at, box, pair->mortar.body, pair->nonmortar.body, &n, point);
  FinalCollect(at, box, pair->nonmortar.body, pair->mortar.body, &n, point);
  PetscCall(RecordsGather(contact->comm, FINAL_REALS, &n, &point));
  PetscCall(FinalTest(contact->comm, at, margin, n, (const PetscReal(*)[FINAL_REALS])point, entered, place));
  PetscCall(PetscFree(point));
  PetscCall(PetscFree(box));
  for (PetscInt k = 0; k < 2; ++k) PetscCall(ContactBoundaryDestroy(&at[k]));
  PetscFunctionReturn(0);
}
