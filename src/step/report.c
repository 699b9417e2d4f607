/* What a load step and a run report: forces, work of the preconditioner, time of the phases, memory. */
#include "stepimpl.h"
#include <math.h>
#include <sys/resource.h>

/* The last solve's end is the load step's */
PetscErrorCode ReportReason(StepReport *report, PetscBool converged, const char reason[])
{
  PetscFunctionBegin;
  report->converged = converged;
  PetscCall(PetscFree(*(char **)&report->reason));
  PetscCall(PetscStrallocpy(reason, (char **)&report->reason));
  PetscFunctionReturn(0);
}

/* Appends */
PetscErrorCode ReportIterations(StepReport *report, PetscInt n, const PetscInt iterations[])
{
  PetscFunctionBegin;
  PetscCall(PetscRealloc((report->nksp + n) * sizeof(PetscInt), &report->ksp_iterations));
  PetscCall(PetscArraycpy(report->ksp_iterations + report->nksp, iterations, n));
  report->nksp += n;
  PetscFunctionReturn(0);
}

/* What the preconditioner did since `before`: amgf counts for itself, any other PC is applied once an iteration of the whole step */
PetscErrorCode ReportPreconditioner(KSP ksp, const PCAMGFCounts *before, StepReport *report)
{
  PC           pc;
  PetscBool    isamgf;
  PCAMGFCounts counts;

  PetscFunctionBegin;
  PetscCall(KSPGetPC(ksp, &pc));
  PetscCall(PetscObjectTypeCompare((PetscObject)pc, PCAMGF, &isamgf));
  if (isamgf) {
    PetscCall(PCAMGFGetCounts(pc, &counts));
    PetscCall(PCAMGFGetFilterSize(pc, &report->filter_dofs));
    report->amg_applications += counts.amg_applies - before->amg_applies;
    report->amg_setups += counts.amg_setups - before->amg_setups;
  } else {
    report->amg_applications = 0;
    for (PetscInt i = 0; i < report->nksp; ++i) report->amg_applications += report->ksp_iterations[i];
    report->amg_setups = report->nksp;
  }
  PetscFunctionReturn(0);
}

/* q = J_full^T M z: the forces on the two sides cancel */
static PetscErrorCode ReportActionReaction(Simulation sim, Vec q, StepReport *report)
{
  const PetscScalar *a;
  PetscReal          sums[4] = {0, 0, 0, 0}; /* the force, and the sum of the vertices' sizes */
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(q, &n));
  PetscCall(VecGetArrayRead(q, &a));
  for (PetscInt i = 0; i < n; i += 3) {
    const PetscReal f[3] = {PetscRealPart(a[i]), PetscRealPart(a[i + 1]), PetscRealPart(a[i + 2])};

    for (PetscInt c = 0; c < 3; ++c) sums[c] += f[c];
    sums[3] += PetscSqrtReal(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  }
  PetscCall(VecRestoreArrayRead(q, &a));
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, sums, 4, MPIU_REAL, MPIU_SUM, sim->comm));
  report->action_reaction = sums[3] > 0.0 ? PetscSqrtReal(sums[0] * sums[0] + sums[1] * sums[1] + sums[2] * sums[2]) / sums[3] : 0.0;
  PetscFunctionReturn(0);
}

