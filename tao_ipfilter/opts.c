/* Options and their defaults. */
#include "ipfilterimpl.h"
#include "tao_ipfilter/solver/options.h"

const char *const        IPStarts[]          = {"cold", "predict", "warm", "IPStart", "IP_START_", NULL};
const char *const        IPBarrierRules[]    = {"monotone", "mehrotra", "IPBarrierRule", "IP_BARRIER_", NULL};
const char *const        IPKKTMeasures[]     = {"relative", "mass", "IPKKTMeasure", "IP_KKT_", NULL};
const char *const        IPForcings[]        = {"adaptive", "fixed", "IPForcing", "IP_FORCING_", NULL};
static const char *const IPEqualityMethods[] = {"auto", "augmented", "condensed", "IPEqualityMethod", "IP_EQUALITY_",
  NULL};
static const char *const IPConstrainedUses[] = {"false", "true", "auto", "IPConstrainedUse", "IP_SUBSPACE_", NULL};
static const char *const IPScalings[]        = {"problem", "none", "IPScaling", "IP_SCALING_", NULL};

/* The values that an option may have. A number that is not between the ends is refused, and NaN always. */
typedef enum { IP_NOT_NEGATIVE, IP_POSITIVE, IP_FRACTION, IP_HALF } OptionRange;

static const struct {
  const char *text;
  PetscReal   low, high;
  PetscBool   low_allowed;
} option_ranges[] = {
  [IP_NOT_NEGATIVE] = {"zero or positive", 0.0, PETSC_MAX_REAL, PETSC_TRUE},
  [IP_POSITIVE]     = {"positive", 0.0, PETSC_MAX_REAL, PETSC_FALSE},
  [IP_FRACTION]     = {"between 0 and 1", 0.0, 1.0, PETSC_FALSE},
  [IP_HALF]         = {"between 0 and 0.5", 0.0, 0.5, PETSC_FALSE},
};

/*
   A real-valued option and its default. The name includes -tao_ipfilter_; offset: position of the value in IPOptions
   [bytes].
*/
typedef struct {
  const char *option, *text;
  size_t      offset;
  PetscReal   value;
  OptionRange range;
} RealOption;

#define IP_REAL(name, member, value, range, text) \
  { \
    "-tao_ipfilter_" name, text, offsetof(IPOptions, member), value, range \
  }

static const RealOption real_options[] = {
  IP_REAL("mu_init", mu0, 1.0, IP_POSITIVE, "barrier parameter at a cold start"),
  IP_REAL("slack_init", s0, 1.0, IP_POSITIVE, "slacks at a cold start"),
  IP_REAL("dual_init", z0, 10.0, IP_POSITIVE, "multipliers of the slacks at a cold start"),
  IP_REAL("gamma_phi", gamma_phi, 1e-8, IP_FRACTION,
    "fraction of the violation by which an accepted step must reduce the barrier function"),
  IP_REAL("eta_phi", eta_phi, 1e-8, IP_HALF, "fraction of the predicted decrease that a step must reach (Armijo)"),
  IP_REAL("delta_max", delta_max, 1e20, IP_POSITIVE, "largest shift of an indefinite Hessian"),
  IP_REAL("proximal", proximal, 1e-5, IP_POSITIVE,
    "for condensed equality constraints: size of the proximal term relative to the weights of the constraints"),
  IP_REAL("filter_switch", filter_switch, 10.0, IP_NOT_NEGATIVE,
    "the filter is used if (J^T D J)_ii exceeds this many times H_ii for some i; 0: always"),
  IP_REAL("direct_memory", direct_memory, 2000, IP_NOT_NEGATIVE,
    "memory in MB, over all ranks, that MUMPS may use for the whole matrix if the Krylov method fails; 0: never"),
};

/* Sets all options to their defaults */
PetscErrorCode IPOptionsInitialize(IPOptions *opt)
{
  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(real_options); k++)
    *(PetscReal *)((char *)opt + real_options[k].offset) = real_options[k].value;
  opt->start        = IP_START_WARM;
  opt->barrier      = IP_BARRIER_MEHROTRA;
  opt->max_mu_first = 10;
  opt->max_soc      = 4;
  opt->subspace     = IP_SUBSPACE_AUTO;
  opt->subspace_max = 0;
  PetscFunctionReturn(0);
}

/*
   Sets the options prefix of the Krylov solver to that of the Tao, followed by tao_ipfilter_. TaoSetOptionsPrefix()
   omits tao_ipfilter_.
*/
PetscErrorCode IPOptionsSetPrefix(Tao tao)
{
  PetscFunctionBegin;
  PetscCall(KSPSetOptionsPrefix(tao->ksp, ((PetscObject)tao)->prefix));
  PetscCall(KSPAppendOptionsPrefix(tao->ksp, "tao_ipfilter_"));
  PetscFunctionReturn(0);
}

