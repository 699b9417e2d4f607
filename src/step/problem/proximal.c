/*
   Proximal point method for bodies that only contact or friction holds. The rigid body motions of such a body have no
   stiffness, but the solvers need a positive definite stiffness. Therefore 1/2 (x - centre)^T proximal (x - centre) is
   added to the energy, with a small diagonal matrix `proximal`. The centre moves to each solution until this term
   exerts no force. The convergence rate is the ratio of `proximal` to the stiffness of whatever holds the bodies.

     All bodies get this term if only friction holds an elastic body and the first solve failed.

     Bodies on weak springs get this term in frictionless contact that is updated. A linearized gap does not resist
     motions that the true gap resists with the contact force divided by a radius, such as the rotation of a pin in a
     hole. The stiffness is therefore the force on the body divided by its size. The centre is the displacement at which
     the gap is linearized, so that the term vanishes as the contact updates converge.
*/
#include "problemimpl.h"
#include <vector3.h>
#include "src/state/control.h"
#include "src/state/path.h"

/*
   After `patience` solves the force of the proximal term must fall in each solve
   below `stuck` times its last value; otherwise neither contact nor springs hold the bodies.
*/
static const PetscInt  patience = 5;
static const PetscReal stuck    = 0.9;

/* stiffness of the term after a failed solve with friction, divided by that of the bodies */
static const PetscReal friction_stiffness = 1e-4;

/* growth of the forces on the bodies that gives the term a new stiffness; the number of contact updates is the same for
   stiffnesses that differ by this factor */
static const PetscReal growth = 10.0;

/*
   Adds the energy of the proximal term at x to *energy, and its force, proximal (x - centre), to `force`. force: may be
   NULL.
*/
PetscErrorCode ProximalAdd(const StepProblem *p, Vec x, PetscReal *energy, Vec force)
{
  PetscFunctionBegin;
  if (p->centre) PetscCall(CentredAdd(1.0, NULL, p->proximal, p->centre, x, energy, force));
  PetscFunctionReturn(0);
}

/* Moves the centre to x, and updates energy and force at p->base of the quadratic model. */
static PetscErrorCode ProximalCentre(StepProblem *p, Vec x)
{
  PetscReal before = 0.0, after = 0.0;

  PetscFunctionBegin;
  if (p->force) {
    PetscCall(VecScale(p->force, -1.0));
    PetscCall(ProximalAdd(p, p->base, &before, p->force));
    PetscCall(VecScale(p->force, -1.0));
  }
  PetscCall(VecCopy(x, p->centre));
  if (p->force) PetscCall(ProximalAdd(p, p->base, &after, p->force));
  p->energy += after - before;
  PetscFunctionReturn(0);
}

/*
   Adds `proximal` to K after a failed solve, or for bodies on weak springs. For rigid bodies the tangent already
   contains this stiffness.
*/
PetscErrorCode ProximalAddStiffness(const StepProblem *p, Mat K)
{
  PetscFunctionBegin;
  if (p->failed || p->holds_weak) PetscCall(MatDiagonalSet(K, p->proximal, ADD_VALUES));
  PetscFunctionReturn(0);
}

