/* Formulations that a scene chooses from: element of a body, gap of a contact pair, energy model of a load step. */
#ifndef FORMULATION_H
#define FORMULATION_H

#include <petscsys.h>

#if defined(PETSC_USE_COMPLEX)
  #error "contact needs a PETSc with real scalars: displacements, gaps and pressures are real numbers"
#endif

/* The element types. A new one is a file in src/elasticity/elements and a line here: name in C, and name in scenes */
#define ELEMENT_TYPES(ELEMENT) \
  ELEMENT(FULL, Full, "full") /* full integration; locks as Poisson's ratio nears 1/2, and in bending */ \
  ELEMENT(BBAR, Bbar, "bbar") /* mean dilatation: the volume change is constant in an element (B-bar, F-bar) */ \
  ELEMENT(INCOMPATIBLE, Incompatible, "incompatible") /* no locking in bending or near nu = 1/2; small strain */

#define ELEMENT_TYPE(name, element, text) ELEMENT_##name,
/* ELEMENT_AUTO: SceneChooseElements() takes one of the others */
typedef enum { ELEMENT_TYPES(ELEMENT_TYPE) ELEMENT_AUTO } ElementType;
#undef ELEMENT_TYPE
PETSC_EXTERN const char *const ElementTypes[];

typedef enum {
  GAP_MORTAR, /* segment to segment: integrated over the overlap of the faces */
  GAP_NODE,   /* node to segment: nonmortar vertex to the closest point of the mortar face */
  GAP_DUAL    /* mortar with dual functions: contact forces act at the vertices of the nonmortar face */
} GapType;
PETSC_EXTERN const char *const GapTypes[];

/* How the energy of a load step is minimized. Both are the same if every body is linear */
typedef enum {
  MODEL_ENERGY,   /* the nonlinear energy; the result is in equilibrium */
  MODEL_QUADRATIC /* its quadratic model about the last state; the tangent is assembled once per load step */
} StepModel;
PETSC_EXTERN const char *const StepModels[];

/* How time is integrated */
typedef enum {
  SCHEME_GENERALIZED_ALPHA, /* second order, with dissipation of high frequencies as asked for */
  SCHEME_IMPACT             /* trapezoidal rule with implicit contact forces */
} DynamicsScheme;
PETSC_EXTERN const char *const DynamicsSchemes[];

typedef enum {
  MASS_REDISTRIBUTED, /* lumped; nodes in contact pairs have none: it goes to the other nodes of their cells */
  MASS_LUMPED,
  MASS_CONSISTENT
} MassType;
PETSC_EXTERN const char *const MassTypes[];

#endif
