/*
   Equations between displacements of points. Each of them makes one displacement component of a node dependent, by
   Gauss-Jordan elimination, after the displacements that other constraints determine were replaced. All ranks know all
   equations. The values of equations with the same ramp are displacements of dependent rows at factor 1 of that ramp.
*/
#include "constraintsimpl.h"

/* An equation: sum factor[k] x[column[k]] = 0. Columns from the number of unknowns on are factors of ramps. pivot: the
   dependent column, whose factor is 1 after the elimination */
typedef struct {
  PetscInt   n, pivot, *column;
  PetscReal *factor;
} EquationRow;

/* Computes a = a + t b. The columns of a row are in ascending order. */
static PetscErrorCode EquationAdd(EquationRow *a, PetscReal t, const EquationRow *b)
{
  EquationRow sum = {.pivot = a->pivot};

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(a->n + b->n, &sum.column, a->n + b->n, &sum.factor));
  for (PetscInt i = 0, j = 0; i < a->n || j < b->n;) {
    const PetscInt  column = PetscMin(i < a->n ? a->column[i] : PETSC_MAX_INT, j < b->n ? b->column[j] : PETSC_MAX_INT);
    const PetscReal one    = i < a->n && a->column[i] == column ? a->factor[i++] : 0.0;
    const PetscReal two    = j < b->n && b->column[j] == column ? t * b->factor[j++] : 0.0;

    if (PetscAbsReal(one + two) <= 1e-13 * PetscMax(PetscAbsReal(one), PetscAbsReal(two))) continue;
    sum.column[sum.n]   = column;
    sum.factor[sum.n++] = one + two;
  }
  PetscCall(PetscFree2(a->column, a->factor));
  *a = sum;
  PetscFunctionReturn(0);
}

/* Returns the factor of a column */
static PetscReal EquationGet(const EquationRow *row, PetscInt column)
{
  PetscInt at;

  if (PetscFindInt(column, row->n, row->column, &at) || at < 0) return 0.0;
  return row->factor[at];
}

/* Adds the entries of one point of an equation to a row, except shape functions below the rounding of positions */
static PetscErrorCode EquationAddPoint(const Constraints *c, const SceneEquation *equation, PetscInt end,
  EquationRow *row)
{
  const PetscReal   rounding = 1e-7;
  const SceneEntry *entry    = (const SceneEntry *)equation;
  BodyPoint         point;

  PetscFunctionBegin;
  PetscCall(BodyPointsLocate(c->bodies.dm, c->bodies.scene, "equation", 1, &entry,
    end ? &equation->to : &equation->body, &equation->point[end], &point));
  for (PetscInt k = 0; k < 3 * point.n; ++k) {
    PetscInt    column = 3 * point.node[k / 3] + k % 3;
    PetscReal   factor = point.N[k / 3] * equation->direction[end][k % 3];
    EquationRow one    = {.n = 1, .column = &column, .factor = &factor};

    if (PetscAbsReal(point.N[k / 3]) > rounding && factor != 0.0) PetscCall(EquationAdd(row, 1.0, &one));
  }
  PetscFunctionReturn(0);
}

/* Creates the row of an equation in terms of all displacements */
static PetscErrorCode EquationCreate(const Constraints *c, const SceneEquation *equation, EquationRow *row)
{
  PetscFunctionBegin;
  row->pivot = -1;
  PetscCall(EquationAddPoint(c, equation, 0, row));
  if (equation->to >= 0) PetscCall(EquationAddPoint(c, equation, 1, row));
  PetscFunctionReturn(0);
}

/* Collective. Substitutes u = D x in the equations, for the displacements that other constraints make dependent. D:
   the matrix of these constraints; NULL: there are none */
