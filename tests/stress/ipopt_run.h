/* Shared by the programs that give IPOPT a problem of the tests: its count of iterations, its silence, and clocks */
#ifndef IPOPT_RUN_H
#define IPOPT_RUN_H

#include <IpStdCInterface.h>
#include <time.h>

/* First member of what IPOPT hands to the callbacks */
typedef struct {
  int iterations;
} RunRecord;

static Bool RunCount(Index mode, Index iteration, Number f, Number inf_pr, Number inf_du, Number mu, Number d_norm,
  Number regularization, Number alpha_du, Number alpha_pr, Index trials, UserDataPtr user)
{
  (void)mode, (void)f, (void)inf_pr, (void)inf_du, (void)mu, (void)d_norm, (void)regularization, (void)alpha_du,
    (void)alpha_pr, (void)trials;
  ((RunRecord *)user)->iterations = iteration;
  return TRUE;
}

/* IPOPT's defaults, silently, with its iterations counted */
static void RunPrepare(IpoptProblem problem)
{
  AddIpoptIntOption(problem, "print_level", 0);
  AddIpoptStrOption(problem, "sb", "yes");
  SetIntermediateCallback(problem, RunCount);
}

static double RunSeconds(clockid_t clock)
{
  struct timespec now;

  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
