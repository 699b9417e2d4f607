/*
   Pretension of bolts. In each solve the shortenings of the bolts' sections are fixed. For linear bodies the energy of
   equilibrium is a convex function of the shortenings, and its derivatives are the section forces. Where the scene
   gives forces, the shortenings are updated from one solve to the next by the method of Broyden, Fletcher, Goldfarb and
   Shanno. The matrix of this method is the compliance of the bolts and the clamped parts. It is kept for all solves of
   the run.
*/
#include "loadsimpl.h"
#include <vector3.h>

static const PetscInt max_solves = 40;

/* Creates the sections of the bolts */
PetscErrorCode BoltsCreate(const Bodies *bodies, Bolts *bolts)
{
  Scene          scene = bodies->scene;
  const PetscInt n     = scene->nbolts;

  PetscFunctionBegin;
  bolts->n = n;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscCalloc6(n, &bolts->force, n, &bolts->shortening, n, &bolts->target, n, &bolts->now, n, &bolts->driven,
    n * n, &bolts->compliance));
  PetscCall(PetscCalloc3(n, &bolts->tried[0], n, &bolts->tried[1], n, &bolts->most));
  for (PetscInt b = 0; b < n; ++b) {
    const SceneBolt *bolt = &scene->bolts[b];
    PetscInt         ncells;

    PetscCall(ElasticityAddSection(bodies->elasticity, bolt->body, bolt->point, bolt->axis, &ncells));
    SceneCheck(ncells, bodies->comm, PETSC_ERR_USER_INPUT, bolt,
      "bolt \"%s\": the plane through its point (%g, %g, %g) with its axis (%g, %g, %g) does not cut its body \"%s\"",
      bolt->name, (double)bolt->point[0], (double)bolt->point[1], (double)bolt->point[2], (double)bolt->axis[0],
      (double)bolt->axis[1], (double)bolt->axis[2], scene->bodies[bolt->body].name);
    SceneCheck(ncells > 0, bodies->comm, PETSC_ERR_USER_INPUT, bolt,
      "bolt \"%s\": its section and that of another bolt cut the same cells of body \"%s\"; move its point or refine "
      "the mesh",
      bolt->name, scene->bodies[bolt->body].name);
  }
  PetscFunctionReturn(0);
}

/* Computes the length of the bolt's body along the axis of the bolt [length] */
static PetscErrorCode BoltsMeasureLength(const Bodies *bodies, const SceneBolt *bolt, PetscReal *length)
{
  const PetscScalar *x;
  PetscReal          ends[2] = {PETSC_NINFINITY, PETSC_NINFINITY}; /* largest coordinate along the axis, and against
                                                                      it [length] */
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(bodies->places.x, &n));
  PetscCall(VecGetArrayRead(bodies->places.x, &x));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal place[3] = {PetscRealPart(x[i]), PetscRealPart(x[i + 1]), PetscRealPart(x[i + 2])};
    const PetscReal along    = VectorDot(place, bolt->axis) / VectorNorm(bolt->axis);

    if (bodies->places.body[i / 3] != bolt->body) continue;
    ends[0] = PetscMax(ends[0], along);
    ends[1] = PetscMax(ends[1], -along);
  }
  PetscCall(VecRestoreArrayRead(bodies->places.x, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPIU_REAL, MPIU_MAX, bodies->comm));
  *length = ends[0] + ends[1];
  PetscFunctionReturn(0);
}

/* Computes the compliance for the first solve: that of a bar with the length and volume of the body, or that of the cut
   cells if it is larger. u: any displacement */
static PetscErrorCode BoltsGuess(const Bodies *bodies, Bolts *bolts, Vec u)
{
  const PetscReal part = 1e-6;
  PetscReal      *volume, *before, *after;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(bodies->scene->nbodies, &volume, bolts->n, &before, bolts->n, &after));
  PetscCall(SpringsMeasureVolumes(bodies, volume));
  PetscCall(ElasticityGetSectionForces(bodies->elasticity, u, before));
  for (PetscInt b = 0; b < bolts->n; ++b) {
    const SceneBolt *bolt  = &bodies->scene->bolts[b];
    const PetscReal  young = bodies->scene->bodies[bolt->body].material.young;
    PetscReal        length, layer;

    PetscCall(BoltsMeasureLength(bodies, bolt, &length));
    PetscCall(ElasticitySetShortening(bodies->elasticity, b, bolts->now[b] + part * length));
    PetscCall(ElasticityGetSectionForces(bodies->elasticity, u, after));
    PetscCall(ElasticitySetShortening(bodies->elasticity, b, bolts->now[b]));
    layer                               = part * length / (after[b] - before[b]);
    bolts->compliance[b * bolts->n + b] = PetscMax(layer, length * length / (young * volume[bolt->body]));
    bolts->most[b]                      = length;
  }
  PetscCall(PetscFree3(volume, before, after));
  PetscFunctionReturn(0);
}

