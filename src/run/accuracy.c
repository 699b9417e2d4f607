/* Chooses tolerances and mesh for a requested accuracy */
#include <accuracy.h>
#include <vector3.h>
#include <math.h>

#define ACCURACY_RATE \
  4.0 /* largest factor by which a uniform refinement reduces the error in energy: that of trilinear elements for
         smooth solutions */
#define ACCURACY_RAISED \
  16.0 /* largest factor by which order 2 instead of order 1 reduces the error in energy. Measured: 11 on a ball,
          limited by the edge of contact; 26 on a cantilever; 80 on a cylinder. */
#define ACCURACY_UPDATES 20
#define ACCURACY_REGULAR \
  1.05 /* The best rate of elements of order 1 is error ~ unknowns^(-2/3). The solution is taken to be singular if the
          recovered error falls by less than this factor times the best rate. */
#define ACCURACY_UNSEEN \
  2.0 /* If the results of two meshes differ by more than this factor times the sum of their recovered errors, there is
         an error that stress recovery does not include. */
#define ACCURACY_MINOR 1e-2 /* The change of a pair's force is relative to at least this fraction of the largest one. */
#define ACCURACY_MARGIN \
  0.5 /* fraction of the allowed error at which the solver's tolerance aims, since the solver leaves up to 1.3 times
         its tolerance, and a second run costs more than a Newton step */

/* Values of -accuracy_of. `force` and `displacement` include the energy; `pressure` includes energy and force. */
enum { ACCURACY_ENERGY, ACCURACY_FORCE, ACCURACY_PRESSURE, ACCURACY_DISPLACEMENT };
static const char *const AccuracyTargets[] = {"energy", "force", "pressure", "displacement"};

/* It is an error to set how -accuracy works without -accuracy */
static PetscErrorCode AccuracyCheckAlone(MPI_Comm comm, PetscBool set)
{
  static const char *const options[] = {"-accuracy_of", "-accuracy_adaptive", "-accuracy_share", "-accuracy_max_dofs",
    "-accuracy_order"};

  PetscFunctionBegin;
  for (size_t k = 0; !set && k < PETSC_STATIC_ARRAY_LENGTH(options); ++k) {
    PetscBool given;

    PetscCall(PetscOptionsHasName(NULL, NULL, options[k], &given));
    PetscCheck(!given, comm, PETSC_ERR_USER_INPUT,
      "%s has no effect without -accuracy: add it, for example "
      "-accuracy 0.01",
      options[k]);
  }
  PetscFunctionReturn(0);
}

