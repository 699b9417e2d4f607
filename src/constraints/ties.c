/*
   Dependent displacements: those of tied faces, inclined symmetry planes, the second faces of cyclic symmetries,
   hanging vertices, equations, and rigid bodies that forces drive. They are not unknowns but functions of other
   displacements, u = C x + o. The vector x has the layout of u; its values in dependent rows are not used. Energy,
   forces and gaps are evaluated at C x + o. Forces f become C^T f, and a stiffness K becomes C^T K C with a diagonal in
   dependent rows. o comes from prescribed motions of rigid bodies and from equations with a value. Prescribed rows do
   not become dependent.
*/
#include "constraintsimpl.h"

/* Marks the local rows that are prescribed */
static PetscErrorCode TiesMarkPrescribed(const Constraints *c, PetscInt rstart, PetscBool prescribed[])
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < c->prescribed->n; ++k) prescribed[c->prescribed->rows[k] - rstart] = PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* Creates the matrix C of hanging vertices; NULL if none hangs. Hanging vertices with prescribed displacements do not
   become dependent. */
static PetscErrorCode TiesCreateHanging(const Constraints *c, const PetscBool prescribed[], Mat *C, PetscBool follows[])
{
  PetscInt start, end, *hangs;
  Mat      means;

  PetscFunctionBegin;
  *C = NULL;
  PetscCall(MeshGetDependent(c->bodies.dm, &means));
  if (!means) PetscFunctionReturn(0);
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  PetscCall(PetscMalloc1(end - start, &hangs));
  for (PetscInt i = start; i < end; ++i) {
    PetscInt n;

    PetscCall(MatGetRow(means, i, &n, NULL, NULL));
    hangs[i - start] = n ? 0 : -1;
    PetscCall(MatRestoreRow(means, i, &n, NULL, NULL));
  }
  PetscCall(JointsExpand(c, means, hangs, prescribed, C, follows));
  PetscCall(PetscFree(hangs));
  PetscFunctionReturn(0);
}

