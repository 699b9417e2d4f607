/* Pairs in contact with themselves. */
#include <model.h>
#include <string.h>

/* Sets both sides of a pair whose `self` is set: to that face, or to the whole boundary of that body, which is marked.
   An unknown body is left to the checks of the scene */
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
