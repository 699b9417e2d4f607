/*
   Private header of contact: everything from geometry to the contact object.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include "src/contact/gaps/gapsimpl.h"

/* linearize.c: deforms surfaces and normals */
PETSC_INTERN PetscErrorCode ContactDeform(Contact, Vec u);

/* penetration.c: only public functions */

/* contact.c creates the contact object, linearize.c its gap, and initial_overlap.c checks for deep initial overlaps.
   They have public functions only */

#endif
