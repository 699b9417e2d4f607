/* Computes the rigid motions of the bodies that only contact resists, but no prescribed displacement, spring or tie */
#include "measureimpl.h"
#include "src/state/path.h"

/*
   Gets the positions of the bodies' nodes. For bodies at small strain they are undeformed, as in the energy, unless
   rigid bodies turn.
*/
static PetscErrorCode FreeMotionsGetPlaces(Simulation sim, Vec *x)
{
  PetscBool linear;

  PetscFunctionBegin;
  PetscCall(ElasticityIsLinear(sim->elasticity, &linear));
  PetscCall(VecDuplicate(sim->places.x, x));
  PetscCall(VecCopy(sim->places.x, *x));
  if (!linear || sim->rigid.turns) PetscCall(VecAXPY(*x, 1.0, sim->path->u));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeMotionsMeasureBodies(FreeMotions *m)
{
  Simulation         sim = m->sim;
  const PetscScalar *x;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(3 * m->nbodies, &m->center, m->nbodies, &m->size));
  PetscCall(VertexPlacesGetCentres(&sim->places, m->x, m->nbodies, m->center));
  PetscCall(VecGetLocalSize(m->x, &n));
  PetscCall(VecGetArrayRead(m->x, &x));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt b = sim->places.body[i / 3];

    m->size[b] = PetscMax(m->size[b], PetscAbsReal(PetscRealPart(x[i]) - m->center[3 * b + i % 3]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, m->size, (PetscMPIInt)m->nbodies, MPIU_REAL, MPIU_MAX, sim->comm));
  PetscCall(VecRestoreArrayRead(m->x, &x));
  PetscFunctionReturn(0);
}

/*
   Computes the displacements w for motions of the bodies, 6 numbers per body: translations, and rotation angles times
   the size of the body
*/
static PetscErrorCode FreeMotionsDisplaceBodies(const FreeMotions *m, const PetscReal motion[], Vec w)
{
  const PetscScalar *x;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(w, &n));
  PetscCall(VecGetArrayRead(m->x, &x));
  PetscCall(VecGetArrayWrite(w, &a));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt   b = m->sim->places.body[i / 3], c = i % 3, d = (c + 1) % 3, e = (c + 2) % 3, v = i - c;
    const PetscReal *t = &motion[6 * b], *r = t + 3, *o = &m->center[3 * b];

    a[i] = t[c] + (r[d] * (PetscRealPart(x[v + e]) - o[e]) - r[e] * (PetscRealPart(x[v + d]) - o[d])) / m->size[b];
  }
  PetscCall(VecRestoreArrayWrite(w, &a));
  PetscCall(VecRestoreArrayRead(m->x, &x));
  PetscFunctionReturn(0);
}

/* Computes the work of forces on the bodies' motions, 6 numbers per body */
static PetscErrorCode FreeMotionsSumBodies(const FreeMotions *m, Vec force, PetscReal motion[])
{
  const PetscScalar *x, *f;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(motion, 6 * m->nbodies));
  PetscCall(VecGetLocalSize(force, &n));
  PetscCall(VecGetArrayRead(m->x, &x));
  PetscCall(VecGetArrayRead(force, &f));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt   b = m->sim->places.body[i / 3], c = i % 3, d = (c + 1) % 3, e = (c + 2) % 3, v = i - c;
    const PetscReal *o = &m->center[3 * b], value = PetscRealPart(f[i]);

    motion[6 * b + c] += value;
    motion[6 * b + 3 + d] += (PetscRealPart(x[v + e]) - o[e]) * value / m->size[b];
    motion[6 * b + 3 + e] -= (PetscRealPart(x[v + d]) - o[d]) * value / m->size[b];
  }
  PetscCall(VecRestoreArrayRead(force, &f));
  PetscCall(VecRestoreArrayRead(m->x, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, motion, (PetscMPIInt)(6 * m->nbodies), MPIU_REAL, MPIU_SUM, m->sim->comm));
  PetscFunctionReturn(0);
}

