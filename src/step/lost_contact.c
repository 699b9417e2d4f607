/*
   Bodies that have lost contact: nothing else holds them, and no contact force acts on them. Their position in these
   free motions is arbitrary. The position nearest to that of the last state is chosen, and a warning says so.
*/
#include "stepimpl.h"
#include <petscblaslapack.h>
#include "src/state/contact_state.h"
#include "src/state/control.h"
#include "src/state/path.h"
#include "src/state/solution.h"

static const PetscReal no_force = 1e-9; /* largest force that counts as none, relative to the stiffness of the bodies
                                           times the largest displacement */

/* Adds the magnitudes of the work of forces, whose row r is that of A, on the free motions */
static PetscErrorCode LostContactAddWork(Mat A, const FreeMotions *m, Vec force, Vec mass, PetscReal work[])
{
  const PetscScalar *f, *a = NULL;
  PetscInt           first, end;
  Mat                rates;

  PetscFunctionBegin;
  PetscCall(MatMatMult(A, m->Z, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &rates));
  PetscCall(MatGetOwnershipRange(rates, &first, &end));
  PetscCall(VecGetArrayRead(force, &f));
  if (mass) PetscCall(VecGetArrayRead(mass, &a));
  for (PetscInt r = first; r < end; ++r) {
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           n;

    PetscCall(MatGetRow(rates, r, &n, &columns, &values));
    for (PetscInt k = 0; k < n; ++k)
      work[columns[k]] += PetscAbsScalar(f[r - first] * values[k] * (a ? a[r - first] : 1.0));
    PetscCall(MatRestoreRow(rates, r, &n, &columns, &values));
  }
  if (mass) PetscCall(VecRestoreArrayRead(mass, &a));
  PetscCall(VecRestoreArrayRead(force, &f));
  PetscCall(MatDestroy(&rates));
  PetscFunctionReturn(0);
}

/* Finds the free motions on which no contact force does work. unheld[k]: position of motion k among them; -1 if one
   does */
static PetscErrorCode LostContactFind(Model model, State state, const FreeMotions *m, Vec u, const ContactSolution *sol,
  PetscInt unheld[], PetscInt *n)
{
  ContactLinearization lin = state->solved->linearization;
  PetscReal           *work, size;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(PetscCalloc1(m->n, &work));
  PetscCall(LostContactAddWork(lin->J, m, sol->pressure, lin->mass, work));
  if (sol->shear) PetscCall(LostContactAddWork(lin->slip, m, sol->shear, NULL, work));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, work, (PetscMPIInt)m->n, MPIU_REAL, MPIU_SUM, model->comm));
  PetscCall(VecNorm(u, NORM_INFINITY, &size));
  for (PetscInt k = 0; k < m->n; ++k) unheld[k] = work[k] <= no_force * model->stiffness * size ? (*n)++ : -1;
  PetscCall(PetscFree(work));
  PetscFunctionReturn(0);
}

/* Computes the displacement w in n unheld motions that brings u nearest to the last state in the mean */
static PetscErrorCode LostContactFit(Model model, State state, const FreeMotions *m, const PetscInt unheld[],
  PetscInt n, Vec u, Vec w)
{
  const PetscBLASInt one = 1;
  const PetscScalar *mass, *before, *now;
  PetscBLASInt       size, info, *pivots;
  PetscReal         *G, *b, *motion;
  PetscInt           first, end;

  PetscFunctionBegin;
  PetscCall(PetscCalloc4(n * n, &G, n, &b, m->n, &motion, n, &pivots));
  PetscCall(VecGetOwnershipRange(u, &first, &end));
  PetscCall(VecGetArrayRead(model->mass, &mass));
  PetscCall(VecGetArrayRead(state->path->u, &before));
  PetscCall(VecGetArrayRead(u, &now));
  for (PetscInt i = first; i < end; ++i) {
    const PetscReal    a = PetscRealPart(mass[i - first]), way = PetscRealPart(before[i - first] - now[i - first]);
    const PetscInt    *columns;
    const PetscScalar *values;
    PetscInt           ncolumns;

    PetscCall(MatGetRow(m->Z, i, &ncolumns, &columns, &values));
    for (PetscInt k = 0; k < ncolumns; ++k) {
      const PetscInt row = unheld[columns[k]];

      if (row < 0) continue;
      b[row] += a * way * PetscRealPart(values[k]);
      for (PetscInt j = 0; j < ncolumns; ++j)
        if (unheld[columns[j]] >= 0) G[n * row + unheld[columns[j]]] += a * PetscRealPart(values[k] * values[j]);
    }
    PetscCall(MatRestoreRow(m->Z, i, &ncolumns, &columns, &values));
  }
  PetscCall(VecRestoreArrayRead(u, &now));
  PetscCall(VecRestoreArrayRead(state->path->u, &before));
  PetscCall(VecRestoreArrayRead(model->mass, &mass));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, G, (PetscMPIInt)(n * n), MPIU_REAL, MPIU_SUM, model->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, b, (PetscMPIInt)n, MPIU_REAL, MPIU_SUM, model->comm));
  PetscCall(PetscBLASIntCast(n, &size));
  PetscCallBLAS("LAPACKgesv", LAPACKgesv_(&size, &one, G, &size, pivots, b, &size, &info));
  for (PetscInt k = 0; k < m->n && !info; ++k) motion[k] = unheld[k] >= 0 ? b[unheld[k]] : 0.0;
  PetscCall(FreeMotionsDisplace(m, motion, w));
  PetscCall(PetscFree4(G, b, motion, pivots));
  PetscFunctionReturn(0);
}

