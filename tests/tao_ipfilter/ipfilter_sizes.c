static char help[] = "Sizes of one constraint, bound or start that must not decide what the others may violate, and "
                     "how the solve ends. Second-order corrections.\n\n";

#include "ipfilter_formulas.h"

/* Rows with bounds of TaoSetInequalityBounds() beside those of the problem itself; none where row_bounds is empty */
typedef struct {
  NLP         p;
  const char *row_bounds;
} Case;

#define HS35 "9-8*x1-6*x2-4*x3+2*x1^2+2*x2^2+x3^2+2*x1*x2+2*x1*x3"

static const Case cases[] = {
  {{"bounds of 1e19", HS35, "x1+x2+2*x3; x1-x2", "", "0: 0: 0:", "0.5 0.5 0.5", 1.0 / 9.0, NLP_SOLVED, NULL},
    "-1e19:3 -1e19:1e19"},
  {{"bounds of 1e20", HS35, "x1+x2+2*x3; x1-x2", "", "0: 0: 0:", "0.5 0.5 0.5", 1.0 / 9.0, NLP_SOLVED, NULL},
    "-1e20:3 -1e20:1e20"},
  {{"bounds of 1e30", HS35, "x1+x2+2*x3; x1-x2", "", "0: 0: 0:", "0.5 0.5 0.5", 1.0 / 9.0, NLP_SOLVED, NULL},
    "-1e30:3 -1e30:1e30"},
  {{"bounds of 1e10", HS35, "x1+x2+2*x3; x1-x2", "", "0: 0: 0:", "0.5 0.5 0.5", 1.0 / 9.0, NLP_SOLVED, NULL},
    "-1e10:3 -1e10:1e10"},
  {{"rows out of reach, 1e8", HS35, "3-x1-x2-2*x3; x1+1e8; 1e8-x3", "", "0: 0: 0:", "0.5 0.5 0.5", 1.0 / 9.0,
     NLP_SOLVED, NULL},
    ""},
  {{"rows out of reach, 1e10", HS35, "3-x1-x2-2*x3; x1+1e10; 1e10-x3-x1", "", "0: 0: 0:", "0.5 0.5 0.5", 1.0 / 9.0,
     NLP_SOLVED, NULL},
    ""},
  {{"rows out of reach, curved", "5*x1+50000/x1+20*x2+72000/x2+10*x3+144000/x3", "1-4/x1-32/x2-120/x3; x1+1e8", "",
     "1e-5: 1e-5: 1e-5:", "1 1 1", 6299.842428, NLP_SOLVED, NULL},
    ""},
  {{"currents at two nodes, from zero", "(x1-1)^2+x2^4+2*x2^2+x3^2+(x4-0.3)^4+x4^2", "", "x1-x2-x3; x3-x4", "",
     "0 0 0 0", 0.5035887906424, NLP_SOLVED, NULL},
    ""},
  {{"linear dynamics, from zero", "exp(x1)-3*x1+0.01*x2^2+(x3-1)^2+0.01*x4^2", "", "x1-x2; x3-x1-x4", ": -2:2 : -2:2",
     "0 0 0 0", -0.2837654916053, NLP_SOLVED, NULL},
    ""},
  {{"circle and hyperbola, from afar", "0", "", "x1^2+x2^2-1e4; x1*x2-3e3", "", "1e4 1e-2", 0.0, NLP_SOLVED, NULL}, ""},
  {{"disc and half-plane, from afar", "0", "0.01-x1^2-x2^2; x1+x2-0.1", "", "", "1e4 -2e4", 0.0, NLP_SOLVED, NULL}, ""},
  {{"larger disc and half-plane", "0", "10-x1^2-x2^2; x1+x2-3.16228", "", "", "1e5 -2e5", 0.0, NLP_SOLVED, NULL}, ""},
  {{"cubic equation, from afar", "0", "", "x1+x2^3*1e-3-48; x1-x2", "", "1e6 -1e6", 0.0, NLP_SOLVED, NULL}, ""},
  {{"steep between bounds", "-x1^4", "", "", "0:1e6", "1", -1e24, NLP_SOLVED, NULL}, ""},
  {{"objective as an unknown, badly scaled", "x3", "x3-((x1-1e6)^2+(x2-2e-6)^2+(x1*x2-2)^2)", "", "",
     "1 1 999998000003", 0.0, NLP_SOLVED, NULL},
    ""},
  {{"objective as an unknown, stiff and soft", "x3", "x3-(1e8*(x1-1)^2+1e-4*(x2-1)^2)", "", "", "5 5 1600000000.0016",
     0.0, NLP_SOLVED, NULL},
    ""},
  {{"objective as an unknown, box far from zero", "x3", "x3-((x1-1e4)^2+x2^2)", "", ":9999 -1e-6:1e-6 :", "1e4 0 0",
     1.0, NLP_SOLVED, NULL},
    ""},
  {{"slacks of 1e-3 and 1e6", "0.5*x1^2+0.5*x2^2-x1-x2", "", "0.001-x1-x3; 1e6-x2-x4; x1+1e6-x5; x2-x6",
     ": : 0: 0: 0: 0:", "0 0 0.001 1e6 1e6 0", -0.5009995, NLP_SOLVED, NULL},
    ""},
  {{"saddle beside rows out of reach", "x1*x2", "1e8+x1; 1e10-x2", "", "-1:2 -1:2", "0.5 0.4", -2.0, NLP_SOLVED, NULL},
    ""},
  {{"start of 1e6, rows out of reach", "(x1-1)^4+(x2-2)^2", "1e8+x1; 1e10-x2", "", "", "1e6 -1e6", 0.0, NLP_SOLVED,
     NULL},
    ""},
  {{"curved valley beside rows out of reach", "(2.23-x1)^2+100*(x2-x1^2)^2+(x3+1.74)^4",
     "5-x1-x2-x3; x1+1e10; 1e8-x2; x3+1e9", "", "", "922.96 78.447 355.66", 0.003769500270967, NLP_SOLVED, NULL},
    ""},
  {{"rows in mixed units, slacks", "x1^2+x2^2+2*x3^2+x4^2-5*x1-5*x2-21*x3+7*x4", "",
     "1e6*(8-x1^2-x2^2-x3^2-x4^2-x1+x2-x3+x4)-x5; 10-x1^2-2*x2^2-x3^2-2*x4^2+x1+x4-x6; "
     "1e-6*(5-2*x1^2-x2^2-x3^2-2*x1+x2+x4)-x7",
     ": : : : 0: 0: 0:", "0 0 0 0 8e6 10 5e-6", -44.0, NLP_REACHED, NULL},
    ""},
  {{"cubic row twice, from afar", "x1", "", "(x1-1)^3-x2; (x1-1)^3-x2", "1: 0:", "25000 25000", 1.0, NLP_REACHED, NULL},
    ""},
  {{"cubic row, objective as an unknown", "x3", "x3-x1", "(x1-1)^3-x2", "1: 0: :", "25000 25000 25000", 1.0,
     NLP_REACHED, NULL},
    ""},
  {{"linear objective, far from its bounds", "x1", "", "(x1-1)^3-x2-1", "1: 0:", "25000 25000", 2.0, NLP_SOLVED, NULL},
    ""},
  {{"valley from afar, quartic term", "(-0.22-x1)^2+100*(x2-x1^2)^2+(x3-(-0.64))^4",
     "1e9-x2; 1e15+x2; 1e8+x1; 1e6*1.17-x1-x2-x3", "", "", "11580.0 20410.0 9009.0", 0.0, NLP_SOLVED, NULL},
    ""},
  {{"valley from afar, quartic bottom", "(-1.5-x1)^4+10*(x2-x1^2)^2+(x3-(-0.87)*x1)^2",
     "1e12-x2; 1e9-x2; 1e9+x2; 1e6*2.75-x1-x2-x3", "", "", "261400.0 417200.0 -241400.0", 0.0, NLP_SOLVED, NULL},
    ""},
  {{"valley from afar, start of 1e5", "(1.79-x1)^2+100*(x2-x1^2)^2+(x3-(-0.86))^4",
     "1e20+x3; 1e9+x3; 1e9+x3; 1e12+x3; 1e6*2.06-x1-x2-x3", "", "", "-95500.0 90650.0 61610.0", 0.0, NLP_SOLVED, NULL},
    ""},
  {{"valley from afar, 1e10", "(-2.33-x1)^2+100*(x2-x1^2)^2+(x3-(2.2))^4", "1e10+x2; 1e15-x3; 1e6*2.43-x1-x2-x3", "",
     "", "-128300.0 46770.0 -117600.0", 0.0, NLP_SOLVED, NULL},
    ""},
  {{"cubic valley from afar", "(2.73-x1)^2+(x2-x1^3)^2+(x3-(-0.82))^2", "1e8-x2; 1e20+x1; 1e6*1.77-x1-x2-x3", "", "",
     "-517.5 -3836.0 4075.0", 0.0, NLP_REACHED, NULL},
    ""},
  {{"cubic valley, unknown of 1e9", "(-2.88-x1)^2+(x2-x1^3)^2+(x3-(2.44))^2",
     "1e9-x1; 1e20+x3; 1e15+x3; 1e20-x3; 1e6*1.12-x1-x2-x3", "", "", "-3992.0 -6569.0 -560.6", 0.0, NLP_REACHED, NULL},
    ""},
  {{"disc of radius 1e4, from zero", "x1+x2", "1e8-x1^2-x2^2", "", "", "0 0", -14142.13562373, NLP_SOLVED, NULL}, ""},
  {{"start at a maximum", "-(x1-0.1)^2+x2^2", "", "", "-1:1 -1:1", "0.1 0", -0.81, NLP_SOLVED, NULL}, ""},
  {{"start where a violated row has no gradient", "0", "x1^2+x2^2+x3^2-2; 3-x1^2-x2^2-x3^2", "", "-1:1.5 -1:1.5 -1:1.5",
     "0 0 0", 0.0, NLP_SOLVED, NULL},
    ""},
  {{"root that is not a number below zero", "0.5*(x1-2)^2", "0.5-sqrt(x1)", "", "", "50", 1.53125, NLP_SOLVED, NULL},
    ""},
  {{"saddle by symmetry", "(x1^2-1)^2+x2^2", "", "", "", "0 0.5", 0.0, NLP_SOLVED, NULL}, ""},
  {{"square row", "x1", "", "x1^2", "", "1", 0.0, NLP_REACHED, NULL}, ""},
  {{"no number in the start", "x1^2+x2^2", "x1+x2-1", "", "", "nan 1", 0.5, NLP_DEGENERATE, NULL}, ""},
};

