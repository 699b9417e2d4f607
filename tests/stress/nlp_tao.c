static char help[] =
  "A solver of TAO, ipfilter unless -tao_type names another, on problems that tests/stress/nlp.py wrote.\n\
  -problems FILE    the problems; without it, those of tests/tao_ipfilter/ipfilter_nlp.h are printed\n\
  -first K          begin with the problem number K\n\
A line a problem: name, how it ended, objective, violation, iterations, points evaluated, seconds, sentence.\n\n";

#include "nlp_read.h"
#include "../tao_ipfilter/ipfilter_formulas.h"

/* How it ended, in the words of nlp.py */
static const char *Ending(TaoConvergedReason reason, const char *sentence)
{
  if (reason > 0) return strstr(sentence, "acceptable") == sentence ? "acceptable" : "converged";
  if (strstr(sentence, "no multipliers") == sentence) return "no multipliers";
  if (strstr(sentence, "infeasible")) return "infeasible";
  return strstr(sentence, "unbounded") ? "unbounded" : "failed";
}

static PetscErrorCode ReportProblem(const FormulasProblem *problem, double seconds)
{
  const Formulas    *formulas = &problem->formulas;
  Tao                tao      = problem->tao;
  TaoConvergedReason reason;
  PetscReal          violation, a[EXPRESSION_MAX];
  PetscInt           its, npoints = formulas->npoints;
  PetscBool          own;
  const char        *sentence;
  Jet                f;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, &its, NULL, NULL, NULL, NULL, &reason));
  PetscCall(PetscObjectTypeCompare((PetscObject)tao, TAOIPFILTER, &own));
  if (own) PetscCall(TaoIPFilterGetReason(tao, &sentence));
  else sentence = TaoConvergedReasons[reason];
  PetscCall(FormulasGather(problem->x, a));
  ExpressionEvaluate(formulas->p->objective, a, NULL, &f);
  PetscCall(FormulasViolation(problem, PETSC_TRUE, &violation));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s|%s|%.12e|%.1e|%" PetscInt_FMT "|%" PetscInt_FMT "|%.5f|%s\n",
    formulas->p->name, Ending(reason, sentence), (double)f.v, (double)violation, its, npoints, seconds, sentence));
  fflush(stdout);
  PetscFunctionReturn(0);
}

static PetscErrorCode SolveProblem(const NLP *p)
{
  FormulasProblem problem;
  PetscLogDouble  begin, end;

  PetscFunctionBeginUser;
  PetscCall(FormulasCreate(PETSC_COMM_WORLD, p, &problem));
  PetscCall(PetscTime(&begin));
  PetscCall(TaoSolve(problem.tao));
  PetscCall(PetscTime(&end));
  PetscCall(ReportProblem(&problem, end - begin));
  PetscCall(FormulasDestroy(&problem));
  PetscFunctionReturn(0);
}

/* The problems of ipfilter_nlp.h: name, optimum, how it ends, other minima, and the fields that NLPRead() reads */
static PetscErrorCode PrintProblems(void)
{
  PetscFunctionBeginUser;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(problems); i++) {
    NLP p = problems[i];

    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "%s\n%.16g\n%d\n%s\n", p.name, p.optimum, (int)p.end, p.others ? p.others : ""));
    for (int k = 0; k < NLP_FIELDS; k++) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", *NLPField(&p, k)));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode SolveFile(const char *name, PetscInt first)
{
  FILE *file = fopen(name, "r");
  NLP   p;

  PetscFunctionBeginUser;
  PetscCheck(file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "Cannot open %s", name);
  for (PetscInt k = 0; NLPRead(file, &p); k++) {
    if (k >= first) PetscCall(SolveProblem(&p));
    NLPFree(&p);
  }
  NLPFree(&p);
  fclose(file);
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  char      name[PETSC_MAX_PATH_LEN];
  PetscInt  first = 0;
  PetscBool given;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PetscOptionsGetString(NULL, NULL, "-problems", name, sizeof(name), &given));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-first", &first, NULL));
  if (given) PetscCall(SolveFile(name, first));
  else PetscCall(PrintProblems());
  PetscCall(PetscFinalize());
  return 0;
}
