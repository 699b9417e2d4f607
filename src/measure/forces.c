/* Computes forces and moments of pairs, faces and bodies */
#include "measureimpl.h"
#include <vector3.h>
#include <math.h>
#include <string.h>
#include "src/state/contact_state.h"

/* A force [force], its moment about the origin [force length], and the sum of the magnitudes of its parts [force] */
typedef struct {
  PetscReal force[3], moment[3], size;
} ForceSum;
#define FORCE_SUM_REALS ((PetscMPIInt)(sizeof(ForceSum) / sizeof(PetscReal)))

/* Undeformed coordinates and displacements of the owned vertices, and the forces at them */
typedef struct {
  PetscInt           rstart, n;
  const PetscScalar *x, *u, *force;
} ForceField;

static PetscErrorCode ForceFieldGet(const VertexPlaces *places, Vec u, Vec force, ForceField *field)
{
  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(force, &field->rstart, NULL));
  PetscCall(VecGetLocalSize(force, &field->n));
  PetscCall(VecGetArrayRead(places->x, &field->x));
  PetscCall(VecGetArrayRead(u, &field->u));
  PetscCall(VecGetArrayRead(force, &field->force));
  PetscFunctionReturn(0);
}

static PetscErrorCode ForceFieldRestore(const VertexPlaces *places, Vec u, Vec force, ForceField *field)
{
  PetscFunctionBegin;
  PetscCall(VecRestoreArrayRead(force, &field->force));
  PetscCall(VecRestoreArrayRead(u, &field->u));
  PetscCall(VecRestoreArrayRead(places->x, &field->x));
  PetscFunctionReturn(0);
}

/* Adds the force f in one row of this rank */
static void ForceSumAddRow(const ForceField *field, PetscInt i, PetscReal f, ForceSum *sum)
{
  const PetscInt c = i % 3, d = (c + 1) % 3, e = (c + 2) % 3, v = i - c;

  sum->force[c] += f;
  sum->size += PetscAbsReal(f);
  sum->moment[d] += PetscRealPart(field->x[v + e] + field->u[v + e]) * f;
  sum->moment[e] -= PetscRealPart(field->x[v + d] + field->u[v + d]) * f;
}

/* Adds the forces on a face, for the components that are true in component[] */
static PetscErrorCode ForceSumAddFace(DM dm, const ForceField *field, const char face[], const PetscBool component[3],
  ForceSum *sum)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) {
    IS              is;
    const PetscInt *rows;
    PetscInt        n;

    if (!component[c]) continue;
    PetscCall(MeshGetFaceDofs(dm, face, c, &is));
    PetscCall(ISGetLocalSize(is, &n));
    PetscCall(ISGetIndices(is, &rows));
    for (PetscInt k = 0; k < n; ++k) {
      const PetscInt i = rows[k] - field->rstart;

      ForceSumAddRow(field, i, PetscRealPart(field->force[i]), sum);
    }
    PetscCall(ISRestoreIndices(is, &rows));
    PetscCall(ISDestroy(&is));
  }
  PetscFunctionReturn(0);
}

