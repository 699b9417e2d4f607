/* Warns of bodies that slip away: they end far from where they were, and no force acts on them there */
#include "stepimpl.h"
#include <vector3.h>
#include "src/measure/measureimpl.h"
#include "src/state/control.h"
#include "src/state/path.h"

static const PetscReal far_motion = 10.0; /* motion of a body that slips away, relative to the largest of the others */
static const PetscReal no_force   = 1e-9; /* largest force that counts as none, relative to the stiffness of the bodies
                                             times the motion */

/* Collective. Computes the largest displacement of each body since the last state [length] */
static PetscErrorCode SlippedMeasure(Simulation sim, PetscReal moved[])
{
  Vec increment;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path->u, &increment));
  PetscCall(VecWAXPY(increment, -1.0, sim->path->previous_u, sim->path->u));
  PetscCall(VertexPlacesLargest(&sim->places, increment, sim->scene->nbodies, moved));
  PetscCall(VecDestroy(&increment));
  PetscFunctionReturn(0);
}

/* Returns whether a displacement that is not zero is prescribed for the body */
static PetscBool SlippedIsDriven(Scene scene, PetscInt b)
{
  for (PetscInt k = 0; k < scene->ndisplacements; ++k) {
    const SceneDisplacement *d = &scene->displacements[k];

    if (d->at == DISPLACEMENT_FACE ? SceneFaceBody(scene, d->face) != &scene->bodies[b] : d->body != b) continue;
    for (PetscInt c = 0; c < 3; ++c)
      if ((!d->released[c] && d->value[c] != 0.0) || d->rotation[c] != 0.0) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Returns the sum of the magnitudes of the forces on a body [force] */
static PetscReal SlippedForce(Scene scene, const StepReport *report, PetscInt b)
{
  const BodyReport *body = &report->bodies[b];
  PetscReal         sum =
    VectorNorm(body->reaction) + VectorNorm(body->springs) + VectorNorm(body->ties) + VectorNorm(body->load);

  for (PetscInt p = 0; p < report->npairs; ++p) {
    if (SceneFaceBody(scene, scene->pairs[p].mortar) == &scene->bodies[b] ||
        SceneFaceBody(scene, scene->pairs[p].nonmortar) == &scene->bodies[b])
      sum += report->pairs[p].normal_force;
  }
  return sum;
}

/* Collective. Finds whether no prescribed displacement, spring or tie holds a body against some motion */
static PetscErrorCode SlippedIsFree(Simulation sim, PetscInt b, PetscBool *is_free)
{
  FreeMotions m;
  PetscInt    first, end;

  PetscFunctionBegin;
  *is_free = PETSC_FALSE;
  PetscCall(FreeMotionsCreate(sim, &m));
  PetscCall(MatGetOwnershipRange(m.Z, &first, &end));
  for (PetscInt i = first; i < end && m.n; ++i) {
    const PetscScalar *values;
    PetscInt           n;

    if (sim->places.body[(i - first) / 3] != b) continue;
    PetscCall(MatGetRow(m.Z, i, &n, NULL, &values));
    for (PetscInt k = 0; k < n; ++k)
      if (PetscAbsScalar(values[k]) > PETSC_SQRT_MACHINE_EPSILON) *is_free = PETSC_TRUE;
    PetscCall(MatRestoreRow(m.Z, i, &n, NULL, &values));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, is_free, 1, MPI_PETSCBOOL, MPI_LOR, sim->comm));
  PetscCall(FreeMotionsDestroy(&m));
  PetscFunctionReturn(0);
}

/*
   Collective. Warns, once in a run, of a body that nothing but contact holds, that has moved much farther than all
   others since the last state, and on which no force acts now. It has left the contact, and may be at any other place
   as well.
*/
PetscErrorCode SlippedAwayWarn(Simulation sim, const StepReport *report)
{
  Scene      scene = sim->scene;
  PetscReal *moved, others = 0.0;
  PetscInt   farthest = 0;
  PetscBool  is_free  = PETSC_FALSE;

  PetscFunctionBegin;
  if (!sim->contact || SimulationIsDynamic(sim) || sim->control->slipped || report->nbodies != scene->nbodies)
    PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(scene->nbodies, &moved));
  PetscCall(SlippedMeasure(sim, moved));
  for (PetscInt b = 1; b < scene->nbodies; ++b)
    if (moved[b] > moved[farthest]) farthest = b;
  for (PetscInt b = 0; b < scene->nbodies; ++b)
    if (b != farthest) others = PetscMax(others, moved[b]);
  if (others > 0.0 && moved[farthest] > far_motion * others && !SlippedIsDriven(scene, farthest) &&
      SlippedForce(scene, report, farthest) <= no_force * sim->stiffness * others)
    PetscCall(SlippedIsFree(sim, farthest, &is_free));
  if (is_free) {
    sim->control->slipped = PETSC_TRUE;
    PetscCall(ReportWarn(sim->comm, &sim->report, scene->bodies[farthest].place,
      "body \"%s\" slips away in load step %" PetscInt_FMT ": it moves by %.3g, %.3g times as far as any other body, "
      "and no force acts on it there. Its position is therefore arbitrary: hold it by displacements or springs, or use "
      "smaller load steps",
      scene->bodies[farthest].name, report->step, (double)moved[farthest], (double)(moved[farthest] / others)));
  }
  PetscCall(PetscFree(moved));
  PetscFunctionReturn(0);
}