/*
   Adds to u as much of w as contact allows: no gap becomes negative. At finite strain a large rotation w would strain
   the bodies; u then remains.
*/
static PetscErrorCode LostContactMove(Model model, State state, Vec w, Vec u, ContactSolution *sol)
{
  const PetscScalar *g, *a;
  PetscReal          part = 1.0, before, after, size;
  PetscInt           n;
  Vec                rates, moved;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sol->gap, &rates));
  PetscCall(VecDuplicate(u, &moved));
  PetscCall(MatMult(state->solved->linearization->J, w, rates));
  PetscCall(VecGetLocalSize(rates, &n));
  PetscCall(VecGetArrayRead(rates, &a));
  PetscCall(VecGetArrayRead(sol->gap, &g));
  for (PetscInt r = 0; r < n; ++r) {
    if (PetscRealPart(g[r] + a[r]) < 0.0 && PetscRealPart(a[r]) < 0.0)
      part = PetscMin(part, PetscMax(PetscRealPart(g[r]), 0.0) / -PetscRealPart(a[r]));
  }
  PetscCall(VecRestoreArrayRead(sol->gap, &g));
  PetscCall(VecRestoreArrayRead(rates, &a));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &part, 1, MPIU_REAL, MPIU_MIN, model->comm));
  PetscCall(VecWAXPY(moved, part, w, u));
  PetscCall(ElasticityEnergy(model->elasticity, u, &before));
  PetscCall(ElasticityEnergy(model->elasticity, moved, &after));
  PetscCall(VecNorm(w, NORM_INFINITY, &size));
  if (after <= before + no_force * model->stiffness * PetscSqr(part * size)) {
    PetscCall(VecCopy(moved, u));
    PetscCall(VecAXPY(sol->gap, part, rates));
  }
  PetscCall(VecDestroy(&moved));
  PetscCall(VecDestroy(&rates));
  PetscFunctionReturn(0);
}

/* Finds the bodies on which contact forces acted at the last state */
static PetscErrorCode LostContactFindTouched(Model model, State state, ContactLinearization last, PetscBool touched[])
{
  const Scene scene = model->scene;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) touched[b] = PETSC_FALSE;
  for (PetscInt r = 0; last && r < last->nlocal; ++r) {
    const SceneContactPair *pair = &scene->pairs[last->pair[r]];

    if (!(state->solved->pressure[r] > 0.0) || pair->self) continue;
    touched[SceneFaceBody(scene, pair->mortar) - scene->bodies]    = PETSC_TRUE;
    touched[SceneFaceBody(scene, pair->nonmortar) - scene->bodies] = PETSC_TRUE;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, touched, (PetscMPIInt)scene->nbodies, MPI_PETSCBOOL, MPI_LOR, model->comm));
  PetscFunctionReturn(0);
}

