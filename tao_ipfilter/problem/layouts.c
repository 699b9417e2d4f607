/* Checks the layouts of the vectors that the caller has given */
#include "problemimpl.h"
#include "tao_ipfilter/solver/options.h"

/*
   Raises an error on all ranks, with the numbers of the first rank concerned, unless v has as many local entries as
   `model`. name, of: names of v and `model` in the message. Does nothing if one of them is NULL.
*/
static PetscErrorCode CheckLayout(Tao tao, Vec v, const char name[], Vec model, const char of[])
{
  MPI_Comm    comm = PetscObjectComm((PetscObject)tao);
  PetscInt    local[2];
  PetscMPIInt rank, size, first;

  PetscFunctionBegin;
  if (!v || !model) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(VecGetLocalSize(v, &local[0]));
  PetscCall(VecGetLocalSize(model, &local[1]));
  first = local[0] == local[1] ? size : rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm));
  if (first == size) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Bcast(local, 2, MPIU_INT, first, comm));
  SETERRQ(comm, PETSC_ERR_ARG_SIZ, "%s: %" PetscInt_FMT " entries on rank %d, where there are %" PetscInt_FMT " %s",
    name, local[0], first, local[1], of);
}

/* Raises an error if a tolerance is NaN or infinite: the comparison with it would not mean anything */
static PetscErrorCode CheckTolerance(Tao tao, PetscReal tolerance, const char name[])
{
  PetscFunctionBegin;
  PetscCheck(!PetscIsInfOrNanReal(tolerance), PetscObjectComm((PetscObject)tao), PETSC_ERR_ARG_OUTOFRANGE,
    "The tolerance %s must be a finite number, not %g", name, (double)tolerance);
  PetscFunctionReturn(0);
}

/* Checks what the caller has set by functions of TAO that TAOIPFILTER does not see called */
static PetscErrorCode CheckProblem(Tao tao)
{
  PetscFunctionBegin;
  PetscCheck(!tao->ops->computeconstraints, PetscObjectComm((PetscObject)tao), PETSC_ERR_SUP,
    "TAOIPFILTER does not use the constraints of TaoSetConstraintsRoutine(): call TaoSetEqualityConstraintsRoutine() "
    "or TaoSetInequalityConstraintsRoutine()");
  PetscCall(CheckTolerance(tao, tao->gatol, "gatol"));
  PetscCall(CheckTolerance(tao, tao->catol, "catol"));
  PetscCall(CheckTolerance(tao, tao->crtol, "crtol"));
  PetscFunctionReturn(0);
}

/* Checks what the caller has set, and the layouts of masses, bounds and starting values. Vectors for constraints that
   do not exist are not used. */
PetscErrorCode IPGivenCheck(Tao tao)
{
  const IPGiven *given = ((TAO_IPFILTER *)tao->data)->given;
  Vec            x = tao->solution, c = tao->ineq_constrained ? tao->constraints_inequality : NULL;
  const char     unknowns[] = "unknowns", rows[] = "inequality constraints";

  PetscFunctionBegin;
  PetscCall(CheckProblem(tao));
  PetscCall(CheckLayout(tao, given->primal_mass, "Primal mass", x, unknowns));
  PetscCall(CheckLayout(tao, given->slack_mass, "Slack mass", c, rows));
  PetscCall(CheckLayout(tao, given->compliance, "Compliance", c, rows));
  PetscCall(CheckLayout(tao, tao->XL, "Lower bounds of the variables", x, unknowns));
  PetscCall(CheckLayout(tao, tao->XU, "Upper bounds of the variables", x, unknowns));
  PetscCall(CheckLayout(tao, tao->IL, "Lower bounds of the inequality constraints", c, rows));
  PetscCall(CheckLayout(tao, tao->IU, "Upper bounds of the inequality constraints", c, rows));
  PetscCall(CheckLayout(tao, given->warm_s, "Slacks of the warm start", c, rows));
  PetscCall(CheckLayout(tao, given->warm_z, "Multipliers of the warm start", c, rows));
  PetscFunctionReturn(0);
}