/*@C
   AccuracySetFromOptions - Reads the required accuracy of a run from the options

   Collective

   Input Parameter:
.  comm - the communicator

   Output Parameter:
.  acc - the plan; its target is 0 if -accuracy is not given

   Options Database Keys:
+  -accuracy <target>         - requested relative error in energy and contact force
.  -accuracy_of <force>       - quantities that must have this error. energy: the energy; force: also each pair's
                                force; pressure: also each pair's largest pressure; displacement: the energy and the
                                displacements of the scene's probes
.  -accuracy_adaptive <false> - refine only the cells with a large error
.  -accuracy_share <0.1>      - largest error of the solver, as a fraction of the target
.  -accuracy_order <2>        - order of all bodies from the second mesh on; the second mesh then has the cells of the
                                first. Without the option: the order of the scene
-  -accuracy_max_dofs <1e6>   - largest number of unknowns of a mesh

   Level: beginner

.seealso: `ReportViewAccuracy()`
@*/
PetscErrorCode AccuracySetFromOptions(MPI_Comm comm, Accuracy *acc)
{
  PetscReal max_dofs = 1e6;
  PetscInt  of       = ACCURACY_FORCE;
  PetscBool set, ordered, estimate = PETSC_TRUE;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(acc, sizeof(*acc)));
  acc->comm  = comm;
  acc->share = 0.1;
  PetscOptionsBegin(comm, NULL, "Accuracy", NULL);
  PetscCall(PetscOptionsReal("-accuracy", "Requested relative error in energy and contact force", "AccuracyPlan",
    acc->target, &acc->target, &set));
  PetscCall(PetscOptionsEList("-accuracy_of", "Quantity that must be accurate besides the energy", "AccuracyAssess",
    AccuracyTargets, ACCURACY_DISPLACEMENT + 1, AccuracyTargets[of], &of, NULL));
  PetscCall(PetscOptionsBool("-accuracy_adaptive", "Refine only where the error is large", "AccuracyAssess",
    acc->adaptive, &acc->adaptive, NULL));
  PetscCall(PetscOptionsReal("-accuracy_share", "Fraction of the requested error that the solver may leave",
    "AccuracyPlan", acc->share, &acc->share, NULL));
  PetscCall(PetscOptionsReal("-accuracy_max_dofs", "Largest number of unknowns of a mesh", "AccuracyAssess", max_dofs,
    &max_dofs, NULL));
  PetscCall(PetscOptionsInt("-accuracy_order",
    "Element order of all bodies from the second mesh on, 2; default: the order of the scene", "AccuracyAssess",
    acc->order, &acc->order, &ordered));
  PetscOptionsEnd();
  PetscCall(AccuracyCheckAlone(comm, set));
  PetscCheck(!ordered || acc->order == 2, comm, PETSC_ERR_USER_INPUT,
    "-accuracy_order must be 2, not %" PetscInt_FMT ": without the option the order is that of the scene", acc->order);
  PetscCheck(!acc->order || !acc->adaptive, comm, PETSC_ERR_SUP,
    "-accuracy_order cannot be combined with -accuracy_adaptive: only hexahedra of order 1 are refined locally");
  PetscCheck(!set || (acc->target > 0.0 && acc->target < 1.0), comm, PETSC_ERR_USER_INPUT,
    "-accuracy is a relative error and must lie between 0 and 1, but is %g", (double)acc->target);
  PetscCheck(acc->share > 0.0 && acc->share < 1.0, comm, PETSC_ERR_USER_INPUT,
    "-accuracy_share must lie between 0 and 1, but is %g", (double)acc->share);
  PetscCheck(max_dofs > 0.0, comm, PETSC_ERR_USER_INPUT, "-accuracy_max_dofs must be positive, but is %g",
    (double)max_dofs);
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-error_estimate", &estimate, NULL));
  PetscCheck(!set || estimate, comm, PETSC_ERR_USER_INPUT,
    "-accuracy needs the error estimate: remove the option -error_estimate 0");
  acc->adaptive         = (PetscBool)(set && acc->adaptive);
  acc->of               = of;
  acc->max_dofs         = (PetscInt)PetscMin(max_dofs, (PetscReal)PETSC_MAX_INT);
  acc->tolerance        = ACCURACY_MARGIN * acc->share * acc->target;
  acc->update_tolerance = 0.25 * acc->share * acc->target;
  PetscFunctionReturn(0);
}

/*
   Checks that the scene is suitable. With -accuracy_order bodies must have order 1 and an element that also exists for
   order 2. If pressures or displacements must be accurate, there must be contact pairs or probes.
*/
static PetscErrorCode AccuracyCheckScene(const Accuracy *acc, Scene scene)
{
  PetscInt npoints = 0;

  PetscFunctionBegin;
  for (PetscInt b = 0; acc->order && acc->mesh == 0 && b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];

    if (body->material.type == MATERIAL_RIGID) continue;
    PetscCheck(body->order < 2, acc->comm, PETSC_ERR_USER_INPUT,
      "-accuracy_order 2 raises the order of the bodies, but body \"%s\" has order 2 already: omit the option or the "
      "key order",
      body->name);
    PetscCheck(body->element != ELEMENT_INCOMPATIBLE, acc->comm, PETSC_ERR_USER_INPUT,
      "-accuracy_order 2: body \"%s\" has element incompatible, which exists for order 1 only: use full or bbar",
      body->name);
    PetscCheck(body->order || body->shape != SHAPE_GMSH, acc->comm, PETSC_ERR_USER_INPUT,
      "-accuracy_order 2: body \"%s\" has the order of the cells in its mesh file: set order: 1 for the first mesh",
      body->name);
  }
  PetscCheck(!acc->order || !scene->nrefinements, acc->comm, PETSC_ERR_SUP,
    "-accuracy_order 2 cannot be combined with the refinements of the scene: only hexahedra of order 1 are refined "
    "locally");
  for (PetscInt i = 0; i < scene->nprobes; ++i) npoints += !scene->probes[i].line;
  PetscCheck(acc->of != ACCURACY_PRESSURE || scene->npairs, acc->comm, PETSC_ERR_USER_INPUT,
    "-accuracy_of pressure needs contact pairs, but the scene has none");
  PetscCheck(acc->of != ACCURACY_DISPLACEMENT || npoints, acc->comm, PETSC_ERR_USER_INPUT,
    "-accuracy_of displacement needs a probe at a point, but the scene has none");
  PetscFunctionReturn(0);
}

