/* Materials of elastic bodies: plain parameters, and the constitutive laws evaluated at a point. */
#ifndef MATERIAL_H
#define MATERIAL_H

#include <petscsys.h>

typedef enum {
  MATERIAL_LINEAR,    /* small strain, isotropic */
  MATERIAL_NEOHOOKEAN /* compressible neo-Hookean, finite strain */
} MaterialType;
PETSC_EXTERN const char *const MaterialTypes[];

typedef struct {
  MaterialType type;
  PetscReal    young;   /* Young's modulus E > 0 [force/length^2] */
  PetscReal    poisson; /* Poisson's ratio, -1 < nu < 1/2 */
} Material;

/*
   A constitutive law at a point. H = F - I is the displacement gradient, H[3 i + j] = du_i/dX_j: small strains
   then keep all their digits. A law may return NaN or infinity where the material is turned inside out (det F <= 0).
*/
typedef struct {
  PetscBool constant; /* the tangent does not depend on H */
  /* Energy density W(H) [force/length^2] */
  PetscReal (*energy)(PetscReal lambda, PetscReal mu, const PetscReal H[9]);
  /* First Piola-Kirchhoff stress P = dW/dH [force/length^2] */
  void (*stress)(PetscReal lambda, PetscReal mu, const PetscReal H[9], PetscReal P[9]);
  /* Tangent A[9 (3 i + j) + 3 k + l] = dP_ij/dH_kl [force/length^2] */
  void (*tangent)(PetscReal lambda, PetscReal mu, const PetscReal H[9], PetscReal A[81]);
  /* Cauchy stress xx yy zz xy yz zx [force/length^2] */
  void (*cauchy)(PetscReal lambda, PetscReal mu, const PetscReal H[9], PetscReal sigma[6]);
} MaterialLaw;

/* Lame parameters [force/length^2]: lambda = E nu/((1+nu)(1-2nu)), mu = E/(2(1+nu)) */
PETSC_EXTERN PetscErrorCode MaterialGetLame(const Material *, PetscReal *lambda, PetscReal *mu);
PETSC_EXTERN PetscErrorCode MaterialGetLaw(const Material *, const MaterialLaw **);

#endif
