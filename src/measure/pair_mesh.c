/* Warns of contact meshes that are too coarse */
#include "pair_rows.h"
#include "src/state/contact_state.h"
#include "src/state/path.h"

#define PAIR_COARSE \
  2.0 /* ratio of the size of nonmortar facets to that of mortar facets above which a warning is
                           printed */
#define PAIR_SWING \
  0.1 /* change of the force between load steps, relative to the largest force, that counts as a
                           reversal */

/* Computes the means over the contact area of the nonmortar facet size, and of its ratio to the mortar facet size.
   Collective. */
static PetscErrorCode PairMeasureFacets(MPI_Comm comm, const PairRows *rows, PetscReal *facet, PetscReal *coarseness)
{
  PetscReal sums[4] = {0.0, 0.0, 0.0, 0.0};

  PetscFunctionBegin;
  for (PetscInt r = 0; r < rows->n; ++r) {
    if (!(rows->closed[r] > 0.0)) continue;
    sums[0] += rows->area[r];
    sums[1] += rows->area[r] * rows->own[r];
    if (!(rows->facing[r] > 0.0)) continue;
    sums[2] += rows->area[r];
    sums[3] += rows->area[r] * rows->own[r] / rows->facing[r];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPIU_SUM, comm));
  *facet      = sums[0] > 0.0 ? sums[1] / sums[0] : 0.0;
  *coarseness = sums[2] > 0.0 ? sums[3] / sums[2] : 0.0;
  PetscFunctionReturn(0);
}

/*
   Counts facets around the vertices of a face. Values of each vertex: 1 if the pair is closed there; number of facets
   around it; number of these that are closed at all corners.
*/
static PetscErrorCode PairCountFacets(Simulation sim, const char face[], const PetscScalar closed[],
  PetscScalar count[])
{
  PetscSection    section;
  IS              is;
  const PetscInt *facets;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(sim->dm, &section));
  PetscCall(MeshGetFacets(sim->dm, face, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &facets));
  for (PetscInt f = 0; f < n; ++f) {
    PetscInt npieces, pieces[MESH_MAX_FACET_PIECES][4];

    PetscCall(MeshGetFacetPieces(sim->dm, facets[f], &npieces, pieces));
    for (PetscInt k = 0; k < npieces; ++k) {
      PetscInt  at[4];
      PetscBool all = PETSC_TRUE;

      for (PetscInt a = 0; a < 4; ++a) {
        PetscCall(PetscSectionGetOffset(section, pieces[k][a], &at[a]));
        all = (PetscBool)(all && PetscRealPart(closed[at[a]]) > 0.0);
      }
      for (PetscInt a = 0; a < 4; ++a) {
        count[at[a] + 1] += 1.0;
        if (all) count[at[a] + 2] += 1.0;
      }
    }
  }
  PetscCall(ISRestoreIndices(is, &facets));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/*
   Finds whether the contact is narrow: no closed vertex of the nonmortar face is completely surrounded by closed ones.
   first: the pair's first point. Collective.
*/
static PetscErrorCode PairMeasureNarrowness(Simulation sim, PetscInt pair, PetscInt first, PetscBool *narrow)
{
  PetscSection       global;
  Vec                closed, count, local[2];
  const PetscScalar *a;
  PetscScalar       *c;
  PetscInt           rstart, n;
  PetscBool          wide = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecDuplicate(sim->path->u, &closed));
  PetscCall(VecDuplicate(sim->path->u, &count));
  PetscCall(VecZeroEntries(closed));
  PetscCall(VecZeroEntries(count));
  PetscCall(VecGetOwnershipRange(closed, &rstart, &n));
  n -= rstart;
  PetscCall(VecGetArray(closed, &c));
  for (PetscInt k = first; k < sim->solved->npoints; ++k) {
    PetscInt i;

    PetscCall(PetscSectionGetOffset(global, sim->solved->points[k].vertex, &i));
    c[i - rstart] = sim->solved->points[k].closed ? 1.0 : 0.0;
  }
  PetscCall(VecRestoreArray(closed, &c));
  for (PetscInt i = 0; i < 2; ++i) PetscCall(DMGetLocalVector(sim->dm, &local[i]));
  PetscCall(DMGlobalToLocal(sim->dm, closed, INSERT_VALUES, local[0]));
  PetscCall(VecZeroEntries(local[1]));
  PetscCall(VecGetArrayRead(local[0], &a));
  PetscCall(VecGetArray(local[1], &c));
  PetscCall(PairCountFacets(sim, sim->scene->pairs[pair].nonmortar, a, c));
  PetscCall(VecRestoreArray(local[1], &c));
  PetscCall(VecRestoreArrayRead(local[0], &a));
  PetscCall(DMLocalToGlobal(sim->dm, local[1], ADD_VALUES, count));
  for (PetscInt i = 0; i < 2; ++i) PetscCall(DMRestoreLocalVector(sim->dm, &local[i]));
  PetscCall(VecGetArrayRead(count, &a));
  for (PetscInt i = 0; i < n; i += 3)
    wide = (PetscBool)(wide || (PetscRealPart(a[i + 2]) > 0.0 && PetscRealPart(a[i + 1] - a[i + 2]) < 0.5));
  PetscCall(VecRestoreArrayRead(count, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &wide, 1, MPI_PETSCBOOL, MPI_LOR, sim->comm));
  *narrow = (PetscBool)!wide;
  PetscCall(VecDestroy(&closed));
  PetscCall(VecDestroy(&count));
  PetscFunctionReturn(0);
}

