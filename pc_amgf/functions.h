/* The functions of a PC or a Tao by which its public functions call its implementation */
#ifndef AMGF_FUNCTIONS_H
#define AMGF_FUNCTIONS_H

#include <petscsys.h>

typedef struct {
  const char       *name;
  PetscVoidFunction implementation;
} AMGFFunction;

#define AMGF_FUNCTION(function, type) \
  { \
    #function "_C", (PetscVoidFunction)function##_##type \
  }

/* Composes n functions with an object, or removes them if `attach` is false */
static inline PetscErrorCode AMGFComposeFunctions(PetscObject object, size_t n, const AMGFFunction functions[],
  PetscBool attach)
{
  PetscFunctionBegin;
  for (size_t i = 0; i < n; i++)
    PetscCall(PetscObjectComposeFunction(object, functions[i].name, attach ? functions[i].implementation : NULL));
  PetscFunctionReturn(0);
}

#endif
