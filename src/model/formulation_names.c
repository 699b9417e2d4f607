/* Names of the formulations in scenes and options */
#include <formulation.h>

#define ELEMENT_NAME(name, element, text) text,
const char *const ElementTypes[]    = {ELEMENT_TYPES(ELEMENT_NAME) "auto", "ElementType", "ELEMENT_", NULL};
const char *const GapTypes[]        = {"auto", "mortar", "node", "dual", "GapType", "GAP_", NULL};
const char *const DynamicsSchemes[] = {"generalized_alpha", "impact", "DynamicsScheme", "SCHEME_", NULL};
const char *const MassTypes[]       = {"redistributed", "lumped", "consistent", "MassType", "MASS_", NULL};
const char *const StepModels[]      = {"energy", "quadratic", "StepModel", "MODEL_", NULL};
