/* Implements the interface IPLawsOps of the subspace method for friction */
#include "frictionimpl.h"

struct _p_IPLaws {
  IPTermSet set;
};

static PetscErrorCode LawsDestroy(IPLaws *laws)
{
  PetscFunctionBegin;
  if (*laws) PetscCall(IPTermLawsDestroy(&(*laws)->set));
  PetscCall(PetscFree(*laws));
  PetscFunctionReturn(0);
}

static PetscErrorCode LawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat factors, Mat R, IPLaws *laws,
  PetscBool *definite)
{
  PetscFunctionBegin;
  PetscCall(PetscNew(laws));
  PetscCall(IPTermLawsCreate(m, n, kmax, K, factors, R, &(*laws)->set, definite));
  PetscFunctionReturn(0);
}

static PetscErrorCode LawsGetData(IPLaws laws, IPLawsData *data)
{
  PetscFunctionBegin;
  data->limit       = laws->set.limit;
  data->coefficient = laws->set.coefficient;
  data->rigid       = laws->set.rigid;
  data->closed      = laws->set.closed;
  data->shift       = laws->set.shift;
  data->nreleased   = laws->set.nreleased;
  PetscFunctionReturn(0);
}

static PetscErrorCode LawsRestart(IPLaws laws)
{
  PetscFunctionBegin;
  laws->set.listed = PETSC_FALSE;
  PetscFunctionReturn(0);
}

static PetscErrorCode LawsForget(IPLaws laws)
{
  PetscFunctionBegin;
  laws->set.system.k = 0;
  PetscFunctionReturn(0);
}

static PetscErrorCode LawsSolve(IPLaws laws, const IPReducedSystem *s, PetscBool simply, PetscInt *steps,
  PetscInt *nactive, PetscBool *met, PetscBool *solved)
{
  PetscFunctionBegin;
  PetscCall(IPTermSetSolve(&laws->set, s, simply, steps, solved));
  *nactive = laws->set.na;
  *met     = laws->set.met;
  PetscFunctionReturn(0);
}

const IPLawsOps IPLawsFriction = {
  .create  = LawsCreate,
  .getdata = LawsGetData,
  .restart = LawsRestart,
  .forget  = LawsForget,
  .solve   = LawsSolve,
  .destroy = LawsDestroy,
};
