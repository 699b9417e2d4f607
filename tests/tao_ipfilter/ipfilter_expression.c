static char help[] =
  "The derivatives of the formulas that the tests of TAOIPFILTER are stated in, against central differences.\n\n";

#include "ipfilter_expression.h"

#define N 3

static const char *const formulas[] = {
  "x1*x2*x3",
  "x1^3-2*x2^-1.5",
  "-x1/x2/x3",
  "x1^x2",
  "x1^(2/3)*(x2-x3)^2",
  "exp(x1*x2)-log(x3)",
  "sqrt(x1+x2*x3)",
  "sin(x1*x2)*cos(x3)",
  "cosh(x1-x2)",
  "atan(x1*x3)",
  "tanh(x1-x2*x3)",
  "erf(x1/x2)",
  "3-(x1+2*(x2-x3*(x1-4)))",
  "7",
};

static PetscReal FirstDifference(const char *formula, const PetscReal x[], PetscInt i, PetscReal step, PetscInt j,
  PetscReal *second)
{
  PetscReal y[N];
  Jet       up, down;

  for (PetscInt k = 0; k < N; k++) y[k] = x[k];
  y[i] = x[i] + step;
  ExpressionEvaluate(formula, y, NULL, &up);
  y[i] = x[i] - step;
  ExpressionEvaluate(formula, y, NULL, &down);
  *second = (up.g[j] - down.g[j]) / (2.0 * step);
  return (up.v - down.v) / (2.0 * step);
}

/* Largest difference of the derivatives from central differences, of values and of first derivatives */
static PetscReal DerivativeError(const char *formula, const PetscReal x[])
{
  Jet       jet;
  PetscReal error = 0.0;

  ExpressionEvaluate(formula, x, NULL, &jet);
  for (PetscInt i = 0; i < N; i++) {
    for (PetscInt j = 0; j < N; j++) {
      PetscReal second, first = FirstDifference(formula, x, i, 1e-5, j, &second);

      error = PetscMax(error, PetscMax(PetscAbsReal(first - jet.g[i]), PetscAbsReal(second - jet.h[i][j])));
    }
  }
  return error;
}

int main(int argc, char **argv)
{
  const PetscReal x[N] = {1.3, 0.7, 0.4};
  Jet             unknown;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(formulas); k++) {
    const PetscReal error = DerivativeError(formulas[k], x);

    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s", formulas[k],
      error < 1e-7 ? "derivatives as by differences\n" : "DERIVATIVES ARE OFF"));
    if (!(error < 1e-7)) PetscCall(PetscPrintf(PETSC_COMM_WORLD, " by %g\n", (double)error));
  }
  ExpressionEvaluate("1+sinh(x1)", x, NULL, &unknown);
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "a function that is not known %s\n",
    PetscIsNanReal(unknown.v) ? "makes no number" : "MAKES A NUMBER"));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      output_file: output/ipfilter_expression.out

TEST*/