/*
   Computes the modulus, see SpringsDistribute(), of the proximal term of each body on weak springs at the displacement
   u: the sum of the magnitudes of the nodal forces on the body, divided by the square of its size. Before the first
   solve contact forces are not known, and the largest sum of all bodies is taken. modulus[b]: 0 for bodies without weak
   springs [force/length^2]
*/
static PetscErrorCode ProximalGetWeakModulus(const StepProblem *p, Vec u, PetscReal modulus[])
{
  const Bodies   bodies  = ModelBodies(p->model);
  const PetscInt nbodies = p->model->scene->nbodies;
  PetscReal     *sums, *volume, largest = 0.0;
  Vec            force;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(4 * nbodies, &sums, nbodies, &volume));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(ElasticityForce(p->model->elasticity, u, force));
  if (p->load) PetscCall(VecAXPY(force, -1.0, p->load));
  PetscCall(VertexPlacesSumForces(&p->model->places, p->model->springs.weak, force, nbodies, sums));
  PetscCall(SpringsMeasureVolumes(&bodies, volume));
  for (PetscInt b = 0; b < nbodies; ++b) largest = PetscMax(largest, sums[4 * b + 3]);
  for (PetscInt b = 0; b < nbodies; ++b) {
    const PetscReal sum = p->weak_modulus ? sums[4 * b + 3] : largest;

    modulus[b] = VectorNorm(&sums[4 * b]) > 0.0 ? sum / PetscSqr(PetscCbrtReal(volume[b])) : 0.0;
  }
  PetscCall(VecDestroy(&force));
  PetscCall(PetscFree2(sums, volume));
  PetscFunctionReturn(0);
}

/* Adds a proximal term with the centre at p->base. modulus: see SpringsDistribute(); weak: whether the term is that of
   bodies on weak springs */
static PetscErrorCode ProximalCreate(StepProblem *p, const PetscReal modulus[], PetscBool weak)
{
  const Bodies bodies = ModelBodies(p->model);
  Mat          K;

  PetscFunctionBegin;
  p->holds_weak = weak;
  PetscCall(VecDuplicate(p->base, &p->proximal));
  PetscCall(SpringsDistribute(&bodies, modulus, p->proximal));
  PetscCall(PrescribedSet(&p->model->prescribed, 0.0, p->proximal));
  PetscCall(TiesSet(&p->model->ties, 0.0, p->proximal));
  if (p->model->quadratic) {
    PetscCall(MatDuplicate(p->model->K, MAT_COPY_VALUES, &K));
    PetscCall(ProximalAddStiffness(p, K));
    PetscCall(MatDestroy(&p->K));
    p->K = K;
  }
  PetscCall(VecDuplicate(p->base, &p->centre));
  PetscCall(VecCopy(p->base, p->centre));
  PetscFunctionReturn(0);
}

PetscErrorCode ProximalEnd(StepProblem *p)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&p->centre));
  PetscCall(VecDestroy(&p->proximal));
  PetscCall(PetscFree(p->failed));
  PetscCall(PetscFree(p->weak_modulus));
  PetscFunctionReturn(0);
}

/* Returns whether bodies on weak springs get the proximal term */
static PetscBool ProximalHoldsWeak(const StepProblem *p)
{
  const Scene scene = p->model->scene;

  if (!p->model->springs.weak || (p->centre && !p->holds_weak) || ModelIsDynamic(p->model) ||
      scene->contact_updates == 1)
    return PETSC_FALSE;
  for (PetscInt k = 0; k < scene->npairs; ++k)
    if (!SceneContactPairHasFriction(&scene->pairs[k])) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Gives bodies on weak springs a proximal term, or another one if the forces at u are much larger or smaller than those
   before */
static PetscErrorCode ProximalHoldWeak(StepProblem *p, Vec u)
{
  const PetscInt nbodies = p->model->scene->nbodies;
  PetscReal     *modulus;
  PetscBool      same = (PetscBool)(p->weak_modulus != NULL);

  PetscFunctionBegin;
  if (!ProximalHoldsWeak(p)) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(nbodies, &modulus));
  PetscCall(ProximalGetWeakModulus(p, u, modulus));
  for (PetscInt b = 0; b < nbodies && p->weak_modulus; ++b) {
    const PetscReal last = p->weak_modulus[b];

    if (modulus[b] == 0.0) modulus[b] = last; /* the body has no contact for now */
    same = (PetscBool)(same && modulus[b] <= growth * last && last <= growth * modulus[b]);
  }
  if (!same) {
    if (p->centre) PetscCall(ProximalCentre(p, p->base)); /* removes the old term from energy and force */
    PetscCall(ProximalEnd(p));
    PetscCall(ProximalCreate(p, modulus, PETSC_TRUE));
    p->weak_modulus = modulus;
  } else PetscCall(PetscFree(modulus));
  PetscFunctionReturn(0);
}

