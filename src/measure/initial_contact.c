/* Describes the contact pairs at the start, and warns of overlaps that the scene does not declare */
#include "measureimpl.h"
#include "src/state/contact_state.h"
#include <math.h>

/* The nonmortar side of a pair in the undeformed state */
typedef struct {
  PetscInt  n;              /* number of vertices that have the mortar face within the search distance */
  PetscReal least, largest; /* smallest and largest gap; negative: overlap [length] */
  PetscReal certain;        /* smallest gap if the uncertainty of the smooth surfaces is added to each [length] */
  PetscReal area, overlap;  /* area of these vertices; area of those that overlap [length^2] */
} PairStart;

static PetscErrorCode StartMeasureArea(ContactLinearization lin, PairStart starts[])
{
  const PetscScalar *g, *m, *doubt;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(lin->g, &g));
  PetscCall(VecGetArrayRead(lin->doubt, &doubt));
  PetscCall(VecGetArrayRead(lin->mass, &m));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    PairStart      *start = &starts[lin->pair[i]];
    const PetscReal gap   = PetscRealPart(g[i]);

    ++start->n;
    start->least   = PetscMin(start->least, gap);
    start->largest = PetscMax(start->largest, gap);
    start->certain = PetscMin(start->certain, gap + PetscRealPart(doubt[i]));
    start->area += PetscRealPart(m[i]);
    if (gap < 0.0) start->overlap += PetscRealPart(m[i]);
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &m));
  PetscCall(VecRestoreArrayRead(lin->doubt, &doubt));
  PetscCall(VecRestoreArrayRead(lin->g, &g));
  PetscFunctionReturn(0);
}

/* Measures gaps and overlaps. Overlaps of the size of rounding errors, or of the uncertainty of the smooth surfaces,
   are ignored. */
static PetscErrorCode StartMeasure(MPI_Comm comm, ContactLinearization lin, PetscInt npairs, PairStart starts[])
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < npairs; ++p)
    starts[p] = (PairStart){.least = PETSC_MAX_REAL, .largest = PETSC_MIN_REAL, .certain = PETSC_MAX_REAL};
  PetscCall(StartMeasureArea(lin, starts));
  for (PetscInt p = 0; p < npairs; ++p) {
    PetscReal sums[2] = {starts[p].area, starts[p].overlap};

    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &starts[p].n, 1, MPIU_INT, MPI_SUM, comm));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &starts[p].least, 1, MPIU_REAL, MPIU_MIN, comm));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &starts[p].largest, 1, MPIU_REAL, MPIU_MAX, comm));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &starts[p].certain, 1, MPIU_REAL, MPIU_MIN, comm));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, comm));
    starts[p].area    = sums[0];
    starts[p].overlap = starts[p].certain < -MESH_SAME_PLACE * PetscSqrtReal(sums[0]) ? sums[1] : 0.0;
  }
  PetscFunctionReturn(0);
}

/*
   Sets the overlap of pairs with dual shape functions to zero if no vertex of either face is in the other body. These
   functions have negative values, so that their gap to a curved face may be negative where the faces only touch.
*/
static PetscErrorCode StartClearDual(Scene scene, Contact contact, LoadPath *path, PairStart starts[])
{
  const SceneContactPair *pairs  = scene->pairs;
  const PetscInt          npairs = scene->npairs;
  PetscReal              *depth, *rounding;
  PetscBool              *within, any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < npairs; ++p) any = (PetscBool)(any || (pairs[p].gap == GAP_DUAL && starts[p].overlap > 0.0));
  if (!any) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(npairs, &depth, npairs, &rounding));
  PetscCall(PetscCalloc1(npairs, &within));
  PetscCall(ContactGetPenetration(contact, path->u, within, depth, rounding));
  for (PetscInt p = 0; p < npairs; ++p) {
    if (pairs[p].gap == GAP_DUAL && depth[p] <= rounding[p] + MESH_SAME_PLACE * PetscSqrtReal(starts[p].area))
      starts[p].overlap = 0.0;
  }
  PetscCall(PetscFree(within));
  PetscCall(PetscFree2(depth, rounding));
  PetscFunctionReturn(0);
}

