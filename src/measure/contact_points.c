/* Computes pressure, gap and status at the vertices of both sides of every contact pair */
#include "pair_rows.h"
#include <math.h>
#include "src/elasticity/recovery/recoveryimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/path.h"

/*
   Values at the mesh's vertices that belong to the pair, three per vertex. carried: covered area, force, gap x area;
   sides: 1 on the mortar side or -1 on the nonmortar side, area with pressure, area after stretch; closing: closed
   area, facet length x area, force of slipping rows; force: components of the contact force.
*/
typedef struct {
  Vec carried, sides, closing, force;
  Vec shear, slid; /* friction force on the mortar side [force]; slip x area [length^3]; NULL without friction */
} PairVertices;

/* Computes the contact force J^T (mass x pressure) of the rows of the pair */
static PetscErrorCode PairPlaceForces(Simulation sim, const PairRows *rows, Vec force)
{
  const PetscScalar *mass;
  PetscScalar       *y;
  Vec                weighted;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->solved->linearization->mass, &weighted));
  PetscCall(VecGetArrayRead(sim->solved->linearization->mass, &mass));
  PetscCall(VecGetArrayWrite(weighted, &y));
  for (PetscInt r = 0; r < rows->n; ++r) y[r] = rows->area[r] > 0.0 ? mass[r] * sim->solved->pressure[r] : 0.0;
  PetscCall(VecRestoreArrayWrite(weighted, &y));
  PetscCall(VecRestoreArrayRead(sim->solved->linearization->mass, &mass));
  PetscCall(MatMultTranspose(sim->solved->linearization->J, weighted, force));
  PetscCall(VecDestroy(&weighted));
  PetscFunctionReturn(0);
}

/*
   Adds friction at the vertices: computes shear and slid, the force of slipping rows in closing[2], and adds the
   friction forces to `force`
*/
static PetscErrorCode PairVerticesAddFriction(Simulation sim, PetscInt pair, const PairRows *rows,
  PairVertices *vertices)
{
  PetscReal   *slipping;
  PetscScalar *f;
  Vec          force;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path->u, &vertices->shear));
  PetscCall(VecDuplicate(sim->path->u, &vertices->slid));
  PetscCall(VecZeroEntries(vertices->shear));
  PetscCall(VecZeroEntries(vertices->slid));
  PetscCall(PetscMalloc1(rows->n, &slipping));
  for (PetscInt r = 0; r < rows->n; ++r) slipping[r] = rows->slips[r] * rows->pressure[r];
  PetscCall(PairSpread(sim, rows, slipping, vertices->sides, 2, vertices->closing));
  PetscCall(PetscFree(slipping));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(PairSpread(sim, rows, rows->shear + c * rows->n, vertices->sides, c, vertices->shear));
    PetscCall(PairSpread(sim, rows, rows->slid + c * rows->n, vertices->sides, c, vertices->slid));
  }
  PetscCall(MatCreateVecs(sim->solved->linearization->slip, NULL, &force));
  PetscCall(VecGetArrayWrite(force, &f));
  for (PetscInt k = 0; k < 2 * rows->n; ++k) f[k] = sim->solved->shear[k];
  PetscCall(VecRestoreArrayWrite(force, &f));
  PetscCall(
    FrictionAddForces(sim->solved->linearization, sim->solved->linearization->slip, force, pair, vertices->force));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/* Computes the values of both sides of a pair before agglomeration (nodal_pressure.c). stretch: of each row, by
   ContactGetStretch(); NULL: 1 */
static PetscErrorCode PairVerticesCreate(Simulation sim, PetscInt pair, PairRows *rows, const PetscReal stretch[],
  PairVertices *vertices)
{
  PetscFunctionBegin;
  vertices->shear = vertices->slid = NULL;
  PetscCall(VecDuplicate(sim->path->u, &vertices->carried));
  PetscCall(VecDuplicate(sim->path->u, &vertices->sides));
  PetscCall(VecDuplicate(sim->path->u, &vertices->closing));
  PetscCall(VecDuplicate(sim->path->u, &vertices->force));
  PetscCall(VecZeroEntries(vertices->carried));
  PetscCall(VecZeroEntries(vertices->closing));
  PetscCall(PairMarkSides(sim, pair, rows, vertices->sides));
  PetscCall(PairRowsResolve(sim, pair, vertices->sides, rows));
  PetscCall(PairSpread(sim, rows, NULL, vertices->sides, 0, vertices->carried));
  PetscCall(PairSpread(sim, rows, rows->pressure, vertices->sides, 1, vertices->carried));
  PetscCall(PairSpread(sim, rows, rows->gap, vertices->sides, 2, vertices->carried));
  PetscCall(PairSpread(sim, rows, rows->presses, vertices->sides, 1, vertices->sides));
  if (stretch) PetscCall(PairSpread(sim, rows, stretch, vertices->sides, 2, vertices->sides));
  PetscCall(PairSpread(sim, rows, rows->closed, vertices->sides, 0, vertices->closing));
  PetscCall(PairSpread(sim, rows, rows->length, vertices->sides, 1, vertices->closing));
  PetscCall(PairPlaceForces(sim, rows, vertices->force));
  if (rows->frictional) PetscCall(PairVerticesAddFriction(sim, pair, rows, vertices));
  PetscFunctionReturn(0);
}

