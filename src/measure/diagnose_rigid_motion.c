/* Finds the body that moves without limit if the energy is unbounded below, and describes its motion */
#include "measureimpl.h"
#include <vector3.h>
#include <string.h>

/* The rigid motion that fits the displacements of a body best */
typedef struct {
  BodyMotion motion;   /* about the centre of mass */
  PetscReal  turned;   /* mean distance by which the rotation moves the nodes */
  PetscReal  residual; /* mean distance of the displacements from the motion, relative to that of the displacements */
} RigidFit;

/* Collective. Computes the mean over the nodes of body b of the magnitude of a vector */
static PetscErrorCode RigidFitGetMean(Model model, Vec v, PetscInt b, PetscReal *mean)
{
  const PetscInt nbodies = model->scene->nbodies;
  PetscReal     *sums;
  Vec            ones;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(4 * nbodies, &sums));
  PetscCall(VecDuplicate(v, &ones));
  PetscCall(VecSet(ones, 1.0));
  PetscCall(VertexPlacesSumForces(&model->places, ones, v, nbodies, sums));
  *mean = sums[4 * b + 3] / sums[4 * b];
  PetscCall(VecDestroy(&ones));
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/* Collective. Fits the motion of body b: the pose after a small multiple of its displacements. distance: the largest
   of them [length] */
static PetscErrorCode RigidFitFind(Model model, Vec u, PetscInt b, PetscReal distance, RigidFit *fit)
{
  const Bodies bodies = ModelBodies(model);
  PetscReal    scale, whole;
  BodyPose    *poses;
  BodyMotion  *motions;
  Vec          moved;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(model->scene->nbodies, &poses));
  PetscCall(PetscCalloc1(model->scene->nbodies, &motions));
  PetscCall(VecNorm(model->places.x, NORM_INFINITY, &scale));
  scale *= 1e-5 / distance;
  PetscCall(VecDuplicate(u, &moved));
  PetscCall(VecCopy(u, moved));
  PetscCall(VecScale(moved, scale));
  PetscCall(PosesFind(&bodies, NULL, moved, poses));
  PoseGetVector((const PetscReal(*)[3])poses[b].Q, motions[b].w);
  for (PetscInt d = 0; d < 3; ++d) {
    motions[b].center[d] = poses[b].from[d];
    motions[b].w[d] /= scale;
  }
  PetscCall(VertexPlacesMove(&model->places, NULL, motions, moved));
  PetscCall(RigidFitGetMean(model, moved, b, &fit->turned));
  for (PetscInt d = 0; d < 3; ++d) motions[b].t[d] = (poses[b].to[d] - poses[b].from[d]) / scale;
  fit->motion = motions[b];
  PetscCall(VertexPlacesMove(&model->places, NULL, motions, moved));
  PetscCall(VecAXPY(moved, -1.0, u));
  PetscCall(RigidFitGetMean(model, moved, b, &fit->residual));
  PetscCall(RigidFitGetMean(model, u, b, &whole));
  fit->residual /= whole;
  PetscCall(VecDestroy(&moved));
  PetscCall(PetscFree(motions));
  PetscCall(PetscFree(poses));
  PetscFunctionReturn(0);
}

/*
   Writes a text for the motion of a body that nothing holds: the axis if it mainly rotates, the direction if it mainly
   translates, and only the distance if it deforms by more than a tenth of its motion. distance: largest displacement
   [length]
*/
static PetscErrorCode RigidFitDescribe(const RigidFit *fit, PetscReal distance, char text[], size_t length,
  PetscBool *turns)
{
  const PetscReal  part = 0.1; /* smallest relative deformation that is mentioned */
  const PetscReal  near = 0.2; /* A cube turns if the axis is not farther from its middle than two of its edges. */
  const PetscReal *w    = fit->motion.w;
  PetscReal        t[3] = {fit->motion.t[0], fit->motion.t[1], fit->motion.t[2]}, arm[3];
  MeshRotation     rotation;

  PetscFunctionBegin;
  *turns = PETSC_FALSE;
  if (!(fit->residual <= part)) {
    PetscCall(PetscSNPrintf(text, length, "moves the farthest, by %g", (double)distance));
    PetscFunctionReturn(0);
  }
  *turns = (PetscBool)(fit->turned > near * VectorNorm(t));
  if (*turns) {
    rotation = (MeshRotation){.axis = {w[0], w[1], w[2]}, .size = fit->turned / VectorNorm(w)};
    VectorCross(w, t, arm);
    for (PetscInt i = 0; i < 3; ++i) rotation.point[i] = fit->motion.center[i] + arm[i] / VectorDot(w, w);
    (void)VectorScaleToUnit(rotation.axis);
    PetscCall(PetscStrncpy(text, "turns ", length));
    PetscCall(RotationDescribe(&rotation, length - strlen(text), text + strlen(text)));
  } else {
    (void)VectorScaleToUnit(t);
    for (PetscInt i = 0; i < 3; ++i) t[i] = RotationRound(t[i], 1e-2);
    PetscCall(PetscSNPrintf(text, length, "moves away along (%g, %g, %g)", (double)t[0], (double)t[1], (double)t[2]));
  }
  PetscFunctionReturn(0);
}

/*
   Appends a description of the body with the largest displacement, and the text `known`, to the reason of a failed
   step; and the text `turning`, if it is not NULL and the body turns. Collective.
*/
PetscErrorCode RigidMotionReport(Model model, Vec u, const char known[], const char turning[], StepReport *report)
{
  const PetscInt nbodies = model->scene->nbodies;
  RigidFit       fit;
  PetscReal     *largest, distance;
  PetscInt       body = 0;
  char           motion[256];
  PetscBool      turns;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nbodies, &largest));
  PetscCall(VertexPlacesLargest(&model->places, u, nbodies, largest));
  for (PetscInt b = 1; b < nbodies; ++b) body = largest[b] > largest[body] ? b : body;
  distance = largest[body];
  PetscCall(PetscFree(largest));
  PetscCall(RigidFitFind(model, u, body, distance, &fit));
  PetscCall(RigidFitDescribe(&fit, distance, motion, sizeof(motion), &turns));
  PetscCall(ReportReason(report, PETSC_FALSE, "%s; body \"%s\" %s: %s%s", report->reason,
    model->scene->bodies[body].name, motion, known, turns && turning ? turning : ""));
  PetscFunctionReturn(0);
}
