/*
   Rows of one contact pair: area, normal, pressure, gap, friction and status. A row and a node B of either side share
   the area |mass_A cover_AB . n_A| covered_A. Values of rows are transferred to nodes, and back, in proportion to it.
*/
#include "pair_rows.h"
#include <vector3.h>
#include "src/state/contact_state.h"
#include "src/state/path.h"

/* Sets one of `stride` values of v at each node of a face to the number `to` */
static PetscErrorCode PairMarkFace(DM dm, const char face[], PetscInt stride, PetscInt component, PetscInt to, Vec v)
{
  IS              is;
  const PetscInt *dofs;
  PetscScalar    *a;
  PetscInt        n, first;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(dm, face, 0, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &dofs));
  PetscCall(VecGetOwnershipRange(v, &first, NULL));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt k = 0; k < n; ++k) a[stride * (dofs[k] / 3) + component - first] = (PetscReal)to;
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(ISRestoreIndices(is, &dofs));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Returns the matrix by which areas are distributed to nodes */
static Mat PairCover(ContactLinearization lin)
{
  return lin->cover ? lin->cover : lin->J;
}

/* Computes for each row A the vector mass_A x sum of A_AB over the nodes B of the mortar side. at: position of these
   sums in those of the linearization, if it has them */
static PetscErrorCode PairRowsSum(Simulation sim, PetscInt pair, Mat A, PetscInt at, PetscInt n, PetscReal vector[])
{
  ContactLinearization lin = sim->solved->linearization;
  Vec                  mark, sum;
  const PetscScalar   *s, *mass;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path->u, &mark));
  PetscCall(VecDuplicate(lin->mass, &sum));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecZeroEntries(mark));
    PetscCall(PairMarkFace(sim->dm, sim->scene->pairs[pair].mortar, 3, c, 1, mark));
    PetscCall(MatMult(A, mark, sum));
    PetscCall(VecGetArrayRead(sum, &s));
    for (PetscInt r = 0; r < n; ++r) {
      const PetscReal all = lin->mortar_sum ? lin->mortar_sum[6 * r + at + c] : PetscRealPart(s[r]);

      vector[3 * r + c] = lin->pair[r] == pair ? PetscRealPart(mass[r]) * all : 0.0;
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
  const PetscScalar *mass;
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
  entries = 0;
  for (PetscInt r = 0; r < nmatrices * rows->n; ++r) {
    const PetscInt     k = r / rows->n, own = r % rows->n;
    const PetscInt    *column;
    const PetscScalar *entry;
    PetscInt           n;

    if (rows->covered[own] == 0.0) continue;
    PetscCall(MatGetRow(A[k], first + own, &n, &column, &entry));
    for (PetscInt i = 0; i < n; ++entries) {
      PetscReal along = 0.0, square = 0.0;

      row[entries]  = first + own;
      node[entries] = column[i] / 3;
      for (; i < n && column[i] / 3 == node[entries]; ++i) {
        along += PetscRealPart(entry[i]) * rows->normal[3 * own + column[i] % 3];
        square += PetscSqr(PetscRealPart(entry[i]));
      }
      value[entries] = factor[k] * mass[own] * rows->covered[own] * (lin->mortar_sum ? PetscSqrtReal(square) : along);
    }
    PetscCall(MatRestoreRow(A[k], first + own, &n, &column, &entry));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecGetLocalSize(rows->node, &nodes));
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
  Vec                areas;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->sides, &areas));
  PetscCall(VecSet(rows->row, 1.0));
  PetscCall(MatMultTranspose(rows->shares, rows->row, areas));
  PetscCall(MatMultTranspose(rows->mortar, rows->row, rows->node));
  PetscCall(VecGetLocalSize(areas, &n));
  PetscCall(VecGetArrayRead(areas, &both));
  PetscCall(VecGetArrayRead(rows->node, &mortar));
  PetscCall(VecGetArray(rows->sides, &side));
  for (PetscInt i = 0; i < n; ++i) {
    if (PetscRealPart(both[i]) > 0.0) side[i] = 2.0 * PetscRealPart(mortar[i]) >= PetscRealPart(both[i]) ? 1.0 : -1.0;
  }
  PetscCall(VecRestoreArray(rows->sides, &side));
  PetscCall(VecRestoreArrayRead(rows->node, &mortar));
  PetscCall(VecRestoreArrayRead(areas, &both));
  PetscCall(VecDestroy(&areas));
  PetscFunctionReturn(0);
}