/*
   Chooses the tolerances of the next run. Collective. scene: the scene, whose contact_updates is raised unless
   -contact_updates was given; tolerances: those of the run, unchanged if no accuracy is requested.
   Contact is updated until the gap is consistent, so that load steps of any size end in the same state. With
   -contact_updates 1 the accuracy refers to the problem with one linearization per load step. The optimizer's tolerance
   starts at half of share x target, and is tightened if the solver's error is too large. Tolerances that the user has
   given as options take precedence; AccuracyAssess() reads them after the run.
*/
PetscErrorCode AccuracyPlan(Accuracy *acc, Scene scene, StepTolerances *tolerances)
{
  PetscBool given;

  PetscFunctionBegin;
  if (acc->target == 0.0) PetscFunctionReturn(0);
  PetscCall(AccuracyCheckScene(acc, scene));
  acc->contact = (PetscBool)(scene->npairs > 0);
  if (!acc->contact) tolerances->linear = acc->tolerance;
  else {
    tolerances->optimizer  = acc->tolerance;
    tolerances->gap_change = acc->update_tolerance;
    PetscCall(PetscOptionsHasName(NULL, NULL, "-contact_updates", &given));
    if (!given) scene->contact_updates = PetscMax(scene->contact_updates, ACCURACY_UPDATES);
    acc->updates = scene->contact_updates;
  }
  PetscFunctionReturn(0);
}

/* Returns the largest difference over the load steps, divided by the largest value, or by `least` if that is larger */
static PetscReal AccuracyLargestChange(PetscInt n, PetscInt stride, const PetscReal now[], const PetscReal before[],
  PetscReal least)
{
  PetscReal difference = 0.0, size = least;

  for (PetscInt s = 0; s < n; ++s) {
    difference = PetscMax(difference, PetscAbsReal(now[s * stride] - before[s * stride]));
    size       = PetscMax(size, PetscAbsReal(now[s * stride]));
  }
  return size > 0.0 ? difference / size : 0.0;
}

/* Returns the largest change of a probe's displacement vector, relative to the largest magnitude of its displacement */
static PetscReal AccuracyDisplacementChange(const AccuracyLevel *now, const AccuracyLevel *before, PetscInt nsteps,
  PetscInt nprobes)
{
  PetscReal change = 0.0;

  for (PetscInt i = 0; i < nprobes; ++i) {
    PetscReal difference = 0.0, size = 0.0;

    for (PetscInt s = 0; s < nsteps; ++s) {
      const PetscReal *u = &now->displaced[3 * (s * nprobes + i)], *v = &before->displaced[3 * (s * nprobes + i)];

      difference = PetscMax(difference, PetscSqr(u[0] - v[0]) + PetscSqr(u[1] - v[1]) + PetscSqr(u[2] - v[2]));
      size       = PetscMax(size, PetscSqr(u[0]) + PetscSqr(u[1]) + PetscSqr(u[2]));
    }
    change = PetscMax(change, size > 0.0 ? PetscSqrtReal(difference / size) : 0.0);
  }
  return change;
}

/*
   Returns the largest relative change of the energy and, depending on `of`, of the probes' displacements or of each
   pair's force (its magnitude, and the sum of its rows' forces)
*/
static PetscReal AccuracyChange(PetscInt of, const AccuracyLevel *now, const AccuracyLevel *before, PetscInt nsteps,
  PetscInt npairs, PetscInt nprobes)
{
  PetscReal change = AccuracyLargestChange(nsteps, 1, now->energy, before->energy, 0.0), largest = 0.0;

  if (of == ACCURACY_DISPLACEMENT) change = PetscMax(change, AccuracyDisplacementChange(now, before, nsteps, nprobes));
  if (of == ACCURACY_ENERGY || of == ACCURACY_DISPLACEMENT) return change;
  for (PetscInt i = 0; i < 2 * npairs * nsteps; ++i) largest = PetscMax(largest, now->force[i]);
  for (PetscInt k = 0; k < 2 * npairs; ++k)
    change = PetscMax(change, AccuracyLargestChange(nsteps, 2 * npairs, now->force + k, before->force + k,
                                k % 2 ? ACCURACY_MINOR * largest : largest));
  return change;
}

