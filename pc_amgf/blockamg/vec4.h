/* Four floats as one value: by the vector extension of GCC and Clang, or by an array with other compilers */
#ifndef AMGF_VEC4_H
#define AMGF_VEC4_H

#include "pc_amgf/clones.h"
#include <string.h>

#if defined(__GNUC__) && !defined(AMGF_PLAIN_C)
  #define VEC4_INLINE static inline __attribute__((always_inline))

typedef float Vec4 __attribute__((vector_size(16)));

VEC4_INLINE Vec4 Vec4Same(float s)
{
  return (Vec4){s, s, s, s};
}

/* Returns a + b c, component by component */
VEC4_INLINE Vec4 Vec4MultiplyAdd(Vec4 a, Vec4 b, Vec4 c)
{
  return a + b * c;
}

VEC4_INLINE Vec4 Vec4Multiply(Vec4 a, Vec4 b)
{
  return a * b;
}

VEC4_INLINE Vec4 Vec4Subtract(Vec4 a, Vec4 b)
{
  return a - b;
}

VEC4_INLINE float Vec4Get(Vec4 a, int i)
{
  return a[i];
}

  #if defined(__clang__)
    #define VEC4_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
  #else
typedef int Vec4Places __attribute__((vector_size(16)));
    #define VEC4_SHUFFLE(a, b, i, j, k, l) __builtin_shuffle(a, b, (Vec4Places){i, j, k, l})
  #endif

/* Returns a vector whose component i is the sum of the components of a[i] */
VEC4_INLINE Vec4 Vec4Sums(const Vec4 a[4])
{
  const Vec4 p = VEC4_SHUFFLE(a[0], a[1], 0, 4, 1, 5) + VEC4_SHUFFLE(a[0], a[1], 2, 6, 3, 7);
  const Vec4 q = VEC4_SHUFFLE(a[2], a[3], 0, 4, 1, 5) + VEC4_SHUFFLE(a[2], a[3], 2, 6, 3, 7);

  return VEC4_SHUFFLE(p, q, 0, 1, 4, 5) + VEC4_SHUFFLE(p, q, 2, 3, 6, 7);
}
#else
  #define VEC4_INLINE static inline

typedef struct {
  float v[4];
} Vec4;

VEC4_INLINE Vec4 Vec4Same(float s)
{
  return (Vec4){{s, s, s, s}};
}

VEC4_INLINE Vec4 Vec4MultiplyAdd(Vec4 a, Vec4 b, Vec4 c)
{
  for (int i = 0; i < 4; i++) a.v[i] += b.v[i] * c.v[i];
  return a;
}

VEC4_INLINE Vec4 Vec4Multiply(Vec4 a, Vec4 b)
{
  for (int i = 0; i < 4; i++) a.v[i] *= b.v[i];
  return a;
}

VEC4_INLINE Vec4 Vec4Subtract(Vec4 a, Vec4 b)
{
  for (int i = 0; i < 4; i++) a.v[i] -= b.v[i];
  return a;
}

VEC4_INLINE float Vec4Get(Vec4 a, int i)
{
  return a.v[i];
}

VEC4_INLINE Vec4 Vec4Sums(const Vec4 a[4])
{
  Vec4 sums;

  for (int i = 0; i < 4; i++) sums.v[i] = (a[i].v[0] + a[i].v[2]) + (a[i].v[1] + a[i].v[3]);
  return sums;
}
#endif

/* Loads from, or stores to, an address of any alignment */
VEC4_INLINE Vec4 Vec4Load(const float *p)
{
  Vec4 a;

  memcpy(&a, p, sizeof(a));
  return a;
}

VEC4_INLINE void Vec4Store(float *p, Vec4 a)
{
  memcpy(p, &a, sizeof(a));
}

#endif
