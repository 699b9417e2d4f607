/* The table of elements */
#include "elementsimpl.h"

#define ELEMENT_ENTRY(name, element, text) &Element##element,
static const Element *const elements[] = {ELEMENT_TYPES(ELEMENT_ENTRY)};

PetscErrorCode ElementGet(ElementType type, PetscInt nnodes, const Element **element)
{
  PetscFunctionBegin;
  PetscCheck(type >= 0 && (size_t)type < PETSC_STATIC_ARRAY_LENGTH(elements), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "Unknown element type %d", (int)type);
  *element = elements[type];
  PetscCheck(!(*element)->nnodes || nnodes == (*element)->nnodes, PETSC_COMM_SELF, PETSC_ERR_SUP,
    "element %s is for hexahedra of %" PetscInt_FMT " nodes, and not for cells of %" PetscInt_FMT
    ": use full or bbar for their body",
    ElementTypes[type], (*element)->nnodes, nnodes);
  PetscFunctionReturn(0);
}
