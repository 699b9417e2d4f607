/* Names of the formulations, as scenes and options write them */
#include <formulation.h>

const char *const ElementTypes[] = {"full", "bbar", "incompatible", "ElementType", "ELEMENT_", NULL};
const char *const GapTypes[]     = {"mortar", "node", "GapType", "GAP_", NULL};
const char *const StepModels[]   = {"energy", "quadratic", "StepModel", "MODEL_", NULL};
