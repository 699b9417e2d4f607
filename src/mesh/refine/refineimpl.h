/* Refinement: uniform refinement, and local refinement of hexahedra; curves of quadratic cells. */
#ifndef REFINEIMPL_H
#define REFINEIMPL_H

#include "src/mesh/query/queryimpl.h"

/* refine_uniform.c: refines a mesh uniformly, and replaces it by the refined mesh */
PETSC_INTERN PetscErrorCode MeshRefine(DM *, PetscInt levels);

/* hexahedra.c: hexahedra on one rank, some refined more than others. The root of a hexahedron is the cell of the
   original mesh that contains it. */
typedef struct {
  PetscInt   ncells, *vertex; /* number of cells; [8 ncells] vertices, in tensor order */
  PetscInt  *root;            /* [ncells] root of each cell */
  PetscInt  *place;           /* [4 ncells] position of the cell's lower corner in its root, in units of the cell's
                          size, and the cell's level */
  PetscInt   nvertices, maxvertices; /* number of vertices, and space for vertices */
  PetscInt  *parent;  /* [4 nvertices] ends of the edge, or corners of the side, in whose middle the vertex was
                           created; -1 for none */
  PetscReal *x;       /* [3 nvertices] coordinates, as in the original mesh; parameters if the shape is curved */
  PetscInt   nplaced; /* number of vertices whose positions are in `placed` (refine_inverted.c) */
  PetscReal *placed;  /* [3 nplaced] coordinates with all vertices on the curves [length] */

  struct _n_MeshMiddles *middles;
} MeshHexes;
PETSC_INTERN PetscErrorCode MeshHexesCreate(DM, MeshHexes *);
PETSC_INTERN PetscErrorCode MeshHexesRefine(MeshHexes *, PetscBool marked[]);
PETSC_INTERN PetscErrorCode MeshHexesMarkHolders(const MeshHexes *, PetscBool marked[], PetscBool *any);
PETSC_INTERN PetscErrorCode MeshHexesFindHanging(const MeshHexes *, PetscBool hangs[]);
PETSC_INTERN PetscErrorCode MeshHexesDestroy(MeshHexes *);

/* refine_zones.c: refines the zones of the scene */
PETSC_INTERN PetscErrorCode MeshHexesRefineZones(DM, const SceneBody[], PetscInt n, const SceneRefinement[],
  MeshHexes *);

/* curves.c: the quadratic nodes of cells: 81 coordinates for a hexahedron or 30 for a tetrahedron of a quadratic body,
   none for other cells. They are distributed with the mesh. */
typedef struct {
  PetscSection section; /* NULL if no body is quadratic */
  Vec          places;  /* coordinates of the quadratic nodes [length] */
} MeshCurves;
PETSC_INTERN PetscInt       MeshCurveSize(PetscInt ncorners);
PETSC_INTERN PetscErrorCode MeshCurvesCreate(DM level0, PetscInt nbodies, const MeshBody[], MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDistribute(PetscSF, DM distributed, MeshCurves *);
/* fine: the mesh refined `levels` times. MeshCurvesApply() moves its vertices, or all its nodes, onto the curves.
   MeshCurvesRefine() replaces the curves by those of the refined cells. */
PETSC_INTERN PetscErrorCode MeshCurvesApply(const MeshCurves *, PetscInt levels, DM fine, PetscBool nodes);
PETSC_INTERN PetscErrorCode MeshCurvesRefine(PetscInt levels, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesPlacePart(const MeshCurves *, const MeshHexes *, PetscInt cell,
  PetscReal places[8][3]);
PETSC_INTERN PetscErrorCode MeshCurvesCutOut(const MeshHexes *, DM fine, MeshCurves *);
PETSC_INTERN PetscErrorCode MeshCurvesDestroy(MeshCurves *);

/* refine_inverted.c: refines coarser neighbours so that fine cells are not inverted */
PETSC_INTERN PetscErrorCode MeshHexesRefineInverted(DM, const SceneBody[], const MeshCurves *, MeshHexes *);

/* hanging.c: hanging vertices. The struct holds the data that are distributed with the mesh. */
typedef struct {
  PetscSection section; /* NULL if there is no local refinement */
  PetscInt    *numbers; /* see MeshHangingCreate() */
} MeshHanging;
PETSC_INTERN PetscErrorCode MeshHangingCreate(const MeshHexes *, DM, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingDistribute(PetscSF, DM before, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingFinish(DM, MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHangingPlace(DM);

/* serendipity.c: hexahedra of 20 nodes */
PETSC_INTERN PetscErrorCode MeshSerendipityFinish(DM, PetscInt nbodies, const SceneBody[]);

/* refine_marked.c: refines the cells that were marked on earlier meshes */
PETSC_INTERN PetscErrorCode MeshNumberCells(DM, const MeshHanging *);
PETSC_INTERN PetscErrorCode MeshHexesRefineMarks(const MeshMarks *, DM, const SceneBody[], const MeshCurves *,
  MeshHexes *);

/* refine_local.c: refines the mesh on the first rank locally, with its curves, and replaces it by the refined mesh */
typedef struct {
  PetscInt               nzones;
  const SceneRefinement *zones;
  const MeshMarks       *marks; /* NULL if there are no marks */
} MeshLocalRefinement;
PETSC_INTERN PetscErrorCode MeshRefineLocally(const MeshLocalRefinement *, const SceneBody[], DM *, MeshCurves *,
  MeshHanging *);

#endif
