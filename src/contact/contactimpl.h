/*
   Private header of contact: everything from geometry to the contact object.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include "src/contact/gaps/gapsimpl.h"

/* linearize.c: deforms surfaces and normals */
PETSC_INTERN PetscErrorCode ContactDeform(Contact, Vec u);

/* penetration.c: only public functions */

/* contact.c, linearize.c, initial_overlap.c: only public functions (the object, its gap, the check for deep initial
   overlaps) */

#endif
