/*
   Solves load steps that return to zero: no load, no temperature change, no prescribed displacement, no overlap. The
   solution is the undeformed bodies. It is set directly, because relative residuals would compare rounding errors with
   rounding errors.
*/
#include "problemimpl.h"
#include "src/state/contact_history.h"
#include "src/state/path.h"

/*
   Finds whether u = 0 may be the solution. vanishes: true if a solve has led to u = 0 up to rounding. *due: true if
   loads, temperatures and prescribed displacements are zero at this time, the last state is deformed, no metal has
   yielded, no bolt is shortened, and no pair has pressure at no gap. If a pair has friction, which may hold bodies in a
   deformed state, u must vanish.
*/
PetscErrorCode ZeroLoadStepIsDue(const StepProblem *p, PetscBool vanishes, PetscBool *due)
{
  PetscReal before, displacement, temperature, load = 0.0, moved = 0.0;
  PetscBool stays; /* true if something has slipped or yielded, which is not undone by zero load */
  Vec       u;

  PetscFunctionBegin;
  *due = PETSC_FALSE;
  if (ModelIsDynamic(p->model)) PetscFunctionReturn(0);
  if (p->load) PetscCall(VecNorm(p->load, NORM_INFINITY, &load));
  PetscCall(TemperaturesGetLargest(&p->model->temperatures, &temperature));
  PetscCall(VecNorm(p->state->path->u, NORM_INFINITY, &before));
  PetscCall(VecDuplicate(p->base, &u));
  PetscCall(VecZeroEntries(u));
  PetscCall(PrescribedApply(&p->model->prescribed, p->time, u));
  PetscCall(VecNorm(u, NORM_INFINITY, &displacement));
  PetscCall(VecDestroy(&u));
  if (p->model->ties.o) PetscCall(VecNorm(p->model->ties.o, NORM_INFINITY, &moved));
  PetscCall(ElasticityHasYielded(p->model->elasticity, &stays));
  for (PetscInt b = 0; b < p->model->bolts.n; ++b) stays = (PetscBool)(stays || p->model->bolts.now[b] != 0.0);
  for (PetscInt k = 0; !vanishes && k < p->model->scene->npairs; ++k)
    stays = (PetscBool)(stays || SceneContactPairHasFriction(&p->model->scene->pairs[k]));
  for (PetscInt k = 0; k < p->model->scene->npairs; ++k)
    stays = (PetscBool)(stays || p->model->scene->pairs[k].exponential[1] > 0.0);
  *due =
    (PetscBool)(!stays && before > 0.0 && load == 0.0 && temperature == 0.0 && displacement == 0.0 && moved == 0.0);
  PetscFunctionReturn(0);
}

/*
   Sets u = 0 as the solution if the undeformed bodies overlap by no more than rounding. undeformed: linearization at u
   = 0; *rests: true if u = 0 is the solution.
*/
PetscErrorCode ZeroLoadStepSolve(StepProblem *p, ContactLinearization undeformed, Vec u, StepReport *report,
  ContactSolution *sol, PetscBool *rests)
{
  const PetscReal rounding = PETSC_SQRT_MACHINE_EPSILON * p->state->path->largest_increment;
  PetscReal       least    = 0.0;
  PetscInt        nrows;

  PetscFunctionBegin;
  PetscCall(VecGetSize(undeformed->g, &nrows));
  if (nrows) PetscCall(VecMin(undeformed->g, NULL, &least));
  *rests = (PetscBool)(least >= -rounding);
  if (!*rests) PetscFunctionReturn(0);
  PetscCall(VecZeroEntries(u));
  PetscCall(ContactSolutionCreate(undeformed->g, sol));
  PetscCall(VecZeroEntries(sol->pressure));
  PetscCall(VecCopy(undeformed->g, sol->gap));
  if (p->state->history->frictional) {
    PetscCall(StepProblemSetContact(p, undeformed, u));
    PetscCall(FrictionKeepNone(p, u, sol));
  }
  PetscCall(ContactHistoryStore(p->state->history, undeformed, sol, sol->gap, p->model->stiffness));
  report->potential = report->kkt_error = report->kkt_error_unscaled = 0.0;
  PetscCall(ReportReason(report, PETSC_TRUE,
    "converged: loads and prescribed displacements are zero, the bodies are undeformed"));
  PetscFunctionReturn(0);
}
