/*
   materials: named materials, from the scene's own list or from a library. A library is a file with a list of materials
   and the units of its numbers.
*/
#include "sectionsimpl.h"
#include <options.h>

/* Finishes a material. Its name must not be that of a law or of another material. */
PetscErrorCode SceneFinishMaterial(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneMaterial *material = entry;
  PetscBool      same;

  PetscFunctionBegin;
  (void)scene;
  if (material->material.type == MATERIAL_RIGID) {
    PetscCall(SceneKeysError(keys, owner, "law", "is rigid: write material: rigid in the body instead"));
    material->material.type = MATERIAL_LINEAR; /* avoids a second error about the constants of the material */
  }
  PetscCall(SceneReadConstants(keys, owner, PETSC_FALSE, &material->material));
  for (PetscInt t = 0; MaterialTypes[t + 2]; ++t) {
    PetscCall(PetscStrcasecmp(material->name, MaterialTypes[t], &same));
    if (same) PetscCall(SceneKeysError(keys, owner, NULL, ": this is the name of a law; choose another name"));
  }
  PetscFunctionReturn(0);
}

/*
   Appends the materials of a file to those of the scene. keys: keys of the file, which is a library or the scene
   itself; library: true for a library; scene: keys of the scene.
*/
static PetscErrorCode MaterialsReadList(SceneKeys keys, const SceneList *rows, PetscBool library, SceneKeys scene)
{
  SceneList      list  = *rows;
  const PetscInt first = scene->nmaterials;
  PetscBool      same;

  PetscFunctionBegin;
  list.required = library;
  PetscCall(SceneReadList(keys, NULL, &list, &scene->nmaterials, &scene->materials));
  for (PetscInt i = first; i < scene->nmaterials; ++i) {
    for (PetscInt m = 0; m < first; ++m) {
      PetscCall(PetscStrcasecmp(scene->materials[i].name, scene->materials[m].name, &same));
      if (same)
        PetscCall(SceneKeysError(keys, "materials", scene->materials[i].name,
          "is defined both in the scene and in its library"));
    }
  }
  PetscFunctionReturn(0);
}

/*
   Reads a library. If the scene states no units, it has the units of the library; otherwise both texts must be equal.
*/
static PetscErrorCode MaterialsReadLibrary(SceneKeys keys, const SceneList *rows, const char name[], Scene scene)
{
  SceneKeys   library;
  char       *file;
  const char *units;
  PetscBool   exists, same = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(PetscStrallocpy(name, &file));
  PetscCall(SceneResolveFile(keys->file, &file));
  PetscCall(PetscTestFile(file, 'r', &exists));
  PetscCheck(exists, keys->comm, PETSC_ERR_FILE_OPEN, "%slibrary is \"%s\", which cannot be read",
    SceneGetPlace(&keys->places, "library"), file);
  PetscCall(PetscSNPrintf(keys->library, sizeof(keys->library), "the scene or its library %s", file));
  PetscCall(SceneKeysCreate(keys->comm, file, &library));
  PetscCall(SceneKeysGet(library, PETSC_TRUE, &units, "units"));
  PetscCall(MaterialsReadList(library, rows, PETSC_TRUE, keys));
  if (units && scene->units) PetscCall(PetscStrcmp(units, scene->units, &same));
  if (!same)
    PetscCall(SceneKeysError(keys, "units", NULL,
      "are \"%s\", those of the library %s are \"%s\": take the library in the units of the scene, or write units: %s "
      "and give all numbers of the scene in these units",
      scene->units, file, units, units));
  if (units && !scene->units) PetscCall(PetscStrallocpy(units, &scene->units));
  PetscCall(SceneKeysCheck(library));
  PetscCall(SceneKeysDestroy(&library));
  PetscCall(PetscFree(file));
  PetscFunctionReturn(0);
}

/* Reads all materials. Call this function before the bodies are read. */
PetscErrorCode SceneReadMaterials(SceneKeys keys, Scene scene, const SceneList *rows)
{
  const char *text;

  PetscFunctionBegin;
  PetscCall(MaterialsReadList(keys, rows, PETSC_FALSE, keys));
  PetscCall(SceneKeysGet(keys, PETSC_FALSE, &text, "library"));
  if (text) PetscCall(MaterialsReadLibrary(keys, rows, text, scene));
  PetscFunctionReturn(0);
}

/*
   Records an error about a name that is neither that of a law nor that of a material. The message suggests the nearest
   name, or lists all names, and says where materials are defined.
*/
static PetscErrorCode MaterialsError(SceneKeys keys, const char key[], const char name[])
{
  const char **names, *nearest;
  char         meant[512];
  size_t       distance, letters;
  PetscInt     n = 0;

  PetscFunctionBegin;
  while (MaterialTypes[n + 2]) ++n;
  PetscCall(PetscMalloc1(n + keys->nmaterials, &names));
  for (PetscInt t = 0; t < n; ++t) names[t] = MaterialTypes[t];
  for (PetscInt m = 0; m < keys->nmaterials; ++m) names[n++] = keys->materials[m].name;
  PetscCall(OptionsNearest(n, names, name, &nearest));
  PetscCall(OptionsDistance(name, nearest, &distance));
  PetscCall(PetscStrlen(name, &letters));
  if (2 * distance < letters) PetscCall(PetscSNPrintf(meant, sizeof(meant), "the nearest one is \"%s\"", nearest));
  else PetscCall(PetscStrncpy(meant, "valid are", sizeof(meant)));
  for (PetscInt k = 0; k < n && 2 * distance >= letters; ++k) {
    PetscCall(PetscStrlcat(meant, k ? ", " : " ", sizeof(meant)));
    PetscCall(PetscStrlcat(meant, names[k], sizeof(meant)));
  }
  PetscCall(SceneKeysError(keys, key, NULL, "is \"%s\", which is neither a law nor a material of %s; %s", name,
    keys->library[0] ? keys->library : "the scene (it names no library)", meant));
  keys->decides = PETSC_TRUE;
  PetscCall(PetscFree(names));
  PetscFunctionReturn(0);
}

/*
   Finds the material of a body by the name of a law, whose constants are not set here, or by the name of a material.
   *listed: true for the name of a material.
*/
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
  if (!law) PetscCall(MaterialsError(keys, key, name));
  else {
    PetscCall(SceneParseEnum(keys, key, name, MaterialTypes, &type));
    material->type = (MaterialType)type;
  }
  PetscFunctionReturn(0);
}
