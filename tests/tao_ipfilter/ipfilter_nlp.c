static char help[] =
  "Small problems whose solutions are known: Hock and Schittkowski's, degenerate, infeasible, unbounded, badly\n\
scaled ones.\n\
  -mode NAME        solver options by their name below, with limits of all steps and evaluations\n\
  -problems A,B     some problems only\n\
  -relaxed          tell also whether the solver says that it has relaxed the constraints\n\n";

#include "ipfilter_problem.h"
#include "ipfilter_formulas.h"

#define NMODES 5

typedef struct {
  PetscInt steps, evaluations;
} Counts;

/* skip: ",the problems,that are not solved,"; why stands above them. most: what all problems may take, a tenth more
   than they took on one machine, since rounding differs */
static const struct {
  const char *name, *options, *skip;
  Counts      most;
} modes[NMODES] = {
  /* zigzag takes more or less than 200 steps, as rounding has it: the test zigzag solves it */
  {"default", "-tao_max_it 200", ",zigzag,", {2000, 5900}},
  {"direct",
    "-tao_max_it 200 -tao_ipfilter_ksp_type preonly -tao_ipfilter_pc_type lu -tao_ipfilter_pc_factor_mat_solver_type "
    "mumps",
    ",zigzag,", {2300, 6900}},
  /* it runs into a corner from which restoration leads to a local minimum of the violation, and says so */
  {"monotone", "-tao_max_it 200 -tao_ipfilter_barrier monotone", ",HS104,zigzag,", {2100, 6100}},
  /* differences know nothing of units as far apart as those of HS54 and HS99EXP */
  {"differences", "-tao_max_it 200 -hessian 0", ",HS54,HS99EXP,zigzag,", {2000, 17300}},
  /* dense matrices, whose conversions drop zeros: the same path as in the first mode */
  {"dense", "-tao_max_it 200 -dense_hessian -dense_jacobians", ",zigzag,", {2000, 5900}},
};

/* Rounding decides which way these go, and one way is twice as long as another: they do not count */
static const char erratic[] = ",HS108,scale4,zigzag,parabola,";

/* Whether a list ",A,B," names the problem */
static PetscErrorCode Named(const char *list, const NLP *p, PetscBool *named)
{
  char name[64];

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(name, sizeof(name), ",%s,", p->name));
  *named = (PetscBool)(strstr(list, name) != NULL);
  PetscFunctionReturn(0);
}

/* What came of it */
typedef struct {
  PetscBool          good; /* as the problem says it ends */
  TaoConvergedReason reason;
  const char        *sentence;
  PetscReal          f, error, violation;
  Counts             counts;
} Outcome;

/* Distance of f from an optimum, relative but for the smallest */
static PetscReal RelativeError(PetscReal f, PetscReal optimum)
{
  const PetscReal size = PetscAbsReal(optimum);

  return PetscAbsReal(f - optimum) / PetscMax(size, size > 0.0 ? PetscMin(1.0, 1e3 * size) : 1.0);
}

/* The least distance of f from the known minima */
static PetscReal ObjectiveError(const NLP *p, PetscReal f)
{
  PetscReal   error = RelativeError(f, p->optimum);
  const char *s     = p->others ? p->others : "";
  char       *end;

  for (PetscReal other = strtod(s, &end); end != s; s = end, other = strtod(s, &end))
    error = PetscMin(error, RelativeError(f, other));
  return error;
}

/* Without multipliers: no optimum, or one that is called acceptable; "converged" only where it is one */
static PetscBool DegenerateIsGood(TaoConvergedReason reason, const char *sentence, PetscReal error, PetscReal violation)
{
  if (reason < 0) return (PetscBool)!strstr(sentence, "infeasible");
  return (PetscBool)(violation < 1e-6 && error < (reason == TAO_CONVERGED_STEPTOL ? 1e-3 : 1e-6));
}