/*
   Creates the proximal term of rigid bodies or of bodies on weak springs, if the scene has such bodies. The centre is
   p->base, where energy and force of the term are zero.
*/
PetscErrorCode ProximalBegin(StepProblem *p)
{
  PetscFunctionBegin;
  if (p->model->rigid.n && !ModelIsDynamic(p->model)) {
    PetscCall(PetscObjectReference((PetscObject)p->model->rigid.restraint));
    p->proximal = p->model->rigid.restraint;
    PetscCall(VecDuplicate(p->base, &p->centre));
    PetscCall(VecCopy(p->base, p->centre));
  }
  PetscCall(ProximalHoldWeak(p, p->base));
  PetscFunctionReturn(0);
}

/* Adapts the term after p->base has changed: the centre moves to u, and the energy at p->base is updated. */
PetscErrorCode ProximalTurn(StepProblem *p, Vec u)
{
  PetscFunctionBegin;
  if (!p->centre) PetscFunctionReturn(0);
  PetscCall(VecCopy(p->base, p->centre));
  PetscCall(ProximalCentre(p, u));
  PetscFunctionReturn(0);
}

/*
   Prepares a second attempt after a failed solve with friction, in which all bodies have a proximal term centred at
   p->base. *again: true if this attempt is to be made, which is once per problem.
*/
PetscErrorCode ProximalRescue(StepProblem *p, Vec u, StepReport *report, PetscBool *again)
{
  const PetscInt nbodies = p->model->scene->nbodies;
  PetscReal     *modulus;

  PetscFunctionBegin;
  *again =
    (PetscBool)(!report->converged && p->friction.T && !p->centre && !p->lower && !p->unsupported && !p->flowing &&
                !p->state->control->interrupted && EnergyIsFinite(p->energy) && !ModelIsDynamic(p->model));
  if (!*again) PetscFunctionReturn(0);
  PetscCall(PetscStrallocpy(report->reason, &p->failed));
  PetscCall(PetscMalloc1(nbodies, &modulus));
  for (PetscInt b = 0; b < nbodies; ++b) modulus[b] = friction_stiffness * p->model->scene->bodies[b].material.young;
  PetscCall(ProximalCreate(p, modulus, PETSC_FALSE));
  PetscCall(PetscFree(modulus));
  PetscCall(VecCopy(p->base, u));
  PetscFunctionReturn(0);
}

/*
   Removes from `way`, the displacement from the centre, a motion of body b, unless the force of the proximal term that
   resists it is more than `most` [force]
*/
static PetscErrorCode ProximalRelease(StepProblem *p, PetscInt b, const BodyMotion *motion, PetscReal most, Vec way)
{
  const PetscInt nbodies = p->model->scene->nbodies;
  BodyMotion    *motions;
  PetscReal     *sums;
  PetscScalar    work, stiffness, part;
  Vec            moved, force;

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(nbodies, &motions, 4 * nbodies, &sums));
  motions[b] = *motion;
  PetscCall(VecDuplicate(way, &moved));
  PetscCall(VecDuplicate(way, &force));
  PetscCall(VertexPlacesMove(&p->model->places, NULL, motions, moved));
  PetscCall(VecPointwiseMult(force, p->proximal, moved));
  PetscCall(VecDot(way, force, &work));
  PetscCall(VecDot(moved, force, &stiffness));
  PetscCall(VertexPlacesSumForces(&p->model->places, force, force, nbodies, sums));
  part = PetscRealPart(stiffness) > 0.0 ? work / stiffness : 0.0;
  if (PetscRealPart(stiffness) > 0.0 && PetscAbsScalar(part) * sums[4 * b + 3] <= most) {
    PetscCall(VecAXPY(way, -part, moved));
    p->glides = PETSC_TRUE;
  }
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&moved));
  PetscCall(PetscFree2(motions, sums));
  PetscFunctionReturn(0);
}

