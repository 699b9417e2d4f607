/* Computes the work of external forces (dead loads, reactions at prescribed displacements) and of contact forces */
#include "measureimpl.h"
#include "src/state/contact_history.h"

/*
   Adds the work of a force over the displacement since the last state: (1 - part) x before . increment[0] + part x now
   . increment[1], where a NULL force counts as zero. `now` then becomes `before`.
*/
static PetscErrorCode WorkAddForce(Vec increment[2], PetscReal part, Vec *before, Vec *now, PetscReal *work)
{
  const PetscReal parts[2]  = {1.0 - part, part};
  Vec             forces[2] = {*before, *now};
  PetscScalar     product;

  PetscFunctionBegin;
  for (int k = 0; k < 2; ++k) {
    if (!forces[k]) continue;
    PetscCall(VecDot(forces[k], increment[k], &product));
    *work += parts[k] * PetscRealPart(product);
  }
  PetscCall(VecDestroy(before));
  *before = *now;
  *now    = NULL;
  PetscFunctionReturn(0);
}

/*
   Updates the energy balance after a solve. work: work of the loads in this solve; taken: energy that contact took up;
   rounding: work of rounding errors of the forces.
*/
static PetscErrorCode WorkBalance(LoadPath *path, PetscReal work, PetscReal taken, PetscReal rounding,
  StepReport *report)
{
  /* The imbalance is divided by the sum of the exchanged energies (turnover), or by this fraction of the stored energy
     if that is larger. */
  const PetscReal at_rest = 1e-2;
  const PetscReal stored  = report->energy + report->plastic_work - path->energy;

  PetscFunctionBegin;
  path->energy += stored;
  path->unbalanced += PetscAbsReal(work - stored - taken);
  path->turnover +=
    PetscMax(rounding, PetscMax(PetscAbsReal(work), PetscMax(PetscAbsReal(stored), PetscAbsReal(taken))));
  path->presses = PETSC_FALSE;
  for (PetscInt p = 0; p < report->npairs; ++p)
    path->presses = (PetscBool)(path->presses || (report->pairs[p].frictional && report->pairs[p].size > 0.0));
  path->pressed = (PetscBool)(path->pressed || path->presses);
  report->imbalance =
    path->turnover > 0.0 ? path->unbalanced / PetscMax(path->turnover, at_rest * PetscAbsReal(path->energy)) : 0.0;
  PetscFunctionReturn(0);
}

/*
   Warns at the end of a load step if the energy balance has an error of more than 1 %, and of more than twice that of
   the last warning. The balance shows how well the load steps follow the path on which the work of friction depends.
   Where friction did not act there is no warning.
*/
PetscErrorCode WorkWarn(Simulation sim, const StepReport *report)
{
  const PetscReal allowed = PetscMax(1e-2, 2.0 * sim->state->path->told);

  PetscFunctionBegin;
  if (!sim->state->path->pressed || !(report->imbalance > allowed)) PetscFunctionReturn(0);
  sim->state->path->told = report->imbalance;
  PetscCall(ReportWarn(sim->model->comm, &sim->report, NULL,
    "load step %" PetscInt_FMT ": %.2g %% of the work is neither stored nor taken up by friction and contact (%g of "
    "%g); use more load steps",
    report->step, 100.0 * (double)report->imbalance, (double)sim->state->path->unbalanced,
    (double)sim->state->path->turnover));
  PetscFunctionReturn(0);
}

/* Adds the work of reactions in the impact scheme, which are those of the step as a whole, and sets them to zero */
static PetscErrorCode WorkAddMean(const Measured *at, Vec increment[2], Vec reaction, PetscReal *work)
{
  const PetscReal share = SchemeShare(&at->scene->dynamics);

  PetscFunctionBegin;
  for (int k = 0; k < 2; ++k) {
    PetscScalar product;

    PetscCall(VecDot(reaction, increment[k], &product));
    *work += 0.5 * share * PetscRealPart(product);
  }
  PetscCall(VecZeroEntries(reaction));
  PetscFunctionReturn(0);
}

