static char help[] =
  "What a run says to be left of it: true within a factor of two of load steps as long as those before,\n\
and nothing where they are not.\n\n";

#include "src/run/runimpl.h"
#include "src/state/run.h"

typedef PetscLogDouble (*Duration)(PetscInt step);

static PetscLogDouble Even(PetscInt step)
{
  (void)step;
  return 30;
}

static PetscLogDouble Uneven(PetscInt step)
{
  return 20 + 15 * (step % 3);
}

static PetscLogDouble Growing(PetscInt step)
{
  return 10 * PetscPowReal(1.1, step);
}

static PetscLogDouble LastIsLong(PetscInt step)
{
  return step == 9 ? 400 : 20;
}

static PetscLogDouble FirstIsLong(PetscInt step)
{
  return step ? 5 : 60;
}

static PetscLogDouble Short(PetscInt step)
{
  (void)step;
  return 0.05;
}

/* A run of ten load steps that speaks ten times in each; nobody foresees a last one that is unlike the others */
static PetscErrorCode Run(const char name[], Duration duration, PetscBool foreseen)
{
  Progress       progress = {.nsteps = 0};
  PetscLogDouble all = 0, worst = 1, first = -1, now = 0, left;
  PetscInt       said = 0, last = 0;

  PetscFunctionBeginUser;
  for (PetscInt step = 0; step < 10; ++step) all += duration(step);
  for (PetscInt step = 0; step < 10; ++step) {
    for (PetscInt k = 0; k < 10; ++k) {
      const PetscLogDouble elapsed = 0.1 * (PetscLogDouble)k * duration(step), truth = all - now - elapsed;

      if (!ProgressEstimate(&progress, elapsed, 9 - step, &left)) continue;
      if (first < 0) first = (PetscLogDouble)step;
      if (step == 9) ++last;
      ++said;
      if (foreseen) worst = PetscMax(worst, PetscMax(left / truth, truth / left));
    }
    now += duration(step);
    ProgressRecord(&progress, duration(step));
  }
  PetscCall(PetscPrintf(PETSC_COMM_SELF,
    "%s: said %" PetscInt_FMT " times of 100, from load step %g on, %" PetscInt_FMT
    " times in the last one, wrong by a factor of %.2f at most\n",
    name, said, first + 1, last, worst));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(Run("even", Even, PETSC_TRUE));
  PetscCall(Run("uneven", Uneven, PETSC_TRUE));
  PetscCall(Run("growing", Growing, PETSC_TRUE));
  PetscCall(Run("the last is long", LastIsLong, PETSC_FALSE));
  PetscCall(Run("the first is long", FirstIsLong, PETSC_TRUE));
  PetscCall(Run("short", Short, PETSC_TRUE));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      output_file: output/progress_estimate_1.out

TEST*/
