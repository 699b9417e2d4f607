/* Options of PCAMGF itself; those of the inner solvers are read in inner_solvers.c */
#include "amgfimpl.h"

/* Sets the lag from the value of -pc_amgf_amg_lag: a whole number, or "auto" */
static PetscErrorCode LagFromString(PC pc, const char string[])
{
  PetscBool automatic;
  PetscInt  lag = AMGF_LAG_AUTO;

  PetscFunctionBegin;
  PetscCall(PetscStrcasecmp(string, "auto", &automatic));
  if (!automatic) {
    char      *end;
    const long number = strtol(string, &end, 10);

    PetscCheck(end != string && !*end && number >= AMGF_LAG_NEVER && number <= PETSC_MAX_INT,
      PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_WRONG,
      "-pc_amgf_amg_lag takes a whole number from %d to %" PetscInt_FMT " or auto, not \"%s\"", AMGF_LAG_NEVER,
      PETSC_MAX_INT, string);
    lag = (PetscInt)number;
  }
  PetscCall(PCAMGFSetAMGLag(pc, lag));
  PetscFunctionReturn(0);
}

PetscErrorCode PCSetFromOptions_AMGF(PC pc, AMGFOptionItems PetscOptionsObject)
{
  PC_AMGF        *amgf = (PC_AMGF *)pc->data;
  PCAMGFCycle     cycle;
  PetscReal       detect = amgf->detect;
  char            file[PETSC_MAX_PATH_LEN], lag[32];
  PetscBool       flg;
  PCAMGFFactorUse use;

  PetscFunctionBegin;
  PetscOptionsHeadBegin(PetscOptionsObject, "AMG with filter options");
  PetscCall(PetscOptionsEnum("-pc_amgf_cycle", "Order of AMG (b) and filter (f)", "PCAMGFSetCycle", PCAMGFCycles,
    (PetscEnum)amgf->cycle, (PetscEnum *)&cycle, &flg));
  if (flg) PetscCall(PCAMGFSetCycle(pc, cycle));
  PetscCall(PetscOptionsString("-pc_amgf_filter_file", "Binary file with the IS of filtered unknowns",
    "PCAMGFSetFilterIS", amgf->file ? amgf->file : "", file, sizeof(file), &flg));
  if (flg) {
    PetscCall(PetscFree(amgf->file));
    PetscCall(ISDestroy(&amgf->file_is));
    if (file[0]) PetscCall(PetscStrallocpy(file, &amgf->file));
  }
  PetscCall(PetscOptionsReal("-pc_amgf_detect",
    "Filter the unknowns whose diagonal entry exceeds this multiple of the median; 0: off", "PCAMGF", amgf->detect,
    &detect, NULL));
  PetscCheck(detect >= 0.0, PetscObjectComm((PetscObject)pc), PETSC_ERR_ARG_OUTOFRANGE,
    "-pc_amgf_detect must be positive, or 0 for off, not %g", (double)detect);
  amgf->detect = detect;
  PetscCall(PetscOptionsString("-pc_amgf_amg_lag",
    "Number of operator changes after which the AMG is rebuilt; -1: never; 0 or auto: when the cost grows",
    "PCAMGFSetAMGLag", amgf->cycle == PC_AMGF_BFB ? "1" : "auto", lag, sizeof(lag), &flg));
  if (flg) PetscCall(LagFromString(pc, lag));
  PetscCall(PetscOptionsEnum("-pc_amgf_factor", "Use a factorization instead of the AMG", "PCAMGFSetFactor",
    PCAMGFFactorUses, (PetscEnum)amgf->factor.use, (PetscEnum *)&use, &flg));
  if (flg) PetscCall(PCAMGFSetFactor(pc, use));
  PetscOptionsHeadEnd();
  PetscFunctionReturn(0);
}
