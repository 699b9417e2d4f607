/*
   The map of src/step: its files in the order in which they build on one another, each with what it offers to those
   below it. A load step is attempted (attempt.c) as an optimization problem (problem.c), solved by one of three
   solvers, measured, and kept or cut (step.c).
*/
#ifndef STEPIMPL_H
#define STEPIMPL_H

#include <step.h>
#include <checkpoint.h>
#include <mesh.h>
#include <elasticity.h>
#include <contact.h>
#include <petscamgf.h>
#include <petsccompat.h>

/* events.c */
PETSC_INTERN PetscLogEvent  SIM_Mesh, SIM_Assembly, SIM_Contact, SIM_Solve, SIM_Forces, SIM_Results;
PETSC_INTERN PetscErrorCode StepEventsRegister(void);
PETSC_INTERN PetscErrorCode StepEventsRead(RunTimes *);
PETSC_INTERN PetscErrorCode StepEventsGetTimes(MPI_Comm, const RunTimes *start, RunTimes *);

/* memory_usage.c */
PETSC_INTERN PetscErrorCode MemoryUsageGet(MPI_Comm, PetscLogDouble *bytes);
PETSC_INTERN PetscErrorCode MemoryUsageGetPeak(MPI_Comm, PetscLogDouble *bytes);

/* report.c */
PETSC_INTERN PetscErrorCode ReportWarn(MPI_Comm, RunReport *, const char format[], ...) PETSC_ATTRIBUTE_FORMAT(3, 4);
PETSC_INTERN PetscErrorCode ReportReason(StepReport *, PetscBool converged, const char reason[]);
PETSC_INTERN PetscErrorCode ReportIterations(StepReport *, PetscInt n, const PetscInt iterations[]);
PETSC_INTERN PetscErrorCode ReportFallbacks(StepReport *, const TaoIPFilterFallbacks *);
PETSC_INTERN PetscErrorCode ReportGetCounts(KSP, PCAMGFCounts *);
PETSC_INTERN PetscErrorCode ReportPreconditioner(KSP, const PCAMGFCounts *before, StepReport *);

/* places.c: where the nodes that this rank owns are, undeformed, and in which body; in the order of the global
   vectors */
typedef struct {
  Vec       x;    /* [length] */
  PetscInt *body; /* one a node */
} VertexPlaces;

PETSC_INTERN PetscErrorCode VertexPlacesCreate(DM, VertexPlaces *);
PETSC_INTERN PetscErrorCode VertexPlacesDestroy(VertexPlaces *);

/* motions.c: rigid motions of faces and bodies at the factors of the ramps; the first displacement of a face or body
   leads the others */
typedef struct {
  PetscReal t[3], center[3]; /* [length] */
  PetscReal turn[3][3];      /* rotation less identity */
} RigidMotion;

PETSC_INTERN PetscInt  MotionFindLeader(Scene, PetscInt displacement);
PETSC_INTERN void      MotionGet(Scene, PetscInt leader, const PetscReal factor[], RigidMotion *);
PETSC_INTERN PetscReal MotionDisplace(const RigidMotion *, const PetscScalar x[3], PetscInt component);

/* prescribed.c: prescribed displacements of the whole scene: owned global rows, ascending, their values at factor 1
   and their ramps */
typedef struct {
  PetscReal value;  /* [length]; of a motion 1 where it drives, else 0 */
  PetscInt  ramp;   /* of a motion 0 */
  PetscInt  motion; /* displacement of the scene that leads it; PETSC_DECIDE: none */
} PrescribedValue;

typedef struct {
  Scene            scene;
  Vec              x; /* places of the nodes, borrowed */
  PetscInt         n;
  PetscInt        *rows;
  PrescribedValue *values;
} Prescribed;

