/*
   Rejects solutions in which weak springs carry a considerable part of the loads or a body moves far, because nothing
   else holds that body.
*/
#include "problemimpl.h"
#include <vector3.h>

/* Writes the reason for which a step failed: what nothing but weak springs resists on body b */
static PetscErrorCode WeakSpringsReport(Simulation sim, PetscInt b, const char what[], StepReport *report)
{
  char reason[512];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(reason, sizeof(reason),
    "body \"%s\" slides or turns away: %s, and only weak springs hold it; add a support, friction, or stiffer springs "
    "than weak_springs: %g",
    sim->scene->bodies[b].name, what, (double)sim->springs.softness));
  PetscCall(ReportReason(report, PETSC_FALSE, reason));
  PetscFunctionReturn(0);
}

/* Reports the solve as failed if the weak springs of a body carry more than WEAK_SPRINGS_SHARE of its loads. */
PetscErrorCode WeakSpringsTest(const StepProblem *p, Vec u, StepReport *report)
{
  const PetscInt nbodies = p->sim->scene->nbodies;
  PetscReal     *carried;
  char           what[96];
  Vec            force;

  PetscFunctionBegin;
  if (!p->sim->springs.weak || !p->load || !report->converged) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(4 * nbodies, &carried));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecPointwiseMult(force, p->sim->springs.weak, u));
  PetscCall(VertexPlacesSumForces(&p->sim->places, force, p->load, nbodies, carried));
  PetscCall(VecDestroy(&force));
  for (PetscInt b = 0; b < nbodies && report->converged; ++b) {
    const PetscReal whole = carried[4 * b + 3], part = VectorNorm(&carried[4 * b]);

    if (part <= WEAK_SPRINGS_SHARE * whole || whole == 0.0) continue;
    PetscCall(PetscSNPrintf(what, sizeof(what), "%g of its loads of %g are unbalanced", (double)part, (double)whole));
    PetscCall(WeakSpringsReport(p->sim, b, what, report));
  }
  PetscCall(PetscFree(carried));
  PetscFunctionReturn(0);
}

/*
   Finds the body on weak springs that moved farthest between u0 and u, relative to its size, the cube root of its
   volume. *ratio: its motion divided by its size
*/
static PetscErrorCode WeakSpringsFindFarthest(Simulation sim, Vec u0, Vec u, PetscInt *farthest, PetscReal *ratio)
{
  const Bodies   bodies  = SimulationBodies(sim);
  const PetscInt nbodies = sim->scene->nbodies;
  PetscReal     *volume, *moved, *weak;
  Vec            increment;

  PetscFunctionBegin;
  *farthest = 0;
  *ratio    = 0.0;
  PetscCall(PetscMalloc3(nbodies, &volume, nbodies, &moved, nbodies, &weak));
  PetscCall(SpringsMeasureVolumes(&bodies, volume));
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, u0, u));
  PetscCall(VertexPlacesLargest(&sim->places, increment, nbodies, moved));
  PetscCall(VertexPlacesLargest(&sim->places, sim->springs.weak, nbodies, weak));
  PetscCall(VecDestroy(&increment));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (weak[b] == 0.0 || moved[b] <= *ratio * PetscCbrtReal(volume[b])) continue;
    *ratio    = moved[b] / PetscCbrtReal(volume[b]);
    *farthest = b;
  }
  PetscCall(PetscFree3(volume, moved, weak));
  PetscFunctionReturn(0);
}

/*
   Reports a contact update as failed if a body on weak springs moved farther from u_linearized than its size: tilted
   contact faces have pushed the body out.
*/
PetscErrorCode WeakSpringsTestMotion(const StepProblem *p, Vec u_linearized, Vec u, StepReport *report)
{
  PetscInt  farthest;
  PetscReal ratio;
  char      what[96];

  PetscFunctionBegin;
  if (!p->sim->springs.weak || !report->converged) PetscFunctionReturn(0);
  PetscCall(WeakSpringsFindFarthest(p->sim, u_linearized, u, &farthest, &ratio));
  PetscCall(PetscSNPrintf(what, sizeof(what), "it moved by %g of its size", (double)ratio));
  if (ratio > 1.0) PetscCall(WeakSpringsReport(p->sim, farthest, what, report));
  PetscFunctionReturn(0);
}

/* Reports that contact updates do not bring a body on weak springs to rest. */
PetscErrorCode WeakSpringsReportMotion(const StepProblem *p, Vec u_linearized, Vec u, StepReport *report)
{
  PetscInt  farthest;
  PetscReal ratio;

  PetscFunctionBegin;
  PetscCall(WeakSpringsFindFarthest(p->sim, u_linearized, u, &farthest, &ratio));
  PetscCall(WeakSpringsReport(p->sim, farthest, "each contact update moves it further", report));
  PetscFunctionReturn(0);
}