/* Returns the largest relative change of a pair's largest pressure */
static PetscReal AccuracyPressureChange(const AccuracyLevel *now, const AccuracyLevel *before, PetscInt nsteps,
  PetscInt npairs)
{
  PetscReal change = 0.0;

  for (PetscInt p = 0; p < npairs; ++p)
    change = PetscMax(change, AccuracyLargestChange(nsteps, npairs, now->pressure + p, before->pressure + p, 0.0));
  return change;
}

/* Returns the last run on a coarser mesh than that of the last run; NULL: there is none */
static const AccuracyLevel *AccuracyCoarser(const Accuracy *acc)
{
  const AccuracyLevel *now = &acc->levels[acc->nlevels - 1];

  for (PetscInt l = acc->nlevels - 2; l >= 0; --l) {
    if (acc->levels[l].mesh < now->mesh) return &acc->levels[l];
  }
  return NULL;
}

/*
   Returns the factor by which the error falls at least: the ratio of the cell sizes, as for the strongest singularity
   considered (crack, edge of a punch)
*/
static PetscReal AccuracyLeastRatio(const Accuracy *acc, const AccuracyLevel *now)
{
  return acc->adaptive ? PetscCbrtReal(PetscMax(now->growth, 1.25)) : 2.0;
}

/*
   Estimates the error of the finer mesh from the difference of the results on two meshes. The ratio of the errors is
   taken from the recovered errors, but limited by the best possible rate, since on coarse meshes the recovered error
   may fall faster than the error. The estimate is at least a quarter of the recovered error, in case the results agree
   by chance, and at least the recovered error if the solution is singular. If the results differ by more than recovery
   can explain, the whole difference is the estimate. The error of pressures is that of the stress, the square root of
   that of the energy.
*/
static void AccuracyAssessMesh(const Accuracy *acc, AccuracyLevel *now, const AccuracyLevel *before, PetscInt nsteps,
  PetscInt npairs, PetscInt nprobes)
{
  PetscReal ratio, pressure, least;

  now->error  = now->recovery;
  now->change = now->growth = NAN;
  if (!before) return;
  now->change = AccuracyChange(acc->of, now, before, nsteps, npairs, nprobes);
  now->growth = (PetscReal)now->dofs / (PetscReal)before->dofs;
  now->unseen = (PetscBool)(now->change > ACCURACY_UNSEEN * (now->recovery + before->recovery));
  ratio       = now->recovery > 0.0 ? before->recovery / now->recovery : ACCURACY_RATE;
  least       = ratio < ACCURACY_REGULAR * PetscPowReal(now->growth, 2.0 / 3.0) ? now->recovery : 0.25 * now->recovery;
  ratio       = PetscClipInterval(ratio, AccuracyLeastRatio(acc, now), now->raised ? ACCURACY_RAISED : ACCURACY_RATE);
  if (now->unseen) ratio = 2.0;
  now->error = PetscMax(now->change / (ratio - 1.0), least);
  if (acc->of != ACCURACY_PRESSURE) return;
  pressure    = AccuracyPressureChange(now, before, nsteps, npairs);
  now->change = PetscMax(now->change, pressure);
  now->error  = PetscMax(now->error, pressure / (PetscSqrtReal(ratio) - 1.0));
}

static void AccuracyRecordProbes(const StepReport *step, PetscReal displaced[])
{
  for (PetscInt i = 0; i < 3 * step->nprobes; ++i) displaced[i] = step->probes[i / 3].displacement[i % 3];
}

/* Records force and largest pressure of each pair in a load step */
static PetscErrorCode AccuracyRecordForces(const StepReport *step, PetscInt npairs, PetscReal force[],
  PetscReal pressure[])
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < npairs; ++p) {
    const PetscReal *f = p < step->npairs ? step->pairs[p].force : NULL;

    force[2 * p]     = f ? VectorNorm(f) : 0.0;
    force[2 * p + 1] = f ? step->pairs[p].normal_force : 0.0;
    pressure[p]      = f ? step->pairs[p].pressure : 0.0;
  }
  PetscFunctionReturn(0);
}

/*
   Returns the error in energy that the solver leaves. With one contact update per load step the gap error is not
   included, since no tolerance reduces it.
*/
static PetscReal AccuracySolverError(const Accuracy *acc, const StepReport *step)
{
  return acc->updates == 1 ? step->algebraic_error - step->gap_error : step->algebraic_error;
}

