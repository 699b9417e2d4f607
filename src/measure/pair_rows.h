/* Rows of one contact pair, and their values at nodes. Used by the files that measure contact. */
#ifndef PAIR_ROWS_H
#define PAIR_ROWS_H

#include "measureimpl.h"

/*
   The rows of one pair. Row A exerts the force z_A w_A n_A on its own side, where w_A n_A = mass_A x sum of J_AB over
   the mortar nodes B. w_A is the area that the mortar side covers around A; it is zero in rows of other pairs. A vector
   of nodes has one value per node, in the order of global vectors.
*/
typedef struct {
  PetscInt   n;
  PetscReal *area, *covered, *normal; /* w [length^2]; w / |mass_A x sum of cover_AB|; n, 3 numbers per row */
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
  Mat shares, mortar; /* rows x nodes: the area that a row and a node share [length^2]; the same of the mortar side,
                         if both sides are the same face */
  Vec sides;          /* of each node: 1 on the mortar side, -1 on the nonmortar side, 0 elsewhere */
  Vec row, node;      /* work vectors */
} PairRows;

/* pair_rows.c. PairSpread(): value NULL: 1 */
PETSC_INTERN PetscBool      PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length);
PETSC_INTERN PetscErrorCode PairRowsCreate(Simulation, PetscInt pair, PairRows *);
PETSC_INTERN PetscErrorCode PairRowsDestroy(PairRows *);
PETSC_INTERN PetscErrorCode PairSpread(const PairRows *, const PetscReal value[], Vec node);
PETSC_INTERN PetscErrorCode PairGather(const PairRows *, Vec node, PetscReal value[]);

/* pair_resolve.c */
PETSC_INTERN PetscErrorCode PairRowsResolve(Simulation, PetscInt pair, PairRows *);

/* nodal_pressure.c: the facets of both faces of a pair, those of the nonmortar face first. Facets of order 2 are
   divided at their nodes. */
typedef struct {
  PetscInt     n, nnonmortar;
  PetscInt    *offset;  /* [4 n] offset of each corner's values in local vectors */
  PetscScalar *value;   /* [16 n] what each facet adds to `between`, for each pair of its corners */
  Mat          between; /* nodes x nodes */
} PairFacets;

PETSC_INTERN PetscErrorCode PairFacetsCreate(Simulation, const SceneContactPair *, PairFacets *);
PETSC_INTERN PetscErrorCode PairFacetsDestroy(PairFacets *);
PETSC_INTERN PetscErrorCode PairFacetsMeasure(Simulation, PetscInt nfaces, const char *const faces[], Vec size);
PETSC_INTERN PetscErrorCode PairFacetsJoin(PairFacets *, PetscInt n);
PETSC_INTERN PetscErrorCode NodalPressureEvenOut(Simulation, const SceneContactPair *, PairFacets *, PetscInt n,
  Vec values[], const PetscBool smooth[]);

/* pair_mesh.c. closed: 1 at nodes that are closed, otherwise 0 */
PETSC_INTERN PetscErrorCode PairMeshMeasure(Simulation, const PairRows *, PairFacets *, Vec closed, PairReport *);

#endif
