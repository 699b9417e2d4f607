/* Pairs in contact with themselves. */
#include <model.h>
#include <string.h>

/* Sets both sides of a pair with the key `self`: to the face that it names, or to the whole boundary of the body
   that it names. This body is marked. An unknown body is ignored here, because the scene is checked later. */
PetscErrorCode SceneContactPairSetSelf(PetscInt nbodies, SceneBody bodies[], SceneContactPair *pair)
{
  const PetscBool whole = (PetscBool)!strchr(pair->self, '.');
  char            face[PETSC_MAX_PATH_LEN];

  PetscFunctionBegin;
  PetscCall(PetscSNPrintf(face, sizeof(face), "%s%s", pair->self, whole ? SCENE_WHOLE_BODY : ""));
  PetscCall(PetscStrallocpy(face, &pair->mortar));
  PetscCall(PetscStrallocpy(face, &pair->nonmortar));
  for (PetscInt b = 0; whole && b < nbodies; ++b) {
    if (!strcmp(bodies[b].name, pair->self)) bodies[b].whole = PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}
