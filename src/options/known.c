/* Names of the options that are known in advance */
#include "optionsimpl.h"
#include <string.h>
#include <strings.h>

/* All options of pc_amgf, tao_ipfilter, src and apps. tests/doc/options.py compares the list with the sources. */
const char *const OptionsOurs[] = {"accuracy", "accuracy_adaptive", "accuracy_max_dofs", "accuracy_of",
  "accuracy_order", "accuracy_share", "checkpoint", "checkpoint_every", "contact_free", "contact_gap",
  "contact_gap_tol", "contact_normals", "contact_penalty", "contact_quadrature", "contact_search_depth",
  "contact_smooth", "contact_update_tol", "contact_updates", "displacement_bounds", "elasticity_mat_type",
  "elasticity_quadrature", "error_estimate", "load_max_cuts", "load_steps", "load_warm_start", "model", "output",
  "output_every", "output_gauss", "pc_amgf_amg_lag", "pc_amgf_cycle", "pc_amgf_detect", "pc_amgf_factor",
  "pc_amgf_factor_share", "pc_amgf_filter_file", "pc_amgf_filter_ranks", "progress_every", "quiet", "refine", "report",
  "restart", "scene_check", "summary", "tables_view", "tao_ipfilter_barrier", "tao_ipfilter_compl_inf_tol",
  "tao_ipfilter_constr_viol_tol", "tao_ipfilter_delta_max", "tao_ipfilter_direct", "tao_ipfilter_direct_memory",
  "tao_ipfilter_dual_inf_tol", "tao_ipfilter_dual_init", "tao_ipfilter_equality", "tao_ipfilter_eta_phi",
  "tao_ipfilter_filter_switch", "tao_ipfilter_forcing", "tao_ipfilter_gamma_phi", "tao_ipfilter_kkt",
  "tao_ipfilter_max_soc", "tao_ipfilter_monitor", "tao_ipfilter_mu_init", "tao_ipfilter_mu_reductions_first",
  "tao_ipfilter_proximal", "tao_ipfilter_scaling", "tao_ipfilter_slack_init", "tao_ipfilter_start",
  "tao_ipfilter_subspace", "tao_ipfilter_subspace_max", "tao_ipfilter_tol", "traceback", NULL};

/*
   Those of our options that are Boolean, and true without a value. Options in none of this and the next two lists need
   a number.
*/
static const char *const OptionsSwitches[] = {"accuracy_adaptive", "contact_free", "contact_smooth", "error_estimate",
  "load_warm_start", "output_gauss", "quiet", "scene_check", "tables_view", "tao_ipfilter_direct",
  "tao_ipfilter_monitor", "traceback", NULL};

/* Options that need an integer */
static const char *const OptionsCounts[] = {"accuracy_order", "checkpoint_every", "contact_quadrature",
  "contact_updates", "displacement_bounds", "elasticity_quadrature", "load_max_cuts", "load_steps", "output_every",
  "pc_amgf_filter_ranks", "refine", "tao_ipfilter_max_soc", "tao_ipfilter_mu_reductions_first",
  "tao_ipfilter_subspace_max", NULL};

/* Options that need a word or a name */
static const char *const OptionsWords[] = {"accuracy_of", "checkpoint", "contact_gap", "contact_normals",
  "elasticity_mat_type", "model", "output", "pc_amgf_amg_lag", "pc_amgf_cycle", "pc_amgf_factor", "pc_amgf_filter_file",
  "report", "restart", "summary", "tao_ipfilter_barrier", "tao_ipfilter_equality", "tao_ipfilter_forcing",
  "tao_ipfilter_kkt", "tao_ipfilter_scaling", "tao_ipfilter_start", "tao_ipfilter_subspace", NULL};

/* Options whose value is one of a few words. tests/doc/options.py compares the list with the sources. */
static const struct {
  const char *name, *words[5];
} OptionsChoices[] = {
  {"accuracy_of", {"energy", "force", "pressure", "displacement", NULL}},
  {"contact_gap", {"auto", "mortar", "node", "dual", NULL}},
  {"contact_normals", {"nodal", "facet", NULL}},
  {"model", {"energy", "quadratic", NULL}},
  {"pc_amgf_cycle", {"bfb", "fbf", "additive", NULL}},
  {"pc_amgf_factor", {"false", "true", "auto", NULL}},
  {"tao_ipfilter_barrier", {"monotone", "mehrotra", NULL}},
  {"tao_ipfilter_equality", {"auto", "augmented", "condensed", NULL}},
  {"tao_ipfilter_forcing", {"adaptive", "fixed", NULL}},
  {"tao_ipfilter_kkt", {"relative", "mass", NULL}},
  {"tao_ipfilter_scaling", {"problem", "gradient", "none", NULL}},
  {"tao_ipfilter_start", {"cold", "predict", "warm", NULL}},
  {"tao_ipfilter_subspace", {"false", "true", "auto", NULL}},
};

/* Options prefixes of PETSc objects that are created later */
static const char *const OptionsPrefixes[] = {"tao_ipfilter_augmented_", "tao_ipfilter_direct_", "tao_ipfilter_",
  "amgf_amg_", "amgf_factor_", "amgf_filter_", "elasticity_", "penalty_", NULL};

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

  if (OptionIsOneOf(name, OptionsOurs)) return PETSC_TRUE;
  if (!strncasecmp(name, "no_", 3) && OptionIsKnown(name + 3)) return PETSC_TRUE;
  if (OptionBeginning(suffix, OptionsAMGF)) return OptionIsOneOf(suffix, OptionsOurs);
  if (!strcasecmp(suffix, "h") || !strcasecmp(suffix, "v")) return PETSC_TRUE;
  return OptionBeginning(suffix, OptionsKinds) ? PETSC_TRUE : PETSC_FALSE;
}

PetscBool OptionGetKind(const char name[], OptionKind *kind)
{
  static const char *const counts[]  = {"ksp_max_it", "tao_max_it", NULL};
  static const char *const numbers[] = {"ksp_rtol", "tao_gatol", NULL};
  const char              *ours = name + OptionPrefixLength(name), *petscs = name + OptionAllPrefixes(name);

  if (OptionIsOneOf(petscs, counts) || OptionIsOneOf(petscs, numbers)) {
    *kind = OptionIsOneOf(petscs, counts) ? OPTION_COUNT : OPTION_NUMBER;
    return PETSC_TRUE;
  }
  if (OptionIsOneOf(ours, OptionsSwitches)) *kind = OPTION_SWITCH;
  else if (OptionIsOneOf(ours, OptionsCounts)) *kind = OPTION_COUNT;
  else if (OptionIsOneOf(ours, OptionsWords)) *kind = OPTION_WORD;
  else *kind = OPTION_NUMBER;
  return OptionIsOneOf(ours, OptionsOurs);
}

/* Gets the words of which the option's value must be one. Returns false if the option allows any value. */
PetscBool OptionGetChoices(const char name[], const char *const **words)
{
  const char *ours = name + OptionPrefixLength(name);

  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(OptionsChoices); ++k) {
    if (strcasecmp(ours, OptionsChoices[k].name)) continue;
    *words = OptionsChoices[k].words;
    return PETSC_TRUE;
  }
  return PETSC_FALSE;
}