/* The optimum, which is called acceptable, or of which it is said that no multipliers exist */
static PetscBool ReachedIsGood(TaoConvergedReason reason, const char *sentence, PetscReal error, PetscReal violation)
{
  if (reason > 0) return DegenerateIsGood(reason, sentence, error, violation);
  return (PetscBool)(strstr(sentence, "no multipliers") == sentence && violation < 1e-6 && error < 1e-3);
}

/* The known optimum at a feasible point; or it is said that there is none. Where the solver fails, what it returns
   violates the constraints no more than the start did, by first. */
static PetscErrorCode Judge(const FormulasProblem *problem, PetscReal first, Outcome *o)
{
  const NLP *p   = problem->formulas.p;
  Tao        tao = problem->tao;

  PetscFunctionBeginUser;
  PetscCall(TaoGetSolutionStatus(tao, &o->counts.steps, &o->f, NULL, NULL, NULL, &o->reason));
  PetscCall(TaoGetCurrentFunctionEvaluations(tao, &o->counts.evaluations));
  PetscCall(TaoIPFilterGetReason(tao, &o->sentence));
  PetscCall(FormulasViolation(problem, PETSC_FALSE, &o->violation));
  o->error = ObjectiveError(p, o->f);
  if (p->end == NLP_SOLVED) o->good = (PetscBool)(o->reason > 0 && o->error < 1e-6 && o->violation < 1e-6);
  else if (p->end == NLP_DEGENERATE) o->good = DegenerateIsGood(o->reason, o->sentence, o->error, o->violation);
  else if (p->end == NLP_REACHED) o->good = ReachedIsGood(o->reason, o->sentence, o->error, o->violation);
  else if (p->end == NLP_INFEASIBLE) o->good = (PetscBool)(o->reason < 0 && strstr(o->sentence, "infeasible"));
  else o->good = (PetscBool)(o->reason < 0 && strstr(o->sentence, "unbounded"));
  if (o->reason < 0 && o->violation > (1.0 + PETSC_SMALL) * first) o->good = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Tells what is not simply solved */
static PetscErrorCode ReportVerdict(const NLP *p, const Outcome *o)
{
  static const char *const verdicts[] = {"solved", "nothing wrong", "said to be infeasible", "said to be unbounded",
    "reached"};
  PetscBool                relaxed    = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-relaxed", &relaxed, NULL));
  if (!o->good)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: NOT AS EXPECTED: %s, objective %.9e, error %g, violation %g; %s\n",
      p->name, TaoConvergedReasons[o->reason], (double)o->f, (double)o->error, (double)o->violation, o->sentence));
  else if (p->end != NLP_SOLVED || relaxed)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", p->name, verdicts[p->end]));
  if (relaxed)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  constraints said to be relaxed: %d\n",
      strstr(o->sentence, "relaxed by") ? 1 : 0));
  PetscFunctionReturn(0);
}

/* The problem stays: its solver has the sentence */
static PetscErrorCode SolveAndJudge(MPI_Comm comm, const NLP *p, Outcome *outcome, FormulasProblem *problem)
{
  PetscReal first;

  PetscFunctionBeginUser;
  PetscCall(FormulasCreate(comm, p, problem));
  PetscCall(FormulasViolation(problem, PETSC_FALSE, &first));
  PetscCall(TaoSolve(problem->tao));
  PetscCall(Judge(problem, first, outcome));
  PetscFunctionReturn(0);
}

static PetscErrorCode PushMode(PetscInt mode, PetscOptions *options)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsCreate(options));
  PetscCall(PetscOptionsInsertString(*options, modes[mode].options));
  PetscCall(PetscOptionsPush(*options));
  PetscFunctionReturn(0);
}

static PetscErrorCode PopMode(PetscOptions *options)
{
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsPop());
  PetscCall(PetscOptionsDestroy(options));
  PetscFunctionReturn(0);
}

/* Whether a problem is to be solved: it is named, or none is and the mode does not skip it */
static PetscErrorCode Wanted(const NLP *p, PetscInt mode, PetscInt nonly, char *const only[], PetscBool *wanted)
{
  PetscBool skipped = PETSC_FALSE;

  PetscFunctionBeginUser;
  *wanted = PETSC_FALSE;
  for (PetscInt i = 0; i < nonly && !*wanted; i++) PetscCall(PetscStrcmp(only[i], p->name, wanted));
  if (!nonly && mode >= 0) PetscCall(Named(modes[mode].skip, p, &skipped));
  if (!nonly) *wanted = (PetscBool)!skipped;
  PetscFunctionReturn(0);
}