static PetscErrorCode PairVerticesDestroy(PairVertices *vertices)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&vertices->carried));
  PetscCall(VecDestroy(&vertices->sides));
  PetscCall(VecDestroy(&vertices->closing));
  PetscCall(VecDestroy(&vertices->force));
  PetscCall(VecDestroy(&vertices->shear));
  PetscCall(VecDestroy(&vertices->slid));
  PetscFunctionReturn(0);
}

/*
   Smooths one component of the friction stress like the pressure (nodal_pressure.c), so that both together satisfy the
   friction law. first: the pair's first point; alone: values before agglomeration.
*/
static PetscErrorCode PairShearPoints(Simulation sim, PetscInt pair, PetscInt first, const PairVertices *vertices,
  Vec alone, PetscInt component)
{
  PetscSection       global;
  const PetscScalar *shear, *a;
  PetscScalar       *carry;
  PetscInt           rstart, n;
  Vec                carried;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetLocalSize(alone, &n));
  PetscCall(VecDuplicate(alone, &carried));
  PetscCall(VecCopy(alone, carried));
  PetscCall(VecGetArrayRead(vertices->shear, &shear));
  PetscCall(VecGetArray(carried, &carry));
  for (PetscInt i = 0; i < n; i += 3) carry[i + 1] = shear[i + component];
  PetscCall(VecRestoreArray(carried, &carry));
  PetscCall(NodalPressureEvenOut(sim, &sim->scene->pairs[pair], carried));
  PetscCall(VecGetArrayRead(carried, &a));
  for (PetscInt k = first; k < sim->solved->npoints; ++k) {
    ContactPoint *point = &sim->solved->points[k];
    PetscInt      i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    i -= rstart;
    if (point->area > 0.0) point->shear[component] = PetscRealPart(a[i + 1] / a[i]);
  }
  PetscCall(VecRestoreArrayRead(carried, &a));
  PetscCall(VecRestoreArrayRead(vertices->shear, &shear));
  PetscCall(VecDestroy(&carried));
  PetscFunctionReturn(0);
}

/*
   Sets friction stress and slip of the pair's points, from number `first` on. The slip is the mean over the covered
   area before agglomeration, which is in `alone`.
*/
static PetscErrorCode PairAddFrictionPoints(Simulation sim, PetscInt pair, PetscInt first, const PairVertices *vertices,
  Vec alone)
{
  PetscSection          global;
  const ContactHistory *m = sim->history;
  const PetscScalar    *area, *side, *closing, *slid;
  PetscInt              rstart;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) PetscCall(PairShearPoints(sim, pair, first, vertices, alone, c));
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetArrayRead(alone, &area));
  PetscCall(VecGetArrayRead(vertices->sides, &side));
  PetscCall(VecGetArrayRead(vertices->closing, &closing));
  PetscCall(VecGetArrayRead(vertices->slid, &slid));
  for (PetscInt k = first; k < sim->solved->npoints; ++k) {
    ContactPoint *point = &sim->solved->points[k];
    PetscInt      i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    i -= rstart;
    for (PetscInt c = 0; c < 3; ++c) {
      point->shear[c] *= PetscRealPart(side[i]);
      point->slip[c] = -PetscRealPart(side[i] * slid[i + c] / area[i]);
    }
    point->slips     = (PetscBool)(point->closed && PetscRealPart(closing[i + 2]) > 0.5 * PetscRealPart(area[i + 1]));
    point->slip_path = m->slip_path[point->pair * m->nowned + i / 3];
  }
  PetscCall(VecRestoreArrayRead(vertices->slid, &slid));
  PetscCall(VecRestoreArrayRead(vertices->closing, &closing));
  PetscCall(VecRestoreArrayRead(vertices->sides, &side));
  PetscCall(VecRestoreArrayRead(alone, &area));
  PetscFunctionReturn(0);
}

