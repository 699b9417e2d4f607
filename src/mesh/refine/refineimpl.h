/*
   Refinement: uniform, and local of hexahedra; curves of quadratic cells.
*/
#ifndef REFINEIMPL_H
#define REFINEIMPL_H

#include "src/mesh/query/queryimpl.h"

/* refine_uniform.c: refines a mesh uniformly, in place */
PETSC_INTERN PetscErrorCode MeshRefine(DM *, PetscInt levels);

/* hexahedra.c: hexahedra on one rank, some refined more than others; their roots are the cells of the original mesh */
typedef struct {
  PetscInt  ncells, *vertex; /* 8 vertices per cell, in tensor order */
  PetscInt *root, *place;    /* root: original cell; place: 4 numbers per cell: position of its lower corner in the
                                root, in units of its size, and its level */
  PetscInt  nvertices, maxvertices,
    *parent;                      /* 4 per vertex: those in whose middle it was created, on an edge or side; otherwise
                               negative */
  PetscReal             *x;       /* 3 coordinates per vertex, as in the original mesh */
  PetscInt               nplaced; /* number of vertices with positions in `placed` (refine_inverted.c) */
  PetscReal             *placed;  /* 3 coordinates per vertex with all vertices on the curves */
  struct _n_MeshMiddles *middles;
} MeshHexes;
PETSC_INTERN PetscErrorCode MeshHexesCreate(DM, MeshHexes *);
PETSC_INTERN PetscErrorCode MeshHexesRefine(MeshHexes *, PetscBool marked[]);
PETSC_INTERN PetscErrorCode MeshHexesMarkHolders(const MeshHexes *, PetscBool marked[], PetscBool *any);
PETSC_INTERN PetscErrorCode MeshHexesFindHanging(const MeshHexes *, PetscBool hangs[]);
PETSC_INTERN PetscErrorCode MeshHexesDestroy(MeshHexes *);

/* refine_zones.c: zones of the scene */
PETSC_INTERN PetscErrorCode MeshHexesRefineZones(DM, const SceneBody[], PetscInt n, const SceneRefinement[],
  MeshHexes *);

/* curves.c: quadratic nodes of cells, 81 or 30 coordinates per cell of a quadratic body, 0 for others; distributed
   with the mesh */
typedef struct {
  PetscSection section; /* NULL: no body is quadratic */
  Vec          places;
} MeshCurves;
PETSC_INTERN PetscInt       MeshCurveSize(PetscInt ncorners);
PETSC_INTERN PetscErrorCode MeshCurvesCreate(DM level0, PetscInt nbodies, const MeshBody[], MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDistribute(PetscSF, DM distributed, MeshCurves *);
/* fine: the refined mesh of the curves. Apply: moves its vertices, or all its nodes, onto the curves; Refine:
   replaces the curves by those of the refined cells */
PETSC_INTERN PetscErrorCode MeshCurvesApply(const MeshCurves *, PetscInt levels, DM fine, PetscBool nodes);
PETSC_INTERN PetscErrorCode MeshCurvesRefine(PetscInt levels, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesPlacePart(const MeshCurves *, const MeshHexes *, PetscInt cell,
  PetscReal places[8][3]);
PETSC_INTERN PetscErrorCode MeshCurvesCutOut(const MeshHexes *, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDestroy(MeshCurves *);

/* refine_inverted.c: refines so that fine cells are not inverted */
PETSC_INTERN PetscErrorCode MeshHexesRefineInverted(DM, const SceneBody[], const MeshCurves *, MeshHexes *);

/* hanging.c: hanging vertices; data distributed with the mesh, and the result */
typedef struct {
  PetscSection section; /* NULL: no local refinement */
  PetscInt    *numbers;
} MeshHanging;
PETSC_INTERN PetscErrorCode MeshHangingCreate(const MeshHexes *, DM, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingDistribute(PetscSF, DM before, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingFinish(DM, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingPlace(DM);
PETSC_INTERN PetscErrorCode MeshHangingDestroy(MeshHanging *);

/* refine_marked.c: marked cells */
PETSC_INTERN PetscErrorCode MeshNumberCells(DM, const MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHexesRefineMarks(const MeshMarks *, DM, const SceneBody[], const MeshCurves *,
  MeshHexes *);

/* refine_local.c: local refinement in place, of the mesh on the first rank and its curves */
typedef struct {
  PetscInt               nzones;
  const SceneRefinement *zones;
  const MeshMarks       *marks; /* NULL: no marks */
} MeshLocalRefinement;
PETSC_INTERN PetscErrorCode MeshRefineLocally(const MeshLocalRefinement *, const SceneBody[], DM *, MeshCurves *,
  MeshHanging *);

#endif