PETSC_INTERN PetscErrorCode PrescribedCreate(DM, Scene, const VertexPlaces *, Prescribed *);
PETSC_INTERN PetscErrorCode PrescribedApply(const Prescribed *, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode PrescribedSet(const Prescribed *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode PrescribedSum(const Prescribed *, Vec, PetscReal sum[3]);
PETSC_INTERN PetscErrorCode PrescribedDestroy(Prescribed *);

/* loads.c: dead loads by ramp, at factor 1; NULL where nothing follows the ramp, and altogether where the scene has
   no load */
typedef struct {
  Scene scene;
  Vec  *force; /* nramps [force] */
} DeadLoads;

PETSC_INTERN PetscErrorCode DeadLoadsCreate(Scene, DM, Elasticity, DeadLoads *);
PETSC_INTERN PetscErrorCode DeadLoadsGet(const DeadLoads *, PetscReal time, Vec *force);
PETSC_INTERN PetscErrorCode DeadLoadsDestroy(DeadLoads *);

/* temperatures.c: of bodies that expand, by ramp at factor 1, as linear functions in the cells; now: NULL where the
   scene has none */
typedef struct {
  MPI_Comm    comm;
  Scene       scene;
  Elasticity  elasticity; /* borrowed */
  PetscInt    n;
  PetscReal **fits; /* nramps, NULL where nothing follows the ramp */
  PetscReal  *now;
} Temperatures;

PETSC_INTERN PetscErrorCode TemperaturesCreate(Scene, Elasticity, MPI_Comm, Temperatures *);
PETSC_INTERN PetscErrorCode TemperaturesApply(Temperatures *, PetscReal time);
PETSC_INTERN PetscErrorCode TemperaturesGetLargest(const Temperatures *, PetscReal *size);
PETSC_INTERN PetscErrorCode TemperaturesDestroy(Temperatures *);

/* solution.c: what a solve left behind, beside the displacement */
typedef struct {
  Vec pressure; /* one a row */
  Vec gap;      /* linearized, one a row */
  Vec shear;    /* forces of friction along both tangents of a row [force]; NULL: no pair has any */
  Vec slip;     /* since the last state, along both tangents of a row [length] */
} ContactSolution;

PETSC_INTERN PetscErrorCode ContactSolutionCreate(Vec rows, ContactSolution *);
PETSC_INTERN PetscErrorCode ContactSolutionDestroy(ContactSolution *);

/* contact_history.c: pressure and slack of the last solve by nonmortar vertex, for the next one's warm start */
typedef struct {
  PetscSection global;           /* the mesh's */
  PetscInt     npairs, nowned;   /* nodes that this rank owns */
  PetscInt     first;            /* global row of the first */
  PetscReal   *pressure, *slack; /* npairs x nowned; pressure 0 where no row was */
  PetscBool   *open;             /* where the pressure is a barrier's over an open gap */
  PetscReal   *shear;            /* 3 npairs x nowned: force of friction [force]; NULL: no pair has any, */
  PetscReal   *settled;          /* that at the last state of equilibrium, */
  PetscReal   *slip_path;        /* and npairs x nowned: the length of all slip up to it [length], */
  PetscReal   *dissipated;       /* and the work of friction [force length] */
} ContactHistory;

PETSC_INTERN PetscErrorCode ContactHistoryCreate(DM, Scene, ContactHistory *);
PETSC_INTERN PetscInt       ContactHistoryIndex(const ContactHistory *, ContactLinearization, PetscInt row);
PETSC_INTERN PetscErrorCode ContactHistoryStore(ContactHistory *, ContactLinearization, const ContactSolution *,
  Vec slack, PetscReal stiffness);
PETSC_INTERN PetscErrorCode ContactHistoryRecall(const ContactHistory *, ContactLinearization, PetscReal scale,
  Vec slack, Vec pressure, PetscBool *any);
PETSC_INTERN PetscErrorCode ContactHistoryChange(const ContactHistory *, ContactLinearization, PetscReal *change);
PETSC_INTERN PetscErrorCode ContactHistoryFindClosed(const ContactHistory *, ContactLinearization, Vec closed);
PETSC_INTERN PetscErrorCode ContactHistoryFindLost(const ContactHistory *, ContactLinearization, PetscBool **lost,
  PetscInt *nlost);
PETSC_INTERN PetscErrorCode ContactHistoryLeastGap(const ContactHistory *, const PetscBool lost[], ContactLinearization,
  PetscReal *least);
PETSC_INTERN PetscErrorCode ContactHistoryDestroy(ContactHistory *);

/* path.c: the last two states of equilibrium; load step k ends at time k */
typedef struct {
  PetscReal time, previous_time;
  Vec       u, previous_u;
  PetscReal largest_increment; /* of any component in any step so far [length] */
  Vec       outside;           /* forces from outside at u; NULL at the start: none [force] */
  PetscReal work;              /* of theirs [force length] */
  Vec       contact;           /* forces on the contacts at u, where pairs rub; NULL: none [force] */
  PetscReal contact_work;      /* of theirs [force length] */
} LoadPath;

/* Fields that are asked for, and what they were at the end of the last load step */
typedef struct {
  PetscBool  nodes, points; /* asked for: at nodes and of cells, at quadrature points */
  PetscReal *recovered;     /* stress, 6 values a local node */
  PetscReal *nodal, *density, *places, *point_stress;
  PetscInt   npoints;
} Results;

/* Where the points of the scene's probes are */
typedef struct {
  PetscInt n;
  PetscReal (*points)[3];
  MeshPlace *places;
} Probes;

/* springs.c: stiffness a row; NULL where the scene has none */
typedef struct {
  Vec      stiffness, weak; /* of all springs to the ground; of the weak ones among them [force/length] */
  Mat      between;         /* of those between two faces; NULL: there are none */
  PetscInt nweak;           /* bodies that they hold */
} Springs;

/* When a run has said how far it is, and what it knows of that; of the clock [s] */
typedef struct {
  PetscReal      every;    /* 0: never */
  PetscReal      first;    /* time of the load program at the beginning of this run */
  PetscReal      residual; /* the first of a linear solve */
  PetscLogDouble begun, reached, said;
} Progress;

/* Of rigid.c: a rigid body some of whose motions are free */
typedef struct {
  PetscInt  leader;        /* displacement of the scene */
  PetscInt  n, motion[6];  /* those that are free: along, and about, the axes */
  PetscInt  row[6];        /* global rows whose displacements carry them */
  PetscReal inverse[6][6]; /* motions by the displacements of these rows; angles times size */
  PetscReal size;          /* [length] */
} RigidBody;

typedef struct {
  PetscInt   n;
  RigidBody *bodies;
  Mat        R;       /* displacements of the rows that follow in terms of those that carry; NULL: no motion is free */
  Vec        elastic; /* 0 in the rows of these bodies, else 1 */
  Vec given; /* what the motions that are prescribed displace their rows by, but those that are prescribed as rows
                [length] */
  Vec held;  /* stiffness of the rows that carry motions, about the centre of proximal.c; else 0 [force/length] */
} RigidBodies;

/* Of ties.c: the displacements of tied rows in terms of the others; C NULL where nothing is tied */
typedef struct {
  Mat      C, K;    /* u = C x + o; stiffness of the bodies, K of the simulation being C^T K C */
  Mat      hanging; /* that which hanging vertices have of C; NULL: there are none */
  Mat      joined;  /* C = joined R, where forces drive rigid bodies; NULL: C = R */
  Mat      elastic; /* C without the rows of such bodies, which have no stiffness; NULL: there are none */
  Vec      o;       /* NULL: 0 [length] */
  PetscInt n, *rows;
  Vec      work;
} Ties;

/* Of adapt.c, where the next mesh may have cells refined: squared errors of this rank's cells, summed over load
   steps, and which are to be refined */
typedef struct {
  PetscReal *errors;
  PetscBool *marked;
} Adapt;

/* Of forecast.c: what load steps ended with on another mesh, interpolated to this one; none where nothing is foreseen
 */
typedef struct {
  StepForecast *found; /* the caller's; NULL: none is wanted */
  StepForecast  here;
  PetscBool     used, failed; /* by the last attempt; by any */
} Forecast;

/* What the files from here on work on */
struct _n_Simulation {
  MPI_Comm     comm;
  Scene        scene;
  DM           dm;
  Elasticity   elasticity;
  Contact      contact; /* NULL when the scene names no pair */
  Prescribed   prescribed;
  DeadLoads    loads;
  Temperatures temperatures;
  Springs      springs;
  RigidBodies  rigid;
  Ties         ties;
  Mat          follows; /* slope of the pressures that follow their faces, of followers.c; NULL before there is one
                           [force/length] */
  VertexPlaces places;
  PetscBool quadratic; /* a load step is a quadratic program: every body is linear, or the scene asks for the model */
  Mat       K;
  Vec       mass;
  PetscReal stiffness;  /* the largest of the bodies', Young's modulus times length [force/length] */
  KSP       ksp;        /* of a quadratic step without contact */
  PetscInt  first_step; /* of this run: 0, or that which it goes on with */
  PetscReal increment;  /* of time, that a load step under way is tried with next; 0: all that is left of it */
  LoadPath  path;
  ContactHistory       history;
  PetscContainer       subspace; /* what the optimizer keeps from one load step to the next; NULL before the first */
  ContactLinearization linearization; /* of the last solve */
  ContactLinearization upcoming;      /* at path.u, of the faces as they are */
  PetscReal           *pressure, *gap, *stress;
  PetscReal           *shear, *slip; /* of the rows, two each; NULL without friction */
  PetscInt             npoints;
  ContactPoint        *points;
  Results              results;
  Probes               probes;
  StepTolerances       tolerances; /* once a solver has read its options: those that it has */
  PetscBool            warm;       /* later load steps start from the path and pressures of the last */
  PetscBool            monitor;    /* say when a step is cut or the gap linearized again */
  PetscBool            estimate;   /* of the discretization error, at the end of every load step */
  PetscInt             maxcuts;    /* of one load step */
  const MeshMarks     *marks;      /* NULL: no cells are to be marked */
  Adapt                adapt;
  Forecast             forecast;
  Progress             progress;
  int                  interrupted; /* the signal that asked for an end */
  PetscReal            penalty;     /* stiffness of the contact by that of the bodies; 0: constraints, no penalty */
  RunReport            report;
  RunTimes             start; /* what the clock and PETSc's events said when it began */
};

/* couplings.c */
PETSC_INTERN PetscErrorCode CouplingsCreate(Simulation, Mat *stiffness);
PETSC_INTERN PetscErrorCode CouplingsAddStiffness(Simulation, Mat C, Mat stiffness);

/* springs.c */
PETSC_INTERN PetscErrorCode SpringsMeasureVolumes(Simulation, PetscReal volume[]);
PETSC_INTERN PetscErrorCode SpringsMeasureStiffness(Simulation, PetscReal *largest);
PETSC_INTERN PetscErrorCode SpringsOfSize(Simulation, PetscReal share, Vec stiffness);
PETSC_INTERN PetscErrorCode SpringsCreate(Simulation);
PETSC_INTERN PetscErrorCode SpringsMeasure(Simulation, Vec u, PetscReal bodies[], PetscReal *weak);
PETSC_INTERN PetscErrorCode SpringsDestroy(Springs *);

/* planes.c */
PETSC_INTERN PetscErrorCode PlanesCreate(Simulation, const PetscBool prescribed[], Mat *C, PetscBool follows[]);

/* rigid.c */
PETSC_INTERN PetscErrorCode RigidCreate(Simulation, const PetscBool prescribed[], PetscBool follows[]);
PETSC_INTERN PetscErrorCode RigidMove(Simulation, PetscReal time, Vec o);
PETSC_INTERN PetscErrorCode RigidAddStiffness(Simulation, Mat C, Vec diagonal, Mat stiffness);
PETSC_INTERN PetscErrorCode RigidTest(Simulation, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode RigidDestroy(RigidBodies *);

/* joints.c */
PETSC_INTERN PetscErrorCode JointsExpand(Simulation, Mat all, const PetscInt tied[], const PetscBool prescribed[],
  Mat *C, PetscBool follows[]);
PETSC_INTERN PetscErrorCode JointsCreate(Simulation, const PetscBool prescribed[], Mat *C, PetscBool follows[]);

/* ties.c */
PETSC_INTERN PetscErrorCode TiesCreate(Simulation);
PETSC_INTERN PetscErrorCode TiesMove(Simulation, PetscReal time);
PETSC_INTERN PetscErrorCode TiesCreateTangent(Simulation, Mat *);
PETSC_INTERN PetscErrorCode TiesTangent(Simulation, Vec u, Mat);
PETSC_INTERN PetscErrorCode TiesFollow(const Ties *, Vec u);
PETSC_INTERN PetscErrorCode TiesGather(const Ties *, Vec force);
PETSC_INTERN PetscErrorCode TiesSet(const Ties *, PetscReal value, Vec);
PETSC_INTERN PetscErrorCode TiesGetForces(Simulation, Vec force, Vec *ties, Vec *rigid);
PETSC_INTERN PetscErrorCode TiesMeasure(Simulation, Vec forces, PetscReal bodies[]);
PETSC_INTERN PetscErrorCode TiesDestroy(Ties *);

/* path.c */
PETSC_INTERN PetscErrorCode PathContinue(Simulation, PetscReal time, Vec u);
PETSC_INTERN PetscErrorCode PathPressureScale(Simulation, PetscReal time, PetscReal *scale);
PETSC_INTERN PetscErrorCode PathSolvesToCome(Simulation, PetscInt *);
PETSC_INTERN PetscErrorCode PathAdvance(LoadPath *, PetscReal time, Vec *u);

/* interrupt.c */
PETSC_INTERN PetscErrorCode InterruptTest(Simulation, PetscBool *);
PETSC_INTERN PetscErrorCode InterruptMonitor(Tao, void *);
PETSC_INTERN PetscErrorCode InterruptReport(Simulation, StepReport *);

/* progress.c */
PETSC_INTERN PetscErrorCode ProgressBegin(Simulation);
PETSC_INTERN PetscErrorCode ProgressReach(Simulation);
PETSC_INTERN PetscErrorCode ProgressMonitorOptimizer(Tao, void *);
PETSC_INTERN PetscErrorCode ProgressMonitorLinear(KSP, PetscInt, PetscReal, void *);

/* stiffness.c */
PETSC_INTERN PetscErrorCode StiffnessSetType(Simulation);
PETSC_INTERN PetscErrorCode StiffnessGetWhole(Simulation, MatType, Mat *);
PETSC_INTERN PetscErrorCode StiffnessSetModes(Simulation, KSP, Mat);

/* contact_update_secants.c: where the gap, or a load, is linearized next, within one solve; begins as all zeros */
#define GAP_SECANTS 2
typedef struct {
  PetscInt  n, stalls; /* solutions; the last ones without progress */
  PetscReal least;     /* change of the gap so far [length] */
  Vec       u, way;    /* the last solution, and the way to it from where the gap was linearized [length] */
  Vec
    solutions[GAP_SECANTS]; /* what solutions changed by, the newest first; NULL beyond those that there are [length] */
  Vec ways[GAP_SECANTS];    /* the same of the ways [length] */
} ContactUpdateSecants;

PETSC_INTERN PetscErrorCode ContactUpdateSecantsAdvance(ContactUpdateSecants *, PetscReal change, Vec u,
  Vec u_linearized, PetscBool *damped);
PETSC_INTERN PetscErrorCode ContactUpdateSecantsDestroy(ContactUpdateSecants *);

/*
   problem.c: min E(u) - load^T u  s.t.  g + J (u - base) >= 0, lower <= u <= upper, u = base on prescribed rows.

   base is the last state with the prescribed displacements of this time. The quadratic model of E about it is
   energy + force^T w + 1/2 w^T K w, w = u - base; w vanishes on prescribed rows.
*/
typedef struct {
  Mat T;                  /* two rows a row of J: its slip; columns of prescribed rows are zero. NULL: no friction */
  Vec t;                  /* slip = T u + t [length] */
  Vec limit, coefficient; /* one a row [force], [1] */
} StepFriction;

typedef struct {
  Simulation           sim;
  PetscReal            time;
  Mat                  K;
  Vec                  base;
  Vec                  load; /* dead load, and that which follows faces at p->followed [force]; NULL if there is none */
  Vec                  force;  /* gradient at base, zero on prescribed rows [force] */
  PetscReal            energy; /* objective at base; of the quadratic model only */
  Mat                  J;      /* NULL without contact; columns of prescribed rows are zero */
  Vec                  g;
  Vec                  lower, upper; /* NULL without bounds */
  ContactUpdateSecants secants;      /* where the load is taken next */
  Vec                  followed; /* displacement at which the load is taken; NULL where no pressure follows its face */
  Vec                  centre, held; /* of proximal.c, and the stiffness about it; NULL without [force/length] */
  char                *failed;       /* why a solve without it has found no solution; NULL: none has been tried */
  PetscReal            carried;      /* what was left between the last solution and its centre [force] */
  PetscReal            tolerance; /* KKT error that the present linearization is solved to; 0: that of the load step */
  PetscBool            ended_early; /* the last solve ended by it, short of the load step's */
  PetscReal            gap_change;  /* of the linearization before the last one */
  Vec                  w, Kw;

  StepFriction friction;
} StepProblem;

PETSC_INTERN PetscErrorCode StepProblemCreate(Simulation, PetscReal time, StepProblem *);
PETSC_INTERN PetscErrorCode StepProblemSetContact(StepProblem *, ContactLinearization, Vec u_linearized);
PETSC_INTERN PetscErrorCode StepProblemSetBounds(StepProblem *, PetscReal increment);
PETSC_INTERN PetscErrorCode StepProblemDestroy(StepProblem *);
/* Callbacks of TAO, also in quadratic.c and energy.c; the context is a StepProblem */
PETSC_INTERN PetscErrorCode StepProblemConstraint(Tao, Vec, Vec, void *);
PETSC_INTERN PetscErrorCode StepProblemConstant(Tao, Vec, Mat, Mat, void *);

/* centred.c */
PETSC_INTERN PetscErrorCode CentredAdd(PetscReal sign, Mat A, Vec diagonal, Vec centre, Vec x, PetscReal *energy,
  Vec force);

/* followers.c */
PETSC_INTERN PetscErrorCode FollowersBegin(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersForget(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersSubtract(const StepProblem *, Vec u, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode FollowersAdvance(StepProblem *, Vec u, PetscInt nsolves, StepReport *, PetscBool *again);

/* proximal.c */
PETSC_INTERN PetscErrorCode ProximalBegin(StepProblem *);
PETSC_INTERN PetscErrorCode ProximalRescue(StepProblem *, Vec u, StepReport *, PetscBool *again);
PETSC_INTERN PetscErrorCode ProximalAddStiffness(const StepProblem *, Mat);
PETSC_INTERN PetscErrorCode ProximalEnd(StepProblem *);
PETSC_INTERN PetscErrorCode ProximalAdd(const StepProblem *, Vec x, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode ProximalAdvance(StepProblem *, Vec u, PetscInt ncentres, StepReport *, PetscBool *again);

/* friction.c */
PETSC_INTERN PetscErrorCode FrictionSetUp(StepProblem *, ContactLinearization, Vec mask);
PETSC_INTERN PetscErrorCode FrictionGive(StepProblem *, Tao, PetscReal scale);
PETSC_INTERN PetscErrorCode FrictionKeep(StepProblem *, Tao, Vec u, ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionAddForces(ContactLinearization, Vec shear, PetscInt pair, Vec force);
PETSC_INTERN PetscErrorCode FrictionDestroy(StepFriction *);

/* friction_work.c */
PETSC_INTERN PetscErrorCode FrictionMeasure(Simulation, const ContactSolution *, StepReport *);
PETSC_INTERN PetscErrorCode FrictionSettle(Simulation, const ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionRecall(Simulation);

/* quadratic.c */
PETSC_INTERN PetscErrorCode QuadraticEnergy(StepProblem *, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode QuadraticObjectiveAndGradient(Tao, Vec, PetscReal *, Vec, void *);

/* energy.c */
PETSC_INTERN PetscErrorCode EnergyObjective(Tao, Vec, PetscReal *, void *);
PETSC_INTERN PetscErrorCode EnergyObjectiveAndGradient(Tao, Vec, PetscReal *, Vec, void *);
PETSC_INTERN PetscErrorCode EnergyHessian(Tao, Vec, Mat, Mat, void *);

/* PETSC_INFINITY is a finite number to IEEE arithmetic, and so to PetscIsInfOrNanReal() */
static inline PetscBool EnergyIsFinite(PetscReal energy)
{
  return (PetscBool)(!PetscIsInfOrNanReal(energy) && energy < PETSC_INFINITY);
}

/* interference.c: overlaps that follow a ramp; gaps that wait for their load step are those of the faces as they are */
PETSC_INTERN PetscErrorCode InterferenceAdd(Simulation, PetscReal time, PetscReal times, ContactLinearization);

/* diagnose_rigid_motion.c */
PETSC_INTERN PetscErrorCode RigidMotionReport(Simulation, Vec u, StepReport *);

/* check_weak_springs.c */
PETSC_INTERN PetscErrorCode WeakSpringsTest(const StepProblem *, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode WeakSpringsTestMotion(const StepProblem *, Vec u_linearized, Vec u, StepReport *);

/* linear.c, optimizer.c, penalty.c: the three solvers; resume: from u as it is, with what is remembered of the last
   solve */
#define STEP_INVERTED "the prescribed displacements turn an element inside out at the start"

PETSC_INTERN PetscErrorCode LinearSolve(StepProblem *, PetscBool resume, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode OptimizerSolve(StepProblem *, PetscBool resume, Vec u, StepReport *, ContactSolution *);
PETSC_INTERN PetscErrorCode PenaltySolve(StepProblem *, PetscBool resume, Vec u, StepReport *, ContactSolution *);

/* contact_update_anticipate.c */
PETSC_INTERN PetscErrorCode ContactUpdateAnticipate(StepProblem *, ContactLinearization);

/* zero_load_step.c: a load step back to where nothing is asked for */
PETSC_INTERN PetscErrorCode ZeroLoadStepIsDue(const StepProblem *, PetscBool *);
PETSC_INTERN PetscErrorCode ZeroLoadStepSolve(const StepProblem *, ContactLinearization undeformed, Vec u, StepReport *,
  ContactSolution *, PetscBool *rests);

/* forces.c: forces and moments by pair, by face and by body */
PETSC_INTERN PetscErrorCode ForcesReserve(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasurePairs(Simulation, Vec u, Vec weighted, Vec shear, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasureFaces(Simulation, Vec u, Vec reaction, Vec ties, Vec rigid, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasureBodies(Simulation, Vec u, Vec load, Vec ties, PetscReal rounding,
  StepReport *);
PETSC_INTERN PetscErrorCode ForcesFree(StepReport *);

/* nodal_pressure.c: evens out, face by face of a pair, what the vertices at the edge of the other's cover carry:
   [area, force, gap x area] a vertex */
PETSC_INTERN PetscErrorCode NodalPressureEvenOut(Simulation, const SceneContactPair *, Vec carried);

/* contact_points.c: pressure, gap and status on both sides of every pair; into sim->points and the report's pairs */
PETSC_INTERN PetscErrorCode ContactPointsMeasure(Simulation, StepReport *);

/* work.c */
PETSC_INTERN PetscErrorCode WorkAdd(const StepProblem *, Vec u, Vec unbalanced, Vec rigid, Vec *contact, StepReport *);

/* results.c */
PETSC_INTERN PetscErrorCode ResultsComplete(const PetscReal stress[6], PetscReal values[STRESS_VALUES]);
PETSC_INTERN PetscErrorCode ResultsMeasure(Simulation);
PETSC_INTERN PetscErrorCode ResultsFree(Results *);

/* probes.c */
PETSC_INTERN PetscErrorCode ProbesCreate(DM, Scene, Probes *);
PETSC_INTERN PetscErrorCode ProbesMeasure(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode ProbesDestroy(Probes *);

/* forecast.c */
PETSC_INTERN PetscErrorCode ForecastSetUp(Simulation);
PETSC_INTERN PetscErrorCode ForecastRecord(Simulation);
PETSC_INTERN PetscErrorCode ForecastGet(const StepProblem *, Vec u, PetscBool *foreseen);
PETSC_INTERN PetscErrorCode ForecastAssess(Simulation, PetscBool converged, PetscBool *again);

/* adapt.c */
PETSC_INTERN PetscErrorCode AdaptAddErrors(Simulation, PetscReal cells[]);

/* adapt_contact.c */
PETSC_INTERN PetscErrorCode AdaptMarkContact(Simulation);

/* measure.c */
PETSC_INTERN PetscErrorCode MeasureState(const StepProblem *, Vec u, const ContactSolution *, StepReport *);

/* initial_contact.c */
PETSC_INTERN PetscErrorCode StartWarn(Simulation, ContactLinearization);
PETSC_INTERN PetscErrorCode StartWarnOfUnmet(Simulation);

/* attempt.c */
PETSC_INTERN PetscErrorCode SimulationAttempt(Simulation, PetscReal time, StepReport *);

/* effects.c */
PETSC_INTERN PetscErrorCode EffectsCreate(Simulation, RunReport *);
PETSC_INTERN PetscErrorCode EffectsSetTimes(Simulation, RunReport *);

/* fields.c, state.c, simulation.c, setup.c, step.c, contact_free.c, and accuracy.c on top of them, have no more
   than what step.h and accuracy.h offer */

#endif