/* Computes C = A C. If *C is NULL, C = A. If A is NULL, C is unchanged. */
static PetscErrorCode TiesApplyNext(Mat A, Mat *C)
{
  Mat product;

  PetscFunctionBegin;
  if (!A) PetscFunctionReturn(0);
  if (*C) {
    PetscCall(MatMatMult(A, *C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    PetscCall(MatDestroy(C));
    *C = product;
  } else {
    PetscCall(PetscObjectReference((PetscObject)A));
    *C = A;
  }
  PetscFunctionReturn(0);
}

/*
   Computes C of all constraints except equations. Tied nodes may depend on nodes on symmetry planes, on hanging
   vertices and on nodes of the second face of a cyclic symmetry, and may be such nodes themselves. Hanging vertices may
   lie between nodes on planes and nodes of cyclic symmetries. Therefore x is first multiplied by the matrix of the
   planes, then by that of cyclic symmetries, then by that of hanging vertices, and once more by that of cyclic
   symmetries, whose second faces may have hanging vertices. All follow once more after the ties.
*/
static PetscErrorCode TiesCompose(Mat joints, Mat planes, Mat cyclic, Mat hanging, Mat *C)
{
  PetscFunctionBegin;
  *C = NULL;
  for (PetscInt k = 0; k < (joints ? 2 : 1); ++k) {
    if (k) PetscCall(TiesApplyNext(joints, C));
    PetscCall(TiesApplyNext(planes, C));
    if (hanging) PetscCall(TiesApplyNext(cyclic, C));
    PetscCall(TiesApplyNext(hanging, C));
    PetscCall(TiesApplyNext(cyclic, C));
  }
  PetscCall(MatDestroy(&joints));
  PetscCall(MatDestroy(&cyclic));
  PetscCall(MatDestroy(&planes));
  PetscFunctionReturn(0);
}

/* Multiplies C by the matrix of the equations from the right. *moves: whether equations have values */
static PetscErrorCode TiesAddEquations(const Constraints *c, const PetscBool prescribed[], PetscBool follows[], Mat *C,
  PetscBool *moves)
{
  Ties *ties = c->ties;
  Mat   equations;
  Vec   moved;

  PetscFunctionBegin;
  *moves       = PETSC_FALSE;
  ties->nramps = c->bodies.scene->nramps;
  PetscCall(PetscCalloc1(ties->nramps, &ties->given));
  if (!c->bodies.scene->nequations) PetscFunctionReturn(0);
  PetscCall(EquationsCreate(c, *C, prescribed, &equations, ties->given, follows));
  for (PetscInt r = 0; r < ties->nramps; ++r) {
    if (!ties->given[r]) continue;
    *moves = PETSC_TRUE;
    if (!*C) continue;
    PetscCall(VecDuplicate(ties->given[r], &moved));
    PetscCall(MatMult(*C, ties->given[r], moved));
    PetscCall(VecDestroy(&ties->given[r]));
    ties->given[r] = moved;
  }
  PetscCall(TiesApplyNext(*C, &equations));
  PetscCall(MatDestroy(C));
  *C = equations;
  PetscFunctionReturn(0);
}

/* Creates a diagonal matrix with a constant value */
static PetscErrorCode TiesCreateDiagonal(Vec layout, PetscReal value, Mat *diagonal)
{
  PetscInt start, end;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(layout, &start, &end));
  PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)layout), end - start, end - start, PETSC_DETERMINE,
    PETSC_DETERMINE, 1, NULL, 0, NULL, diagonal));
  for (PetscInt i = start; i < end; ++i) PetscCall(MatSetValue(*diagonal, i, i, value, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(*diagonal, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*diagonal, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Computes C = joined R if there are rigid bodies that forces drive */
static PetscErrorCode TiesJoinRigid(const Constraints *c)
{
  Ties *ties = c->ties;

  PetscFunctionBegin;
  if (!c->rigid->R) PetscFunctionReturn(0);
  PetscCall(MatDestroy(&ties->C));
  PetscCall(MatDestroy(&ties->elastic));
  PetscCall(TiesApplyNext(c->rigid->R, &ties->C));
  PetscCall(TiesApplyNext(ties->joined, &ties->C));
  PetscCall(MatSetBlockSizes(ties->C, 3, 3));
  PetscCall(MatDuplicate(ties->C, MAT_COPY_VALUES, &ties->elastic));
  PetscCall(MatDiagonalScale(ties->elastic, c->rigid->elastic, NULL));
  PetscFunctionReturn(0);
}

/* Lists the dependent rows of this rank: those of elastic bodies that are in the list already, and the rows marked in
   `follows` */
static PetscErrorCode TiesListRows(const Constraints *c, PetscInt rstart, const PetscBool follows[])
{
  Ties              *ties = c->ties;
  PetscInt           n, kept = 0, added = 0;
  PetscInt          *rows;
  const PetscScalar *elastic = NULL;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(PetscMalloc1(n, &rows));
  if (c->rigid->elastic) PetscCall(VecGetArrayRead(c->rigid->elastic, &elastic));
  for (PetscInt k = 0; elastic && k < ties->n; ++k) {
    if (PetscRealPart(elastic[ties->rows[k] - rstart]) > 0.0) rows[kept++] = ties->rows[k];
  }
  if (c->rigid->elastic) PetscCall(VecRestoreArrayRead(c->rigid->elastic, &elastic));
  for (PetscInt i = 0; i < n; ++i) {
    if (follows[i]) rows[kept + added++] = rstart + i;
  }
  PetscCall(PetscFree(ties->rows));
  ties->rows = rows;
  ties->n    = kept + added;
  PetscFunctionReturn(0);
}

/* Collective. Creates C. Must be called after the prescribed rows, and before the stiffness, were created. */
PetscErrorCode TiesCreate(const Constraints *c)
{
  Ties      *ties = c->ties;
  PetscInt   n, rstart;
  PetscBool *prescribed, *follows, moves;
  Mat        joints, planes, cyclic, all;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &rstart, NULL));
  PetscCall(PetscCalloc2(n, &prescribed, n, &follows));
  PetscCall(TiesMarkPrescribed(c, rstart, prescribed));
  PetscCall(PlanesCreate(c, prescribed, &planes, follows));
  PetscCall(JointsCreate(c, prescribed, &joints, follows));
  PetscCall(TiesCreateHanging(c, prescribed, &ties->hanging, follows));
  PetscCall(CyclicCreate(c, prescribed, &cyclic, follows));
  PetscCall(RigidCreate(c, prescribed, follows));
  PetscCall(TiesCompose(joints, planes, cyclic, ties->hanging, &all));
  PetscCall(TiesAddEquations(c, prescribed, follows, &all, &moves));
  if (all || c->rigid->R || c->springs->between || c->springs->dampers) {
    *(c->rigid->R ? &ties->joined : &ties->C) = all;
    PetscCall(TiesJoinRigid(c));
    if (!ties->C) PetscCall(TiesCreateDiagonal(c->bodies.mass, 1.0, &ties->C));
    PetscCall(MatSetBlockSizes(ties->C, 3, 3));
    PetscCall(TiesListRows(c, rstart, follows));
    PetscCall(VecDuplicate(c->bodies.mass, &ties->work));
    if (c->rigid->R || moves) PetscCall(VecDuplicate(c->bodies.mass, &ties->o));
    if (c->rigid->R || moves) PetscCall(VecZeroEntries(ties->o));
    PetscCall(ElasticitySetMatType(c->bodies.elasticity, MATAIJ));
  }
  PetscCall(PetscFree2(prescribed, follows));
  PetscFunctionReturn(0);
}

/* Adds to v the displacements due to the values of equations at a time */
static PetscErrorCode TiesAddGiven(const Constraints *c, PetscReal time, Vec v)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < c->ties->nramps; ++r) {
    PetscReal factor;

    if (!c->ties->given[r]) continue;
    PetscCall(SceneGetFactor(c->bodies.scene, r, time, &factor));
    PetscCall(VecAXPY(v, factor, c->ties->given[r]));
  }
  PetscFunctionReturn(0);
}

