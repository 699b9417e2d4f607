/*
   Inertia. In a time step the energy of the bodies gets the term

     c/2 (u - centre)^T M (u - centre) + (rest + turn + excess)^T u + viscosity E(u - viscous)

   Its gradient is the force of inertia and damping. Each file uses those listed before it.
*/
#ifndef DYNAMICSIMPL_H
#define DYNAMICSIMPL_H

#include "src/constraints/constraintsimpl.h"

typedef struct {
  Mat       mass;                   /* NULL: a static analysis */
  Vec       velocity, acceleration; /* at the last state [length/time], [length/time^2] */
  Vec       auxiliary;              /* acceleration of generalized-alpha [length/time^2] */
  Vec       inert;                  /* 1 in rows with mass that move freely, else 0 */
  Vec       rest;    /* impact scheme: internal, damping and dead forces at the last state; else NULL [force] */
  Vec       turn;    /* impact scheme: forces of turn.c; NULL: no rigid body turns freely [force] */
  Vec       excess;  /* impact scheme: twice that of the mean internal force, of the last iterate; NULL: all bodies have
                          a quadratic energy [force] */
  PetscReal inertia; /* c of the time step under way [1/time^2] */
  Vec       centre;  /* of this step [length] */
  PetscReal viscosity; /* factor of the elastic energy of u - viscous, for damping by stiffness in this step; 0: none */
  Vec       viscous;   /* NULL: none [length] */
  Elasticity elasticity; /* borrowed */
  PetscReal  kinetic;    /* energy at time 0 [force length] */
  PetscReal  damped;     /* work that damping has taken up [force length] */
} Dynamics;

static inline PetscBool SchemeIsImpact(const SceneDynamics *scene)
{
  return (PetscBool)(scene->time_step > 0.0 && scene->scheme == SCHEME_IMPACT);
}

/* Contact forces are this fraction of the multipliers of a time step */
static inline PetscReal SchemeShare(const SceneDynamics *scene)
{
  return SchemeIsImpact(scene) ? 0.5 : 1.0;
}

/* mass.c */
PETSC_INTERN PetscErrorCode MassCreate(const Constraints *, Dynamics *);
PETSC_INTERN PetscErrorCode MassGetCentres(const Constraints *, const Dynamics *, PetscReal centres[][3]);
PETSC_INTERN PetscErrorCode MassMeasure(const Constraints *, const Dynamics *, Vec u, PetscReal *kinetic,
  PetscReal momentum[3], PetscReal spin[3]);

/* start.c */
PETSC_INTERN PetscErrorCode DynamicsCreate(const Constraints *, const DeadLoads *, Dynamics *);
PETSC_INTERN PetscErrorCode DynamicsSetRest(const Constraints *, const DeadLoads *, PetscReal time, Vec u, Dynamics *);
PETSC_INTERN PetscErrorCode DynamicsDestroy(Dynamics *);

/* scheme.c: the scheme's terms for a time step of this length from the displacement u */
PETSC_INTERN PetscErrorCode SchemeBegin(const SceneDynamics *, PetscReal dt, Vec u, Dynamics *);
PETSC_INTERN PetscErrorCode SchemePredict(const Dynamics *, PetscReal dt, Vec u, Vec predicted);
PETSC_INTERN PetscErrorCode SchemeAddForce(const Dynamics *, Vec u, PetscReal *energy, Vec force);
PETSC_INTERN PetscErrorCode SchemeGetDamping(const SceneDynamics *, const Dynamics *, Vec velocity, Vec force);
PETSC_INTERN PetscErrorCode SchemeAdvance(const SceneDynamics *, PetscReal dt, Vec before, Vec u, Dynamics *);

/* turn.c */
PETSC_INTERN PetscErrorCode TurnSetForce(const Constraints *, Vec before, Vec u, Vec load, Dynamics *);

#endif
