/* Shared by the tests of constitutive laws */
#ifndef MATERIAL_DIFFERENCES_H
#define MATERIAL_DIFFERENCES_H

#include <material.h>

/* A smooth rough sequence in [-1, 1] */
static inline PetscReal Rough(PetscInt i)
{
  return PetscSinReal(12.9898 * (PetscReal)(i + 1) + 1.3 * (PetscReal)(i * i));
}

static inline PetscErrorCode Report(const char name[], PetscReal value, PetscReal tolerance)
{
  PetscFunctionBeginUser;
  if (value <= tolerance) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s: below %g\n", name, (double)tolerance));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s: %g, NOT below %g\n", name, (double)value, (double)tolerance));
  PetscFunctionReturn(0);
}

/* Central differences at the displacement gradient H. Raises errors[] to those of the stress P against the energy, of
   the tangent A against the stress, and of the symmetry of A */
static inline void RaiseDerivativeErrors(const MaterialLaw *law, const MaterialModuli *m, PetscReal h, PetscReal H[9],
  const PetscReal P[9], const PetscReal A[81], PetscReal errors[3])
{
  for (PetscInt j = 0; j < 9; ++j) {
    const PetscReal keep = H[j];
    PetscReal       forward, backward, Pf[9], Pb[9];

    H[j]    = keep + h;
    forward = law->energy(m, H);
    law->stress(m, H, Pf);
    H[j]     = keep - h;
    backward = law->energy(m, H);
    law->stress(m, H, Pb);
    H[j]      = keep;
    errors[0] = PetscMax(errors[0], PetscAbsReal((forward - backward) / (2 * h) - P[j]));
    for (PetscInt i = 0; i < 9; ++i) {
      errors[1] = PetscMax(errors[1], PetscAbsReal((Pf[i] - Pb[i]) / (2 * h) - A[9 * i + j]));
      errors[2] = PetscMax(errors[2], PetscAbsReal(A[9 * i + j] - A[9 * j + i]));
    }
  }
}

#define YOUNG   2.6
#define POISSON 0.3

/* Prints the name of a material of a law of plasticity; sets its type and elastic constants; gets its law and moduli */
static inline PetscErrorCode BeginPlastic(const char name[], MaterialType type, Material *material,
  const MaterialLaw **law, MaterialModuli *m, MaterialModuli *isochoric)
{
  PetscFunctionBeginUser;
  material->type    = type;
  material->young   = YOUNG;
  material->poisson = POISSON;
  PetscCall(MaterialGetModuli(material, m, isochoric));
  PetscCall(MaterialGetLaw(material, law));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", name));
  PetscFunctionReturn(0);
}

#endif