/* Reports the pretension of bolts at u, and adds its work */
static PetscErrorCode WorkAddBolts(Model model, State state, Vec u, StepReport *report)
{
  const Bodies bodies = ModelBodies(model);
  PetscReal    work;

  PetscFunctionBegin;
  PetscCall(BoltsSettle(&bodies, &model->bolts, u, &work));
  state->path->work += work;
  PetscCall(PetscFree(report->bolts));
  report->nbolts = model->bolts.n;
  PetscCall(PetscCalloc1(report->nbolts, &report->bolts));
  for (PetscInt b = 0; b < report->nbolts; ++b)
    report->bolts[b] = (BoltReport){.name = model->scene->bolts[b].name,
      .force                              = model->bolts.force[b],
      .shortening                         = model->bolts.shortening[b]};
  PetscFunctionReturn(0);
}

/*
   Adds the work from the last state to u. unbalanced: internal - contact - dead forces, which are the reactions in
   prescribed rows; rigid: forces on rigid bodies that are driven by forces, or NULL; contact: contact forces if there
   is friction, owned by this function afterwards, or NULL. late: work of friction that the mean of the forces at both
   states omits. The mean of the loads omits the same work, which is therefore added to theirs. With temperatures a part
   may come from the thermal expansion, whose work is not computed.
*/
PetscErrorCode WorkAdd(Simulation sim, Vec load, Vec u, Vec unbalanced, Vec rigid, Vec *contact, PetscReal late,
  StepReport *report)
{
  const Measured  at     = MeasuredAt(sim->model, sim->state, NULL);
  const Bodies    bodies = ModelBodies(sim->model);
  LoadPath       *path   = sim->state->path;
  const PetscReal work = path->work, taken = path->contact_work;
  PetscReal       place, way;
  Vec             outside, reaction, increment[2];

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &outside));
  PetscCall(VecDuplicate(u, &reaction));
  PetscCall(VecCopy(unbalanced, outside));
  PetscCall(PrescribedSet(&sim->model->prescribed, 0.0, outside));
  PetscCall(VecWAXPY(reaction, -1.0, outside, unbalanced));
  PetscCall(ArcsGetIncrements(&bodies, path->u, u, increment));
  if (SchemeIsImpact(&sim->model->scene->dynamics)) PetscCall(WorkAddMean(&at, increment, reaction, &path->work));
  if (load) PetscCall(VecWAXPY(outside, 1.0, load, reaction));
  else PetscCall(VecCopy(reaction, outside));
  if (rigid) PetscCall(VecAXPY(outside, SchemeShare(&sim->model->scene->dynamics), rigid));
  PetscCall(VecDestroy(&reaction));
  PetscCall(VecNorm(u, NORM_INFINITY, &place));
  PetscCall(VecNorm(increment[0], NORM_INFINITY, &way));
  PetscCall(WorkAddForce(increment, 0.5, &path->outside, &outside, &path->work));
  if (*contact)
    PetscCall(VecScale(*contact, -1.0)); /* the forces on the contacts are opposite to those on the
                                                        bodies */
  /* in the impact scheme contact forces act with the mean arms of the step (turn.c): chords instead of arcs */
  if (SchemeIsImpact(&sim->model->scene->dynamics)) PetscCall(VecWAXPY(increment[1], -1.0, path->u, u));
  PetscCall(WorkAddForce(increment, SchemeIsImpact(&sim->model->scene->dynamics) ? 1.0 : 0.5, &path->contact, contact,
    &path->contact_work));
  if (!sim->model->scene->ntemperatures) path->work += late;
  path->contact_work += late;
  PetscCall(WorkAddBolts(sim->model, sim->state, u, report));
  for (int k = 0; k < 2; ++k) PetscCall(VecDestroy(&increment[k]));
  report->work         = path->work;
  report->contact_work = path->contact_work;
  if (!sim->state->history->frictional) PetscFunctionReturn(0);
  report->normal_work = report->contact_work - report->dissipated - report->contact_energy;
  if (!sim->model->scene->ntemperatures && !ModelIsDynamic(sim->model))
    PetscCall(WorkBalance(path, path->work - work, path->contact_work - taken,
      MODEL_ROUNDING * sim->model->stiffness * place * way, report));
  PetscFunctionReturn(0);
}
