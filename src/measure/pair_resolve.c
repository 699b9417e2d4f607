/*
   Smooths pressures that the mortar side cannot resolve. If the nonmortar side is finer and stiffer than the mortar
   facets, few rows carry all of the force. The rows between them have no pressure, and gaps that are small compared
   with the mortar facets' deformation. The mortar side only responds to means over its shape functions. Therefore the
   pressures of open rows that are surrounded by closed ones, and of the rows around them, are replaced: first the rows'
   values are averaged at the mortar nodes, weighted by the shared area, then these means are interpolated back to
   the rows. The sum of value x area over the rows is preserved.
*/
#include "pair_rows.h"
#include "src/state/contact_state.h"

static const PetscReal resolve_enclosed = 0.4; /* limit of the distance between the centres of closed rows and of all
                                                  rows, relative to their spread; the ratio is about 0.57 at a
                                                  straight border of contact, and about 0.2 between strips of contact */

/* Returns Young's modulus of the body behind the mortar face; PETSC_INFINITY if the body is rigid */
static PetscReal ResolveModulus(Scene scene, PetscInt pair)
{
  const Material *material = &SceneFaceBody(scene, scene->pairs[pair].mortar)->material;

  return material->type == MATERIAL_RIGID ? PETSC_INFINITY : material->young;
}

/* Computes the mean of the marked rows' values at the mortar nodes, interpolated back to the rows. Collective. */
static PetscErrorCode ResolveMean(const PairRows *rows, const PetscReal mark[], const PetscReal value[],
  PetscReal mean[])
{
  PetscReal         *marked;
  const PetscScalar *w;
  PetscScalar       *a;
  PetscInt           n;
  Vec                weight, v;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(rows->n, &marked));
  for (PetscInt r = 0; r < rows->n; ++r) marked[r] = mark[r] * value[r];
  PetscCall(VecDuplicate(rows->node, &weight));
  PetscCall(VecDuplicate(rows->node, &v));
  PetscCall(PairSpread(rows, mark, weight));
  PetscCall(PairSpread(rows, marked, v));
  PetscCall(VecGetLocalSize(v, &n));
  PetscCall(VecGetArrayRead(weight, &w));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = PetscRealPart(w[i]) > 0.0 ? a[i] / w[i] : 0.0;
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(VecRestoreArrayRead(weight, &w));
  PetscCall(PairGather(rows, v, mean));
  PetscCall(VecDestroy(&v));
  PetscCall(VecDestroy(&weight));
  PetscCall(PetscFree(marked));
  PetscFunctionReturn(0);
}

/* Finds whether a row is marked on any rank */
static PetscErrorCode ResolveAny(Simulation sim, PetscInt n, const PetscReal mark[], PetscBool *any)
{
  PetscFunctionBegin;
  *any = PETSC_FALSE;
  for (PetscInt r = 0; r < n; ++r) *any = (PetscBool)(*any || mark[r] > 0.0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPI_PETSCBOOL, MPI_LOR, sim->comm));
  PetscFunctionReturn(0);
}

/*
   Computes the undeformed coordinates of the rows' vertices relative to the mean of all, and the sum of their squares;
   n values per component [length; length^2]
*/
static PetscErrorCode ResolvePlaces(Simulation sim, const PairRows *rows, PetscReal place[])
{
  const PetscInt     n = rows->n;
  PetscSection       global;
  const PetscScalar *x;
  PetscInt           rstart;
  PetscReal          sum[4] = {0.0, 0.0, 0.0, 0.0};

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(sim->places.x, &rstart, NULL));
  PetscCall(VecGetArrayRead(sim->places.x, &x));
  for (PetscInt r = 0; r < n; ++r) {
    PetscInt i;

    PetscCall(PetscSectionGetOffset(global, sim->solved->linearization->vertex[r], &i));
    for (PetscInt c = 0; c < 3; ++c) {
      place[c * n + r] = PetscRealPart(x[i - rstart + c]);
      sum[c] += rows->area[r] * place[c * n + r];
    }
    sum[3] += rows->area[r];
  }
  PetscCall(VecRestoreArrayRead(sim->places.x, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPIU_REAL, MPIU_SUM, sim->comm));
  for (PetscInt r = 0; r < n; ++r) {
    place[3 * n + r] = 0.0;
    for (PetscInt c = 0; c < 3; ++c) {
      place[c * n + r] -= sum[c] / sum[3];
      place[3 * n + r] += PetscSqr(place[c * n + r]);
    }
  }
  PetscFunctionReturn(0);
}

/*
   Unmarks open rows that closed rows do not surround. A row remains marked if the centre of the closed rows within two
   mortar facets is close to the centre of all rows there, relative to their spread. This excludes open rows beside the
   contact area.
*/
static PetscErrorCode ResolveEnclosed(Simulation sim, const PairRows *rows, const PetscReal covered[], PetscReal open[])
{
  const PetscInt n = rows->n;
  PetscReal     *place, *all, *closed;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(4 * n, &place, 4 * n, &all, 3 * n, &closed));
  PetscCall(ResolvePlaces(sim, rows, place));
  for (PetscInt c = 0; c < 4; ++c) PetscCall(ResolveMean(rows, covered, place + c * n, all + c * n));
  for (PetscInt c = 0; c < 3; ++c) PetscCall(ResolveMean(rows, rows->closed, place + c * n, closed + c * n));
  for (PetscInt r = 0; r < n; ++r) {
    PetscReal spread = all[3 * n + r], off = 0.0;

    for (PetscInt c = 0; c < 3; ++c) {
      spread -= PetscSqr(all[c * n + r]);
      off += PetscSqr(closed[c * n + r] - all[c * n + r]);
    }
    if (off > PetscSqr(resolve_enclosed) * spread) open[r] = 0.0;
  }
  PetscCall(PetscFree3(place, all, closed));
  PetscFunctionReturn(0);
}

