/*
   Contact, private: all of it, from one facet to the object.
*/
#ifndef CONTACTIMPL_H
#define CONTACTIMPL_H

#include "src/contact/gaps/gapsimpl.h"

/* contact.c, linearize.c, initial_overlap.c: the object's life, its gap, and the error where bodies overlap deeper
   than it looks, public */

#endif
