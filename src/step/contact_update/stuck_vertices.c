/* Names vertices at which contact updates do not converge, or which have no way out of the other body */
#include "contact_updateimpl.h"
#include "src/state/contact_history.h"
#include "src/state/contact_state.h"

/* A vertex of a pair's nonmortar face */
typedef struct {
  PetscReal error;        /* see PlaceFind() and PlaceFindDriven(); negative: there is none */
  PetscInt  pair, vertex; /* number of the pair; local DMPlex point */
  PetscInt  node;         /* number of the vertex in global vectors */
  PetscReal x[3];         /* undeformed coordinates [length] */
} GapPlace;

static void PlaceTake(ContactLinearization lin, PetscInt row, PetscReal error, GapPlace *place)
{
  if (error <= place->error) return;
  place->error  = error;
  place->pair   = lin->pair[row];
  place->vertex = lin->vertex[row];
}

/*
   Finds a vertex of this rank where contact updates do not converge. If slid is false, it is the vertex at which the
   gap at at_u differs most from the linearized gap of the solution. If slid is true, it is the vertex with the largest
   force [force] of those that have slid off the opposite face.
*/
static PetscErrorCode PlaceFind(State state, const ContactSolution *sol, ContactLinearization at_u, PetscBool slid,
  GapPlace *place)
{
  ContactLinearization solved = state->solved->linearization;
  const PetscScalar   *g, *gap, *z, *mass;
  PetscInt            *row;

  PetscFunctionBegin;
  place->error = -1.0;
  PetscCall(ContactHistoryFollowRows(state->history, solved, at_u, &row));
  PetscCall(VecGetArrayRead(at_u->g, &g));
  PetscCall(VecGetArrayRead(sol->gap, &gap));
  PetscCall(VecGetArrayRead(sol->pressure, &z));
  PetscCall(VecGetArrayRead(solved->mass, &mass));
  for (PetscInt r = 0; r < solved->nlocal; ++r) {
    const PetscReal force = PetscRealPart(z[r]) * PetscRealPart(mass[r]);

    if (slid && row[r] < 0 && force > 0.0) PlaceTake(solved, r, force, place);
    if (!slid && row[r] >= 0) PlaceTake(solved, r, PetscAbsScalar(g[row[r]] - gap[r]), place);
  }
  for (PetscInt r = 0; r < at_u->nlocal && !slid; ++r) PlaceTake(at_u, r, -PetscRealPart(g[r]), place);
  PetscCall(VecRestoreArrayRead(solved->mass, &mass));
  PetscCall(VecRestoreArrayRead(sol->pressure, &z));
  PetscCall(VecRestoreArrayRead(sol->gap, &gap));
  PetscCall(VecRestoreArrayRead(at_u->g, &g));
  PetscCall(PetscFree(row));
  PetscFunctionReturn(0);
}

/* Collective. Sets the node number and the coordinates of the vertex on its rank; then all ranks get the PlaceFind()
   result with the largest error */
static PetscErrorCode PlaceShare(Model model, GapPlace *place)
{
  struct {
    double error;
    int    rank;
  } worst;
  PetscSection       global;
  const PetscScalar *x;
  PetscInt           start, offset;
  PetscMPIInt        rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(model->comm, &rank));
  if (place->error >= 0.0) {
    PetscCall(DMGetGlobalSection(model->dm, &global));
    PetscCall(PetscSectionGetOffset(global, place->vertex, &offset));
    PetscCall(VecGetOwnershipRange(model->places.x, &start, NULL));
    PetscCall(VecGetArrayRead(model->places.x, &x));
    for (PetscInt c = 0; c < 3; ++c) place->x[c] = PetscRealPart(x[offset - start + c]);
    PetscCall(VecRestoreArrayRead(model->places.x, &x));
    place->node = offset / 3;
  }
  worst.error = (double)place->error;
  worst.rank  = rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, model->comm));
  PetscCallMPI(MPI_Bcast(place, (PetscMPIInt)sizeof(*place), MPI_BYTE, worst.rank, model->comm));
  PetscFunctionReturn(0);
}

