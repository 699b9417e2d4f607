#ifndef MESH_PRIVATE_H
#define MESH_PRIVATE_H

#include "shape.h"

/* Number within DMPlex's hexahedron of the vertex at each corner i + 2 j + 4 k */
PETSC_INTERN const PetscInt MeshHexTensorOrder[8];

/* Name of the label of a body's face */
PETSC_INTERN PetscErrorCode MeshFaceLabelName(const char body[], const char face[], size_t length, char name[]);

/* Names with commas, or the word none, cut off at size */
PETSC_INTERN PetscErrorCode MeshListNames(PetscInt n, char *const names[], size_t size, char text[]);

/* Maps the vertices of bodies with curved refinement (or those without) from the shapes' parameters to space */
PETSC_INTERN PetscErrorCode MeshMapVertices(DM, PetscInt nbodies, const SceneBody[], PetscBool curved);
/* Collective error if a cell is inverted or flat at one of its corners; mapped: also in bodies that are mapped after refinement */
PETSC_INTERN PetscErrorCode MeshCheckCells(DM, PetscInt nbodies, const SceneBody[], PetscBool mapped);

/* Labels of the faces' parts that bodies name, at level 0; not collective, on the rank that has the body. first: the first vertex.
   empty: index of a part without facets, or PETSC_DECIDE */
PETSC_INTERN PetscErrorCode MeshLabelSubfaces(DM, const SceneBody *, const ShapeGrid *, PetscInt first, PetscInt *empty);

/* A Gmsh file, read on rank 0; bodies that come from one file one after another share it */
typedef struct {
  const char *name;
  DM          dm; /* NULL on the other ranks */
} GmshFile;

/* Not collective: what is wrong with the file's form and numbers, in a sentence of so many characters, or "" */
PETSC_INTERN PetscErrorCode GmshCheckFile(const char file[], size_t length, char sentence[]);
/* All collective. Names are in the order of the file, as MeshGetFaceNames() gives those of surfaces; tags may be NULL */
PETSC_INTERN PetscErrorCode GmshGetPhysicalNames(MPI_Comm, const SceneBody *, PetscInt dim, PetscInt *n, char ***names, PetscInt **tags);
/* Error if the file has no physical volume of the body's name */
PETSC_INTERN PetscErrorCode GmshCheckVolume(MPI_Comm, const SceneBody *);
PETSC_INTERN PetscErrorCode GmshFileOpen(MPI_Comm, const SceneBody *, GmshFile *);
PETSC_INTERN PetscErrorCode GmshFileGetGrid(MPI_Comm, GmshFile *, const SceneBody *, ShapeGrid *);
PETSC_INTERN PetscErrorCode GmshFileClose(GmshFile *);

#endif
