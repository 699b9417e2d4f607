/* Materials by name: of the scene's own list, and of a library, a file with such a list and the units that its
   numbers are in */
#include "sectionsimpl.h"
#include <options.h>

static PetscErrorCode MaterialsReadEntry(SceneKeys keys, SceneMaterial *entry)
{
  char        key[SCENE_KEY_LENGTH];
  const char *text;
  PetscInt    type = MATERIAL_LINEAR;

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(key, sizeof(key), "materials_%s_law", entry->name));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "%s", key));
  if (text) PetscCall(SceneParseEnum(keys, key, text, MaterialTypes, &type));
  entry->material.type = (MaterialType)type;
  if (type == MATERIAL_RIGID) {
    PetscCall(SceneKeysComplain(keys, "%s is rigid, which needs no entry: a body has material: rigid", key));
    entry->material.type = MATERIAL_LINEAR; /* report this error, not its constants */
  }
  PetscCall(PetscSNPrintf(key, sizeof(key), "materials_%s", entry->name));
  PetscCall(SceneReadConstants(keys, key, PETSC_FALSE, &entry->material));
  PetscFunctionReturn(0);
}

/* Appends those of a file to the scene's; none has the name of a law, or of another */
static PetscErrorCode MaterialsReadList(SceneKeys keys, PetscBool required, SceneKeys scene)
{
  PetscInt n;
  char   **names;

  PetscFunctionBegin;
  PetscCall(SceneGetNames(keys, "materials", required, &n, &names));
  PetscCall(PetscRealloc((size_t)(scene->nmaterials + n) * sizeof(*scene->materials), &scene->materials));
  for (PetscInt i = 0; i < n; ++i) {
    SceneMaterial *entry = &scene->materials[scene->nmaterials];
    PetscBool      same;

    *entry = (SceneMaterial){.name = names[i]};
    PetscCall(MaterialsReadEntry(keys, entry));
    for (PetscInt t = 0; MaterialTypes[t + 2]; ++t) {
      PetscCall(PetscStrcasecmp(names[i], MaterialTypes[t], &same));
      if (same) PetscCall(SceneKeysComplain(keys, "the material name \"%s\" is taken by a law", names[i]));
    }
    for (PetscInt m = 0; m < scene->nmaterials; ++m) {
      PetscCall(PetscStrcasecmp(names[i], scene->materials[m].name, &same));
      if (same)
        PetscCall(SceneKeysComplain(keys, "the material \"%s\" stands in the scene and in its library", names[i]));
    }
    ++scene->nmaterials;
  }
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/* Its units are those of the scene, unless that says its own: they must be the same words then */
static PetscErrorCode MaterialsReadLibrary(SceneKeys keys, const char name[], Scene scene)
{
  SceneKeys   library;
  char       *file;
  const char *units;
  PetscBool   exists, same = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(name, &file));
  PetscCall(SceneResolveFile(keys->file, &file));
  PetscCall(PetscTestFile(file, 'r', &exists));
  PetscCheck(exists, keys->comm, PETSC_ERR_FILE_OPEN, "%s: there is no library \"%s\" that can be read", keys->file,
    file);
  PetscCall(SceneKeysCreate(keys->comm, file, &library));
  PetscCall(SceneKeysGet(library, PETSC_TRUE, &units, "units"));
  PetscCall(MaterialsReadList(library, PETSC_TRUE, keys));
  if (units && scene->units) PetscCall(PetscStrcmp(units, scene->units, &same));
  if (!same)
    PetscCall(
      SceneKeysComplain(keys, "units are \"%s\", those of the library %s are \"%s\"", scene->units, file, units));
  if (units && !scene->units) PetscCall(PetscStrallocpy(units, &scene->units));
  PetscCall(SceneKeysCheck(library));
  PetscCall(SceneKeysDestroy(&library));
  PetscCall(PetscFree(file));
  PetscFunctionReturn(0);
}

/* Before the bodies */
PetscErrorCode SceneReadMaterials(SceneKeys keys, Scene scene)
{
  const char *text;

  PetscFunctionBegin;
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "units"));
  if (text) PetscCall(PetscStrallocpy(text, &scene->units));
  PetscCall(MaterialsReadList(keys, PETSC_FALSE, keys));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "library"));
  if (text) PetscCall(MaterialsReadLibrary(keys, text, scene));
  PetscFunctionReturn(0);
}

/* A name that is neither a law nor a material: an error with the nearest name */
static PetscErrorCode MaterialsComplain(SceneKeys keys, const char key[], const char name[])
{
  const char **names, *nearest;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(keys->nmaterials, &names));
  for (PetscInt m = 0; m < keys->nmaterials; ++m) names[m] = keys->materials[m].name;
  PetscCall(OptionsNearest(keys->nmaterials, names, name, &nearest));
  PetscCall(SceneKeysComplain(keys,
    "%s is \"%s\", neither a law nor a material of the scene or its library; the nearest one is \"%s\"", key, name,
    nearest));
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/* The material of a body by the name of a law, which leaves constants as they are, or of a material */
PetscErrorCode SceneFindMaterial(SceneKeys keys, const char key[], const char name[], PetscBool *listed,
  Material *material)
{
  PetscInt  type = MATERIAL_LINEAR;
  PetscBool law  = PETSC_FALSE;

  PetscFunctionBegin;
  *listed = PETSC_FALSE;
  for (PetscInt m = 0; m < keys->nmaterials && !*listed; ++m) {
    PetscCall(PetscStrcasecmp(name, keys->materials[m].name, listed));
    if (*listed) *material = keys->materials[m].material;
  }
  if (*listed) PetscFunctionReturn(0);
  for (PetscInt t = 0; MaterialTypes[t + 2] && !law; ++t) PetscCall(PetscStrcasecmp(name, MaterialTypes[t], &law));
  if (!law && keys->nmaterials) {
    PetscCall(MaterialsComplain(keys, key, name));
    PetscFunctionReturn(0);
  }
  PetscCall(SceneParseEnum(keys, key, name, MaterialTypes, &type));
  material->type = (MaterialType)type;
  PetscFunctionReturn(0);
}
