/*
   Transfers values of a contact pair's rows to the vertices of both sides, and values of the mortar vertices back to
   the rows
*/
#include "pair_rows.h"
#include "src/state/contact_state.h"

/* Sets one component of v at the vertices of a face to the number `to` */
PetscErrorCode PairMarkFace(DM dm, const char face[], PetscInt component, PetscInt to, Vec v)
{
  IS              is;
  const PetscInt *rows;
  PetscScalar    *a;
  PetscInt        n, rstart;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(dm, face, component, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &rows));
  PetscCall(VecGetOwnershipRange(v, &rstart, NULL));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt k = 0; k < n; ++k) a[rows[k] - rstart] = (PetscReal)to;
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(ISRestoreIndices(is, &rows));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Returns the matrix by which areas are distributed to vertices */
Mat PairCover(ContactLinearization lin)
{
  return lin->cover ? lin->cover : lin->J;
}

/* Does what PairSpread() does if bodies are sectors of cyclic symmetry. The vectors of a row at vertices near the
   other face of the cut are turned; therefore their lengths are used. */
static PetscErrorCode PairSpreadTurned(const PairRows *rows, const PetscReal value[], ContactLinearization lin,
  PetscInt to, Vec v)
{
  const PetscScalar *mass;
  PetscInt           rstart;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(PairCover(lin), &rstart, NULL));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt r = 0; r < rows->n; ++r) {
    const PetscReal    factor = PetscRealPart(mass[r]) * rows->covered[r] * (value ? value[r] : 1.0);
    const PetscInt    *column;
    const PetscScalar *entry;
    PetscInt           n;

    if (factor == 0.0) continue;
    PetscCall(MatGetRow(PairCover(lin), rstart + r, &n, &column, &entry));
    for (PetscInt i = 0; i < n;) {
      const PetscInt node   = column[i] / 3;
      PetscReal      square = 0.0;

      for (; i < n && column[i] / 3 == node; ++i) square += PetscSqr(PetscRealPart(entry[i]));
      PetscCall(VecSetValue(v, 3 * node + to, factor * PetscSqrtReal(square), ADD_VALUES));
    }
    PetscCall(MatRestoreRow(PairCover(lin), rstart + r, &n, &column, &entry));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscFunctionReturn(0);
}

/*
   Adds to v[to] at the vertices B: factor x sum_A mass_A A_AB . n_A covered_A value_A (value NULL: 1). sides: the
   factor is multiplied by its first value; NULL: 1
*/
static PetscErrorCode PairSpreadBy(Simulation sim, const PairRows *rows, Mat A, const PetscReal value[],
  PetscReal factor, Vec sides, PetscInt to, Vec v)
{
  ContactLinearization lin = sim->solved->linearization;
  const PetscScalar   *t, *side = NULL, *mass;
  PetscScalar         *y, *a;
  PetscInt             n;
  Vec                  weighted, spread;

  PetscFunctionBegin;
  if (lin->mortar_sum) {
    PetscCall(PairSpreadTurned(rows, value, lin, to, v));
    PetscFunctionReturn(0);
  }
  PetscCall(VecDuplicate(lin->mass, &weighted));
  PetscCall(VecDuplicate(v, &spread));
  PetscCall(VecGetLocalSize(v, &n));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecGetArrayRead(lin->mass, &mass));
    PetscCall(VecGetArrayWrite(weighted, &y));
    for (PetscInt r = 0; r < rows->n; ++r)
      y[r] = mass[r] * rows->normal[3 * r + c] * rows->covered[r] * (value ? value[r] : 1.0);
    PetscCall(VecRestoreArrayWrite(weighted, &y));
    PetscCall(VecRestoreArrayRead(lin->mass, &mass));
    PetscCall(MatMultTranspose(A, weighted, spread));
    PetscCall(VecGetArrayRead(spread, &t));
    if (sides) PetscCall(VecGetArrayRead(sides, &side));
    PetscCall(VecGetArray(v, &a));
    for (PetscInt i = 0; i < n; i += 3) {
      const PetscReal times = side ? factor * PetscRealPart(side[i]) : factor;

      if (times != 0.0) a[i + to] += times * t[i + c];
    }
    PetscCall(VecRestoreArray(v, &a));
    if (sides) PetscCall(VecRestoreArrayRead(sides, &side));
    PetscCall(VecRestoreArrayRead(spread, &t));
  }
  PetscCall(VecDestroy(&spread));
  PetscCall(VecDestroy(&weighted));
  PetscFunctionReturn(0);
}

