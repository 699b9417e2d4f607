/* Private header of options. Names have no dash; lists end with NULL. */
#ifndef OPTIONSIMPL_H
#define OPTIONSIMPL_H

#include <options.h>

/* nearest.c: only public functions */

/* known.c */
typedef enum {
  OPTION_SWITCH, /* true or false; true if there is no value */
  OPTION_COUNT,  /* an integer */
  OPTION_NUMBER,
  OPTION_WORD, /* one of several words, or a name */
  OPTION_KINDS
} OptionKind;

PETSC_INTERN const char *const OptionsUsual[];
/* returns the k-th name of our options; NULL after the last */
PETSC_INTERN const char *OptionGetOurs(PetscInt k);
PETSC_INTERN PetscBool   OptionIsKnown(const char name[]);
/* returns false if the option is not one of ours */
PETSC_INTERN PetscBool OptionGetKind(const char name[], OptionKind *);
/* returns false if any value is allowed */
PETSC_INTERN PetscBool OptionGetChoices(const char name[], const char *const **words);
PETSC_INTERN size_t    OptionPrefixLength(const char name[]); /* returns the length of an object's prefix before an
                                                                 option of PCAMGF; 0: there is none */

/* check.c: only public functions */

#endif
