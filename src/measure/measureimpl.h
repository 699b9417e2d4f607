/*
   Measurement of a state, which is not changed: forces, work, contact results, fields, errors. Files are in the order
   in which they depend on each other.
*/
#ifndef MEASUREIMPL_H
#define MEASUREIMPL_H

#include "src/state/stateimpl.h"

#define MEASURE_ROUNDING 1e-11 /* of forces, relative to the stiffness and the largest displacement */

/* friction_work.c */
PETSC_INTERN PetscErrorCode FrictionGetCoefficient(Scene, PetscReal time, PetscInt pair, PetscReal *coefficient);
PETSC_INTERN PetscErrorCode FrictionAddForces(ContactLinearization, Vec shear, PetscInt pair, Vec force);
PETSC_INTERN PetscErrorCode FrictionMeasure(Simulation, Vec u, const ContactSolution *, StepReport *);
PETSC_INTERN PetscErrorCode FrictionSettle(Simulation, Vec u, const ContactSolution *);
PETSC_INTERN PetscErrorCode FrictionRecall(Simulation);

/* diagnose_rigid_motion.c */
PETSC_INTERN PetscErrorCode RigidMotionReport(Simulation, Vec u, const char known[], StepReport *);

/* free_motions.c: rigid motions of all bodies that prescribed displacements, springs and ties do not resist */
typedef struct {
  Simulation sim;
  PetscInt   nbodies, n;
  Vec        x;             /* coordinates of the nodes [length] */
  PetscReal *center, *size; /* 3 per body, 1 per body [length] */
  PetscReal *motion;        /* [6 nbodies n], orthonormal: for each body three translations, and three angles times
                               its size */
} FreeMotions;

PETSC_INTERN PetscErrorCode FreeMotionsCreate(Simulation, FreeMotions *);
PETSC_INTERN PetscErrorCode FreeMotionsDisplace(const FreeMotions *, const PetscReal motion[], Vec w);
PETSC_INTERN PetscErrorCode FreeMotionsSum(const FreeMotions *, Vec force, PetscReal motion[]);
PETSC_INTERN PetscErrorCode FreeMotionsDestroy(FreeMotions *);

/* diagnose_equilibrium.c */
PETSC_INTERN PetscErrorCode EquilibriumDiagnose(Simulation, PetscReal time, Vec load, StepReport *, PetscBool *none);

/* forces.c: forces and moments by pair, by face and by body */
PETSC_INTERN PetscErrorCode ForcesReserve(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasurePairs(Simulation, Vec u, Vec weighted, Vec shear, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasureFaces(Simulation, Vec u, Vec reaction, Vec ties, Vec rigid, StepReport *);
PETSC_INTERN PetscErrorCode ForcesMeasureBodies(Simulation, Vec u, Vec load, Vec ties, PetscReal rounding,
  StepReport *);
PETSC_INTERN PetscErrorCode ForcesFree(StepReport *);

/* nodal_pressure.c: smooths the values of vertices at the edge of the other side's covered area, face by face:
   [area, force, gap x area] per vertex */
PETSC_INTERN PetscErrorCode NodalPressureEvenOut(Simulation, const SceneContactPair *, Vec carried);

/* contact_points.c: pressure, gap and status on both sides of every pair: sim->solved->points, and the report */
PETSC_INTERN PetscErrorCode ContactPointsMeasure(Simulation, StepReport *);

/* penetration.c: penetration of vertices; gaps of mortar pairs are means */
PETSC_INTERN PetscErrorCode PenetrationMeasure(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode PenetrationWarn(Simulation);

/* pair_mesh.c, strain.c: warnings about too coarse contact meshes, and about strains too large for small-strain laws */
PETSC_INTERN PetscErrorCode PairMeshWarn(Simulation);
PETSC_INTERN PetscErrorCode StrainWarn(Simulation, PetscInt step);

/* rigid_places.c */
PETSC_INTERN PetscErrorCode RigidPlacesMeasure(Simulation, StepReport *);

/* work.c */
PETSC_INTERN PetscErrorCode WorkWarn(Simulation, const StepReport *);
PETSC_INTERN PetscErrorCode WorkAdd(Simulation, Vec load, Vec u, Vec unbalanced, Vec rigid, Vec *contact, StepReport *);

/* results.c */
PETSC_INTERN PetscErrorCode ResultsComplete(const PetscReal stress[6], PetscReal values[STRESS_VALUES]);
PETSC_INTERN PetscErrorCode ResultsMeasure(Simulation);
PETSC_INTERN PetscErrorCode ResultsFree(Results *);

/* probes.c */
PETSC_INTERN PetscErrorCode ProbesCreate(DM, Scene, Probes *);
PETSC_INTERN PetscErrorCode ProbesMeasure(Simulation, StepReport *);
PETSC_INTERN PetscErrorCode ProbesDestroy(Probes *);

/* measure.c */
PETSC_INTERN PetscErrorCode MeasureState(Simulation, PetscReal time, Vec load, Vec inertia, Vec u,
  const ContactSolution *, StepReport *);

/* motion.c */
PETSC_INTERN PetscErrorCode MotionMeasure(Simulation, Vec u, StepReport *);

/* initial_contact.c */
PETSC_INTERN PetscErrorCode StartWarn(Simulation, ContactLinearization);
PETSC_INTERN PetscErrorCode StartWarnOfUnmet(Simulation);

#endif
