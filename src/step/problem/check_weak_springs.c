/*
   Rejects solutions in which weak springs carry a considerable part of the loads or a body does not come to rest,
   because nothing else holds that body.
*/
#include "problemimpl.h"
#include <vector3.h>

/* Writes the reason for which a step failed: what nothing but weak springs resists on body b */
static PetscErrorCode WeakSpringsReport(Model model, PetscInt b, const char what[], StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(ReportReason(report, PETSC_FALSE,
    "body \"%s\" slides or turns away: %s, and only weak springs hold it; add a support, friction, or stiffer springs "
    "than weak_springs: %g",
    model->scene->bodies[b].name, what, (double)model->springs.softness));
  PetscFunctionReturn(0);
}

/* Reports the solve as failed if the weak springs of a body carry more than WEAK_SPRINGS_SHARE of its loads. */
PetscErrorCode WeakSpringsTest(const StepProblem *p, Vec u, StepReport *report)
{
  const PetscInt nbodies = p->model->scene->nbodies;
  PetscReal     *carried;
  char           what[96];
  Vec            force;

  PetscFunctionBegin;
  if (!p->model->springs.weak || !p->load || !report->converged) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(4 * nbodies, &carried));
  PetscCall(VecDuplicate(u, &force));
  PetscCall(VecPointwiseMult(force, p->model->springs.weak, u));
  PetscCall(VertexPlacesSumForces(&p->model->places, force, p->load, nbodies, carried));
  PetscCall(VecDestroy(&force));
  for (PetscInt b = 0; b < nbodies && report->converged; ++b) {
    const PetscReal whole = carried[4 * b + 3], part = VectorNorm(&carried[4 * b]);

    if (part <= WEAK_SPRINGS_SHARE * whole || whole == 0.0) continue;
    PetscCall(PetscSNPrintf(what, sizeof(what), "%g of its loads of %g are unbalanced", (double)part, (double)whole));
    PetscCall(WeakSpringsReport(p->model, b, what, report));
  }
  PetscCall(PetscFree(carried));
  PetscFunctionReturn(0);
}

/*
   Reports that contact updates do not bring a body on weak springs to rest. The body that moved farthest between
   u_linearized and u, relative to its size, is named.
*/
PetscErrorCode WeakSpringsReportMotion(const StepProblem *p, Vec u_linearized, Vec u, StepReport *report)
{
  const Bodies   bodies   = ModelBodies(p->model);
  const PetscInt nbodies  = p->model->scene->nbodies;
  PetscInt       farthest = 0;
  PetscReal     *volume, *moved, *weak, most = 0.0;
  Vec            increment;

  PetscFunctionBegin;
  PetscCall(PetscMalloc3(nbodies, &volume, nbodies, &moved, nbodies, &weak));
  PetscCall(SpringsMeasureVolumes(&bodies, volume));
  PetscCall(VecDuplicate(u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, u_linearized, u));
  PetscCall(VertexPlacesLargest(&p->model->places, increment, nbodies, moved));
  PetscCall(VertexPlacesLargest(&p->model->places, p->model->springs.weak, nbodies, weak));
  PetscCall(VecDestroy(&increment));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (weak[b] == 0.0 || moved[b] <= most * PetscCbrtReal(volume[b])) continue;
    most     = moved[b] / PetscCbrtReal(volume[b]);
    farthest = b;
  }
  PetscCall(PetscFree3(volume, moved, weak));
  PetscCall(WeakSpringsReport(p->model, farthest, "each contact update moves it further", report));
  PetscFunctionReturn(0);
}
