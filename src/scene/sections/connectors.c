/* connectors, equations: keys that depend on one another. */
#include "sectionsimpl.h"
#include <string.h>
#include <vector3.h>

PetscBool SceneConnectorHides(const void *entry, const char key[])
{
  const SceneConnector *connector = entry;

  return (PetscBool)(!strcmp(key, "value") ? connector->axial : !strcmp(key, "stiffness") && !connector->axial);
}

PetscErrorCode SceneFinishConnector(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  SceneConnector *connector = entry;
  const char     *text;
  PetscReal       line[3];
  PetscBool       value, there;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s_body", owner));
  PetscCall(SceneHasOneOf(keys, owner, "connector", "stiffness", "value", &value));
  connector->axial = (PetscBool)!value;
  PetscCall(SceneHasKey(keys, owner, "to_point", &there));
  if (!there) PetscCall(PetscArraycpy(connector->point[1], connector->point[0], 3));
  for (int d = 0; d < 3; ++d) line[d] = connector->point[1][d] - connector->point[0][d];
  if (connector->axial && VectorNorm(line) == 0.0)
    PetscCall(SceneKeysError(keys, owner, "stiffness",
      "acts along the line from point to to_point, which must be two different points"));
  if (value && VectorNorm(connector->value) == 0.0 && connector->damping == 0.0)
    PetscCall(SceneKeysError(keys, owner, "value", "is (0, 0, 0): such a connector holds nothing"));
  if (connector->to == connector->body)
    PetscCall(
      SceneKeysError(keys, owner, "to", "is its body, %s; a connector joins two bodies, or one to the ground", text));
  PetscFunctionReturn(0);
}

PetscBool SceneEquationHides(const void *entry, const char key[])
{
  return (PetscBool)(((const SceneEquation *)entry)->to < 0 && !strncmp(key, "to_", 3));
}

PetscErrorCode SceneFinishEquation(SceneKeys keys, Scene scene, const char owner[], void *entry)
{
  const SceneEquation *equation = entry;
  const char          *text;
  PetscBool            to, point, direction;

  PetscFunctionBegin;
  (void)scene;
  PetscCall(SceneKeysGet(keys, PETSC_TRUE, &text, "%s_body", owner));
  PetscCall(SceneHasKey(keys, owner, "to", &to));
  PetscCall(SceneHasKey(keys, owner, "to_point", &point));
  PetscCall(SceneHasKey(keys, owner, "to_direction", &direction));
  if (to != point || to != direction)
    PetscCall(SceneKeysError(keys, owner, NULL, "needs all of the keys to, to_point and to_direction, or none"));
  if (VectorNorm(equation->direction[0]) == 0.0)
    PetscCall(SceneKeysError(keys, owner, "direction", "is (0, 0, 0), so that no displacement of point follows"));
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateEquations(MPI_Comm comm, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt e = 0; e < scene->nequations; ++e) {
    const SceneEquation *equation = &scene->equations[e];

    for (PetscInt end = 0; end < (equation->to < 0 ? 1 : 2); ++end) {
      const SceneBody *body = &scene->bodies[end ? equation->to : equation->body];

      SceneRequire(body->material.type != MATERIAL_RIGID, equation,
        "equation \"%s\": its body \"%s\" is rigid, and moves as a whole", equation->name, body->name);
    }
  }
  PetscFunctionReturn(0);
}
