/*
   Rows of one contact pair: area, normal, pressure, gap, friction and status. A row and a node B of either side share
   the area |mass_A cover_AB . n_A| covered_A. Values of rows are transferred to nodes, and back, in proportion to it.
*/
#include "pair_rows.h"
#include <vector3.h>
#include "src/state/contact_state.h"

/* Returns the matrix by which areas are distributed to nodes */
static Mat PairCover(ContactLinearization lin)
{
  return lin->cover ? lin->cover : lin->J;
}

/* Computes for each row A the vector mass_A x sum of A_AB over the nodes B of the mortar side. first: position of these
   sums in those of the linearization, if it has them */
static PetscErrorCode PairRowsSum(const Measured *at, PetscInt pair, Mat A, PetscInt first, PetscReal vector[])
{
  ContactLinearization lin = at->solved->linearization;
  Vec                  mark, sum;
  const PetscScalar   *s, *mass;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(at->u, &mark));
  PetscCall(VecDuplicate(lin->mass, &sum));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecZeroEntries(mark));
    PetscCall(MeshFaceSet(at->dm, at->scene->pairs[pair].mortar, c, 1.0, mark));
    PetscCall(MatMult(A, mark, sum));
    PetscCall(VecGetArrayRead(sum, &s));
    for (PetscInt r = 0; r < lin->nlocal; ++r) {
      const PetscReal all = lin->mortar_sum ? lin->mortar_sum[6 * r + first + c] : PetscRealPart(s[r]);

      vector[3 * r + c] = lin->pair[r] == pair ? mass[r] * all : 0.0;
    }
    PetscCall(VecRestoreArrayRead(sum, &s));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

/*
   Creates the matrix of the areas that rows and nodes share: factor x mass_A A_AB . n_A covered_A for the matrix A; and
   that of a second one, if any, which is added. The vectors of a row at nodes near the other face of a cut of cyclic
   symmetry are turned; therefore their lengths are used.
*/
static PetscErrorCode PairShare(ContactLinearization lin, const PairRows *rows, PetscInt nmatrices, const Mat A[],
  const PetscReal factor[], Mat *shares)
{
  const PetscScalar *mass, *covered;
  PetscScalar       *value;
  PetscInt          *row, *node, first, nodes, entries = 0;
  MatInfo            info;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < nmatrices; ++k) {
    PetscCall(MatGetInfo(A[k], MAT_LOCAL, &info));
    entries += (PetscInt)info.nz_used;
  }
  PetscCall(PetscMalloc3(entries, &row, entries, &node, entries, &value));
  PetscCall(MatGetOwnershipRange(A[0], &first, NULL));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  PetscCall(VecGetArrayRead(rows->value[ROW_COVERED], &covered));
  entries = 0;
  for (PetscInt r = 0; r < nmatrices * rows->n; ++r) {
    const PetscInt     k = r / rows->n, own = r % rows->n;
    const PetscInt    *column;
    const PetscScalar *entry;
    PetscInt           n;

    if (covered[own] == 0.0) continue;
    PetscCall(MatGetRow(A[k], first + own, &n, &column, &entry));
    for (PetscInt i = 0; i < n; ++entries) {
      PetscReal along = 0.0, square = 0.0;

      row[entries]  = first + own;
      node[entries] = column[i] / 3;
      for (; i < n && column[i] / 3 == node[entries]; ++i) {
        along += PetscRealPart(entry[i]) * rows->normal[3 * own + column[i] % 3];
        square += PetscSqr(PetscRealPart(entry[i]));
      }
      value[entries] = factor[k] * mass[own] * covered[own] * (lin->mortar_sum ? PetscSqrtReal(square) : along);
    }
    PetscCall(MatRestoreRow(A[k], first + own, &n, &column, &entry));
  }
  PetscCall(VecRestoreArrayRead(rows->value[ROW_COVERED], &covered));
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecGetLocalSize(rows->sides, &nodes));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)A[0]), shares));
  PetscCall(MatSetSizes(*shares, rows->n, nodes, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*shares, MATAIJ));
  PetscCall(MatSetPreallocationCOO(*shares, entries, row, node));
  PetscCall(MatSetValuesCOO(*shares, value, INSERT_VALUES));
  PetscCall(PetscFree3(row, node, value));
  PetscFunctionReturn(0);
}