static PetscErrorCode SetRowBounds(FormulasProblem *problem, const char text[])
{
  Vec b[2];

  PetscFunctionBeginUser;
  if (!*text) PetscFunctionReturn(0);
  for (PetscInt k = 0; k < 2; k++) PetscCall(FormulasVector(PETSC_COMM_WORLD, problem->formulas.ci.m, text, k, &b[k]));
  PetscCall(TaoSetInequalityBounds(problem->tao, b[0], b[1]));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecDestroy(&b[k]));
  PetscFunctionReturn(0);
}

/* Of an optimum: at least 1, but what is below 1e-3 has its own size */
static PetscReal Size(PetscReal optimum)
{
  const PetscReal size = PetscAbsReal(optimum);

  return PetscMax(size, size > 0.0 ? PetscMin(1.0, 1e3 * size) : 1.0);
}

/* The optimum to 1e-6, and constraints met to 1e-6 beside the rows of the Jacobian; for what has no answer
   (NLP_DEGENERATE), an end by the reason that it has; where a failure is admitted (NLP_REACHED), no other answer */
static PetscErrorCode RunCase(const Case *test)
{
  FormulasProblem    problem;
  TaoConvergedReason reason;
  const char        *sentence;
  PetscReal          f, violation = 0.0;
  PetscBool          right;

  PetscFunctionBeginUser;
  PetscCall(FormulasCreate(PETSC_COMM_WORLD, &test->p, &problem));
  PetscCall(SetRowBounds(&problem, test->row_bounds));
  PetscCall(TaoSolve(problem.tao));
  PetscCall(TaoGetSolutionStatus(problem.tao, NULL, &f, NULL, NULL, NULL, &reason));
  PetscCall(TaoIPFilterGetReason(problem.tao, &sentence));
  if (!*test->row_bounds) PetscCall(FormulasViolation(&problem, PETSC_TRUE, &violation));
  if (test->p.end == NLP_DEGENERATE) right = (PetscBool)(reason == TAO_DIVERGED_NAN);
  else
    right =
      (PetscBool)(reason > 0 && violation < 1e-6 && PetscAbsReal(f - test->p.optimum) < 1e-6 * Size(test->p.optimum));
  if (test->p.end == NLP_REACHED && reason < 0) right = PETSC_TRUE;
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", test->p.name, right ? "right" : "NOT AS EXPECTED"));
  if (!right)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  %s, objective %.9g, violation %g; %s\n", TaoConvergedReasons[reason],
      (double)f, (double)violation, sentence));
  PetscCall(FormulasDestroy(&problem));
  PetscFunctionReturn(0);
}

