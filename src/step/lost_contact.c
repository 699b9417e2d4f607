/*
   Bodies that have lost contact: nothing else holds them, and no contact force acts on them. Their position in these
   free motions is arbitrary. The position nearest to that of the last state is chosen, and a warning says so.
*/
#include "stepimpl.h"
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"
#include "src/state/solution.h"

static const PetscReal no_force = 1e-9; /* largest force that counts as none, relative to the stiffness of the bodies
                                           times the largest displacement */

/* Computes the sum of the magnitudes of the work of the single forces, whose row r is that of A, on each free motion */
static PetscErrorCode LostContactGetWork(Mat A, const FreeMotions *m, Vec force, PetscReal work[])
{
  Mat rates;

  PetscFunctionBegin;
  PetscCall(MatMatMult(A, m->Z, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &rates));
  PetscCall(MatDiagonalScale(rates, force, NULL));
  PetscCall(MatGetColumnNorms(rates, NORM_1, work));
  PetscCall(MatDestroy(&rates));
  PetscFunctionReturn(0);
}

/* Computes the largest friction forces that the normal forces allow, along both tangents of each row [force] */
static PetscErrorCode LostContactGetBounds(const StepFriction *friction, Vec normal, Vec bounds)
{
  const PetscScalar *force, *limit, *coefficient;
  PetscScalar       *b;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(normal, &n));
  PetscCall(VecGetArrayRead(normal, &force));
  PetscCall(VecGetArrayRead(friction->limit, &limit));
  PetscCall(VecGetArrayRead(friction->coefficient, &coefficient));
  PetscCall(VecGetArrayWrite(bounds, &b));
  for (PetscInt r = 0; r < n; ++r) {
    const PetscBool acts = (PetscBool)(PetscRealPart(force[r]) > 0.0 && PetscRealPart(coefficient[r]) > 0.0);

    b[2 * r] = b[2 * r + 1] = acts ? PetscMin(PetscRealPart(coefficient[r] * force[r]), PetscRealPart(limit[r])) : 0.0;
  }
  PetscCall(VecRestoreArrayWrite(bounds, &b));
  PetscCall(VecRestoreArrayRead(friction->coefficient, &coefficient));
  PetscCall(VecRestoreArrayRead(friction->limit, &limit));
  PetscCall(VecRestoreArrayRead(normal, &force));
  PetscFunctionReturn(0);
}

/* Finds the free motions that no contact force resists: normal forces do no work on them, and neither would friction if
   the bodies slipped. unheld: 1 for each of them, 0 for the others */
static PetscErrorCode LostContactFind(const StepProblem *p, const FreeMotions *m, Vec u, const ContactSolution *sol,
  Vec unheld, PetscBool *any)
{
  ContactLinearization lin = p->state->solved->linearization;
  PetscReal           *normal, *shear, size;
  Vec                  weighted, bounds;

  PetscFunctionBegin;
  *any = PETSC_FALSE;
  PetscCall(PetscCalloc2(m->n, &normal, m->n, &shear));
  PetscCall(VecDuplicate(sol->pressure, &weighted));
  PetscCall(VecPointwiseMult(weighted, sol->pressure, lin->mass));
  PetscCall(LostContactGetWork(lin->J, m, weighted, normal));
  if (sol->shear) {
    PetscCall(VecDuplicate(sol->shear, &bounds));
    PetscCall(LostContactGetBounds(&p->friction, weighted, bounds));
    PetscCall(LostContactGetWork(lin->slip, m, bounds, shear));
    PetscCall(VecDestroy(&bounds));
  }
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  for (PetscInt k = 0; k < m->n; ++k) {
    if (normal[k] + shear[k] > no_force * p->model->stiffness * size) continue;
    PetscCall(VecSetValue(unheld, k, 1.0, INSERT_VALUES));
    *any = PETSC_TRUE;
  }
  PetscCall(VecAssemblyBegin(unheld));
  PetscCall(VecAssemblyEnd(unheld));
  PetscCall(VecDestroy(&weighted));
  PetscCall(PetscFree2(normal, shear));
  PetscFunctionReturn(0);
}