/*
   Removes from `way`, the displacement from the centre, motions that no contact resists: the rotation of a pin about
   its axis, and its translation along it. The facets of a round face always cause a small torque and a small axial
   force. The proximal term holds them; otherwise they would move the body on and on. The limit is smaller for the
   translation, because the axial force of a slender taper is small too. all: forces of the deformation
*/
static PetscErrorCode ProximalReleaseGliding(StepProblem *p, Vec all, Vec way)
{
  const MeshRotation *rotations = p->model->springs.rotations;
  const PetscInt      nbodies   = p->model->scene->nbodies;
  const PetscReal     torque = 1e-2, axial = 1e-4;
  PetscReal          *sums;

  PetscFunctionBegin;
  p->glides = PETSC_FALSE;
  PetscCall(PetscMalloc1(4 * nbodies, &sums));
  PetscCall(VertexPlacesSumForces(&p->model->places, all, all, nbodies, sums));
  for (PetscInt b = 0; b < nbodies; ++b) {
    for (PetscInt k = 0; k < (rotations[b].any ? 3 : 1) && rotations[b].free; ++k) {
      BodyMotion turn = {.w = {k == 0, k == 1, k == 2}};

      if (!rotations[b].any) PetscCall(PetscArraycpy(turn.w, rotations[b].axis, 3));
      PetscCall(PetscArraycpy(turn.center, rotations[b].point, 3));
      PetscCall(ProximalRelease(p, b, &turn, torque * sums[4 * b + 3], way));
    }
    if (rotations[b].free && rotations[b].slides) {
      BodyMotion slide = {.t = {rotations[b].axis[0], rotations[b].axis[1], rotations[b].axis[2]}};

      PetscCall(ProximalRelease(p, b, &slide, axial * sums[4 * b + 3], way));
    }
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/*
   Computes the force of the proximal term at x (`proximal`), without motions of bodies on weak springs that no contact
   resists, and that of the deformation (`elastic`) in new vectors. norms: 2-norms of both [force].
*/
static PetscErrorCode ProximalGetForces(StepProblem *p, Vec x, Vec *proximal, Vec *elastic, PetscReal norms[2])
{
  PetscFunctionBegin;
  PetscCall(VecDuplicate(x, proximal));
  PetscCall(VecDuplicate(x, elastic));
  PetscCall(ElasticityForce(p->model->elasticity, x, *elastic));
  PetscCall(VecWAXPY(*proximal, -1.0, p->centre, x));
  if (p->holds_weak) PetscCall(ProximalReleaseGliding(p, *elastic, *proximal));
  PetscCall(VecPointwiseMult(*proximal, p->proximal, *proximal));
  PetscCall(VecNorm(*proximal, NORM_2, &norms[0]));
  PetscCall(VecNorm(*elastic, NORM_2, &norms[1]));
  PetscFunctionReturn(0);
}

/*
   Moves the centre to u_linearized, at which the gap is linearized, if the term holds bodies on weak springs. Motions
   that no contact resists remain as they are.
*/
PetscErrorCode ProximalLinearize(StepProblem *p, Vec u_linearized)
{
  Vec centre, elastic;

  PetscFunctionBegin;
  PetscCall(ProximalHoldWeak(p, u_linearized));
  if (!p->holds_weak) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u_linearized, &centre));
  PetscCall(VecDuplicate(u_linearized, &elastic));
  PetscCall(ElasticityForce(p->model->elasticity, u_linearized, elastic));
  PetscCall(VecWAXPY(centre, -1.0, p->centre, u_linearized));
  PetscCall(ProximalReleaseGliding(p, elastic, centre));
  PetscCall(VecAXPY(centre, 1.0, p->centre));
  PetscCall(ProximalCentre(p, centre));
  PetscCall(VecDestroy(&elastic));
  PetscCall(VecDestroy(&centre));
  PetscFunctionReturn(0);
}