/* Adds the components of the forces on a face along a normal */
static PetscErrorCode ForceSumAddPlane(DM dm, const ForceField *field, const char face[], const PetscReal normal[3],
  ForceSum *sum)
{
  PetscReal       d[3];
  IS              is;
  const PetscInt *rows;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(PetscArraycpy(d, normal, 3));
  VectorScaleToUnit(d);
  PetscCall(MeshGetFaceDofs(dm, face, 0, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &rows));
  for (PetscInt k = 0; k < n; ++k) {
    const PetscInt  i    = rows[k] - field->rstart;
    const PetscReal f[3] = {PetscRealPart(field->force[i]), PetscRealPart(field->force[i + 1]),
      PetscRealPart(field->force[i + 2])};

    for (PetscInt c = 0; c < 3; ++c) ForceSumAddRow(field, i + c, VectorDot(d, f) * d[c], sum);
  }
  PetscCall(ISRestoreIndices(is, &rows));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

static PetscErrorCode ForceSumReduce(MPI_Comm comm, PetscInt n, ForceSum sums[])
{
  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, FORCE_SUM_REALS * (PetscMPIInt)n, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/* Returns the index of a face in the report. A new face is appended. */
static PetscInt ForcesFindFace(StepReport *report, const char name[])
{
  PetscInt f = 0;

  while (f < report->nfaces && strcmp(report->faces[f].name, name)) ++f;
  if (f == report->nfaces) report->faces[report->nfaces++].name = name;
  return f;
}

/* Creates the report's lists of pairs, faces and bodies, with zeros */
PetscErrorCode ForcesReserve(const Measured *at, StepReport *report)
{
  Scene scene = at->scene;

  PetscFunctionBegin;
  PetscCall(ForcesFree(report));
  PetscCall(PetscCalloc1(scene->npairs, &report->pairs));
  PetscCall(PetscCalloc1(scene->ndisplacements, &report->faces));
  PetscCall(PetscCalloc1(scene->nbodies, &report->bodies));
  report->npairs  = scene->npairs;
  report->nbodies = scene->nbodies;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    report->pairs[p].name   = scene->pairs[p].name;
    report->pairs[p].mortar = scene->pairs[p].mortar;
    for (PetscInt d = 0; d < 3; ++d) report->pairs[p].pressure_place[d] = NAN;
    report->pairs[p].frictional = SceneContactPairHasFriction(&scene->pairs[p]);
  }
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    FaceReport *face = &report->faces[ForcesFindFace(report, scene->displacements[d].face)];

    face->torque = NAN;
    if (!scene->displacements[d].symmetry) face->driven = PETSC_TRUE;
  }
  for (PetscInt b = 0; b < scene->nbodies; ++b) report->bodies[b].name = scene->bodies[b].name;
  PetscFunctionReturn(0);
}

PetscErrorCode ForcesFree(StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(PetscFree(report->pairs));
  PetscCall(PetscFree(report->faces));
  PetscCall(PetscFree(report->bodies));
  report->npairs = report->nfaces = report->nbodies = 0;
  PetscFunctionReturn(0);
}

/* Adds the forces on a whole face */
static PetscErrorCode ForcesAddFace(DM dm, const VertexPlaces *places, const char face[], Vec u, Vec force,
  ForceSum *sum)
{
  static const PetscBool all[3] = {PETSC_TRUE, PETSC_TRUE, PETSC_TRUE};
  ForceField             field;

  PetscFunctionBegin;
  PetscCall(ForceFieldGet(places, u, force, &field));
  PetscCall(ForceSumAddFace(dm, &field, face, all, sum));
  PetscCall(ForceFieldRestore(places, u, force, &field));
  PetscFunctionReturn(0);
}