/*
   Returns a text that says how the overlap differs from what the scene declares; NULL: it does not differ. The surfaces
   through the facets of curved faces have an error of less than 1 % of the overlap.
*/
static const char *StartJudge(const SceneContactPair *pair, const PairStart *start)
{
  const PetscReal most = 1.01;

  if (start->overlap == 0.0)
    return pair->interference > 0.0
             ? "although the pair declares an interference: correct the positions, or remove the key"
             : NULL;
  if (pair->interference == 0.0)
    return "which the pair does not declare: move the bodies apart, or set interference to true or to the largest "
           "overlap";
  return -start->least > most * pair->interference
           ? "more than the interference that the pair declares: increase it, or correct the positions"
           : NULL;
}

/* Returns whether bodies of the scene may rotate by large angles */
static PetscBool StartMayTurn(Scene scene)
{
  PetscBool turns = PETSC_FALSE;

  for (PetscInt b = 0; b < scene->nbodies; ++b)
    turns = (PetscBool)(turns || MaterialIsFinite(&scene->bodies[b].material));
  for (PetscInt k = 0; k < scene->ndisplacements; ++k) {
    for (PetscInt c = 0; c < 3; ++c)
      turns =
        (PetscBool)(turns || scene->displacements[k].rotation[c] != 0.0 || scene->displacements[k].released[3 + c]);
  }
  return turns;
}

/* Collective. Writes what is wrong with a pair whose faces look away from each other; an empty text: nothing */
static PetscErrorCode StartLookAway(Contact contact, Scene scene, PetscInt p, char text[], size_t length)
{
  const SceneContactPair *pair = &scene->pairs[p];
  PetscBool               away;

  PetscFunctionBegin;
  text[0] = '\0';
  PetscCall(ContactLooksAway(contact, p, StartMayTurn(scene), &away));
  if (away)
    PetscCall(PetscSNPrintf(text, length,
      "contact pair \"%s\": all of the nonmortar face %s looks away from the mortar face %s, so that the two cannot be "
      "pressed against each other: give the pair the faces that meet",
      pair->name, pair->nonmortar, pair->mortar));
  PetscFunctionReturn(0);
}

/* Warns of nodes that must stick although both faces have different prescribed displacements there */
static PetscErrorCode StartWarnOfFrictionless(const Measured *at, PetscInt p)
{
  const SceneContactPair *pair = &at->scene->pairs[p];
  PetscInt                nfrictionless, nnodes;

  PetscFunctionBegin;
  PetscCall(ContactGetFrictionless(at->contact, p, &nfrictionless, &nnodes));
  if (nfrictionless)
    PetscCall(ReportWarn(at->comm, at->report, pair->place,
      "contact pair \"%s\" cannot stick at %" PetscInt_FMT " of the %" PetscInt_FMT
      " nodes of %s, because different displacements are prescribed there on the two faces; no friction acts at these "
      "nodes: prescribe displacements away from the contact, or give the pair a coefficient of friction",
      pair->name, nfrictionless, nnodes, pair->nonmortar));
  PetscFunctionReturn(0);
}

/* Warns that rebounds between two rigid bodies are not those of real bodies: contact is closed at the end of a time
   step, so that the velocity after it depends on where in the step the bodies meet */
static PetscErrorCode StartWarnOfRigid(const Measured *at, const SceneContactPair *pair)
{
  PetscFunctionBegin;
  if (!SceneIsDynamic(at->scene) || !SceneContactPairIsRigid(at->scene, pair)) PetscFunctionReturn(0);
  PetscCall(ReportWarn(at->comm, at->report, pair->place,
    "contact pair \"%s\" is between two rigid bodies, whose rebound depends on the time steps; their energy does not "
    "grow: give one of the two bodies an elastic material if the rebound matters",
    pair->name));
  PetscFunctionReturn(0);
}

