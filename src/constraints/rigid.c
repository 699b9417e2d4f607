/*
   Rigid bodies that forces drive. If motions are free, the displacements of all nodes of the body depend on as many
   rows, the carrying rows, as there are free motions: u = R x + o, where o comes from the prescribed motions. Free
   rotations are finite:

     u = place + exp(angle) last (X - center) - X.

   R and o are linearized about one place and one angle. If a body with a law of small strain is tied to the rigid body,
   the rotations of the rigid body are small too: R and o are then those of the undeformed body.
*/
#include "constraintsimpl.h"
#include <vector3.h>
#include <string.h>

/* Computes component c of the displacement at the position x due to each free motion of the body. Rotations are
   multiplied by the body's size. */
static void RigidGetRow(const RigidBody *body, const PetscScalar x[3], PetscInt c, PetscReal row[6])
{
  const PetscInt next = (c + 1) % 3, last = (c + 2) % 3;

  for (PetscInt k = 0; k < body->n; ++k) {
    const PetscInt   m    = body->motion[k];
    const PetscReal *axis = body->axis[m % 3];

    row[k] = m == c ? 1.0 : 0.0;
    if (m >= 3)
      row[k] = (axis[next] * (PetscRealPart(x[last]) - body->place[last]) -
                 axis[last] * (PetscRealPart(x[next]) - body->place[next])) /
               body->size;
  }
}

/* Gets the first global row of each node of the body that this rank owns */
PetscErrorCode RigidGetNodes(const Constraints *c, const RigidBody *body, IS *nodes)
{
  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(c->bodies.dm, c->bodies.scene->displacements[body->leader].face, 0, nodes));
  PetscFunctionReturn(0);
}

/* Collective. Computes body->size */
static PetscErrorCode RigidMeasure(const Constraints *c, PetscInt rstart, const PetscScalar x[], PetscInt n,
  const PetscInt nodes[], RigidBody *body)
{
  const PetscReal *center = c->bodies.scene->displacements[body->leader].center;

  PetscFunctionBegin;
  body->size = 0.0;
  for (PetscInt i = 0; i < 3 * n; ++i)
    body->size = PetscMax(body->size, PetscAbsReal(PetscRealPart(x[nodes[i / 3] - rstart + i % 3]) - center[i % 3]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &body->size, 1, MPIU_REAL, MPIU_MAX, c->bodies.comm));
  PetscFunctionReturn(0);
}

/* Collective. Finds the next carrying row: the row whose coefficients have the largest component orthogonal to those of
   the rows found so far, for which unit[] is an orthonormal basis. carriers: coefficients of the carrying rows */
static PetscErrorCode RigidFindCarrier(const Constraints *c, PetscInt rstart, const PetscScalar x[], PetscInt n,
  const PetscInt nodes[], PetscInt found, PetscReal unit[6][6], PetscReal carriers[6][6], RigidBody *body)
{
  struct {
    double value;
    int    rank;
  } best = {-1.0, 0};
  PetscReal   across[6], row[6];
  PetscMPIInt rank;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3 * n; ++i) {
    PetscReal square = 0.0;

    RigidGetRow(body, &x[nodes[i / 3] - rstart], i % 3, row);
    PetscCall(PetscArraycpy(across, row, 6));
    for (PetscInt k = 0; k < 2 * found; ++k) {
      PetscReal dot = 0.0;

      for (PetscInt m = 0; m < body->n; ++m) dot += across[m] * unit[k % found][m];
      for (PetscInt m = 0; m < body->n; ++m) across[m] -= dot * unit[k % found][m];
    }
    for (PetscInt m = 0; m < body->n; ++m) square += PetscSqr(across[m]);
    if (square <= best.value) continue;
    best.value       = square;
    body->row[found] = nodes[i / 3] + i % 3;
    for (PetscInt m = 0; m < body->n; ++m)
      unit[found][m] = across[m] / PetscSqrtReal(PetscMax(square, PETSC_MACHINE_EPSILON));
    PetscCall(PetscArraycpy(carriers[found], row, 6));
  }
  PetscCallMPI(MPI_Comm_rank(c->bodies.comm, &rank));
  best.rank = rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MAXLOC, c->bodies.comm));
  PetscCallMPI(MPI_Bcast(&body->row[found], 1, MPIU_INT, best.rank, c->bodies.comm));
  PetscCallMPI(MPI_Bcast(unit[found], 6, MPIU_REAL, best.rank, c->bodies.comm));
  PetscCallMPI(MPI_Bcast(carriers[found], 6, MPIU_REAL, best.rank, c->bodies.comm));
  PetscFunctionReturn(0);
}

