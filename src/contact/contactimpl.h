/*
   Contact, private: all of it, from one facet to the object.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include "src/contact/gaps/gapsimpl.h"

/* linearize.c: the surfaces and normals at a displacement */
PETSC_INTERN PetscErrorCode ContactDeform(Contact, Vec u);

/* penetration.c: of vertices, public */

/* contact.c, linearize.c, initial_overlap.c: the object's life, its gap, and the error where bodies overlap deeper
   than it looks, public */

#endif
