/* How deep vertices of one face of a pair are in the other body, beside the gap, which of mortar pairs is a mean. */
#include "src/step/stepimpl.h"

#define PENETRATION_SHARE 0.01 /* of the largest displacement: more is warned of */

/* At the last state. Collective */
PetscErrorCode PenetrationMeasure(Simulation sim, StepReport *report)
{
  PetscReal *depth;

  PetscFunctionBegin;
  if (!report->npairs) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(report->npairs, &depth));
  PetscCall(ContactGetPenetration(sim->contact, sim->path.u, depth));
  PetscCall(VecNorm(sim->path.u, NORM_INFINITY, &report->motion));
  for (PetscInt p = 0; p < report->npairs; ++p) report->pairs[p].penetration = depth[p];
  PetscCall(PetscFree(depth));
  PetscFunctionReturn(0);
}

/* Whether an overlap of the pair is to be left at the end of a load step */
static PetscBool PenetrationIsMeant(const SceneContactPair *pair, const StepReport *report)
{
  return (PetscBool)(pair->interference_ramp >= 0 && report->ramps[pair->interference_ramp].factor < 1.0);
}

/* After the last load step, of each pair the deepest in proportion to the motion. Not where the gap itself is not to
   be met */
PetscErrorCode PenetrationWarn(Simulation sim)
{
  const RunReport *run = &sim->report;

  PetscFunctionBegin;
  if (sim->penalty > 0.0 || sim->scene->contact_updates == 1) PetscFunctionReturn(0);
  for (PetscInt p = 0; p < sim->scene->npairs; ++p) {
    const SceneContactPair *pair  = &sim->scene->pairs[p];
    PetscReal               worst = 0.0, depth = 0.0;
    PetscInt                step = 0;

    for (PetscInt s = 0; s < run->nsteps; ++s) {
      const StepReport *report = &run->steps[s];

      if (p >= report->npairs || PenetrationIsMeant(pair, report)) continue;
      if (report->pairs[p].penetration <= worst * report->motion) continue;
      depth = report->pairs[p].penetration;
      worst = depth / report->motion;
      step  = report->step;
    }
    if (worst > PENETRATION_SHARE)
      PetscCall(ReportWarn(sim->comm, &sim->report,
        "contact pair \"%s\": vertices of %s and %s penetrate by up to %g in load step %" PetscInt_FMT
        ", %.2g %% of the largest displacement, though the mean gap is closed: make the finer or softer side the "
        "nonmortar one, refine it, or use gap: node",
        pair->name, pair->mortar, pair->nonmortar, (double)depth, step, 100.0 * (double)worst));
  }
  PetscFunctionReturn(0);
}