/*
   Warns of initial overlaps that the scene has not declared or declares differently, and of friction that cannot act.
   lin: linearization at zero displacement.
*/
PetscErrorCode StartWarn(Simulation sim, ContactLinearization lin)
{
  const Measured at    = SimulationMeasured(sim);
  Scene          scene = sim->model->scene;
  PairStart     *starts;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->npairs, &starts));
  PetscCall(StartMeasure(sim->model->comm, lin, scene->npairs, starts));
  PetscCall(StartClearDual(sim->model->scene, sim->model->contact, sim->state->path, starts));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *pair   = &scene->pairs[p];
    const char             *wanted = StartJudge(pair, &starts[p]);
    char                    away[512];

    PetscCall(StartLookAway(sim->model->contact, scene, p, away, sizeof(away)));
    if (away[0]) PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place, "%s", away));
    PetscCall(StartWarnOfRigid(&at, pair));
    PetscCall(StartWarnOfFrictionless(&at, p));
    if (!wanted) continue;
    if (starts[p].overlap > 0.0)
      PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place,
        "contact pair \"%s\" overlaps at the start, by up to %g over an area of %g, %s", pair->name,
        -(double)starts[p].least, (double)starts[p].overlap, wanted));
    else
      PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place,
        "contact pair \"%s\": the faces do not overlap at the start, %s", pair->name, wanted));
  }
  PetscCall(PetscFree(starts));
  PetscFunctionReturn(0);
}

/* Fails the last load step if the bodies of a pair that was open in all load steps have passed into each other */
static PetscErrorCode StartRefuseEntered(const Measured *at, PetscInt p, StepReport *report)
{
  const SceneContactPair *pair = &at->scene->pairs[p];
  PetscReal               place[3];
  PetscBool               entered;

  PetscFunctionBegin;
  if (!report->converged) PetscFunctionReturn(0);
  PetscCall(ContactGetEntered(at->contact, p, at->u, MEASURE_MOTION * report->motion, &entered, place));
  if (!entered) PetscFunctionReturn(0);
  PetscCall(ReportReason(report, PETSC_FALSE,
    "contact pair \"%s\" was open at the end of every load step, but its bodies have passed into each other, for "
    "example at the point (%g, %g, %g): the faces %s and %s are not those that meet",
    pair->name, (double)place[0], (double)place[1], (double)place[2], pair->mortar, pair->nonmortar));
  ReportFailRun(at->report, report, RUN_GAP_UNCONVERGED);
  PetscFunctionReturn(0);
}

/* Finds whether the faces of pair p touch at the end of the last load step, be it without any force */
static PetscErrorCode StartFindTouching(const ContactState *solved, MPI_Comm comm, PetscInt p, PetscBool *touching)
{
  const ContactLinearization lin   = solved->linearization;
  PetscReal                  least = PETSC_MAX_REAL, area = 0.0;
  const PetscScalar         *gap, *mass;

  PetscFunctionBegin;
  *touching = PETSC_FALSE;
  if (!solved->solution.gap) PetscFunctionReturn(0);
  PetscCall(VecGetArrayRead(solved->solution.gap, &gap));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt i = 0; i < lin->nlocal; ++i) {
    if (lin->pair[i] != p) continue;
    least = PetscMin(least, PetscRealPart(gap[i]));
    area += PetscRealPart(mass[i]);
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(VecRestoreArrayRead(solved->solution.gap, &gap));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPIU_REAL, MPIU_MIN, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPIU_REAL, MPIU_SUM, comm));
  *touching = (PetscBool)(least <= MESH_SAME_PLACE * PetscSqrtReal(area));
  PetscFunctionReturn(0);
}

/* Warns, after the last load step, of pairs that were open in all load steps. report: of that load step, which fails if
   their bodies have passed into each other */