static PetscErrorCode EquationsSubstitute(const Constraints *c, Mat D, EquationRow rows[])
{
  PetscInt    n = c->bodies.scene->nequations, nlocal, widest = 0;
  PetscMPIInt rank;
  Mat         A, product;

  PetscFunctionBegin;
  if (!D) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Comm_rank(c->bodies.comm, &rank));
  PetscCall(VecGetLocalSize(c->bodies.mass, &nlocal));
  for (PetscInt e = 0; e < n; ++e) widest = PetscMax(widest, rows[e].n);
  PetscCall(MatCreateAIJ(c->bodies.comm, rank ? 0 : n, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, widest, NULL, widest,
    NULL, &A));
  for (PetscInt e = 0; !rank && e < n; ++e)
    PetscCall(MatSetValues(A, 1, &e, rows[e].n, rows[e].column, rows[e].factor, INSERT_VALUES));
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatMatMult(A, D, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  for (PetscInt e = 0; e < n; ++e) {
    EquationRow        row = {.pivot = -1};
    const PetscInt    *columns;
    const PetscScalar *values;

    if (!rank) PetscCall(MatGetRow(product, e, &row.n, &columns, &values));
    PetscCallMPI(MPI_Bcast(&row.n, 1, MPIU_INT, 0, c->bodies.comm));
    PetscCall(PetscMalloc2(row.n, &row.column, row.n, &row.factor));
    if (!rank) PetscCall(PetscArraycpy(row.column, columns, row.n));
    for (PetscInt k = 0; !rank && k < row.n; ++k) row.factor[k] = PetscRealPart(values[k]);
    if (!rank) PetscCall(MatRestoreRow(product, e, NULL, &columns, &values));
    PetscCallMPI(MPI_Bcast(row.column, (PetscMPIInt)row.n, MPIU_INT, 0, c->bodies.comm));
    PetscCallMPI(MPI_Bcast(row.factor, (PetscMPIInt)row.n, MPIU_REAL, 0, c->bodies.comm));
    PetscCall(PetscFree2(rows[e].column, rows[e].factor));
    rows[e] = row;
  }
  PetscCall(MatDestroy(&product));
  PetscCall(MatDestroy(&A));
  PetscFunctionReturn(0);
}

/* Subtracts the value from a row. n unknowns: length of `layout` */
static PetscErrorCode EquationAddValue(const SceneEquation *equation, Vec layout, EquationRow *row)
{
  PetscInt    column;
  PetscReal   factor = -equation->value;
  EquationRow value  = {.n = 1, .column = &column, .factor = &factor};

  PetscFunctionBegin;
  PetscCall(VecGetSize(layout, &column));
  column += equation->ramp;
  if (equation->value != 0.0) PetscCall(EquationAdd(row, 1.0, &value));
  PetscFunctionReturn(0);
}

/* Collective. Eliminates the pivots of the rows before from row e, and finds its own pivot, the free column with the
   largest factor; -1 if there is none. taken: 1 for unknowns that are prescribed or dependent, else 0 */
static PetscErrorCode EquationChoose(MPI_Comm comm, PetscInt e, Vec taken, EquationRow rows[])
{
  EquationRow       *row = &rows[e];
  PetscReal         *free, most = 0.0;
  PetscInt           start, end;
  const PetscScalar *t;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < e; ++k) {
    const PetscReal factor = EquationGet(row, rows[k].pivot);

    if (factor != 0.0) PetscCall(EquationAdd(row, -factor, &rows[k]));
  }
  PetscCall(PetscCalloc1(row->n, &free));
  PetscCall(VecGetOwnershipRange(taken, &start, &end));
  PetscCall(VecGetArrayRead(taken, &t));
  for (PetscInt k = 0; k < row->n; ++k) {
    const PetscInt own = row->column[k];

    if (own >= start && own < end && PetscRealPart(t[own - start]) == 0.0) free[k] = PetscAbsReal(row->factor[k]);
  }
  PetscCall(VecRestoreArrayRead(taken, &t));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, free, (PetscMPIInt)row->n, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt k = 0; k < row->n; ++k) {
    if (free[k] > most) most = free[k], row->pivot = row->column[k];
  }
  PetscCall(PetscFree(free));
  PetscFunctionReturn(0);
}

/* Eliminates the pivot of row e from the rows before, after scaling it to 1 */
static PetscErrorCode EquationEliminate(PetscInt e, EquationRow rows[])
{
  const PetscReal pivot = EquationGet(&rows[e], rows[e].pivot);

  PetscFunctionBegin;
  for (PetscInt k = 0; k < rows[e].n; ++k) rows[e].factor[k] /= pivot;
  for (PetscInt q = 0; q < e; ++q) {
    const PetscReal factor = EquationGet(&rows[q], rows[e].pivot);

    if (factor != 0.0) PetscCall(EquationAdd(&rows[q], -factor, &rows[e]));
  }
  PetscFunctionReturn(0);
}

