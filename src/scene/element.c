/*
   Chooses the elements of bodies for which the scene names none. share/bench/elements/choice.py compares the chosen
   elements with the others.
*/
#include "sceneimpl.h"
#include <mesh.h>

#define INCOMPRESSIBLE 0.4 /* Poisson's ratio above which bbar is chosen instead of full */

/* Sets bulk and shear modulus to the means of a stiffness over all directions (Voigt) */
static void ModuliSetMeans(MaterialModuli *m)
{
  PetscReal axial = 0, lateral = 0, shear = 0;

  for (int i = 0; i < 3; ++i) {
    axial += m->stiffness[7 * i];
    lateral += m->stiffness[6 * i + (i + 1) % 3];
    shear += m->stiffness[7 * (3 + i)];
  }
  m->bulk = (axial + 2 * lateral) / 9;
  m->mu   = (axial - lateral + 3 * shear) / 15;
}

/* Computes Poisson's ratio of the isotropic part of a material law, or of the mean of an orthotropic one */
static PetscErrorCode MaterialPoisson(const Material *material, PetscReal *poisson)
{
  MaterialModuli m;

  PetscFunctionBegin;
  PetscCall(MaterialGetModuli(material, &m, NULL));
  if (material->type == MATERIAL_ORTHOTROPIC) ModuliSetMeans(&m);
  *poisson = (3 * m.bulk - 2 * m.mu) / (6 * m.bulk + 2 * m.mu);
  PetscFunctionReturn(0);
}

/* Returns whether a pressure follows a face of the body */
static PetscBool BodyIsFollowed(Scene scene, const SceneBody *body)
{
  PetscBool followed = PETSC_FALSE;

  for (PetscInt p = 0; p < scene->npressures; ++p) {
    const ScenePressure *pressure = &scene->pressures[p];

    followed = (PetscBool)(followed || (pressure->follows && SceneFaceBody(scene, pressure->face) == body));
  }
  return followed;
}

/*
   Chooses the element of a body. nnodes: number of nodes of its cells; *reason: why the element was chosen; NULL if the
   scene names it. A pressure that follows its face is solved as a sequence of linearized loads. Under such a load
   hexahedra with bbar lose their stability earlier than those with full.
*/
static PetscErrorCode BodyChooseElement(Scene scene, const SceneBody *body, PetscInt nnodes, ElementType *element,
  const char **reason)
{
  PetscReal poisson;

  PetscFunctionBegin;
  *reason = NULL;
  if (body->element != ELEMENT_AUTO || body->material.type == MATERIAL_RIGID) {
    *element = body->element == ELEMENT_AUTO ? ELEMENT_FULL : body->element;
    PetscFunctionReturn(0);
  }
  PetscCall(MaterialPoisson(&body->material, &poisson));
  if (!MaterialIsFinite(&body->material) && nnodes == 8) {
    *element = ELEMENT_INCOMPATIBLE;
    *reason  = "small strain, hexahedra of order 1";
  } else if (MaterialYields(&body->material) && MaterialIsFinite(&body->material) && nnodes > 8) {
    *element = ELEMENT_FULL; /* bbar has false equilibria if yielding metal is compressed, see plasticity_finite.sh */
    *reason  = "metal at finite strain, order 2";
  } else if (MaterialYields(&body->material)) {
    *element = ELEMENT_BBAR;
    *reason  = "plastic strain keeps the volume";
  } else if (body->material.type == MATERIAL_SAINT_VENANT) {
    *element = ELEMENT_FULL;
    *reason  = "the only element for its law";
  } else if (nnodes == 8 && poisson <= INCOMPRESSIBLE && BodyIsFollowed(scene, body)) {
    *element = ELEMENT_FULL;
    *reason  = "finite strain, pressure that follows a face";
  } else if (nnodes == 8) {
    *element = ELEMENT_BBAR;
    *reason  = "finite strain, hexahedra of order 1";
  } else if (poisson > INCOMPRESSIBLE) {
    *element = ELEMENT_BBAR;
    *reason  = "Poisson's ratio above 0.4";
  } else {
    *element = ELEMENT_FULL;
    *reason  = "Poisson's ratio of 0.4 or less";
  }
  PetscFunctionReturn(0);
}

/*@C
   SceneChooseElements - Gets the element of every body

   Collective

   Input Parameters:
+  scene - the scene
-  dm    - its mesh

   Output Parameters:
+  elements - the element that the scene names for each body, or the one that fits its law and cells
-  reasons  - why it was chosen, NULL where the scene names it; NULL if not wanted

   Level: developer

.seealso: `SceneDescribe()`, `ElasticityCreate()`
@*/
PetscErrorCode SceneChooseElements(Scene scene, DM dm, ElementType elements[], const char *reasons[])
{
  PetscInt *nnodes;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &nnodes));
  PetscCall(MeshGetBodyNodes(dm, scene->nbodies, nnodes));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const char *reason;

    PetscCall(BodyChooseElement(scene, &scene->bodies[b], nnodes[b], &elements[b], &reason));
    if (reasons) reasons[b] = reason;
  }
  PetscCall(PetscFree(nnodes));
  PetscFunctionReturn(0);
}