/* Updates o to the prescribed motions and the values of equations at a time */
static PetscErrorCode TiesMove(const Constraints *c, PetscReal time)
{
  Ties *ties = c->ties;

  PetscFunctionBegin;
  if (!ties->o) PetscFunctionReturn(0);
  if (c->rigid->R) {
    PetscCall(RigidMove(c, time, ties->joined ? ties->work : ties->o));
    if (ties->joined) PetscCall(MatMult(ties->joined, ties->work, ties->o));
  } else PetscCall(VecZeroEntries(ties->o));
  PetscCall(TiesAddGiven(c, time, ties->o));
  PetscFunctionReturn(0);
}

/* Collective. Updates C and o if rigid bodies have finite free rotations, which are linearized about the displacement
   u. u_last: displacement at the last state. *anew: whether the tangent of linear bodies changes with C */
PetscErrorCode TiesTurn(const Constraints *c, PetscReal time, Vec u_last, Vec u, PetscBool *anew)
{
  PetscInt   n, rstart;
  PetscBool *prescribed, *follows;

  PetscFunctionBegin;
  *anew = PETSC_FALSE;
  if (c->rigid->turns) {
    PetscCall(VecGetLocalSize(c->bodies.mass, &n));
    PetscCall(VecGetOwnershipRange(c->bodies.mass, &rstart, NULL));
    PetscCall(PetscCalloc2(n, &prescribed, n, &follows));
    PetscCall(TiesMarkPrescribed(c, rstart, prescribed));
    PetscCall(RigidTurn(c, time, u_last, u));
    PetscCall(RigidMakeRows(c, prescribed, follows, anew));
    PetscCall(TiesJoinRigid(c));
    PetscCall(TiesListRows(c, rstart, follows));
    PetscCall(PetscFree2(prescribed, follows));
    *anew = (PetscBool)(*anew || c->ties->joined || c->springs->stiffness);
  }
  PetscCall(TiesMove(c, time));
  PetscFunctionReturn(0);
}

/* Collective. Replaces the linearized motions of rigid bodies in u by the finite motions at a time. *change: the
   largest change of the displacement [length]; 0 if no body has finite free rotations */