/* By how much constraints without an interior were relaxed is said in the caller's units: the solution violates them by
   that much, whatever the unit of a row is */
static PetscErrorCode TestRelaxedUnits(void)
{
  const char *rows[] = {"-x1*x2", "-1e6*x1*x2", "-1e-4*x1*x2"};

  PetscFunctionBeginUser;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(rows); k++) {
    const NLP       mpcc = {"", "(x1-1)^2+(x2-1)^2", rows[k], "", "0: 0:", "2 0.5", 1.0, NLP_DEGENERATE, NULL};
    const char     *sentence, *said;
    double          told = 0.0;
    PetscReal       violation;
    FormulasProblem problem;

    PetscCall(FormulasCreate(PETSC_COMM_WORLD, &mpcc, &problem));
    PetscCall(TaoSolve(problem.tao));
    PetscCall(TaoIPFilterGetReason(problem.tao, &sentence));
    PetscCall(FormulasViolation(&problem, PETSC_FALSE, &violation));
    said = strstr(sentence, "relaxed by ");
    if (said) told = strtod(said + strlen("relaxed by "), NULL);
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "relaxed row %s: ", rows[k]));
    if (violation <= 1.01 * told && violation >= 0.1 * told && told > 0.0)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "violated by what is said\n"));
    else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "violated by %g, %s\n", (double)violation, sentence));
    PetscCall(FormulasDestroy(&problem));
  }
  PetscFunctionReturn(0);
}

