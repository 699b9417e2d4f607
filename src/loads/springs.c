/* Springs: those of the scene to the ground or between faces, and weak springs on bodies that are not held */
#include "loadsimpl.h"

/* Collective. Computes the volume of every body [length^3] */
PetscErrorCode SpringsMeasureVolumes(const Bodies *bodies, PetscReal volume[])
{
  const PetscScalar *m;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(volume, bodies->scene->nbodies));
  PetscCall(VecGetLocalSize(bodies->mass, &n));
  PetscCall(VecGetArrayRead(bodies->mass, &m));
  for (PetscInt i = 0; i < n; i += 3) volume[bodies->places.body[i / 3]] += PetscRealPart(m[i]);
  PetscCall(VecRestoreArrayRead(bodies->mass, &m));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, volume, (PetscMPIInt)bodies->scene->nbodies, MPIU_REAL, MPIU_SUM, bodies->comm));
  PetscFunctionReturn(0);
}

/* Collective. Computes the largest product of Young's modulus and size (cube root of the volume) of a body
   [force/length] */
PetscErrorCode SpringsMeasureStiffness(const Bodies *bodies, PetscReal *largest)
{
  PetscReal *volume;

  PetscFunctionBegin;
  *largest = 0.0;
  PetscCall(PetscMalloc1(bodies->scene->nbodies, &volume));
  PetscCall(SpringsMeasureVolumes(bodies, volume));
  for (PetscInt b = 0; b < bodies->scene->nbodies; ++b)
    *largest = PetscMax(*largest, bodies->scene->bodies[b].material.young * PetscCbrtReal(volume[b]));
  PetscCall(PetscFree(volume));
  PetscFunctionReturn(0);
}

/* Collective. Computes a stiffness per row [force/length]: that of body b is modulus[b] times its size, the cube root
   of its volume, distributed to its nodes by volume. modulus: [force/length^2] */
PetscErrorCode SpringsDistribute(const Bodies *bodies, const PetscReal modulus[], Vec stiffness)
{
  const PetscScalar *m;
  PetscScalar       *k;
  PetscReal         *volume;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(bodies->scene->nbodies, &volume));
  PetscCall(SpringsMeasureVolumes(bodies, volume));
  PetscCall(VecGetLocalSize(bodies->mass, &n));
  PetscCall(VecGetArrayRead(bodies->mass, &m));
  PetscCall(VecGetArrayWrite(stiffness, &k));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt b = bodies->places.body[i / 3];

    k[i] = volume[b] > 0.0 ? modulus[b] * PetscCbrtReal(volume[b]) / volume[b] * PetscRealPart(m[i]) : 0.0;
  }
  PetscCall(VecRestoreArrayWrite(stiffness, &k));
  PetscCall(VecRestoreArrayRead(bodies->mass, &m));
  PetscCall(PetscFree(volume));
  PetscFunctionReturn(0);
}

/* Finds whether bodies may need weak springs: if the scene asks for them, or if it has contact without friction, on
   which round bodies may rotate */
