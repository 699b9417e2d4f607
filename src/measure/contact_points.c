/* Computes pressure, gap and status at the nodes of both sides of every contact pair */
#include "pair_rows.h"
#include <math.h>
#include "src/elasticity/recovery/recoveryimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"

/* Sums over the rows at each node, weighted by the area that they share: those of the values of rows (pair_rows.h), and
   some of them before they are agglomerated and smoothed */
typedef enum {
  AT_ALONE = ROW_SUMS, /* ROW_ONE, ROW_GAP, ROW_PRESSURE */
  AT_GAP_ALONE,
  AT_FORCE_ALONE,
  AT_SUMS
} NodeSum;

/* Computes the sums at the nodes */
static PetscErrorCode PairSum(const Measured *at, PetscInt pair, const PairRows *rows, PairFacets *facets, Vec sums[])
{
  const PetscBool smooth[ROW_EVEN] = {PETSC_FALSE, PETSC_FALSE, PETSC_TRUE, PETSC_TRUE, PETSC_TRUE, PETSC_TRUE};
  const PetscInt  neven            = rows->frictional ? ROW_EVEN : ROW_SHEAR;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < ROW_SUMS; ++k) {
    const PetscBool friction = (PetscBool)((k >= ROW_SHEAR && k < ROW_EVEN) || k >= ROW_SLIPPING);

    if (rows->frictional || !friction) PetscCall(MatMultTranspose(rows->shares, rows->value[k], sums[k]));
    else PetscCall(VecZeroEntries(sums[k]));
  }
  for (PetscInt k = 0; k <= ROW_PRESSURE; ++k) PetscCall(VecCopy(sums[k], sums[AT_ALONE + k]));
  PetscCall(
    NodalPressureEvenOut(at->dm, at->elasticity, &at->places, &at->scene->pairs[pair], facets, neven, sums, smooth));
  PetscFunctionReturn(0);
}

/* Returns whether `part` is more than half of `whole`, beyond rounding */
static PetscBool PairIsMostly(PetscReal part, PetscReal whole)
{
  return (PetscBool)(2.0 * part > (1.0 + PETSC_SQRT_MACHINE_EPSILON) * whole);
}

/* Sets pressure, gap, friction and status of a point from the sums at its node. stretched: whether ROW_STRETCH is the
   stretch of the faces since the linearization, by which areas are multiplied and stresses are divided; side: 1 on the
   mortar side, else -1 */
static void PairSetPoint(const PairRows *rows, const PetscReal sum[AT_SUMS], PetscBool stretched, PetscReal side,
  ContactPoint *point)
{
  const PetscReal alone = sum[AT_ALONE];

  point->area = sum[ROW_ONE];
  point->gap  = sum[AT_GAP_ALONE] / alone;
  if (point->area > 0.0) {
    point->pressure = sum[ROW_PRESSURE] / point->area;
    point->gap      = sum[ROW_GAP] / point->area;
  }
  point->presses = PairIsMostly(sum[ROW_PRESSES], alone);
  point->closed  = (PetscBool)(PairIsMostly(sum[ROW_CLOSED], alone) ||
                              PairIsClosed(point->pressure, point->gap, rows->young, sum[ROW_LENGTH] / alone));
  for (PetscInt c = 0; c < 3 && rows->frictional; ++c) {
    if (point->area > 0.0) point->shear[c] = side * sum[ROW_SHEAR + c] / point->area;
    point->slip[c] = -side * sum[ROW_SLID + c] / alone;
  }
  if (rows->frictional) point->slips = (PetscBool)(point->closed && sum[ROW_SLIPPING] > 0.5 * sum[AT_FORCE_ALONE]);
  if (!stretched || !(sum[ROW_STRETCH] > 0.0)) return;
  point->area *= sum[ROW_STRETCH] / alone;
  point->pressure /= sum[ROW_STRETCH] / alone;
  for (PetscInt c = 0; c < 3; ++c) point->shear[c] /= sum[ROW_STRETCH] / alone;
}

/* Appends the pair's points. `closed` is set to 1 at the nodes of closed points, and to 0 elsewhere. areas: those of
   the nonmortar side's points that are closed, and that slip */
