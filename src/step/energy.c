/* The true energy of the bodies as objective: infinite where an element is turned inside out. */
#include "stepimpl.h"
#include <math.h>

PetscErrorCode EnergyObjective(Tao tao, Vec u, PetscReal *f, void *ctx)
{
  StepProblem *p    = (StepProblem *)ctx;
  PetscScalar  work = 0.0;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityEnergy(p->sim->elasticity, u, f));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  if (p->load) PetscCall(VecDot(p->load, u, &work));
  *f = EnergyIsFinite(*f) ? *f - PetscRealPart(work) : INFINITY;
  PetscFunctionReturn(0);
}

PetscErrorCode EnergyObjectiveAndGradient(Tao tao, Vec u, PetscReal *f, Vec G, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;

  PetscFunctionBegin;
  PetscCall(EnergyObjective(tao, u, f, ctx));
  if (PetscIsInfOrNanReal(*f)) {
    PetscCall(VecZeroEntries(G));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityForce(p->sim->elasticity, u, G));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  if (p->load) PetscCall(VecAXPY(G, -1.0, p->load));
  PetscCall(PrescribedSet(&p->sim->prescribed, 0.0, G));
  PetscFunctionReturn(0);
}

PetscErrorCode EnergyHessian(Tao tao, Vec u, Mat H, Mat Hpre, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;

  PetscFunctionBegin;
  (void)tao, (void)Hpre;
  PetscCall(PetscLogEventBegin(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityTangent(p->sim->elasticity, u, H));
  PetscCall(PetscLogEventEnd(SIM_Assembly, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