/* Its sum over a pair's nonmortar vertices acts on that side */
static PetscErrorCode ReportContactForce(Simulation sim, Vec q, StepReport *report)
{
  const PetscScalar *a;
  PetscInt           rstart;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(report->contact_force, 3));
  PetscCall(VecGetOwnershipRange(q, &rstart, NULL));
  PetscCall(VecGetArrayRead(q, &a));
  for (PetscInt p = 0; p < sim->scene->npairs; ++p) {
    for (PetscInt c = 0; c < 3; ++c) {
      IS              is;
      const PetscInt *rows;
      PetscInt        n;

      PetscCall(MeshGetFaceDofs(sim->dm, sim->scene->pairs[p].nonmortar, c, &is));
      PetscCall(ISGetLocalSize(is, &n));
      PetscCall(ISGetIndices(is, &rows));
      for (PetscInt k = 0; k < n; ++k) report->contact_force[c] += PetscRealPart(a[rows[k] - rstart]);
      PetscCall(ISRestoreIndices(is, &rows));
      PetscCall(ISDestroy(&is));
    }
  }
  PetscCall(VecRestoreArrayRead(q, &a));
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, report->contact_force, 3, MPIU_REAL, MPIU_SUM, sim->comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode ReportGap(const ContactSolution *sol, StepReport *report)
{
  Vec       product;
  PetscReal most;

  PetscFunctionBegin;
  report->gap_min = NAN;
  PetscCall(VecGetSize(sol->gap, &report->constraints));
  if (!report->constraints) PetscFunctionReturn(0);
  PetscCall(VecMin(sol->gap, NULL, &report->gap_min));
  PetscCall(VecDuplicate(sol->gap, &product));
  PetscCall(VecPointwiseMult(product, sol->gap, sol->pressure));
  PetscCall(VecNorm(product, NORM_INFINITY, &most));
  report->complementarity = most;
  PetscCall(VecDestroy(&product));
  PetscFunctionReturn(0);
}

/* In the energy norm, relative to that of the displacement; report->energy is set */
static PetscErrorCode ReportDiscretization(Simulation sim, Vec u, StepReport *report)
{
  const PetscReal size = PetscSqrtReal(2.0 * report->energy);
  PetscReal       sum  = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscFree(report->body_errors));
  PetscCall(PetscMalloc1(sim->scene->nbodies, &report->body_errors));
  PetscCall(ElasticityEstimateError(sim->elasticity, u, report->body_errors, NULL));
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b) {
    sum += report->body_errors[b];
    report->body_errors[b] = size > 0.0 ? PetscSqrtReal(report->body_errors[b]) / size : 0.0;
  }
  report->error_estimate = size > 0.0 ? PetscSqrtReal(sum) / size : 0.0;
  PetscFunctionReturn(0);
}

/*
   What of the energy is not the mesh's doing: sum m |gap z| (the duality gap), the work of the forces out of balance, and that of
   the pressures on the difference of the true and the linearized gap; to first order in each, over twice the energy
*/
static PetscErrorCode ReportAlgebraicError(Vec u, Vec residual, const ContactSolution *sol, Vec weighted, StepReport *report)
{
  PetscScalar work, duality = 0.0;
  PetscReal   press = 0.0;
  Vec         products;

  PetscFunctionBegin;
  PetscCall(VecDot(u, residual, &work));
  if (weighted) {
    PetscCall(VecDuplicate(weighted, &products));
    PetscCall(VecPointwiseMult(products, weighted, sol->gap));
    PetscCall(VecAbs(products));
    PetscCall(VecSum(products, &duality));
    PetscCall(VecDestroy(&products));
    PetscCall(VecNorm(weighted, NORM_1, &press));
  }
  report->algebraic_error = PetscAbsScalar(duality) + PetscAbsScalar(work) + press * report->gap_change;
  if (report->energy > 0.0) report->algebraic_error /= 2.0 * report->energy;
  PetscFunctionReturn(0);
}

