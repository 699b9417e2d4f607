/* Materials of elastic bodies: parameters, and the constitutive laws at a point. */
#ifndef MATERIAL_H
#define MATERIAL_H

#include "lanes.h"
#include <petscsys.h>

/* The material laws. A new law needs a file in src/material and a line here, with its name in C and its name in
   scenes. */
#define MATERIAL_LAWS(LAW) \
  LAW(LINEAR, Linear, "linear")                     /* small strain, isotropic */ \
  LAW(NEOHOOKEAN, NeoHookean, "neohookean")         /* compressible neo-Hookean, finite strain */ \
  LAW(SAINT_VENANT, SaintVenant, "saint_venant")    /* Saint Venant-Kirchhoff, large rotations at moderate strain */ \
  LAW(MOONEY_RIVLIN, MooneyRivlin, "mooney_rivlin") /* compressible Mooney-Rivlin, finite strain */ \
  LAW(ORTHOTROPIC, Orthotropic, "orthotropic")      /* small strain, three planes of material symmetry */ \
  LAW(J2, J2, "j2")                                 /* small strain, von Mises plasticity with hardening */ \
  LAW(J2_FINITE, J2Finite, "j2_finite")             /* finite strain, von Mises plasticity with hardening */ \
  LAW(RIGID, Rigid, "rigid")                        /* rigid: all displacements of the body are prescribed */

#define MATERIAL_TYPE(name, law, text) MATERIAL_##name,
typedef enum { MATERIAL_LAWS(MATERIAL_TYPE) } MaterialType;
#undef MATERIAL_TYPE
PETSC_EXTERN const char *const MaterialTypes[];

#define MATERIAL_OWN 8 /* number of constants that a law may have in addition to the named members below */

#define MATERIAL_PLASTIC 7 /* number of values: plastic strain xx yy zz xy yz zx, and equivalent plastic strain */
#define MATERIAL_DEFORMATION \
  9 /* number of values, for j2_finite: inverse of the plastic deformation gradient, minus
                                  I */
/* Number of values that the law's history can have at a quadrature point: those above, in this order */
#define MATERIAL_HISTORY (MATERIAL_PLASTIC + MATERIAL_DEFORMATION)

#define MATERIAL_LIST 32
typedef struct {
  PetscInt  n;
  PetscReal value[MATERIAL_LIST];
} MaterialList;

/* Hardening of a metal. The yield stress at the equivalent plastic strain a is yield + modulus a + (saturation -
   yield) (1 - exp(-rate a)). If a table is given, it replaces `yield`. */
typedef struct {
  PetscReal    yield;            /* yield stress at a = 0; with a table the table's first stress [force/length^2] */
  PetscReal    modulus;          /* slope of linear isotropic hardening, not negative [force/length^2] */
  PetscReal    saturation, rate; /* Voce's exponential hardening; 0: none [force/length^2], [1] */
  PetscReal    kinematic;        /* Prager's kinematic hardening: slope of the back stress in uniaxial tension, not
                                    negative [force/length^2] */
  MaterialList strains;          /* table: equivalent plastic strains, ascending from 0; no table if empty */
  MaterialList stresses; /* table: yield stresses at these strains, never descending; constant beyond the last one
                            [force/length^2] */
} MaterialHardening;

typedef struct {
  MaterialType type;
  PetscReal    young;   /* Young's modulus E > 0. For laws with other constants MaterialSetScale() sets a value of
                           similar stiffness [force/length^2] */
  PetscReal    poisson; /* Poisson's ratio, -1 < nu < 1/2 */
  PetscReal    c10, c01, bulk;         /* Mooney-Rivlin: constants of I1 and I2, not negative; bulk modulus
                                       [force/length^2] */
  PetscReal    youngs[3], poissons[3]; /* orthotropic: E1 E2 E3 [force/length^2]; nu12 nu23 nu13 */
  PetscReal    shears[3],
    axes[2][3]; /* shear moduli G12 G23 G13 [force/length^2]; the first material axis, and a vector in the plane of
                   axes 1 and 2. Zero: axes x and y */
  PetscReal
    expansion[3]; /* laws of small strain: coefficient of linear thermal expansion; for an orthotropic law along its
                     three axes [1/temperature] */
  MaterialHardening hardening; /* j2, j2_finite; of elastic laws only `yield`, for the safety factor; 0: not given */
  PetscReal         density;   /* mass per undeformed volume, used in dynamics only; 0: not given */
  PetscReal         own[MATERIAL_OWN];
} Material;

/* The constants in the form in which a law is evaluated [force/length^2] */
typedef struct {
  PetscReal                lambda, mu;    /* Lame parameters */
  PetscReal                bulk;          /* kappa = lambda + 2 mu/3 */
  PetscReal                c01_fraction;  /* Mooney-Rivlin: c01/(c10 + c01) */
  PetscReal                stiffness[36]; /* orthotropic: 6 x 6 stiffness for the strains xx yy zz 2xy 2yz 2zx */
  PetscReal                own[MATERIAL_OWN];
  const MaterialHardening *hardening; /* j2, j2_finite: points into the Material, which must not be moved */
  const PetscReal         *history;   /* history of the quadrature point, computed by the law's advance(); NULL: the
                                         law is evaluated as elastic */
} MaterialModuli;