/* Sets facet size, coarseness and narrowness in the pair's report. Collective. */
PetscErrorCode PairMeshMeasure(Simulation sim, PetscInt pair, const PairRows *rows, PetscInt first, PairReport *report)
{
  PetscFunctionBegin;
  PetscCall(PairMeasureFacets(sim->comm, rows, &report->facet, &report->coarseness));
  PetscCall(PairMeasureNarrowness(sim, pair, first, &report->narrow));
  PetscFunctionReturn(0);
}

/* Returns whether a load history reverses, which explains reversals of contact forces */
static PetscBool PairLoadTurns(const RunReport *run)
{
  for (PetscInt s = 1; s + 1 < run->nsteps; ++s) {
    const StepReport *step = &run->steps[s];

    for (PetscInt r = 0; r < step->nramps; ++r) {
      const PetscReal now = step->ramps[r].factor;

      if ((now - step[-1].ramps[r].factor) * (step[1].ramps[r].factor - now) < 0.0) return PETSC_TRUE;
    }
  }
  return PETSC_FALSE;
}

/*
   Counts how often the force reverses by more than a tenth of its size while the contact is narrow. forces: the last
   two extreme values; rounding: rounding error of forces.
*/
static PetscInt PairCountTurns(const RunReport *run, PetscInt p, PetscReal rounding, PetscReal forces[2])
{
  PetscInt  turns = 0, sense = 0;
  PetscReal largest = rounding / PAIR_SWING;

  for (PetscInt s = 0; s < run->nsteps; ++s) {
    const PairReport *pair = p < run->steps[s].npairs ? &run->steps[s].pairs[p] : NULL;
    const PetscReal   more = pair ? pair->normal_force - forces[1] : 0.0;

    if (!pair || !pair->narrow) { /* the count begins anew */
      sense = 0;
      if (pair) forces[1] = pair->normal_force;
      continue;
    }
    largest = PetscMax(largest, pair->normal_force);
    if (PetscAbsReal(more) <= PAIR_SWING * largest) continue;
    if (sense * more < 0.0) {
      ++turns;
      forces[0] = forces[1];
    }
    sense     = more > 0.0 ? 1 : -1;
    forces[1] = pair->normal_force;
  }
  return turns;
}