/* Sets the rows of R that belong to a body. Carrying rows stay unit rows. Marks the body's rows in `mine` and dependent
   rows in `follows`. */
static PetscErrorCode RigidSetRows(const Constraints *c, const RigidBody *body, PetscInt rstart, const PetscScalar x[],
  PetscInt n, const PetscInt nodes[], const PetscBool prescribed[], PetscBool mine[], PetscBool follows[])
{
  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3 * n; ++i) {
    const PetscInt row = nodes[i / 3] + i % 3, local = row - rstart;
    PetscReal      motion[6];
    PetscBool      carries = PETSC_FALSE;

    mine[local] = PETSC_TRUE;
    if (prescribed[local]) continue;
    for (PetscInt k = 0; k < body->n; ++k) carries = (PetscBool)(carries || body->row[k] == row);
    if (carries) continue;
    follows[local] = PETSC_TRUE;
    RigidGetRow(body, &x[nodes[i / 3] - rstart], i % 3, motion);
    for (PetscInt k = 0; k < body->n; ++k) {
      PetscReal entry = 0.0;

      for (PetscInt m = 0; m < body->n; ++m) entry += motion[m] * body->inverse[m][k];
      if (PetscAbsReal(entry) > 1e-14) PetscCall(MatSetValue(c->rigid->R, row, body->row[k], entry, INSERT_VALUES));
    }
  }
  PetscFunctionReturn(0);
}

/* Returns whether a tie joins the body to a body with a law of small strain */
static PetscBool RigidIsTiedToSmallStrain(Scene scene, PetscInt body)
{
  PetscBool small = PETSC_FALSE;

  for (PetscInt t = 0; t < scene->nties; ++t) {
    const Material *mortar = &SceneFaceBody(scene, scene->ties[t].mortar)->material,
                   *other  = &SceneFaceBody(scene, scene->ties[t].nonmortar)->material,
                   *own    = &scene->bodies[body].material;

    if (mortar != own && other != own) continue;
    if (mortar == own) mortar = other;
    small = (PetscBool)(small || (mortar->type != MATERIAL_RIGID && !MaterialIsFinite(mortar)));
  }
  return small;
}