/* Updates the shortenings of driven bolts: now += compliance (target - force) */
static void BoltsFollow(Bolts *bolts, const PetscReal force[])
{
  for (PetscInt b = 0; b < bolts->n; ++b) {
    for (PetscInt k = 0; k < bolts->n && bolts->driven[b]; ++k) {
      if (bolts->driven[k]) bolts->now[b] += bolts->compliance[b * bolts->n + k] * (bolts->target[k] - force[k]);
    }
  }
}

/* Sets the shortenings of the sections for the next solve */
static PetscErrorCode BoltsApply(const Bodies *bodies, const Bolts *bolts)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < bolts->n; ++b) PetscCall(ElasticitySetShortening(bodies->elasticity, b, bolts->now[b]));
  PetscFunctionReturn(0);
}

/* Sets forces and shortenings for a load step that ends at `time`. u: displacement at the last state */
PetscErrorCode BoltsBegin(const Bodies *bodies, Bolts *bolts, PetscReal time, Vec u)
{
  const PetscReal rounding = 1e-9;

  PetscFunctionBegin;
  if (!bolts->n) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < bolts->n; ++b) {
    const SceneBolt *bolt = &bodies->scene->bolts[b];
    PetscReal        factor;

    PetscCall(SceneGetFactor(bodies->scene, bolt->ramp, time, &factor));
    bolts->driven[b] = (PetscBool)(!bolt->shortens && !(bolt->lock && time > (PetscReal)bolt->lock + rounding));
    bolts->now[b]    = bolt->shortens ? factor * bolt->shortening : bolts->shortening[b];
    bolts->target[b] = bolts->driven[b] ? factor * bolt->force : 0.0;
  }
  bolts->tries = PETSC_FALSE;
  PetscCall(BoltsApply(bodies, bolts));
  if (!bolts->nslopes) PetscCall(BoltsGuess(bodies, bolts, u));
  BoltsFollow(bolts, bolts->force);
  PetscCall(BoltsApply(bodies, bolts));
  PetscFunctionReturn(0);
}

/* Updates the compliance with the changes of force and shortening between the last two solves of this load step */
static PetscErrorCode BoltsLearn(Bolts *bolts, const PetscReal force[])
{
  const PetscInt  n    = bolts->n;
  const PetscReal most = 30.0; /* largest factor by which the compliance grows in one update. Before the bolts clamp
                                  their parts, the measured compliance may be much too large. */
  PetscReal      *s, *y, *Hy, ys = 0.0, yHy = 0.0, scale;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(n, &s, n, &y, n, &Hy));
  for (PetscInt b = 0; b < n; ++b) {
    s[b] = bolts->driven[b] ? bolts->now[b] - bolts->tried[0][b] : 0.0;
    y[b] = bolts->driven[b] ? force[b] - bolts->tried[1][b] : 0.0;
  }
  for (PetscInt b = 0; b < n; ++b) {
    Hy[b] = 0.0;
    for (PetscInt k = 0; k < n; ++k) Hy[b] += bolts->compliance[b * n + k] * y[k];
    ys += y[b] * s[b];
    yHy += y[b] * Hy[b];
  }
  scale = ys > 0.0 && yHy > 0.0 ? ys / yHy : PETSC_INFINITY;
  if (scale > most || !bolts->nslopes) {
    for (PetscInt i = 0; i < n * n; ++i) bolts->compliance[i] *= PetscMin(scale, most);
    for (PetscInt b = 0; b < n; ++b) Hy[b] *= PetscMin(scale, most);
    yHy *= PetscMin(scale, most);
  }
  ++bolts->nslopes;
  for (PetscInt b = 0; b < n && scale <= most; ++b) {
    for (PetscInt k = 0; k < n; ++k)
      bolts->compliance[b * n + k] += (1.0 + yHy / ys) * s[b] * s[k] / ys - (Hy[b] * s[k] + s[b] * Hy[k]) / ys;
  }
  PetscCall(PetscFree3(s, y, Hy));
  PetscFunctionReturn(0);
}

