/* Finds the body that moves without limit if the energy is unbounded below, and describes its motion */
#include "measureimpl.h"
#include <vector3.h>

/*
   Sums over the nodes of a body with coordinates X and displacements u. All members are real numbers, so that they are
   summed over the ranks at once.
*/
typedef struct {
  PetscReal n, place[3], shift[3];    /* number of nodes; sum of X; sum of u */
  PetscReal moment[3], inertia[3][3]; /* sum of X x u; sum of |X|^2 I - X X^T */
  PetscReal square;                   /* sum of |u|^2 */
} RigidFitSums;

/* The rigid motion t + w x (X - center) that fits the displacements best */
typedef struct {
  PetscReal center[3], t[3], w[3];
  PetscReal turned;   /* root mean square of w x (X - center) */
  PetscReal residual; /* root mean square of the displacements minus the motion, relative to that of the
                         displacements */
} RigidFit;

/* Finds the body with the largest displacement component, and that component. Collective. */
static PetscErrorCode RigidFitFindFarthest(Scene scene, const VertexPlaces *places, Vec u, PetscInt *farthest,
  PetscReal *distance)
{
  const PetscInt nbodies = scene->nbodies;
  PetscReal     *largest;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nbodies, &largest));
  PetscCall(VertexPlacesLargest(places, u, nbodies, largest));
  *farthest = 0;
  for (PetscInt b = 1; b < nbodies; ++b) {
    if (largest[b] > largest[*farthest]) *farthest = b;
  }
  *distance = largest[*farthest];
  PetscCall(PetscFree(largest));
  PetscFunctionReturn(0);
}