/* Initializes a rigid body in its undeformed position */
static PetscErrorCode RigidCreateBody(const Constraints *c, PetscInt leader, RigidBody *body)
{
  const SceneDisplacement *d = &c->bodies.scene->displacements[leader];
  IS                       is;
  const PetscInt          *nodes;
  const PetscScalar       *x;
  PetscInt                 n, rstart;

  PetscFunctionBegin;
  *body = (RigidBody){.leader = leader};
  for (PetscInt m = 0; m < 6; ++m) {
    if (d->released[m]) body->motion[body->n++] = m;
    if (m >= 3) body->turns = (PetscBool)(body->turns || d->released[m]);
  }
  for (PetscInt i = 0; i < 3; ++i) {
    body->place[i]   = d->center[i];
    body->axis[i][i] = body->last[i][i] = 1.0;
  }
  while (strncmp(d->face, c->bodies.scene->bodies[body->body].name, strlen(d->face) - strlen(SCENE_WHOLE_BODY)) ||
         strlen(c->bodies.scene->bodies[body->body].name) + strlen(SCENE_WHOLE_BODY) != strlen(d->face))
    ++body->body;
  body->turns = (PetscBool)(body->turns && !RigidIsTiedToSmallStrain(c->bodies.scene, body->body));
  PetscCall(RigidGetNodes(c, body, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &nodes));
  PetscCall(VecGetOwnershipRange(c->rigid->x, &rstart, NULL));
  PetscCall(VecGetArrayRead(c->rigid->x, &x));
  PetscCall(RigidMeasure(c, rstart, x, n, nodes, body));
  PetscCall(VecRestoreArrayRead(c->rigid->x, &x));
  PetscCall(ISRestoreIndices(is, &nodes));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Collective. Chooses the carrying rows of one body, and sets its rows of R. *anew becomes true if the carrying rows
   are not the same as before. */
static PetscErrorCode RigidMakeBodyRows(const Constraints *c, const PetscBool prescribed[], PetscBool mine[],
  PetscBool follows[], RigidBody *body, PetscBool *anew)
{
  IS                 is;
  const PetscInt    *nodes;
  const PetscScalar *x;
  PetscInt           n, rstart;
  PetscReal          unit[6][6];

  PetscFunctionBegin;
  PetscCall(RigidGetNodes(c, body, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &nodes));
  PetscCall(VecGetOwnershipRange(c->rigid->x, &rstart, NULL));
  PetscCall(VecGetArrayRead(c->rigid->x, &x));
  for (PetscInt k = 0; k < body->n; ++k) {
    const PetscInt before = body->row[k];

    PetscCall(RigidFindCarrier(c, rstart, x, n, nodes, k, unit, body->inverse, body));
    *anew = (PetscBool)(*anew || body->row[k] != before);
  }
  (void)MatrixInvertInPlace(body->n, 6, &body->inverse[0][0]);
  PetscCall(RigidSetRows(c, body, rstart, x, n, nodes, prescribed, mine, follows));
  PetscCall(VecRestoreArrayRead(c->rigid->x, &x));
  PetscCall(ISRestoreIndices(is, &nodes));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Collective. Creates R at the positions about which the bodies are linearized. prescribed, follows: flags of this
   rank's rows, as in PlanesCreate() */
PetscErrorCode RigidMakeRows(const Constraints *c, const PetscBool prescribed[], PetscBool follows[], PetscBool *anew)
{
  RigidBodies *rigid = c->rigid;
  PetscInt     n, rstart;
  PetscBool   *mine;
  PetscScalar *elastic;

  PetscFunctionBegin;
  *anew = PETSC_FALSE;
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &rstart, NULL));
  PetscCall(PetscCalloc1(n, &mine));
  PetscCall(MatDestroy(&rigid->R));
  PetscCall(MatCreateAIJ(c->bodies.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 6, NULL, 6, NULL, &rigid->R));
  for (PetscInt b = 0; b < rigid->n; ++b)
    PetscCall(RigidMakeBodyRows(c, prescribed, mine, follows, &rigid->bodies[b], anew));
  PetscCall(VecGetArrayWrite(rigid->elastic, &elastic));
  for (PetscInt i = 0; i < n; ++i) {
    elastic[i] = mine[i] ? 0.0 : 1.0;
    if (!(mine[i] && follows[i])) PetscCall(MatSetValue(rigid->R, rstart + i, rstart + i, 1.0, INSERT_VALUES));
  }
  PetscCall(VecRestoreArrayWrite(rigid->elastic, &elastic));
  PetscCall(MatAssemblyBegin(rigid->R, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(rigid->R, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree(mine));
  PetscFunctionReturn(0);
}

/* Collective. Creates the rigid bodies that forces drive. Must be called after the prescribed rows were created.
   Without such bodies nothing is created. */
PetscErrorCode RigidCreate(const Constraints *c, const PetscBool prescribed[], PetscBool follows[])
{
  RigidBodies *rigid = c->rigid;
  Scene        scene = c->bodies.scene;
  PetscBool    anew;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    rigid->n += SceneFreesMotion(&scene->displacements[d]) && MotionFindLeader(scene, d) == d;
  if (!rigid->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(rigid->n, &rigid->bodies));
  PetscCall(VecDuplicate(c->bodies.mass, &rigid->elastic));
  PetscCall(VecDuplicate(c->bodies.mass, &rigid->given));
  PetscCall(VecDuplicate(c->bodies.mass, &rigid->restraint));
  PetscCall(VecDuplicate(c->bodies.places.x, &rigid->x));
  PetscCall(VecCopy(c->bodies.places.x, rigid->x));
  rigid->n = 0;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    if (!SceneFreesMotion(&scene->displacements[d]) || MotionFindLeader(scene, d) != d) continue;
    PetscCall(RigidCreateBody(c, d, &rigid->bodies[rigid->n]));
    rigid->turns = (PetscBool)(rigid->turns || rigid->bodies[rigid->n++].turns);
  }
  PetscCall(RigidMakeRows(c, prescribed, follows, &anew));
  PetscFunctionReturn(0);
}

/* Collective. Computes o, the displacements of the dependent rows due to prescribed motions at a time [length] */
PetscErrorCode RigidMove(const Constraints *c, PetscReal time, Vec o)
{
  RigidBodies       *rigid = c->rigid;
  const PetscScalar *x;
  PetscScalar       *a;
  PetscInt           rstart;
  PetscReal         *factor;
  RigidMotion        motion;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(c->bodies.scene->nramps, &factor));
  for (PetscInt r = 0; r < c->bodies.scene->nramps; ++r)
    PetscCall(SceneGetFactor(c->bodies.scene, r, time, &factor[r]));
  if (!rigid->turns) PetscCall(VecZeroEntries(rigid->given));
  PetscCall(VecGetOwnershipRange(rigid->given, &rstart, NULL));
  PetscCall(VecGetArrayRead(c->bodies.places.x, &x));
  PetscCall(VecGetArray(rigid->given, &a));
  for (PetscInt b = 0; b < rigid->n; ++b) {
    IS              is;
    const PetscInt *nodes;
    PetscInt        n;

    if (rigid->bodies[b].turns) continue;
    MotionGet(c->bodies.scene, rigid->bodies[b].leader, factor, &motion);
    PetscCall(RigidGetNodes(c, &rigid->bodies[b], &is));
    PetscCall(ISGetLocalSize(is, &n));
    PetscCall(ISGetIndices(is, &nodes));
    for (PetscInt i = 0; i < 3 * n; ++i)
      a[nodes[i / 3] + i % 3 - rstart] = MotionDisplace(&motion, &x[nodes[i / 3] - rstart], i % 3);
    PetscCall(ISRestoreIndices(is, &nodes));
    PetscCall(ISDestroy(&is));
  }
  PetscCall(VecRestoreArray(rigid->given, &a));
  PetscCall(VecRestoreArrayRead(c->bodies.places.x, &x));
  PetscCall(PetscFree(factor));
  PetscCall(PrescribedSet(c->prescribed, 0.0, rigid->given));
  PetscCall(MatMult(rigid->R, rigid->given, o));
  PetscCall(VecAYPX(o, -1.0, rigid->given));
  PetscFunctionReturn(0);
}

