static char help[] = "Contact: what is wrong with pairs, options and displacements is one sentence on every rank.\n";

#include <mesh.h>
#include <contact.h>
#include "../lib/attempt.h"

static PetscErrorCode Attempt(DM dm, PetscInt npairs, const SceneContactPair pairs[], const char option[],
  const char value[], PetscBool finite)
{
  Contact              contact = NULL;
  ContactLinearization lin;
  Vec                  u;
  PetscErrorCode       ierr;

  PetscFunctionBeginUser;
  if (option) PetscCall(PetscOptionsSetValue(NULL, option, value));
  PetscCall(DMCreateGlobalVector(dm, &u));
  if (!finite) { /* on the last rank that has a value */
    PetscInt N;

    PetscCall(VecGetSize(u, &N));
    PetscCall(VecSetValue(u, N - 1, NAN, INSERT_VALUES));
    PetscCall(VecAssemblyBegin(u));
    PetscCall(VecAssemblyEnd(u));
  }
  PetscCall(AttemptBegin());
  ierr = ContactCreate(dm, npairs, pairs, &contact);
  if (!ierr) ierr = ContactSetFromOptions(contact);
  if (!ierr) ierr = ContactLinearize(contact, u, CONTACT_FORCES, &lin);
  PetscCall(AttemptEnd());
  PetscCall(AttemptPrint(ierr));
  if (contact) PetscCall(ContactDestroy(&contact));
  if (option) PetscCall(PetscOptionsClearValue(NULL, option));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static char            name[2][8] = {"lower", "upper"};
  const SceneContactPair good = {.name = "pair", .mortar = "lower.zmax", .nonmortar = "upper.zmin", .gap = GAP_MORTAR};
  const SceneContactPair mortar = {.name = "pair", .mortar = "lower.top", .nonmortar = "upper.zmin", .gap = GAP_MORTAR};
  const SceneContactPair nonmortar = {.name = "pair",
    .mortar                                 = "lower.zmax",
    .nonmortar                              = "middle.zmin",
    .gap                                    = GAP_MORTAR};
  const SceneContactPair twice = {.name = "pair", .mortar = "lower.zmax", .nonmortar = "lower.zmax", .gap = GAP_MORTAR};
  const SceneContactPair near  = {.name = "pair",
     .mortar                            = "lower.zmax",
     .nonmortar                         = "upper.zmin",
     .gap                               = GAP_NODE,
     .distance                          = -0.5};
  const SceneContactPair unknown = {.name = "pair",
    .mortar                               = "lower.zmax",
    .nonmortar                            = "upper.zmin",
    .gap                                  = (GapType)7};
  const SceneContactPair same[2] = {good, good};
  SceneBody              body[2];
  DM                     dm;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscMemzero(body, sizeof(body)));
  for (PetscInt b = 0; b < 2; ++b)
    body[b] = (SceneBody){.name = name[b],
      .shape                    = SHAPE_BOX,
      .lower                    = {0, 0, (PetscReal)b},
      .upper                    = {1, 1, 1.0 + (PetscReal)b},
      .cells                    = {2 + b, 2, 2}};
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, body, 0, &dm));
  PetscCall(Attempt(dm, 1, &mortar, NULL, NULL, PETSC_TRUE));
  PetscCall(Attempt(dm, 1, &nonmortar, NULL, NULL, PETSC_TRUE));
  PetscCall(Attempt(dm, 1, &twice, NULL, NULL, PETSC_TRUE));
  PetscCall(Attempt(dm, 1, &near, NULL, NULL, PETSC_TRUE));
  PetscCall(Attempt(dm, 1, &unknown, NULL, NULL, PETSC_TRUE));
  PetscCall(Attempt(dm, 2, same, NULL, NULL, PETSC_TRUE));
  PetscCall(Attempt(dm, 1, &good, NULL, NULL, PETSC_FALSE));
  PetscCall(Attempt(dm, 1, &good, "-contact_search_depth", "-1", PETSC_TRUE));
  PetscCall(Attempt(dm, 1, &good, "-contact_quadrature", "9", PETSC_TRUE));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 3}}
      output_file: output/contact_errors_1.out

TEST*/