/* Returns whether `part` is more than half of `whole`, beyond rounding */
static PetscBool PairIsMostly(PetscReal part, PetscReal whole)
{
  return (PetscBool)(2.0 * part > (1.0 + PETSC_SQRT_MACHINE_EPSILON) * whole);
}

/* Appends the pair's points. alone: values before agglomeration. */
static PetscErrorCode PairAppendPoints(Simulation sim, PetscInt pair, const PairRows *rows,
  const PairVertices *vertices, Vec alone)
{
  PetscSection       global;
  const PetscScalar *a, *b, *s, *side, *f;
  PetscInt           pstart, pend, rstart, n, npoints = 0;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(PetscSectionGetChart(global, &pstart, &pend));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetLocalSize(alone, &n));
  PetscCall(VecGetArrayRead(vertices->carried, &a));
  PetscCall(VecGetArrayRead(alone, &b));
  PetscCall(VecGetArrayRead(vertices->sides, &side));
  PetscCall(VecGetArrayRead(vertices->closing, &s));
  PetscCall(VecGetArrayRead(vertices->force, &f));
  for (PetscInt i = 0; i < n; i += 3) npoints += PetscRealPart(b[i]) > 0.0;
  PetscCall(PetscRealloc((sim->solved->npoints + npoints) * sizeof(ContactPoint), &sim->solved->points));
  for (PetscInt v = pstart; v < pend; ++v) {
    ContactPoint *point;
    PetscInt      i, ndofs;

    PetscCall(PetscSectionGetDof(global, v, &ndofs));
    PetscCall(PetscSectionGetOffset(global, v, &i));
    i -= rstart;
    if (ndofs <= 0 || i < 0 || !(PetscRealPart(b[i]) > 0.0)) continue;
    point = &sim->solved->points[sim->solved->npoints++];
    *point =
      (ContactPoint){.pair = pair, .vertex = v, .area = PetscRealPart(a[i]), .gap = PetscRealPart(b[i + 2] / b[i])};
    if (point->area > 0.0) {
      point->pressure = PetscRealPart(a[i + 1] / a[i]);
      point->gap      = PetscRealPart(a[i + 2] / a[i]);
    }
    for (PetscInt c = 0; c < 3; ++c) point->force[c] = PetscRealPart(f[i + c]);
    point->presses = PairIsMostly(PetscRealPart(side[i + 1]), PetscRealPart(b[i]));
    point->closed  = (PetscBool)(PairIsMostly(PetscRealPart(s[i]), PetscRealPart(b[i])) ||
                                PairIsClosed(point->pressure, point->gap, rows->young, PetscRealPart(s[i + 1] / b[i])));
  }
  PetscCall(VecRestoreArrayRead(vertices->force, &f));
  PetscCall(VecRestoreArrayRead(vertices->closing, &s));
  PetscCall(VecRestoreArrayRead(vertices->sides, &side));
  PetscCall(VecRestoreArrayRead(alone, &b));
  PetscCall(VecRestoreArrayRead(vertices->carried, &a));
  PetscFunctionReturn(0);
}

/*
   Multiplies the areas of the pair's points by the stretch of their faces since the linearization, and divides their
   stresses by it. first: the pair's first point; alone: values before agglomeration.
*/
static PetscErrorCode PairStretchPoints(Simulation sim, PetscInt first, const PairVertices *vertices, Vec alone)
{
  PetscSection       global;
  const PetscScalar *area, *side;
  PetscInt           rstart;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetArrayRead(alone, &area));
  PetscCall(VecGetArrayRead(vertices->sides, &side));
  for (PetscInt k = first; k < sim->solved->npoints; ++k) {
    ContactPoint *point = &sim->solved->points[k];
    PetscReal     stretch;
    PetscInt      i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    i -= rstart;
    stretch = PetscRealPart(side[i + 2] / area[i]);
    if (!(stretch > 0.0)) continue;
    point->area *= stretch;
    point->pressure /= stretch;
    for (PetscInt c = 0; c < 3; ++c) point->shear[c] /= stretch;
  }
  PetscCall(VecRestoreArrayRead(vertices->sides, &side));
  PetscCall(VecRestoreArrayRead(alone, &area));
  PetscFunctionReturn(0);
}

