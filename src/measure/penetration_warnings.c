/*
   Measures the penetration of single vertices below the other face of a pair. The gaps of mortar pairs are means, so
   that single vertices may penetrate.
*/
#include "measureimpl.h"

/* Returns whether the pair carries a force that is not a rounding error */
static PetscBool PenetrationHasForce(const StepReport *report, PetscInt p)
{
  return (PetscBool)(PetscAbsReal(report->pairs[p].normal_force) > report->force_rounding);
}

/* Measures penetration at the last state. After the last load step, pairs without force are measured in their facets as
   well. Collective. */
PetscErrorCode PenetrationMeasure(Model model, State state, StepReport *report)
{
  PetscReal *depth, *rounding, sum;
  PetscBool *within;

  PetscFunctionBegin;
  if (!report->npairs) PetscFunctionReturn(0);
  PetscCall(PetscMalloc3(report->npairs, &depth, report->npairs, &rounding, report->npairs, &within));
  for (PetscInt p = 0; p < report->npairs; ++p)
    within[p] = (PetscBool)(report->step == model->scene->nsteps && !PenetrationHasForce(report, p));
  PetscCall(ContactGetPenetration(model->contact, state->path->u, within, depth, rounding));
  PetscCall(NodalMagnitudesMeasure(state->path->u, &sum, &report->motion));
  for (PetscInt p = 0; p < report->npairs; ++p) {
    report->pairs[p].penetration          = depth[p];
    report->pairs[p].penetration_rounding = rounding[p];
  }
  PetscCall(PetscFree3(depth, rounding, within));
  PetscFunctionReturn(0);
}

/* Returns whether a pair may penetrate at the end of a load step: it is soft, or its overlap's ramp has not ended */
static PetscBool PenetrationIsMeant(const SceneContactPair *pair, const StepReport *report)
{
  return (PetscBool)(SceneContactPairIsSoft(pair) ||
                     (pair->interference_ramp >= 0 && report->ramps[pair->interference_ramp].factor < 1.0));
}

/* Returns the largest displacement of the load steps so far [length] */
static PetscReal PenetrationMotion(const RunReport *run)
{
  PetscReal motion = 0.0;

  for (PetscInt s = 0; s < run->nsteps; ++s) motion = PetscMax(motion, run->steps[s].motion);
  return motion;
}

/* Writes which part of the largest displacement a depth is; nothing if no point has moved */
static PetscErrorCode PenetrationSayShare(PetscReal depth, PetscReal motion, size_t size, char text[])
{
  PetscFunctionBegin;
  text[0] = 0;
  if (motion > 0.0)
    PetscCall(PetscSNPrintf(text, size, ", %.3g %% of the largest displacement", 100.0 * (double)(depth / motion)));
  PetscFunctionReturn(0);
}

/*
   Fails the last load step if a pair carries no force although a point of it penetrates the other body. The mean
   gap is then open, so that no contact force acts. In earlier load steps this is only a warning: when contact begins on
   a coarse mesh, the first vertex penetrates a little before the mean gap closes. In dynamics it is always a warning.
*/
PetscErrorCode PenetrationTest(Simulation sim, StepReport *report)
{
  const PetscReal motion = PenetrationMotion(&sim->report);
  char            share[64];

  PetscFunctionBegin;
  if (sim->model->scene->contact_updates == 1 || ModelIsDynamic(sim->model) || motion == 0.0) PetscFunctionReturn(0);
  if (report->step < sim->model->scene->nsteps) PetscFunctionReturn(0);
  for (PetscInt p = 0; p < report->npairs && report->converged; ++p) {
    const SceneContactPair *pair = &sim->model->scene->pairs[p];
    const PairReport       *its  = &report->pairs[p];

    if (PenetrationHasForce(report, p) || PenetrationIsMeant(pair, report)) continue;
    if (its->penetration <= PetscMax(MEASURE_MOTION * motion, its->penetration_rounding)) continue;
    PetscCall(PenetrationSayShare(its->penetration, motion, sizeof(share), share));
    PetscCall(ReportReason(report, PETSC_FALSE,
      "contact pair \"%s\" carries no force, although a point of %s or %s penetrates the other body by %.3g%s: %s",
      pair->name, pair->mortar, pair->nonmortar, (double)its->penetration, share,
      SceneBodyIsSurface(SceneFaceBody(sim->model->scene, pair->mortar))
        ? "the rigid surface lies between the nonmortar vertices without touching one; refine the nonmortar face"
        : "the mean gap of the nonmortar facets there is open; use gap: node, swap the two faces, or refine them"));
    ReportFailRun(&sim->report, report, RUN_GAP_UNCONVERGED);
  }
  PetscFunctionReturn(0);
}