PetscErrorCode TiesStraighten(const Constraints *c, PetscReal time, Vec u, PetscReal *change)
{
  PetscFunctionBegin;
  *change = 0.0;
  if (!c->rigid->turns) PetscFunctionReturn(0);
  PetscCall(RigidStraighten(c, u, change));
  if (!c->ties->joined) PetscFunctionReturn(0);
  PetscCall(VecCopy(u, c->ties->work));
  PetscCall(MatMult(c->ties->joined, c->ties->work, u));
  PetscCall(TiesAddGiven(c, time, u));
  PetscFunctionReturn(0);
}

/* Computes u = C u + o, so that the dependent rows follow from the others */
PetscErrorCode TiesFollow(const Ties *ties, Vec u)
{
  PetscFunctionBegin;
  if (!ties->C) PetscFunctionReturn(0);
  PetscCall(VecCopy(u, ties->work));
  PetscCall(MatMult(ties->C, ties->work, u));
  if (ties->o) PetscCall(VecAXPY(u, 1.0, ties->o));
  PetscFunctionReturn(0);
}

/* Computes f = C^T f, which moves forces on dependent rows to the rows on which they depend */
PetscErrorCode TiesGather(const Ties *ties, Vec f)
{
  PetscFunctionBegin;
  if (!ties->C) PetscFunctionReturn(0);
  PetscCall(VecCopy(f, ties->work));
  PetscCall(MatMultTranspose(ties->C, ties->work, f));
  PetscFunctionReturn(0);
}

/*
   Collective. Moves forces on dependent rows to the rows on which they depend. *ties: the forces on the bodies that
   this represents, except those between hanging vertices and their cells. *rigid: the forces on rigid bodies that keep
   them rigid and in their prescribed motions. Both are NULL if there are none.
*/
PetscErrorCode TiesGetForces(const Constraints *c, Vec force, Vec *ties, Vec *rigid)
{
  const Ties *t = c->ties;

  PetscFunctionBegin;
  *ties = *rigid = NULL;
  if (!t->C) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(force, ties));
  if (t->hanging) PetscCall(MatMultTranspose(t->hanging, force, *ties));
  else PetscCall(VecCopy(force, *ties));
  if (c->rigid->R) {
    PetscCall(VecDuplicate(force, rigid));
    if (t->joined) PetscCall(MatMultTranspose(t->joined, force, *rigid));
    else PetscCall(VecCopy(force, *rigid));
    PetscCall(VecAXPY(*ties, -1.0, *rigid));
    PetscCall(MatMultTranspose(c->rigid->R, *rigid, force));
    PetscCall(VecAXPY(*rigid, -1.0, force));
    PetscFunctionReturn(0);
  }
  PetscCall(TiesGather(t, force));
  PetscCall(VecAXPY(*ties, -1.0, force));
  PetscFunctionReturn(0);
}

/* Sets the dependent rows of v to one value */
PetscErrorCode TiesSet(const Ties *ties, PetscReal value, Vec v)
{
  PetscFunctionBegin;
  PetscCall(RowsSet(ties->n, ties->rows, value, v));
  PetscFunctionReturn(0);
}

/* Sets prescribed and dependent rows and columns to zero, except for the diagonal entries, which are set to those of
   `diagonal` */
static PetscErrorCode TiesClearRows(const Constraints *c, Vec diagonal, Mat tied)
{
  const Ties        *ties = c->ties;
  PetscInt           rstart;
  Vec                now;
  PetscScalar       *d;
  const PetscScalar *old;

  PetscFunctionBegin;
  PetscCall(MatZeroRowsColumns(tied, c->prescribed->n, c->prescribed->rows, 0.0, NULL, NULL));
  PetscCall(VecDuplicate(diagonal, &now));
  PetscCall(MatGetDiagonal(tied, now));
  PetscCall(VecGetOwnershipRange(now, &rstart, NULL));
  PetscCall(VecGetArray(now, &d));
  PetscCall(VecGetArrayRead(diagonal, &old));
  for (PetscInt k = 0; k < c->prescribed->n; ++k)
    d[c->prescribed->rows[k] - rstart] = old[c->prescribed->rows[k] - rstart];
  for (PetscInt k = 0; k < ties->n; ++k) d[ties->rows[k] - rstart] = old[ties->rows[k] - rstart];
  PetscCall(VecRestoreArrayRead(diagonal, &old));
  PetscCall(VecRestoreArray(now, &d));
  PetscCall(MatDiagonalSet(tied, now, INSERT_VALUES));
  PetscCall(VecDestroy(&now));
  PetscFunctionReturn(0);
}

