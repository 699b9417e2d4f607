/* The softest and the stiffest elastic body of a scene */
#include "modelimpl.h"

/*@C
   SceneFindStiffest - Finds the bodies with the smallest and the largest Young's modulus

   Not Collective

   Input Parameter:
.  scene - the scene

   Output Parameters:
+  soft - the softest elastic body; NULL if all bodies are rigid
-  hard - the stiffest elastic body; NULL if all bodies are rigid

   Level: developer

.seealso: `SceneLoad()`
@*/
void SceneFindStiffest(Scene scene, const SceneBody **soft, const SceneBody **hard)
{
  *soft = *hard = NULL;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];

    if (!(body->material.young > 0.0) || body->material.type == MATERIAL_RIGID) continue;
    if (!*soft || body->material.young < (*soft)->material.young) *soft = body;
    if (!*hard || body->material.young > (*hard)->material.young) *hard = body;
  }
}

/*
   Returns the ratio of their stiffnesses if rounding errors of the forces of the stiffest body may exceed contact
   forces of the softest one, else 0. With 1e8 blocks that contact alone holds come to rest, with 1e10 they do not.
*/
PetscReal SceneRatioBeyondRounding(Scene scene, const SceneBody **soft, const SceneBody **hard)
{
  const PetscReal most = 1e9;
  PetscReal       ratio;

  SceneFindStiffest(scene, soft, hard);
  if (!*soft || !scene->npairs) return 0.0;
  ratio = (*hard)->material.young / (*soft)->material.young;
  return ratio > most ? ratio : 0.0;
}
