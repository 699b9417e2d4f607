/*
   Does something hold every body? Each body has six rigid modes. A prescribed displacement holds its component at the
   corners of its face; a contact pair, taken as closed, holds the relative motion along the normal at the corners of its
   nonmortar face. A mode outside the span of these rows moves freely, and the stiffness is singular for it.
*/
#include "sceneimpl.h"

/* Orthonormal basis of the rows met so far */
typedef struct {
  PetscInt   n, rank;
  PetscReal *basis; /* rank x n */
} RowSpace;

static PetscErrorCode RowSpaceAdd(RowSpace *space, PetscReal row[])
{
  const PetscInt n      = space->n;
  PetscReal      before = 0, after = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) before += row[i] * row[i];
  /* Gram-Schmidt, twice for orthogonality to rounding */
  for (PetscInt pass = 0; pass < 2; ++pass) {
    for (PetscInt r = 0; r < space->rank; ++r) {
      const PetscReal *q   = &space->basis[r * n];
      PetscReal        dot = 0;

      for (PetscInt i = 0; i < n; ++i) dot += q[i] * row[i];
      for (PetscInt i = 0; i < n; ++i) row[i] -= dot * q[i];
    }
  }
  for (PetscInt i = 0; i < n; ++i) after += row[i] * row[i];
  if (after > 1e-12 * before && space->rank < n) {
    for (PetscInt i = 0; i < n; ++i) space->basis[space->rank * n + i] = row[i] / PetscSqrtReal(after);
    space->rank++;
  }
  PetscFunctionReturn(0);
}

/* Adds to row the component along axis of body's rigid motion t + r x (x - center)/size at the point x */
static PetscErrorCode AddRigidMotion(Scene scene, PetscInt b, PetscInt axis, const PetscReal x[3], PetscReal sign, PetscReal row[])
{
  const SceneBody *body = &scene->bodies[b];
  const PetscInt   s = (axis + 1) % 3, t = (axis + 2) % 3;
  PetscReal        arm[3], size = 0;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) {
    size   = PetscMax(size, (body->upper[i] - body->lower[i]) / 2);
    arm[i] = x[i] - (body->upper[i] + body->lower[i]) / 2;
  }
  row[6 * b + axis] += sign;
  row[6 * b + 3 + s] += sign * arm[t] / size;
  row[6 * b + 3 + t] -= sign * arm[s] / size;
  PetscFunctionReturn(0);
}

static PetscErrorCode AddDisplacements(Scene scene, RowSpace *space, PetscReal row[])
{
  SceneFace face;
  PetscBool found;
  PetscReal corners[4][3];

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    PetscCall(SceneFindFace(scene, scene->displacements[d].face, &face, &found));
    PetscCall(SceneFaceCorners(scene, face, corners));
    for (PetscInt k = 0; k < 12; ++k) {
      if (!scene->displacements[d].fixed[k % 3]) continue;
      PetscCall(PetscArrayzero(row, space->n));
      PetscCall(AddRigidMotion(scene, face.body, k % 3, corners[k / 3], 1, row));
      PetscCall(RowSpaceAdd(space, row));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode AddContact(Scene scene, RowSpace *space, PetscReal row[])
{
  SceneFace mortar, nonmortar;
  PetscBool found;
  PetscReal corners[4][3];

  PetscFunctionBegin;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    PetscCall(SceneFindFace(scene, scene->pairs[p].mortar, &mortar, &found));
    PetscCall(SceneFindFace(scene, scene->pairs[p].nonmortar, &nonmortar, &found));
    PetscCall(SceneFaceCorners(scene, nonmortar, corners));
    for (PetscInt k = 0; k < 4; ++k) {
      PetscCall(PetscArrayzero(row, space->n));
      PetscCall(AddRigidMotion(scene, nonmortar.body, nonmortar.axis, corners[k], 1, row));
      PetscCall(AddRigidMotion(scene, mortar.body, nonmortar.axis, corners[k], -1, row));
      PetscCall(RowSpaceAdd(space, row));
    }
  }
  PetscFunctionReturn(0);
}

/* Collective, the same on every rank */
PetscErrorCode SceneCheckSupport(MPI_Comm comm, const char file[], Scene scene)
{
  static const char *const modes[] = {"a translation along x", "a translation along y", "a translation along z", "a rotation about x", "a rotation about y", "a rotation about z"};
  RowSpace                 space   = {6 * scene->nbodies, 0, NULL};
  PetscReal               *row;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(space.n * space.n, &space.basis, space.n, &row));
  PetscCall(AddDisplacements(scene, &space, row));
  PetscCall(AddContact(scene, &space, row));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    PetscReal freest = 1e-6;
    PetscInt  mode   = -1, nfree = 0;

    /* How much of each unit mode lies outside the span */
    for (PetscInt k = 0; k < 6; ++k) {
      PetscReal outside = 1;

      for (PetscInt r = 0; r < space.rank; ++r) outside -= PetscSqr(space.basis[r * space.n + 6 * b + k]);
      if (outside > 1 - 1e-6) nfree++;
      if (outside > freest + 1e-6) {
        freest = outside;
        mode   = k;
      }
    }
    PetscCheck(nfree < 6, comm, PETSC_ERR_USER_INPUT, "%s: nothing holds body \"%s\": prescribe a displacement on one of its faces", file, scene->bodies[b].name);
    PetscCheck(mode < 0, comm, PETSC_ERR_USER_INPUT, "%s: body \"%s\" is not held against %s, neither by a displacement nor by a contact pair", file, scene->bodies[b].name, modes[mode]);
  }
  PetscCall(PetscFree2(space.basis, row));
  PetscFunctionReturn(0);
}