static PetscBool SpringsMayBeWeak(Scene scene)
{
  if (scene->weak_springs) return PETSC_TRUE;
  for (PetscInt p = 0; p < scene->npairs && !SceneIsDynamic(scene); ++p) {
    if (!scene->pairs[p].self && !SceneContactPairHasFriction(&scene->pairs[p])) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Collective. Finds the bodies that get weak springs. unsupported: whether each body gets them */
static PetscErrorCode SpringsFindWeak(const Bodies *bodies, Springs *springs, PetscBool unsupported[])
{
  PetscFunctionBegin;
  PetscCall(PetscCalloc1(bodies->scene->nbodies, &springs->rotations));
  PetscCall(MeshGetUnsupported(bodies->dm, bodies->scene, unsupported, springs->rotations));
  for (PetscInt b = 0; b < bodies->scene->nbodies; ++b) {
    springs->nweak += unsupported[b];
    if (!unsupported[b]) springs->rotations[b].free = PETSC_FALSE;
  }
  springs->softness = bodies->scene->weak_springs ? bodies->scene->weak_springs : MODEL_WEAK_SPRINGS;
  PetscFunctionReturn(0);
}

/* Collective. Creates weak springs on bodies that are not held. They carry unbalanced forces, and are weak beside the
   softest body, on which others may rest, so that they hardly affect the deformation. */
static PetscErrorCode SpringsCreateWeak(const Bodies *bodies, const PetscBool unsupported[], Springs *springs)
{
  const PetscInt   nbodies = bodies->scene->nbodies;
  const SceneBody *soft, *hard;
  PetscReal       *modulus;

  PetscFunctionBegin;
  SceneFindStiffest(bodies->scene, &soft, &hard);
  PetscCall(PetscCalloc1(nbodies, &modulus));
  for (PetscInt b = 0; b < nbodies; ++b)
    if (unsupported[b] && soft) modulus[b] = springs->softness * soft->material.young;
  PetscCall(VecDuplicate(bodies->mass, &springs->weak));
  PetscCall(SpringsDistribute(bodies, modulus, springs->weak));
  PetscCall(PetscFree(modulus));
  PetscFunctionReturn(0);
}

/* Collective. Creates all springs. Must be called before the first tangent is created. */
PetscErrorCode SpringsCreate(const Bodies *bodies, Springs *springs)
{
  PetscBool *unsupported, weak;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(bodies->scene->nbodies, &unsupported));
  if (SpringsMayBeWeak(bodies->scene)) PetscCall(SpringsFindWeak(bodies, springs, unsupported));
  weak = (PetscBool)(bodies->scene->weak_springs || springs->nweak);
  if (!bodies->scene->nsprings && !bodies->scene->nconnectors && !weak) {
    PetscCall(PetscFree(unsupported));
    PetscFunctionReturn(0);
  }
  PetscCall(VecDuplicate(bodies->mass, &springs->stiffness));
  PetscCall(VecZeroEntries(springs->stiffness));
  for (PetscInt s = 0; s < bodies->scene->nsprings; ++s) {
    if (!bodies->scene->springs[s].to)
      PetscCall(ElasticityAddFaceField(bodies->elasticity, bodies->scene->springs[s].face,
        bodies->scene->springs[s].value, springs->stiffness));
  }
  PetscCall(CouplingsCreate(bodies, &springs->between));
  PetscCall(ConnectorsCreate(bodies, springs));
  if (weak) {
    PetscCall(SpringsCreateWeak(bodies, unsupported, springs));
    PetscCall(VecAXPY(springs->stiffness, 1.0, springs->weak));
  }
  PetscCall(ElasticitySetSprings(bodies->elasticity, springs->stiffness, springs->between));
  PetscCall(PetscFree(unsupported));
  PetscFunctionReturn(0);
}

/* Collective. Creates `force`, the springs' forces on the nodes, and computes *weak, the sum of the magnitudes of the
   weak springs' forces [force] */
PetscErrorCode SpringsMeasure(const Springs *springs, Vec u, Vec *force, PetscReal *weak)
{
  Vec part;

  PetscFunctionBegin;
  *weak = 0.0;
  PetscCall(VecDuplicate(u, force));
  PetscCall(VecPointwiseMult(*force, springs->stiffness, u));
  if (springs->between) PetscCall(MatMultAdd(springs->between, u, *force, *force));
  PetscCall(VecScale(*force, -1.0));
  if (!springs->weak) PetscFunctionReturn(0);
  PetscCall(VecDuplicate(u, &part));
  PetscCall(VecPointwiseMult(part, springs->weak, u));
  PetscCall(NodalMagnitudesMeasure(part, weak, NULL));
  PetscCall(VecDestroy(&part));
  PetscFunctionReturn(0);
}

PetscErrorCode SpringsDestroy(Springs *springs)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&springs->stiffness));
  PetscCall(VecDestroy(&springs->weak));
  PetscCall(MatDestroy(&springs->between));
  PetscCall(MatDestroy(&springs->dampers));
  PetscCall(MatDestroy(&springs->modes));
  PetscCall(PetscFree(springs->connectors));
  PetscCall(PetscFree(springs->rotations));
  PetscFunctionReturn(0);
}
