/* Creates and destroys a scene. */
#include "sceneimpl.h"
#include "src/mesh/gmsh/gmshimpl.h"
#include <string.h>

#define SCENE_CONTACT_UPDATES 20

/* Returns the name of the file without its folder and the ending .yaml. */
static PetscErrorCode SceneDefaultName(const char file[], char **name)
{
  const char *slash = strrchr(file, '/');
  char       *dot;

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(slash ? slash + 1 : file, name));
  dot = strrchr(*name, '.');
  if (dot && dot != *name) *dot = 0;
  PetscFunctionReturn(0);
}

/* Applies command line options, which override the values of the file. */
static PetscErrorCode SceneSetFromOptions(MPI_Comm comm, const char file[], Scene scene)
{
  PetscInt  nsteps = scene->nsteps, bounds = scene->displacement_bounds;
  PetscBool set, bounded;

  PetscFunctionBegin;
  PetscOptionsBegin(comm, NULL, "Scene", NULL);
  PetscCall(PetscOptionsInt("-refine", "Number of uniform refinements of the mesh", "SceneLoad", scene->refine,
    &scene->refine, NULL));
  PetscCall(PetscOptionsInt("-load_steps", "Number of equal load steps into which the scene's load program is divided",
    "SceneLoad", nsteps, &nsteps, &set));
  PetscCall(PetscOptionsEnum("-model", "Objective of a load step: the exact energy, or its quadratic model",
    "SceneLoad", StepModels, (PetscEnum)scene->model, (PetscEnum *)&scene->model, NULL));
  PetscCall(PetscOptionsInt("-contact_updates", "Largest number of contact updates per load step", "SceneLoad",
    scene->contact_updates, &scene->contact_updates, NULL));
  PetscCall(PetscOptionsInt("-displacement_bounds",
    "First load step in which no displacement may change by more than the largest earlier increment; 0: none",
    "SceneLoad", bounds, &bounds, &bounded));
  PetscOptionsEnd();
  PetscCheck(nsteps >= 1, comm, PETSC_ERR_USER_INPUT, "%s: %" PetscInt_FMT " load steps, which must be at least 1",
    file, nsteps);
  PetscCheck(nsteps <= SCENE_MAX_STEPS, comm, PETSC_ERR_USER_INPUT,
    "%s: %" PetscInt_FMT " load steps, which must be at most %d", file, nsteps, SCENE_MAX_STEPS);
  if (set && nsteps != scene->nsteps) PetscCall(SceneResample(scene, nsteps));
  if (bounded) scene->displacement_bounds = bounds;
  PetscFunctionReturn(0);
}

/*
   Divides the boundaries of bodies from mesh files into faces if the scene refers to such a face, for example
   part.surface_2.
*/
static PetscErrorCode SceneFindSurfaces(SceneKeys keys, Scene scene)
{
  PetscBool    named = PETSC_FALSE;
  MeshSurfaces surfaces;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < keys->values.n && !named; ++i)
    named = (PetscBool)(strstr(keys->values.values[i].text, "." MESH_SURFACE) != NULL);
  if (!named || keys->error[0]) PetscFunctionReturn(0);
  PetscCall(MeshSurfacesCreate(keys->comm, scene->nbodies, scene->bodies, &surfaces));
  PetscCall(MeshSurfacesDestroy(&surfaces));
  PetscFunctionReturn(0);
}

/*
   Reads the lists in the order of the table of keys. Quantities that are computed from a list are computed before
   another list needs them.
*/
static PetscErrorCode SceneReadLists(SceneKeys keys, Scene scene)
{
  PetscFunctionBegin;
  for (const SceneList *list = SceneLists; list->name; ++list) {
    if (!strcmp(list->name, "faces")) PetscCall(SceneReadFaces(keys, scene, list));
    else if (!strcmp(list->name, "symmetry")) PetscCall(SceneReadSymmetry(keys, scene));
    else if (list->entries)
      PetscCall(
        SceneReadList(keys, scene, list, (PetscInt *)((char *)scene + list->count), (char *)scene + list->entries));
    if (!strcmp(list->name, "contact")) PetscCall(SceneSplitRules(scene));
    if (!strcmp(list->name, "displacements")) PetscCall(SceneJoinMotions(scene));
    if (!strcmp(list->name, "bodies")) {
      PetscCall(SceneScaleRigid(scene));
      PetscCall(GmshConvert(keys->comm, scene->nbodies, scene->bodies));
      PetscCall(SceneFindSurfaces(keys, scene));
    }
  }
  PetscFunctionReturn(0);
}

