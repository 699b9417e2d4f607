/*
   Coulomb friction. The friction force tau of a contact row is a vector with two components along the tangents of the
   row. It depends on the slip since the last equilibrium state:
       |tau| <= b,  tau = -b slip/|slip| if slip != 0,  b = min(limit, coefficient x normal force of the row).
     The optimizer treats these laws as norm terms. Between solves the forces are stored in global coordinates, since
     the tangents belong to one linearization.
*/
#include "problemimpl.h"
#include <vector3.h>
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"
#include "src/state/path.h"

/*
   Sets limit and coefficient of each row. A pair with `stick: true` has the coefficient 1,000, because with an infinite
   coefficient the force bound of a vertex with zero pressure would be undetermined. Vertices that have opened in this
   load step are free; those that have closed again stick from the next load step on.
*/
static PetscErrorCode FrictionSetCoefficients(StepProblem *p, ContactLinearization lin)
{
  const PetscReal    share = StepProblemShare(p);
  Scene              scene = p->model->scene;
  const PetscScalar *mass;
  PetscScalar       *limit, *coefficient;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  PetscCall(VecGetArrayWrite(p->friction.limit, &limit));
  PetscCall(VecGetArrayWrite(p->friction.coefficient, &coefficient));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    const SceneContactPair *pair = &scene->pairs[lin->pair[r]];
    PetscReal               mu   = 0.0;

    PetscCall(FrictionGetCoefficient(scene, p->time, lin->pair[r], &mu));
    limit[r] = pair->shear_limit < PETSC_INFINITY ? pair->shear_limit * PetscRealPart(mass[r]) / share : PETSC_INFINITY;
    coefficient[r] = mu;
    if (p->state->history->released[ContactHistoryIndex(p->state->history, lin, r)]) coefficient[r] = 0.0;
  }
  PetscCall(VecRestoreArrayWrite(p->friction.coefficient, &coefficient));
  PetscCall(VecRestoreArrayWrite(p->friction.limit, &limit));
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscFunctionReturn(0);
}

/* Adds to the slip of the rows `factor` times the slip before vertices have stuck at another place */
static PetscErrorCode FrictionAddShift(const ContactHistory *m, ContactLinearization lin, PetscReal factor, Vec slip)
{
  PetscScalar *s;

  PetscFunctionBegin;
  PetscCall(VecGetArray(slip, &s));
  for (PetscInt r = 0; r < 2 * lin->nlocal; ++r)
    s[r] += factor * VectorDot(&lin->tangent[3 * r], &m->shift[3 * ContactHistoryIndex(m, lin, r / 2)]);
  PetscCall(VecRestoreArray(slip, &s));
  PetscFunctionReturn(0);
}

/*
   Computes T and t with which the slip is slip = T u + t. With the full matrix T_full of the linearization the slip is
   T (u - base) + T_full (base - path.u), where T is T_full without the columns of prescribed displacements. mask: 0 in
   prescribed rows, 1 elsewhere. If bodies turn, the path to u_linearized is measured along arcs.
*/
PetscErrorCode FrictionSetUp(StepProblem *p, ContactLinearization lin, Vec u_linearized, Vec mask)
{
  const Bodies  bodies = ModelBodies(p->model);
  StepFriction *f      = &p->friction;
  PetscBool     turned;
  Vec           moved;

  PetscFunctionBegin;
  PetscCall(FrictionDestroy(f));
  if (!lin->slip) PetscFunctionReturn(0);
  if (p->model->ties.C) PetscCall(MatMatMult(lin->slip, p->model->ties.C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &f->T));
  else PetscCall(MatDuplicate(lin->slip, MAT_COPY_VALUES, &f->T));
  PetscCall(MatDiagonalScale(f->T, NULL, mask));
  PetscCall(MatCreateVecs(f->T, NULL, &f->t));
  PetscCall(VecDuplicate(f->t, &moved));
  PetscCall(VecWAXPY(p->w, -1.0, p->state->path->u, p->base));
  PetscCall(MatMult(lin->slip, p->w, f->t));
  PetscCall(MatMult(f->T, p->base, moved));
  PetscCall(VecAXPY(f->t, -1.0, moved));
  PetscCall(ArcsGetExcess(&bodies, p->state->path->u, u_linearized, p->w, &turned));
  if (turned) PetscCall(MatMultAdd(lin->slip, p->w, f->t, f->t));
  PetscCall(VecDestroy(&moved));
  PetscCall(FrictionAddShift(p->state->history, lin, -1.0, f->t));
  PetscCall(VecDuplicate(f->t, &f->t_given));
  PetscCall(VecCopy(f->t, f->t_given));
  PetscCall(VecDuplicate(lin->g, &f->limit));
  PetscCall(VecDuplicate(lin->g, &f->coefficient));
  PetscCall(FrictionSetCoefficients(p, lin));
  PetscFunctionReturn(0);
}

/* Copies what the optimizer changes; the matrix is shared */
PetscErrorCode FrictionCopy(const StepFriction *f, StepFriction *copy)
{
  const Vec  from[] = {f->t, f->t_given, f->limit, f->coefficient};
  Vec *const to[]   = {&copy->t, &copy->t_given, &copy->limit, &copy->coefficient};

  PetscFunctionBegin;
  copy->T = f->T;
  if (!f->T) PetscFunctionReturn(0);
  PetscCall(PetscObjectReference((PetscObject)f->T));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(to); ++k) {
    PetscCall(VecDuplicate(from[k], to[k]));
    PetscCall(VecCopy(from[k], *to[k]));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode FrictionDestroy(StepFriction *f)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&f->T));
  PetscCall(VecDestroy(&f->t));
  PetscCall(VecDestroy(&f->t_given));
  PetscCall(VecDestroy(&f->limit));
  PetscCall(VecDestroy(&f->coefficient));
  PetscFunctionReturn(0);
}

