static char help[] =
  "Hessians and Jacobians of every type: the solution is that with AIJ, or one sentence says what is refused.\n\n";

#include "ipfilter_matrices.h"

/* One combination of types against AIJ; no J, no E: without these constraints */
static PetscErrorCode Test(PetscInt n, const char Htype[], const char Jtype[], const char Etype[], const char options[])
{
  Program            p;
  Mat                H, J = NULL, E = NULL;
  Vec                x, exact;
  PetscErrorCode     error = 0;
  TaoConvergedReason reason;
  PetscReal          difference;
  PetscBool          sbaij;

  PetscFunctionBeginUser;
  PetscCall(CreateProgram(n, &p));
  PetscCall(PetscStrcmp(Htype, MATSBAIJ, &sbaij));
  p.fixed = sbaij ? PETSC_FALSE : PETSC_TRUE; /* PETSc does not zero columns of SBAIJ on several ranks */
  PetscCall(VecDuplicate(p.q.b, &x));
  PetscCall(VecDuplicate(p.q.b, &exact));
  PetscCall(CreateAs(p.q.H, Htype, &H));
  if (Jtype) PetscCall(CreateAs(p.q.J, Jtype, &J));
  if (Etype) PetscCall(CreateAs(p.E, Etype, &E));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "H %s, J %s, E %s%s%s: ", Htype, Jtype ? Jtype : "none",
    Etype ? Etype : "none", options[0] ? ", " : "", options));
  PetscCall(Solve(&p, H, J, E, options, x, &error, &reason));
  PetscCall(AttemptCompareRanks(Htype, error));
  if (error) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s\n", attempt_sentence));
  else {
    PetscCall(Solve(&p, p.q.H, J ? p.q.J : NULL, E ? p.E : NULL, "-tao_ipfilter_direct", exact, &error, &reason));
    PetscCall(VecAXPY(x, -1.0, exact));
    PetscCall(VecNorm(x, NORM_INFINITY, &difference));
    if (difference < 1e-5) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "as with aij\n"));
    else PetscCall(PetscPrintf(PETSC_COMM_WORLD, "OFF BY %g, %s\n", (double)difference, TaoConvergedReasons[reason]));
  }
  PetscCall(MatDestroy(&H));
  PetscCall(MatDestroy(&J));
  PetscCall(MatDestroy(&E));
  PetscCall(VecDestroy(&x));
  PetscCall(VecDestroy(&exact));
  PetscCall(DestroyProgram(&p));
  PetscFunctionReturn(0);
}

/* The vectors that go with a nest are nests, too */
static PetscErrorCode TestNestedVector(void)
{
  Program            p;
  Mat                H;
  Vec                x, parts[2];
  PetscErrorCode     error = 0;
  TaoConvergedReason reason;
  IS                 rows[2];

  PetscFunctionBeginUser;
  PetscCall(CreateProgram(40, &p));
  PetscCall(CreateNest(p.q.H, PETSC_FALSE, &H));
  PetscCall(MatNestGetISs(H, rows, NULL));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecGetSubVector(p.q.b, rows[k], &parts[k]));
  PetscCall(VecCreateNest(PETSC_COMM_WORLD, 2, rows, parts, &x));
  PetscCall(Solve(&p, H, NULL, NULL, "", x, &error, &reason));
  PetscCall(AttemptCompareRanks("nested vector", error));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "nested vector: %s\n", error ? attempt_sentence : "NOT REFUSED"));
  PetscCall(VecDestroy(&x));
  for (PetscInt k = 0; k < 2; k++) PetscCall(VecRestoreSubVector(p.q.b, rows[k], &parts[k]));
  PetscCall(MatDestroy(&H));
  PetscCall(DestroyProgram(&p));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const char *const hessians[]  = {MATAIJ, MATBAIJ, MATSBAIJ, MATDENSE, "nest", MATIS, MATCONSTANTDIAGONAL, "shell",
     "shell with diagonal", "nest with a shell", "transpose"};
  const char *const jacobians[] = {MATBAIJ, MATDENSE, "nest", MATIS, "shell", "nest with a shell", "transpose"};
  const char *const products[]  = {"-tao_ipfilter_pc_type none", "-tao_ipfilter_pc_type jacobi",
     "-tao_ipfilter_pc_type shell"};
  const PetscInt    few = 40, many = 1002;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscAMGFInitializePackage());
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(hessians); k++) {
    PetscCall(Test(few, hessians[k], NULL, NULL, ""));
    PetscCall(Test(few, hessians[k], MATAIJ, NULL, ""));
    PetscCall(Test(few, hessians[k], MATAIJ, MATAIJ, ""));
    PetscCall(Test(few, hessians[k], MATAIJ, MATAIJ, "-tao_ipfilter_equality condensed"));
  }
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(jacobians); k++) {
    PetscCall(Test(few, MATAIJ, jacobians[k], MATAIJ, ""));
    PetscCall(Test(few, MATAIJ, MATAIJ, jacobians[k], ""));
  }
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(products); k++) {
    PetscCall(Test(many, "shell", MATAIJ, NULL, products[k]));
    PetscCall(Test(many, "shell with diagonal", "nest", NULL, products[k]));
  }
  PetscCall(Test(many, "shell", MATAIJ, NULL, ""));
  PetscCall(Test(many, "shell", MATAIJ, NULL, "-tao_ipfilter_pc_type none -tao_ipfilter_direct"));
  PetscCall(Test(many, "shell", MATAIJ, MATAIJ, "-tao_ipfilter_pc_type none"));
  PetscCall(Test(many, "nest with a shell", MATAIJ, NULL, ""));
  PetscCall(Test(many, MATAIJ, "shell", NULL, ""));
  PetscCall(Test(many, MATAIJ, MATAIJ, "shell", ""));
  PetscCall(TestNestedVector());
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: 2

TEST*/