/*
   Marks the sides, and computes the shared areas. If both sides are one face, `cover` holds the difference of the two
   sides' integrals. Their sum is then computed as twice the part of the mortar side minus `cover`.
*/
static PetscErrorCode PairShareSides(Simulation sim, const SceneContactPair *faces, PairRows *rows)
{
  ContactLinearization lin       = sim->solved->linearization;
  const Mat            A[2]      = {PairCover(lin), lin->mortar_cover};
  const PetscReal      factor[2] = {rows->self ? -1.0 : 1.0, 2.0}, one = 1.0;
  PetscInt             n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(sim->path->u, &n));
  PetscCall(VecCreateMPI(sim->comm, n / 3, PETSC_DETERMINE, &rows->sides));
  PetscCall(VecDuplicate(rows->sides, &rows->node));
  PetscCall(VecDuplicate(lin->mass, &rows->row));
  PetscCall(VecZeroEntries(rows->sides));
  PetscCall(PairShare(lin, rows, rows->self ? 2 : 1, A, factor, &rows->shares));
  if (rows->self) {
    PetscCall(PairShare(lin, rows, 1, &A[1], &one, &rows->mortar));
    PetscCall(PairMarkSelf(rows));
    PetscFunctionReturn(0);
  }
  PetscCall(PairMarkFace(sim->dm, faces->mortar, 1, 0, 1, rows->sides));
  PetscCall(PairMarkFace(sim->dm, faces->nonmortar, 1, 0, -1, rows->sides));
  /* entries of the nonmortar side have the opposite sign */
  if (!lin->mortar_sum) PetscCall(MatDiagonalScale(rows->shares, NULL, rows->sides));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes at the nodes B of both sides the sum over the rows A of the area that they share times value_A.
   This is the integral of the rows' field times B's shape function. Over a side these integrals sum to the sum of w_A
   value_A.
