/*
   A load step back to where nothing is asked for: no load, no temperature, no prescribed displacement, no overlap.
   The bodies are undeformed then. Every residual would be measured by what is left of forces, energies and
   displacements: by rounding.
*/
#include "stepimpl.h"

/* Whether this time asks for no force and for no displacement, where those before it did */
PetscErrorCode ZeroLoadStepIsDue(const StepProblem *p, PetscBool *due)
{
  PetscReal before, displacement, temperature, load = 0.0, moved = 0.0;
  PetscBool rubs = PETSC_FALSE; /* what has slipped does not go back by itself */
  Vec       u;

  PetscFunctionBegin;
  *due = PETSC_FALSE;
  if (SimulationIsDynamic(p->sim)) PetscFunctionReturn(0);
  if (p->load) PetscCall(VecNorm(p->load, NORM_INFINITY, &load));
  PetscCall(TemperaturesGetLargest(&p->sim->temperatures, &temperature));
  PetscCall(VecNorm(p->sim->path.u, NORM_INFINITY, &before));
  PetscCall(VecDuplicate(p->base, &u));
  PetscCall(VecZeroEntries(u));
  PetscCall(PrescribedApply(&p->sim->prescribed, p->time, u));
  PetscCall(VecNorm(u, NORM_INFINITY, &displacement));
  PetscCall(VecDestroy(&u));
  if (p->sim->ties.o) PetscCall(VecNorm(p->sim->ties.o, NORM_INFINITY, &moved));
  for (PetscInt k = 0; k < p->sim->scene->npairs; ++k)
    rubs = (PetscBool)(rubs || SceneContactPairRubs(&p->sim->scene->pairs[k]));
  *due = (PetscBool)(!rubs && before > 0.0 && load == 0.0 && temperature == 0.0 && displacement == 0.0 && moved == 0.0);
  PetscFunctionReturn(0);
}

/* The undeformed bodies are the solution unless they overlap by more than rounding; undeformed: the gap between them */
PetscErrorCode ZeroLoadStepSolve(const StepProblem *p, ContactLinearization undeformed, Vec u, StepReport *report,
  ContactSolution *sol, PetscBool *rests)
{
  const PetscReal rounding = PETSC_SQRT_MACHINE_EPSILON * p->sim->path.largest_increment;
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
  PetscCall(ContactHistoryStore(&p->sim->history, undeformed, sol, sol->gap, p->sim->stiffness));
  report->potential = report->kkt_error = report->kkt_error_unscaled = 0.0;
  PetscCall(ReportReason(report, PETSC_TRUE, "converged: nothing is asked for, the bodies are undeformed"));
  PetscFunctionReturn(0);
}
