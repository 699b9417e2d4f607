static char help[] =
  "The first rank solves the reduced problem of the subspace alone. Wherever its memory runs out there, all\n\
ranks return the error, and none waits for another one.\n\n";

#include "ipfilter_problem.h"
#include "../lib/attempt.h"

#define MOST 100

/* A line of the optimizer's sources that allocates memory */
typedef struct {
  char file[64], function[64];
  int  line;
} Place;

static PetscErrorCode (*allocate)(size_t, PetscBool, int, const char[], const char[], void **);
static Place places[MOST];
static int   nplaces;
static Place failing; /* the allocation here fails; line 0: none does */

static PetscBool IsPlace(const Place *p, int line, const char file[])
{
  return (PetscBool)(p->line == line && !strcmp(p->file, file));
}

/* PETSc's allocation: notes its place, and fails where it shall */
static PetscErrorCode Allocate(size_t n, PetscBool clear, int line, const char function[], const char file[], void **to)
{
  if (IsPlace(&failing, line, file)) return PETSC_ERR_MEM;
  if (strstr(file, "tao_ipfilter/") && !failing.line && nplaces < MOST) {
    Place *p     = &places[nplaces];
    int    known = 0;

    for (int k = 0; k < nplaces; ++k) known = known || IsPlace(&places[k], line, file);
    if (!known) {
      (void)PetscStrncpy(p->file, file, sizeof(p->file));
      (void)PetscStrncpy(p->function, function, sizeof(p->function));
      p->line = line;
      ++nplaces;
    }
  }
  return allocate(n, clear, line, function, file, to);
}

/* A chain of points with three coordinates, of which every third one is pressed onto a plane and pulled along it */
typedef struct {
  QuadraticProgram q;
  Mat              T;
  Vec              x, t, limit, coefficient;
} Chain;

static PetscErrorCode Assemble(Mat A)
{
  PetscFunctionBeginUser;
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateChain(PetscInt npoints, Chain *chain)
{
  const PetscInt n = 3 * npoints, m = npoints / 3;
  PetscInt       start, end, nlocal;

  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, n, n, 3, NULL, 3, NULL, &chain->q.H));
  PetscCall(MatGetOwnershipRange(chain->q.H, &start, &end));
  PetscCall(MatCreateVecs(chain->q.H, &chain->x, &chain->q.b));
  PetscCall(VecGetLocalSize(chain->x, &nlocal));
  for (PetscInt r = start; r < end; ++r) {
    const PetscInt near[2] = {r >= 3 ? r - 3 : -1, r + 3 < n ? r + 3 : -1};

    PetscCall(MatSetValue(chain->q.H, r, r, 4.0, INSERT_VALUES));
    for (int k = 0; k < 2; ++k) PetscCall(MatSetValue(chain->q.H, r, near[k], -0.9 - 0.01 * (r % 3), INSERT_VALUES));
    PetscCall(VecSetValue(chain->q.b, r, r % 3 ? 0.2 + 0.01 * r : -1.0, INSERT_VALUES));
  }
  PetscCall(Assemble(chain->q.H));
  PetscCall(VecAssemblyBegin(chain->q.b));
  PetscCall(VecAssemblyEnd(chain->q.b));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, nlocal, m, n, 1, NULL, 1, NULL, &chain->q.J));
  PetscCall(MatGetOwnershipRange(chain->q.J, &start, &end));
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, 2 * (end - start), nlocal, 2 * m, n, 1, NULL, 1, NULL, &chain->T));
  for (PetscInt r = start; r < end; ++r) {
    PetscCall(MatSetValue(chain->q.J, r, 9 * r, 1.0, INSERT_VALUES));
    for (PetscInt a = 0; a < 2; ++a) PetscCall(MatSetValue(chain->T, 2 * r + a, 9 * r + 1 + a, 1.0, INSERT_VALUES));
  }
  PetscCall(Assemble(chain->q.J));
  PetscCall(Assemble(chain->T));
  PetscCall(MatCreateVecs(chain->q.J, NULL, &chain->q.g));
  PetscCall(VecSet(chain->q.g, 0.0));
  PetscCall(MatCreateVecs(chain->T, NULL, &chain->t));
  PetscCall(VecSet(chain->t, 0.0));
  PetscCall(VecDuplicate(chain->q.g, &chain->limit));
  PetscCall(VecSet(chain->limit, PETSC_INFINITY));
  PetscCall(VecDuplicate(chain->q.g, &chain->coefficient));
  PetscCall(VecSet(chain->coefficient, PETSC_INFINITY));
  PetscFunctionReturn(0);
}

