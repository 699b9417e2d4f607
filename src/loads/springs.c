/* Springs: those of the scene between faces and the ground or other faces, and weak ones for bodies that move freely.
 */
#include "src/step/stepimpl.h"

/* Of every body, on all ranks; sim->mass: of unit density */
PetscErrorCode SpringsMeasureVolumes(Simulation sim, PetscReal volume[])
{
  const PetscScalar *m;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(volume, sim->scene->nbodies));
  PetscCall(VecGetLocalSize(sim->mass, &n));
  PetscCall(VecGetArrayRead(sim->mass, &m));
  for (PetscInt i = 0; i < n; i += 3) volume[sim->places.body[i / 3]] += PetscRealPart(m[i]);
  PetscCall(VecRestoreArrayRead(sim->mass, &m));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, (PetscMPIInt)sim->scene->nbodies, MPIU_REAL, MPIU_SUM, sim->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SpringsMeasureStiffness(Simulation sim, PetscReal *largest)
{
  PetscReal *volume;

  PetscFunctionBegin;
  *largest = 0.0;
  PetscCall(PetscMalloc1(sim->scene->nbodies, &volume));
  PetscCall(SpringsMeasureVolumes(sim, volume));
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b)
    *largest = PetscMax(*largest, sim->scene->bodies[b].material.young * PetscCbrtReal(volume[b]));
  PetscCall(PetscFree(volume));
  PetscFunctionReturn(0);
}

/* Bodies as a whole by their size: so much of young x length, spread over their vertices by volume */
PetscErrorCode SpringsOfSize(Simulation sim, PetscReal share, Vec stiffness)
{
  Scene              scene = sim->scene;
  PetscReal         *volume;
  const PetscScalar *m;
  PetscScalar       *k;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &volume));
  PetscCall(SpringsMeasureVolumes(sim, volume));
  PetscCall(VecGetLocalSize(sim->mass, &n));
  PetscCall(VecGetArrayRead(sim->mass, &m));
  PetscCall(VecGetArrayWrite(stiffness, &k));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt b = sim->places.body[i / 3];

    k[i] = share * scene->bodies[b].material.young * PetscCbrtReal(volume[b]) * PetscRealPart(m[i]) / volume[b];
  }
  PetscCall(VecRestoreArrayWrite(stiffness, &k));
  PetscCall(VecRestoreArrayRead(sim->mass, &m));
  PetscCall(PetscFree(volume));
  PetscFunctionReturn(0);
}

/* On the bodies that are not held. They take as little from the bodies' deformation as they are worth, and from the
   forces on them what is out of balance. */
static PetscErrorCode SpringsCreateWeak(Simulation sim)
{
  PetscBool   *unheld;
  PetscScalar *k;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(sim->scene->nbodies, &unheld));
  PetscCall(MeshGetUnheld(sim->dm, sim->scene, unheld));
  PetscCall(VecDuplicate(sim->mass, &sim->springs.weak));
  PetscCall(SpringsOfSize(sim, sim->scene->weak_springs, sim->springs.weak));
  PetscCall(VecGetLocalSize(sim->springs.weak, &n));
  PetscCall(VecGetArray(sim->springs.weak, &k));
  for (PetscInt i = 0; i < n; ++i) {
    if (!unheld[sim->places.body[i / 3]]) k[i] = 0.0;
  }
  PetscCall(VecRestoreArray(sim->springs.weak, &k));
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b) sim->springs.nweak += unheld[b];
  PetscCall(PetscFree(unheld));
  PetscFunctionReturn(0);
}

/* Before the first tangent; sim->mass and sim->places are known */
PetscErrorCode SpringsCreate(Simulation sim)
{
  Springs *springs = &sim->springs;

  PetscFunctionBegin;
  if (!sim->scene->nsprings && !sim->scene->weak_springs) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(sim->mass, &springs->stiffness));
  PetscCall(VecZeroEntries(springs->stiffness));
  for (PetscInt s = 0; s < sim->scene->nsprings; ++s) {
    if (!sim->scene->springs[s].to)
      PetscCall(ElasticityAddFaceField(sim->elasticity, sim->scene->springs[s].face, sim->scene->springs[s].value,
        springs->stiffness));
  }
  PetscCall(CouplingsCreate(sim, &springs->between));
  if (sim->scene->weak_springs) {
    PetscCall(SpringsCreateWeak(sim));
    PetscCall(VecAXPY(springs->stiffness, 1.0, springs->weak));
  }
  PetscCall(ElasticitySetSprings(sim->elasticity, springs->stiffness, springs->between));
  PetscFunctionReturn(0);
}

/* Adds the springs' forces on the bodies, 3 each, and the sum of the sizes of the weak ones' */
PetscErrorCode SpringsMeasure(Simulation sim, Vec u, PetscReal bodies[], PetscReal *weak)
{
  const PetscScalar *k, *w = NULL, *v, *f;
  PetscInt           n;
  PetscReal          sum = 0.0;
  Vec                joint;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(VecDuplicate(u, &joint));
  PetscCall(VecZeroEntries(joint));
  if (sim->springs.between) PetscCall(MatMult(sim->springs.between, u, joint));
  PetscCall(VecGetArrayRead(joint, &f));
  PetscCall(VecGetArrayRead(u, &v));
  PetscCall(VecGetArrayRead(sim->springs.stiffness, &k));
  if (sim->springs.weak) PetscCall(VecGetArrayRead(sim->springs.weak, &w));
  for (PetscInt i = 0; i < n; i += 3) {
    PetscReal square = 0.0;

    for (PetscInt d = 0; d < 3; ++d) {
      bodies[3 * sim->places.body[i / 3] + d] -= PetscRealPart(k[i + d] * v[i + d] + f[i + d]);
      if (w) square += PetscSqr(PetscRealPart(w[i + d] * v[i + d]));
    }
    sum += PetscSqrtReal(square);
  }
  if (w) PetscCall(VecRestoreArrayRead(sim->springs.weak, &w));
  PetscCall(VecRestoreArrayRead(sim->springs.stiffness, &k));
  PetscCall(VecRestoreArrayRead(u, &v));
  PetscCall(VecRestoreArrayRead(joint, &f));
  PetscCall(VecDestroy(&joint));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, bodies, (PetscMPIInt)(3 * sim->scene->nbodies), MPIU_REAL, MPIU_SUM, sim->comm));
  PetscCallMPI(MPI_Allreduce(&sum, weak, 1, MPIU_REAL, MPIU_SUM, sim->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SpringsDestroy(Springs *springs)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&springs->stiffness));
  PetscCall(VecDestroy(&springs->weak));
  PetscCall(MatDestroy(&springs->between));
  PetscFunctionReturn(0);
}