static PetscErrorCode AccuracyRecord(Accuracy *acc, const RunReport *report, PetscInt npairs)
{
  AccuracyLevel *level;
  PetscReal      largest = 0.0;
  const PetscInt nprobes = report->nsteps ? report->steps[0].nprobes : 0;

  PetscFunctionBegin;
  PetscCall(PetscRealloc((acc->nlevels + 1) * sizeof(*acc->levels), &acc->levels));
  level = &acc->levels[acc->nlevels++];
  PetscCall(PetscMemzero(level, sizeof(*level)));
  PetscCall(PetscMalloc4(report->nsteps, &level->energy, 2 * npairs * report->nsteps, &level->force,
    npairs * report->nsteps, &level->pressure, 3 * nprobes * report->nsteps, &level->displaced));
  level->refine = report->refine;
  level->mesh   = acc->mesh;
  level->raised = (PetscBool)(acc->order && acc->mesh == 1);
  level->dofs   = report->dofs;
  level->time   = report->time.total;
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const StepReport *step = &report->steps[s];

    level->energy[s] = step->energy + step->plastic_work;
    level->amg_applications += step->amg_applications;
    largest = PetscMax(largest, step->energy);
    PetscCall(AccuracyRecordForces(step, npairs, level->force + 2 * npairs * s, level->pressure + npairs * s));
    AccuracyRecordProbes(step, level->displaced + 3 * nprobes * s);
  }
  for (PetscInt s = 0; s < report->nsteps; ++s) {
    const StepReport *step   = &report->steps[s];
    const PetscReal   weight = largest > 0.0 ? step->energy / largest : 0.0;

    level->recovery  = PetscMax(level->recovery, weight * PetscSqr(step->error_estimate));
    level->algebraic = PetscMax(level->algebraic, weight * AccuracySolverError(acc, step));
  }
  AccuracyAssessMesh(acc, level, AccuracyCoarser(acc), report->nsteps, npairs, nprobes);
  PetscFunctionReturn(0);
}

/*
   Decides whether to refine again: unless the results of two meshes show an error within a factor of 2 of the target,
   or the next mesh would exceed the limit of unknowns
*/
static PetscErrorCode AccuracyDecideOnMesh(Accuracy *acc, PetscBool *refine)
{
  const AccuracyLevel *now    = &acc->levels[acc->nlevels - 1];
  const PetscBool      single = (PetscBool)!AccuracyCoarser(acc);
  const PetscReal      next   = (acc->adaptive ? acc->growth : 8.0) * (PetscReal)now->dofs;

  PetscFunctionBegin;
  acc->reached = (PetscBool)(!single && now->error <= 2.0 * acc->target);
  *refine      = (PetscBool)(!acc->reached && next <= (PetscReal)acc->max_dofs);
  if (acc->reached)
    PetscCall(PetscSNPrintf(acc->end, sizeof(acc->end),
      "requested accuracy reached: the error of the mesh is at most twice the requested one"));
  else if (!*refine)
    PetscCall(PetscSNPrintf(acc->end, sizeof(acc->end),
      "REQUESTED ACCURACY NOT REACHED: %sthe next mesh would have about %g unknowns, but -accuracy_max_dofs allows "
      "%" PetscInt_FMT,
      single ? "a single mesh gives no error estimate; " : "", (double)next, acc->max_dofs));
  PetscFunctionReturn(0);
}

/* Adopts the tolerances of the run, which options may have set */
static void AccuracyAdopt(Accuracy *acc, const StepTolerances *used)
{
  const PetscReal solver = acc->contact ? used->optimizer : used->linear;

  acc->given            = (PetscBool)(solver != acc->tolerance);
  acc->tolerance        = solver;
  acc->update_tolerance = used->gap_change;
}