/*@C
   SceneLoad - Reads a scene from a YAML file and validates it

   Collective

   Input Parameters:
+  comm - the communicator; the first rank reads the file
-  file - its name

   Output Parameter:
.  scene - the scene, the same on every rank

   Options Database Keys, which take precedence over the file:
+  -refine <n>               - uniform refinements of level 0
.  -load_steps <n>           - number of load steps: the load program, with all ramps, is divided into n equal time
                               steps; ramps are interpolated linearly
.  -model <energy,quadratic> - objective of a load step
.  -contact_updates <n>      - largest number of linearizations of the gap per load step; 1: the gap is not checked
-  -displacement_bounds <n>  - first load step whose displacements are bounded by the largest increment before it; 0:
                               none

   Level: beginner

   Notes:
   share/scenes/README.md documents the format: every key, its unit and default, and an example of every effect.

   The options under the key solver are set in the options database until `SceneDestroy()`, unless they are already set.

   Every error is raised on all ranks: PETSC_ERR_FILE_OPEN for a missing file, PETSC_ERR_FILE_READ for a file that is
   not YAML, PETSC_ERR_USER_INPUT for errors in its contents.

.seealso: `SceneView()`, `SceneDestroy()`, `PetscOptionsInsertStringYAML()`
@*/
PetscErrorCode SceneLoad(MPI_Comm comm, const char file[], Scene *scene)
{
  SceneKeys keys;
  Scene     s;

  PetscFunctionBegin;
  PetscCall(SceneKeysCreate(comm, file, &keys));
  PetscCall(PetscNew(&s));
  keys->top          = SceneLists[0].rows;
  s->contact_updates = SCENE_CONTACT_UPDATES;
  PetscCall(SceneReadDynamics(keys, s, SceneFindList("dynamics")));
  PetscCall(SceneReadRamps(keys, s));
  PetscCall(SceneReadRows(keys, s, "", SceneLists[0].rows, NULL, s));
  if (!s->name) PetscCall(SceneDefaultName(keys->file, &s->name));
  PetscCall(PetscStrallocpy(keys->file, &s->file));
  PetscCall(SceneReadMaterials(keys, s, SceneFindList("materials")));
  PetscCall(SceneReadLists(keys, s));
  PetscCall(SceneReadSolver(keys, s));
  PetscCall(SceneKeysCheck(keys));
  PetscCall(SceneSetFromOptions(comm, file, s));
  s->places    = keys->places;
  keys->places = (ScenePlaces){0};
  PetscCall(SceneValidate(comm, s));
  PetscCall(SceneKeysDestroy(&keys));
  PetscCall(SceneSetOptions(s));
  *scene = s;
  PetscFunctionReturn(0);
}

/*@C
   SceneDestroy - Frees a scene

   Not Collective

   Input Parameter:
.  scene - the scene, set to NULL; may point to NULL

   Level: beginner

.seealso: `SceneLoad()`
@*/
PetscErrorCode SceneDestroy(Scene *scene)
{
  Scene s = *scene;

  PetscFunctionBegin;
  if (!s) PetscFunctionReturn(0);
  for (PetscInt b = 0; b < s->nbodies; ++b) {
    for (PetscInt f = 0; f < s->bodies[b].nsubfaces; ++f) {
      PetscCall(PetscFree(s->bodies[b].subfaces[f].name));
      PetscCall(PetscFree(s->bodies[b].subfaces[f].of));
    }
    PetscCall(PetscFree(s->bodies[b].subfaces));
    PetscCall(PetscFree(s->bodies[b].material_name));
    PetscCall(GmshRemoveConverted(&s->bodies[b]));
    PetscCall(PetscFree(s->bodies[b].gmsh.file));
    PetscCall(SceneStlDestroy(&s->bodies[b].stl));
    PetscCall(PetscFree(s->bodies[b].gmsh.volume));
  }
  for (const SceneList *list = SceneLists; list->name; ++list) {
    char *entries = list->entries ? *(char **)((char *)s + list->entries) : NULL;

    if (!entries || list->shared) continue;
    for (PetscInt i = 0; i < *(PetscInt *)((char *)s + list->count); ++i) {
      PetscCall(PetscFree(*(char **)(entries + (size_t)i * list->size)));
      PetscCall(SceneFreeRows(list->rows, entries + (size_t)i * list->size));
    }
    PetscCall(PetscFree(entries));
  }
  for (PetscInt r = 0; r < s->nrules; ++r) {
    PetscCall(PetscFree(s->rules[r].name));
    PetscCall(SceneFreeRows(SceneFindList("contact")->rows, &s->rules[r]));
  }
  PetscCall(PetscFree(s->rules));
  PetscCall(SceneDestroyOptions(s));
  for (PetscInt r = 0; r < s->nramps; ++r) {
    PetscCall(PetscFree(s->ramps[r].name));
    PetscCall(PetscFree(s->ramps[r].factor));
  }
  PetscCall(PetscFree(s->ramps));
  PetscCall(PetscFree(s->units));
  PetscCall(PetscFree(s->name));
  PetscCall(PetscFree(s->file));
  PetscCall(SceneDestroyPlaces(&s->places));
  PetscCall(PetscFree(*scene));
  PetscFunctionReturn(0);
}
