/*
   Eight reals as one value, for eight quadrature points or nodes at once: by the vector extension of Clang and of GCC
   from version 12 on. With other compilers a value is one real. Functions take pointers to values, since the registers
   of arguments depend on the processor.
*/
#ifndef LANES_H
#define LANES_H

#include "clones.h"
#include <petscsys.h>
#include <stdint.h>
#include <string.h>

#if (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)) && !defined(AMGF_PLAIN_C)
  #define LANES        8
  #define LANES_INLINE static inline __attribute__((always_inline))
  #define LANE(v, l)   ((v)[l])

typedef PetscReal Lanes __attribute__((vector_size(LANES * sizeof(PetscReal))));
typedef Lanes     LanesStored __attribute__((aligned(sizeof(PetscReal)), may_alias));

LANES_INLINE PetscReal LanesSum(const Lanes *v)
{
  const Lanes half = *v + __builtin_shufflevector(*v, *v, 4, 5, 6, 7, 0, 1, 2, 3);
  const Lanes two  = half + __builtin_shufflevector(half, half, 2, 3, 0, 1, 2, 3, 0, 1);

  return two[0] + two[1];
}
#else
  #define LANES        1
  #define LANES_INLINE static inline
  #define LANE(v, l)   (*(&(v) + (l)))

typedef PetscReal Lanes, LanesStored;

LANES_INLINE PetscReal LanesSum(const Lanes *v)
{
  return *v;
}
#endif

/* The value in an array of LANES reals */
#define LANES_OF(array) (*(LanesStored *)(array))

/* Finds whether a component is at most `limit` */
LANES_INLINE PetscBool LanesReach(const Lanes *v, PetscReal limit)
{
  int reach = 0;

  for (int l = 0; l < LANES; ++l) reach |= LANE(*v, l) <= limit;
  return (PetscBool)reach;
}

/* Computes the cube root of positive numbers: a third of the exponent, then Halley's iteration, which triples the
   number of correct digits */
LANES_INLINE void LanesCubeRoot(const Lanes *x, Lanes *root)
{
  Lanes r = *x;

  for (int l = 0; l < LANES; ++l) {
    double   guess = LANE(*x, l);
    uint64_t bits;

    memcpy(&bits, &guess, sizeof(bits));
    bits = ((bits >> 32) * 0xAAAAAAABull >> 33) + 715094163; /* a third of the upper half */
    bits <<= 32;
    memcpy(&guess, &bits, sizeof(bits));
    LANE(r, l) = guess;
  }
  for (int it = 0; it < 3; ++it) {
    const Lanes cube = r * r * r;

    r *= (cube + 2 * *x) / (2 * cube + *x);
  }
  *root = r;
}

#endif