/*
   Decides whether to tighten the solver's tolerance, at most twice per mesh, because the solver's error exceeds its
   share
*/
static PetscErrorCode AccuracyDecideOnTolerance(Accuracy *acc, PetscBool *tighten)
{
  const AccuracyLevel *now     = &acc->levels[acc->nlevels - 1];
  const PetscReal      allowed = acc->share * acc->target;
  PetscInt             runs    = 0;

  PetscFunctionBegin;
  *tighten = PETSC_FALSE;
  if (now->algebraic <= allowed) PetscFunctionReturn(0);
  for (PetscInt l = 0; l < acc->nlevels; ++l) runs += (acc->levels[l].mesh == now->mesh);
  *tighten = (PetscBool)(!acc->given && runs <= 2);
  if (*tighten) acc->tolerance *= PetscMax(0.01, ACCURACY_MARGIN * allowed / now->algebraic);
  else {
    acc->reached = PETSC_FALSE;
    PetscCall(PetscSNPrintf(acc->end, sizeof(acc->end),
      "REQUESTED ACCURACY NOT REACHED: the solver leaves an error of %g, more than its share", (double)now->algebraic));
  }
  PetscFunctionReturn(0);
}

/* Sets the order of all bodies that are not rigid */
static PetscErrorCode AccuracyRaiseOrder(PetscInt order, Scene scene)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    if (scene->bodies[b].material.type != MATERIAL_RIGID) scene->bodies[b].order = order;
  }
  PetscFunctionReturn(0);
}

/*
   Collective. Estimates the error of a run, and chooses the next refinement if it is too large. tolerances: the
   tolerances of the run; report: the report of the run; scene: the scene, whose refinement is set to that of the next
   run; again: whether the scene must be run again.

   The first mesh's error in energy is estimated by stress recovery. This does not include the errors of faceted curved
   surfaces and of the edge of contact. Therefore a second mesh is always run. From then on the error is extrapolated
   from the change between two meshes: that of the energy or of a pair's force, whichever is largest. The assumed
   convergence rate is that of the recovered error, but at most a factor of 4, the rate of trilinear elements. The
   result is at least a quarter of the recovered error. It is at least the recovered error if that falls more slowly
   than for a regular solution, as near singular edges. If the change is larger than the recovered errors of both meshes
   explain, the change is the error. A pair's force has two values: its magnitude, relative to the largest of all pairs,
   and the sum of the magnitudes of its rows' forces.

   A mesh is fine enough when its error is within a factor of 2 of the target. Uniform refinement divides the error by 4
   and costs 8 times as much, so that all coarser meshes together cost a seventh of the last. If the first mesh already
   meets the target, the second one makes the cost 8 times that of the first.

   Adaptive refinement also uses at least two meshes. Each refines the cells chosen by SimulationPropose(). The error is
   extrapolated with the same rates, where the ratio of cell sizes is at least the cube root of the ratio of unknowns.

   With -accuracy_order the second mesh is the first one with bodies of that order. It has six to eight times as many
   unknowns, and the error is extrapolated with a factor of at most 16. Later meshes are refined.

   If the solver's error exceeds its share, its tolerance is tightened, unless the user has given it. On the finest mesh
   the run is repeated with the new tolerance.
*/
PetscErrorCode AccuracyAssess(Accuracy *acc, const StepTolerances *tolerances, const RunReport *report, Scene scene,
  PetscBool *again)
{
  const PetscBool raise = (PetscBool)(acc->order && acc->mesh == 0);
  PetscBool       refine, tighten;

  PetscFunctionBegin;
  *again = PETSC_FALSE;
  if (acc->target == 0.0) PetscFunctionReturn(0);
  AccuracyAdopt(acc, tolerances);
  PetscCall(AccuracyRecord(acc, report, scene->npairs));
  PetscCall(AccuracyDecideOnMesh(acc, &refine));
  PetscCall(AccuracyDecideOnTolerance(acc, &tighten));
  if (refine) ++acc->mesh;
  if (refine && raise) PetscCall(AccuracyRaiseOrder(acc->order, scene));
  else if (refine && !acc->adaptive) ++scene->refine;
  *again = (PetscBool)(refine || tighten);
  PetscFunctionReturn(0);
}

/*@C
   AccuracyDestroy - Frees the record of the runs

   Not Collective

   Input Parameter:
.  acc - the record

   Level: beginner

.seealso: `AccuracySetFromOptions()`
@*/
PetscErrorCode AccuracyDestroy(Accuracy *acc)
{
  PetscFunctionBegin;
  for (PetscInt l = 0; l < acc->nlevels; ++l)
    PetscCall(
      PetscFree4(acc->levels[l].energy, acc->levels[l].force, acc->levels[l].pressure, acc->levels[l].displaced));
  PetscCall(PetscFree(acc->levels));
  acc->nlevels = 0;
  PetscFunctionReturn(0);
}