/*
   All taken from the elements and the contact rows, not from the solver: energy; the residual of equilibrium; the reaction
   = internal - contact - dead force on the prescribed rows; at the end of a load step the discretization error
*/
PetscErrorCode ReportForces(const StepProblem *p, Vec u, const ContactSolution *sol, StepReport *report)
{
  Simulation sim = p->sim;
  Vec        force, contact, weighted = NULL;
  PetscReal  size, residual;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(p->base, &force));
  PetscCall(ElasticityEnergy(sim->elasticity, u, &report->energy));
  PetscCall(ElasticityForce(sim->elasticity, u, force));
  PetscCall(VecNorm(force, NORM_2, &size));
  if (p->load) PetscCall(VecAXPY(force, -1.0, p->load));
  if (sol->pressure) {
    PetscCall(ReportGap(sol, report));
    PetscCall(VecDuplicate(sol->pressure, &weighted));
    PetscCall(VecDuplicate(p->base, &contact));
    PetscCall(VecPointwiseMult(weighted, sol->pressure, sim->linearization->mass));
    PetscCall(MatMultTranspose(sim->linearization->J, weighted, contact));
    PetscCall(ReportContactForce(sim, contact, report));
    PetscCall(ReportActionReaction(sim, contact, report));
    PetscCall(VecAXPY(force, -1.0, contact));
    PetscCall(VecDestroy(&contact));
  }
  PetscCall(PrescribedSum(&sim->prescribed, force, report->reaction));
  PetscCall(PrescribedSet(&sim->prescribed, 0.0, force));
  PetscCall(VecNorm(force, NORM_2, &residual));
  report->equilibrium = size > 0.0 ? residual / size : residual;
  PetscCall(ReportAlgebraicError(u, force, sol, weighted, report));
  PetscCall(VecDestroy(&weighted));
  PetscCall(VecDestroy(&force));
  if (sim->estimate && p->time == (PetscReal)report->step) PetscCall(ReportDiscretization(sim, u, report));
  PetscFunctionReturn(0);
}

/* The resident set now, summed over ranks */
PetscErrorCode ReportResident(MPI_Comm comm, PetscLogDouble *bytes)
{
  PetscFunctionBegin;
  PetscCall(PetscMemoryGetCurrentUsage(bytes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/* The peak of the resident set of this program. Linux tells it by VmHWM; what getrusage() says elsewhere may be the peak of the
   process that started this one */
static PetscErrorCode PeakResident(PetscLogDouble *bytes)
{
  FILE         *status = fopen("/proc/self/status", "r");
  char          line[256];
  unsigned long kilobytes = 0;
  struct rusage usage;

  PetscFunctionBegin;
  while (status && !kilobytes && fgets(line, sizeof(line), status)) (void)sscanf(line, "VmHWM: %lu", &kilobytes);
  if (status) fclose(status);
  if (!kilobytes) {
    PetscCheck(!getrusage(RUSAGE_SELF, &usage), PETSC_COMM_SELF, PETSC_ERR_SYS, "getrusage() failed");
    kilobytes = (unsigned long)usage.ru_maxrss;
  }
  *bytes = 1024.0 * (PetscLogDouble)kilobytes;
  PetscFunctionReturn(0);
}

/* Summed over ranks */
static PetscErrorCode ReportMemory(MPI_Comm comm, PetscLogDouble *bytes)
{
  PetscFunctionBegin;
  PetscCall(PeakResident(bytes));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bytes, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscFunctionReturn(0);
}

/*@C
   SimulationGetReport - The report of the run so far: one entry a load step, time of the phases, memory.

   Collective

   Input Parameter:
.  sim - the simulation

   Output Parameter:
.  report - a view; its arrays and strings are borrowed and end with the simulation

   Level: intermediate

   Note:
   Phase times come from PETSc's events, so PetscLogDefaultBegin() (or -log_view) must have been called before the
   simulation was created; otherwise only the total is known.
@*/
PetscErrorCode SimulationGetReport(Simulation sim, RunReport *report)
{
  PetscFunctionBegin;
  PetscCall(StepEventsGetTimes(sim->comm, &sim->start, &sim->report.time));
  for (PetscInt b = 0; b < sim->report.nbodies; ++b) PetscCall(ElasticityGetAssemblies(sim->elasticity, b, &sim->report.assemblies[b]));
  PetscCall(EffectsSetTimes(sim, &sim->report));
  PetscCall(ReportMemory(sim->comm, &sim->report.peak_memory_bytes));
  *report = sim->report;
  PetscFunctionReturn(0);
}
