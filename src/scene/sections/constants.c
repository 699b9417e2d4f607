/* Constants of a material: read, viewed, described and checked */
#include "sectionsimpl.h"
#include <petscviewer.h>
#include <string.h>

/* <owner>_<constant>, each required unless the material has a name, whose constants it then replaces. A law without
   an expansion says which have one, where it is given */
PetscErrorCode SceneReadConstants(SceneKeys keys, const char owner[], PetscBool listed, Material *m)
{
  static const char *const directions[] = {"first_axis", "second_axis"};
  PetscBool                has;

  PetscFunctionBegin;
  PetscCall(SceneReadRows(keys, NULL, owner, SceneConstantRows, MaterialTypes[m->type], listed, m));
  for (PetscInt i = 0; i < 2 && m->type == MATERIAL_ORTHOTROPIC; ++i) {
    PetscCall(SceneHasKey(keys, owner, directions[i], &has));
    if (has && m->axes[i][0] == 0 && m->axes[i][1] == 0 && m->axes[i][2] == 0)
      PetscCall(SceneKeysComplain(keys, "%s_%s is zero, which is no direction", owner, directions[i]));
  }
  if (MaterialIsFinite(m)) {
    PetscCall(SceneHasKey(keys, owner, "expansion", &has));
    if (has)
      PetscCall(
        SceneKeysComplain(keys, "%s_expansion is for laws of small strain, linear and orthotropic: %s does not expand",
          owner, MaterialTypes[m->type]));
  }
  PetscCall(MaterialSetScale(m));
  PetscFunctionReturn(0);
}

/* A line each, as it is read */
PetscErrorCode SceneViewConstants(Scene scene, const Material *material, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(SceneViewRows(scene, viewer, SceneConstantRows, MaterialTypes[material->type], material, NULL));
  PetscFunctionReturn(0);
}

/* In words, within a line */
PetscErrorCode SceneDescribeConstants(const Material *material, PetscViewer viewer)
{
  PetscFunctionBegin;
  for (const SceneKey *row = SceneConstantRows; row->name; ++row) {
    const PetscReal *value = (const PetscReal *)((const char *)material + row->at);
    const char      *name  = row->n > 1                      ? row->name
                             : !strcmp(row->name, "young")   ? "E"
                             : !strcmp(row->name, "poisson") ? "nu"
                                                             : row->name;
    PetscBool        any   = (PetscBool)(row->need == SCENE_REQUIRED);

    for (PetscInt k = 0; k < row->n; ++k) any = (PetscBool)(any || value[k] != 0);
    if (!any || !SceneRowIsOf(row, MaterialTypes[material->type])) continue;
    PetscCall(PetscViewerASCIIPrintf(viewer, ", %s =", name));
    for (PetscInt k = 0; k < row->n; ++k) PetscCall(PetscViewerASCIIPrintf(viewer, " %.6g", (double)value[k]));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SceneValidateOrthotropic(MPI_Comm comm, const char file[], const SceneBody *body)
{
  const Material *m = &body->material;
  MaterialModuli  moduli;
  PetscErrorCode  ierr;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 3; ++i) {
    PetscCheck(m->youngs[i] > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has Young's modulus young = %g along axis %" PetscInt_FMT ", which must be above 0", file,
      body->name, (double)m->youngs[i], i + 1);
    PetscCheck(m->shears[i] > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has a shear modulus shear = %g, which must be above 0", file, body->name, (double)m->shears[i]);
  }
  PetscCall(PetscPushErrorHandler(PetscReturnErrorHandler, NULL));
  ierr = MaterialGetModuli(m, &moduli, NULL);
  PetscCall(PetscPopErrorHandler());
  PetscCheck(!ierr, comm, PETSC_ERR_USER_INPUT,
    "%s: body \"%s\" is orthotropic with Poisson's ratios %g, %g, %g for the axes 12, 23, 13, with which some strain "
    "has no positive energy, or its first_axis and second_axis are along one line",
    file, body->name, (double)m->poissons[0], (double)m->poissons[1], (double)m->poissons[2]);
  PetscFunctionReturn(0);
}

PetscErrorCode SceneValidateConstants(MPI_Comm comm, const char file[], const SceneBody *body)
{
  const Material *m = &body->material;

  PetscFunctionBegin;
  switch (m->type) {
  case MATERIAL_MOONEY_RIVLIN:
    PetscCheck(m->c10 >= 0 && m->c01 >= 0 && m->c10 + m->c01 > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has c10 = %g and c01 = %g, of which none may be negative, or its energy has no lower bound, nor "
      "both be 0",
      file, body->name, (double)m->c10, (double)m->c01);
    PetscCheck(m->bulk > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has a bulk modulus bulk = %g, which must be above 0", file, body->name, (double)m->bulk);
    break;
  case MATERIAL_ORTHOTROPIC: PetscCall(SceneValidateOrthotropic(comm, file, body)); break;
  default:
    PetscCheck(m->young > 0, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has Young's modulus young = %g, which must be above 0", file, body->name, (double)m->young);
    PetscCheck(m->poisson > -1 && m->poisson < 0.5, comm, PETSC_ERR_USER_INPUT,
      "%s: body \"%s\" has Poisson's ratio poisson = %g, which must lie between -1 and 0.5, both excluded", file,
      body->name, (double)m->poisson);
  }
  PetscFunctionReturn(0);
}
