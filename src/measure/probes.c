/* Measures displacement, stress and contact at the scene's probes: points, and points along lines */
#include "measureimpl.h"
#include <math.h>
#include "src/state/contact_state.h"
#include "src/state/results.h"

/*
   Contact at the vertices, three values each. values: pressure, gap, 1 if closed; paired: 1 if the vertex is in a pair,
   unused, unused.
*/
typedef struct {
  Vec values, paired;
} ProbeContact;

PetscErrorCode ProbesCreate(DM dm, Scene scene, Probes *probes)
{
  PetscFunctionBegin;
  if (!scene->nprobes) PetscFunctionReturn(0);
  PetscCall(MeshLocateProbes(dm, scene, &probes->n, &probes->points, &probes->places));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesDestroy(Probes *probes)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(probes->points));
  PetscCall(PetscFree(probes->places));
  probes->n = 0;
  PetscFunctionReturn(0);
}

/*
   Sets the values. A vertex in several pairs gets the mean pressure and the smallest gap, and is closed if it is closed
   in one of them.
*/
static PetscErrorCode ProbeContactFill(const Measured *at, PetscScalar values[], PetscScalar paired[])
{
  PetscSection global;
  PetscReal   *area;
  PetscInt     n, rstart;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(at->dm, &global));
  PetscCall(VecGetLocalSize(at->u, &n));
  PetscCall(VecGetOwnershipRange(at->u, &rstart, NULL));
  PetscCall(PetscCalloc1(n, &area));
  for (PetscInt k = 0; k < at->solved->npoints; ++k) {
    const ContactPoint *point = &at->solved->points[k];
    PetscInt            i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    i -= rstart;
    if (area[i] + point->area > 0.0)
      values[i] = (values[i] * area[i] + point->pressure * point->area) / (area[i] + point->area);
    area[i] += point->area;
    if (PetscRealPart(paired[i]) == 0.0 || PetscRealPart(values[i + 1]) > point->gap) values[i + 1] = point->gap;
    if (point->closed) values[i + 2] = 1.0;
    paired[i] = 1.0;
  }
  PetscCall(PetscFree(area));
  PetscFunctionReturn(0);
}

/* Creates local vectors, in which the values of all nodes of a cell can be read */
static PetscErrorCode ProbeContactCreate(const Measured *at, ProbeContact *contact)
{
  Vec          global[2];
  PetscScalar *a[2];

  PetscFunctionBegin;
  for (int i = 0; i < 2; ++i) {
    PetscCall(DMGetGlobalVector(at->dm, &global[i]));
    PetscCall(VecZeroEntries(global[i]));
    PetscCall(VecGetArray(global[i], &a[i]));
  }
  PetscCall(ProbeContactFill(at, a[0], a[1]));
  for (int i = 0; i < 2; ++i) {
    Vec *local = i ? &contact->paired : &contact->values;

    PetscCall(VecRestoreArray(global[i], &a[i]));
    PetscCall(DMGetLocalVector(at->dm, local));
    PetscCall(DMGlobalToLocal(at->dm, global[i], INSERT_VALUES, *local));
    PetscCall(DMRestoreGlobalVector(at->dm, &global[i]));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode ProbeContactDestroy(DM dm, ProbeContact *contact)
{
  PetscFunctionBegin;
  PetscCall(DMRestoreLocalVector(dm, &contact->values));
  PetscCall(DMRestoreLocalVector(dm, &contact->paired));
  PetscFunctionReturn(0);
}

/* Interpolates n values per node in a cell. The values of a node start at n x the node's number. */
static void ProbeInterpolate(const MeshPlace *place, const PetscInt node[], PetscInt n, const PetscScalar values[],
  PetscReal result[])
{
  for (PetscInt i = 0; i < n; ++i) {
    result[i] = 0.0;
    for (PetscInt a = 0; a < place->n; ++a) result[i] += place->N[a] * PetscRealPart(values[n * node[a] + i]);
  }
}

/*
   Reads contact values at a point. They exist on contact faces only: all nodes of the point's facet must be in a pair.
   Otherwise the report is unchanged.
*/
static PetscErrorCode ProbeReadContact(const ProbeContact *contact, const MeshPlace *place, const PetscInt node[],
  ProbeReport *report)
{
  const PetscScalar *values, *paired;
  PetscReal          v[3], on[3];

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(contact->values, &values));
  PetscCall(VecGetArrayRead(contact->paired, &paired));
  ProbeInterpolate(place, node, 3, values, v);
  ProbeInterpolate(place, node, 3, paired, on);
  PetscCall(VecRestoreArrayRead(contact->paired, &paired));
  PetscCall(VecRestoreArrayRead(contact->values, &values));
  if (on[0] < 1.0 - PETSC_SQRT_MACHINE_EPSILON) PetscFunctionReturn(0);
  report->contact_pressure = v[0];
  report->contact_gap      = v[1];
  report->contact_status   = v[2] > 0.5 ? 1.0 : 0.0;
  PetscFunctionReturn(0);
}

static PetscErrorCode ProbeRead(DM dm, Results *results, const PetscScalar u[], const ProbeContact *contact,
  const MeshPlace *place, ProbeReport *report)
{
  PetscSection section;
  PetscInt     n, points[MESH_MAX_NODES], node[MESH_MAX_NODES];
  PetscReal    stress[6], values[STRESS_VALUES];

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetCellNodes(dm, place->cell, &n, points));
  for (PetscInt a = 0; a < n; ++a) {
    PetscCall(PetscSectionGetOffset(section, points[a], &node[a]));
    node[a] /= 3;
  }
  ProbeInterpolate(place, node, 3, u, report->displacement);
  ProbeInterpolate(place, node, 6, results->recovered, stress);
  PetscCall(ResultsComplete(stress, values));
  PetscCall(PetscArraycpy(&report->stress_xx, values, STRESS_VALUES));
  if (contact) PetscCall(ProbeReadContact(contact, place, node, report));
  PetscFunctionReturn(0);
}

