/* Rows of one contact pair, and what their vertices have of them: shared by the files that measure contact. */
#ifndef PAIR_ROWS_H
#define PAIR_ROWS_H

#include "measureimpl.h"

/*
   The rows of one pair: row A pushes its own side by z_A w_A n_A, w_A n_A = mass_A sum of J_AB over the vertices B of
   the mortar side. w_A is the area that the mortar side covers about A. Rows of other pairs have w = 0. Over vertices
   it is shared as the cover is, of which w_A is share_A times the sum, along the normal n_A that the cover has.
*/
typedef struct {
  PetscInt   n;
  PetscReal *area, *share, *normal; /* w [length^2]; 3 a row */
  PetscReal *pressure, *gap, *closed;
  PetscReal *presses; /* closed before what the mortar side does not resolve was evened out */
  PetscReal  young;   /* of the softer body [force/length^2] */
  PetscReal *own;     /* size of the facets about the row [length] */
  PetscReal *facing;  /* size of the mortar side's facets that the row faces [length] */
  PetscReal *length;  /* of the facets that the row's gap is of; of the coarser side where it resolves no more */
  PetscBool  rubs;    /* the pair has friction */
  PetscReal *slips;   /* 1: its friction gives way */
  PetscReal *shear,
    *way; /* of friction, on the mortar side [force/length^2], and slip [length]; n values a component */
} PairRows;

/* pair_rows.c */
PETSC_INTERN PetscBool      PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length);
PETSC_INTERN PetscErrorCode PairRowsCreate(Simulation, PetscInt pair, PairRows *);
PETSC_INTERN PetscErrorCode PairRowsDestroy(PairRows *);

/* pair_spread.c: from rows to vertices and back, in proportion to the area that both share. sides: first value of a
   vertex 1 mortar side, -1 nonmortar side, 0 neither */
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
