static char help[] =
  "The active set of contact problems in slender bodies: complementarity problems whose exchanges of single rows take\n"
  "very many steps in a fixed order. Each solution is checked against the conditions that define it.\n\n";

#include "../../tao_ipfilter/subspace/active_set.c"

/* What active_set.c needs of the compliance: a dense matrix that is known */
static PetscReal *matrix;

PetscErrorCode IPComplianceColumns(IPCompliance *c, PetscInt n, const PetscInt rows[])
{
  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < n; k++) c->column[rows[k]] = rows[k];
  c->C = matrix;
  PetscFunctionReturn(0);
}

/* Sets C = L L^T (Fathi, Computational complexity of LCPs associated with positive definite symmetric matrices, 1979).
   L is lower triangular; its diagonal entries are 1, the others 2. back: whether the order of the rows is reversed */
static void SetFathi(PetscInt m, PetscBool back, PetscReal C[])
{
  for (PetscInt i = 0; i < m; i++) {
    for (PetscInt j = 0; j < m; j++) {
      const PetscInt a = back ? m - 1 - i : i, b = back ? m - 1 - j : j, least = PetscMin(a, b);

      C[i + j * m] = 4.0 * least + (a == b ? 1.0 : 2.0);
    }
  }
}

/* Sets C to the compliance of cantilevers that lie on each other, with n contacts between neighbours. A contact acts on
   the beam above it, and with the opposite sign on the beam below it. A force at b deflects a beam at a < b by
   a^2 (3 b - a). Each contact has a small compliance of its own. */
static void SetBeams(PetscInt nbeams, PetscInt n, PetscReal C[])
{
  const PetscInt m = (nbeams - 1) * n;

  for (PetscInt i = 0; i < m; i++) {
    for (PetscInt j = 0; j < m; j++) {
      const PetscReal a = (1.0 + PetscMin(i % n, j % n)) / n, b = (1.0 + PetscMax(i % n, j % n)) / n;
      const PetscInt  apart = PetscAbsInt(i / n - j / n);

      C[i + j * m] = (apart > 1 ? 0.0 : apart ? -1.0 : 2.0) * a * a * (3.0 * b - a) + (i == j ? 1e-5 : 0.0);
    }
  }
}

/* Solves the complementarity problem C lambda >= h, lambda >= 0, lambda^T (C lambda - h) = 0, and prints whether the
   solution satisfies it. start: whether all rows are active at the start, or none */
static PetscErrorCode Solve(const char name[], PetscInt m, const PetscReal h[], PetscBool start)
{
  IPReducedSystem s   = {.m = m};
  IPCompliance    c   = {.m = m};
  IPActiveSet     set = {0};
  PetscInt        steps;
  PetscReal       worst = 0.0, largest = 0.0;
  PetscBool       solved;

  PetscFunctionBeginUser;
  PetscCall(IPActiveSetCreate(m, &set));
  PetscCall(PetscMalloc4(m, &s.h, m, &s.lambda, m, &s.gap, m, &c.column));
  PetscCall(PetscArraycpy(s.h, h, m));
  PetscCall(PetscArrayzero(s.lambda, m));
  for (PetscInt i = 0; i < m; i++) {
    c.column[i]   = -1;
    set.active[i] = start;
    s.length      = PetscMax(s.length, PetscAbsReal(h[i]));
  }
  PetscCall(IPActiveSetSolve(&set, &c, &s, &steps, &solved));
  for (PetscInt i = 0; i < m; i++) {
    PetscReal gap = -h[i], size = 0.0;

    for (PetscInt j = 0; j < m; j++) {
      gap += matrix[i + j * m] * s.lambda[j];
      size += PetscAbsReal(matrix[i + j * m] * s.lambda[j]);
    }
    largest = PetscMax(largest, size);
    worst   = PetscMax(worst, PetscAbsReal(PetscMin(s.lambda[i] * matrix[i + i * m], gap)));
  }
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", name, solved && worst <= 1e-10 * largest ? "solved" : "NOT solved"));
  if (!solved || worst > 1e-10 * largest)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %" PetscInt_FMT " steps, error %g\n", steps, (double)(worst / largest)));
  PetscCall(PetscFree4(s.h, s.lambda, s.gap, c.column));
  PetscCall(IPActiveSetDestroy(&set));
  PetscFunctionReturn(0);
}

static PetscErrorCode SolveFathi(PetscBool back)
{
  const PetscInt m = 20;
  PetscReal      h[20];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m * m, &matrix));
  SetFathi(m, back, matrix);
  for (PetscInt i = 0; i < m; i++) h[i] = PetscPowRealInt(2.0, back ? i : m - 1 - i);
  PetscCall(Solve(back ? "Fathi's matrix, opposite order" : "Fathi's matrix", m, h, PETSC_FALSE));
  PetscCall(PetscFree(matrix));
  PetscFunctionReturn(0);
}

/* Solves for the contact forces of a stack of cantilevers. A force at the tip of the uppermost presses it onto the
   others. */
static PetscErrorCode SolveBeams(PetscInt nbeams, PetscInt n)
{
  const PetscInt m = (nbeams - 1) * n;
  PetscReal     *h;
  char           name[64];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m * m, &matrix, m, &h));
  SetBeams(nbeams, n, matrix);
  for (PetscInt i = 0; i < m; i++) {
    const PetscReal a = (1.0 + i % n) / n;

    h[i] = i / n == nbeams - 2 ? 0.5 * a * a * (3.0 - a) : 0.0;
  }
  PetscCall(PetscSNPrintf(name, sizeof(name), "%" PetscInt_FMT " beams, %" PetscInt_FMT " contacts each", nbeams, n));
  PetscCall(Solve(name, m, h, PETSC_TRUE));
  PetscCall(PetscFree2(matrix, h));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(SolveFathi(PETSC_FALSE));
  PetscCall(SolveFathi(PETSC_TRUE));
  PetscCall(SolveBeams(4, 40));
  PetscCall(SolveBeams(9, 160)); /* the exchange of the last wrong row alone did not end in 200 steps */
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

  test:
    suffix: 1

TEST*/
