/*
   Inertia. In a time step this term is added to the energy of the bodies:
     c/2 (u - centre)^T M (u - centre) + (residual + turn + excess + turned)^T u + viscosity E(u - viscous)
     + rate/2 (u - viscous)^T D (u - viscous)
   E is the elastic energy, D the matrix of dampers. The gradient of the term is the sum of the inertia and damping
   forces. Each file uses only the files listed before it.
*/
#ifndef DYNAMICSIMPL_H
#define DYNAMICSIMPL_H

#include "src/constraints/constraintsimpl.h"

typedef struct {
  Mat mass;                   /* mass matrix [force time^2/length]; NULL in a static analysis */
  Vec velocity, acceleration; /* at the last state [length/time], [length/time^2] */
  Vec auxiliary;              /* acceleration of generalized-alpha [length/time^2] */
  Vec inert;                  /* 1 in rows with mass whose displacement is not prescribed, else 0 */
  Vec residual; /* impact scheme: internal plus damping minus dead forces at the last state [force]; NULL for other
                     schemes */
  Vec turn;     /* impact scheme: forces of turn.c [force]; NULL if no rigid body has finite free rotations */
  Vec excess;   /* impact scheme: twice the excess of the energy-conserving mean internal force of the step over the
                       mean of the forces at its ends (ElasticityExcess()), at the last iterate [force]; NULL if all
                       bodies have a quadratic energy */
  Vec turned;   /* impact scheme: contact forces along the derivatives of the gaps at the end of the step, less those
                     along the derivatives at its start [force]; NULL without contact */
  PetscReal inertia;   /* c in the current time step [1/time^2] */
  Vec       centre;    /* displacement at which the mass term of the current time step is zero [length] */
  PetscReal viscosity; /* factor of the elastic energy of u - viscous in the current time step, for damping in
                          proportion to stiffness; 0 without such damping */
  Vec       viscous;   /* displacement at which that damping, and that of dampers, vanishes [length]; NULL without
                            such damping */
  Vec driven; /* velocity at the end of the current time step in rows with prescribed displacements (drive.c); other
                 rows are not used [length/time] */
  const Prescribed *prescribed; /* owned by the caller */
  Springs          *springs;    /* springs and dampers; their `rate` is set here; owned by the caller */
  Elasticity        elasticity; /* owned by the caller */
  PetscReal         kinetic;    /* kinetic energy at time 0 [force length] */
  PetscReal         damped;     /* energy that damping has dissipated [force length] */
  PetscReal         fastest;    /* controlled time steps: largest norm of the velocity so far, with the mass */
} Dynamics;

static inline PetscBool SchemeIsImpact(const SceneDynamics *scene)
{
  return (PetscBool)(scene->time_step > 0.0 && scene->scheme == SCHEME_IMPACT);
}

/* Returns the ratio of contact forces to the multipliers of a time step */
static inline PetscReal SchemeShare(const SceneDynamics *scene)
{
  return SchemeIsImpact(scene) ? 0.5 : 1.0;
}

/* mass.c: the mass matrix and quantities that depend on it */
PETSC_INTERN PetscErrorCode MassCreate(const Constraints *, Dynamics *);
PETSC_INTERN PetscErrorCode MassGetCentres(const Constraints *, const Dynamics *, PetscReal centres[][3]);
PETSC_INTERN PetscErrorCode MassMeasure(const Constraints *, const Dynamics *, Vec u, PetscReal *kinetic,
  PetscReal momentum[3], PetscReal spin[3]);

/* drive.c: velocities and accelerations in rows with prescribed displacements */
PETSC_INTERN PetscErrorCode DriveStart(const Constraints *, PetscInt order, Vec rate);
PETSC_INTERN PetscErrorCode DriveBegin(const Constraints *, PetscReal time, PetscReal dt, PetscReal before, Vec u,
  Vec previous, Dynamics *);
PETSC_INTERN PetscErrorCode DriveEnd(const Dynamics *, Vec velocity);

/* initial_state.c: velocities and accelerations at time 0 */
PETSC_INTERN PetscErrorCode DynamicsCreate(const Constraints *, const DeadLoads *, Springs *, Dynamics *);
PETSC_INTERN PetscErrorCode DynamicsSetRest(const Constraints *, const DeadLoads *, PetscReal time, Vec u, Dynamics *);
PETSC_INTERN PetscErrorCode DynamicsDestroy(Dynamics *);

/* scheme.c: terms of a time step of length dt that begins at the displacement u */
PETSC_INTERN PetscErrorCode SchemeBegin(const SceneDynamics *, PetscReal dt, Vec u, Dynamics *);
PETSC_INTERN PetscErrorCode SchemePredict(const Dynamics *, PetscReal dt, Vec u, Vec predicted);
PETSC_INTERN PetscErrorCode SchemeAddForce(const Dynamics *, Vec u, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode SchemeGetDamping(const SceneDynamics *, const Dynamics *, Vec velocity, Vec force);
PETSC_INTERN PetscErrorCode SchemeEstimate(const SceneDynamics *, PetscReal dt, PetscReal before, PetscBool smooth,
  Vec from, Vec u, Dynamics *, PetscReal *error);
PETSC_INTERN PetscErrorCode SchemeAdvance(const SceneDynamics *, PetscReal dt, Vec before, Vec u, Dynamics *);

/* turn.c: forces that conserve the energy of rotating rigid bodies */
PETSC_INTERN PetscErrorCode TurnSetForce(const Constraints *, Vec before, Vec u, Vec load, Vec contact, Dynamics *);

#endif