/* Collective. Adds the springs on rigid bodies, which are the only stiffness of their rows, to the stiffness matrix. C:
   u = C x */
static PetscErrorCode RigidAddSprings(const Constraints *c, Mat C, Mat stiffness)
{
  PetscInt n;
  Mat      springs, product;
  Vec      own;

  PetscFunctionBegin;
  if (!c->springs->stiffness) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(c->springs->stiffness, &own));
  PetscCall(VecPointwiseMult(own, c->springs->stiffness, c->rigid->elastic));
  PetscCall(VecAYPX(own, -1.0, c->springs->stiffness));
  PetscCall(VecGetLocalSize(own, &n));
  PetscCall(MatCreateAIJ(c->bodies.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 1, NULL, 0, NULL, &springs));
  PetscCall(MatDiagonalSet(springs, own, INSERT_VALUES));
  PetscCall(MatPtAP(springs, C, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatAXPY(stiffness, 1.0, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&product));
  PetscCall(MatDestroy(&springs));
  PetscCall(VecDestroy(&own));
  PetscFunctionReturn(0);
}

/*
   Collective. Adds stiffness for the carrying rows to a matrix in which all diagonal entries are allocated: springs,
   and a proximal term (proximal.c) for free motions that nothing elastic resists. C: u = C x; diagonal: its entries set
   the scale of the proximal term
*/
PetscErrorCode RigidAddStiffness(const Constraints *c, Mat C, Vec diagonal, Mat stiffness)
{
  const PetscReal    fraction = SceneIsDynamic(c->bodies.scene) ? 0.0 : 1e-3; /* relative to the diagonal entry of an
                                                                              elastic body of this size */
  const PetscReal    none     = 1e-6; /* If the stiffness is above this fraction of the diagonal entry, elastic bodies
                                      that are tied to the rigid body resist the motion. */
  const PetscScalar *d;
  PetscScalar       *restraint;
  PetscInt           first, end;

  PetscFunctionBegin;
  PetscCall(RigidAddSprings(c, C, stiffness));
  PetscCall(MatGetDiagonal(stiffness, c->rigid->restraint));
  PetscCall(VecGetOwnershipRange(diagonal, &first, &end));
  PetscCall(VecGetArrayRead(diagonal, &d));
  PetscCall(VecGetArray(c->rigid->restraint, &restraint));
  for (PetscInt b = 0; b < c->rigid->n; ++b) {
    const RigidBody *body = &c->rigid->bodies[b];

    for (PetscInt k = 0; k < body->n; ++k) {
      const PetscInt i = body->row[k] - first;

      if (body->row[k] >= first && body->row[k] < end && PetscRealPart(restraint[i]) <= none * PetscRealPart(d[i]))
        restraint[i] = -fraction * d[i];
    }
  }
  for (PetscInt i = 0; i < end - first; ++i) restraint[i] = PetscMax(-PetscRealPart(restraint[i]), 0.0);
  PetscCall(VecRestoreArray(c->rigid->restraint, &restraint));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(MatDiagonalSet(stiffness, c->rigid->restraint, ADD_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode RigidDestroy(RigidBodies *rigid)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&rigid->R));
  PetscCall(VecDestroy(&rigid->elastic));
  PetscCall(VecDestroy(&rigid->given));
  PetscCall(VecDestroy(&rigid->x));
  PetscCall(VecDestroy(&rigid->restraint));
  PetscCall(PetscFree(rigid->bodies));
  PetscFunctionReturn(0);
}