/* Marks each node of a face in contact with itself by the side to which most of its area belongs */
static PetscErrorCode PairMarkSelf(PairRows *rows)
{
  const PetscScalar *both, *mortar;
  PetscScalar       *side;
  PetscInt           n;
  Vec                areas, part;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->sides, &areas));
  PetscCall(VecDuplicate(rows->sides, &part));
  PetscCall(MatMultTranspose(rows->shares, rows->value[ROW_ONE], areas));
  PetscCall(MatMultTranspose(rows->mortar, rows->value[ROW_ONE], part));
  PetscCall(VecGetLocalSize(areas, &n));
  PetscCall(VecGetArrayRead(areas, &both));
  PetscCall(VecGetArrayRead(part, &mortar));
  PetscCall(VecGetArrayWrite(rows->sides, &side));
  for (PetscInt i = 0; i < n; ++i)
    side[i] =
      PetscRealPart(both[i]) > 0.0 ? (2.0 * PetscRealPart(mortar[i]) >= PetscRealPart(both[i]) ? 1.0 : -1.0) : 0.0;
  PetscCall(VecRestoreArrayWrite(rows->sides, &side));
  PetscCall(VecRestoreArrayRead(part, &mortar));
  PetscCall(VecRestoreArrayRead(areas, &both));
  PetscCall(VecDestroy(&areas));
  PetscCall(VecDestroy(&part));
  PetscFunctionReturn(0);
}

/*
   Marks the sides, and computes the shared areas. If both sides are one face, `cover` holds the difference of the two
   sides' integrals. Their sum is then computed as twice the part of the mortar side minus `cover`.
*/
static PetscErrorCode PairShareSides(const Measured *at, const SceneContactPair *faces, PairRows *rows)
{
  ContactLinearization lin       = at->solved->linearization;
  const Mat            A[2]      = {PairCover(lin), lin->mortar_cover};
  const PetscReal      factor[2] = {rows->self ? -1.0 : 1.0, 2.0}, one = 1.0;
  PetscInt             n;
  Vec                  mark;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(at->u, &n));
  PetscCall(VecCreateMPI(at->comm, n / 3, PETSC_DETERMINE, &rows->sides));
  PetscCall(VecDuplicate(rows->sides, &rows->gathered));
  PetscCall(VecDuplicate(at->u, &mark));
  PetscCall(VecZeroEntries(mark));
  PetscCall(MeshFaceSet(at->dm, faces->mortar, 0, 1.0, mark));
  if (!rows->self) PetscCall(MeshFaceSet(at->dm, faces->nonmortar, 0, 0.0, mark));
  PetscCall(VecStrideGather(mark, 0, rows->gathered, INSERT_VALUES));
  if (!rows->self) PetscCall(MeshFaceSet(at->dm, faces->nonmortar, 0, -1.0, mark));
  PetscCall(VecStrideGather(mark, 0, rows->sides, INSERT_VALUES));
  PetscCall(VecDestroy(&mark));
  PetscCall(PairShare(lin, rows, rows->self ? 2 : 1, A, factor, &rows->shares));
  if (rows->self) {
    PetscCall(PairShare(lin, rows, 1, &A[1], &one, &rows->mortar));
    PetscCall(PairMarkSelf(rows));
  } else if (!lin->mortar_sum) /* entries of the nonmortar side have the opposite sign */
    PetscCall(MatDiagonalScale(rows->shares, NULL, rows->sides));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes the means of a field of the mortar side over the rows: the sum over the mortar nodes of the area
   that they share with the row, times their value, over w_A; 0 in rows of other pairs. The field is set to 0 at other
   nodes.
*/
PetscErrorCode PairGather(const PairRows *rows, Vec node, Vec row)
{
  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(node, node, rows->gathered));
  PetscCall(MatMult(rows->self ? rows->mortar : rows->shares, node, row));
  PetscCall(VecQuotient_AMGF(row, row, rows->value[ROW_AREA])); /* a quotient by 0 is 0 */
  PetscFunctionReturn(0);
}

/*
   Returns whether a row is in contact: the strain that corresponds to the pressure (pressure/young) exceeds that of the
   gap (gap/length). With an interior point method the product of the two is equal in all rows and tends to zero.
*/
PetscBool PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length)
{
  return (PetscBool)(pressure / young > gap / length);
}

