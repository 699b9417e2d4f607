/*
   Substitution for one right-hand side with one supernode, in groups of four columns, so that each entry of the
   right-hand side is read once for four columns. This file is included once for each precision of the factors. Two
   macros must be defined before: ENTRY is the type of the factors, and NAME(name) appends the precision to a name.
*/

/* y += a x for four columns of a matrix with columns of length m */
static inline void NAME(
  GroupAdd)(PetscInt n, size_t m, const ENTRY *restrict a, const PetscReal x[], PetscReal *restrict y)
{
  const ENTRY *restrict b = a + m, *restrict c = b + m, *restrict d = c + m;
  const PetscReal x0 = x[0], x1 = x[1], x2 = x[2], x3 = x[3];

  for (PetscInt i = 0; i < n; i++) y[i] += a[i] * x0 + b[i] * x1 + c[i] * x2 + d[i] * x3;
}

/* x -= a^T y for four columns */
static inline void NAME(
  GroupDot)(PetscInt n, size_t m, const ENTRY *restrict a, const PetscReal *restrict y, PetscReal x[])
{
  const ENTRY *restrict b = a + m, *restrict c = b + m, *restrict d = c + m;
  PetscReal part[4][GROUP_LANES] = {{0.0}};
  PetscInt  i                    = 0;

  for (; i + GROUP_LANES <= n; i += GROUP_LANES) {
    for (PetscInt l = 0; l < GROUP_LANES; l++) {
      part[0][l] += a[i + l] * y[i + l];
      part[1][l] += b[i + l] * y[i + l];
      part[2][l] += c[i + l] * y[i + l];
      part[3][l] += d[i + l] * y[i + l];
    }
  }
  for (; i < n; i++) {
    part[0][0] += a[i] * y[i];
    part[1][0] += b[i] * y[i];
    part[2][0] += c[i] * y[i];
    part[3][0] += d[i] * y[i];
  }
  for (PetscInt j = 0; j < 4; j++)
    for (PetscInt l = 0; l < GROUP_LANES; l++) x[j] -= part[j][l];
}

/*
   Forward substitution. x: m entries. On entry: the right-hand sides of the supernode's own columns, followed by zeros.
   On exit: the solution, followed by what must be added to the right-hand sides of the rows below.
*/
AMGF_CLONES static void NAME(GroupForward)(PetscInt m, PetscInt columns, const ENTRY *L, PetscReal *x)
{
  for (PetscInt j = 0; j < columns; j += 4) {
    const PetscInt n = PetscMin(4, columns - j);
    const ENTRY   *a = L + (size_t)j * (size_t)m + j;
    PetscReal      minus[4];

    for (PetscInt k = 0; k < n; k++) {
      const ENTRY *column = a + (size_t)k * (size_t)m;

      x[j + k] /= column[k];
      for (PetscInt i = k + 1; i < n; i++) x[j + i] -= column[i] * x[j + k];
      minus[k] = -x[j + k];
    }
    if (n == 4) NAME(GroupAdd)(m - j - 4, (size_t)m, a + 4, minus, x + j + 4);
    else
      for (PetscInt k = 0; k < n; k++)
        for (PetscInt i = n; i < m - j; i++) x[j + i] += a[(size_t)k * (size_t)m + (size_t)i] * minus[k];
  }
}

/* Backward substitution. x: m entries. On entry: the right-hand sides of the supernode's own columns, followed by the
   solution of the rows below. On exit the solution replaces these right-hand sides. */
AMGF_CLONES static void NAME(GroupBackward)(PetscInt m, PetscInt columns, const ENTRY *L, PetscReal *x)
{
  for (PetscInt j = (columns - 1) / 4 * 4; j >= 0; j -= 4) {
    const PetscInt n = PetscMin(4, columns - j);
    const ENTRY   *a = L + (size_t)j * (size_t)m + j;

    if (n == 4) NAME(GroupDot)(m - j - 4, (size_t)m, a + 4, x + j + 4, x + j);
    else
      for (PetscInt k = 0; k < n; k++)
        for (PetscInt i = n; i < m - j; i++) x[j + k] -= a[(size_t)k * (size_t)m + (size_t)i] * x[j + i];
    for (PetscInt k = n - 1; k >= 0; k--) {
      const ENTRY *column = a + (size_t)k * (size_t)m;

      for (PetscInt i = k + 1; i < n; i++) x[j + k] -= column[i] * x[j + i];
      x[j + k] /= column[k];
    }
  }
}