/*
   Marks the rows whose gap the mortar pressure would close by a small strain of the mortar facets, and which share a
   mortar node with an enclosed open row. mark: 1 for these rows; *any: whether any rank has such a row; length: size
   of the mortar facets.
*/
static PetscErrorCode ResolveMark(Simulation sim, PetscReal young, const PairRows *rows, const PetscReal length[],
  PetscReal mark[], PetscBool *any)
{
  PetscReal *covered, *pressure, *open;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(rows->n, &covered, rows->n, &pressure, rows->n, &open));
  for (PetscInt r = 0; r < rows->n; ++r) covered[r] = rows->area[r] > 0.0 ? 1.0 : 0.0;
  PetscCall(ResolveMean(rows, covered, rows->pressure, pressure));
  for (PetscInt r = 0; r < rows->n; ++r) {
    mark[r] = covered[r] > 0.0 && PairIsClosed(pressure[r], rows->gap[r], young, length[r]) ? 1.0 : 0.0;
    open[r] = mark[r] * (1.0 - rows->closed[r]);
  }
  PetscCall(ResolveAny(sim, rows->n, open, any));
  if (*any) {
    PetscCall(ResolveEnclosed(sim, rows, covered, open));
    PetscCall(ResolveAny(sim, rows->n, open, any));
  }
  if (*any) {
    PetscCall(ResolveMean(rows, covered, open, pressure));
    for (PetscInt r = 0; r < rows->n; ++r) mark[r] *= pressure[r] > PETSC_SQRT_MACHINE_EPSILON ? 1.0 : 0.0;
  }
  PetscCall(PetscFree3(covered, pressure, open));
  PetscFunctionReturn(0);
}

/* Replaces the values of marked rows by their means over mortar facets */
static PetscErrorCode ResolveValue(const PairRows *rows, const PetscReal mark[], PetscReal value[])
{
  PetscReal *mean;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(rows->n, &mean));
  PetscCall(ResolveMean(rows, mark, value, mean));
  for (PetscInt r = 0; r < rows->n; ++r) {
    if (mark[r] > 0.0) value[r] = mean[r];
  }
  PetscCall(PetscFree(mean));
  PetscFunctionReturn(0);
}

/*
   Replaces friction stress and slip of marked rows by their means over mortar facets. A row slips if slipping rows
   carry more than half of its pressure.
*/
static PetscErrorCode ResolveFriction(PairRows *rows, const PetscReal mark[], const PetscReal pressure[])
{
  PetscReal *slipping;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(ResolveValue(rows, mark, rows->shear + c * rows->n));
    PetscCall(ResolveValue(rows, mark, rows->slid + c * rows->n));
  }
  PetscCall(PetscMalloc1(rows->n, &slipping));
  for (PetscInt r = 0; r < rows->n; ++r) slipping[r] = rows->slips[r] * pressure[r];
  PetscCall(ResolveValue(rows, mark, slipping));
  for (PetscInt r = 0; r < rows->n; ++r) {
    if (mark[r] > 0.0) rows->slips[r] = slipping[r] > 0.5 * rows->pressure[r] ? 1.0 : 0.0;
  }
  PetscCall(PetscFree(slipping));
  PetscFunctionReturn(0);
}

/* Smooths the pressures of a pair that the mortar side cannot resolve. Collective. */
PetscErrorCode PairRowsResolve(Simulation sim, PetscInt pair, PairRows *rows)
{
  const PetscReal   young  = ResolveModulus(sim->scene, pair);
  const char *const mortar = sim->scene->pairs[pair].mortar;
  PetscReal        *length = rows->facing, *mark, *pressure;
  PetscBool         any;
  Vec               size;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->node, &size));
  PetscCall(PairFacetsMeasure(sim, 1, &mortar, size));
  PetscCall(VecSqrtAbs(size));
  PetscCall(PairGather(rows, size, length));
  PetscCall(VecDestroy(&size));
  if (young == PETSC_INFINITY) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(rows->n, &mark, rows->n, &pressure));
  PetscCall(ResolveMark(sim, young, rows, length, mark, &any));
  if (any) {
    PetscCall(PetscArraycpy(pressure, rows->pressure, rows->n));
    PetscCall(ResolveValue(rows, mark, rows->pressure));
    PetscCall(ResolveValue(rows, mark, rows->gap));
    for (PetscInt r = 0; r < rows->n; ++r) {
      if (mark[r] > 0.0) {
        rows->closed[r] = 1.0;
        rows->length[r] = length[r];
      }
    }
    if (rows->frictional) PetscCall(ResolveFriction(rows, mark, pressure));
  }
  PetscCall(PetscFree2(mark, pressure));
  PetscFunctionReturn(0);
}