/*
   The position of bodies by their unheld motions c that is nearest to the last state in the mean: the minimum of
   c^T G c / 2 - b^T c with gap + rates c >= 0
*/
typedef struct {
  Mat Z, G, rates; /* Z: one column for each motion, the displacements of the nodes; zero if it is held */
  Vec c, b, gap;   /* gap: at c = 0, not owned */
} NearestPlace;

static PetscErrorCode NearestPlaceCreate(Model model, State state, const FreeMotions *m, Vec unheld, Vec u, Vec gap,
  NearestPlace *n)
{
  Mat weighted;
  Vec back;

  PetscFunctionBegin;
  n->gap = gap;
  PetscCall(MatDuplicate(m->Z, MAT_COPY_VALUES, &n->Z));
  PetscCall(MatDiagonalScale(n->Z, NULL, unheld));
  PetscCall(MatDuplicate(n->Z, MAT_COPY_VALUES, &weighted));
  PetscCall(MatDiagonalScale(weighted, model->mass, NULL));
  PetscCall(MatTransposeMatMult(n->Z, weighted, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &n->G));
  PetscCall(MatMatMult(state->solved->linearization->J, n->Z, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &n->rates));
  PetscCall(MatCreateVecs(n->G, &n->c, &n->b));
  PetscCall(VecDuplicate(u, &back));
  PetscCall(VecWAXPY(back, -1.0, u, state->path->u));
  PetscCall(MatMultTranspose(weighted, back, n->b));
  PetscCall(VecSet(n->c, 1.0));
  PetscCall(VecAXPY(n->c, -1.0, unheld));
  PetscCall(MatDiagonalSet(n->G, n->c, ADD_VALUES)); /* motions that are held remain as they are */
  PetscCall(VecDestroy(&back));
  PetscCall(MatDestroy(&weighted));
  PetscFunctionReturn(0);
}

static PetscErrorCode NearestPlaceDestroy(NearestPlace *n)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&n->c));
  PetscCall(VecDestroy(&n->b));
  PetscCall(MatDestroy(&n->rates));
  PetscCall(MatDestroy(&n->G));
  PetscCall(MatDestroy(&n->Z));
  PetscFunctionReturn(0);
}

static PetscErrorCode NearestPlaceObjective(Tao tao, Vec c, PetscReal *f, Vec g, void *data)
{
  const NearestPlace *n = (NearestPlace *)data;
  PetscScalar         cGc, bc;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(MatMult(n->G, c, g));
  PetscCall(VecDot(g, c, &cGc));
  PetscCall(VecDot(n->b, c, &bc));
  PetscCall(VecAXPY(g, -1.0, n->b));
  *f = PetscRealPart(0.5 * cGc - bc);
  PetscFunctionReturn(0);
}

static PetscErrorCode NearestPlaceGaps(Tao tao, Vec c, Vec gaps, void *data)
{
  const NearestPlace *n = (NearestPlace *)data;

  PetscFunctionBegin;
  (void)tao;
  PetscCall(MatMultAdd(n->rates, c, n->gap, gaps));
  PetscFunctionReturn(0);
}

/* Does nothing: the Hessian G and the Jacobian `rates` are constant */
static PetscErrorCode NearestPlaceConstant(Tao tao, Vec c, Mat A, Mat P, void *data)
{
  PetscFunctionBegin;
  (void)tao;
  (void)c;
  (void)A;
  (void)P;
  (void)data;
  PetscFunctionReturn(0);
}

