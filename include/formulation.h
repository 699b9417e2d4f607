/* Formulations that a scene can choose: the element of a body, the gap of a contact pair, the energy model of a load
   step, and the time integration. */
#ifndef FORMULATION_H
#define FORMULATION_H

#include <petscsys.h>

#if defined(PETSC_USE_COMPLEX)
  #error "contact needs a PETSc with real scalars: displacements, gaps and pressures are real numbers"
#endif

/* The element types. A new element type needs a file in src/elasticity/elements and a line here, with its name in C
   and its name in scenes. */
#define ELEMENT_TYPES(ELEMENT) \
  ELEMENT(FULL, Full, "full") /* full integration; too stiff (locking) in bending, and near Poisson's ratio 1/2 */ \
  ELEMENT(BBAR, Bbar, "bbar") /* mean dilatation (B-bar, F-bar): the change of volume is constant in a cell */ \
  ELEMENT(INCOMPATIBLE, Incompatible, "incompatible") /* incompatible modes: no locking in bending or near Poisson's \
                                                         ratio 1/2; small strain only */ \
  ELEMENT(REDUCED, Reduced, "reduced") /* 2 x 2 x 2 points in hexahedra of order 2, as C3D20R of Abaqus and CalculiX */

#define ELEMENT_TYPE(name, element, text) ELEMENT_##name,
/* ELEMENT_AUTO stands for the element that SceneChooseElements() selects. */
typedef enum { ELEMENT_TYPES(ELEMENT_TYPE) ELEMENT_AUTO } ElementType;
#undef ELEMENT_TYPE
PETSC_EXTERN const char *const ElementTypes[];

typedef enum {
  GAP_AUTO,   /* GAP_MORTAR, and GAP_DUAL from the first load step for which GAP_MORTAR finds no equilibrium */
  GAP_MORTAR, /* segment to segment: the gap is integrated over the overlap of the two faces */
  GAP_NODE,   /* node to segment: distance from a nonmortar vertex to the closest point of the mortar face */
  GAP_DUAL    /* mortar with dual shape functions: the contact force of a row acts at its own nonmortar vertex */
} GapType;
PETSC_EXTERN const char *const GapTypes[];

/* The function that a load step minimizes. Both models are equal if every body is linear. */
typedef enum {
  MODEL_ENERGY,   /* the nonlinear energy; the result is in equilibrium */
  MODEL_QUADRATIC /* the quadratic model of the energy about the last state; the tangent is assembled once per load
                     step */
} StepModel;
PETSC_EXTERN const char *const StepModels[];

/* How time is integrated */
typedef enum {
  SCHEME_GENERALIZED_ALPHA, /* second order; dissipates high frequencies as much as the spectral radius says */
  SCHEME_IMPACT             /* trapezoidal rule, with the contact forces at the end of the time step */
} DynamicsScheme;
PETSC_EXTERN const char *const DynamicsSchemes[];

typedef enum {
  MASS_REDISTRIBUTED, /* lumped; the mass of nodes in contact pairs is moved to the other nodes of their cells */
  MASS_LUMPED,
  MASS_CONSISTENT
} MassType;
PETSC_EXTERN const char *const MassTypes[];

#endif
