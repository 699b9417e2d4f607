/*
   Rejects solutions in which weak springs carry a considerable part of the loads or a body moves far, because nothing
   else holds that body.
*/
#include "problemimpl.h"
#include <vector3.h>

/* largest force of the weak springs of a body, as a fraction of the sum of the magnitudes of its nodal loads */
static const PetscReal weak_springs_share = 0.01;

/*
   Measures the forces of the weak springs on each body b. carried[4 b .. 4 b + 2]: their resultant [force]; carried[4 b
   + 3]: sum of the magnitudes of the body's nodal loads [force].
*/
static PetscErrorCode WeakSpringsMeasure(Simulation sim, Vec u, Vec load, PetscReal carried[])
{
  Vec force;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecPointwiseMult(force, sim->springs.weak, u));
  PetscCall(VecScale(force, -1.0));
  PetscCall(VertexPlacesSumForces(&sim->places, force, load, sim->scene->nbodies, carried));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/* Writes the rotation of body b that only weak springs resist, as the end of a sentence. Empty if it has none. */
static PetscErrorCode WeakSpringsDescribeRotation(Simulation sim, PetscInt b, size_t size, char text[])
{
  const MeshRotation *rotation = &sim->springs.rotations[b];
  char                axis[160];

  PetscFunctionBegin;
  text[0] = 0;
  if (!rotation->free) PetscFunctionReturn(0);
  PetscCall(RotationDescribe(rotation, sizeof(axis), axis));
  PetscCall(PetscSNPrintf(text, size, "; no contact or support resists its rotation %s", axis));
  PetscFunctionReturn(0);
}

/* Reports the solve as failed if the weak springs of a body carry more than weak_springs_share of its loads. */
PetscErrorCode WeakSpringsTest(const StepProblem *p, Vec u, StepReport *report)
{
  Scene      scene = p->sim->scene;
  PetscReal *carried;

  PetscFunctionBegin;
  if (!p->sim->springs.weak || !p->load || !report->converged) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(4 * scene->nbodies, &carried));
  PetscCall(WeakSpringsMeasure(p->sim, u, p->load, carried));
  for (PetscInt b = 0; b < scene->nbodies && report->converged; ++b) {
    const PetscReal *c = &carried[4 * b], force = VectorNorm(c);
    char             reason[512], rotation[256];

    PetscCall(WeakSpringsDescribeRotation(p->sim, b, sizeof(rotation), rotation));
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "body \"%s\" slides or turns away: its weak springs carry %g, and its loads sum up to %g; add a support, or "
      "stiffer springs than weak_springs: %g%s",
      scene->bodies[b].name, (double)force, (double)c[3], (double)p->sim->springs.softness, rotation));
    if (force > weak_springs_share * c[3] && c[3] > 0.0) PetscCall(ReportReason(report, PETSC_FALSE, reason));
  }
  PetscCall(PetscFree(carried));
  PetscFunctionReturn(0);
}

/*
   Measures how far bodies on weak springs moved between u0 and u. moved[b]: square of the largest displacement of a
   vertex of body b; 0 for bodies without weak springs [length^2].
*/
static PetscErrorCode WeakSpringsMeasureMotion(Simulation sim, Vec u0, Vec u, PetscReal moved[])
{
  const PetscScalar *k, *v0, *v;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(moved, sim->scene->nbodies));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecGetArrayRead(sim->springs.weak, &k));
  PetscCall(VecGetArrayRead(u0, &v0));
  PetscCall(VecGetArrayRead(u, &v));
  for (PetscInt i = 0; i < n; i += 3) {
    PetscReal *body = &moved[sim->places.body[i / 3]], square = 0.0;

    if (!(PetscRealPart(k[i]) > 0.0)) continue;
    for (PetscInt d = 0; d < 3; ++d) square += PetscSqr(PetscRealPart(v[i + d] - v0[i + d]));
    *body = PetscMax(*body, square);
  }
  PetscCall(VecRestoreArrayRead(u, &v));
  PetscCall(VecRestoreArrayRead(u0, &v0));
  PetscCall(VecRestoreArrayRead(sim->springs.weak, &k));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, moved, (PetscMPIInt)sim->scene->nbodies, MPIU_REAL, MPIU_MAX, sim->comm));
  PetscFunctionReturn(0);
}

/*
   Reports a contact update as failed if a body on weak springs moved farther from u_linearized than its size, the cube
   root of its volume: tilted contact faces have pushed the body out.
*/
PetscErrorCode WeakSpringsTestMotion(const StepProblem *p, Vec u_linearized, Vec u, StepReport *report)
{
  const Bodies bodies = SimulationBodies(p->sim);
  Scene        scene  = p->sim->scene;
  PetscReal   *volume, *moved;

  PetscFunctionBegin;
  if (!p->sim->springs.weak || !report->converged) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(scene->nbodies, &volume, scene->nbodies, &moved));
  PetscCall(SpringsMeasureVolumes(&bodies, volume));
  PetscCall(WeakSpringsMeasureMotion(p->sim, u_linearized, u, moved));
  for (PetscInt b = 0; b < scene->nbodies && report->converged; ++b) {
    const PetscReal length = PetscCbrtReal(volume[b]), distance = PetscSqrtReal(moved[b]);
    char            reason[512], rotation[256];

    PetscCall(WeakSpringsDescribeRotation(p->sim, b, sizeof(rotation), rotation));
    PetscCall(PetscSNPrintf(reason, sizeof(reason),
      "body \"%s\" slides or turns away: it moved by %g, more than its size of %g, and only weak springs hold it; "
      "add a support, friction, or stiffer springs than weak_springs: %g%s",
      scene->bodies[b].name, (double)distance, (double)length, (double)p->sim->springs.softness, rotation));
    if (distance > length) PetscCall(ReportReason(report, PETSC_FALSE, reason));
  }
  PetscCall(PetscFree2(volume, moved));
  PetscFunctionReturn(0);
}

/*
   Reports that contact updates do not bring a body on weak springs to rest. The body that moved farthest between
   u_linearized and u, relative to its size, is named.
*/
PetscErrorCode WeakSpringsReportMotion(const StepProblem *p, Vec u_linearized, Vec u, StepReport *report)
{
  const Bodies bodies   = SimulationBodies(p->sim);
  Scene        scene    = p->sim->scene;
  PetscInt     farthest = 0;
  PetscReal   *volume, *moved;
  char         reason[512], rotation[256];

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &volume, scene->nbodies, &moved));
  PetscCall(SpringsMeasureVolumes(&bodies, volume));
  PetscCall(WeakSpringsMeasureMotion(p->sim, u_linearized, u, moved));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    moved[b] = PetscSqrtReal(moved[b]) / PetscCbrtReal(volume[b]);
    if (moved[b] > moved[farthest]) farthest = b;
  }
  PetscCall(PetscFree2(volume, moved));
  PetscCall(WeakSpringsDescribeRotation(p->sim, farthest, sizeof(rotation), rotation));
  PetscCall(PetscSNPrintf(reason, sizeof(reason),
    "body \"%s\" slides or turns away: each contact update moves it further, and only weak springs hold it; add "
    "a support, friction, or stiffer springs than weak_springs: %g%s",
    scene->bodies[farthest].name, (double)p->sim->springs.softness, rotation));
  PetscCall(ReportReason(report, PETSC_FALSE, reason));
  PetscFunctionReturn(0);
}
