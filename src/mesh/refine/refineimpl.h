/*
   Refinement, uniform and local, of hexahedra and of the curves they lie on.
*/
#ifndef REFINEIMPL_H
#define REFINEIMPL_H

#include "src/mesh/query/queryimpl.h"

/* refine_uniform.c: so many uniform refinements of a mesh in place */
PETSC_INTERN PetscErrorCode MeshRefine(DM *, PetscInt levels);

/* hexahedra.c: hexahedra on one rank, some refined more often than others; of a mesh whose cells are their roots */
typedef struct {
  PetscInt  ncells, *vertex; /* 8 a cell, in tensor order */
  PetscInt *root, *place;    /* 4 numbers a cell: where in its root the lower corner is, in cells of its size, and how
                                often the root was refined */
  PetscInt  nvertices, maxvertices,
    *parent;                /* 4 a vertex: those that it was made amid, on an edge or a side; the others are negative */
  PetscReal             *x; /* 3 a vertex, as the mesh has them */
  PetscInt               nplaced; /* the first so many vertices have been placed: refine_inverted.c */
  PetscReal             *placed;  /* 3 a vertex, where they are with all vertices on the curves */
  struct _n_MeshMiddles *middles;
} MeshHexes;
PETSC_INTERN PetscErrorCode MeshHexesCreate(DM, MeshHexes *);
PETSC_INTERN PetscErrorCode MeshHexesRefine(MeshHexes *, PetscBool marked[]);
PETSC_INTERN PetscErrorCode MeshHexesMarkHolders(const MeshHexes *, PetscBool marked[], PetscBool *any);
PETSC_INTERN PetscErrorCode MeshHexesFindHanging(const MeshHexes *, PetscBool hangs[]);
PETSC_INTERN PetscErrorCode MeshHexesDestroy(MeshHexes *);

/* refine_zones.c: what the scene refines */
PETSC_INTERN PetscErrorCode MeshHexesRefineZones(DM, const SceneBody[], PetscInt n, const SceneRefinement[],
  MeshHexes *);

/* curves.c: the quadratic cells of a mesh: [81 or 30 a cell of a quadratic body, 0 of others], carried along as it is
   distributed */
typedef struct {
  PetscSection section; /* NULL: no body has any */
  Vec          places;
} MeshCurves;
PETSC_INTERN PetscInt       MeshCurveSize(PetscInt ncorners);
PETSC_INTERN PetscErrorCode MeshCurvesCreate(DM level0, PetscInt nbodies, const MeshBody[], MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDistribute(PetscSF, DM distributed, MeshCurves *);
/* fine: the mesh that the curves belong to, refined. Moves its vertices onto them, or all its nodes; replaces them by
   those of its cells */
PETSC_INTERN PetscErrorCode MeshCurvesApply(const MeshCurves *, PetscInt levels, DM fine, PetscBool nodes);
PETSC_INTERN PetscErrorCode MeshCurvesRefine(PetscInt levels, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesPlacePart(const MeshCurves *, const MeshHexes *, PetscInt cell,
  PetscReal places[8][3]);
PETSC_INTERN PetscErrorCode MeshCurvesCutOut(const MeshHexes *, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDestroy(MeshCurves *);

/* refine_inverted.c: refines so that fine cells are not inverted */
PETSC_INTERN PetscErrorCode MeshHexesRefineInverted(DM, const SceneBody[], const MeshCurves *, MeshHexes *);

/* hanging.c: vertices amid an edge or a side of a cell; what is carried along as the mesh is distributed, and what
   becomes of it */
typedef struct {
  PetscSection section; /* NULL: there was no local refinement */
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

/* refine_local.c: local refinement, in place; the mesh is that of the first rank, with its curves */
typedef struct {
  PetscInt               nzones;
  const SceneRefinement *zones;
  const MeshMarks       *marks; /* NULL: there will be none */
} MeshLocalRefinement;
PETSC_INTERN PetscErrorCode MeshRefineLocally(const MeshLocalRefinement *, const SceneBody[], DM *, MeshCurves *,
  MeshHanging *);

#endif