/* Without scaling, a gradient that is small only because of the caller's units does not mean convergence. The answer
   must be right, or the reason must be negative. */
static PetscErrorCode TestUnscaled(void)
{
  static const Case unscaled[] = {
    {{"unscaled, objective in 1e-8", "1e-8*((x1-1)^2+(x2-2)^2+(x1-x2)^4)", "3-x1-x2", "", "", "5 5", 1.875e-9,
       NLP_SOLVED, NULL},
      ""},
    {{"unscaled, unknown in 1e8", "(x1*1e-8-2)^2+(x2-1)^2", "2-x1*1e-8-x2", "", "", "3e8 3", 0.5, NLP_REACHED, NULL},
      ""},
    {{"unscaled, falls slowly", "-log(1+x1)+x2^2", "", "", "0: :", "1 1", -1e20, NLP_REACHED, NULL}, ""},
  };

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_scaling", "none"));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_max_it", "150"));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(unscaled); k++) PetscCall(RunCase(&unscaled[k]));
  PetscCall(PetscOptionsClearValue(NULL, "-tao_ipfilter_scaling"));
  PetscCall(PetscOptionsClearValue(NULL, "-tao_max_it"));
  PetscFunctionReturn(0);
}

/* From a start far away the violation of an infeasible constraint is small beside the first one */
static PetscErrorCode TestInfeasible(void)
{
  const char *rows[] = {"-0.1-x1^2-1.689*x2^2", "-10-x1^2-1.779*x2^2", "-0.01-x1^2-1.111*x2^2"};

  PetscFunctionBeginUser;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(rows); k++) {
    const NLP          far = {"", "0", rows[k], "", "", "1e4 1e4", 0.0, NLP_SOLVED, NULL};
    const char        *sentence;
    TaoConvergedReason reason;
    FormulasProblem    problem;

    PetscCall(FormulasCreate(PETSC_COMM_WORLD, &far, &problem));
    PetscCall(TaoSolve(problem.tao));
    PetscCall(TaoGetConvergedReason(problem.tao, &reason));
    PetscCall(TaoIPFilterGetReason(problem.tao, &sentence));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "infeasible row %s, from afar: %s\n", rows[k],
      reason < 0 && strstr(sentence, "infeasible") ? "said to be infeasible" : sentence));
    PetscCall(FormulasDestroy(&problem));
  }
  PetscFunctionReturn(0);
}