/* Sets friction stress and slip. A row slips if its slip exceeds the rounding error of displacements. */
static PetscErrorCode PairRowsSetFriction(const Measured *at, PetscInt pair, const PetscScalar mass[], PairRows *rows,
  PetscScalar *a[])
{
  const PetscReal      rounding = 1e-9;
  ContactLinearization lin      = at->solved->linearization;
  const PetscScalar   *slip, *shear;
  PetscReal            size;

  PetscFunctionBegin;
  PetscCall(VecNorm(at->u, NORM_INFINITY, &size));
  PetscCall(VecGetArrayRead(at->solved->solution.slip, &slip));
  PetscCall(VecGetArrayRead(at->solved->solution.shear, &shear));
  for (PetscInt r = 0; r < rows->n; ++r) {
    const PetscScalar *s = &slip[2 * r], *f = &shear[2 * r];
    const PetscReal   *t = &lin->tangent[6 * r];

    if (lin->pair[r] != pair || !(PetscRealPart(a[ROW_AREA][r]) > 0.0)) continue;
    if (PetscSqr(PetscRealPart(s[0])) + PetscSqr(PetscRealPart(s[1])) > PetscSqr(rounding * size))
      a[ROW_SLIPPING][r] = a[ROW_CLOSED][r] * a[ROW_PRESSURE][r];
    for (PetscInt c = 0; c < 3; ++c) {
      a[ROW_SHEAR + c][r] = (f[0] * t[c] + f[1] * t[3 + c]) / mass[r];
      a[ROW_SLID + c][r]  = (s[0] * t[c] + s[1] * t[3 + c]) * mass[r] * a[ROW_COVERED][r] / a[ROW_AREA][r];
    }
  }
  PetscCall(VecRestoreArrayRead(at->solved->solution.shear, &shear));
  PetscCall(VecRestoreArrayRead(at->solved->solution.slip, &slip));
  PetscFunctionReturn(0);
}

/* Sets the values of the rows, except those of friction, from w n (`force`) and normal x |mass_A sum of cover_AB| */
static PetscErrorCode PairRowsSet(const ContactSolution *sol, const PetscScalar mass[], const PetscReal force[],
  PairRows *rows, PetscScalar *a[])
{
  const PetscScalar *z, *g;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  for (PetscInt r = 0; r < rows->n; ++r) {
    PetscReal *normal = &rows->normal[3 * r], size = VectorNorm(normal);

    if (!(size > 0.0)) continue;
    a[ROW_AREA][r]     = VectorNorm(&force[3 * r]);
    a[ROW_COVERED][r]  = a[ROW_AREA][r] / size;
    a[ROW_PRESSURE][r] = z[r];
    a[ROW_LENGTH][r] = a[ROW_OWN][r] = PetscSqrtReal(PetscRealPart(mass[r]));
    a[ROW_GAP][r]                    = g[r] * mass[r] / size;
    for (PetscInt c = 0; c < 3; ++c) normal[c] /= size;
    if (PetscRealPart(a[ROW_AREA][r]) > 0.0 &&
        PairIsClosed(PetscRealPart(z[r]), PetscRealPart(a[ROW_GAP][r]), rows->young, PetscRealPart(a[ROW_LENGTH][r])))
      a[ROW_CLOSED][r] = a[ROW_PRESSES][r] = 1.0;
  }
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscFunctionReturn(0);
}

PetscErrorCode PairRowsCreate(const Measured *at, PetscInt pair, PairRows *rows)
{
  const SceneContactPair *faces = &at->scene->pairs[pair];
  ContactLinearization    lin   = at->solved->linearization;
  const PetscScalar      *mass;
  PetscScalar           **a;
  PetscReal              *force;

  PetscFunctionBegin;
  *rows = (PairRows){.n = lin->nlocal,
    .self               = (PetscBool)(faces->self != NULL),
    .frictional         = (PetscBool)(lin->slip && SceneContactPairHasFriction(faces)),
    .young              = PetscMin(SceneFaceBody(at->scene, faces->mortar)->material.young,
                   SceneFaceBody(at->scene, faces->nonmortar)->material.young)};
  PetscCall(VecDuplicateVecs(lin->mass, ROW_VALUES, &rows->value));
  for (PetscInt k = 0; k < ROW_VALUES; ++k) PetscCall(VecSet(rows->value[k], k == ROW_ONE));
  PetscCall(PetscMalloc1(3 * rows->n, &rows->normal));
  PetscCall(PetscMalloc1(3 * rows->n, &force));
  PetscCall(PairRowsSum(at, pair, rows->self ? lin->mortar_cover : PairCover(lin), 3, rows->normal));
  PetscCall(PairRowsSum(at, pair, rows->self ? lin->mortar : lin->J, 0, force));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  PetscCall(VecGetArrays(rows->value, ROW_VALUES, &a));
  PetscCall(PairRowsSet(&at->solved->solution, mass, force, rows, a));
  if (rows->frictional) PetscCall(PairRowsSetFriction(at, pair, mass, rows, a));
  PetscCall(VecRestoreArrays(rows->value, ROW_VALUES, &a));
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(PetscFree(force));
  PetscCall(PairShareSides(at, faces, rows));
  PetscFunctionReturn(0);
}

PetscErrorCode PairRowsDestroy(PairRows *rows)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&rows->shares));
  PetscCall(MatDestroy(&rows->mortar));
  PetscCall(VecDestroy(&rows->sides));
  PetscCall(VecDestroy(&rows->gathered));
  PetscCall(VecDestroyVecs(ROW_VALUES, &rows->value));
  PetscCall(PetscFree(rows->normal));
  PetscFunctionReturn(0);
}