/*
   Updates the shortenings after a solve with the solution u. *again becomes true if another solve must follow, because
   a force differs from the given force by more than the relative tolerance. *failed: name of a bolt whose force is not
   reached in max_solves solves, or only with a shortening longer than the bolt; NULL if there is none
*/
PetscErrorCode BoltsAdvance(const Bodies *bodies, Bolts *bolts, PetscReal tolerance, Vec u, PetscBool *again,
  const char **failed)
{
  const PetscReal accuracy =
    100.0; /* changes of forces below this many tolerances may be due to the accuracy of solves,
                                       or to an update of the contact */
  PetscReal *force, largest = 0.0, off = 0.0, change = 0.0;
  PetscInt   worst = 0;

  PetscFunctionBegin;
  *failed = NULL;
  if (!bolts->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(bolts->n, &force));
  PetscCall(ElasticityGetSectionForces(bodies->elasticity, u, force));
  for (PetscInt b = 0; b < bolts->n; ++b) {
    largest = PetscMax(largest, PetscAbsReal(bolts->target[b]));
    if (bolts->driven[b]) change = PetscMax(change, PetscAbsReal(force[b] - bolts->tried[1][b]));
  }
  for (PetscInt b = 0; b < bolts->n; ++b) {
    if (!bolts->driven[b] || PetscAbsReal(force[b] - bolts->target[b]) <= off) continue;
    off   = PetscAbsReal(force[b] - bolts->target[b]);
    worst = b;
  }
  if (bolts->tries && change >= accuracy * tolerance * largest) PetscCall(BoltsLearn(bolts, force));
  ++bolts->nsolves;
  bolts->tries = PETSC_TRUE;
  PetscCall(PetscArraycpy(bolts->tried[0], bolts->now, bolts->n));
  PetscCall(PetscArraycpy(bolts->tried[1], force, bolts->n));
  if (off > tolerance * largest) {
    BoltsFollow(bolts, force);
    PetscCall(BoltsApply(bodies, bolts));
    for (PetscInt b = 0; b < bolts->n; ++b) {
      if (PetscAbsReal(bolts->now[b]) > bolts->most[b]) *failed = bodies->scene->bolts[b].name;
    }
    if (bolts->nsolves >= max_solves) *failed = bodies->scene->bolts[worst].name;
    *again = (PetscBool) !*failed;
  }
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}

/* Makes the forces and shortenings at u those of the last state. *work: work that the pretension has done since the
   previous state [force length] */
PetscErrorCode BoltsSettle(const Bodies *bodies, Bolts *bolts, Vec u, PetscReal *work)
{
  PetscReal *force;

  PetscFunctionBegin;
  *work = 0.0;
  if (!bolts->n) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(bolts->n, &force));
  PetscCall(ElasticityGetSectionForces(bodies->elasticity, u, force));
  for (PetscInt b = 0; b < bolts->n; ++b) {
    *work += 0.5 * (force[b] + bolts->force[b]) * (bolts->now[b] - bolts->shortening[b]);
    bolts->force[b]      = force[b];
    bolts->shortening[b] = bolts->now[b];
  }
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}

/* Sets the shortenings and forces of the last state at u, which was read from a checkpoint with its shortenings */
PetscErrorCode BoltsRestore(const Bodies *bodies, Bolts *bolts, Vec u)
{
  PetscFunctionBegin;
  if (!bolts->n) PetscFunctionReturn(0);
  PetscCall(PetscArraycpy(bolts->now, bolts->shortening, bolts->n));
  PetscCall(BoltsApply(bodies, bolts));
  PetscCall(ElasticityGetSectionForces(bodies->elasticity, u, bolts->force));
  PetscFunctionReturn(0);
}

PetscErrorCode BoltsDestroy(Bolts *bolts)
{
  PetscFunctionBegin;
  if (!bolts->n) PetscFunctionReturn(0);
  PetscCall(PetscFree6(bolts->force, bolts->shortening, bolts->target, bolts->now, bolts->driven, bolts->compliance));
  PetscCall(PetscFree3(bolts->tried[0], bolts->tried[1], bolts->most));
  PetscFunctionReturn(0);
}
