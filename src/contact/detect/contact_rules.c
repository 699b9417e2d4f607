/* Finds the rule of the scene that applies to two surfaces */
#include "detectimpl.h"
#include <string.h>

/* Returns whether the name, of this length, is that of a surface's body or of the surface itself */
static PetscBool RuleNames(const char name[], size_t length, const char surface[])
{
  const size_t body = strcspn(surface, ".");

  return (PetscBool)((length == body || length == strlen(surface)) && !strncmp(name, surface, length));
}

/* Returns whether the list of exceptions excludes two surfaces. An item "a" excludes them if it names either; an item
   "a/b" if it names both. */
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

/* Returns whether a face belongs to the body, or is the name of the body */
static PetscBool RuleIsOfBody(const char face[], const char body[])
{
  const size_t length = strlen(body);

  return (PetscBool)(!strncmp(face, body, length) && (face[length] == '.' || !face[length]));
}

/* Returns whether `one` and `two`, which are faces or bodies, belong to the two bodies, in any order */
static PetscBool RuleJoins(const char one[], const char two[], const char first[], const char second[])
{
  return (PetscBool)((RuleIsOfBody(one, first) && RuleIsOfBody(two, second)) ||
                     (RuleIsOfBody(one, second) && RuleIsOfBody(two, first)));
}

/* Returns whether a body is rigid and has no free motions */
static PetscBool RuleIsDriven(Scene scene, const SceneBody *body)
{
  if (body->material.type != MATERIAL_RIGID) return PETSC_FALSE;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    const SceneDisplacement *motion = &scene->displacements[d];

    if (SceneFreesMotion(motion) && SceneFaceBody(scene, motion->face) == body) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Finds the rule for two surfaces. Two driven rigid bodies have no rule, nor have two rigid surfaces, nor bodies for
   which the scene lists a contact pair or a tie. A rule that names both bodies goes before a rule for all bodies. */
const SceneContactPair *DetectFindRule(const DetectModel *model, Scene scene, PetscInt surface, PetscInt other)
{
  const MeshSurfaces     *s     = &model->surfaces;
  const SceneBody        *first = &scene->bodies[s->body[surface]], *second = &scene->bodies[s->body[other]];
  const SceneContactPair *any = NULL;

  if (RuleIsDriven(scene, first) && RuleIsDriven(scene, second)) return NULL;
  if (SceneBodyIsSurface(first) && SceneBodyIsSurface(second)) return NULL;
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

/* Returns whether a rule with the key `self` adds a pair for this body in contact with itself. The body must have a
   law of finite strain, the rule must not except it, and the scene must list no pair between its faces. */
PetscBool DetectWantsSelf(Scene scene, const SceneContactPair *rule, const SceneBody *body)
{
  if (!MaterialIsFinite(&body->material) || RuleExcepts(rule->except, body->name, body->name)) return PETSC_FALSE;
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    if (RuleJoins(scene->pairs[p].mortar, scene->pairs[p].nonmortar, body->name, body->name)) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}