/*
   Adds to v[to], at the vertices B of both sides, sum_A |mass_A cover_AB . n_A| covered_A value_A (value NULL: 1). This
   is the integral of the rows' field times B's shape function. Over a side these integrals sum to the sum of w_A
   value_A. If both sides are one face, `cover` holds the difference of the two sides' integrals. Their sum is then
   computed as twice the part of the mortar side minus `cover`.
*/
PetscErrorCode PairSpread(Simulation sim, const PairRows *rows, const PetscReal value[], Vec sides, PetscInt to, Vec v)
{
  ContactLinearization lin = sim->solved->linearization;

  PetscFunctionBegin;
  PetscCall(PairSpreadBy(sim, rows, PairCover(lin), value, rows->self ? -1.0 : 1.0, rows->self ? NULL : sides, to, v));
  if (rows->self) PetscCall(PairSpreadBy(sim, rows, lin->mortar_cover, value, 2.0, NULL, to, v));
  PetscFunctionReturn(0);
}

/* Marks each vertex of a face in contact with itself by the side to which most of its area belongs */
static PetscErrorCode PairMarkSelf(Simulation sim, const PairRows *rows, Vec sides)
{
  PetscScalar       *s;
  const PetscScalar *a;
  PetscInt           n;
  Vec                areas; /* two areas per vertex: that of both sides, and that of the mortar side */

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sides, &areas));
  PetscCall(VecZeroEntries(areas));
  PetscCall(PairSpread(sim, rows, NULL, NULL, 0, areas));
  PetscCall(PairSpreadBy(sim, rows, sim->solved->linearization->mortar_cover, NULL, 1.0, NULL, 1, areas));
  PetscCall(VecGetLocalSize(sides, &n));
  PetscCall(VecGetArrayRead(areas, &a));
  PetscCall(VecGetArray(sides, &s));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal both = PetscRealPart(a[i]), mortar = PetscRealPart(a[i + 1]);

    if (both > 0.0) s[i] = 2.0 * mortar >= both ? 1.0 : -1.0;
  }
  PetscCall(VecRestoreArray(sides, &s));
  PetscCall(VecRestoreArrayRead(areas, &a));
  PetscCall(VecDestroy(&areas));
  PetscFunctionReturn(0);
}

/*
   Collective. Marks the vertices of both sides. The vector `sides` has three values per vertex, of which the first is
   set: 1 on the mortar side, -1 on the nonmortar side.
*/
PetscErrorCode PairMarkSides(Simulation sim, PetscInt pair, const PairRows *rows, Vec sides)
{
  const SceneContactPair *faces = &sim->scene->pairs[pair];

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(sides));
  if (rows->self) {
    PetscCall(PairMarkSelf(sim, rows, sides));
    PetscFunctionReturn(0);
  }
  PetscCall(PairMarkFace(sim->dm, faces->mortar, 0, 1, sides));
  PetscCall(PairMarkFace(sim->dm, faces->nonmortar, 0, -1, sides));
  PetscFunctionReturn(0);
}

/* Sets component c of `along` to v[from] at the mortar vertices, and to 0 elsewhere. If the face is in contact with
   itself, all its vertices count as mortar vertices. */
static PetscErrorCode PairPlaceAlong(const PairRows *rows, PetscInt c, Vec sides, Vec v, PetscInt from, Vec along)
{
  const PetscScalar *side, *a;
  PetscScalar       *b;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(along));
  PetscCall(VecGetLocalSize(along, &n));
  PetscCall(VecGetArrayRead(sides, &side));
  PetscCall(VecGetArrayRead(v, &a));
  PetscCall(VecGetArray(along, &b));
  for (PetscInt i = 0; i < n; i += 3) {
    if (rows->self || PetscRealPart(side[i]) > 0.0) b[i + c] = a[i + from];
  }
  PetscCall(VecRestoreArray(along, &b));
  PetscCall(VecRestoreArrayRead(v, &a));
  PetscCall(VecRestoreArrayRead(sides, &side));
  PetscFunctionReturn(0);
}

/*
   Computes value_A = sum over the mortar vertices B of mass_A cover_AB . n_A covered_A v[from]_B / w_A, the mean of a
   mortar field over the row; 0 in rows of other pairs. Collective.
*/
PetscErrorCode PairGather(Simulation sim, const PairRows *rows, Vec sides, Vec v, PetscInt from, PetscReal value[])
{
  ContactLinearization lin = sim->solved->linearization;
  const PetscScalar   *s, *mass;
  Vec                  along, sum;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(value, rows->n));
  PetscCall(VecDuplicate(v, &along));
  PetscCall(VecDuplicate(lin->mass, &sum));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(PairPlaceAlong(rows, c, sides, v, from, along));
    PetscCall(MatMult(rows->self ? lin->mortar_cover : PairCover(lin), along, sum));
    PetscCall(VecGetArrayRead(sum, &s));
    for (PetscInt r = 0; r < rows->n; ++r) {
      if (rows->area[r] > 0.0)
        value[r] += PetscRealPart(mass[r] * s[r]) * rows->normal[3 * r + c] * rows->covered[r] / rows->area[r];
    }
    PetscCall(VecRestoreArrayRead(sum, &s));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&along));
  PetscFunctionReturn(0);
}