/*
   Computes the force with which prescribed, sprung and tied rows resist displacements w, with a stiffness of about 1
   each
*/
static PetscErrorCode FreeMotionsResist(const FreeMotions *m, Vec w, Vec resisted, Vec force)
{
  Simulation sim = m->sim;
  PetscReal  size;
  Vec        other, follows;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(w, &other));
  PetscCall(VecDuplicate(w, &follows));
  PetscCall(VecPointwiseMult(force, resisted, w));
  if (sim->ties.C) {
    PetscCall(MatMult(sim->ties.C, w, other));
    PetscCall(VecAYPX(other, -1.0, w));
    PetscCall(VecAXPY(force, 1.0, other));
    PetscCall(MatMultTranspose(sim->ties.C, other, follows));
    PetscCall(VecAXPY(force, -1.0, follows));
  }
  if (sim->springs.between) {
    PetscCall(MatNorm(sim->springs.between, NORM_INFINITY, &size));
    PetscCall(MatMult(sim->springs.between, w, other));
    if (size > 0.0) PetscCall(VecAXPY(force, 1.0 / size, other));
  }
  PetscCall(VecDestroy(&follows));
  PetscCall(VecDestroy(&other));
  PetscFunctionReturn(0);
}

/* Sets `resisted` to 1 in rows that are prescribed or have a spring, and to 0 in the others */
static PetscErrorCode FreeMotionsMarkResisted(Simulation sim, Vec resisted)
{
  PetscScalar       *a;
  const PetscScalar *k;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(resisted));
  PetscCall(PrescribedSet(&sim->prescribed, 1.0, resisted));
  if (!sim->springs.stiffness) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(resisted, &n));
  PetscCall(VecGetArray(resisted, &a));
  PetscCall(VecGetArrayRead(sim->springs.stiffness, &k));
  for (PetscInt i = 0; i < n; ++i) {
    if (PetscRealPart(k[i]) > 0.0) a[i] = 1.0;
  }
  PetscCall(VecRestoreArrayRead(sim->springs.stiffness, &k));
  PetscCall(VecRestoreArray(resisted, &a));
  PetscFunctionReturn(0);
}

/* Computes the symmetric matrix of the resistance to the bodies' motions, [6 nbodies x 6 nbodies] */
static PetscErrorCode FreeMotionsMeasureResistance(const FreeMotions *m, PetscReal resistance[])
{
  const PetscInt size = 6 * m->nbodies;
  PetscReal     *motion, *work;
  Vec            w, force, resisted;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(m->x, &w));
  PetscCall(VecDuplicate(m->x, &force));
  PetscCall(VecDuplicate(m->x, &resisted));
  PetscCall(FreeMotionsMarkResisted(m->sim, resisted));
  PetscCall(PetscCalloc2(size, &motion, size, &work));
  for (PetscInt k = 0; k < size; ++k) {
    motion[k] = 1.0;
    PetscCall(FreeMotionsDisplaceBodies(m, motion, w));
    PetscCall(FreeMotionsResist(m, w, resisted, force));
    PetscCall(FreeMotionsSumBodies(m, force, work));
    for (PetscInt i = 0; i < size; ++i) resistance[size * k + i] = work[i];
    motion[k] = 0.0;
  }
  PetscCall(PetscFree2(motion, work));
  PetscCall(VecDestroy(&resisted));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&w));
  PetscFunctionReturn(0);
}

/*
   Eliminates by Gauss's method, each time the motion with the largest resistance. pivot[k]: k-th eliminated motion; *n:
   number of motions with resistance.
*/
static void FreeMotionsEliminate(PetscInt size, PetscReal a[], PetscInt pivot[], PetscInt *n)
{
  const PetscReal none = 1e-9; /* relative to the resistance of a held node, which is about 1 */
  PetscBool       more = PETSC_TRUE;

  for (*n = 0; more && *n < size; *n += more) {
    PetscInt  best = PETSC_DECIDE;
    PetscReal scale;

    for (PetscInt i = 0; i < size; ++i) {
      PetscBool taken = PETSC_FALSE;

      for (PetscInt k = 0; k < *n; ++k) taken = (PetscBool)(taken || pivot[k] == i);
      if (!taken && (best < 0 || a[size * i + i] > a[size * best + best])) best = i;
    }
    more = (PetscBool)(a[size * best + best] > none);
    if (!more) break;
    pivot[*n] = best;
    scale     = 1.0 / a[size * best + best];
    for (PetscInt j = 0; j < size; ++j) a[size * best + j] *= scale;
    for (PetscInt i = 0; i < size; ++i) {
      const PetscReal factor = a[size * i + best];

      for (PetscInt j = 0; i != best && j < size; ++j) a[size * i + j] -= factor * a[size * best + j];
    }
  }
}