static PetscErrorCode RigidFitSum(MPI_Comm comm, const VertexPlaces *places, Vec u, PetscInt body, RigidFitSums *sums)
{
  const PetscScalar *x, *v;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(sums, sizeof(*sums)));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecGetArrayRead(places->x, &x));
  PetscCall(VecGetArrayRead(u, &v));
  for (PetscInt k = 0; k < n; k += 3) {
    const PetscReal X[3] = {PetscRealPart(x[k]), PetscRealPart(x[k + 1]), PetscRealPart(x[k + 2])};
    const PetscReal d[3] = {PetscRealPart(v[k]), PetscRealPart(v[k + 1]), PetscRealPart(v[k + 2])};
    PetscReal       moment[3];

    if (places->body[k / 3] != body) continue;
    VectorCross(X, d, moment);
    sums->n++;
    sums->square += VectorDot(d, d);
    for (PetscInt i = 0; i < 3; ++i) {
      sums->place[i] += X[i];
      sums->shift[i] += d[i];
      sums->moment[i] += moment[i];
      for (PetscInt j = 0; j < 3; ++j) sums->inertia[i][j] += (i == j) * VectorDot(X, X) - X[i] * X[j];
    }
  }
  PetscCall(VecRestoreArrayRead(u, &v));
  PetscCall(VecRestoreArrayRead(places->x, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, sizeof(*sums) / sizeof(PetscReal), MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/*
   Fits the motion by least squares: t is the mean displacement, and w follows from the inertia and the moment about the
   center
*/
static void RigidFitFit(RigidFitSums *sums, RigidFit *fit)
{
  PetscReal moment[3], turned, *inertia = &sums->inertia[0][0];

  for (PetscInt i = 0; i < 3; ++i) {
    fit->center[i] = sums->place[i] / sums->n;
    fit->t[i]      = sums->shift[i] / sums->n;
  }
  VectorCross(sums->place, fit->t, moment);
  for (PetscInt i = 0; i < 3; ++i) moment[i] = sums->moment[i] - moment[i];
  for (PetscInt k = 0; k < 9; ++k)
    inertia[k] -= (k % 4 == 0) * VectorDot(sums->place, fit->center) - sums->place[k / 3] * fit->center[k % 3];
  (void)MatrixSolve(sums->inertia, moment, fit->w);
  turned        = VectorDot(fit->w, moment) / sums->n; /* equals w . inertia w */
  fit->turned   = PetscSqrtReal(PetscMax(turned, 0.0));
  fit->residual = PetscSqrtReal(PetscMax(1.0 - (turned + VectorDot(fit->t, fit->t)) * sums->n / sums->square, 0.0));
}

/*
   Returns x rounded to a multiple of the power of ten below `unit`, without a minus sign for zero, so that rounding
   errors are not printed
*/
static PetscReal RigidFitRound(PetscReal x, PetscReal unit)
{
  const PetscReal power = PetscPowReal(10.0, PetscFloorReal(PetscLog10Real(unit)));

  return PetscFloorReal(x / power + 0.5) * power + 0.0;
}

/*
   Writes a text for the motion of a body that nothing holds: the axis if it mainly rotates, the direction if it mainly
   translates, and only the distance if it deforms by more than a tenth of its motion. distance: largest displacement
   [length]
*/
static PetscErrorCode RigidFitDescribe(RigidFitSums *sums, PetscReal distance, char text[], size_t length,
  PetscBool *turns)
{
  const PetscReal part = 0.1; /* smallest relative deformation that is mentioned */
  const PetscReal near = 0.2; /* A cube turns if the axis is not farther from its middle than two of its edges. */
  PetscReal       axis[3], arm, radius, size;
  RigidFit        fit;

  PetscFunctionBegin;
  *turns = PETSC_FALSE;
  RigidFitFit(sums, &fit);
  if (PetscIsInfOrNanReal(fit.residual) || fit.residual > part) {
    PetscCall(PetscSNPrintf(text, length, "moves the farthest, by %g", (double)distance));
    PetscFunctionReturn(0);
  }
  size   = VectorNorm(fit.w);
  *turns = (PetscBool)(fit.turned > near * VectorNorm(fit.t));
  if (*turns) {
    radius = fit.turned / size;
    VectorCross(fit.w, fit.t, axis);
    for (PetscInt i = 0; i < 3; ++i) {
      arm      = fit.center[i] + axis[i] / PetscSqr(size);
      axis[i]  = RigidFitRound(arm, 1e-2 * radius);
      fit.w[i] = RigidFitRound(fit.w[i] / size, 1e-2);
    }
    PetscCall(PetscSNPrintf(text, length, "turns about the axis along (%g, %g, %g) through (%g, %g, %g)",
      (double)fit.w[0], (double)fit.w[1], (double)fit.w[2], (double)axis[0], (double)axis[1], (double)axis[2]));
  } else {
    size = VectorNorm(fit.t);
    for (PetscInt i = 0; i < 3; ++i) fit.t[i] = RigidFitRound(fit.t[i] / size, 1e-2);
    PetscCall(PetscSNPrintf(text, length, "moves away along (%g, %g, %g)", (double)fit.t[0], (double)fit.t[1],
      (double)fit.t[2]));
  }
  PetscFunctionReturn(0);
}

/*
   Appends a description of the body with the largest displacement, and the text `known`, to the reason of a failed
   step; and the text `turning`, if it is not NULL and the body turns. Collective.
*/
PetscErrorCode RigidMotionReport(Model model, Vec u, const char known[], const char turning[], StepReport *report)
{
  RigidFitSums sums;
  PetscReal    distance = 0.0;
  PetscInt     body     = 0;
  char         motion[256];
  PetscBool    turns;

  PetscFunctionBegin;
  PetscCall(RigidFitFindFarthest(model->scene, &model->places, u, &body, &distance));
  PetscCall(RigidFitSum(model->comm, &model->places, u, body, &sums));
  PetscCall(RigidFitDescribe(&sums, distance, motion, sizeof(motion), &turns));
  PetscCall(ReportReason(report, PETSC_FALSE, "%s; body \"%s\" %s: %s%s", report->reason,
    model->scene->bodies[body].name, motion, known, turns && turning ? turning : ""));
  PetscFunctionReturn(0);
}
