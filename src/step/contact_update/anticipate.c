/*
   Improves the contact update of pairs with smooth surfaces. The matrix J of the linearized gap is computed with fixed
   patches, so that its transpose gives forces which are smooth over the facets of a body. The exact derivative B of the
   gap also contains the rotation of the normals and the bending of the patches. Without the following correction these
   terms would have an effect only in the next contact update, and the error would decay slowly.

     The gap g of rows under pressure is therefore replaced by a gap g'. The solution with J and g' closes these rows
     approximately as a solution with B and g would. The response of the bodies is approximated by D = diag(K)^-1:
       B D J^T w = g,  g' = J D J^T w.
     At the solution of the load step g = g' = 0 in these rows. Soft rows have a compliance C and yielded by y in the
     last solution: there B D J^T w + C w = g + y and g' = J D J^T w + C w - y, so that g = g' = -y at the solution.
*/
#include "contact_updateimpl.h"
#include "src/state/contact_history.h"

#define ANTICIPATE_TOLERANCE  1e-3
#define ANTICIPATE_ITERATIONS 100

typedef struct {
  Mat J, B;
  Vec closed;         /* 1 for rows under pressure, 0 for other rows */
  Vec own, yield;     /* compliance of the rows [length/force]; depth by which they yielded in the last solution
                         [length]; zeros in rigid rows */
  Vec D;              /* diag(K)^-1; 0 in prescribed rows [length/force] */
  Vec row, force, du; /* work vectors: one in the space of the rows, two displacement vectors */
} GapResponse;

/* Computes y = (A D J^T + C) x in the rows under pressure and y = x in the other rows. A: J or B. */
static PetscErrorCode ResponseApply(GapResponse *r, Mat A, Vec x, Vec y)
{
  PetscFunctionBegin;
  PetscCall(VecPointwiseMult(r->row, r->closed, x));
  PetscCall(MatMultTranspose(r->J, r->row, r->force));
  PetscCall(VecPointwiseMult(r->du, r->D, r->force));
  PetscCall(VecPointwiseMult(r->row, r->own, r->row));
  PetscCall(MatMultAdd(A, r->du, r->row, y));
  PetscCall(VecPointwiseMult(y, r->closed, y));
  PetscCall(VecPointwiseMult(r->row, r->closed, x));
  PetscCall(VecAYPX(r->row, -1.0, x));
  PetscCall(VecAXPY(y, 1.0, r->row));
  PetscFunctionReturn(0);
}

static PetscErrorCode ResponseMult(Mat shell, Vec x, Vec y)
{
  GapResponse *r;

  PetscFunctionBegin;
  PetscCall(MatShellGetContext(shell, &r));
  PetscCall(ResponseApply(r, r->B, x, y));
  PetscFunctionReturn(0);
}

/* Computes D = 1/diag(K); 1 where the diagonal of K is not positive, and 0 in prescribed rows. */
static PetscErrorCode ResponseDiagonal(StepProblem *p, Vec D)
{
  PetscScalar *d;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(MatGetDiagonal(p->K, D));
  PetscCall(VecGetLocalSize(D, &n));
  PetscCall(VecGetArray(D, &d));
  for (PetscInt i = 0; i < n; ++i) d[i] = PetscRealPart(d[i]) > 0.0 ? 1.0 / d[i] : 1.0;
  PetscCall(VecRestoreArray(D, &d));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, D));
  PetscFunctionReturn(0);
}

/* Sets compliance and yield of the rows of lin */
static PetscErrorCode ResponseSetSoft(StepProblem *p, ContactLinearization lin, GapResponse *r)
{
  PetscBool any;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(p->g, &r->own));
  PetscCall(VecDuplicate(p->g, &r->yield));
  PetscCall(VecZeroEntries(r->own));
  PetscCall(VecZeroEntries(r->yield));
  if (!p->compliance) PetscFunctionReturn(0);
  PetscCall(ContactHistoryRecall(p->state->history, lin, 1.0, r->own, r->yield, &any)); /* pressures in r->yield */
  PetscCall(VecPointwiseMult(r->yield, r->yield, p->compliance));
  PetscCall(VecPointwiseDivide(r->own, p->compliance, lin->mass));
  PetscFunctionReturn(0);
}

/*
   Replaces g by g' (see the top of this file) in p->g, in the rows whose vertices were under pressure in the last
   solution. Does nothing if no pair has smooth surfaces, or if the system for w is not solved.
*/
PetscErrorCode ContactUpdateAnticipate(StepProblem *p, ContactLinearization lin)
{
  GapResponse r = {.J = lin->J, .B = lin->derivative};
  Vec         g, w;
  PetscBool   found = PETSC_FALSE;

  PetscFunctionBegin;
  if (!lin->derivative) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(p->g, &r.closed));
  PetscCall(VecDuplicate(p->g, &r.row));
  PetscCall(VecDuplicate(p->g, &g));
  PetscCall(VecDuplicate(p->g, &w));
  PetscCall(VecDuplicate(p->base, &r.D));
  PetscCall(VecDuplicate(p->base, &r.force));
  PetscCall(VecDuplicate(p->base, &r.du));
  PetscCall(ContactHistoryFindClosed(p->state->history, lin, r.closed));
  PetscCall(ResponseDiagonal(p, r.D));
  PetscCall(ResponseSetSoft(p, lin, &r));
  PetscCall(VecWAXPY(g, 1.0, lin->g, r.yield));
  PetscCall(VecPointwiseMult(g, r.closed, g));
  PetscCall(MatrixFreeSolve(g, w, &r, ResponseMult, ANTICIPATE_TOLERANCE, ANTICIPATE_ITERATIONS, &found));
  if (found) {
    PetscCall(ResponseApply(&r, r.J, w, g));
    PetscCall(VecAXPY(g, -1.0, r.yield));
    PetscCall(VecPointwiseMult(g, r.closed, g));
    PetscCall(VecPointwiseMult(r.row, r.closed, lin->g));
    PetscCall(VecAXPY(p->g, -1.0, r.row));
    PetscCall(VecAXPY(p->g, 1.0, g));
  }
  PetscCall(VecDestroy(&r.closed));
  PetscCall(VecDestroy(&r.row));
  PetscCall(VecDestroy(&r.own));
  PetscCall(VecDestroy(&r.yield));
  PetscCall(VecDestroy(&g));
  PetscCall(VecDestroy(&w));
  PetscCall(VecDestroy(&r.D));
  PetscCall(VecDestroy(&r.force));
  PetscCall(VecDestroy(&r.du));
  PetscFunctionReturn(0);
}
