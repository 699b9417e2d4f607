/* The life of a scene */
#include "sceneimpl.h"
#include <string.h>

/* The file's name without folders and .yaml */
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

static PetscErrorCode SceneReadProblem(SceneKeys keys, Scene scene)
{
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "problem"));
  if (text) PetscCall(PetscStrallocpy(text, &scene->name));
  else PetscCall(SceneDefaultName(keys->file, &scene->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "refine"));
  if (text) PetscCall(SceneParseInt(keys, "refine", text, &scene->refine));
  PetscFunctionReturn(0);
}

/* The command line wins over the file */
static PetscErrorCode SceneSetFromOptions(MPI_Comm comm, Scene scene)
{
  PetscInt  nsteps = scene->nsteps;
  PetscBool set;

  PetscFunctionBegin;
  PetscOptionsBegin(comm, NULL, "Scene", NULL);
  PetscCall(PetscOptionsInt("-refine", "Uniform refinements of level 0", "SceneLoad", scene->refine, &scene->refine, NULL));
  PetscCall(PetscOptionsInt("-load_steps", "Load steps of equal size", "SceneLoad", nsteps, &nsteps, &set));
  PetscOptionsEnd();
  if (set) PetscCall(SceneSetUniformLoad(scene, nsteps));
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

   Options Database Keys:
+  -refine <n>     - uniform refinements of level 0, instead of the file's
-  -load_steps <n> - load steps of equal size, instead of the file's

   Level: beginner

   Notes:
   A scene holds these keys. Lists of named things keep their order; a name is a letter, then letters, digits, _ or -.
   A number may be a fraction, as -5/7. Lengths, forces and pressures are in any consistent units.
.vb
   problem: two_block                  # optional; the file's name
   bodies:
     - slab:
         shape: box                    # optional
         lower: [-4.5, -2, -4.5]       # corners [length]
         upper: [4.5, 2, -1.5]
         cells: [20, 6, 3]             # hexahedra along x, y, z at level 0
         material: linear              # optional; or neohookean
         young: 1                      # [force/length^2]
         poisson: 0.499
   displacements:                      # prescribed, times the load factor [length]
     - bottom: {face: slab.zmin, value: [0, 0, 0]}
     - top:    {face: block.zmax, value: [free, free, -5/7]}
   contact:                            # optional; the nonmortar face carries the constraints
     - blocks: {mortar: slab.zmax, nonmortar: block.zmin}
   load: {steps: 2}                    # or {factors: [0.5, 1]}; optional, 1 step
   refine: 1                           # optional, 0
.ve
   The faces of a box are xmin, xmax, ymin, ymax, zmin and zmax.

   Every error is raised on all ranks: PETSC_ERR_FILE_OPEN and PETSC_ERR_FILE_READ for a file that is not there or no
   YAML, PETSC_ERR_USER_INPUT for what it says.

.seealso: `SceneView()`, `SceneDestroy()`, `PetscOptionsInsertFileYAML()`
@*/
PetscErrorCode SceneLoad(MPI_Comm comm, const char file[], Scene *scene)
{
  SceneKeys keys;
  Scene     s;

  PetscFunctionBegin;
  PetscCall(SceneKeysCreate(comm, file, &keys));
  PetscCall(PetscNew(&s));
  PetscCall(SceneReadProblem(keys, s));
  PetscCall(SceneReadBodies(keys, s));
  PetscCall(SceneReadDisplacements(keys, s));
  PetscCall(SceneReadContact(keys, s));
  PetscCall(SceneReadLoad(keys, s));
  PetscCall(SceneKeysCheck(keys));
  PetscCall(SceneKeysDestroy(&keys));
  PetscCall(SceneSetFromOptions(comm, s));
  PetscCall(SceneValidate(comm, file, s));
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
  for (PetscInt b = 0; b < s->nbodies; ++b) PetscCall(PetscFree(s->bodies[b].name));
  for (PetscInt d = 0; d < s->ndisplacements; ++d) {
    PetscCall(PetscFree(s->displacements[d].name));
    PetscCall(PetscFree(s->displacements[d].face));
  }
  for (PetscInt p = 0; p < s->npairs; ++p) {
    PetscCall(PetscFree(s->pairs[p].name));
    PetscCall(PetscFree(s->pairs[p].mortar));
    PetscCall(PetscFree(s->pairs[p].nonmortar));
  }
  PetscCall(PetscFree(s->bodies));
  PetscCall(PetscFree(s->displacements));
  PetscCall(PetscFree(s->pairs));
  for (PetscInt r = 0; r < s->nramps; ++r) {
    PetscCall(PetscFree(s->ramps[r].name));
    PetscCall(PetscFree(s->ramps[r].factor));
  }
  PetscCall(PetscFree(s->ramps));
  PetscCall(PetscFree(s->name));
  PetscCall(PetscFree(*scene));
  PetscFunctionReturn(0);
}
