/* Materials of elastic bodies: plain parameters, and the constitutive laws evaluated at a point. */
#ifndef MATERIAL_H
#define MATERIAL_H

#include <petscsys.h>

/* The laws: a new one is a file of src/material and a line here. What it is called in C, and by scenes */
#define MATERIAL_LAWS(LAW) \
  LAW(LINEAR, Linear, "linear")                     /* small strain, isotropic */ \
  LAW(NEOHOOKEAN, NeoHookean, "neohookean")         /* compressible neo-Hookean, finite strain */ \
  LAW(SAINT_VENANT, SaintVenant, "saint_venant")    /* Saint Venant-Kirchhoff, large rotations at moderate strain */ \
  LAW(MOONEY_RIVLIN, MooneyRivlin, "mooney_rivlin") /* compressible Mooney-Rivlin, finite strain */ \
  LAW(ORTHOTROPIC, Orthotropic, "orthotropic")      /* small strain, three planes of symmetry */ \
  LAW(RIGID, Rigid, "rigid")                        /* no strain: every displacement of the body is prescribed */

#define MATERIAL_TYPE(name, law, text) MATERIAL_##name,
typedef enum {
  MATERIAL_LAWS(MATERIAL_TYPE)
} MaterialType;
#undef MATERIAL_TYPE
PETSC_EXTERN const char *const MaterialTypes[];

#define MATERIAL_OWN 8 /* constants, and moduli, that a law may have beside those that have names here */

typedef struct {
  MaterialType type;
  PetscReal    young;   /* Young's modulus E > 0; laws with other constants get a value of about their stiffness from
                      MaterialSetScale() [force/length^2] */
  PetscReal    poisson; /* Poisson's ratio, -1 < nu < 1/2 */
  PetscReal    c10, c01, bulk;         /* Mooney-Rivlin: constants of I1 and I2, not negative; bulk modulus
                                       [force/length^2] */
  PetscReal    youngs[3], poissons[3]; /* orthotropic: E1 E2 E3 [force/length^2]; nu12 nu23 nu13 */
  PetscReal    shears[3],
    axes[2][3]; /* G12 G23 G13 [force/length^2]; first axis, and a second vector in the plane of axes 1 and 2; 0: x, y
                   */
  PetscReal
    expansion[3];    /* small strain: linear thermal expansion, of an orthotropic law along its axes [1/temperature] */
  PetscReal density; /* mass per undeformed volume; 0: none was given. Used by dynamics alone */
  PetscReal own[MATERIAL_OWN];
} Material;

/* The constants with which a law is evaluated [force/length^2] */
typedef struct {
  PetscReal lambda, mu;    /* Lame parameters */
  PetscReal bulk;          /* kappa = lambda + 2 mu/3 */
  PetscReal share;         /* Mooney-Rivlin: c01/(c10 + c01) */
  PetscReal stiffness[36]; /* orthotropic: of strains xx yy zz 2xy 2yz 2zx */
  PetscReal own[MATERIAL_OWN];
} MaterialModuli;

/* A constant of a law, as scenes have it: so many numbers of a Material, each between two bounds */
typedef struct {
  const char *name; /* of its key; NULL ends a list */
  PetscInt    n;
  size_t      at; /* offset in a Material */
  PetscBool   required;
  const char *label, *symbol; /* in sentences; NULL: its name */
  PetscReal   lower, upper;   /* both excluded; PETSC_INFINITY: none. Both 0: any number will do */
} MaterialConstant;

/*
   A constitutive law at a point. H = F - I is the displacement gradient, H[3 i + j] = du_i/dX_j, so that small
   strains keep all digits. Every law has the form W = W_iso + kappa/2 theta(H)^2 with the bulk modulus kappa and the
   dilatation theta; W_iso alone has the isochoric moduli of MaterialGetModuli(). If the material is inverted (det F
   <= 0; linear laws do not check it) the energy is PETSC_INFINITY, and stress, tangent and Cauchy stress return
   PETSC_FALSE and write nothing.
*/
typedef struct {
  PetscBool constant;  /* the tangent does not depend on H */
  PetscBool isotropic; /* and is lambda I (x) I + 2 mu I_sym */
  /* Energy density W(H) [force/length^2] */
  PetscReal (*energy)(const MaterialModuli *, const PetscReal H[9]);
  /* First Piola-Kirchhoff stress P = dW/dH [force/length^2] */
  PetscBool (*stress)(const MaterialModuli *, const PetscReal H[9], PetscReal P[9]);
  /* Tangent A[9 (3 i + j) + 3 k + l] = dP_ij/dH_kl [force/length^2] */
  PetscBool (*tangent)(const MaterialModuli *, const PetscReal H[9], PetscReal A[81]);
  /* Cauchy stress xx yy zz xy yz zx [force/length^2] */
  PetscBool (*cauchy)(const MaterialModuli *, const PetscReal H[9], PetscReal sigma[6]);
  /* Dilatation theta(H) and its derivative C = dtheta/dH */
  PetscReal (*dilatation)(const PetscReal H[9], PetscReal C[9]);
  /* Adds pressure times the second derivative of theta to a tangent */
  void (*curvature)(PetscReal pressure, const PetscReal H[9], PetscReal A[81]);
  PetscBool               finite; /* strains are */
  const MaterialConstant *constants;
  /* Its bulk modulus, 2 mu/3 + lambda, and what else the functions above read; an error if no such material exists */
  PetscErrorCode (*moduli)(const Material *, MaterialModuli *);
  /* Young's modulus, about, from other constants; NULL: it is one of them */
  void (*scale)(Material *);
} MaterialLaw;

/* Whether strains are finite */
PETSC_EXTERN PetscBool MaterialIsFinite(const Material *);
/* Lame parameters [force/length^2]: lambda = E nu/((1+nu)(1-2nu)), mu = E/(2(1+nu)) */
PETSC_EXTERN PetscErrorCode MaterialGetLame(const Material *, PetscReal *lambda, PetscReal *mu);
/* Sets an equivalent Young's modulus for a material with other constants */
PETSC_EXTERN PetscErrorCode MaterialSetScale(Material *);
/* Linear thermal expansion along the axes of space, a symmetric tensor */
PETSC_EXTERN PetscErrorCode MaterialGetExpansion(const Material *, PetscReal A[9]);
/* The constants for the law, and for its isochoric part alone */
PETSC_EXTERN PetscErrorCode MaterialGetModuli(const Material *, MaterialModuli *, MaterialModuli *isochoric);
PETSC_EXTERN PetscErrorCode MaterialGetLaw(const Material *, const MaterialLaw **);

#endif