/* Distant bounds cost no steps. Bounds of 1e19 or more count as infinite. Nearer ones do not enlarge the first mu. */
static PetscErrorCode TestFarBounds(void)
{
  const char *bounds[] = {"", "-1e30:1e30 -1e19:1e20 -1e30:1e30", "-1e12:1e12 -1e15:1e15 -1e12:1e12"};
  PetscInt    its[3];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 3; k++) {
    const NLP       p = {"", "x3", "", "x3-(x1-1)^2-x2^2; x1+x2-3", bounds[k], "0 0 0", 2.0, NLP_SOLVED, NULL};
    FormulasProblem problem;

    PetscCall(FormulasCreate(PETSC_COMM_WORLD, &p, &problem));
    PetscCall(TaoSolve(problem.tao));
    PetscCall(TaoGetSolutionStatus(problem.tao, &its[k], NULL, NULL, NULL, NULL, NULL));
    PetscCall(FormulasDestroy(&problem));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "variables with bounds out of reach: %s\n",
    its[1] == its[0] && its[2] <= its[0] + 2 ? "no more steps than without" : "MORE STEPS"));
  PetscFunctionReturn(0);
}

/* A cold start begins with the barrier parameter of the option, with rows or without */
static PetscErrorCode TestFirstBarrier(void)
{
  const NLP   bounded = {"", "(x1-2)^2+(x2-3)^2+x1*x2", "", "", "0:1 0:1", "0.5 0.5", 0.0, NLP_SOLVED, NULL};
  const char *mu[2]   = {"1e-9", "1e3"};
  PetscInt    its[2];

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_start", "cold"));
  PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_barrier", "monotone"));
  for (PetscInt k = 0; k < 2; k++) {
    FormulasProblem problem;

    PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_mu_init", mu[k]));
    PetscCall(FormulasCreate(PETSC_COMM_WORLD, &bounded, &problem));
    PetscCall(TaoSolve(problem.tao));
    PetscCall(TaoGetSolutionStatus(problem.tao, &its[k], NULL, NULL, NULL, NULL, NULL));
    PetscCall(FormulasDestroy(&problem));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "-tao_ipfilter_mu_init without rows: %s\n",
    its[0] < its[1] ? "fewer steps from a small one" : "NO EFFECT"));
  PetscFunctionReturn(0);
}

/* Maratos's problem, where full Newton steps violate the constraint and raise the objective: second-order corrections
   spare steps, and cost less than one evaluation a step */
static PetscErrorCode TestCorrection(PetscBool equality)
{
  const char *circle = "x1^2+x2^2-1", *corrections[] = {"0", "4"};
  const NLP   maratos = {"", "2*(x1^2+x2^2-1)-x1", equality ? "" : circle, equality ? circle : "", "",
      "0.69670670934716542 0.71735609089952276", -1.0, NLP_SOLVED, NULL};
  PetscInt    steps[2], points[2];
  PetscReal   f[2];

  PetscFunctionBeginUser;
  for (PetscInt k = 0; k < 2; k++) {
    FormulasProblem problem;

    PetscCall(PetscOptionsSetValue(NULL, "-tao_ipfilter_max_soc", corrections[k]));
    PetscCall(FormulasCreate(PETSC_COMM_WORLD, &maratos, &problem));
    PetscCall(TaoSolve(problem.tao));
    PetscCall(TaoGetSolutionStatus(problem.tao, &steps[k], &f[k], NULL, NULL, NULL, NULL));
    points[k] = problem.formulas.npoints;
    PetscCall(FormulasDestroy(&problem));
  }
  PetscCall(PetscOptionsClearValue(NULL, "-tao_ipfilter_max_soc"));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "correction of an %s: ", equality ? "equality" : "inequality"));
  if (steps[1] < steps[0] && points[1] <= points[0] + steps[1] && PetscMax(f[0], f[1]) < -1.0 + 1e-6)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "fewer steps\n"));
  else
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
      "%" PetscInt_FMT " steps and %" PetscInt_FMT " points, with it %" PetscInt_FMT " and %" PetscInt_FMT
      ", objective %g, %g\n",
      steps[0], points[0], steps[1], points[1], (double)f[0], (double)f[1]));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(cases); k++) PetscCall(RunCase(&cases[k]));
  PetscCall(TestRelaxedUnits());
  PetscCall(TestInfeasible());
  PetscCall(TestUnscaled());
  PetscCall(TestFarBounds());
  PetscCall(TestFirstBarrier());
  PetscCall(TestCorrection(PETSC_TRUE));
  PetscCall(PetscOptionsInsertString(NULL, "-tao_ipfilter_start cold -tao_ipfilter_slack_init 1e-4 "
                                           "-tao_ipfilter_dual_init 1.5 -tao_ipfilter_mu_init 1.5e-4"));
  PetscCall(TestCorrection(PETSC_FALSE));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   testset:
      output_file: output/ipfilter_sizes_1.out
      test:
         suffix: 1
      test:
         suffix: ranks_long
         nsize: 2

TEST*/
