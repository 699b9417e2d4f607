/* src/options: names without their dash; lists end with NULL. */
#ifndef OPTIONSIMPL_H
#define OPTIONSIMPL_H

#include <options.h>

/* nearest.c: only public functions */

/* known.c */
typedef enum {
  OPTION_SWITCH, /* true or false; no value means true */
  OPTION_COUNT,  /* an integer */
  OPTION_NUMBER,
  OPTION_WORD, /* one of several words, or a name */
  OPTION_KINDS
} OptionKind;

PETSC_INTERN const char *const OptionsOurs[], *const OptionsUsual[];
PETSC_INTERN PetscBool OptionIsKnown(const char name[]);
PETSC_INTERN PetscBool OptionGetKind(const char name[], OptionKind *); /* returns false if the option is not ours */
PETSC_INTERN PetscBool OptionGetChoices(const char name[], const char *const **words); /* false: any word is right */
PETSC_INTERN size_t    OptionPrefixLength(const char name[]); /* length of an object's prefix before an option of
                                                                 PCAMGF */

/* check.c: only public functions */

#endif
