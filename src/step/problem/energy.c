/*
   Objectives of a load step: either the quadratic model of the energy about p->base, which is exact if every body is
   linear; or the strain energy minus the work of the loads, which is infinite if an element is inverted.
*/
#include "problemimpl.h"
#include <math.h>
#include "src/state/path.h"

/* Computes *f = energy + force^T w + 1/2 w^T K w with w = u - base. On exit p->w and p->Kw contain w and K w. */
PetscErrorCode QuadraticEnergy(StepProblem *p, Vec u, PetscReal *f)
{
  PetscScalar linear, curvature;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(p->w, -1.0, p->base, u));
  PetscCall(MatMult(p->K, p->w, p->Kw));
  PetscCall(VecDotBegin(p->force, p->w, &linear));
  PetscCall(VecDotBegin(p->Kw, p->w, &curvature));
  PetscCall(VecDotEnd(p->force, p->w, &linear));
  PetscCall(VecDotEnd(p->Kw, p->w, &curvature));
  *f = p->energy + PetscRealPart(linear) + 0.5 * PetscRealPart(curvature);
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticObjectiveAndGradient(Tao tao, Vec u, PetscReal *f, Vec G, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(QuadraticEnergy(p, u, f));
  PetscCall(VecWAXPY(G, 1.0, p->force, p->Kw));
  PetscFunctionReturn(0);
}

/*
   Computes the displacement of the bodies that belongs to the optimizer's iterate. *u: the iterate itself, or with ties
   p->w, in which tied nodes follow the nodes on which they depend.
*/
static PetscErrorCode EnergyGetState(StepProblem *p, Vec iterate, Vec *u)
{
  PetscFunctionBegin;
  *u = iterate;
  if (!p->model->ties.C) PetscFunctionReturn(0);
  *u = p->w;
  PetscCall(VecCopy(iterate, *u));
  PetscCall(TiesFollow(&p->model->ties, *u));
  PetscFunctionReturn(0);
}

/* Computes the energy *f of the bodies and the loads at the displacement u; infinite if an element is inverted */
static PetscErrorCode EnergyGet(StepProblem *p, Vec u, PetscReal *f)
{
  PetscScalar work = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Energy, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityEnergy(p->model->elasticity, u, f));
  PetscCall(PetscLogEventEnd(SIM_Energy, NULL, NULL, NULL, NULL));
  if (p->load) PetscCall(VecDot(p->load, u, &work));
  if (EnergyIsFinite(*f)) PetscCall(ProximalAdd(p, u, f, NULL));
  if (EnergyIsFinite(*f)) PetscCall(SchemeAddForce(&p->model->dynamics, u, f, NULL));
  if (EnergyIsFinite(*f)) PetscCall(FollowersSubtract(p, u, f, NULL));
  *f = EnergyIsFinite(*f) ? *f - PetscRealPart(work) : INFINITY;
  PetscFunctionReturn(0);
}

/* Computes the gradient G of the energy at the displacement u, which is 0 in prescribed and tied rows */
PetscErrorCode EnergyGetGradient(StepProblem *p, Vec u, Vec G)
{
  PetscReal energy = 0.0; /* not used */

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Energy, NULL, NULL, NULL, NULL));
  PetscCall(ElasticityForce(p->model->elasticity, u, G));
  PetscCall(PetscLogEventEnd(SIM_Energy, NULL, NULL, NULL, NULL));
  if (p->load) PetscCall(VecAXPY(G, -1.0, p->load));
  PetscCall(FollowersSubtract(p, u, &energy, G));
  PetscCall(SchemeAddForce(&p->model->dynamics, u, &energy, G));
  PetscCall(TiesGather(&p->model->ties, G));
  PetscCall(ProximalAdd(p, u, &energy, G));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, G));
  PetscFunctionReturn(0);
}

