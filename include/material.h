/* Materials of elastic bodies: parameters, and the constitutive laws at a point. */
#ifndef MATERIAL_H
#define MATERIAL_H

#include <petscsys.h>

/* The material laws. A new one is a file in src/material and a line here: name in C, and name in scenes */
#define MATERIAL_LAWS(LAW) \
  LAW(LINEAR, Linear, "linear")                     /* small strain, isotropic */ \
  LAW(NEOHOOKEAN, NeoHookean, "neohookean")         /* compressible neo-Hookean, finite strain */ \
  LAW(SAINT_VENANT, SaintVenant, "saint_venant")    /* Saint Venant-Kirchhoff, large rotations at moderate strain */ \
  LAW(MOONEY_RIVLIN, MooneyRivlin, "mooney_rivlin") /* compressible Mooney-Rivlin, finite strain */ \
  LAW(ORTHOTROPIC, Orthotropic, "orthotropic")      /* small strain, three planes of symmetry */ \
  LAW(J2, J2, "j2")                                 /* small strain, plasticity of von Mises with hardening */ \
  LAW(J2_FINITE, J2Finite, "j2_finite")             /* the same at finite strain */ \
  LAW(RIGID, Rigid, "rigid")                        /* no strain: every displacement of the body is prescribed */

#define MATERIAL_TYPE(name, law, text) MATERIAL_##name,
typedef enum { MATERIAL_LAWS(MATERIAL_TYPE) } MaterialType;
#undef MATERIAL_TYPE
PETSC_EXTERN const char *const MaterialTypes[];

#define MATERIAL_OWN 8 /* number of constants and moduli that a law may have without a named member here */

#define MATERIAL_PLASTIC     7 /* plastic strain xx yy zz xy yz zx, and its equivalent */
#define MATERIAL_DEFORMATION 9 /* j2_finite: the inverse of the plastic deformation gradient, minus I */
/* Values that a law may keep at a point: those above, in this order */
#define MATERIAL_HISTORY (MATERIAL_PLASTIC + MATERIAL_DEFORMATION)

#define MATERIAL_LIST 32
typedef struct {
  PetscInt  n;
  PetscReal value[MATERIAL_LIST];
} MaterialList;

/* Hardening of a metal: the yield stress of the equivalent plastic strain a is that of the table, or yield, and
   modulus a + (saturation - yield) (1 - exp(-rate a)) */
typedef struct {
  PetscReal    yield;            /* at a = 0; with a table its first stress [force/length^2] */
  PetscReal    modulus;          /* linear isotropic hardening, not negative [force/length^2] */
  PetscReal    saturation, rate; /* Voce's exponential hardening; 0: none [force/length^2], [1] */
  PetscReal    kinematic;        /* Prager's: slope of the back stress in a bar, not negative [force/length^2] */
  MaterialList strains;          /* of the table, equivalent plastic strains, ascending from 0; none: no table */
  MaterialList stresses; /* yield stresses there, not descending; beyond the last one constant [force/length^2] */
} MaterialHardening;

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
    expansion[3]; /* small strain: linear thermal expansion, of an orthotropic law along its axes [1/temperature] */
  MaterialHardening hardening; /* j2, j2_finite */
  PetscReal         density;   /* mass per undeformed volume; 0: not given. Used in dynamics only */
  PetscReal         own[MATERIAL_OWN];
} Material;

/* The constants with which a law is evaluated [force/length^2] */
typedef struct {
  PetscReal                lambda, mu;    /* Lame parameters */
  PetscReal                bulk;          /* kappa = lambda + 2 mu/3 */
  PetscReal                share;         /* Mooney-Rivlin: c01/(c10 + c01) */
  PetscReal                stiffness[36]; /* orthotropic: of strains xx yy zz 2xy 2yz 2zx */
  PetscReal                own[MATERIAL_OWN];
  const MaterialHardening *hardening; /* j2, j2_finite: of the Material, which must stay where it is */
  const PetscReal         *history;   /* of the point, from the law's advance(); NULL: elastic, without any */
  PetscReal                secant;    /* share of the secant in the tangent of metal that flows; 0: the tangent */
} MaterialModuli;

/* A constant of a law in scenes: one or more numbers of a Material, with bounds */
typedef struct {
  const char *name; /* of its key; NULL ends a list */
  PetscInt    n;    /* 0: a MaterialList */
  size_t      at;   /* offset in a Material */
  PetscBool   required;
  const char *label, *symbol; /* name in messages; NULL: the key's name */
  PetscReal   lower, upper;   /* bounds, both excluded; PETSC_INFINITY: none. Both 0: no bounds */
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
  PetscBool isotropic; /* and equals lambda I (x) I + 2 mu I_sym */
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
  /* Of laws with a history, whose functions above are of the step from the history of their moduli: writes the one
     at H, and returns whether it differs. NULL: there is none. After it energy and stress at H are the same */
  PetscBool (*advance)(const MaterialModuli *, const PetscReal H[9], PetscReal history[MATERIAL_HISTORY]);
  /* Leaves of H its elastic part, with which the functions above have the same stress without history */
  void (*elastic)(const PetscReal history[MATERIAL_HISTORY], PetscReal H[9]);
  /* The part of the energy that is plastic work [force/length^2] */
  PetscReal (*work)(const MaterialModuli *, const PetscReal history[MATERIAL_HISTORY]);
  PetscBool               finite; /* strains are */
  const MaterialConstant *constants;
  /* Computes the moduli used by the functions above, among them the bulk modulus lambda + 2 mu/3; error if no such
     material exists */
  PetscErrorCode (*moduli)(const Material *, MaterialModuli *);
  /* Sets an equivalent Young's modulus from other constants; NULL: it is one of the constants */
  void (*scale)(Material *);
} MaterialLaw;

/* Whether strains are finite */
PETSC_EXTERN PetscBool MaterialIsFinite(const Material *);
/* Whether a law has plastic strains */
PETSC_EXTERN PetscBool MaterialYields(const Material *);
/* Lame parameters [force/length^2]: lambda = E nu/((1+nu)(1-2nu)), mu = E/(2(1+nu)) */
PETSC_EXTERN PetscErrorCode MaterialGetLame(const Material *, PetscReal *lambda, PetscReal *mu);
/* Sets an equivalent Young's modulus for a material with other constants */
PETSC_EXTERN PetscErrorCode MaterialSetScale(Material *);
/* Linear thermal expansion as a symmetric tensor in global axes */
PETSC_EXTERN PetscErrorCode MaterialGetExpansion(const Material *, PetscReal A[9]);
/* Moduli for the law, and for its isochoric part */
PETSC_EXTERN PetscErrorCode MaterialGetModuli(const Material *, MaterialModuli *, MaterialModuli *isochoric);
PETSC_EXTERN PetscErrorCode MaterialGetLaw(const Material *, const MaterialLaw **);
/* Returns whether hardening ends at small strain. Loads beyond a limit cannot then be carried at any plastic strain. At
   finite strain the change of shape may carry them. */
PETSC_EXTERN PetscBool MaterialCollapses(const Material *);
/* Whether a law of plasticity has such a hardening; if not, which constant is wrong and why */
PETSC_EXTERN PetscBool MaterialCheckHardening(const MaterialHardening *, const char **key, char why[], size_t length);

#endif
