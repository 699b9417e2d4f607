/*
   Springs between two faces. Their energy is

     1/2 sum_A k a_A |u_A - sum_B M_AB u_B|^2

   over the nodes A of one face. The weights M_AB of the other face are those of a tie, and a_A is the integral of the
   shape function of A. The springs couple nodes that have no common cell, so that their stiffness is a separate matrix.
*/
#include "loadsimpl.h"

/* Creates a matrix with three rows per node. It is preallocated for the node's entries in `nodes`, which has one row
   per node, and for the diagonal. */
PetscErrorCode CouplingsReserve(const Bodies *bodies, Mat nodes, Mat *A)
{
  PetscInt nlocal, start, end, *here, *elsewhere;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(bodies->mass, &nlocal));
  PetscCall(MatGetOwnershipRange(nodes, &start, &end));
  PetscCall(PetscMalloc2(nlocal, &here, nlocal, &elsewhere));
  for (PetscInt i = 0; i < nlocal / 3; ++i) {
    const PetscInt *columns;
    PetscInt        n, local = 0;

    PetscCall(MatGetRow(nodes, start + i, &n, &columns, NULL));
    for (PetscInt k = 0; k < n; ++k) local += columns[k] >= start && columns[k] < end;
    for (PetscInt d = 0; d < 3; ++d) {
      here[3 * i + d]      = 1 + local;
      elsewhere[3 * i + d] = n - local;
    }
    PetscCall(MatRestoreRow(nodes, start + i, &n, &columns, NULL));
  }
  PetscCall(MatCreateAIJ(bodies->comm, nlocal, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 0, here, 0, elsewhere, A));
  PetscCall(PetscFree2(here, elsewhere));
  PetscFunctionReturn(0);
}

/* Creates stretch = 1 - M for the three components, in the rows of the nodes of one face. Other rows are empty. */
static PetscErrorCode CouplingGetStretch(const Bodies *bodies, Mat means, Mat *stretch)
{
  PetscInt start, end;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  PetscCall(CouplingsReserve(bodies, means, stretch));
  for (PetscInt i = start; i < end; ++i) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           n;

    PetscCall(MatGetRow(means, i, &n, &columns, &values));
    for (PetscInt d = 0; n && d < 3; ++d) {
      PetscCall(MatSetValue(*stretch, 3 * i + d, 3 * i + d, 1.0, ADD_VALUES));
      for (PetscInt k = 0; k < n; ++k)
        PetscCall(MatSetValue(*stretch, 3 * i + d, 3 * columns[k] + d, -values[k], ADD_VALUES));
    }
    PetscCall(MatRestoreRow(means, i, &n, &columns, &values));
  }
  PetscCall(MatAssemblyBegin(*stretch, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*stretch, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Creates stiffness = stretch^T diag(k a) stretch for the springs of one entry of the scene */
static PetscErrorCode CouplingAssemble(const Bodies *bodies, const SceneSpring *spring, Mat *stiffness)
{
  const SceneTie tie = {.name = spring->name,
    .place                    = spring->place,
    .mortar                   = spring->to,
    .nonmortar                = spring->face,
    .distance                 = spring->distance};
  Mat            means, stretch, stretched;
  Vec            k;

  PetscFunctionBegin;
  PetscCall(ContactTieCreate(bodies->dm, "springs", &tie, &means));
  PetscCall(CouplingGetStretch(bodies, means, &stretch));
  PetscCall(VecDuplicate(bodies->mass, &k));
  PetscCall(VecZeroEntries(k));
  PetscCall(ElasticityAddFaceField(bodies->elasticity, spring->face, spring->value, k));
  PetscCall(MatDuplicate(stretch, MAT_COPY_VALUES, &stretched));
  PetscCall(MatDiagonalScale(stretched, k, NULL));
  PetscCall(MatTransposeMatMult(stretch, stretched, MAT_INITIAL_MATRIX, PETSC_DEFAULT, stiffness));
  PetscCall(VecDestroy(&k));
  PetscCall(MatDestroy(&stretched));
  PetscCall(MatDestroy(&stretch));
  PetscCall(MatDestroy(&means));
  PetscFunctionReturn(0);
}

/* Collective. Creates the stiffness of all springs between faces; NULL if there are none */
PetscErrorCode CouplingsCreate(const Bodies *bodies, Mat *stiffness)
{
  PetscFunctionBegin;
  *stiffness = NULL;
  for (PetscInt s = 0; s < bodies->scene->nsprings; ++s) {
    Mat one;

    if (!bodies->scene->springs[s].to) continue;
    PetscCall(CouplingAssemble(bodies, &bodies->scene->springs[s], &one));
    if (*stiffness) {
      PetscCall(MatAXPY(*stiffness, 1.0, one, DIFFERENT_NONZERO_PATTERN));
      PetscCall(MatDestroy(&one));
    } else *stiffness = one;
  }
  PetscFunctionReturn(0);
}

/* Adds C^T S C to the stiffness, where S is the matrix of springs between unknowns and, in a time step, `rate` times
   that of dampers, and u = C x */
PetscErrorCode CouplingsAddStiffness(const Springs *springs, Mat C, Mat stiffness)
{
  const Mat       parts[]   = {springs->between, springs->dampers};
  const PetscReal factors[] = {1.0, springs->rate};

  PetscFunctionBegin;
  for (int p = 0; p < 2; ++p) {
    Mat product;

    if (!parts[p]) continue;
    PetscCall(MatPtAP(parts[p], C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    PetscCall(MatAXPY(stiffness, factors[p], product, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatDestroy(&product));
  }
  PetscFunctionReturn(0);
}