/* Raises an error if the value of an option is outside its range or NaN */
static PetscErrorCode OptionCheck(Tao tao, const char option[], OptionRange range, PetscReal value)
{
  const PetscBool above = (PetscBool)(value > option_ranges[range].low ||
                                      (option_ranges[range].low_allowed && value == option_ranges[range].low));

  PetscFunctionBegin;
  PetscCheck(above && value < option_ranges[range].high, PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "%s must be %s, not %g", option, option_ranges[range].text, (double)value);
  PetscFunctionReturn(0);
}

/* Reads the real-valued options */
static PetscErrorCode OptionsReadReals(Tao tao, AMGFOptionItems PetscOptionsObject)
{
  IPOptions *opt = ((TAO_IPFILTER *)tao->data)->opt;

  PetscFunctionBegin;
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(real_options); k++) {
    PetscReal *value = (PetscReal *)((char *)opt + real_options[k].offset);

    PetscCall(PetscOptionsReal(real_options[k].option, real_options[k].text, TAOIPFILTER, *value, value, NULL));
    PetscCall(OptionCheck(tao, real_options[k].option, real_options[k].range, *value));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode TaoSetFromOptions_IPFilter(Tao tao, AMGFOptionItems PetscOptionsObject)
{
  const PetscInt fewest = 4; /* least number of directions with which the basis can be compressed */
  IPOptions     *opt    = ((TAO_IPFILTER *)tao->data)->opt;

  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "Interior point with a filter line search");
  PetscCall(OptionsReadReals(tao, PetscOptionsObject));
  PetscCall(PetscOptionsReal("-tao_ipfilter_tol", "KKT error at which the solver has converged; the same as -tao_gatol",
    TAOIPFILTER, tao->gatol, &tao->gatol, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_start", "How slacks and multipliers are chosen at the start", TAOIPFILTER,
    IPStarts, (PetscEnum)opt->start, (PetscEnum *)&opt->start, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_barrier", "How the barrier parameter is updated", TAOIPFILTER,
    IPBarrierRules, (PetscEnum)opt->barrier, (PetscEnum *)&opt->barrier, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_kkt", "Measure of the KKT error", TAOIPFILTER, IPKKTMeasures,
    (PetscEnum)opt->measure, (PetscEnum *)&opt->measure, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_forcing",
    "Tolerance of the linear solver: derived from the KKT error, or the KSP's own", TAOIPFILTER, IPForcings,
    (PetscEnum)opt->forcing, (PetscEnum *)&opt->forcing, NULL));
  PetscCall(
    PetscOptionsEnum("-tao_ipfilter_scaling", "Units of tolerances and constants: scales of the problem, or none",
      TAOIPFILTER, IPScalings, (PetscEnum)opt->scaling, (PetscEnum *)&opt->scaling, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_equality",
    "Equality constraints: in an augmented system factored by MUMPS, or condensed with proximal updates", TAOIPFILTER,
    IPEqualityMethods, (PetscEnum)opt->equality, (PetscEnum *)&opt->equality, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_mu_reductions_first",
    "Largest number of reductions of the barrier parameter at the first iteration", TAOIPFILTER, opt->max_mu_first,
    &opt->max_mu_first, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_max_soc", "Largest number of second-order corrections per step", TAOIPFILTER,
    opt->max_soc, &opt->max_soc, NULL));
  PetscCall(OptionCheck(tao, "-tao_ipfilter_mu_reductions_first", IP_NOT_NEGATIVE, opt->max_mu_first));
  PetscCall(OptionCheck(tao, "-tao_ipfilter_max_soc", IP_NOT_NEGATIVE, opt->max_soc));
  PetscCall(PetscOptionsBool("-tao_ipfilter_direct",
    "Factor the whole matrix by MUMPS and use its inertia, instead of a Krylov method", TAOIPFILTER, opt->direct_always,
    &opt->direct_always, NULL));
  PetscCall(PetscOptionsEnum("-tao_ipfilter_subspace", "Use the subspace method instead of the interior point method",
    TAOIPFILTER, IPConstrainedUses, (PetscEnum)opt->subspace, (PetscEnum *)&opt->subspace, NULL));
  PetscCall(PetscOptionsInt("-tao_ipfilter_subspace_max",
    "Largest number of directions of the subspace method; 0: 80, or 48 with Newton's method", TAOIPFILTER,
    opt->subspace_max, &opt->subspace_max, NULL));
  PetscCheck(!opt->subspace_max || opt->subspace_max >= fewest, PetscObjectComm((PetscObject)tao),
    PETSC_ERR_ARG_OUTOFRANGE, "-tao_ipfilter_subspace_max must be 0 or at least %" PetscInt_FMT ", not %" PetscInt_FMT,
    fewest, opt->subspace_max);
  PetscCall(PetscOptionsBool("-tao_ipfilter_monitor", "Print one line per iteration", TAOIPFILTER, opt->monitor,
    &opt->monitor, NULL));
  PetscOptionsHeadEnd();
  PetscCall(IPOptionsSetPrefix(tao));
  PetscCall(KSPSetFromOptions(tao->ksp));
  PetscFunctionReturn(0);
}