static PetscErrorCode PairWarnOfRotation(Simulation sim, PetscInt p)
{
  const SceneContactPair *pair      = &sim->scene->pairs[p];
  PetscReal               forces[2] = {0.0, 0.0}, motion = 0.0;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < sim->report.nsteps; ++k) motion = PetscMax(motion, sim->report.steps[k].motion);
  if (SceneIsDynamic(sim->scene) || PairLoadTurns(&sim->report) ||
      PairCountTurns(&sim->report, p, MEASURE_ROUNDING * sim->stiffness * motion, forces) < 2)
    PetscFunctionReturn(0);
  PetscCall(ReportWarn(sim->comm, &sim->report, pair->place,
    "contact pair \"%s\": the contact is only one facet of %s wide, and its force oscillates as it moves over the "
    "facets, for example from %.3g to %.3g: refine that face to about seven facets across the contact, or make the "
    "face that moves with the contact the nonmortar one",
    pair->name, pair->nonmortar, (double)forces[0], (double)forces[1]));
  PetscFunctionReturn(0);
}

/* Warns of a nonmortar side that is coarser than the mortar side, unless it is also the softer one */
static PetscErrorCode PairWarnOfCoarseness(Simulation sim, PetscInt p)
{
  const SceneContactPair *pair      = &sim->scene->pairs[p];
  const Material         *nonmortar = &SceneFaceBody(sim->scene, pair->nonmortar)->material,
                 *mortar            = &SceneFaceBody(sim->scene, pair->mortar)->material;
  const PetscBool softer            = (PetscBool)(nonmortar->type != MATERIAL_RIGID &&
                                       (mortar->type == MATERIAL_RIGID || nonmortar->young < mortar->young));
  PetscReal       coarseness        = 0.0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < sim->report.nsteps; ++s) {
    if (p < sim->report.steps[s].npairs) coarseness = PetscMax(coarseness, sim->report.steps[s].pairs[p].coarseness);
  }
  if (!softer && !pair->self && coarseness > PAIR_COARSE)
    PetscCall(ReportWarn(sim->comm, &sim->report, pair->place,
      "contact pair \"%s\": facets of the nonmortar face %s are %.2g times as large as those of the mortar face %s, "
      "whose vertices can penetrate between its constraints: swap the two faces, or refine %s",
      pair->name, pair->nonmortar, (double)coarseness, pair->mortar, pair->nonmortar));
  PetscFunctionReturn(0);
}

/*
   Warns of facets that are too large for the radius of a rigid surface: about seven facets across the contact are
   needed, and its width is less than two radii. The contact must be one facet wide when it carries its largest force.
*/
static PetscErrorCode PairWarnOfRadius(Simulation sim, PetscInt p)
{
  const PetscReal         share   = 1.0 / 3.0;
  const SceneContactPair *pair    = &sim->scene->pairs[p];
  const SceneBody        *surface = SceneFaceBody(sim->scene, pair->mortar);
  const PetscReal         radius  = SceneSurfaceRadius(surface);
  const PairReport       *largest = NULL;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < sim->report.nsteps; ++s) {
    const StepReport *step = &sim->report.steps[s];

    if (p >= step->npairs || step->pairs[p].normal_force <= step->force_rounding) continue;
    if (!largest || step->pairs[p].normal_force > largest->normal_force) largest = &step->pairs[p];
  }
  if (!largest || !largest->narrow || !(largest->facet > share * radius)) PetscFunctionReturn(0);
  PetscCall(ReportWarn(sim->comm, &sim->report, pair->place,
    "contact pair \"%s\": facets of %s are %.3g large, and the radius of the rigid surface \"%s\" is %.3g: the force "
    "depends on where the vertices are; refine %s to about seven facets across the contact",
    pair->name, pair->nonmortar, (double)largest->facet, surface->name, (double)radius, pair->nonmortar));
  PetscFunctionReturn(0);
}

/* Warns of coarse contact meshes after the last load step */
PetscErrorCode PairMeshWarn(Simulation sim)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < sim->scene->npairs; ++p) {
    PetscCall(PairWarnOfCoarseness(sim, p));
    PetscCall(PairWarnOfRotation(sim, p));
    PetscCall(PairWarnOfRadius(sim, p));
  }
  PetscFunctionReturn(0);
}