*/
PetscErrorCode PairSpread(const PairRows *rows, const PetscReal value[], Vec node)
{
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(VecGetArrayWrite(rows->row, &a));
  for (PetscInt r = 0; r < rows->n; ++r) a[r] = value ? value[r] : 1.0;
  PetscCall(VecRestoreArrayWrite(rows->row, &a));
  PetscCall(MatMultTranspose(rows->shares, rows->row, node));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes the means of a field of the mortar side over the rows: the sum over the mortar nodes of the area
   that they share with the row, times their value, over w_A; 0 in rows of other pairs. If the face is in contact with
   itself, all its nodes count as mortar nodes.
*/
PetscErrorCode PairGather(const PairRows *rows, Vec node, PetscReal value[])
{
  const PetscScalar *side, *s;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecCopy(node, rows->node));
  PetscCall(VecGetLocalSize(node, &n));
  PetscCall(VecGetArrayRead(rows->sides, &side));
  PetscCall(VecGetArray(rows->node, &a));
  for (PetscInt i = 0; i < n; ++i) {
    if (!rows->self && !(PetscRealPart(side[i]) > 0.0)) a[i] = 0.0;
  }
  PetscCall(VecRestoreArray(rows->node, &a));
  PetscCall(VecRestoreArrayRead(rows->sides, &side));
  PetscCall(MatMult(rows->self ? rows->mortar : rows->shares, rows->node, rows->row));
  PetscCall(VecGetArrayRead(rows->row, &s));
  for (PetscInt r = 0; r < rows->n; ++r) value[r] = rows->area[r] > 0.0 ? PetscRealPart(s[r]) / rows->area[r] : 0.0;
  PetscCall(VecRestoreArrayRead(rows->row, &s));
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
static PetscErrorCode PairRowsSetFriction(Simulation sim, PetscInt pair, const PetscScalar mass[], PairRows *rows)
{
  const PetscReal      rounding = 1e-9;
  ContactLinearization lin      = sim->solved->linearization;
  PetscReal            size;

  PetscFunctionBegin;
  PetscCall(VecNorm(sim->path->u, NORM_INFINITY, &size));
  PetscCall(PetscCalloc3(rows->n, &rows->slips, 3 * rows->n, &rows->shear, 3 * rows->n, &rows->slid));
  for (PetscInt r = 0; r < rows->n; ++r) {
    const PetscReal *s = &sim->solved->slip[2 * r], *f = &sim->solved->shear[2 * r], *t = &lin->tangent[6 * r];

    if (lin->pair[r] != pair || !(rows->area[r] > 0.0)) continue;
    rows->slips[r] = rows->closed[r] > 0.0 && PetscSqr(s[0]) + PetscSqr(s[1]) > PetscSqr(rounding * size) ? 1.0 : 0.0;
    for (PetscInt c = 0; c < 3; ++c) {
      rows->shear[c * rows->n + r] = (f[0] * t[c] + f[1] * t[3 + c]) / PetscRealPart(mass[r]);
      rows->slid[c * rows->n + r] =
        (s[0] * t[c] + s[1] * t[3 + c]) * PetscRealPart(mass[r]) * rows->covered[r] / rows->area[r];
    }
  }
  PetscFunctionReturn(0);
}

PetscErrorCode PairRowsCreate(Simulation sim, PetscInt pair, PairRows *rows)
{
  const SceneContactPair *faces = &sim->scene->pairs[pair];
  ContactLinearization    lin   = sim->solved->linearization;
  const PetscInt          n     = lin->nlocal;
  const PetscScalar      *mass;
  PetscReal              *force;

  PetscFunctionBegin;
  *rows       = (PairRows){.n = n,
          .self               = (PetscBool)(faces->self != NULL),
          .frictional         = (PetscBool)(sim->solved->linearization->slip && SceneContactPairHasFriction(faces))};
  rows->young = PetscMin(SceneFaceBody(sim->scene, faces->mortar)->material.young,
    SceneFaceBody(sim->scene, faces->nonmortar)->material.young);
  PetscCall(PetscCalloc7(n, &rows->area, n, &rows->covered, 3 * n, &rows->normal, n, &rows->pressure, n, &rows->gap, n,
    &rows->closed, n, &rows->length));
  PetscCall(PetscCalloc3(n, &rows->own, n, &rows->facing, n, &rows->presses));
  PetscCall(PetscMalloc1(3 * n, &force));
  PetscCall(PairRowsSum(sim, pair, rows->self ? lin->mortar_cover : PairCover(lin), 3, n, rows->normal));
  PetscCall(PairRowsSum(sim, pair, rows->self ? lin->mortar : lin->J, 0, n, force));
  PetscCall(VecGetArrayRead(sim->solved->linearization->mass, &mass));
  for (PetscInt r = 0; r < n; ++r) {
    PetscReal *normal = &rows->normal[3 * r], size = VectorNorm(normal);

    if (!(size > 0.0)) continue;
    rows->area[r]     = VectorNorm(&force[3 * r]);
    rows->covered[r]  = rows->area[r] / size;
    rows->pressure[r] = sim->solved->pressure[r];
    rows->length[r] = rows->own[r] = PetscSqrtReal(PetscRealPart(mass[r]));
    rows->gap[r]                   = sim->solved->gap[r] * PetscRealPart(mass[r]) / size;
    for (PetscInt c = 0; c < 3; ++c) normal[c] /= size;
    if (rows->area[r] > 0.0 && PairIsClosed(rows->pressure[r], rows->gap[r], rows->young, rows->length[r]))
      rows->closed[r] = rows->presses[r] = 1.0;
  }
  PetscCall(PetscFree(force));
  PetscCall(PairShareSides(sim, faces, rows));
  if (rows->frictional) PetscCall(PairRowsSetFriction(sim, pair, mass, rows));
  PetscCall(VecRestoreArrayRead(sim->solved->linearization->mass, &mass));
  PetscFunctionReturn(0);
}

PetscErrorCode PairRowsDestroy(PairRows *rows)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&rows->shares));
  PetscCall(MatDestroy(&rows->mortar));
  PetscCall(VecDestroy(&rows->sides));
  PetscCall(VecDestroy(&rows->row));
  PetscCall(VecDestroy(&rows->node));
  if (rows->frictional) PetscCall(PetscFree3(rows->slips, rows->shear, rows->slid));
  PetscCall(PetscFree3(rows->own, rows->facing, rows->presses));
  PetscCall(PetscFree7(rows->area, rows->covered, rows->normal, rows->pressure, rows->gap, rows->closed, rows->length));
  PetscFunctionReturn(0);
}