/*
   Collective. Names pair, face and vertex at which the gap at at_u differs most from that of the solution, or which has
   slid off the opposite face. sentence: "; contact pair ...", empty if there is no such vertex.
*/
PetscErrorCode ContactUpdateNamePlace(Model model, State state, const ContactSolution *sol, ContactLinearization at_u,
  PetscBool slid, size_t length, char sentence[])
{
  const SceneContactPair *pair;
  PetscBool               edge;
  GapPlace                place;

  PetscFunctionBegin;
  sentence[0] = '\0';
  PetscCall(PlaceFind(state, sol, at_u, slid, &place));
  PetscCall(PlaceShare(model, &place));
  if (place.error < 0.0) PetscFunctionReturn(0);
  pair = &model->scene->pairs[place.pair];
  PetscCall(ContactIsAtEdge(model->contact, place.pair, place.node, &edge));
  PetscCall(PetscSNPrintf(sentence, length, "; contact pair \"%s\", %s vertex (%g, %g, %g) %s face %s: %s", pair->name,
    slid ? "for example" : "the most at", (double)place.x[0], (double)place.x[1], (double)place.x[2],
    edge ? "on the edge of" : "inside", pair->nonmortar,
    edge ? "round the edge, or use smaller load steps" : "use smaller load steps, or swap mortar and nonmortar"));
  PetscFunctionReturn(0);
}

/*
   Finds a vertex of this rank that penetrates the other body although no unknown changes its gap, because all
   displacements in it are prescribed. place->error: its depth [length]. allowed: depth that is not found [length]
*/
static PetscErrorCode PlaceFindDriven(const StepProblem *p, PetscReal allowed, GapPlace *place)
{
  ContactLinearization lin = p->state->solved->linearization;
  PetscReal            largest;
  const PetscScalar   *g, *entry;
  Vec                  entries;

  PetscFunctionBegin;
  place->error = -1.0;
  PetscCall(VecDuplicate(p->g, &entries));
  PetscCall(MatGetRowMaxAbs(p->J, entries, NULL));
  PetscCall(VecNorm(entries, NORM_INFINITY, &largest));
  PetscCall(VecGetArrayRead(entries, &entry));
  PetscCall(VecGetArrayRead(p->g, &g));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    if (PetscRealPart(entry[r]) <= MODEL_ROUNDING * largest && PetscRealPart(g[r]) < -allowed)
      PlaceTake(lin, r, -PetscRealPart(g[r]), place);
  }
  PetscCall(VecRestoreArrayRead(p->g, &g));
  PetscCall(VecRestoreArrayRead(entries, &entry));
  PetscCall(VecDestroy(&entries));
  PetscFunctionReturn(0);
}

/*
   Collective. Reports the cause of a solve that failed because prescribed displacements press a vertex into the other
   body
*/
PetscErrorCode ContactUpdateReportDriven(const StepProblem *p, StepReport *report)
{
  const PetscReal         part = 1e-6; /* smallest depth that counts, relative to the largest displacement */
  const SceneContactPair *pair;
  PetscReal               size;
  GapPlace                place;

  PetscFunctionBegin;
  if (report->converged || !p->J) PetscFunctionReturn(0);
  PetscCall(VecNorm(p->base, NORM_INFINITY, &size));
  PetscCall(PlaceFindDriven(p, part * size, &place));
  PetscCall(PlaceShare(p->model, &place));
  if (place.error < 0.0) PetscFunctionReturn(0);
  pair = &p->model->scene->pairs[place.pair];
  PetscCall(ReportReason(report, PETSC_FALSE,
    "contact pair \"%s\": prescribed displacements press the vertex (%g, %g, %g) of face %s by %g into the other body, "
    "and no component of it is free to avoid that: prescribe the displacements of a face that does not touch %s, or "
    "fewer components",
    pair->name, (double)place.x[0], (double)place.x[1], (double)place.x[2], pair->nonmortar, (double)place.error,
    pair->mortar));
  PetscFunctionReturn(0);
}
