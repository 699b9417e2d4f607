/*
   The optimization problem of a load step, and its solvers. The files are listed such that each depends only on those
   before it.
*/
#ifndef PROBLEMIMPL_H
#define PROBLEMIMPL_H

#include "src/measure/measureimpl.h"
#include <petscamgf.h>

/* stiffness.c: chooses the storage of the stiffness matrix and attaches rigid body modes */
PETSC_INTERN PetscErrorCode StiffnessSetType(Model);
PETSC_INTERN PetscErrorCode StiffnessSetModes(Model, KSP, Mat);
PETSC_INTERN PetscErrorCode StiffnessGiveMotions(Model, State, Tao);

/*
   anderson.c: Anderson acceleration of the contact updates, of the follower loads or of the mean internal
   force. A struct of zeros has no history.
*/
#define ANDERSON_DEPTH 2
typedef struct {
  PetscInt  n, stalls;   /* number of solutions so far, and number of consecutive last solutions without
                                 progress */
  PetscReal least;       /* smallest change of the gap so far [length] */
  PetscReal first;       /* change of the gap of the first solution [length] */
  Vec       u, residual; /* last solution u and its residual u - u_linearized [length] */
  Vec
    solutions[ANDERSON_DEPTH]; /* differences of successive solutions, newest first [length]; NULL if there are fewer */
  Vec
    residuals[ANDERSON_DEPTH]; /* differences of successive residuals, newest first [length]; NULL if there are fewer */
} Anderson;

PETSC_INTERN PetscErrorCode AndersonAdvance(Anderson *, PetscReal change, Vec u, Vec u_linearized, PetscBool *damped);
PETSC_INTERN PetscErrorCode AndersonDestroy(Anderson *);

/*
   problem.c: min E(u) - load^T u subject to g + J (u - base) >= 0, lower <= u <= upper, and u = base on prescribed
   rows. `base` is the last state with the prescribed displacements of the present time. The quadratic model of E about
   base is energy + force^T w + 1/2 w^T K w with w = u - base; w is 0 on prescribed rows.
*/
typedef struct {
  Mat T;                  /* two rows per row of J, for the slip along its two tangents; columns of prescribed rows
                             are zero; NULL without friction */
  Vec t;                  /* constant part of the slip, slip = T u + t [length] */
  Vec t_given;            /* t before the optimizer has shifted references of vertices that stick */
  Vec limit, coefficient; /* largest friction force [force] and friction coefficient of each row of J */
} StepFriction;

/* Rows of soft pairs yield by depth + compliance x pressure. All vectors are NULL if no pair is soft. */
typedef struct {
  Vec compliance, depth; /* 0 in rows that do not yield [length^3/force], [length] */
  Vec cover;             /* share of each row of a soft pair that the mortar face covers */
} SoftRows;

typedef struct {
  Simulation sim;
  Model      model; /* that of the simulation */
  State      state; /* that of the simulation */
  PetscReal  time;
  PetscBool  quadratic; /* true if the objective is the quadratic model */
  Mat        K;
  Vec        base;
  Vec        load;   /* dead loads plus follower loads at p->followed [force]; NULL: no loads */
  Vec        force;  /* gradient at base, zero on prescribed rows [force] */
  PetscReal  energy; /* objective at base for the quadratic model [force length] */
  Mat        J;      /* NULL without contact; columns of prescribed rows are zero */
  Vec        g;
  SoftRows   soft;
  Vec        lower, upper;     /* NULL if there are no bounds */
  Anderson   secants;          /* secants of the follower loads */
  Vec        followed;         /* centre at which follower loads are linearized [length]; NULL: no follower
                                        loads */
  Vec        meant;            /* displacement at which the mean internal force of a time step is evaluated
                                        [length]; NULL: not needed */
  Anderson   mean_secants;     /* secants of the displacement `meant` */
  Vec        centre, proximal; /* proximal.c: centre [length] and diagonal stiffness [force/length] of the
                                        proximal term; NULL: no such term */
  PetscBool  unsupported;      /* true if it is proven that contact cannot hold the loads with the bodies in
                                        the positions of the last state */
  PetscBool  foreseen;         /* true if this was tested */
  PetscBool  moves_on;         /* true if a body that only friction holds did not come to rest in any solve */
  char      *failed;           /* reason for which the solve before the proximal term was added failed; NULL:
                                        no such failure */
  PetscBool  holds_weak;       /* true if the proximal term holds bodies on weak springs */
  PetscReal *weak_modulus;     /* modulus of this term of each body, see SpringsDistribute(); NULL: no such term */
  PetscBool  glides;           /* true if this term holds a body in a motion that no contact resists */
  PetscReal  carried;          /* force of the proximal term after the last solve [force] */
  PetscReal  tolerance;        /* relative KKT error to which the present linearization is solved; 0: that of
                                        the load step */
  PetscBool  ended_early;      /* true if the last solve stopped at `tolerance`, before the tolerance of the
                                        load step */
  PetscReal  gap_change;       /* change of the gap in the contact update before the last one [length] */
  PetscBool  by_newton;        /* true if Newton's method found the point at which the gap is linearized */
  PetscReal  newton_rtol;      /* relative tolerance to which Newton's method for the last contact update was solved */
  PetscBool  rough;            /* true if a contact update made no progress, so that Newton's method is not
                                        used for now */
  PetscInt   nflows;           /* number of iterates that show plastic flow */
  PetscInt
    nfalls; /* number of steps of falling objective that are short or have an indefinite tangent, less the others */
  PetscInt    nindefinite;  /* number of indefinite systems up to the last iterate */
  PetscReal   last_f;       /* objective of the last iterate [force length] */
  PetscBool   beyond_limit; /* true if follower loads seem to exceed a limit load */
  const char *flowing;      /* name of the body that flows, so that there is no equilibrium; NULL: none */
  Vec         w, Kw;
  Vec         tangent_at, tangent_before; /* displacements of the last two tangents [length] */

  Mat       directions; /* impact scheme: derivatives of the gaps at the last state; NULL without contact */
  PetscInt *direction;  /* row of `directions` at each index of the contact history; negative: none */
  Vec       pressed;    /* impact scheme, if rigid bodies turn: contact forces of the last solve [force]; NULL: none */

  StepFriction friction;
} StepProblem;

