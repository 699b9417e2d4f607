/* Which rule of the scene is for two surfaces */
#include "detectimpl.h"
#include <string.h>

/* Whether the name is that of a surface's body, or of the surface itself */
static PetscBool RuleNames(const char name[], size_t length, const char surface[])
{
  const size_t body = strcspn(surface, ".");

  return (PetscBool)((length == body || length == strlen(surface)) && !strncmp(name, surface, length));
}

/* Whether an item of the list, "a" or "a/b", names one of the two surfaces, or both of them */
static PetscBool RuleExcepts(const char except[], const char first[], const char second[])
{
  while (except && *except) {
    const size_t length = strcspn(except, ","), slash = PetscMin(strcspn(except, "/"), length);

    if (slash == length) {
      if (RuleNames(except, length, first) || RuleNames(except, length, second)) return PETSC_TRUE;
    } else {
      const char  *rest = except + slash + 1;
      const size_t left = length - slash - 1;

      if (RuleNames(except, slash, first) && RuleNames(rest, left, second)) return PETSC_TRUE;
      if (RuleNames(except, slash, second) && RuleNames(rest, left, first)) return PETSC_TRUE;
    }
    except += length + (except[length] == ',');
  }
  return PETSC_FALSE;
}

static PetscBool RuleIsOfBody(const char face[], const char body[])
{
  const size_t length = strlen(body);

  return (PetscBool)(!strncmp(face, body, length) && (face[length] == '.' || !face[length]));
}

/* Whether two faces or bodies belong to two bodies, in any order */
static PetscBool RuleJoins(const char one[], const char two[], const char first[], const char second[])
{
  return (PetscBool)((RuleIsOfBody(one, first) && RuleIsOfBody(two, second)) ||
                     (RuleIsOfBody(one, second) && RuleIsOfBody(two, first)));
}

const SceneContactPair *DetectFindRule(const DetectModel *model, Scene scene, PetscInt surface, PetscInt other)
{
  const MeshSurfaces     *s     = &model->surfaces;
  const SceneBody        *first = &scene->bodies[s->body[surface]], *second = &scene->bodies[s->body[other]];
  const SceneContactPair *any = NULL;

  if (first->material.type == MATERIAL_RIGID && second->material.type == MATERIAL_RIGID) return NULL;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    if (RuleJoins(scene->pairs[p].mortar, scene->pairs[p].nonmortar, first->name, second->name)) return NULL;
  }
  for (PetscInt t = 0; t < scene->nties; ++t) {
    if (RuleJoins(scene->ties[t].mortar, scene->ties[t].nonmortar, first->name, second->name)) return NULL;
  }
  for (PetscInt r = 0; r < scene->nrules; ++r) {
    if (!scene->rules[r].mortar) any = &scene->rules[r];
    else if (RuleJoins(scene->rules[r].mortar, scene->rules[r].nonmortar, first->name, second->name))
      return &scene->rules[r];
  }
  return any && RuleExcepts(any->except, s->name[surface], s->name[other]) ? NULL : any;
}
