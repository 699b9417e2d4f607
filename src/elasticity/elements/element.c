/* The table of elements */
#include "elementsimpl.h"

PetscErrorCode ElementGet(ElementType type, PetscInt nnodes, const Element **element)
{
  PetscFunctionBegin;
  switch (type) {
  case ELEMENT_FULL: *element = &ElementFull; break;
  case ELEMENT_BBAR: *element = &ElementBbar; break;
  case ELEMENT_INCOMPATIBLE:
    PetscCheck(nnodes == 8, PETSC_COMM_SELF, PETSC_ERR_SUP,
      "element incompatible is for hexahedra of 8 nodes, and not for cells of %" PetscInt_FMT
      ": take full or bbar for their body",
      nnodes);
    *element = &ElementIncompatible;
    break;
  default: SETERRQ(PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "Unknown element type %d", (int)type);
  }
  PetscFunctionReturn(0);
}
