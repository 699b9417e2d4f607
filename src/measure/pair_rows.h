/* Rows of one contact pair, and values at their vertices; used by the files that measure contact. */
#ifndef PAIR_ROWS_H
#define PAIR_ROWS_H

#include "measureimpl.h"

/*
   The rows of one pair. Row A exerts the force z_A w_A n_A on its own side, with w_A n_A = mass_A x sum of J_AB over
   the mortar vertices B; w_A is the area that the mortar side covers around A. Rows of other pairs have w = 0. Areas
   are distributed to vertices by lin->cover, whose sum times share_A is w_A, with the normal n_A.
*/
typedef struct {
  PetscInt   n;
  PetscReal *area, *share, *normal; /* w [length^2]; normal: 3 per row */
  PetscReal *pressure, *gap, *closed;
  PetscReal *presses;    /* closed before unresolved pressures were smoothed */
  PetscReal  young;      /* Young's modulus of the softer body [force/length^2] */
  PetscReal *own;        /* size of the facets around the row [length] */
  PetscReal *facing;     /* size of the mortar facets that the row faces [length] */
  PetscReal *length;     /* facet size that the row's gap is compared with: that of the coarser side if only that side
                         is resolved */
  PetscBool  frictional; /* the pair has friction */
  PetscReal *slips;      /* 1: the row slips */
  PetscReal *shear,
    *slid; /* friction stress on the mortar side [force/length^2], and slip [length]; component c of row A stands at
              c n + A */
} PairRows;

/* pair_rows.c */
PETSC_INTERN PetscBool      PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length);
PETSC_INTERN PetscErrorCode PairRowsCreate(Simulation, PetscInt pair, PairRows *);
PETSC_INTERN PetscErrorCode PairRowsDestroy(PairRows *);

/* pair_spread.c: from rows to vertices and back, in proportion to the shared area. sides: first value of a vertex: 1
   mortar side, -1 nonmortar side, 0 neither */
PETSC_INTERN PetscErrorCode PairMarkSides(Simulation, PetscInt pair, Vec sides);
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