/* Finds the largest pressure of the pair's points and its place. first: the pair's first point. */
static PetscErrorCode PairReportPressure(Simulation sim, PetscInt first, PairReport *report)
{
  const PetscInt     n       = sim->solved->npoints - first;
  LargestValue       largest = {.place = {NAN, NAN, NAN}};
  LargestSample     *samples;
  PetscSection       section;
  Vec                coordinates;
  const PetscScalar *x;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(n, &samples));
  PetscCall(DMGetLocalSection(sim->dm, &section));
  PetscCall(MeshGetNodeCoordinates(sim->dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt k = 0; k < n; ++k) {
    const ContactPoint *point = &sim->solved->points[first + k];
    PetscInt            i;

    PetscCall(PetscSectionGetOffset(section, point->vertex, &i));
    samples[k] = (LargestSample){0, PetscMax(point->pressure, 0.0),
      {PetscRealPart(x[i]), PetscRealPart(x[i + 1]), PetscRealPart(x[i + 2])}};
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(LargestFind(sim->comm, n, samples, 1, &largest));
  PetscCall(PetscFree(samples));
  report->pressure = largest.value;
  for (PetscInt d = 0; d < 3; ++d) report->pressure_place[d] = largest.value > 0.0 ? largest.place[d] : NAN;
  PetscFunctionReturn(0);
}

/* Computes the areas of the nonmortar side's points and the normal force for the report. first: the pair's first
   point. */
static PetscErrorCode PairReportPoints(Simulation sim, const PairRows *rows, Vec sides, PetscInt first,
  PairReport *report)
{
  PetscReal          sums[4] = {0.0};
  const PetscReal    weight  = rows->self ? 0.5 : 1.0;
  PetscSection       global;
  const PetscScalar *side;
  PetscInt           rstart;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < rows->n; ++r) {
    sums[0] += rows->area[r] * rows->pressure[r];
    sums[3] += weight * rows->area[r] * rows->presses[r];
  }
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(sides, &rstart, NULL));
  PetscCall(VecGetArrayRead(sides, &side));
  for (PetscInt k = first; k < sim->solved->npoints; ++k) {
    const ContactPoint *point = &sim->solved->points[k];
    PetscInt            i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    if (!rows->self && PetscRealPart(side[i - rstart]) > 0.0) continue;
    if (point->closed) sums[1] += weight * point->area;
    if (point->slips) sums[2] += weight * point->area;
  }
  PetscCall(VecRestoreArrayRead(sides, &side));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPIU_SUM, sim->comm));
  if (sums[1] == 0.0) sums[1] = sums[3]; /* contact within the facets around one vertex closes none of them */
  report->normal_force = sums[0];
  report->area         = sums[1];
  report->slip_area    = sums[2];
  report->stick_area   = rows->frictional ? sums[1] - sums[2] : 0.0;
  PetscFunctionReturn(0);
}

/* Computes the contact points and reports of all pairs at the last state. Collective. */
PetscErrorCode ContactPointsMeasure(Simulation sim, StepReport *report)
{
  const ContactLinearization lin     = sim->solved->linearization;
  PetscReal                 *stretch = NULL;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  sim->solved->npoints = 0;
  if (lin && lin->area) {
    PetscCall(PetscMalloc1(lin->nlocal + 1, &stretch)); /* not NULL on ranks without rows */
    PetscCall(ContactGetStretch(sim->contact, sim->path->u, lin, stretch));
  }
  PetscCall(PetscFree(sim->solved->points));
  for (PetscInt p = 0; sim->solved->linearization && p < report->npairs; ++p) {
    const PetscInt first = sim->solved->npoints;
    PairRows       rows;
    PairVertices   vertices;
    Vec            alone;

    PetscCall(PairRowsCreate(sim, p, &rows));
    PetscCall(PairVerticesCreate(sim, p, &rows, stretch, &vertices));
    PetscCall(VecDuplicate(vertices.carried, &alone));
    PetscCall(VecCopy(vertices.carried, alone));
    PetscCall(NodalPressureEvenOut(sim, &sim->scene->pairs[p], vertices.carried));
    PetscCall(PairAppendPoints(sim, p, &rows, &vertices, alone));
    if (rows.frictional) PetscCall(PairAddFrictionPoints(sim, p, first, &vertices, alone));
    if (stretch) PetscCall(PairStretchPoints(sim, first, &vertices, alone));
    PetscCall(PairReportPoints(sim, &rows, vertices.sides, first, &report->pairs[p]));
    PetscCall(PairReportPressure(sim, first, &report->pairs[p]));
    PetscCall(PairMeshMeasure(sim, p, &rows, first, &report->pairs[p]));
    PetscCall(VecDestroy(&alone));
    PetscCall(PairVerticesDestroy(&vertices));
    PetscCall(PairRowsDestroy(&rows));
  }
  PetscCall(PetscFree(stretch));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