/*
   Computes the sums of the pair's contact forces, J^T (mass x pressure) and friction, over the nonmortar side
   (sides[0]) and the mortar side (sides[1])
*/
static PetscErrorCode ForcesMeasurePair(const Measured *at, PetscInt pair, Vec u, Vec weighted, Vec shear,
  ForceSum sides[2])
{
  const SceneContactPair *faces = &at->scene->pairs[pair];
  ContactLinearization    lin   = at->solved->linearization;
  Vec                     force, mortar = NULL;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecZeroEntries(force));
  PetscCall(RowsAddForces(lin, lin->J, weighted, pair, force));
  PetscCall(RowsAddForces(lin, lin->slip, shear, pair, force));
  if (faces->self) { /* both sides are the same face */
    PetscCall(VecDuplicate(u, &mortar));
    PetscCall(VecZeroEntries(mortar));
    PetscCall(RowsAddForces(lin, lin->mortar, weighted, pair, mortar));
    PetscCall(RowsAddForces(lin, lin->mortar_slip, shear, pair, mortar));
    PetscCall(VecAXPY(force, -1.0, mortar));
  }
  PetscCall(ForcesAddFace(at->dm, &at->places, faces->nonmortar, u, force, &sides[0]));
  PetscCall(ForcesAddFace(at->dm, &at->places, faces->mortar, u, mortar ? mortar : force, &sides[1]));
  PetscCall(VecDestroy(&mortar));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/*
   Computes the contact forces of all pairs. weighted: mass x pressure, one entry per row of the last linearization;
   shear: friction forces, or NULL.
*/
PetscErrorCode ForcesMeasurePairs(const Measured *at, Vec u, Vec weighted, Vec shear, StepReport *report)
{
  ForceSum *sides;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(PetscCalloc1(2 * report->npairs, &sides));
  for (PetscInt p = 0; p < report->npairs; ++p) PetscCall(ForcesMeasurePair(at, p, u, weighted, shear, &sides[2 * p]));
  PetscCall(ForceSumReduce(at->comm, 2 * report->npairs, sides));
  PetscCall(PetscArrayzero(report->contact_force, 3));
  for (PetscInt p = 0; p < report->npairs; ++p) {
    PairReport *pair = &report->pairs[p];

    PetscCall(PetscArraycpy(pair->force, sides[2 * p].force, 3));
    PetscCall(PetscArraycpy(pair->moment, sides[2 * p].moment, 3));
    PetscCall(PetscArraycpy(pair->mortar_force, sides[2 * p + 1].force, 3));
    pair->size = PetscMax(sides[2 * p].size, sides[2 * p + 1].size);
    PetscCall(PetscArraycpy(pair->mortar_moment, sides[2 * p + 1].moment, 3));
    for (PetscInt c = 0; c < 3; ++c) report->contact_force[c] += pair->force[c];
  }
  PetscCall(PetscFree(sides));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Adds the forces at all nodes of a rigid body that forces drive to *sum, and sets them to zero in `rigid` */
static PetscErrorCode ForcesTakeAll(DM dm, const VertexPlaces *places, Vec u, Vec rigid, const char face[],
  ForceSum *sum)
{
  PetscFunctionBegin;
  PetscCall(ForcesAddFace(dm, places, face, u, rigid, sum));
  for (PetscInt c = 0; c < 3; ++c) PetscCall(MeshFaceSet(dm, face, c, 0.0, rigid));
  PetscFunctionReturn(0);
}

/* Adds the reactions of each face to its sum, see ForcesMeasureFaces() */
static PetscErrorCode ForcesSumFaces(Model model, Vec u, Vec reaction, Vec ties, Vec rigid, StepReport *report,
  ForceSum sums[])
{
  const Constraints constraints = ModelConstraints(model);
  Vec               shares;
  ForceField        field;

  PetscFunctionBegin;
  PetscCall(FaceForcesDivide(&constraints, reaction, ties, &shares));
  PetscCall(ForceFieldGet(&model->places, u, shares, &field));
  for (PetscInt i = 0; i < model->scene->ndisplacements; ++i) {
    const SceneDisplacement *d   = &model->scene->displacements[i];
    ForceSum                *sum = &sums[ForcesFindFace(report, d->face)];

    PetscCall(ForceSumAddFace(model->dm, &field, d->face, d->fixed, sum));
    if (d->inclined) PetscCall(ForceSumAddPlane(model->dm, &field, d->face, d->normal, sum));
  }
  PetscCall(ForceFieldRestore(&model->places, u, shares, &field));
  PetscCall(VecDestroy(&shares));
  for (PetscInt i = 0; rigid && i < model->scene->ndisplacements; ++i) {
    const SceneDisplacement *d = &model->scene->displacements[i];

    if (d->moves)
      PetscCall(ForcesTakeAll(model->dm, &model->places, u, rigid, d->face, &sums[ForcesFindFace(report, d->face)]));
  }
  PetscFunctionReturn(0);
}

/*
   Computes the reactions of all faces. reaction: forces in prescribed rows; ties: forces of ties and inclined planes on
   the bodies, on exit without those of the planes; rigid: forces on the rigid bodies, on exit without those of the
   faces. ties and rigid may be NULL.
*/
PetscErrorCode ForcesMeasureFaces(Model model, Vec u, Vec reaction, Vec ties, Vec rigid, StepReport *report)
{
  ForceSum *sums;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscCall(PetscCalloc1(report->nfaces, &sums));
  PetscCall(ForcesSumFaces(model, u, reaction, ties, rigid, report, sums));
  PetscCall(ForceSumReduce(model->comm, report->nfaces, sums));
  for (PetscInt f = 0; f < report->nfaces; ++f) {
    PetscCall(PetscArraycpy(report->faces[f].reaction, sums[f].force, 3));
    report->faces[f].size = sums[f].size;
    PetscCall(PetscArraycpy(report->faces[f].moment, sums[f].moment, 3));
  }
  PetscCall(PetscFree(sums));
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* Computes the place of the centre of a rotation of the scene at the end of a load step [length] */
static PetscErrorCode TorqueGetCenter(Scene scene, const SceneDisplacement *turn, const StepReport *report,
  PetscReal center[3])
{
  const size_t length = strcspn(turn->face, ".");

  PetscFunctionBegin;
  PetscCall(PetscArraycpy(center, turn->center, 3));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *other = &scene->displacements[d];

    if (strcmp(other->face, turn->face)) continue;
    for (PetscInt i = 0; i < 3; ++i) center[i] += report->ramps[other->ramp].factor * other->value[i];
  }
  /* a rigid body may have translations that are free */
  for (PetscInt b = 0; b < report->nrigid_bodies; ++b) {
    const RigidReport *body = &report->rigid_bodies[b];

    if (!strncmp(body->name, turn->face, length) && !body->name[length])
      PetscCall(PetscArraycpy(center, body->position, 3));
  }
  PetscFunctionReturn(0);
}

/* Computes the torques of faces and rigid bodies that the scene rotates. Needs their moments, and the places of rigid
   bodies. */
PetscErrorCode TorquesMeasure(Scene scene, StepReport *report)
{
  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements && report->nfaces; ++d) {
    const SceneDisplacement *turn  = &scene->displacements[d];
    FaceReport              *face  = &report->faces[ForcesFindFace(report, turn->face)];
    const PetscReal          angle = VectorNorm(turn->rotation);
    PetscReal                center[3], moment[3];

    if (angle == 0.0 || !PetscIsNanReal(face->torque)) continue;
    PetscCall(TorqueGetCenter(scene, turn, report, center));
    VectorCross(center, face->reaction, moment);
    for (PetscInt i = 0; i < 3; ++i) moment[i] = face->moment[i] - moment[i];
    face->torque = VectorDot(moment, turn->rotation) / angle;
  }
  PetscFunctionReturn(0);
}