/*
   Warns, after the last load step, of a pair without force whose penetration is most of the motion, although it may be
   an error of the curved faces: with motions so small the mesh decides whether there is contact. run: has load steps.
*/
static PetscErrorCode PenetrationWarnOfCoarse(const Measured *at, PetscInt p)
{
  const RunReport        *run    = at->report;
  const StepReport       *report = &run->steps[run->nsteps - 1];
  const SceneContactPair *pair   = &at->scene->pairs[p];
  const PetscReal         motion = PenetrationMotion(run), most = 0.5;
  const PairReport       *its;
  char                    share[64];

  PetscFunctionBegin;
  if (p >= report->npairs || pair->self || PenetrationIsMeant(pair, report)) PetscFunctionReturn(0);
  its = &report->pairs[p];
  if (PenetrationHasForce(report, p) || its->penetration <= most * motion ||
      its->penetration > its->penetration_rounding)
    PetscFunctionReturn(0);
  PetscCall(PenetrationSayShare(its->penetration, motion, sizeof(share), share));
  PetscCall(ReportWarn(at->comm, at->report, pair->place,
    "contact pair \"%s\" carries no force, although a point of %s or %s penetrates the other body by %.3g%s; the error "
    "of the curved faces there may be as large: refine them if the bodies are to touch",
    pair->name, pair->mortar, pair->nonmortar, (double)its->penetration, share));
  PetscFunctionReturn(0);
}

/*
   Warns of penetration after the last load step, pair by pair. Load steps in which the scene leaves an overlap are
   ignored.
*/
PetscErrorCode PenetrationWarn(Simulation sim)
{
  const Measured   at     = SimulationMeasured(sim);
  const RunReport *run    = &sim->report;
  const PetscReal  motion = PenetrationMotion(run);

  PetscFunctionBegin;
  if (sim->model->scene->contact_updates == 1) PetscFunctionReturn(0); /* leaves penetration */
  for (PetscInt p = 0; p < sim->model->scene->npairs; ++p) {
    const SceneContactPair *pair  = &sim->model->scene->pairs[p];
    PetscReal               depth = 0.0;
    PetscInt                step  = 0;
    PetscBool               open  = PETSC_FALSE;
    const PetscBool         node  = (PetscBool)(pair->gap == GAP_NODE);
    char                    share[64];

    for (PetscInt s = 0; s < run->nsteps; ++s) {
      const StepReport *report = &run->steps[s];

      if (p >= report->npairs || PenetrationIsMeant(pair, report)) continue;
      if (report->pairs[p].penetration <= PetscMax(depth, report->pairs[p].penetration_rounding)) continue;
      depth = report->pairs[p].penetration;
      step  = report->step;
      open  = (PetscBool)!PenetrationHasForce(report, p);
    }
    if (run->nsteps) PetscCall(PenetrationWarnOfCoarse(&at, p));
    if (depth <= MEASURE_MOTION * motion) continue;
    PetscCall(PenetrationSayShare(depth, motion, sizeof(share), share));
    if (pair->self)
      PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place,
        "contact pair \"%s\": a vertex of %s penetrates its own body by %.3g at the end of load step %" PetscInt_FMT
        "%s, although the mean gap is closed: refine the surface there",
        pair->name, pair->self, (double)depth, step, share));
    else
      PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place,
        "contact pair \"%s\": a point of %s or %s penetrates the other body by %.3g at the end of load step "
        "%" PetscInt_FMT "%s, although the %s is %s: %s",
        pair->name, pair->mortar, pair->nonmortar, (double)depth, step, share,
        node ? "gap at the nonmortar vertices" : "mean gap", open ? "open" : "closed",
        node ? "swap the two faces, or refine the nonmortar one there" : "use gap: node, or refine the faces there"));
  }
  PetscFunctionReturn(0);
}