/* Returns the ratio of the optimizer's multipliers to the contact forces */
static inline PetscReal StepProblemShare(const StepProblem *p)
{
  return SchemeShare(&p->model->scene->dynamics);
}

PETSC_INTERN PetscErrorCode StepProblemCreate(Simulation, PetscReal time, StepProblem *);
PETSC_INTERN PetscErrorCode StepProblemSetQuadratic(StepProblem *, PetscBool anew);
PETSC_INTERN PetscErrorCode StepProblemTurn(StepProblem *, Vec u);
PETSC_INTERN PetscErrorCode StepProblemSetContact(StepProblem *, ContactLinearization, Vec u_linearized);
PETSC_INTERN PetscErrorCode StepProblemSetBounds(StepProblem *, PetscReal increment);
PETSC_INTERN PetscErrorCode StepProblemAdvanceBolts(StepProblem *, Vec u, StepReport *, PetscBool *again);
PETSC_INTERN PetscErrorCode StepProblemForesee(StepProblem *, StepReport *);
PETSC_INTERN PetscErrorCode StepProblemDestroy(StepProblem *);
/* callbacks of TAO; more of them are in energy.c; their context is a StepProblem */
PETSC_INTERN PetscErrorCode StepProblemConstraint(Tao, Vec, Vec, void *);
PETSC_INTERN PetscErrorCode StepProblemConstant(Tao, Vec, Mat, Mat, void *);

