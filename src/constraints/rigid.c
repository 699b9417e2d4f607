/*
   Rigid bodies driven by forces. The displacements of all nodes depend on those of as many rows as there are free
   motions: u = R x + o, where o comes from the prescribed motions. Free rotations are small, u = r x (X - center).
*/
#include "constraintsimpl.h"

/* angle at which small rotations have a relative error of 6e-4 */
static const PetscReal largest_angle = 2.0; /* [degrees] */

static PetscBool RigidIsReleased(const SceneDisplacement *d)
{
  PetscBool released = PETSC_FALSE;

  for (PetscInt m = 0; m < 6; ++m) released = (PetscBool)(released || d->released[m]);
  return released;
}

/* row: component c of the body's free motions at X; rotations are angle x body size */
static void RigidGetRow(const SceneDisplacement *d, const RigidBody *body, const PetscScalar X[3], PetscInt c,
  PetscReal row[6])
{
  for (PetscInt k = 0; k < body->n; ++k) {
    const PetscInt m = body->motion[k], next = (m + 1) % 3, last = (m + 2) % 3;

    row[k] = m == c ? 1.0 : 0.0;
    if (m >= 3 && c == next) row[k] = -(PetscRealPart(X[last]) - d->center[last]) / body->size;
    if (m >= 3 && c == last) row[k] = (PetscRealPart(X[next]) - d->center[next]) / body->size;
  }
}

/* First global row of each node that this rank owns */
static PetscErrorCode RigidGetNodes(const Constraints *c, const RigidBody *body, IS *nodes)
{
  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(c->bodies.dm, c->bodies.scene->displacements[body->leader].face, 0, nodes));
  PetscFunctionReturn(0);
}

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

/* Finds the row whose motions have the largest component orthogonal to those of the carrying rows, unit[]; it
   becomes the next carrying row */
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

    RigidGetRow(&c->bodies.scene->displacements[body->leader], body, &x[nodes[i / 3] - rstart], i % 3, row);
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

/* Inverse of an n x n matrix by Gauss-Jordan elimination with row pivoting */
static void RigidInvert(PetscInt n, PetscReal a[6][6], PetscReal inverse[6][6])
{
  for (PetscInt i = 0; i < 36; ++i) inverse[i / 6][i % 6] = i / 6 == i % 6 ? 1.0 : 0.0;
  for (PetscInt k = 0; k < n; ++k) {
    PetscInt  p = k;
    PetscReal scale;

    for (PetscInt i = k; i < n; ++i) p = PetscAbsReal(a[i][k]) > PetscAbsReal(a[p][k]) ? i : p;
    for (PetscInt j = 0; j < n; ++j) {
      const PetscReal swap[2] = {a[p][j], inverse[p][j]};

      a[p][j]       = a[k][j];
      inverse[p][j] = inverse[k][j];
      a[k][j]       = swap[0];
      inverse[k][j] = swap[1];
    }
    scale = 1.0 / a[k][k];
    for (PetscInt j = 0; j < n; ++j) {
      a[k][j] *= scale;
      inverse[k][j] *= scale;
    }
    for (PetscInt i = 0; i < n; ++i) {
      const PetscReal factor = a[i][k];

      for (PetscInt j = 0; i != k && j < n; ++j) {
        a[i][j] -= factor * a[k][j];
        inverse[i][j] -= factor * inverse[k][j];
      }
    }
  }
}

/* Sets the rows of R; carrying rows are exact unit rows */
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
    RigidGetRow(&c->bodies.scene->displacements[body->leader], body, &x[nodes[i / 3] - rstart], i % 3, motion);
    for (PetscInt k = 0; k < body->n; ++k) {
      PetscReal share = 0.0;

      for (PetscInt m = 0; m < body->n; ++m) share += motion[m] * body->inverse[m][k];
      if (PetscAbsReal(share) > 1e-14) PetscCall(MatSetValue(c->rigid->R, row, body->row[k], share, INSERT_VALUES));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode RigidCreateBody(const Constraints *c, PetscInt leader, const PetscBool prescribed[],
  PetscBool mine[], PetscBool follows[], RigidBody *body)
{
  const SceneDisplacement *d = &c->bodies.scene->displacements[leader];
  IS                       is;
  const PetscInt          *nodes;
  const PetscScalar       *x;
  PetscInt                 n, rstart;
  PetscReal                unit[6][6], carriers[6][6];

  PetscFunctionBegin;
  body->leader = leader;
  body->n      = 0;
  for (PetscInt m = 0; m < 6; ++m) {
    if (d->released[m]) body->motion[body->n++] = m;
  }
  PetscCall(RigidGetNodes(c, body, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &nodes));
  PetscCall(VecGetOwnershipRange(c->bodies.places.x, &rstart, NULL));
  PetscCall(VecGetArrayRead(c->bodies.places.x, &x));
  PetscCall(RigidMeasure(c, rstart, x, n, nodes, body));
  for (PetscInt k = 0; k < body->n; ++k) PetscCall(RigidFindCarrier(c, rstart, x, n, nodes, k, unit, carriers, body));
  RigidInvert(body->n, carriers, body->inverse);
  PetscCall(RigidSetRows(c, body, rstart, x, n, nodes, prescribed, mine, follows));
  PetscCall(VecRestoreArrayRead(c->bodies.places.x, &x));
  PetscCall(ISRestoreIndices(is, &nodes));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* Sets up rigid bodies driven by forces; call after the prescribed rows. prescribed and follows: of this rank's
   rows. Without such bodies nothing is created */
PetscErrorCode RigidCreate(const Constraints *c, const PetscBool prescribed[], PetscBool follows[])
{
  RigidBodies *rigid = c->rigid;
  Scene        scene = c->bodies.scene;
  PetscInt     n, rstart;
  PetscBool   *mine;
  PetscScalar *elastic;

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    rigid->n += RigidIsReleased(&scene->displacements[d]) && MotionFindLeader(scene, d) == d;
  if (!rigid->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(rigid->n, &rigid->bodies));
  PetscCall(VecDuplicate(c->bodies.mass, &rigid->elastic));
  PetscCall(VecDuplicate(c->bodies.mass, &rigid->given));
  PetscCall(VecDuplicate(c->bodies.mass, &rigid->held));
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &rstart, NULL));
  PetscCall(PetscCalloc1(n, &mine));
  PetscCall(MatCreateAIJ(c->bodies.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 6, NULL, 6, NULL, &rigid->R));
  rigid->n = 0;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    if (RigidIsReleased(&scene->displacements[d]) && MotionFindLeader(scene, d) == d)
      PetscCall(RigidCreateBody(c, d, prescribed, mine, follows, &rigid->bodies[rigid->n++]));
  }
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