static PetscErrorCode DestroyChain(Chain *chain)
{
  PetscFunctionBeginUser;
  PetscCall(ProblemDestroy(&chain->q));
  PetscCall(MatDestroy(&chain->T));
  PetscCall(VecDestroy(&chain->x));
  PetscCall(VecDestroy(&chain->t));
  PetscCall(VecDestroy(&chain->limit));
  PetscCall(VecDestroy(&chain->coefficient));
  PetscFunctionReturn(0);
}

/* Solves twice with the same solver, so that parts of the first reduced problem are used again */
static PetscErrorCode Solve(Chain *chain, PetscBool friction)
{
  TaoConvergedReason reason;
  Tao                tao;

  PetscFunctionBeginUser;
  PetscCall(ProblemCreateSolver(&chain->q, chain->x, &tao));
  if (friction) PetscCall(TaoIPFilterSetNormTerms(tao, chain->T, chain->t, chain->limit, chain->coefficient));
  PetscCall(TaoSetFromOptions(tao));
  for (int k = 0; k < 2; ++k) {
    PetscCall(VecSet(chain->x, 0.0));
    PetscCall(TaoSolve(tao));
  }
  PetscCall(TaoGetConvergedReason(tao, &reason));
  PetscCheck(reason > 0, PETSC_COMM_WORLD, PETSC_ERR_NOT_CONVERGED, "%s", TaoConvergedReasons[reason]);
  PetscCall(TaoDestroy(&tao));
  PetscFunctionReturn(0);
}

/* Keeps the places where only the first rank allocates, in the order of the first rank, on all ranks */
static PetscErrorCode KeepFirst(void)
{
  Place       theirs[MOST];
  int         ntheirs = nplaces, kept = 0;
  PetscMPIInt last, rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &last));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  --last;
  PetscCall(PetscArraycpy(theirs, places, MOST));
  PetscCallMPI(MPI_Bcast(&ntheirs, 1, MPI_INT, last, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Bcast(theirs, (PetscMPIInt)sizeof(theirs), MPI_BYTE, last, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Bcast(&nplaces, 1, MPI_INT, 0, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Bcast(places, (PetscMPIInt)sizeof(places), MPI_BYTE, 0, PETSC_COMM_WORLD));
  for (int k = 0; k < nplaces; ++k) {
    PetscBool shared = PETSC_FALSE;

    for (int i = 0; i < ntheirs; ++i)
      shared = (PetscBool)(shared || IsPlace(&theirs[i], places[k].line, places[k].file));
    if (!shared) places[kept++] = places[k];
  }
  nplaces = kept;
  PetscFunctionReturn(0);
}

static PetscErrorCode FailEverywhere(PetscBool friction)
{
  PetscMPIInt rank;
  int         nwrong = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  for (int k = 0; k < nplaces; ++k) {
    Chain       chain;
    PetscMPIInt least, failed;

    PetscCall(CreateChain(30, &chain));
    failing = places[k];
    if (rank) failing.file[0] = '\0';
    PetscCall(PetscInfo(NULL, "Memory runs out in %s(), line %d\n", places[k].function, places[k].line));
    PetscCall(AttemptBegin());
    failed = Solve(&chain, friction) ? 1 : 0;
    PetscCall(AttemptEnd());
    failing.line = 0;
    PetscCallMPI(MPI_Allreduce(&failed, &least, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD));
    if (!least) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "no error on some rank: %s()\n", places[k].function));
    nwrong += !least;
    PetscCall(DestroyChain(&chain));
  }
  PetscCall(
    PetscPrintf(PETSC_COMM_WORLD, "%s contacts that stick: %s places on the first rank, an error on all ranks: %s\n",
      friction ? "with" : "without", nplaces > 3 ? "several" : "FEW", nwrong ? "NO" : "yes"));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  allocate = PetscTrMalloc;
  for (int friction = 0; friction < 2; ++friction) {
    Chain chain;

    PetscCall(CreateChain(30, &chain));
    nplaces       = 0;
    PetscTrMalloc = Allocate;
    PetscCall(Solve(&chain, (PetscBool)friction));
    PetscCall(DestroyChain(&chain));
    PetscCall(KeepFirst());
    PetscCall(FailEverywhere((PetscBool)friction));
    PetscTrMalloc = allocate;
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: 2
      args: -tao_ipfilter_subspace true -malloc_dump 0

TEST*/
