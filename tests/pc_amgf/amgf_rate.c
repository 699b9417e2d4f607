static char help[] =
  "PCAMGF estimates the time of a factorization from the processor time that the calling thread needs "
  "for a matrix product, whatever other threads of the process do.\n\n";

#define _GNU_SOURCE /* declares RTLD_NEXT */
#include "amgf_problem.h"
#include <dlfcn.h>
#include <petscblaslapack.h>
#include <pthread.h>
#include <time.h>

enum { TIMED = 192, NTHREADS = 4 };

static volatile PetscBool busy = PETSC_FALSE;

/* Uses 2 ms of processor time: 7e9 operations per second for the timed product, a rate of an optimized BLAS */
static void UseProcessor(void)
{
  struct timespec now, end;

  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  end.tv_nsec += 2000000;
  do {
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  } while (1000000000LL * (now.tv_sec - end.tv_sec) + now.tv_nsec - end.tv_nsec < 0);
}

/* Replaces the matrix product of BLAS: the product that PCAMGF times takes 2 ms on any machine */
void BLASgemm_(const char *transposeA, const char *transposeB, const PetscBLASInt *m, const PetscBLASInt *n,
  const PetscBLASInt *k, const PetscScalar *alpha, const PetscScalar *A, const PetscBLASInt *lda, const PetscScalar *B,
  const PetscBLASInt *ldb, const PetscScalar *beta, PetscScalar *C, const PetscBLASInt *ldc)
{
  typedef void (*Product)(const char *, const char *, const PetscBLASInt *, const PetscBLASInt *, const PetscBLASInt *,
    const PetscScalar *, const PetscScalar *, const PetscBLASInt *, const PetscScalar *, const PetscBLASInt *,
    const PetscScalar *, PetscScalar *, const PetscBLASInt *);
  static Product product = NULL;

  if (*m == TIMED && *n == TIMED && *k == TIMED) {
    UseProcessor();
    return;
  }
  if (!product) product = (Product)dlsym(RTLD_NEXT, PetscStringize(BLASgemm_));
  product(transposeA, transposeB, m, n, k, alpha, A, lda, B, ldb, beta, C, ldc);
}

static void *Work(void *arg)
{
  while (busy) UseProcessor();
  return arg;
}

/* why: the choice for a new solver, and the estimates that led to it */
static PetscErrorCode Choose(Mat A, size_t size, char why[])
{
  const char *reason;
  Vec         b, x;
  KSP         ksp;
  PC          pc;
  PetscBool   factored;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(A, &x, &b));
  PetscCall(FillVector(b, 0.8));
  PetscCall(ProblemCreateSolver(A, A, &ksp, &pc));
  PetscCall(PCAMGFSetFilterOptional(pc, PETSC_TRUE));
  PetscCall(PCAMGFSetFactor(pc, PC_AMGF_FACTOR_AUTO));
  PetscCall(PCAMGFExpect(pc, 1e6, 1.0));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(PCAMGFGetFactored(pc, &factored, &reason));
  PetscCall(PetscStrncpy(why, reason, size));
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&b));
  PetscCall(VecDestroy(&x));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  pthread_t threads[NTHREADS];
  Problem   problem;
  Mat       A;
  char      alone[256], beside[256];
  PetscBool same;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(ProblemSetDefaults(&problem));
  problem.n = 12;
  PetscCall(ProblemCreate(PETSC_COMM_WORLD, &problem, MATAIJ, PETSC_TRUE, &A));
  PetscCall(Choose(A, sizeof(alone), alone));
  busy = PETSC_TRUE;
  for (PetscInt k = 0; k < NTHREADS; k++) (void)pthread_create(&threads[k], NULL, Work, NULL);
  PetscCall(Choose(A, sizeof(beside), beside));
  busy = PETSC_FALSE;
  for (PetscInt k = 0; k < NTHREADS; k++) (void)pthread_join(threads[k], NULL);
  PetscCall(PetscStrcmp(alone, beside, &same));
  if (same) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "the estimates do not depend on other threads\n"));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "alone: %s\nbeside other threads: %s\n", alone, beside));
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1

TEST*/
