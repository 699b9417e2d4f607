/*
   STREAM's triad, a = b + s c, in three working sets: within a core's reach and far beyond every cache. Prints a line
   a size: bytes of the three arrays, and the best of its repetitions [byte/s], 24 bytes an entry as STREAM counts
   them.

   J. D. McCalpin, Memory bandwidth and machine balance in current high performance computers, IEEE TCCA Newsletter,
   1995
*/
#define _POSIX_C_SOURCE 200112L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double Now(void)
{
  struct timespec t;

  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void Triad(double *restrict a, const double *restrict b, const double *restrict c, double s, size_t n)
{
  for (size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
}

/* Best of the repetitions; at least 1e9 bytes in all, so that small sets are not timed by a tick of the clock */
static double Rate(double *a, double *b, double *c, size_t n)
{
  const double bytes = 24.0 * (double)n;
  const size_t inner = 1 + (size_t)(2e8 / bytes);
  double       best  = 0.0;

  for (int repeat = 0; repeat < 10; ++repeat) {
    const double start = Now();
    double       rate;

    for (size_t k = 0; k < inner; ++k) {
      Triad(a, b, c, 0.5, n);
      Triad(c, b, a, 0.25, n); /* the next depends on it: nothing can be left out */
    }
    rate = 2.0 * (double)inner * bytes / (Now() - start);
    if (rate > best) best = rate;
  }
  return best;
}

int main(int argc, char **argv)
{
  for (int i = 1; i < argc; ++i) {
    const size_t n = (size_t)(atof(argv[i]) / 24.0);
    double      *a = malloc(n * sizeof(double)), *b = malloc(n * sizeof(double)), *c = malloc(n * sizeof(double));

    if (!n || !a || !b || !c) {
      fprintf(stderr, "triad: no memory for %s bytes\n", argv[i]);
      return 1;
    }
    for (size_t k = 0; k < n; ++k) a[k] = 0.0, b[k] = 1.0, c[k] = 2.0;
    printf("%.0f %.6e\n", 24.0 * (double)n, Rate(a, b, c, n));
    free(a);
    free(b);
    free(c);
  }
  return 0;
}
