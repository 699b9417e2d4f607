/*
   One load step: its files in the order in which they build on one another, each with what it offers to those
   below it. A load step is attempted (attempt.c) as an optimization problem (problem.c), solved by one of three
   solvers, measured, and kept or cut (step.c).
*/
#ifndef STEPIMPL_H
#define STEPIMPL_H

#include "src/measure/measureimpl.h"
#include <petscamgf.h>

/* interrupt.c */
PETSC_INTERN PetscErrorCode InterruptTest(Simulation, PetscBool *);
PETSC_INTERN PetscErrorCode InterruptMonitor(Tao, void *);
PETSC_INTERN PetscErrorCode InterruptReport(Simulation, StepReport *);

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
  PetscBool            unheld;       /* contact cannot hold the loads where the bodies were at the last state */
  PetscBool            moves_on;     /* no solve brings a body to rest that friction ought to hold */
  char                *failed;       /* why a solve without it has found no solution; NULL: none has been tried */
  PetscReal            carried;      /* what was left between the last solution and its centre [force] */
  PetscReal            tolerance; /* KKT error that the present linearization is solved to; 0: that of the load step */
  PetscBool            ended_early; /* the last solve ended by it, short of the load step's */
  PetscReal            gap_change;  /* of the linearization before the last one */
  Vec                  w, Kw;

  StepFriction friction;
} StepProblem;

PETSC_INTERN PetscErrorCode StepProblemCreate(Simulation, PetscReal time, StepProblem *);
PETSC_INTERN PetscErrorCode StepProblemTurn(StepProblem *, Vec u);
PETSC_INTERN PetscErrorCode StepProblemSetContact(StepProblem *, ContactLinearization, Vec u_linearized);
PETSC_INTERN PetscErrorCode StepProblemSetBounds(StepProblem *, PetscReal increment);
PETSC_INTERN PetscErrorCode StepProblemDestroy(StepProblem *);
/* Callbacks of TAO, also in quadratic.c and energy.c; the context is a StepProblem */
PETSC_INTERN PetscErrorCode StepProblemConstraint(Tao, Vec, Vec, void *);
PETSC_INTERN PetscErrorCode StepProblemConstant(Tao, Vec, Mat, Mat, void *);

/* followers.c */
PETSC_INTERN PetscErrorCode FollowersBegin(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersTurn(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersForget(StepProblem *);
PETSC_INTERN PetscErrorCode FollowersSubtract(const StepProblem *, Vec u, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode FollowersAdvance(StepProblem *, Vec u, PetscInt nsolves, StepReport *, PetscBool *again);

/* proximal.c */
PETSC_INTERN PetscErrorCode ProximalBegin(StepProblem *);
PETSC_INTERN PetscErrorCode ProximalTurn(StepProblem *, Vec u);
PETSC_INTERN PetscErrorCode ProximalRescue(StepProblem *, Vec u, StepReport *, PetscBool *again);
PETSC_INTERN PetscErrorCode ProximalAddStiffness(const StepProblem *, Mat);
PETSC_INTERN PetscErrorCode ProximalEnd(StepProblem *);
PETSC_INTERN PetscErrorCode ProximalAdd(const StepProblem *, Vec x, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode ProximalAdvance(StepProblem *, Vec u, PetscInt ncentres, StepReport *, PetscBool *again);

/* friction.c */
PETSC_INTERN PetscErrorCode FrictionSetUp(StepProblem *, ContactLinearization, Vec u_linearized, Vec mask);
PETSC_INTERN PetscErrorCode FrictionGive(StepProblem *, Tao, PetscReal scale);
PETSC_INTERN PetscErrorCode FrictionKeep(StepProblem *, Tao, Vec u, ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionDestroy(StepFriction *);

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

/* forecast.c */
PETSC_INTERN PetscErrorCode ForecastSetUp(Simulation);
PETSC_INTERN PetscErrorCode ForecastRecord(Simulation);
PETSC_INTERN PetscErrorCode ForecastGet(const StepProblem *, Vec u, PetscBool *foreseen);
PETSC_INTERN PetscErrorCode ForecastAssess(Simulation, PetscBool converged, PetscBool *again);

/* contact_update_truth.c */
PETSC_INTERN PetscErrorCode ContactUpdateMeasureTruth(Simulation, Vec u, const ContactSolution *,
  ContactLinearization at_u, StepReport *);

/* attempt.c */
PETSC_INTERN PetscErrorCode SimulationAttempt(Simulation, PetscReal time, StepReport *);

/* step.c has no more than what step.h offers */

#endif
