/* Warns of contact meshes that are too coarse */
#include "pair_rows.h"
#include "src/state/contact_state.h"

#define PAIR_COARSE \
  2.0 /* ratio of the size of nonmortar facets to that of mortar facets above which a warning is
                           printed */
#define PAIR_SWING \
  0.1 /* change of the force between load steps, relative to the largest force, that counts as a
                           reversal */

/* Computes the means over the contact area of the nonmortar facet size, and of its ratio to the mortar facet size.
   Collective. */
static PetscErrorCode PairMeasureFacets(const PairRows *rows, PetscReal *facet, PetscReal *coarseness)
{
  PetscScalar closed, facing, own, ratio;
  Vec         area, quotient;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->value[ROW_AREA], &area));
  PetscCall(VecDuplicate(rows->value[ROW_AREA], &quotient));
  PetscCall(VecPointwiseMult(area, rows->value[ROW_AREA], rows->value[ROW_CLOSED]));
  PetscCall(VecSum(area, &closed));
  PetscCall(VecDot(area, rows->value[ROW_OWN], &own));
  PetscCall(VecQuotient_AMGF(quotient, rows->value[ROW_FACING], rows->value[ROW_FACING])); /* a quotient by 0 is 0 */
  PetscCall(VecDot(area, quotient, &facing));
  PetscCall(VecQuotient_AMGF(quotient, rows->value[ROW_OWN], rows->value[ROW_FACING]));
  PetscCall(VecDot(area, quotient, &ratio));
  *facet      = PetscRealPart(closed) > 0.0 ? PetscRealPart(own / closed) : 0.0;
  *coarseness = PetscRealPart(facing) > 0.0 ? PetscRealPart(ratio / facing) : 0.0;
  PetscCall(VecDestroy(&quotient));
  PetscCall(VecDestroy(&area));
  PetscFunctionReturn(0);
}

/*
   Finds whether the contact is narrow: no closed vertex of the nonmortar face is completely surrounded by closed ones.
   Collective.
*/
static PetscErrorCode PairMeasureNarrowness(PairFacets *facets, Vec closed, PetscBool *narrow)
{
  const PetscScalar *a, *c;
  PetscInt           n;
  PetscBool          wide = PETSC_FALSE;
  Vec                all, count;

  PetscFunctionBegin;
  PetscCall(PairFacetsJoin(facets, facets->nnonmortar));
  PetscCall(VecDuplicate(closed, &all));
  PetscCall(VecDuplicate(closed, &count));
  PetscCall(MatGetRowSum(facets->between, all));
  PetscCall(MatMult(facets->between, closed, count));
  PetscCall(VecGetLocalSize(closed, &n));
  PetscCall(VecGetArrayRead(all, &a));
  PetscCall(VecGetArrayRead(count, &c));
  for (PetscInt i = 0; i < n; ++i)
    wide = (PetscBool)(wide || (PetscRealPart(c[i]) > 0.0 && PetscRealPart(a[i] - c[i]) < 0.5));
  PetscCall(VecRestoreArrayRead(count, &c));
  PetscCall(VecRestoreArrayRead(all, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &wide, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)closed)));
  *narrow = (PetscBool)!wide;
  PetscCall(VecDestroy(&all));
  PetscCall(VecDestroy(&count));
  PetscFunctionReturn(0);
}

/* Sets facet size, coarseness and narrowness in the pair's report. Collective. */
PetscErrorCode PairMeshMeasure(const PairRows *rows, PairFacets *facets, Vec closed, PairReport *report)
{
  PetscFunctionBegin;
  PetscCall(PairMeasureFacets(rows, &report->facet, &report->coarseness));
  PetscCall(PairMeasureNarrowness(facets, closed, &report->narrow));
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

static PetscErrorCode PairWarnOfRotation(const Measured *at, PetscInt p)
{
  const SceneContactPair *pair      = &at->scene->pairs[p];
  PetscReal               forces[2] = {0.0, 0.0}, motion = 0.0;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < at->report->nsteps; ++k) motion = PetscMax(motion, at->report->steps[k].motion);
  if (SceneIsDynamic(at->scene) || PairLoadTurns(at->report) ||
      PairCountTurns(at->report, p, MEASURE_ROUNDING * at->stiffness * motion, forces) < 2)
    PetscFunctionReturn(0);
  PetscCall(ReportWarn(at->comm, at->report, pair->place,
    "contact pair \"%s\": the contact is only one facet of %s wide, and its force oscillates as it moves over the "
    "facets, for example from %.3g to %.3g: refine that face to about seven facets across the contact, or make the "
    "face that moves with the contact the nonmortar one",
    pair->name, pair->nonmortar, (double)forces[0], (double)forces[1]));
  PetscFunctionReturn(0);
}

