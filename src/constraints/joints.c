/* Ties between faces, as rows of a matrix: the displacement of each node of one face is a weighted mean of
   displacements of the other face. */
#include "constraintsimpl.h"

/* Collective. Sums the matrices of all ties. tied[i]: number of the tie of node i of this rank; -1 if it is not tied */
static PetscErrorCode JointsCollect(const Constraints *c, Mat *all, PetscInt tied[])
{
  MPI_Comm comm = c->bodies.comm;

  PetscFunctionBegin;
  *all = NULL;
  for (PetscInt t = 0; t < c->bodies.scene->nties; ++t) {
    const SceneTie *tie = &c->bodies.scene->ties[t];
    PetscInt        start, end, twice = -1;
    Mat             rows;

    PetscCall(ContactTieCreate(c->bodies.dm, "tie", tie, &rows));
    PetscCall(MatGetOwnershipRange(rows, &start, &end));
    for (PetscInt i = start; i < end; ++i) {
      PetscInt n;

      PetscCall(MatGetRow(rows, i, &n, NULL, NULL));
      if (n && tied[i - start] >= 0) twice = tied[i - start];
      if (n) tied[i - start] = t;
      PetscCall(MatRestoreRow(rows, i, &n, NULL, NULL));
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &twice, 1, MPIU_INT, MPI_MAX, comm));
    SceneCheck(twice < 0, comm, PETSC_ERR_USER_INPUT, &c->bodies.scene->ties[twice],
      "ties \"%s\" and \"%s\" have common vertices on their nonmortar faces: swap mortar and nonmortar of one of them",
      c->bodies.scene->ties[twice].name, tie->name);
    if (*all) {
      PetscCall(MatAXPY(*all, 1.0, rows, DIFFERENT_NONZERO_PATTERN));
      PetscCall(MatDestroy(&rows));
    } else *all = rows;
  }
  PetscFunctionReturn(0);
}

/* Collective. It is an error if a node to which others are tied is itself tied. */
static PetscErrorCode JointsCheckChains(const Constraints *c, Mat all, const PetscInt tied[])
{
  Vec                is_tied, fixed;
  PetscScalar       *a;
  const PetscScalar *h;
  PetscInt           n, chained = -1;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(all, &is_tied, &fixed));
  PetscCall(VecGetLocalSize(is_tied, &n));
  PetscCall(VecGetArray(is_tied, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = tied[i] >= 0 ? 1.0 : 0.0;
  PetscCall(VecRestoreArray(is_tied, &a));
  PetscCall(MatMult(all, is_tied, fixed));
  PetscCall(VecGetArrayRead(fixed, &h));
  for (PetscInt i = 0; i < n; ++i) {
    if (PetscAbsScalar(h[i]) > 1e-12) chained = tied[i];
  }
  PetscCall(VecRestoreArrayRead(fixed, &h));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &chained, 1, MPIU_INT, MPI_MAX, c->bodies.comm));
  SceneCheck(chained < 0, c->bodies.comm, PETSC_ERR_USER_INPUT, &c->bodies.scene->ties[PetscMax(chained, 0)],
    "tie \"%s\": vertices of its mortar face %s are tied themselves: swap mortar and nonmortar of one of the ties",
    c->bodies.scene->ties[PetscMax(chained, 0)].name, c->bodies.scene->ties[PetscMax(chained, 0)].mortar);
  PetscCall(VecDestroy(&is_tied));
  PetscCall(VecDestroy(&fixed));
  PetscFunctionReturn(0);
}

/* Collective. It is an error if a tied node hangs, because a uniform stress would not be transmitted. */
static PetscErrorCode JointsCheckHanging(const Constraints *c, const PetscInt tied[])
{
  PetscInt start, end, hangs = -1;
  Mat      means;

  PetscFunctionBegin;
  PetscCall(MeshGetHanging(c->bodies.dm, &means));
  if (!means) PetscFunctionReturn(0);
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  for (PetscInt i = start; i < end; ++i) {
    PetscInt n;

    PetscCall(MatGetRow(means, i, &n, NULL, NULL));
    if (n && tied[i - start] >= 0) hangs = tied[i - start];
    PetscCall(MatRestoreRow(means, i, &n, NULL, NULL));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &hangs, 1, MPIU_INT, MPI_MAX, c->bodies.comm));
  SceneCheck(hangs < 0, c->bodies.comm, PETSC_ERR_USER_INPUT, &c->bodies.scene->ties[PetscMax(hangs, 0)],
    "tie \"%s\": its nonmortar face %s is locally refined: refine all of it or none, or swap mortar and nonmortar",
    c->bodies.scene->ties[PetscMax(hangs, 0)].name, c->bodies.scene->ties[PetscMax(hangs, 0)].nonmortar);
  PetscFunctionReturn(0);
}

/* Creates the matrix C of the ties alone, with three rows per node, from `all`, which has one row per node. Marks
   dependent rows in `follows`. Prescribed rows do not become dependent. */
PetscErrorCode JointsExpand(const Constraints *c, Mat all, const PetscInt tied[], const PetscBool prescribed[], Mat *C,
  PetscBool follows[])
{
  PetscInt nlocal, rstart, start;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(c->bodies.mass, &nlocal));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &rstart, NULL));
  PetscCall(MatGetOwnershipRange(all, &start, NULL));
  PetscCall(CouplingsReserve(&c->bodies, all, C));
  for (PetscInt i = 0; i < nlocal; ++i) {
    const PetscInt     row = rstart + i, node = i / 3;
    PetscInt           n;
    const PetscInt    *columns;
    const PetscScalar *values;

    if (tied[node] < 0 || prescribed[i]) {
      PetscCall(MatSetValue(*C, row, row, 1.0, INSERT_VALUES));
      continue;
    }
    follows[i] = PETSC_TRUE;
    PetscCall(MatGetRow(all, start + node, &n, &columns, &values));
    for (PetscInt k = 0; k < n; ++k) {
      if (PetscAbsScalar(values[k]) > 1e-14)
        PetscCall(MatSetValue(*C, row, 3 * columns[k] + i % 3, values[k], INSERT_VALUES));
    }
    PetscCall(MatRestoreRow(all, start + node, &n, &columns, &values));
  }
  PetscCall(MatAssemblyBegin(*C, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*C, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Collective. Creates the matrix C of the ties. *C is NULL if no faces are tied. */
PetscErrorCode JointsCreate(const Constraints *c, const PetscBool prescribed[], Mat *C, PetscBool follows[])
{
  PetscInt n, *tied;
  Mat      all;

  PetscFunctionBegin;
  *C = NULL;
  if (!c->bodies.scene->nties) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(PetscMalloc1(n / 3, &tied));
  for (PetscInt i = 0; i < n / 3; ++i) tied[i] = -1;
  PetscCall(JointsCollect(c, &all, tied));
  PetscCall(JointsCheckChains(c, all, tied));
  PetscCall(JointsCheckHanging(c, tied));
  PetscCall(JointsExpand(c, all, tied, prescribed, C, follows));
  PetscCall(MatDestroy(&all));
  PetscCall(PetscFree(tied));
  PetscFunctionReturn(0);
}
