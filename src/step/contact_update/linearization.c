/* The displacements at which the gap is linearized in contact updates, and the linearizations there */
#include "contact_updateimpl.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"

/*
   Computes the gap at u for a load step that ends at `time`. The derivative of the gap is computed only if initial
   overlaps follow ramps, since InterferenceAdd() needs it.
*/
PetscErrorCode ContactUpdateGetGaps(Model model, State state, PetscReal time, Vec u, ContactLinearization *lin)
{
  PetscBool ramps = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < model->scene->npairs; ++p)
    ramps = (PetscBool)(ramps || model->scene->pairs[p].interference_ramp >= 0);
  if (ramps) {
    PetscCall(ContactLinearize(model->contact, u, CONTACT_FORCES, lin));
    PetscCall(InterferenceAdd(model, state, time, 1.0, *lin));
  } else PetscCall(ContactLinearize(model->contact, u, CONTACT_GAPS, lin));
  PetscFunctionReturn(0);
}

/* Linearizes the gap at u for a load step that ends at `time`. The ramps of initial overlaps are applied. */
PetscErrorCode ContactUpdateLinearize(Model model, State state, PetscReal time, Vec u, ContactLinearization *lin)
{
  PetscFunctionBegin;
  PetscCall(ContactLinearize(model->contact, u, CONTACT_FORCES, lin));
  PetscCall(InterferenceAdd(model, state, time, 1.0, *lin));
  PetscFunctionReturn(0);
}

/*
   Makes u a displacement in which rigid bodies that turn freely are rigid. An extrapolated u does not have this
   property, because a combination of rotations is not a rotation.
*/
static PetscErrorCode ContactUpdateMakeRigid(StepProblem *p, Vec u)
{
  const Constraints constraints = ModelConstraints(p->model);
  PetscReal         change;

  PetscFunctionBegin;
  if (!p->model->rigid.turns) PetscFunctionReturn(0);
  PetscCall(StepProblemTurn(p, u));
  PetscCall(TiesFollow(&p->model->ties, u));
  PetscCall(TiesStraighten(&constraints, p->time, u, &change));
  PetscFunctionReturn(0);
}

/*
   Finds whether pairs have friction, and whether friction allows to linearize the gap at the extrapolated path: no
   vertices stick, which they do where they close, no rigid body rolls, and the path is smooth. Otherwise bodies that
   friction holds might be lost.
*/
static PetscErrorCode ContactUpdateMayContinue(const StepProblem *p, PetscBool *rubs, PetscBool *may)
{
  PetscBool sticks = PETSC_FALSE;

  PetscFunctionBegin;
  *rubs = PETSC_FALSE;
  *may  = PETSC_TRUE;
  for (PetscInt k = 0; k < p->model->scene->npairs; ++k) {
    PetscReal mu = 0.0;

    PetscCall(FrictionGetCoefficient(p->model->scene, p->time, k, &mu));
    if (mu > 0.0) *rubs = PETSC_TRUE;
    if (mu >= PETSC_INFINITY) sticks = PETSC_TRUE;
  }
  if (*rubs) PetscCall(PathIsSmooth(p->model, p->state, p->time, may));
  if (sticks || (*rubs && p->model->rigid.turns)) *may = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/*
   Extrapolates the path. u: the last state on entry, the extrapolated displacement on exit. *continued: false if u is
   not changed, because friction does not allow it. With friction no body may rotate from the last state to the
   extrapolated one, since friction holds a body that rolls.
*/
static PetscErrorCode ContactUpdateContinue(const StepProblem *p, Vec u, PetscBool *continued)
{
  const Bodies bodies = ModelBodies(p->model);
  PetscBool    rubs, rolls;

  PetscFunctionBegin;
  PetscCall(ContactUpdateMayContinue(p, &rubs, continued));
  if (!*continued) PetscFunctionReturn(0);
  PetscCall(PathContinue(p->model, p->state, p->time, u));
  if (!rubs) PetscFunctionReturn(0);
  PetscCall(ArcsGetExcess(&bodies, p->state->path->u, u, NULL, &rolls));
  if (rolls) PetscCall(VecCopy(p->state->path->u, u));
  *continued = (PetscBool)!rolls;
  PetscFunctionReturn(0);
}

/*
   Sets state->solved->linearization, and creates *u_linearized, the displacement of this linearization. It is an
   extrapolation of the path if the gap may be linearized again; otherwise the last state. The last state is always used
   in the first load step and after a cut.
*/
PetscErrorCode ContactUpdateBegin(StepProblem *p, Vec u, const StepReport *report, Vec *u_linearized)
{
  PetscBool continues =
    (PetscBool)(p->state->path->time > 0.0 && p->model->scene->contact_updates > 1 && !report->cuts);

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, u_linearized));
  PetscCall(VecCopy(p->state->path->u, *u_linearized));
  PetscCall(ContactUpdateKeepDirections(p));
  if (continues) PetscCall(ContactUpdateContinue(p, *u_linearized, &continues));
  if (continues) {
    PetscCall(ContactUpdateMakeRigid(p, *u_linearized));
    PetscCall(ContactLinearizationDestroy(&p->state->solved->upcoming));
  }
  if (!p->state->solved->upcoming)
    PetscCall(ContactLinearize(p->model->contact, *u_linearized, CONTACT_FORCES, &p->state->solved->upcoming));
  p->state->solved->linearization = p->state->solved->upcoming;
  p->state->solved->upcoming      = NULL;
  PetscCall(InterferenceAdd(p->model, p->state, p->time, 1.0, p->state->solved->linearization));
  PetscFunctionReturn(0);
}

/*
   Moves u_linearized to the point at which the gap is linearized next, and linearizes the gap there. at_u: the
   linearization at the solution u on entry, the new linearization on exit.
*/
PetscErrorCode ContactUpdateNext(StepProblem *p, Anderson *secants, const ContactSolution *sol, Vec u, Vec u_linearized,
  StepReport *report, ContactLinearization *at_u)
{
  PetscBool damped, at_solution, found = PETSC_FALSE;
  PetscReal proximal;
  Vec       next;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &next));
  if (!p->holds_weak) PetscCall(ContactUpdateNewton(p, sol, *at_u, u_linearized, u, next, report, &found));
  PetscCall(ProximalMeasure(p, u, &proximal)); /* this force decreases as bodies on weak springs come to rest, whereas
                                                  the change of the gap need not decrease */
  PetscCall(AndersonAdvance(secants, p->holds_weak ? proximal : report->update_error, u, u_linearized, &damped));
  report->gap_damped += damped;
  p->by_newton = (PetscBool)(found && !damped);
  if (p->by_newton) PetscCall(VecCopy(next, u_linearized));
  PetscCall(VecDestroy(&next));
  PetscCall(VecEqual(u, u_linearized, &at_solution));
  PetscCall(ContactLinearizationDestroy(&p->state->solved->linearization));
  if (!at_solution || (*at_u)->gaps_only) {
    PetscCall(ContactLinearizationDestroy(at_u));
    PetscCall(ContactUpdateMakeRigid(p, u_linearized));
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u_linearized, at_u));
  }
  p->state->solved->linearization = *at_u;
  *at_u                           = NULL;
  PetscFunctionReturn(0);
}
