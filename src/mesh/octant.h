/*
   Octants of shells and balls as O-grids.

   Parameters: a cube [0, 1]^3 with a corner at the octant's corner, whose three far sides (the patches) are extruded to the cube
   [0, 2]^3: there, with m the largest component, the point q = p/m of a far side gives a direction and s = m - 1 the place
   across the shell, 0 at its inner and 1 at its outer surface. Shells have no cells in [0, 1]^3, a ball has its core there.
*/
#ifndef MESH_OCTANT_H
#define MESH_OCTANT_H

#include "shape.h"

PETSC_INTERN const char *const *OctantFaces(const SceneBody *);
PETSC_INTERN PetscErrorCode OctantSize(MPI_Comm, const SceneBody *, PetscBool core, PetscInt64 *ncells, PetscInt64 *nvertices);
PETSC_INTERN PetscErrorCode OctantCreate(const SceneBody *, PetscBool core, ShapeGrid *);
/* q on the far sides of the unit cube and s, from parameters outside of the core */
PETSC_INTERN void OctantSplit(const PetscReal p[3], PetscReal q[3], PetscReal *s);
/* Unit vector of a point of the far sides, all components >= 0; equal steps along the cube's edges are equal angles */
PETSC_INTERN void OctantDirection(const PetscReal q[3], PetscReal direction[3]);
/* Place of a point given relative to the corner, all components >= 0 */
PETSC_INTERN void OctantPlace(const SceneBody *, const PetscReal relative[3], PetscReal x[3]);

#endif
