/* Names of the options that are known in advance */
#include "optionsimpl.h"
#include <string.h>
#include <strings.h>

/*
   All options of pc_amgf, tao_ipfilter, src and apps, in order: name, kind, and the words of which the value must be
   one, if it allows a few words only. tests/doc/options.py compares the list with the sources.
*/
static const struct {
  const char *name;
  OptionKind  kind;
  const char *words[5];
} OptionsOurs[] = {
  {"accuracy", OPTION_NUMBER, {NULL}},
  {"accuracy_adaptive", OPTION_SWITCH, {NULL}},
  {"accuracy_max_dofs", OPTION_NUMBER, {NULL}},
  {"accuracy_of", OPTION_WORD, {"energy", "force", "pressure", "displacement", NULL}},
  {"accuracy_order", OPTION_COUNT, {NULL}},
  {"accuracy_share", OPTION_NUMBER, {NULL}},
  {"checkpoint", OPTION_WORD, {NULL}},
  {"checkpoint_every", OPTION_COUNT, {NULL}},
  {"contact_free", OPTION_SWITCH, {NULL}},
  {"contact_gap", OPTION_WORD, {"auto", "mortar", "node", "dual", NULL}},
  {"contact_gap_tol", OPTION_NUMBER, {NULL}},
  {"contact_quadrature", OPTION_COUNT, {NULL}},
  {"contact_search_depth", OPTION_NUMBER, {NULL}},
  {"contact_smooth", OPTION_SWITCH, {NULL}},
  {"contact_update_tol", OPTION_NUMBER, {NULL}},
  {"contact_updates", OPTION_COUNT, {NULL}},
  {"displacement_bounds", OPTION_COUNT, {NULL}},
  {"elasticity_mat_type", OPTION_WORD, {NULL}},
  {"elasticity_quadrature", OPTION_COUNT, {NULL}},
  {"error_estimate", OPTION_SWITCH, {NULL}},
  {"load_max_cuts", OPTION_COUNT, {NULL}},
  {"load_steps", OPTION_COUNT, {NULL}},
  {"load_warm_start", OPTION_SWITCH, {NULL}},
  {"model", OPTION_WORD, {"energy", "quadratic", NULL}},
  {"output", OPTION_WORD, {NULL}},
  {"output_every", OPTION_COUNT, {NULL}},
  {"output_gauss", OPTION_SWITCH, {NULL}},
  {"output_last", OPTION_SWITCH, {NULL}},
  {"pc_amgf_amg_lag", OPTION_WORD, {NULL}},
  {"pc_amgf_cycle", OPTION_WORD, {"bfb", "fbf", "additive", NULL}},
  {"pc_amgf_detect", OPTION_NUMBER, {NULL}},
  {"pc_amgf_factor", OPTION_WORD, {"false", "true", "auto", NULL}},
  {"pc_amgf_filter_file", OPTION_WORD, {NULL}},
  {"progress_every", OPTION_NUMBER, {NULL}},
  {"quiet", OPTION_SWITCH, {NULL}},
  {"refine", OPTION_COUNT, {NULL}},
  {"report", OPTION_WORD, {NULL}},
  {"restart", OPTION_WORD, {NULL}},
  {"scene_check", OPTION_SWITCH, {NULL}},
  {"summary", OPTION_WORD, {NULL}},
  {"tables_view", OPTION_SWITCH, {NULL}},
  {"tao_ipfilter_barrier", OPTION_WORD, {"monotone", "mehrotra", NULL}},
  {"tao_ipfilter_delta_max", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_direct", OPTION_SWITCH, {NULL}},
  {"tao_ipfilter_direct_memory", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_dual_init", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_equality", OPTION_WORD, {"auto", "augmented", "condensed", NULL}},
  {"tao_ipfilter_eta_phi", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_filter_switch", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_forcing", OPTION_WORD, {"adaptive", "fixed", NULL}},
  {"tao_ipfilter_gamma_phi", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_kkt", OPTION_WORD, {"relative", "mass", NULL}},
  {"tao_ipfilter_max_soc", OPTION_COUNT, {NULL}},
  {"tao_ipfilter_monitor", OPTION_SWITCH, {NULL}},
  {"tao_ipfilter_mu_init", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_mu_reductions_first", OPTION_COUNT, {NULL}},
  {"tao_ipfilter_proximal", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_scaling", OPTION_WORD, {"problem", "none", NULL}},
  {"tao_ipfilter_slack_init", OPTION_NUMBER, {NULL}},
  {"tao_ipfilter_start", OPTION_WORD, {"cold", "predict", "warm", NULL}},
  {"tao_ipfilter_subspace", OPTION_WORD, {"false", "true", "auto", NULL}},
  {"tao_ipfilter_subspace_max", OPTION_COUNT, {NULL}},
  {"tao_ipfilter_tol", OPTION_NUMBER, {NULL}},
  {"traceback", OPTION_SWITCH, {NULL}},
};

/* Options prefixes of PETSc objects that are created later */
static const char *const OptionsPrefixes[] = {"tao_ipfilter_augmented_", "tao_ipfilter_direct_", "tao_ipfilter_",
  "amgf_amg_", "amgf_factor_", "amgf_filter_", "elasticity_", NULL};

/* Beginnings of PETSc's own options, which are too many to list. A misspelt one is found by -options_left. */
static const char *const OptionsKinds[] = {"adapt", "ao_", "blas_", "characteristic_", "check_pointer",
  "checkfunctionlist", "citations", "coarse_", "cuda", "debug", "default_device", "device_", "display", "dll_", "dm_",
  "draw_", "error_output", "esteig_", "fieldsplit_", "fp_trap", "get_total_flops", "help", "hip", "history", "info",
  "inner_", "is_", "ksp_", "log_", "malloc", "mat", "memory_", "mg_", "mpi", "no_signal_handler", "not_shared_tmp",
  "nox", "objects_", "omp_", "on_error_", "options_", "pc_", "petsc", "prefix_", "python", "random_", "redundant_",
  "root_device", "saws", "sf_", "shared_tmp", "skip_petscrc", "snes_", "start_in_debugger", "stop_for_debugger", "sub_",
  "sycl", "tao_", "thread", "tmp", "ts_", "use_gpu", "vec", "version", "viewer", "x_", "xml", NULL};

/* Options of PETSc that are suggested for misspelt names */
const char *const OptionsUsual[] = {"help", "info", "ksp_max_it", "ksp_monitor", "ksp_rtol", "ksp_type", "ksp_view",
  "log_view", "malloc_debug", "mat_type", "options_file", "options_left", "options_view", "pc_type", "snes_rtol",
  "tao_gatol", "tao_max_it", "tao_monitor", "tao_type", "tao_view", "version", NULL};

static PetscBool OptionIsOneOf(const char name[], const char *const list[])
{
  for (; *list; ++list) {
    if (!strcasecmp(name, *list)) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Returns the length of the first entry of the list with which the name begins; 0: it begins with none */
static size_t OptionBeginning(const char name[], const char *const list[])
{
  for (; *list; ++list) {
    if (!strncasecmp(name, *list, strlen(*list))) return strlen(*list);
  }
  return 0;
}

static size_t OptionAllPrefixes(const char name[])
{
  size_t n, all = 0;

  while ((n = OptionBeginning(name + all, OptionsPrefixes))) all += n;
  return all;
}

/* Returns the place of a name in OptionsOurs; -1: it is not there */
static PetscInt OptionFind(const char name[])
{
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(OptionsOurs); ++k) {
    if (!strcasecmp(name, OptionsOurs[k].name)) return (PetscInt)k;
  }
  return -1;
}

const char *OptionGetOurs(PetscInt k)
{
  return k < (PetscInt)PETSC_STATIC_ARRAY_LENGTH(OptionsOurs) ? OptionsOurs[k].name : NULL;
}

static const char *const OptionsAMGF[] = {"pc_amgf_", NULL};

size_t OptionPrefixLength(const char name[])
{
  const size_t all = OptionAllPrefixes(name);

  return OptionBeginning(name + all, OptionsAMGF) ? all : 0;
}

/*
   Returns whether a name is known, also with no_ before it. After the prefix of an object the options of PETSc and
   those of PCAMGF are allowed.
*/
PetscBool OptionIsKnown(const char name[])
{
  const char *suffix = name + OptionAllPrefixes(name);

  if (OptionFind(name) >= 0) return PETSC_TRUE;
  if (!strncasecmp(name, "no_", 3) && OptionIsKnown(name + 3)) return PETSC_TRUE;
  if (OptionBeginning(suffix, OptionsAMGF)) return (PetscBool)(OptionFind(suffix) >= 0);
  if (!strcasecmp(suffix, "h") || !strcasecmp(suffix, "v")) return PETSC_TRUE;
  return OptionBeginning(suffix, OptionsKinds) ? PETSC_TRUE : PETSC_FALSE;
}

PetscBool OptionGetKind(const char name[], OptionKind *kind)
{
  static const char *const counts[]  = {"ksp_max_it", "tao_max_it", NULL};
  static const char *const numbers[] = {"ksp_rtol", "tao_gatol", NULL};
  const char              *petscs    = name + OptionAllPrefixes(name);
  const PetscInt           ours      = OptionFind(name + OptionPrefixLength(name));

  if (OptionIsOneOf(petscs, counts) || OptionIsOneOf(petscs, numbers)) {
    *kind = OptionIsOneOf(petscs, counts) ? OPTION_COUNT : OPTION_NUMBER;
    return PETSC_TRUE;
  }
  if (ours >= 0) *kind = OptionsOurs[ours].kind;
  return (PetscBool)(ours >= 0);
}

/* Gets the words of which the option's value must be one. Returns false if the option allows any value. */
PetscBool OptionGetChoices(const char name[], const char *const **words)
{
  const PetscInt ours = OptionFind(name + OptionPrefixLength(name));

  if (ours < 0 || !OptionsOurs[ours].words[0]) return PETSC_FALSE;
  *words = OptionsOurs[ours].words;
  return PETSC_TRUE;
}