/* o: displacements of dependent rows by prescribed motions */
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
  PetscCall(VecZeroEntries(rigid->given));
  PetscCall(VecGetOwnershipRange(rigid->given, &rstart, NULL));
  PetscCall(VecGetArrayRead(c->bodies.places.x, &x));
  PetscCall(VecGetArray(rigid->given, &a));
  for (PetscInt b = 0; b < rigid->n; ++b) {
    IS              is;
    const PetscInt *nodes;
    PetscInt        n;

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

/* Adds springs on rigid bodies, whose own rows have no other stiffness; C: u = C x */
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

/* Adds springs, and the proximal stiffness of the free motions (proximal.c), to a matrix that has all diagonal
   entries */
PetscErrorCode RigidAddStiffness(const Constraints *c, Mat C, Vec diagonal, Mat stiffness)
{
  const PetscReal    share = SceneIsDynamic(c->bodies.scene) ? 0.0 : 1e-3; /* of an elastic body of this size */
  const PetscScalar *d;
  PetscScalar       *held;
  PetscInt           first, end;

  PetscFunctionBegin;
  PetscCall(RigidAddSprings(c, C, stiffness));
  PetscCall(VecZeroEntries(c->rigid->held));
  PetscCall(VecGetOwnershipRange(diagonal, &first, &end));
  PetscCall(VecGetArrayRead(diagonal, &d));
  PetscCall(VecGetArray(c->rigid->held, &held));
  for (PetscInt b = 0; b < c->rigid->n; ++b) {
    const RigidBody *body = &c->rigid->bodies[b];

    for (PetscInt k = 0; k < body->n; ++k) {
      if (body->row[k] >= first && body->row[k] < end) held[body->row[k] - first] = share * d[body->row[k] - first];
    }
  }
  PetscCall(VecRestoreArray(c->rigid->held, &held));
  PetscCall(VecRestoreArrayRead(diagonal, &d));
  PetscCall(MatDiagonalSet(stiffness, c->rigid->held, ADD_VALUES));
  PetscFunctionReturn(0);
}

/* Marks the solve as failed if a free rotation is not small */
PetscErrorCode RigidTest(const Constraints *c, Vec u, StepReport *report)
{
  const PetscScalar *a, *given;
  PetscInt           first, end;

  PetscFunctionBegin;
  if (!c->rigid->n || !report->converged) PetscFunctionReturn(0);
  PetscCall(VecGetOwnershipRange(u, &first, &end));
  PetscCall(VecGetArrayRead(u, &a));
  PetscCall(VecGetArrayRead(c->rigid->given, &given));
  for (PetscInt b = 0; b < c->rigid->n; ++b) {
    const RigidBody *body     = &c->rigid->bodies[b];
    PetscReal        moved[6] = {0.0}, square = 0.0, degrees;
    char             reason[256];

    for (PetscInt k = 0; k < body->n; ++k)
      moved[k] = body->row[k] >= first && body->row[k] < end
                   ? PetscRealPart(a[body->row[k] - first] - given[body->row[k] - first])
                   : 0.0;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, moved, 6, MPIU_REAL, MPIU_SUM, c->bodies.comm));
    for (PetscInt k = 0; k < body->n; ++k) {
      PetscReal angle = 0.0;

      for (PetscInt m = 0; m < body->n; ++m) angle += body->inverse[k][m] * moved[m] / body->size;
      if (body->motion[k] >= 3) square += PetscSqr(angle);
    }
    degrees = PetscSqrtReal(square) * 180.0 / PETSC_PI;
    if (!(degrees > largest_angle)) continue;
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "displacement \"%s\": the rigid body turns by %.3g degrees, but a free rotation may be at most %.0f degrees: "
      "prescribe the rotation, or add supports",
      c->bodies.scene->displacements[body->leader].name, (double)degrees, (double)largest_angle));
    PetscCall(ReportReason(report, PETSC_FALSE, reason));
  }
  PetscCall(VecRestoreArrayRead(c->rigid->given, &given));
  PetscCall(VecRestoreArrayRead(u, &a));
  PetscFunctionReturn(0);
}

PetscErrorCode RigidDestroy(RigidBodies *rigid)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&rigid->R));
  PetscCall(VecDestroy(&rigid->elastic));
  PetscCall(VecDestroy(&rigid->given));
  PetscCall(VecDestroy(&rigid->held));
  PetscCall(PetscFree(rigid->bodies));
  PetscFunctionReturn(0);
}