/*
   Compares two forces. *fraction: maximum over the bodies of the resultant of `force` on a body divided by the sum of
   the magnitudes of the nodal forces `all`.
*/
static PetscErrorCode ProximalCompareResultants(const StepProblem *p, Vec force, Vec all, PetscReal *fraction)
{
  const PetscInt nbodies = p->model->scene->nbodies;
  PetscReal     *sums;

  PetscFunctionBegin;
  *fraction = 0.0;
  PetscCall(PetscMalloc1(4 * nbodies, &sums));
  PetscCall(VertexPlacesSumForces(&p->model->places, force, all, nbodies, sums));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (sums[4 * b + 3] > 0.0) *fraction = PetscMax(*fraction, VectorNorm(&sums[4 * b]) / sums[4 * b + 3]);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/*
   Measures the force of the proximal term that holds bodies on weak springs. *share: the larger of the norm of this
   force divided by the norm of the forces of the deformation at u, and ten times the relative resultant of this force
   on a body; 0 if there is no such term. The resultant has the larger weight because coarse facets can cause a torque,
   but not a resultant.
*/
PetscErrorCode ProximalMeasure(StepProblem *p, Vec u, PetscReal *fraction)
{
  PetscReal norms[2], resultant;
  Vec       force, all;

  PetscFunctionBegin;
  *fraction = 0.0;
  if (!p->holds_weak) PetscFunctionReturn(0);
  PetscCall(ProximalGetForces(p, u, &force, &all, norms));
  PetscCall(ProximalCompareResultants(p, force, all, &resultant));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&all));
  if (norms[1] > 0.0) *fraction = PetscMax(norms[0] / norms[1], 10.0 * resultant);
  PetscFunctionReturn(0);
}

/*
   Reports a rigid motion that continues at the same rate from solve to solve. Such a motion does not prove that nothing
   holds the body: rounding errors of a very stiff body's forces may drive it.
*/
static PetscErrorCode ProximalReportRigidMotion(StepProblem *p, Vec u, StepReport *report)
{
  const Scene      scene  = p->model->scene;
  PetscBool        mortar = PETSC_FALSE;
  const SceneBody *soft, *hard;
  Vec              increment;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < scene->npairs; ++k) mortar = (PetscBool)(mortar || scene->pairs[k].gap == GAP_MORTAR);
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, p->centre, u));
  PetscCall(ReportReason(report, PETSC_FALSE, "no equilibrium was found in which friction holds the bodies"));
  PetscCall(RigidMotionReport(p->model, increment, "it does not come to rest",
    mortar ? "; if it should stand near the edge of a face, use gap: dual" : NULL, report));
  PetscCall(VecDestroy(&increment));
  p->moves_on = (PetscBool)(SceneRatioBeyondRounding(scene, &soft, &hard) == 0.0);
  PetscFunctionReturn(0);
}

/* Reports that the load step has no equilibrium, because p->flowing flows */
PetscErrorCode ProximalReportFlow(const StepProblem *p, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE,
    "no equilibrium exists at time %g: body \"%s\" flows plastically, because the load exceeds the collapse load; the "
    "last equilibrium is at time %g",
    (double)p->time, p->flowing, (double)p->state->path->time));
  PetscFunctionReturn(0);
}