/* A constant that a law has in scenes: one or more numbers of a Material, with bounds */
typedef struct {
  const char *name; /* name of the key; NULL ends a list */
  PetscInt    n;    /* 0: a MaterialList */
  size_t      at;   /* offset in a Material */
  PetscBool   required;
  const char *label, *symbol; /* label: name in messages; NULL: the name of the key */
  PetscReal   lower, upper;   /* bounds; the bounds themselves are not allowed. PETSC_INFINITY: no bound on this
                                 side. Both 0: no bounds */
} MaterialConstant;

/*
   A constitutive law at a point. H = F - I is the displacement gradient, H[3 i + j] = du_i/dX_j, so that small
   strains keep all digits. Every law has the form W = W_iso + kappa/2 theta(H)^2 with the bulk modulus kappa and the
   dilatation theta; W_iso alone has the isochoric moduli of MaterialGetModuli(). If the material is inverted (det F
   <= 0; linear laws do not check it) the energy is PETSC_INFINITY, and stress, tangent and Cauchy stress return
   PETSC_FALSE and write nothing.
*/
typedef struct {
  PetscBool constant; /* the tangent does not depend on H */
  /* Energy density W(H) [force/length^2] */
  PetscReal (*energy)(const MaterialModuli *, const PetscReal H[9]);
  /* First Piola-Kirchhoff stress P = dW/dH [force/length^2] */
  PetscBool (*stress)(const MaterialModuli *, const PetscReal H[9], PetscReal P[9]);
  /* Tangent A[9 (3 i + j) + 3 k + l] = dP_ij/dH_kl [force/length^2] */
  PetscBool (*tangent)(const MaterialModuli *, const PetscReal H[9], PetscReal A[81]);
  /* The same three functions at as many points as there are lanes; false if one of these is inverted. NULL: the
     functions above are called for each point. */
  PetscBool (*energies)(const MaterialModuli *, const Lanes H[9], Lanes *W);
  PetscBool (*stresses)(const MaterialModuli *, const Lanes H[9], Lanes P[9]);
  PetscBool (*tangents)(const MaterialModuli *, const Lanes H[9], Lanes A[81]);
  /* Cauchy stress xx yy zz xy yz zx [force/length^2] */
  PetscBool (*cauchy)(const MaterialModuli *, const PetscReal H[9], PetscReal sigma[6]);
  /* Dilatation theta(H) and its derivative C = dtheta/dH */
  PetscReal (*dilatation)(const PetscReal H[9], PetscReal C[9]);
  /* The same at as many points as there are lanes; NULL: the function of one point is used */
  void (*dilatations)(const Lanes H[9], Lanes C[9], Lanes *theta);
  /* Adds pressure times the second derivative of theta to a tangent; NULL: this derivative is zero */
  void (*curvature)(PetscReal pressure, const PetscReal H[9], PetscReal A[81]);
  /* Only for laws with a history; NULL for other laws. Computes the history at H from that in the moduli, and
     returns whether they differ. The other functions evaluate the step from the history in the moduli to H; energy
     and stress at H are the same before and after advance(). */
  PetscBool (*advance)(const MaterialModuli *, const PetscReal H[9], PetscReal history[MATERIAL_HISTORY]);
  /* Replaces H by its elastic part. Without history, the functions above give the same stress for the elastic part. */
  void (*elastic)(const PetscReal history[MATERIAL_HISTORY], PetscReal H[9]);
  /* Returns the plastic work that is included in the energy [force/length^2] */
  PetscReal (*work)(const MaterialModuli *, const PetscReal history[MATERIAL_HISTORY]);
  PetscBool               finite; /* strains are */
  const MaterialConstant *constants;
  /* Computes the moduli that the functions above use, including the bulk modulus lambda + 2 mu/3. Raises an error if
     no material has these constants. */
  PetscErrorCode (*moduli)(const Material *, MaterialModuli *);
  /* Sets a Young's modulus of similar stiffness from other constants; NULL if Young's modulus is a constant of the
     law */
  void (*scale)(Material *);
} MaterialLaw;

/* Whether strains are finite */
PETSC_EXTERN PetscBool MaterialIsFinite(const Material *);
/* Returns whether a law has plastic strains */
PETSC_EXTERN PetscBool MaterialYields(const Material *);
/* Computes the Lame parameters [force/length^2]: lambda = E nu/((1+nu)(1-2nu)), mu = E/(2(1+nu)) */
PETSC_EXTERN PetscErrorCode MaterialGetLame(const Material *, PetscReal *lambda, PetscReal *mu);
/* Sets a Young's modulus of similar stiffness if the law has other constants */
PETSC_EXTERN PetscErrorCode MaterialSetScale(Material *);
/* Computes the linear thermal expansion as a symmetric tensor in global axes */
PETSC_EXTERN PetscErrorCode MaterialGetExpansion(const Material *, PetscReal A[9]);
/* Computes the moduli of a material's law, and those of its isochoric part */
PETSC_EXTERN PetscErrorCode MaterialGetModuli(const Material *, MaterialModuli *, MaterialModuli *isochoric);
PETSC_EXTERN PetscErrorCode MaterialGetLaw(const Material *, const MaterialLaw **);
/* Returns whether the yield stress stays below a limit. At small strain no equilibrium then exists for loads beyond
   a limit load. At finite strain the change of the body's shape may still allow one. */
PETSC_EXTERN PetscBool MaterialCollapses(const Material *);
/* Checks the constants of hardening. If one is wrong, returns false with its key and the reason */
PETSC_EXTERN PetscBool MaterialCheckHardening(const MaterialHardening *, const char **key, char why[], size_t length);

#endif