/* mode: negative for the options of the command line */
static PetscErrorCode SolveAll(PetscInt mode)
{
  char        *only[8];
  PetscInt     nonly = (PetscInt)PETSC_STATIC_ARRAY_LENGTH(only), nsolved = 0;
  Counts       all = {0, 0};
  PetscOptions options;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetStringArray(NULL, NULL, "-problems", only, &nonly, NULL));
  if (mode >= 0) PetscCall(PushMode(mode, &options));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(problems); k++) {
    Outcome         outcome;
    FormulasProblem problem;
    PetscBool       wanted = PETSC_FALSE, wild = PETSC_FALSE;

    PetscCall(Wanted(&problems[k], mode, nonly, only, &wanted));
    if (!wanted) continue;
    PetscCall(SolveAndJudge(PETSC_COMM_WORLD, &problems[k], &outcome, &problem));
    PetscCall(ReportVerdict(&problems[k], &outcome));
    PetscCall(FormulasDestroy(&problem));
    PetscCall(Named(erratic, &problems[k], &wild));
    if (outcome.good && problems[k].end == NLP_SOLVED) ++nsolved;
    if (wild) continue;
    all.steps += outcome.counts.steps;
    all.evaluations += outcome.counts.evaluations;
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%" PetscInt_FMT " problems solved\n", nsolved));
  if (mode >= 0 && (all.steps > modes[mode].most.steps || all.evaluations > modes[mode].most.evaluations))
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
      "MORE THAN %" PetscInt_FMT " steps or %" PetscInt_FMT " evaluations: %" PetscInt_FMT " and %" PetscInt_FMT "\n",
      modes[mode].most.steps, modes[mode].most.evaluations, all.steps, all.evaluations));
  if (mode >= 0) PetscCall(PopMode(&options));
  for (PetscInt i = 0; i < nonly; i++) PetscCall(PetscFree(only[i]));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *names[NMODES];
  PetscInt    mode = -1;
  PetscBool   given;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (PetscInt i = 0; i < NMODES; i++) names[i] = modes[i].name;
  PetscCall(PetscOptionsGetEList(NULL, NULL, "-mode", names, NMODES, &mode, &given));
  PetscCall(SolveAll(given ? mode : -1));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      args: -mode default

   test:
      suffix: 2
      nsize: 2
      args: -mode default -problems HS6,HS26,HS35,HS38,HS93,HS98,MPCC,cubic

   test:
      suffix: 2_long
      nsize: 2
      args: -mode default
      output_file: output/ipfilter_nlp_1.out

   test:
      suffix: direct
      args: -mode direct
      output_file: output/ipfilter_nlp_1.out

   test:
      suffix: monotone
      args: -mode monotone

   test:
      suffix: differences
      args: -mode differences

   # the line search cuts many steps in a row; the watchdog and the restoration phase must end this
   test:
      suffix: zigzag
      args: -problems zigzag -tao_max_it 400

   # where no direction is found, the restoration starts from the violation of the present iterate, not of
   # the last line search
   test:
      suffix: no_direction
      args: -problems circles,HS17 -tao_ipfilter_delta_max 1e-10

   # constraints without an interior are relaxed by less than the tolerance, and the solver says so
   test:
      suffix: relaxed
      args: -problems MPCC,HS35 -relaxed

   # c = x y - 1 has one nonzero in its Jacobian at the start, two later
   test:
      suffix: dense_jacobian
      args: -problems hyperbola -dense_jacobians

   test:
      suffix: dense
      args: -mode dense
      output_file: output/ipfilter_nlp_1.out

   test:
      suffix: dense_2
      nsize: 2
      args: -mode dense -problems HS1,HS14,HS39,HS43,HS71,HS104,HS113,circles

TEST*/