/* Passes the friction laws to the optimizer, and the stored forces times `scale` as a start. */
PetscErrorCode FrictionGive(StepProblem *p, Tao tao, PetscReal scale)
{
  ContactLinearization  lin = p->state->solved->linearization;
  const ContactHistory *m   = p->state->history;
  PetscScalar          *f;
  Vec                   force;

  PetscFunctionBegin;
  if (!p->friction.T) PetscFunctionReturn(0);
  PetscCall(TaoIPFilterSetNormTerms(tao, p->friction.T, p->friction.t, p->friction.limit, p->friction.coefficient));
  PetscCall(VecDuplicate(p->friction.t, &force));
  PetscCall(VecGetArrayWrite(force, &f));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    const PetscReal *kept = &m->shear[3 * ContactHistoryIndex(m, lin, r)];

    for (PetscInt a = 0; a < 2; ++a) {
      const PetscReal *t = &lin->tangent[6 * r + 3 * a];

      f[2 * r + a] = scale / StepProblemShare(p) * (t[0] * kept[0] + t[1] * kept[1] + t[2] * kept[2]);
    }
  }
  PetscCall(VecRestoreArrayWrite(force, &f));
  PetscCall(TaoIPFilterSetNormTermForces(tao, force));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/* Makes all vertices stick where they are, at the beginning of a load step */
PetscErrorCode FrictionRestart(StepProblem *p)
{
  ContactHistory *m = p->state->history;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(m->released, m->npairs * m->nowned));
  if (m->shift) PetscCall(PetscArrayzero(m->shift, 3 * m->npairs * m->nowned));
  PetscFunctionReturn(0);
}

/*
   Stores what the optimizer has changed at vertices that must stick. Vertices whose coefficients it has set to zero are
   free. Other vertices have opened and stuck again, and it has shifted the positions from which their slip is measured.
*/
static PetscErrorCode FrictionKeepReleased(StepProblem *p)
{
  ContactLinearization lin = p->state->solved->linearization;
  ContactHistory      *m   = p->state->history;
  const PetscScalar   *coefficient, *t, *given;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(p->friction.t, &t));
  PetscCall(VecGetArrayRead(p->friction.t_given, &given));
  for (PetscInt r = 0; r < 2 * lin->nlocal; ++r) {
    PetscReal *shift = &m->shift[3 * ContactHistoryIndex(m, lin, r / 2)];

    for (PetscInt c = 0; c < 3; ++c) shift[c] += PetscRealPart(given[r] - t[r]) * lin->tangent[3 * r + c];
  }
  PetscCall(VecRestoreArrayRead(p->friction.t_given, &given));
  PetscCall(VecRestoreArrayRead(p->friction.t, &t));
  PetscCall(VecCopy(p->friction.t, p->friction.t_given));
  PetscCall(VecGetArrayRead(p->friction.coefficient, &coefficient));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    PetscReal mu = 0.0;

    PetscCall(FrictionGetCoefficient(p->model->scene, p->time, lin->pair[r], &mu));
    if (mu > 0.0 && PetscRealPart(coefficient[r]) == 0.0) m->released[ContactHistoryIndex(m, lin, r)] = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayRead(p->friction.coefficient, &coefficient));
  PetscFunctionReturn(0);
}

/* Stores friction forces and slips of the solution u in sol, and the forces in the contact history. */
PetscErrorCode FrictionKeep(StepProblem *p, Tao tao, Vec u, ContactSolution *sol)
{
  ContactLinearization lin = p->state->solved->linearization;
  ContactHistory      *m   = p->state->history;
  const PetscScalar   *f;
  Vec                  force;

  PetscFunctionBegin;
  if (!p->friction.T) PetscFunctionReturn(0);
  PetscCall(TaoIPFilterGetNormTermForces(tao, &force));
  PetscCall(VecDuplicate(force, &sol->shear));
  PetscCall(VecDuplicate(force, &sol->slip));
  PetscCall(VecAXPBY(sol->shear, StepProblemShare(p), 0.0, force));
  PetscCall(MatMultAdd(p->friction.T, u, p->friction.t, sol->slip));
  PetscCall(FrictionKeepReleased(p));
  PetscCall(FrictionAddShift(m, lin, 1.0, sol->slip));
  PetscCall(PetscArrayzero(m->shear, 3 * m->npairs * m->nowned));
  PetscCall(VecGetArrayRead(sol->shear, &f));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    for (PetscInt c = 0; c < 3; ++c)
      m->shear[3 * ContactHistoryIndex(m, lin, r) + c] =
        PetscRealPart(f[2 * r] * lin->tangent[6 * r + c] + f[2 * r + 1] * lin->tangent[6 * r + 3 + c]);
  }
  PetscCall(VecRestoreArrayRead(sol->shear, &f));
  PetscFunctionReturn(0);
}

/* Stores slips at u, and that there are no friction forces */
PetscErrorCode FrictionKeepNone(const StepProblem *p, Vec u, ContactSolution *sol)
{
  ContactHistory *m = p->state->history;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(m->shear, 3 * m->npairs * m->nowned));
  if (!p->friction.T) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(p->friction.t, &sol->shear));
  PetscCall(VecZeroEntries(sol->shear));
  PetscCall(VecDuplicate(p->friction.t, &sol->slip));
  PetscCall(MatMultAdd(p->friction.T, u, p->friction.t, sol->slip));
  PetscFunctionReturn(0);
}