/*
   Computes the displacement w to the nearest place; zero if it is not found. penetrates: whether gaps may become
   negative. Options: those of TAOIPFILTER with the prefix lost_contact_
*/
static PetscErrorCode NearestPlaceSolve(NearestPlace *n, PetscBool penetrates, Vec w)
{
  Tao                tao;
  Vec                gaps;
  TaoConvergedReason reason;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(n->c));
  PetscCall(VecDuplicate(n->gap, &gaps));
  PetscCall(TaoCreate(PetscObjectComm((PetscObject)w), &tao));
  PetscCall(TaoSetOptionsPrefix(tao, "lost_contact_"));
  PetscCall(TaoSetType(tao, TAOIPFILTER));
  PetscCall(TaoSetSolution(tao, n->c));
  PetscCall(TaoSetObjectiveAndGradient(tao, NULL, NearestPlaceObjective, n));
  PetscCall(TaoSetHessian(tao, n->G, n->G, NearestPlaceConstant, n));
  if (!penetrates) {
    PetscCall(TaoSetInequalityConstraintsRoutine(tao, gaps, NearestPlaceGaps, n));
    PetscCall(TaoSetJacobianInequalityRoutine(tao, n->rates, n->rates, NearestPlaceConstant, n));
  }
  PetscCall(TaoSetFromOptions(tao));
  PetscCall(TaoSolve(tao));
  PetscCall(TaoGetConvergedReason(tao, &reason));
  if (reason > 0) PetscCall(MatMult(n->Z, n->c, w));
  else PetscCall(VecZeroEntries(w));
  PetscCall(TaoDestroy(&tao));
  PetscCall(VecDestroy(&gaps));
  PetscFunctionReturn(0);
}

/* Adds w to u. At finite strain a large rotation w would strain the bodies; u then remains. */
static PetscErrorCode LostContactMove(Model model, State state, Vec w, Vec u, ContactSolution *sol)
{
  PetscReal before, after, size;
  Vec       moved;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &moved));
  PetscCall(VecWAXPY(moved, 1.0, w, u));
  PetscCall(ElasticityEnergy(model->elasticity, u, &before));
  PetscCall(ElasticityEnergy(model->elasticity, moved, &after));
  PetscCall(VecNorm(w, NORM_INFINITY, &size));
  if (after <= before + no_force * model->stiffness * PetscSqr(size)) {
    PetscCall(VecCopy(moved, u));
    PetscCall(MatMultAdd(state->solved->linearization->J, w, sol->gap, sol->gap));
  }
  PetscCall(VecDestroy(&moved));
  PetscFunctionReturn(0);
}

/*
   Finds the bodies on which contact forces above `least` act. at: linearization with the rows of the pressures; NULL:
   no contact
*/
static PetscErrorCode LostContactFindTouched(Model model, ContactLinearization at, Vec pressure, PetscReal least,
  PetscBool touched[])
{
  const Scene        scene = model->scene;
  const PetscScalar *z = NULL, *mass = NULL;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) touched[b] = PETSC_FALSE;
  if (at) {
    PetscCall(VecGetArrayRead(pressure, &z));
    PetscCall(VecGetArrayRead(at->mass, &mass));
  }
  for (PetscInt r = 0; at && r < at->nlocal; ++r) {
    const SceneContactPair *pair = &scene->pairs[at->pair[r]];

    if (!(PetscRealPart(z[r] * mass[r]) > least) || pair->self) continue;
    touched[SceneFaceBody(scene, pair->mortar) - scene->bodies]    = PETSC_TRUE;
    touched[SceneFaceBody(scene, pair->nonmortar) - scene->bodies] = PETSC_TRUE;
  }
  if (at) {
    PetscCall(VecRestoreArrayRead(at->mass, &mass));
    PetscCall(VecRestoreArrayRead(pressure, &z));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, touched, (PetscMPIInt)scene->nbodies, MPI_PETSCBOOL, MPI_LOR, model->comm));
  PetscFunctionReturn(0);
}

