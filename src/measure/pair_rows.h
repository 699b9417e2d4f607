/* Rows of one contact pair, and their values at vertices. Used by the files that measure contact. */
#ifndef PAIR_ROWS_H
#define PAIR_ROWS_H

#include "measureimpl.h"

/*
   The rows of one pair. Row A exerts the force z_A w_A n_A on its own side, where w_A n_A = mass_A x sum of J_AB over
   the mortar vertices B. w_A is the area that the mortar side covers around A; it is zero in rows of other pairs. Areas
   are distributed to vertices by lin->cover, whose sum times covered_A is w_A, with the normal n_A.
*/
typedef struct {
  PetscInt   n;
  PetscReal *area, *covered, *normal; /* w [length^2]; see above; n, 3 numbers per row */
  PetscReal *pressure, *gap, *closed;
  PetscReal *presses;    /* closed before the pressures were smoothed by pair_resolve.c */
  PetscReal  young;      /* Young's modulus of the softer body [force/length^2] */
  PetscReal *own;        /* size of the facets around the row [length] */
  PetscReal *facing;     /* size of the mortar facets that the row faces [length] */
  PetscReal *length;     /* facet size with which the row's gap is compared: the row's own, or that of the mortar
                            side if only the mortar side's means are resolved [length] */
  PetscBool  self;       /* both sides are the same face, which is in contact with itself */
  PetscBool  frictional; /* the pair has friction */
  PetscReal *slips;      /* 1 if the row slips, otherwise 0 */
  PetscReal *shear,
    *slid; /* friction stress on the mortar side [force/length^2]; slip [length]; component c of row A has the index
              c n + A */
} PairRows;

/* pair_rows.c */
PETSC_INTERN PetscBool      PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length);
PETSC_INTERN PetscErrorCode PairRowsCreate(Simulation, PetscInt pair, PairRows *);
PETSC_INTERN PetscErrorCode PairRowsDestroy(PairRows *);

/*
   pair_spread.c: transfers values from rows to vertices and back, in proportion to the shared area. The vector `sides`
   has three values per vertex. The first is 1 at vertices of the mortar side, -1 on the nonmortar side, and 0
   elsewhere.
*/
PETSC_INTERN PetscErrorCode PairMarkSides(Simulation, PetscInt pair, const PairRows *, Vec sides);
PETSC_INTERN PetscErrorCode PairMarkFace(DM, const char face[], PetscInt component, PetscInt to, Vec);
PETSC_INTERN Mat            PairCover(ContactLinearization);
PETSC_INTERN PetscErrorCode PairSpread(Simulation, const PairRows *, const PetscReal value[], Vec sides, PetscInt to,
  Vec v);
PETSC_INTERN PetscErrorCode PairGather(Simulation, const PairRows *, Vec sides, Vec v, PetscInt from,
  PetscReal value[]);

/* pair_mesh.c */
PETSC_INTERN PetscErrorCode PairMeshMeasure(Simulation, PetscInt pair, const PairRows *, PetscInt first, PairReport *);

/* pair_resolve.c */
PETSC_INTERN PetscErrorCode PairRowsResolve(Simulation, PetscInt pair, Vec sides, PairRows *);

#endif