/*
   Warns, once in a run, of a body that has lost contact: contact forces acted on it before, or its arbitrary motion w
   is larger than the motions of all other bodies
*/
static PetscErrorCode LostContactWarn(Model model, State state, RunReport *report, ContactLinearization last, Vec w,
  Vec u, PetscInt step)
{
  const Scene scene = model->scene;
  PetscReal  *moved, *lost, others;
  PetscBool  *touched;
  Vec         increment;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(scene->nbodies, &moved, scene->nbodies, &lost, scene->nbodies, &touched));
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, state->path->u, u));
  PetscCall(VertexPlacesLargest(&model->places, increment, scene->nbodies, moved));
  PetscCall(VertexPlacesLargest(&model->places, w, scene->nbodies, lost));
  PetscCall(VecDestroy(&increment));
  PetscCall(LostContactFindTouched(model, state, last, touched));
  for (PetscInt b = 0; b < scene->nbodies && !state->control->lost_contact; ++b) {
    others = 0.0;
    for (PetscInt c = 0; c < scene->nbodies; ++c)
      if (c != b) others = PetscMax(others, moved[c]);
    if (!(lost[b] > 0.0) || (!touched[b] && lost[b] <= others)) continue;
    state->control->lost_contact = PETSC_TRUE;
    PetscCall(ReportWarn(model->comm, report, scene->bodies[b].place,
      "body \"%s\" slips away in load step %" PetscInt_FMT
      ": it has lost contact, and nothing else holds it. Its position is arbitrary, and the nearest one to that before "
      "is chosen: hold it by displacements or springs, or use smaller load steps",
      scene->bodies[b].name, step));
  }
  PetscCall(PetscFree3(moved, lost, touched));
  PetscFunctionReturn(0);
}

/*
   Rejects the solution u if a body with the arbitrary motion w is farther away from its last position than the bodies
   are large, and than all other bodies have moved. The next position of such a body would be as arbitrary.
*/
static PetscErrorCode LostContactReject(Model model, State state, Vec w, Vec u, StepReport *report)
{
  const Scene scene = model->scene;
  PetscReal  *moved, *lost, extent, others = 0.0;
  char        reason[256];
  Vec         increment;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &moved, scene->nbodies, &lost));
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, state->path->u, u));
  PetscCall(VertexPlacesLargest(&model->places, increment, scene->nbodies, moved));
  PetscCall(VertexPlacesLargest(&model->places, w, scene->nbodies, lost));
  PetscCall(VecDestroy(&increment));
  PetscCall(VecNorm(model->places.x, NORM_INFINITY, &extent));
  for (PetscInt b = 0; b < scene->nbodies; ++b)
    if (!(lost[b] > 0.0)) others = PetscMax(others, moved[b]);
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (!(lost[b] > 0.0) || moved[b] <= PetscMax(others, 2.0 * extent)) continue;
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "body \"%s\" slips away by %g: it has lost contact, and nothing else holds it", scene->bodies[b].name,
      (double)moved[b]));
    PetscCall(ReportReason(report, PETSC_FALSE, reason));
    break;
  }
  PetscCall(PetscFree2(moved, lost));
  PetscFunctionReturn(0);
}

/*
   Collective. Moves bodies that have lost contact in the solution u to the nearest position to the last state, whose
   linearization is `last`. *at_u: linearization at u
*/
PetscErrorCode LostContactSettle(const StepProblem *p, ContactLinearization last, Vec u, ContactSolution *sol,
  ContactLinearization *at_u, StepReport *report)
{
  Simulation  sim = p->sim;
  FreeMotions m;
  PetscInt   *unheld, n;
  Vec         w;

  PetscFunctionBegin;
  if (!report->converged || ModelIsDynamic(p->model)) PetscFunctionReturn(0);
  PetscCall(FreeMotionsCreate(p->model, p->state, &m));
  PetscCall(PetscMalloc1(m.n, &unheld));
  if (m.n) PetscCall(LostContactFind(p->model, p->state, &m, u, sol, unheld, &n));
  if (m.n && n) {
    PetscCall(VecDuplicate(u, &w));
    PetscCall(LostContactFit(p->model, p->state, &m, unheld, n, u, w));
    PetscCall(LostContactWarn(sim->model, sim->state, &sim->report, last, w, u, report->step));
    PetscCall(LostContactMove(p->model, p->state, w, u, sol));
    PetscCall(LostContactReject(p->model, p->state, w, u, report));
    PetscCall(ContactLinearizationDestroy(at_u));
    PetscCall(ContactUpdateLinearize(p->model, p->state, p->time, u, PETSC_FALSE, at_u));
    PetscCall(VecDestroy(&w));
  }
  PetscCall(PetscFree(unheld));
  PetscCall(FreeMotionsDestroy(&m));
  PetscFunctionReturn(0);
}