PetscErrorCode StartWarnOfUnmet(Simulation sim, StepReport *report)
{
  const Measured   at  = SimulationMeasured(sim);
  const RunReport *run = &sim->report;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < sim->model->scene->npairs; ++p) {
    const SceneContactPair *pair   = &sim->model->scene->pairs[p];
    PetscReal               closed = 0.0; /* area and force; on coarse facets a force may act at no closed vertex */
    PetscBool               touching;

    if (pair->why) continue; /* the pair was found by a rule and need not close */
    for (PetscInt s = 0; s < run->nsteps; ++s)
      if (p < run->steps[s].npairs) closed += run->steps[s].pairs[p].area + run->steps[s].pairs[p].normal_force;
    if (closed > 0.0) continue;
    PetscCall(StartRefuseEntered(&at, p, report));
    PetscCall(StartFindTouching(sim->state->solved, sim->model->comm, p, &touching));
    if (touching) continue;
    if (pair->self)
      PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place,
        "contact pair \"%s\" was open at the end of every load step: %s did not come into contact with itself",
        pair->name, pair->self));
    else
      PetscCall(ReportWarn(sim->model->comm, &sim->report, pair->place,
        "contact pair \"%s\" was open at the end of every load step (mortar %s, nonmortar %s): check load direction, "
        "faces and clearance",
        pair->name, pair->mortar, pair->nonmortar));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode StartDescribePair(const SceneContactPair *pair, const PairStart *start, PetscViewer viewer)
{
  const char *wanted = StartJudge(pair, start);

  PetscFunctionBegin;
  if (pair->self) {
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  %s: %" PetscInt_FMT " vertices of %s have another part of it within the search distance", pair->name, start->n,
      pair->self));
    if (start->n)
      PetscCall(PetscViewerASCIIPrintf(viewer, "; gap %.5g to %.5g", (double)start->least, (double)start->largest));
    PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
    PetscFunctionReturn(0);
  }
  if (!start->n) {
    PetscCall(PetscViewerASCIIPrintf(viewer,
      "  %s: no vertex of %s has %s within the search distance; WARNING: the pair has no effect unless the faces come "
      "closer\n",
      pair->name, pair->nonmortar, pair->mortar));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "  %s: %" PetscInt_FMT
    " vertices of %s, over an area of %.5g, have %s within the search distance; gap %.5g to %.5g",
    pair->name, start->n, pair->nonmortar, (double)start->area, pair->mortar, (double)start->least,
    (double)start->largest));
  if (start->overlap > 0.0)
    PetscCall(PetscViewerASCIIPrintf(viewer, ", overlap over an area of %.5g", (double)start->overlap));
  PetscCall(PetscViewerASCIIPrintf(viewer, "\n"));
  if (wanted)
    PetscCall(PetscViewerASCIIPrintf(viewer, "    WARNING: they %soverlap, %s\n", start->overlap > 0.0 ? "" : "do not ",
      wanted));
  PetscFunctionReturn(0);
}

/*@C
   StepDescribeContact - Prints initial gaps and mesh sizes of a scene's contact pairs

   Collective on the viewer

   Input Parameters:
+  scene  - the scene
.  dm     - its mesh, by `MeshCreate()`
-  viewer - an ASCII viewer

   Level: beginner

   Note:
   Bodies that overlap by more than the search depth are an error, as in a run.

.seealso: `SceneDescribe()`, `ContactCheckDepth()`
@*/
PetscErrorCode StepDescribeContact(Scene scene, DM dm, PetscViewer viewer)
{
  Contact              contact;
  ContactLinearization lin;
  PairStart           *starts;
  Vec                  zero;

  PetscFunctionBegin;
  if (!scene->npairs) PetscFunctionReturn(0);
  PetscCall(ContactCreate(dm, scene->npairs, scene->pairs, &contact));
  PetscCall(ContactSetBodies(contact, scene->bodies));
  PetscCall(ContactSetFromOptions(contact));
  PetscCall(ContactSetDisplacements(contact, scene->ndisplacements, scene->displacements));
  PetscCall(ContactSetCyclic(contact, scene->ncyclic, scene->cyclic));
  PetscCall(DMCreateGlobalVector(dm, &zero));
  PetscCall(VecZeroEntries(zero));
  PetscCall(ContactLinearize(contact, zero, CONTACT_FORCES, &lin));
  PetscCall(ContactCheckDepth(contact));
  PetscCall(PetscMalloc1(scene->npairs, &starts));
  PetscCall(StartMeasure(PetscObjectComm((PetscObject)dm), lin, scene->npairs, starts));
  PetscCall(PetscViewerASCIIPrintf(viewer, "Contact at the start\n"));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    char away[512];

    PetscCall(StartDescribePair(&scene->pairs[p], &starts[p], viewer));
    PetscCall(StartLookAway(contact, scene, p, away, sizeof(away)));
    if (away[0]) PetscCall(PetscViewerASCIIPrintf(viewer, "    WARNING: %s\n", away));
  }
  PetscCall(PetscFree(starts));
  PetscCall(ContactLinearizationDestroy(&lin));
  PetscCall(VecDestroy(&zero));
  PetscCall(ContactDestroy(&contact));
  PetscFunctionReturn(0);
}