/* Warns of a nonmortar side that is coarser than the mortar side, unless it is also the softer one */
static PetscErrorCode PairWarnOfCoarseness(const Measured *at, PetscInt p)
{
  const SceneContactPair *pair      = &at->scene->pairs[p];
  const Material         *nonmortar = &SceneFaceBody(at->scene, pair->nonmortar)->material,
                 *mortar            = &SceneFaceBody(at->scene, pair->mortar)->material;
  const PetscBool softer            = (PetscBool)(nonmortar->type != MATERIAL_RIGID &&
                                       (mortar->type == MATERIAL_RIGID || nonmortar->young < mortar->young));
  PetscReal       coarseness        = 0.0;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < at->report->nsteps; ++s) {
    if (p < at->report->steps[s].npairs) coarseness = PetscMax(coarseness, at->report->steps[s].pairs[p].coarseness);
  }
  if (!softer && !pair->self && coarseness > PAIR_COARSE)
    PetscCall(ReportWarn(at->comm, at->report, pair->place,
      "contact pair \"%s\": facets of the nonmortar face %s are %.2g times as large as those of the mortar face %s, "
      "whose vertices can penetrate between its constraints: swap the two faces, or refine %s",
      pair->name, pair->nonmortar, (double)coarseness, pair->mortar, pair->nonmortar));
  PetscFunctionReturn(0);
}

/*
   Warns of facets that are too large for the radius of a rigid surface: about seven facets across the contact are
   needed, and its width is less than two radii. The contact must be one facet wide when it carries its largest force.
*/
static PetscErrorCode PairWarnOfRadius(const Measured *at, PetscInt p)
{
  const PetscReal         share   = 1.0 / 3.0;
  const SceneContactPair *pair    = &at->scene->pairs[p];
  const SceneBody        *surface = SceneFaceBody(at->scene, pair->mortar);
  const PetscReal         radius  = SceneSurfaceRadius(surface);
  const PairReport       *largest = NULL;

  PetscFunctionBegin;
  for (PetscInt s = 0; s < at->report->nsteps; ++s) {
    const StepReport *step = &at->report->steps[s];

    if (p >= step->npairs || step->pairs[p].normal_force <= step->force_rounding) continue;
    if (!largest || step->pairs[p].normal_force > largest->normal_force) largest = &step->pairs[p];
  }
  if (!largest || !largest->narrow || !(largest->facet > share * radius)) PetscFunctionReturn(0);
  PetscCall(ReportWarn(at->comm, at->report, pair->place,
    "contact pair \"%s\": facets of %s are %.3g large, and the radius of the rigid surface \"%s\" is %.3g: the force "
    "depends on where the vertices are; refine %s to about seven facets across the contact",
    pair->name, pair->nonmortar, (double)largest->facet, surface->name, (double)radius, pair->nonmortar));
  PetscFunctionReturn(0);
}

/* Warns of coarse contact meshes after the last load step */
PetscErrorCode PairMeshWarn(Simulation sim)
{
  const Measured at = SimulationMeasured(sim);
  PetscFunctionBegin;
  for (PetscInt p = 0; p < sim->model->scene->npairs; ++p) {
    PetscCall(PairWarnOfCoarseness(&at, p));
    PetscCall(PairWarnOfRotation(&at, p));
    PetscCall(PairWarnOfRadius(&at, p));
  }
  PetscFunctionReturn(0);
}
