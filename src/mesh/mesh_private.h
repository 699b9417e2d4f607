#ifndef MESH_PRIVATE_H
#define MESH_PRIVATE_H

#include <mesh.h>

/* Number within DMPlex's hexahedron of the vertex at each corner i + 2 j + 4 k */
PETSC_INTERN const PetscInt MeshHexTensorOrder[8];

#endif
