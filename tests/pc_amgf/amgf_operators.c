static char help[] =
  "PCAMGF on operators of every kind: it solves, or one sentence says what is missing, on every rank.\n\n";

#include <petsccompat.h>
#include "amgf_problem.h"
#include "../lib/attempt.h"

static PetscErrorCode OperatorMult(Mat S, Vec x, Vec y)
{
  Mat A;

  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(S, &A));
  PetscCall(MatMult(A, x, y));
  PetscFunctionReturn(0);
}

/* A as a matrix of another type; of a shell nothing but the product is known */
static PetscErrorCode OperatorCreate(Mat A, MatType type, Mat *B)
{
  PetscBool shell, nest;
  PetscInt  m;

  PetscFunctionBeginUser;
  PetscCall(PetscStrcmp(type, MATSHELL, &shell));
  PetscCall(PetscStrcmp(type, MATNEST, &nest));
  if (shell) {
    PetscCall(MatGetLocalSize(A, &m, NULL));
    PetscCall(MatCreateShell(PetscObjectComm((PetscObject)A), m, m, PETSC_DETERMINE, PETSC_DETERMINE, A, B));
    PetscCall(MatShellSetOperation(*B, MATOP_MULT, (AMGFOperation *)OperatorMult));
  } else if (nest) PetscCall(MatCreateNest(PetscObjectComm((PetscObject)A), 1, NULL, 1, NULL, &A, B));
  else PetscCall(MatConvert(A, type, MAT_INITIAL_MATRIX, B));
  PetscFunctionReturn(0);
}

static PetscErrorCode OperatorSolve(Mat B, Mat P, IS filter, PetscBool *solved)
{
  KSP                ksp;
  PC                 pc;
  Vec                b, x;
  KSPConvergedReason reason;

  PetscFunctionBeginUser;
  PetscCall(MatCreateVecs(P, &x, &b));
  PetscCall(VecSet(b, 1.0));
  PetscCall(ProblemCreateSolver(B, P, &ksp, &pc));
  if (filter) PetscCall(PCAMGFSetFilterIS(pc, filter));
  PetscCall(KSPSetFromOptions(ksp));
  PetscCall(KSPSolve(ksp, b, x));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  *solved = (PetscBool)(reason > 0);
  PetscCall(KSPDestroy(&ksp));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&b));
  PetscFunctionReturn(0);
}

static PetscErrorCode TestOperator(const char name[], Mat B, Mat P, IS filter)
{
  PetscBool      solved = PETSC_FALSE;
  PetscErrorCode ierr;

  PetscFunctionBeginUser;
  PetscCall(AttemptBegin());
  ierr = OperatorSolve(B, P, filter, &solved);
  PetscCall(AttemptEnd());
  PetscCall(AttemptCompareRanks(name, ierr));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s, %s: ", name, filter ? "filtered" : "AMG alone"));
  if (ierr) PetscCall(AttemptPrint(ierr));
  else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", solved ? "solved" : "NOT SOLVED"));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const MatType types[] = {MATAIJ, MATBAIJ, MATSBAIJ, MATDENSE, MATIS, MATNEST, MATSHELL};
  Problem       problem;
  Mat           A, S;
  IS            filter;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(ProblemSetDefaults(&problem));
  PetscCall(ProblemCreate(PETSC_COMM_WORLD, &problem, MATAIJ, PETSC_TRUE, &A));
  PetscCall(MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(ProblemCreateFilterIS(&problem, A, PETSC_COMM_WORLD, &filter));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(types); ++i) {
    Mat B;

    PetscCall(OperatorCreate(A, types[i], &B));
    PetscCall(TestOperator(types[i], B, B, NULL));
    PetscCall(TestOperator(types[i], B, B, filter));
    PetscCall(MatDestroy(&B));
  }
  PetscCall(OperatorCreate(A, MATSHELL, &S));
  PetscCall(TestOperator("shell, and its entries beside it", S, A, filter));
  PetscCall(MatDestroy(&S));
  PetscCall(ISDestroy(&filter));
  PetscCall(MatDestroy(&A));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}
      args: -ksp_max_it 500 -malloc_dump 0
      filter: grep -v "^Warning: PCAMGF runs without a filter"
      output_file: output/amgf_operators_1.out

TEST*/
