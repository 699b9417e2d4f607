/*
   Private header of measure: results of a state, which is not changed: forces, work, contact results, fields, errors.
   The files are listed such that each depends only on those before it.
*/
#ifndef MEASUREIMPL_H
#define MEASUREIMPL_H

#include "src/state/stateimpl.h"
#include "src/state/path.h"

/*
   What the measures of a state follow from, apart from loads and constraints: the bodies, their displacement, the
   contact rows of the last solve, the results at vertices, and the report of the run, to which warnings are added
*/
typedef struct {
  MPI_Comm        comm;
  Scene           scene;
  DM              dm;
  Elasticity      elasticity;
  Contact         contact; /* NULL if the scene has no contact pair */
  VertexPlaces    places;
  PetscReal       stiffness; /* largest stiffness of all bodies [force/length] */
  Vec             mass, u;
  ContactState   *solved;
  ContactHistory *history;
  RunReport      *report;
} Measured;

/* report: NULL if no warning is added */
static inline Measured MeasuredAt(Model m, State s, RunReport *report)
{
  return (Measured){m->comm, m->scene, m->dm, m->elasticity, m->contact, m->places, m->stiffness, m->mass, s->path->u,
    s->solved, s->history, report};
}

static inline Measured SimulationMeasured(Simulation sim)
{
  return MeasuredAt(sim->model, sim->state, &sim->report);
}

#define MEASURE_MOTION   0.01  /* depth that does not count, as a fraction of the largest displacement of the run */
#define MEASURE_ROUNDING 1e-11 /* rounding error of forces, relative to the stiffness times the largest displacement */

/* friction_work.c */
PETSC_INTERN PetscErrorCode FrictionGetCoefficient(Scene, PetscReal time, PetscInt pair, PetscReal *coefficient);
PETSC_INTERN PetscErrorCode RowsAddForces(ContactLinearization, Mat, Vec rows, PetscInt pair, Vec force);
PETSC_INTERN PetscErrorCode RowsGetForces(ContactLinearization, const ContactSolution *, Vec weighted, Vec force);
PETSC_INTERN PetscErrorCode FrictionMeasure(Model, State, PetscReal time, Vec u, const ContactSolution *, StepReport *,
  PetscReal *late);
PETSC_INTERN PetscErrorCode FrictionSettle(Model, State, PetscReal time, Vec u, const ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionRecall(ContactHistory *);

/* diagnose_rigid_motion.c */
PETSC_INTERN PetscErrorCode RigidMotionReport(Model, Vec u, const char known[], const char turning[], StepReport *);

/* free_motions.c: rigid motions of all bodies that no prescribed displacement, spring or tie resists */
typedef struct {
  PetscInt   n;
  Mat        Z;    /* one column for each motion: the displacements of the nodes [length] */
  Vec        each; /* work vector with a number for each motion */
  VecScatter all;  /* from such a vector to a copy on each rank */
} FreeMotions;

PETSC_INTERN PetscErrorCode FreeMotionsCreate(Model, State, FreeMotions *);
PETSC_INTERN PetscErrorCode FreeMotionsMultiply(const FreeMotions *, Mat, Vec motion, Vec product);
PETSC_INTERN PetscErrorCode FreeMotionsSum(const FreeMotions *, Mat, Vec force, Vec work);
PETSC_INTERN PetscErrorCode FreeMotionsDestroy(FreeMotions *);

/* diagnose_equilibrium.c */
#define WEAK_SPRINGS_SHARE 0.01 /* largest part of the loads on a body that its weak springs may carry */

PETSC_INTERN PetscErrorCode EquilibriumDiagnose(Model, State, PetscReal time, Vec load, StepReport *, PetscBool *none);

/* forces.c: forces and moments of pairs, faces and bodies */
PETSC_INTERN PetscErrorCode ForcesReserve(const Measured *, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasurePairs(const Measured *, Vec u, Vec weighted, Vec shear, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasureFaces(Model, Vec u, Vec reaction, Vec ties, Vec rigid, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasureBodies(Model, Vec u, Vec load, Vec ties, PetscReal rounding, StepReport *);
PETSC_INTERN PetscErrorCode TorquesMeasure(Scene, StepReport *);
PETSC_INTERN PetscErrorCode ForcesFree(StepReport *);

/*
   contact_points.c: computes state->solved->points, with pressure, gap and status on both sides of every pair, and the
   pairs' reports
*/
PETSC_INTERN PetscErrorCode ContactPointsMeasure(Model, State, StepReport *);

/* penetration_warnings.c: penetration of single vertices, whereas the gaps of mortar pairs are means */
PETSC_INTERN PetscErrorCode PenetrationMeasure(Model, State, StepReport *);
PETSC_INTERN PetscErrorCode PenetrationTest(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode PenetrationWarn(Simulation);

/* displacement_warnings.c: prescribed displacements that are larger than the bodies that they press */
PETSC_INTERN PetscErrorCode DisplacementWarn(Simulation, const StepReport *);

/*
   pair_mesh.c, strain_warnings.c: warn of contact meshes that are too coarse, and of strains that are too large for
   laws of small strain
*/
PETSC_INTERN PetscErrorCode PairMeshWarn(Simulation);
PETSC_INTERN PetscErrorCode StrainTest(Simulation, StepReport *);

/* rigid_places.c */
PETSC_INTERN PetscErrorCode RigidPlacesMeasure(Simulation, StepReport *);

/* work.c */
PETSC_INTERN PetscErrorCode WorkWarn(Simulation, const StepReport *);
PETSC_INTERN PetscErrorCode WorkAdd(Simulation, Vec load, Vec u, Vec unbalanced, Vec rigid, Vec *contact,
  PetscReal late, StepReport *);

/* results.c */
PETSC_INTERN PetscErrorCode ResultsComplete(const PetscReal stress[6], PetscReal values[STRESS_VALUES]);
PETSC_INTERN PetscErrorCode ResultsKeepReaction(Results *, Vec force);
PETSC_INTERN PetscErrorCode ResultsRecover(Model, Results *, Vec u, PetscReal errors[], PetscReal *cells[],
  StepReport *);
PETSC_INTERN PetscErrorCode ResultsMeasure(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode ResultsFree(Results *);

/* probes.c */
PETSC_INTERN PetscErrorCode ProbesCreate(DM, Scene, Probes *);
PETSC_INTERN PetscErrorCode ProbesMeasure(Model, State, Results *, StepReport *);
PETSC_INTERN PetscErrorCode ProbesDestroy(Probes *);

/* measure.c */
PETSC_INTERN PetscErrorCode MeasureState(Simulation, PetscReal time, Vec load, Vec inertia, Vec u,
  const ContactSolution *, StepReport *);

/* motion.c */
PETSC_INTERN PetscErrorCode MotionMeasure(Model, State, Vec u, StepReport *);

/* initial_contact.c */
PETSC_INTERN PetscErrorCode StartWarn(Simulation, ContactLinearization);
PETSC_INTERN PetscErrorCode StartWarnOfUnmet(Simulation, StepReport *);

#endif
