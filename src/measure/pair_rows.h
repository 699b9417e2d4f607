/* Rows of one contact pair, and their values at nodes. Used by the files that measure contact. */
#ifndef PAIR_ROWS_H
#define PAIR_ROWS_H

#include "measureimpl.h"

/* Values of rows. Those before ROW_SUMS are summed at nodes, weighted by the area that rows and nodes share; the sums
   of those before ROW_EVEN are agglomerated and smoothed (nodal_pressure.c). */
typedef enum {
  ROW_ONE, /* 1; its sums are areas [length^2] */
  ROW_GAP,
  ROW_PRESSURE,
  ROW_SHEAR, /* components of the friction stress on the mortar side [force/length^2] */
  ROW_EVEN    = ROW_SHEAR + 3,
  ROW_PRESSES = ROW_EVEN, /* 1 if the row is closed before the pressures are smoothed by pair_resolve.c, otherwise 0 */
  ROW_CLOSED,
  ROW_LENGTH,   /* facet size with which the gap is compared: the row's own, or that of the mortar side if only the
                   mortar side's means are resolved [length] */
  ROW_STRETCH,  /* stretch of the faces since the linearization, by which areas are multiplied */
  ROW_SLIPPING, /* pressure of slipping rows, otherwise 0 */
  ROW_SLID,     /* components of the slip [length] */
  ROW_SUMS = ROW_SLID + 3,
  ROW_AREA = ROW_SUMS, /* w [length^2] */
  ROW_COVERED,         /* w / |mass_A x sum of cover_AB| */
  ROW_OWN,             /* size of the facets around the row [length] */
  ROW_FACING,          /* size of the mortar facets that the row faces [length] */
  ROW_VALUES
} RowValue;

/*
   The rows of one pair. Row A exerts the force z_A w_A n_A on its own side, where w_A n_A = mass_A x sum of J_AB over
   the mortar nodes B. w_A is the area that the mortar side covers around A; it is zero in rows of other pairs. A vector
   of nodes has one value per node, in the order of global vectors.
*/
typedef struct {
  PetscInt   n;
  Vec       *value;          /* [ROW_VALUES] one value per row */
  PetscReal *normal;         /* n, 3 numbers per row */
  PetscReal  young;          /* Young's modulus of the softer body [force/length^2] */
  PetscBool  self;           /* both sides are the same face, which is in contact with itself */
  PetscBool  frictional;     /* the pair has friction */
  Mat        shares, mortar; /* rows x nodes: the area that a row and a node share [length^2]; the same of the mortar
                                side, if both sides are the same face */
  Vec        sides;          /* of each node: 1 on the mortar side, -1 on the nonmortar side, 0 elsewhere */
  Vec        gathered;       /* 1 at nodes of the mortar side, otherwise 0. All nodes of a face in contact with itself
                                count as mortar nodes. */
} PairRows;

/* pair_rows.c */
PETSC_INTERN PetscBool      PairIsClosed(PetscReal pressure, PetscReal gap, PetscReal young, PetscReal length);
PETSC_INTERN PetscErrorCode PairRowsCreate(const Measured *, PetscInt pair, PairRows *);
PETSC_INTERN PetscErrorCode PairRowsDestroy(PairRows *);
PETSC_INTERN PetscErrorCode PairGather(const PairRows *, Vec node, Vec row);

/* pair_resolve.c */
PETSC_INTERN PetscErrorCode PairRowsResolve(const Measured *, PetscInt pair, PairRows *);

/* nodal_pressure.c: the facets of both faces of a pair, those of the nonmortar face first. Facets of order 2 are
   divided at their nodes. */
typedef struct {
  PetscInt     n, nnonmortar;
  PetscInt    *offset;  /* [4 n] offset of each corner's values in local vectors */
  PetscScalar *value;   /* [16 n] what each facet adds to `between`, for each pair of its corners */
  Mat          between; /* nodes x nodes */
} PairFacets;

PETSC_INTERN PetscErrorCode PairFacetsCreate(MPI_Comm, DM, const VertexPlaces *, const SceneContactPair *,
  PairFacets *);
PETSC_INTERN PetscErrorCode PairFacetsDestroy(PairFacets *);
PETSC_INTERN PetscErrorCode PairFacetsMeasure(Elasticity, const VertexPlaces *, PetscInt nfaces,
  const char *const faces[], Vec size);
PETSC_INTERN PetscErrorCode PairFacetsJoin(PairFacets *, PetscInt n);
PETSC_INTERN PetscErrorCode NodalPressureEvenOut(DM, Elasticity, const VertexPlaces *, const SceneContactPair *,
  PairFacets *, PetscInt n, Vec values[], const PetscBool smooth[]);

/* pair_mesh.c. closed: 1 at nodes that are closed, otherwise 0 */
PETSC_INTERN PetscErrorCode PairMeshMeasure(const PairRows *, PairFacets *, Vec closed, PairReport *);

#endif