/* Returns the report of the body of a face <body>.<face> */
static BodyReport *ForcesFindBody(StepReport *report, const char face[])
{
  for (PetscInt b = 0; b < report->nbodies; ++b) {
    const size_t length = strlen(report->bodies[b].name);

    if (!strncmp(face, report->bodies[b].name, length) && face[length] == '.') return &report->bodies[b];
  }
  return NULL;
}

static PetscErrorCode ForcesMeasureConnectors(Model model, Vec u, StepReport *report)
{
  const Bodies bodies = ModelBodies(model);

  PetscFunctionBegin;
  PetscCall(PetscFree(report->connectors));
  report->nconnectors = model->scene->nconnectors;
  PetscCall(PetscCalloc1(report->nconnectors, &report->connectors));
  for (PetscInt c = 0; c < report->nconnectors; ++c) {
    ConnectorReport *connector = &report->connectors[c];

    connector->name = model->scene->connectors[c].name;
    PetscCall(
      ConnectorMeasure(&bodies, &model->springs, c, u, model->dynamics.velocity, connector->offset, connector->force));
  }
  PetscFunctionReturn(0);
}

/*
   Adds a force to one of the body's sums and to its residual. Its size is added to body->balance, which is normalized
   at the end: the magnitude, or `size` if that is larger because the parts of the force cancel.
*/
static PetscErrorCode ForcesAddToBody(BodyReport *body, PetscReal sum[3], const PetscReal force[3], PetscReal size)
{
  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) {
    sum[c] += force[c];
    body->residual[c] += force[c];
  }
  body->balance += PetscMax(VectorNorm(force), size);
  PetscFunctionReturn(0);
}

