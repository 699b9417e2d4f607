/*
   Private header of contact: everything from geometry to the contact object.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include "src/contact/gaps/gapsimpl.h"

/* linearize.c: deforms the surfaces and normals of all pairs to the displacement u */
PETSC_INTERN PetscErrorCode ContactDeform(Contact, Vec u);

/* contact.c, penetration.c, passage.c, tie.c, facing_away.c and inside.c have public functions only. */

#endif
