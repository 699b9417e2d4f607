/* The map of src/options: names without their dash, lists that end with NULL. */
#ifndef OPTIONSIMPL_H
#define OPTIONSIMPL_H

#include <options.h>

/* nearest.c has no more than what options.h offers */

/* known.c */
typedef enum {
  OPTION_SWITCH, /* true or false, or no value, which is true */
  OPTION_COUNT,  /* a whole number */
  OPTION_NUMBER,
  OPTION_WORD, /* one of a few, or a name */
  OPTION_KINDS
} OptionKind;

PETSC_INTERN const char *const OptionsOurs[], *const OptionsUsual[];
PETSC_INTERN PetscBool OptionIsKnown(const char name[]);
PETSC_INTERN PetscBool OptionGetKind(const char name[], OptionKind *); /* false: it is not ours */
PETSC_INTERN size_t    OptionPrefixLength(const char name[]); /* of those of objects before an option of PCAMGF */

/* check.c has no more than what options.h offers */

#endif