/* Adds forces at nodes to the bodies' sums at this offset in the reports */
static PetscErrorCode ForcesAddToBodies(const VertexPlaces *places, Vec forces, size_t offset, StepReport *report)
{
  PetscReal *sums;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(4 * report->nbodies, &sums));
  PetscCall(VertexPlacesSumForces(places, forces, forces, report->nbodies, sums));
  for (PetscInt b = 0; b < report->nbodies; ++b) {
    BodyReport *body = &report->bodies[b];

    PetscCall(ForcesAddToBody(body, (PetscReal *)((char *)body + offset), &sums[4 * b], sums[4 * b + 3]));
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

static PetscErrorCode ForcesSumSprings(Model model, Vec u, StepReport *report)
{
  Vec forces;

  PetscFunctionBegin;
  PetscCall(SpringsMeasure(&model->springs, u, &forces, &report->weak_spring_force));
  PetscCall(ForcesMeasureConnectors(model, u, report));
  PetscCall(ForcesAddToBodies(&model->places, forces, offsetof(BodyReport, springs), report));
  PetscCall(VecDestroy(&forces));
  PetscFunctionReturn(0);
}

/*
   Sums the forces on each body: those of pairs and faces from the report, springs, ties and loads (NULL: none). Forces
   below `rounding` count as balanced.
*/
PetscErrorCode ForcesMeasureBodies(Model model, Vec u, Vec load, Vec ties, PetscReal rounding, StepReport *report)
{
  PetscReal largest = 0.0;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < report->npairs; ++p) {
    BodyReport *nonmortar = ForcesFindBody(report, model->scene->pairs[p].nonmortar),
               *mortar    = ForcesFindBody(report, model->scene->pairs[p].mortar);

    PetscCall(ForcesAddToBody(nonmortar, nonmortar->contact, report->pairs[p].force, report->pairs[p].size));
    PetscCall(ForcesAddToBody(mortar, mortar->contact, report->pairs[p].mortar_force, report->pairs[p].size));
  }
  for (PetscInt f = 0; f < report->nfaces; ++f) {
    BodyReport *body = ForcesFindBody(report, report->faces[f].name);

    PetscCall(ForcesAddToBody(body, body->reaction, report->faces[f].reaction, report->faces[f].size));
  }
  if (load) PetscCall(ForcesAddToBodies(&model->places, load, offsetof(BodyReport, load), report));
  if (model->springs.stiffness) PetscCall(ForcesSumSprings(model, u, report));
  if (ties) PetscCall(ForcesAddToBodies(&model->places, ties, offsetof(BodyReport, ties), report));
  report->balance = 0.0;
  for (PetscInt b = 0; b < report->nbodies; ++b) largest = PetscMax(largest, report->bodies[b].balance);
  for (PetscInt b = 0; b < report->nbodies; ++b) {
    BodyReport *body = &report->bodies[b];

    body->balance   = body->balance > rounding
                        ? VectorNorm(body->residual) / PetscMax(body->balance, PETSC_SQRT_MACHINE_EPSILON * largest)
                        : 0.0;
    report->balance = PetscMax(report->balance, body->balance);
  }
  PetscFunctionReturn(0);
}