static PetscErrorCode PairAppendPoints(const Measured *at, PetscInt pair, const PairRows *rows, PetscBool stretched,
  Vec sums[AT_SUMS], Vec force, Vec closed, PetscReal areas[2])
{
  const PetscReal    weight = rows->self ? 0.5 : 1.0;
  PetscSection       global;
  const PetscScalar *side, *f;
  PetscScalar      **a, *mark;
  PetscInt           pstart, pend, first, n, npoints = 0;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(at->dm, &global));
  PetscCall(PetscSectionGetChart(global, &pstart, &pend));
  PetscCall(VecGetOwnershipRange(force, &first, NULL));
  PetscCall(VecGetLocalSize(closed, &n));
  PetscCall(VecGetArrays(sums, AT_SUMS, &a));
  PetscCall(VecGetArrayRead(rows->sides, &side));
  PetscCall(VecGetArrayRead(force, &f));
  PetscCall(VecZeroEntries(closed));
  PetscCall(VecGetArray(closed, &mark));
  for (PetscInt i = 0; i < n; ++i) npoints += PetscRealPart(a[AT_ALONE][i]) > 0.0;
  PetscCall(PetscRealloc((at->solved->npoints + npoints) * sizeof(ContactPoint), &at->solved->points));
  for (PetscInt v = pstart; v < pend; ++v) {
    ContactPoint *point;
    PetscReal     sum[AT_SUMS];
    PetscInt      i, ndofs;

    PetscCall(PetscSectionGetDof(global, v, &ndofs));
    PetscCall(PetscSectionGetOffset(global, v, &i));
    i = (i - first) / 3;
    if (ndofs <= 0 || i < 0 || !(PetscRealPart(a[AT_ALONE][i]) > 0.0)) continue;
    for (PetscInt k = 0; k < AT_SUMS; ++k) sum[k] = PetscRealPart(a[k][i]);
    point  = &at->solved->points[at->solved->npoints++];
    *point = (ContactPoint){.pair = pair, .vertex = v};
    PairSetPoint(rows, sum, stretched, PetscRealPart(side[i]), point);
    for (PetscInt c = 0; c < 3; ++c) point->force[c] = PetscRealPart(f[3 * i + c]);
    if (rows->frictional) point->slip_path = at->history->slip_path[pair * at->history->nowned + i];
    mark[i] = point->closed ? 1.0 : 0.0;
    if (!rows->self && PetscRealPart(side[i]) > 0.0) continue;
    if (point->closed) areas[0] += weight * point->area;
    if (point->slips) areas[1] += weight * point->area;
  }
  PetscCall(VecRestoreArray(closed, &mark));
  PetscCall(VecRestoreArrayRead(force, &f));
  PetscCall(VecRestoreArrayRead(rows->sides, &side));
  PetscCall(VecRestoreArrays(sums, AT_SUMS, &a));
  PetscFunctionReturn(0);
}

/* Finds the largest pressure of the pair's points and its place. first: the pair's first point. */
static PetscErrorCode PairReportPressure(const Measured *at, PetscInt first, PairReport *report)
{
  const PetscInt     n       = at->solved->npoints - first;
  LargestValue       largest = {.place = {NAN, NAN, NAN}};
  LargestSample     *samples;
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &samples));
  PetscCall(DMGetLocalSection(at->dm, &section));
  PetscCall(MeshGetNodeCoordinates(at->dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt k = 0; k < n; ++k) {
    const ContactPoint *point = &at->solved->points[first + k];
    PetscInt            i;

    PetscCall(PetscSectionGetOffset(section, point->vertex, &i));
    samples[k] = (LargestSample){0, PetscMax(point->pressure, 0.0),
      {PetscRealPart(x[i]), PetscRealPart(x[i + 1]), PetscRealPart(x[i + 2])}};
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(LargestFind(at->comm, n, samples, 1, &largest));
  PetscCall(PetscFree(samples));
  report->pressure = largest.value;
  for (PetscInt d = 0; d < 3; ++d) report->pressure_place[d] = largest.value > 0.0 ? largest.place[d] : NAN;
  PetscFunctionReturn(0);
}

/* Sets the normal force and the areas of the report. areas: by PairAppendPoints(), on this rank */
static PetscErrorCode PairReportForce(MPI_Comm comm, const PairRows *rows, const PetscReal areas[2], PairReport *report)
{
  PetscReal   sums[2] = {areas[0], areas[1]};
  PetscScalar force, presses;

  PetscFunctionBegin;
  PetscCall(VecDot(rows->value[ROW_PRESSURE], rows->value[ROW_AREA], &force));
  PetscCall(VecDot(rows->value[ROW_PRESSES], rows->value[ROW_AREA], &presses));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, comm));
  /* contact within the facets around one vertex closes none of them */
  if (sums[0] == 0.0) sums[0] = (rows->self ? 0.5 : 1.0) * PetscRealPart(presses);
  report->normal_force = PetscRealPart(force);
  report->area         = sums[0];
  report->slip_area    = sums[1];
  report->stick_area   = rows->frictional ? sums[0] - sums[1] : 0.0;
  PetscFunctionReturn(0);
}

