/* The map of src/options: names without their dash, lists that end with NULL. */
#ifndef OPTIONSIMPL_H
#define OPTIONSIMPL_H

#include <options.h>

/* nearest.c has no more than what options.h offers */

/* known.c */
PETSC_INTERN const char *const OptionsOurs[], *const OptionsUsual[];
PETSC_INTERN PetscBool OptionIsKnown(const char name[]);
PETSC_INTERN size_t    OptionPrefixLength(const char name[]); /* of those of objects before an option of PCAMGF */

/* check.c has no more than what options.h offers */

#endif