/* Creates the matrix C of the equations, and for each ramp with values the displacements given[ramp] of dependent rows
   at factor 1 */
static PetscErrorCode EquationsAssemble(const Constraints *c, const EquationRow rows[], Mat *C, Vec given[])
{
  const PetscInt n = c->bodies.scene->nequations;
  PetscInt       nlocal, start, end, size, widest = 1;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(c->bodies.mass, &nlocal));
  PetscCall(VecGetSize(c->bodies.mass, &size));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &start, &end));
  for (PetscInt e = 0; e < n; ++e) widest = PetscMax(widest, rows[e].n);
  PetscCall(
    MatCreateAIJ(c->bodies.comm, nlocal, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, widest, NULL, widest, NULL, C));
  for (PetscInt i = start; i < end; ++i) PetscCall(MatSetValue(*C, i, i, 1.0, INSERT_VALUES));
  for (PetscInt e = 0; e < n; ++e) {
    const PetscInt row = rows[e].pivot;

    for (PetscInt k = 0; k < rows[e].n; ++k) {
      const PetscInt column = rows[e].column[k], ramp = column - size;

      if (ramp >= 0 && !given[ramp]) PetscCall(VecDuplicate(c->bodies.mass, &given[ramp]));
      if (row < start || row >= end) continue;
      if (ramp >= 0) PetscCall(VecSetValue(given[ramp], row, -rows[e].factor[k], INSERT_VALUES));
      else PetscCall(MatSetValue(*C, row, column, column == row ? 0.0 : -rows[e].factor[k], INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(*C, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*C, MAT_FINAL_ASSEMBLY));
  for (PetscInt r = 0; r < c->bodies.scene->nramps; ++r) {
    if (given[r]) PetscCall(VecAssemblyBegin(given[r]));
    if (given[r]) PetscCall(VecAssemblyEnd(given[r]));
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates the matrix C of the equations, and for each ramp the displacements given[ramp] that their values
   cause at factor 1; NULL if there are none. With the matrix D of the other constraints, u = D (C x + given).
   prescribed: rows of this rank that are prescribed; follows: rows that depend on others, to which those of the
   equations are added */
PetscErrorCode EquationsCreate(const Constraints *c, Mat D, const PetscBool prescribed[], Mat *C, Vec given[],
  PetscBool follows[])
{
  Scene        scene = c->bodies.scene;
  PetscInt     n, start;
  EquationRow *rows;
  PetscScalar *t;
  Vec          taken;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(c->bodies.mass, &taken));
  PetscCall(VecGetLocalSize(taken, &n));
  PetscCall(VecGetOwnershipRange(taken, &start, NULL));
  PetscCall(VecGetArray(taken, &t));
  for (PetscInt i = 0; i < n; ++i) t[i] = prescribed[i] || follows[i];
  PetscCall(VecRestoreArray(taken, &t));
  PetscCall(PetscCalloc1(scene->nequations, &rows));
  for (PetscInt e = 0; e < scene->nequations; ++e) PetscCall(EquationCreate(c, &scene->equations[e], &rows[e]));
  PetscCall(EquationsSubstitute(c, D, rows));
  for (PetscInt e = 0; e < scene->nequations; ++e) {
    PetscCall(EquationAddValue(&scene->equations[e], taken, &rows[e]));
    PetscCall(EquationChoose(c->bodies.comm, e, taken, rows));
    SceneCheck(rows[e].pivot >= 0, c->bodies.comm, PETSC_ERR_USER_INPUT, &scene->equations[e],
      "equation \"%s\" contains no free displacement: other constraints or equations determine all of them",
      scene->equations[e].name);
    PetscCall(EquationEliminate(e, rows));
  }
  PetscCall(EquationsAssemble(c, rows, C, given));
  for (PetscInt e = 0; e < scene->nequations; ++e) {
    if (rows[e].pivot >= start && rows[e].pivot < start + n) follows[rows[e].pivot - start] = PETSC_TRUE;
    PetscCall(PetscFree2(rows[e].column, rows[e].factor));
  }
  PetscCall(PetscFree(rows));
  PetscCall(VecDestroy(&taken));
  PetscFunctionReturn(0);
}
