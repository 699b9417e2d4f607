/* The quadratic model of one load step and its callbacks. */
#include "quadratic.h"

/*
   base = the last state with the step's prescribed displacements; energy and force there come from the elements, so that
   the prescribed rows' coupling, which the tangent does not hold, is in them.
*/
PetscErrorCode QuadraticCreate(Simulation sim, PetscReal load, QuadraticModel *q)
{
  PetscFunctionBegin;
  PetscCall(PetscMemzero(q, sizeof(*q)));
  PetscCall(PetscObjectReference((PetscObject)sim->K));
  q->K = sim->K;
  PetscCall(VecDuplicate(sim->path.u, &q->base));
  PetscCall(VecDuplicate(sim->path.u, &q->force));
  PetscCall(VecDuplicate(sim->path.u, &q->w));
  PetscCall(VecDuplicate(sim->path.u, &q->Kw));
  PetscCall(VecCopy(sim->path.u, q->base));
  PetscCall(PrescribedApply(&sim->prescribed, load, q->base));
  PetscCall(ElasticityEnergy(sim->elasticity, q->base, &q->energy));
  PetscCall(ElasticityForce(sim->elasticity, q->base, q->force));
  PetscCall(PrescribedZero(&sim->prescribed, q->force));
  PetscFunctionReturn(0);
}

/* g + J_full (u - u_linearized) = [g + J_full (base - u_linearized)] + J (u - base), J without prescribed columns */
PetscErrorCode QuadraticSetContact(QuadraticModel *q, const Prescribed *prescribed, ContactLinearization lin, Vec u_linearized)
{
  Vec mask;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(lin->g, &q->g));
  PetscCall(VecWAXPY(q->w, -1.0, u_linearized, q->base));
  PetscCall(MatMultAdd(lin->J, q->w, lin->g, q->g));
  PetscCall(MatDuplicate(lin->J, MAT_COPY_VALUES, &q->J));
  PetscCall(VecDuplicate(q->base, &mask));
  PetscCall(VecSet(mask, 1.0));
  PetscCall(PrescribedZero(prescribed, mask));
  PetscCall(MatDiagonalScale(q->J, NULL, mask));
  PetscCall(VecDestroy(&mask));
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticDestroy(QuadraticModel *q)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&q->K));
  PetscCall(MatDestroy(&q->J));
  PetscCall(VecDestroy(&q->g));
  PetscCall(VecDestroy(&q->base));
  PetscCall(VecDestroy(&q->force));
  PetscCall(VecDestroy(&q->w));
  PetscCall(VecDestroy(&q->Kw));
  PetscFunctionReturn(0);
}

/* Energy at u; leaves w = u - base and K w in the model */
PetscErrorCode QuadraticEnergy(QuadraticModel *q, Vec u, PetscReal *f)
{
  PetscScalar linear, curvature;

  PetscFunctionBegin;
  PetscCall(VecWAXPY(q->w, -1.0, q->base, u));
  PetscCall(MatMult(q->K, q->w, q->Kw));
  PetscCall(VecDotBegin(q->force, q->w, &linear));
  PetscCall(VecDotBegin(q->Kw, q->w, &curvature));
  PetscCall(VecDotEnd(q->force, q->w, &linear));
  PetscCall(VecDotEnd(q->Kw, q->w, &curvature));
  *f = q->energy + PetscRealPart(linear) + 0.5 * PetscRealPart(curvature);
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticObjectiveAndGradient(Tao tao, Vec u, PetscReal *f, Vec G, void *ctx)
{
  QuadraticModel *q = (QuadraticModel *)ctx;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(QuadraticEnergy(q, u, f));
  PetscCall(VecWAXPY(G, 1.0, q->force, q->Kw));
  PetscFunctionReturn(0);
}

/* Constant, and assembled: nothing to do, so that its object state tells the optimizer that it has not changed */
PetscErrorCode QuadraticHessian(Tao tao, Vec u, Mat H, Mat Hpre, void *ctx)
{
  PetscFunctionBegin;
  (void)tao, (void)u, (void)H, (void)Hpre, (void)ctx;
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticConstraint(Tao tao, Vec u, Vec c, void *ctx)
{
  QuadraticModel *q = (QuadraticModel *)ctx;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(VecWAXPY(q->w, -1.0, q->base, u));
  PetscCall(MatMultAdd(q->J, q->w, q->g, c));
  PetscFunctionReturn(0);
}

PetscErrorCode QuadraticJacobian(Tao tao, Vec u, Mat J, Mat Jpre, void *ctx)
{
  PetscFunctionBegin;
  (void)tao, (void)u, (void)J, (void)Jpre, (void)ctx;
  PetscFunctionReturn(0);
}
