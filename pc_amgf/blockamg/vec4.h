/*
   Four or eight floats as one value: by the vector extension of Clang and of GCC from version 12 on, or by arrays with
   other compilers
*/
#ifndef AMGF_VEC4_H
#define AMGF_VEC4_H

#include <clones.h>
#include <stdint.h>
#include <string.h>

#if (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)) && !defined(AMGF_PLAIN_C)
  #define VEC4_INLINE static inline __attribute__((always_inline))

typedef float   Vec4 __attribute__((vector_size(16)));
typedef float   Vec8 __attribute__((vector_size(32)));
typedef int32_t Vec8Ints __attribute__((vector_size(32)));
typedef int16_t Vec8Shorts __attribute__((vector_size(32)));

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

VEC4_INLINE Vec4 Vec4Add(Vec4 a, Vec4 b)
{
  return a + b;
}

VEC4_INLINE Vec4 Vec4Subtract(Vec4 a, Vec4 b)
{
  return a - b;
}

VEC4_INLINE float Vec4Get(Vec4 a, int i)
{
  return a[i];
}

/* Returns a vector whose component i is the sum of the components of a[i] */
VEC4_INLINE Vec4 Vec4Sums(const Vec4 a[4])
{
  const Vec4 p = __builtin_shufflevector(a[0], a[1], 0, 4, 1, 5) + __builtin_shufflevector(a[0], a[1], 2, 6, 3, 7);
  const Vec4 q = __builtin_shufflevector(a[2], a[3], 0, 4, 1, 5) + __builtin_shufflevector(a[2], a[3], 2, 6, 3, 7);

  return __builtin_shufflevector(p, q, 0, 1, 4, 5) + __builtin_shufflevector(p, q, 2, 3, 6, 7);
}

VEC4_INLINE Vec8 Vec8Join(Vec4 low, Vec4 high)
{
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

VEC4_INLINE Vec4 Vec8Low(Vec8 a)
{
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}

VEC4_INLINE Vec4 Vec8High(Vec8 a)
{
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
}

VEC4_INLINE Vec8 Vec8MultiplyAdd(Vec8 a, Vec8 b, Vec8 c)
{
  return a + b * c;
}

VEC4_INLINE Vec8 Vec8Multiply(Vec8 a, Vec8 b)
{
  return a * b;
}

  #if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    #define VEC8_WIDEN(s, z, ...) __builtin_shufflevector(s, z, __VA_ARGS__)
  #else
    #define VEC8_WIDEN(s, z, ...) __builtin_shufflevector(z, s, __VA_ARGS__)
  #endif

/*
   Loads 16 integers of 16 bits from an address of any alignment, as 65536 times their values: *a gets integers 0 to 3
   and 8 to 11, *b integers 4 to 7 and 12 to 15. With this factor and this order, processors need few instructions.
*/
VEC4_INLINE void Vec8LoadShorts(const int16_t *p, Vec8 *a, Vec8 *b)
{
  const Vec8Shorts zero = {0};
  Vec8Shorts       s;

  memcpy(&s, p, sizeof(s));
  *a = __builtin_convertvector((Vec8Ints)VEC8_WIDEN(s, zero, 0, 16, 1, 17, 2, 18, 3, 19, 8, 24, 9, 25, 10, 26, 11, 27),
    Vec8);
  *b = __builtin_convertvector(
    (Vec8Ints)VEC8_WIDEN(s, zero, 4, 20, 5, 21, 6, 22, 7, 23, 12, 28, 13, 29, 14, 30, 15, 31), Vec8);
}
#else
  #define VEC4_INLINE static inline

typedef struct {
  float v[4];
} Vec4;

typedef struct {
  Vec4 low, high;
} Vec8;

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

VEC4_INLINE Vec4 Vec4Add(Vec4 a, Vec4 b)
{
  for (int i = 0; i < 4; i++) a.v[i] += b.v[i];
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

VEC4_INLINE Vec8 Vec8Join(Vec4 low, Vec4 high)
{
  return (Vec8){low, high};
}

VEC4_INLINE Vec4 Vec8Low(Vec8 a)
{
  return a.low;
}

VEC4_INLINE Vec4 Vec8High(Vec8 a)
{
  return a.high;
}

VEC4_INLINE Vec8 Vec8MultiplyAdd(Vec8 a, Vec8 b, Vec8 c)
{
  return (Vec8){Vec4MultiplyAdd(a.low, b.low, c.low), Vec4MultiplyAdd(a.high, b.high, c.high)};
}

VEC4_INLINE Vec8 Vec8Multiply(Vec8 a, Vec8 b)
{
  return (Vec8){Vec4Multiply(a.low, b.low), Vec4Multiply(a.high, b.high)};
}

VEC4_INLINE Vec4 Vec4FromShorts(const int16_t *p)
{
  return (Vec4){{65536.0f * p[0], 65536.0f * p[1], 65536.0f * p[2], 65536.0f * p[3]}};
}

VEC4_INLINE void Vec8LoadShorts(const int16_t *p, Vec8 *a, Vec8 *b)
{
  *a = (Vec8){Vec4FromShorts(p), Vec4FromShorts(p + 8)};
  *b = (Vec8){Vec4FromShorts(p + 4), Vec4FromShorts(p + 12)};
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