/* followers.c: forces that depend on the solution */
PETSC_INTERN PetscErrorCode FollowersBegin(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersTurn(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersForget(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersSubtract(const StepProblem *, Vec u, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode FollowersTestLimit(Tao, void *);
PETSC_INTERN PetscErrorCode FollowersReportLimit(const StepProblem *, StepReport *);
PETSC_INTERN PetscErrorCode FollowersForesee(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersAdvanceMean(StepProblem *, Vec u, PetscInt nsolves, StepReport *,
  PetscBool *again);
PETSC_INTERN PetscErrorCode FollowersAdvance(StepProblem *, Vec u, PetscInt nsolves, StepReport *, PetscBool *again);

/* proximal.c: proximal term of bodies that only contact, friction or weak springs hold */
PETSC_INTERN PetscErrorCode ProximalBegin(StepProblem *);
PETSC_INTERN PetscErrorCode ProximalTurn(StepProblem *, Vec u);
PETSC_INTERN PetscErrorCode ProximalRescue(StepProblem *, Vec u, StepReport *, PetscBool *again);
PETSC_INTERN PetscErrorCode ProximalLinearize(StepProblem *, Vec u_linearized);
PETSC_INTERN PetscErrorCode ProximalMeasure(StepProblem *, Vec u, PetscReal *fraction);
PETSC_INTERN PetscErrorCode ProximalAddStiffness(const StepProblem *, Mat);
PETSC_INTERN PetscErrorCode ProximalEnd(StepProblem *);
PETSC_INTERN PetscErrorCode ProximalAdd(const StepProblem *, Vec x, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode ProximalReportFlow(const StepProblem *, StepReport *);
PETSC_INTERN PetscErrorCode ProximalAdvance(StepProblem *, Vec u, PetscInt ncentres, StepReport *, PetscBool *again);

/* friction.c: friction laws of the optimizer */
PETSC_INTERN PetscErrorCode FrictionSetUp(StepProblem *, ContactLinearization, Vec u_linearized, Vec mask);
PETSC_INTERN PetscErrorCode FrictionGive(StepProblem *, Tao, PetscReal scale);
PETSC_INTERN PetscErrorCode FrictionRestart(StepProblem *);
PETSC_INTERN PetscErrorCode FrictionKeep(StepProblem *, Tao, Vec u, ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionKeepNone(const StepProblem *, Vec u, ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionCopy(const StepFriction *, StepFriction *);
PETSC_INTERN PetscErrorCode FrictionDestroy(StepFriction *);

/* energy.c: objectives of the optimizer */
PETSC_INTERN PetscErrorCode QuadraticEnergy(StepProblem *, Vec, PetscReal *);
PETSC_INTERN PetscErrorCode QuadraticObjectiveAndGradient(Tao, Vec, PetscReal *, Vec, void *);
PETSC_INTERN PetscErrorCode EnergyGetGradient(StepProblem *, Vec u, Vec G);
PETSC_INTERN PetscErrorCode EnergyGetTangent(StepProblem *, Vec u, Mat H);
PETSC_INTERN PetscErrorCode EnergyObjective(Tao, Vec, PetscReal *, void *);
PETSC_INTERN PetscErrorCode EnergyObjectiveAndGradient(Tao, Vec, PetscReal *, Vec, void *);
PETSC_INTERN PetscErrorCode EnergyHessian(Tao, Vec, Mat, Mat, void *);
PETSC_INTERN PetscErrorCode EnergyTestFlow(Tao, void *); /* monitor of TAO */

/*
   Returns whether an energy is finite. PETSC_INFINITY is a finite floating point number, which PetscIsInfOrNanReal()
   does not detect.
*/
static inline PetscBool EnergyIsFinite(PetscReal energy)
{
  return (PetscBool)(!PetscIsInfOrNanReal(energy) && energy < PETSC_INFINITY);
}

/* interference.c: ramps of initial overlaps; linearizations in state->solved->upcoming are stored without ramps */
PETSC_INTERN PetscErrorCode InterferenceGetCover(Model, Vec like, PetscInt pair, ContactLinearization,
  PetscReal size[]);
PETSC_INTERN PetscErrorCode InterferenceAdd(Model, State, PetscReal time, PetscReal times, ContactLinearization);

/* soft.c: laws of soft contact pairs */
PETSC_INTERN PetscErrorCode SoftSetUp(StepProblem *, ContactLinearization);
PETSC_INTERN PetscErrorCode SoftKeep(StepProblem *, ContactLinearization, ContactSolution *);
PETSC_INTERN PetscErrorCode SoftMeasureError(StepProblem *, ContactLinearization, const ContactSolution *,
  PetscReal *error);
PETSC_INTERN PetscErrorCode SoftDestroy(SoftRows *);

/* check_weak_springs.c: rejects solutions in which weak springs carry the loads */
PETSC_INTERN PetscErrorCode WeakSpringsTest(const StepProblem *, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode WeakSpringsReportMotion(const StepProblem *, Vec u_linearized, Vec u, StepReport *);

/* create_optimizer.c */
PETSC_INTERN PetscErrorCode OptimizerCreate(StepProblem *, Tao *, PetscBool *ours);

/*
   linear.c, optimizer.c: the two solvers. resume: true if the solve starts from u and from the pressures
   of the last solve
*/
#define STEP_INVERTED \
  "the prescribed displacements invert an element at the start of the load step; use smaller load steps"

PETSC_INTERN PetscErrorCode LinearSolve(StepProblem *, PetscBool resume, Vec u, StepReport *);
PETSC_INTERN PetscErrorCode OptimizerSolve(StepProblem *, PetscBool resume, Vec u, StepReport *, ContactSolution *);

/* starting_point.c: the starting point of a solve */
PETSC_INTERN PetscErrorCode StepProblemStart(StepProblem *, PetscBool resume, Tao, Vec u, PetscBool *valid);
PETSC_INTERN PetscErrorCode StepProblemUntie(StepProblem *, Vec u);

/* linear.c: the solver for the bodies without contact; solves the systems of contact updates */
PETSC_INTERN PetscErrorCode MatrixFreeSolve(Vec b, Vec x, void *context, PetscErrorCode (*multiply)(Mat, Vec, Vec),
  PetscReal rtol, PetscInt most, PetscBool *found);

/* zero_load_step.c: load steps that return to zero load */
PETSC_INTERN PetscErrorCode ZeroLoadStepIsDue(const StepProblem *, PetscBool vanishes, PetscBool *);
PETSC_INTERN PetscErrorCode ZeroLoadStepSolve(StepProblem *, ContactLinearization undeformed, Vec u, StepReport *,
  ContactSolution *, PetscBool *rests);

/* solve.c: solves the problem with the present linearization of the contact */
PETSC_INTERN PetscErrorCode StepProblemSolve(StepProblem *, PetscBool resume, Vec u, StepReport *, ContactSolution *);

#endif