/*
   Reports bodies that have lost contact, whose motion w, the way back to the last state, is arbitrary. A body on which
   contact forces act is none, though nothing may resist its slip. Warns, once in a run, if contact forces acted on such
   a body before, or if w is larger than the motions of all other bodies. Rejects the solution u if such a body is
   farther away from its last position than the bodies are large, and than all bodies in contact have moved: its next
   position would be as arbitrary. last: linearization of the last state
*/
static PetscErrorCode LostContactReport(Model model, State state, RunReport *run, ContactLinearization last, Vec w,
  Vec u, const ContactSolution *sol, StepReport *report)
{
  const Scene scene = model->scene;
  PetscReal  *moved, *lost, extent, least;
  PetscBool  *touched, *touches;
  Vec         increment;

  PetscFunctionBegin;
  PetscCall(
    PetscMalloc4(scene->nbodies, &moved, scene->nbodies, &lost, scene->nbodies, &touched, scene->nbodies, &touches));
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, state->path->u, u));
  PetscCall(VertexPlacesLargest(&model->places, increment, scene->nbodies, moved));
  PetscCall(VertexPlacesLargest(&model->places, w, scene->nbodies, lost));
  PetscCall(VecDestroy(&increment));
  PetscCall(VecNorm(model->places.x, NORM_INFINITY, &extent));
  PetscCall(VecNorm(u, NORM_INFINITY, &least));
  least *= no_force * model->stiffness;
  PetscCall(LostContactFindTouched(model, last, state->solved->solution.pressure, least, touched));
  PetscCall(LostContactFindTouched(model, state->solved->linearization, sol->pressure, least, touches));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    PetscReal others = 0.0, held = 0.0; /* motions of all other bodies, and of those that have not lost contact */

    for (PetscInt c = 0; c < scene->nbodies; ++c) {
      if (c != b) others = PetscMax(others, moved[c]);
      if (!(lost[c] > 0.0)) held = PetscMax(held, moved[c]);
    }
    if (!(lost[b] > 0.0) || touches[b]) continue;
    if (!state->control->lost_contact && (touched[b] || lost[b] > others)) {
      state->control->lost_contact = PETSC_TRUE;
      PetscCall(ReportWarn(model->comm, run, scene->bodies[b].place,
        "body \"%s\" slips away in load step %" PetscInt_FMT
        ": it has lost contact, and nothing else holds it. Its position is arbitrary, and the nearest one to that "
        "before is chosen: hold it by displacements or springs, or use smaller load steps",
        scene->bodies[b].name, report->step));
    }
    if (!report->converged || moved[b] <= PetscMax(held, 2.0 * extent)) continue;
    PetscCall(
      ReportReason(report, PETSC_FALSE, "body \"%s\" slips away by %g: it has lost contact, and nothing else holds it",
        scene->bodies[b].name, (double)moved[b]));
  }
  PetscCall(PetscFree4(moved, lost, touched, touches));
  PetscFunctionReturn(0);
}

/*
   Collective. Moves bodies that have lost contact in the solution u to the nearest position to the last state, whose
   linearization is `last`. *at_u: linearization at u
*/
PetscErrorCode LostContactSettle(const StepProblem *p, ContactLinearization last, Vec u, ContactSolution *sol,
  ContactLinearization *at_u, StepReport *report)
{
  FreeMotions  m;
  NearestPlace place;
  PetscBool    any = PETSC_FALSE;
  Vec          unheld, w, back;

  PetscFunctionBegin;
  if (!report->converged || ModelIsDynamic(p->model)) PetscFunctionReturn(0);
  PetscCall(FreeMotionsCreate(p->model, p->state, &m));
  PetscCall(MatCreateVecs(m.Z, &unheld, &w));
  if (m.n) PetscCall(LostContactFind(p, &m, u, sol, unheld, &any));
  if (any) {
    PetscCall(VecDuplicate(w, &back));
    PetscCall(NearestPlaceCreate(p->model, p->state, &m, unheld, u, sol->gap, &place));
    PetscCall(NearestPlaceSolve(&place, PETSC_TRUE, back));
    PetscCall(NearestPlaceSolve(&place, PETSC_FALSE, w));
    PetscCall(NearestPlaceDestroy(&place));
    PetscCall(LostContactMove(p->model, p->state, w, u, sol));
    PetscCall(LostContactReport(p->model, p->state, &p->sim->report, last, back, u, sol, report));
    PetscCall(VecDestroy(&back));
    PetscCall(ContactLinearizationDestroy(at_u));
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u, at_u));
  }
  PetscCall(VecDestroy(&unheld));
  PetscCall(VecDestroy(&w));
  PetscCall(FreeMotionsDestroy(&m));
  PetscFunctionReturn(0);
}