/* Sets positions and names from the scene. The rank that has the point sets the other values. */
static PetscErrorCode ProbesBegin(Model model, Results *results, ProbeReport reports[])
{
  PetscInt k = 0;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < model->scene->nprobes; ++p) {
    const SceneProbe *probe  = &model->scene->probes[p];
    PetscReal         length = 0.0;

    for (PetscInt d = 0; d < 3 && probe->line; ++d) length += PetscSqr(probe->to[d] - probe->from[d]);
    for (PetscInt i = 0; i < probe->n; ++i, ++k) {
      reports[k]                  = (ProbeReport){.name = probe->name};
      reports[k].arc              = PetscSqrtReal(length) * (PetscReal)i / (PetscReal)PetscMax(1, probe->n - 1);
      reports[k].contact_pressure = reports[k].contact_gap = reports[k].contact_status = NAN;
      PetscCall(PetscArraycpy(reports[k].place, results->probes.points[k], 3));
    }
  }
  PetscFunctionReturn(0);
}

/* Sends each point's values from the rank that has the point to all ranks */
static PetscErrorCode ProbesShare(MPI_Comm comm, Results *results, ProbeReport reports[])
{
  enum { values = (sizeof(ProbeReport) - offsetof(ProbeReport, displacement)) / sizeof(PetscReal) };
  PetscReal *all;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(values * results->probes.n, &all));
  for (PetscInt k = 0; k < results->probes.n; ++k) {
    if (results->probes.places[k].cell >= 0)
      PetscCall(PetscArraycpy(all + values * k, reports[k].displacement, values));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all, (PetscMPIInt)(values * results->probes.n), MPIU_REAL, MPIU_SUM, comm));
  for (PetscInt k = 0; k < results->probes.n; ++k)
    PetscCall(PetscArraycpy(reports[k].displacement, all + values * k, values));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}

/* Distributes the points to the report's lists of points and of points on lines */
static PetscErrorCode ProbesSort(Scene scene, const ProbeReport all[], StepReport *report)
{
  PetscInt k = 0;

  PetscFunctionBegin;
  PetscCall(PetscFree(report->probes));
  PetscCall(PetscFree(report->lines));
  report->nprobes = report->nlines = 0;
  for (PetscInt p = 0; p < scene->nprobes; ++p)
    *(scene->probes[p].line ? &report->nlines : &report->nprobes) += scene->probes[p].n;
  PetscCall(PetscMalloc1(report->nprobes, &report->probes));
  PetscCall(PetscMalloc1(report->nlines, &report->lines));
  report->nprobes = report->nlines = 0;
  for (PetscInt p = 0; p < scene->nprobes; ++p) {
    for (PetscInt i = 0; i < scene->probes[p].n; ++i, ++k) {
      if (scene->probes[p].line) report->lines[report->nlines++] = all[k];
      else report->probes[report->nprobes++] = all[k];
    }
  }
  PetscFunctionReturn(0);
}

/* Measures the probes at the last state, whose nodal stress and contact points must be known. Collective. */
PetscErrorCode ProbesMeasure(Model model, State state, Results *results, StepReport *report)
{
  const Measured     at = MeasuredAt(model, state, NULL);
  ProbeReport       *reports;
  ProbeContact       contact;
  Vec                local;
  const PetscScalar *u;

  PetscFunctionBegin;
  if (!results->probes.n) PetscFunctionReturn(0);
  PetscCall(PetscLogEventBegin(SIM_Results, NULL, NULL, NULL, NULL));
  PetscCall(PetscMalloc1(results->probes.n, &reports));
  PetscCall(ProbesBegin(model, results, reports));
  if (model->contact) PetscCall(ProbeContactCreate(&at, &contact));
  PetscCall(DMGetLocalVector(model->dm, &local));
  PetscCall(DMGlobalToLocal(model->dm, state->path->u, INSERT_VALUES, local));
  PetscCall(VecGetArrayRead(local, &u));
  for (PetscInt k = 0; k < results->probes.n; ++k) {
    if (results->probes.places[k].cell >= 0)
      PetscCall(
        ProbeRead(model->dm, results, u, model->contact ? &contact : NULL, &results->probes.places[k], &reports[k]));
  }
  PetscCall(VecRestoreArrayRead(local, &u));
  PetscCall(DMRestoreLocalVector(model->dm, &local));
  if (model->contact) PetscCall(ProbeContactDestroy(model->dm, &contact));
  PetscCall(ProbesShare(model->comm, results, reports));
  PetscCall(ProbesSort(model->scene, reports, report));
  PetscCall(PetscFree(reports));
  PetscCall(PetscLogEventEnd(SIM_Results, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
