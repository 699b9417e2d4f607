/*
   What is fuzzed: bytes as a scene file, up to its mesh, and bytes as the Gmsh file of one body. Both must end with a
   mesh or with one sentence, whatever the bytes are. tests/fuzz_corpus.c runs the corpus, tests/fuzz/scene.c and
   gmsh.c fuzz.
*/
#ifndef FUZZ_TARGETS_H
#define FUZZ_TARGETS_H

#include <scene.h>
#include <mesh.h>
#include <stdio.h>
#include "../attempt.h"

/* Larger meshes only cost time */
#define FUZZ_MAX_CELLS 1000

/* Few cells, and no solver options, which could make PETSc write files */
static PetscBool FuzzIsSmall(Scene scene)
{
  PetscReal ncells = 0;

  if (scene->noptions || scene->refine > 1) return PETSC_FALSE;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];
    PetscReal        n    = (PetscReal)PetscMax(1, body->layers);

    for (PetscInt d = 0; d < 3; ++d) n *= 1 + (PetscReal)PetscAbsInt(body->cells[d]);
    ncells += n;
  }
  return ncells * (scene->refine ? 8 : 1) < FUZZ_MAX_CELLS ? PETSC_TRUE : PETSC_FALSE;
}

static inline PetscErrorCode FuzzMeshScene(const char file[])
{
  Scene scene;
  DM    dm;

  PetscFunctionBeginUser;
  PetscCall(SceneLoad(PETSC_COMM_SELF, file, &scene));
  if (FuzzIsSmall(scene)) {
    PetscCall(MeshCreate(PETSC_COMM_SELF, scene->nbodies, scene->bodies, scene->refine, &dm));
    PetscCall(MeshCheckScene(dm, scene));
    PetscCall(DMDestroy(&dm));
  }
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode FuzzMeshGmsh(const char file[])
{
  char      name[] = "bar", *path;
  SceneBody body   = {.name = name,
      .shape                = SHAPE_GMSH,
      .material             = {.type = MATERIAL_LINEAR, .young = 1, .poisson = 0.3},
      .gmsh                 = {.volume = name}};
  DM        dm;

  PetscFunctionBeginUser;
  PetscCall(PetscStrallocpy(file, &path));
  body.gmsh.file = path;
  PetscCall(MeshCreate(PETSC_COMM_SELF, 1, &body, 0, &dm));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFree(path));
  PetscFunctionReturn(0);
}

/* sound: PETSC_FALSE if there was an error, whose sentence is in attempt_sentence */
static PetscErrorCode FuzzRun(PetscErrorCode (*target)(const char[]), const char file[], PetscBool *sound)
{
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(AttemptBegin());
  ierr = target(file);
  PetscCall(AttemptEnd());
  *sound = ierr ? PETSC_FALSE : PETSC_TRUE;
  PetscCheck(!ierr || attempt_sentence[0], PETSC_COMM_SELF, PETSC_ERR_PLIB, "An error without a sentence, in %s", file);
  PetscFunctionReturn(0);
}

#endif