/* Collective. Computes tied = C^T K C and allocates all diagonal entries, because the product has none in dependent
   rows */
PetscErrorCode TiesMultiply(Mat C, Mat K, Mat *tied)
{
  PetscBool aij;
  Vec       layout;
  Mat       places, A = K;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompareAny((PetscObject)K, &aij, MATSEQAIJ, MATMPIAIJ, ""));
  if (!aij) PetscCall(MatConvert(K, MATAIJ, MAT_INITIAL_MATRIX, &A));
  PetscCall(MatPtAP(A, C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, tied));
  if (!aij) PetscCall(MatDestroy(&A));
  PetscCall(MatCreateVecs(*tied, &layout, NULL));
  PetscCall(TiesCreateDiagonal(layout, 0.0, &places));
  PetscCall(MatAXPY(*tied, 1.0, places, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&places));
  PetscCall(VecDestroy(&layout));
  PetscFunctionReturn(0);
}

/* Collective. Assembles the tangent at u: the stiffness minus the derivative of follower loads. If rows are dependent,
   it is C^T K C with a diagonal in these rows. */
PetscErrorCode TiesTangent(const Constraints *c, Vec u, Mat K)
{
  Ties           *ties  = c->ties;
  const PetscBool rigid = (PetscBool)(SceneIsDynamic(c->bodies.scene) || !ties->elastic); /* rows of rigid bodies */
  Vec             diagonal;
  Mat             tied;

  PetscFunctionBegin;
  if (!ties->C) {
    PetscCall(ElasticityTangent(c->bodies.elasticity, u, K));
    if (*c->follows) PetscCall(MatAXPY(K, -1.0, *c->follows, SAME_NONZERO_PATTERN));
    PetscFunctionReturn(0);
  }
  PetscCall(ElasticityTangent(c->bodies.elasticity, u, ties->K));
  if (*c->follows) PetscCall(MatAXPY(ties->K, -1.0, *c->follows, SAME_NONZERO_PATTERN));
  PetscCall(VecDuplicate(u, &diagonal));
  PetscCall(MatGetDiagonal(ties->K, diagonal));
  PetscCall(TiesMultiply(rigid ? ties->C : ties->elastic, ties->K, &tied));
  PetscCall(CouplingsAddStiffness(c->springs, ties->C, tied));
  if (c->rigid->R) PetscCall(RigidAddStiffness(c, ties->C, diagonal, tied));
  PetscCall(TiesClearRows(c, diagonal, tied));
  PetscCall(MatSetBlockSize(tied, 3));
  PetscCall(MatSetOption(tied, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetOption(tied, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  PetscCall(MatHeaderReplace(K, &tied));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(0);
}

/* Collective. Creates the solvers' stiffness matrix. If rows are dependent it has type AIJ, and the stiffness of the
   bodies alone is ties->K. */
PetscErrorCode TiesCreateTangent(const Constraints *c, Mat *K)
{
  PetscFunctionBegin;
  PetscCall(ElasticityCreateTangent(c->bodies.elasticity, K));
  if (!c->ties->C) PetscFunctionReturn(0);
  c->ties->K = *K;
  PetscCall(MatDuplicate(c->ties->K, MAT_DO_NOT_COPY_VALUES, K));
  PetscFunctionReturn(0);
}

PetscErrorCode TiesDestroy(Ties *ties)
{
  PetscFunctionBegin;
  for (PetscInt r = 0; r < ties->nramps; ++r) PetscCall(VecDestroy(&ties->given[r]));
  PetscCall(PetscFree(ties->given));
  PetscCall(MatDestroy(&ties->C));
  PetscCall(MatDestroy(&ties->K));
  PetscCall(MatDestroy(&ties->hanging));
  PetscCall(MatDestroy(&ties->joined));
  PetscCall(MatDestroy(&ties->elastic));
  PetscCall(VecDestroy(&ties->o));
  PetscCall(VecDestroy(&ties->work));
  PetscCall(PetscFree(ties->rows));
  PetscFunctionReturn(0);
}