/* Computes the contact points and the report of a pair. stretch: of each row, by ContactGetStretch(); NULL: 1.
   Collective. */
static PetscErrorCode PairMeasure(const Measured *at, PetscInt pair, const PetscReal stretch[], PairReport *report)
{
  const PetscInt             first    = at->solved->npoints;
  const ContactLinearization lin      = at->solved->linearization;
  PetscReal                  areas[2] = {0.0, 0.0};
  PetscScalar               *a;
  PairRows                   rows;
  PairFacets                 facets;
  Vec                       *sums, weighted, force, closed;

  PetscFunctionBegin;
  PetscCall(PairRowsCreate(at, pair, &rows));
  PetscCall(VecDuplicate(lin->mass, &weighted));
  PetscCall(VecPointwiseMult(weighted, rows.value[ROW_PRESSURE], lin->mass));
  PetscCall(VecDuplicate(at->u, &force));
  PetscCall(MatMultTranspose(lin->J, weighted, force));
  if (rows.frictional) PetscCall(RowsAddForces(lin, lin->slip, at->solved->solution.shear, pair, force));
  PetscCall(VecDestroy(&weighted));
  PetscCall(PairRowsResolve(at, pair, &rows));
  PetscCall(VecGetArray(rows.value[ROW_STRETCH], &a));
  for (PetscInt r = 0; r < rows.n && stretch; ++r) a[r] = stretch[r];
  PetscCall(VecRestoreArray(rows.value[ROW_STRETCH], &a));
  PetscCall(PairFacetsCreate(at->comm, at->dm, &at->places, &at->scene->pairs[pair], &facets));
  PetscCall(VecDuplicate(rows.sides, &closed));
  PetscCall(VecDuplicateVecs(rows.sides, AT_SUMS, &sums));
  PetscCall(PairSum(at, pair, &rows, &facets, sums));
  PetscCall(PairAppendPoints(at, pair, &rows, (PetscBool)(stretch != NULL), sums, force, closed, areas));
  PetscCall(PairReportForce(at->comm, &rows, areas, report));
  PetscCall(PairReportPressure(at, first, report));
  PetscCall(PairMeshMeasure(&rows, &facets, closed, report));
  PetscCall(VecDestroyVecs(AT_SUMS, &sums));
  PetscCall(VecDestroy(&closed));
  PetscCall(VecDestroy(&force));
  PetscCall(PairFacetsDestroy(&facets));
  PetscCall(PairRowsDestroy(&rows));
  PetscFunctionReturn(0);
}

/* Computes the contact points and reports of all pairs at the last state. Collective. */
PetscErrorCode ContactPointsMeasure(Model model, State state, StepReport *report)
{
  const Measured             at      = MeasuredAt(model, state, NULL);
  const ContactLinearization lin     = state->solved->linearization;
  PetscReal                 *stretch = NULL;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  state->solved->npoints = 0;
  PetscCall(PetscFree(state->solved->points));
  if (lin && lin->area) {
    PetscCall(PetscMalloc1(lin->nlocal + 1, &stretch)); /* not NULL on ranks without rows */
    PetscCall(ContactGetStretch(model->contact, state->path->u, lin, stretch));
  }
  for (PetscInt p = 0; lin && p < report->npairs; ++p) PetscCall(PairMeasure(&at, p, stretch, &report->pairs[p]));
  PetscCall(PetscFree(stretch));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