/* Makes motion n orthogonal to the earlier ones, and of length 1 */
static void FreeMotionsOrthonormalize(PetscInt size, PetscInt n, PetscReal motion[])
{
  PetscReal *v = &motion[size * n], square = 0.0;

  for (PetscInt k = 0; k < 2 * n; ++k) {
    const PetscReal *before = &motion[size * (k % n)];
    PetscReal        along  = 0.0;

    for (PetscInt i = 0; i < size; ++i) along += before[i] * v[i];
    for (PetscInt i = 0; i < size; ++i) v[i] -= along * before[i];
  }
  for (PetscInt i = 0; i < size; ++i) square += v[i] * v[i];
  for (PetscInt i = 0; i < size; ++i) v[i] /= PetscSqrtReal(square);
}

/* Computes the motions without resistance, one for each motion that was not eliminated */
static PetscErrorCode FreeMotionsFind(FreeMotions *m)
{
  const PetscInt size = 6 * m->nbodies;
  PetscReal     *a;
  PetscInt      *pivot, npivots;
  PetscBool     *taken;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(size * size, &a, size, &pivot));
  PetscCall(PetscCalloc1(size, &taken));
  PetscCall(FreeMotionsMeasureResistance(m, a));
  FreeMotionsEliminate(size, a, pivot, &npivots);
  for (PetscInt k = 0; k < npivots; ++k) taken[pivot[k]] = PETSC_TRUE;
  PetscCall(PetscCalloc1(size * (size - npivots), &m->motion));
  for (PetscInt j = 0; j < size; ++j) {
    if (taken[j]) continue;
    m->motion[size * m->n + j] = 1.0;
    for (PetscInt k = 0; k < npivots; ++k) m->motion[size * m->n + pivot[k]] = -a[size * pivot[k] + j];
    FreeMotionsOrthonormalize(size, m->n++, m->motion);
  }
  PetscCall(PetscFree(taken));
  PetscCall(PetscFree2(a, pivot));
  PetscFunctionReturn(0);
}

/* Computes the free motions at the last state. Collective. */
PetscErrorCode FreeMotionsCreate(Simulation sim, FreeMotions *m)
{
  PetscFunctionBegin;
  *m = (FreeMotions){.sim = sim, .nbodies = sim->scene->nbodies};
  PetscCall(FreeMotionsGetPlaces(sim, &m->x));
  PetscCall(FreeMotionsMeasureBodies(m));
  PetscCall(FreeMotionsFind(m));
  PetscFunctionReturn(0);
}

/* Computes the displacements w of a combination of the free motions */
PetscErrorCode FreeMotionsDisplace(const FreeMotions *m, const PetscReal motion[], Vec w)
{
  const PetscInt size = 6 * m->nbodies;
  PetscReal     *bodies;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(size, &bodies));
  for (PetscInt k = 0; k < m->n; ++k) {
    for (PetscInt i = 0; i < size; ++i) bodies[i] += motion[k] * m->motion[size * k + i];
  }
  PetscCall(FreeMotionsDisplaceBodies(m, bodies, w));
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(0);
}

/* Computes the work of forces on the free motions */
PetscErrorCode FreeMotionsSum(const FreeMotions *m, Vec force, PetscReal motion[])
{
  const PetscInt size = 6 * m->nbodies;
  PetscReal     *bodies;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(size, &bodies));
  PetscCall(FreeMotionsSumBodies(m, force, bodies));
  for (PetscInt k = 0; k < m->n; ++k) {
    motion[k] = 0.0;
    for (PetscInt i = 0; i < size; ++i) motion[k] += bodies[i] * m->motion[size * k + i];
  }
  PetscCall(PetscFree(bodies));
  PetscFunctionReturn(0);
}

PetscErrorCode FreeMotionsDestroy(FreeMotions *m)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(m->center, m->size));
  PetscCall(PetscFree(m->motion));
  PetscCall(VecDestroy(&m->x));
  PetscFunctionReturn(0);
}