/*
   Finds whether a body flows plastically under the rigid bodies: from the centre to the solution u plastic work grew
   by a multiple of the change of the elastic energy. Sets p->flowing to its name.
*/
static PetscErrorCode ProximalTestFlow(StepProblem *p, Vec u)
{
  const PetscReal multiple = 50.0;
  PetscReal       stored[2], work[2];
  PetscInt        body;

  PetscFunctionBegin;
  PetscCall(ElasticityPlasticFlow(p->model->elasticity, p->centre, &stored[0], &work[0], &body));
  PetscCall(ElasticityPlasticFlow(p->model->elasticity, u, &stored[1], &work[1], &body));
  if (work[1] - work[0] > multiple * PetscAbsReal(stored[1] - stored[0]))
    p->flowing = p->model->scene->bodies[body].name;
  PetscFunctionReturn(0);
}

static PetscErrorCode ProximalReportRigidBodies(StepProblem *p, Vec u, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(EquilibriumDiagnose(p->model, p->state, p->time, p->load, report, &p->unsupported));
  if (!p->unsupported) PetscCall(ProximalTestFlow(p, u));
  if (p->flowing) PetscCall(ProximalReportFlow(p, report));
  else if (!p->unsupported)
    PetscCall(ReportReason(report, PETSC_FALSE,
      "no equilibrium was found for the rigid bodies that are driven by forces; use smaller load steps"));
  PetscFunctionReturn(0);
}

/*
   Moves the centre to the solution u. In every third solve it moves farther: rigid bodies are placed where a geometric
   series of their motions ends, because without this they approach the collapse load of bodies that yield very slowly.
   ratio: force of the proximal term divided by that of the last solve
*/
static PetscErrorCode ProximalMoveCentre(StepProblem *p, Vec u, PetscInt ncentres, PetscReal ratio)
{
  const PetscInt  every = 3;
  const PetscReal most  = 4.0;
  Vec             farther;

  PetscFunctionBegin;
  if (p->failed || ncentres % every || !(ratio < 1.0)) {
    PetscCall(ProximalCentre(p, u));
    PetscFunctionReturn(0);
  }
  PetscCall(VecDuplicate(u, &farther));
  PetscCall(VecWAXPY(farther, -1.0, p->centre, u));
  PetscCall(VecAYPX(farther, PetscMin(most, ratio / (1.0 - ratio)), u));
  PetscCall(ProximalCentre(p, farther));
  PetscCall(VecDestroy(&farther));
  p->carried = PETSC_INFINITY; /* the next force cannot be compared with this one */
  PetscFunctionReturn(0);
}

/*
   Tests whether the proximal term still exerts a force at the solution u. *again: true if it does, so that another
   solve must follow with the centre at u. ncentres: number of solves so far.
*/
PetscErrorCode ProximalAdvance(StepProblem *p, Vec u, PetscInt ncentres, StepReport *report, PetscBool *again)
{
  const PetscReal tolerance = StepControlRepeats(p->state->control);
  PetscReal       norms[2], ratio;
  PetscBool       falls;
  Vec             force, all;

  PetscFunctionBegin;
  *again = PETSC_FALSE;
  if (p->failed && !report->converged && !p->state->control->interrupted)
    PetscCall(ReportReason(report, PETSC_FALSE, "%s", p->failed));
  if (!p->centre || p->holds_weak || !report->converged) PetscFunctionReturn(0);
  PetscCall(ProximalGetForces(p, u, &force, &all, norms));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&all));
  if (norms[0] <= tolerance * norms[1]) PetscFunctionReturn(0);
  ratio      = p->carried > 0.0 ? norms[0] / p->carried : 1.0;
  falls      = (PetscBool)(ratio < stuck);
  *again     = (PetscBool)(ncentres < STEP_MAX_REPEATS && (ncentres <= patience || falls));
  p->carried = norms[0];
  if (*again) PetscCall(ProximalMoveCentre(p, u, ncentres, ratio));
  else if (!p->failed) PetscCall(ProximalReportRigidBodies(p, u, report));
  else if (!falls) PetscCall(ProximalReportRigidMotion(p, u, report));
  else PetscCall(ReportReason(report, PETSC_FALSE, "%s", p->failed));
  PetscFunctionReturn(0);
}