/* Assembles the tangent H at the displacement u */
PetscErrorCode EnergyGetTangent(StepProblem *p, Vec u, Mat H)
{
  const Constraints constraints = ModelConstraints(p->model);

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Energy, NULL, NULL, NULL, NULL));
  PetscCall(TiesTangent(&constraints, u, H));
  PetscCall(ProximalAddStiffness(p, H));
  PetscCall(PetscLogEventEnd(SIM_Energy, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode EnergyObjective(Tao tao, Vec iterate, PetscReal *f, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;
  Vec          u;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(EnergyGetState(p, iterate, &u));
  PetscCall(EnergyGet(p, u, f));
  PetscFunctionReturn(0);
}

PetscErrorCode EnergyObjectiveAndGradient(Tao tao, Vec iterate, PetscReal *f, Vec G, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;
  Vec          u;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(EnergyGetState(p, iterate, &u));
  PetscCall(EnergyGet(p, u, f));
  if (EnergyIsFinite(*f)) PetscCall(EnergyGetGradient(p, u, G));
  else PetscCall(VecZeroEntries(G));
  PetscFunctionReturn(0);
}

/* Keeps u as the displacement of the newer of the last two tangents. The last state stands for those that have not been
   computed yet. */
static PetscErrorCode EnergyKeepTangent(StepProblem *p, Vec u)
{
  PetscBool same;

  PetscFunctionBegin;
  if (!p->tangent_at) {
    PetscCall(VecDuplicate(u, &p->tangent_at));
    PetscCall(VecDuplicate(u, &p->tangent_before));
    PetscCall(VecCopy(p->state->path->u, p->tangent_at));
    PetscCall(VecCopy(p->state->path->u, p->tangent_before));
  }
  PetscCall(VecEqual(u, p->tangent_at, &same));
  if (same) PetscFunctionReturn(0);
  PetscCall(VecSwap(p->tangent_at, p->tangent_before));
  PetscCall(VecCopy(u, p->tangent_at));
  PetscFunctionReturn(0);
}

PetscErrorCode EnergyHessian(Tao tao, Vec iterate, Mat H, Mat Hpre, void *ctx)
{
  StepProblem *p = (StepProblem *)ctx;
  Vec          u;

  PetscFunctionBegin;
  (void)tao;
  (void)Hpre;
  PetscCall(EnergyGetState(p, iterate, &u));
  PetscCall(EnergyKeepTangent(p, u));
  ElasticitySetPressureBase(p->model->elasticity, p->tangent_before);
  PetscCall(EnergyGetTangent(p, u, H));
  ElasticitySetPressureBase(p->model->elasticity, NULL);
  PetscFunctionReturn(0);
}

/*
   Ends a solve that has no equilibrium because bodies flow plastically. The plastic work grows in proportion to the
   displacement, whereas the elastic energy does not. Therefore the objective has a minimum unless the loads do more
   work on the flow than the flow dissipates (the kinematic theorem of limit analysis). This is found if the objective
   is below that of the last state although the plastic work is a large multiple of the elastic energy. The test is not
   made if prescribed displacements move, because these may require such a plastic work.
*/
PetscErrorCode EnergyTestFlow(Tao tao, void *ctx)
{
  StepProblem       *p        = (StepProblem *)ctx;
  const PetscReal    multiple = 1e3;
  const PetscInt     patience = 2;
  Vec                iterate, u;
  PetscReal          stored, work, f, rest;
  PetscInt           body;
  PetscBool          still;
  TaoConvergedReason reason;

  PetscFunctionBegin;
  PetscCall(TaoGetConvergedReason(tao, &reason));
  if (reason != TAO_CONTINUE_ITERATING) PetscFunctionReturn(0);
  PetscCall(TaoGetSolution(tao, &iterate));
  PetscCall(EnergyGetState(p, iterate, &u));
  PetscCall(ElasticityPlasticFlow(p->model->elasticity, u, &stored, &work, &body));
  if (!(work > multiple * stored)) PetscFunctionReturn(0);
  PetscCall(VecEqual(p->base, p->state->path->u, &still));
  PetscCall(EnergyObjective(tao, iterate, &f, p));
  PetscCall(EnergyObjective(tao, p->state->path->u, &rest, p));
  if (!still || !(f < rest) || ++p->nflows < patience) PetscFunctionReturn(0);
  p->flowing = p->model->scene->bodies[body].name;
  PetscCall(TaoSetConvergedReason(tao, TAO_DIVERGED_USER));
  PetscFunctionReturn(0);
}
