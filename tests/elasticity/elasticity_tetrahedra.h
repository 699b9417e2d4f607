/* Boxes of tetrahedra for the tests of hexahedra: each cell of a box is cut into six, as a Gmsh file that the box is
   read from */
#ifndef ELASTICITY_TETRAHEDRA_H
#define ELASTICITY_TETRAHEDRA_H

#include <mesh.h>

/* Number of the vertex (i, j, k) of a box, from 1 */
static inline PetscInt TetrahedraVertex(const SceneBody *box, PetscInt i, PetscInt j, PetscInt k)
{
  return 1 + i + (box->cells[0] + 1) * (j + (box->cells[1] + 1) * k);
}

static inline void TetrahedraWriteNodes(FILE *stream, const SceneBody *box)
{
  const PetscInt *n = box->cells;

  fprintf(stream, "$Nodes\n%" PetscInt_FMT "\n", (n[0] + 1) * (n[1] + 1) * (n[2] + 1));
  for (PetscInt k = 0; k <= n[2]; ++k) {
    for (PetscInt j = 0; j <= n[1]; ++j) {
      for (PetscInt i = 0; i <= n[0]; ++i) {
        const PetscInt at[3] = {i, j, k};

        fprintf(stream, "%" PetscInt_FMT, TetrahedraVertex(box, i, j, k));
        for (PetscInt d = 0; d < 3; ++d)
          fprintf(stream, " %.17g",
            (double)(box->lower[d] + (box->upper[d] - box->lower[d]) * (PetscReal)at[d] / (PetscReal)n[d]));
        fputs("\n", stream);
      }
    }
  }
  fputs("$EndNodes\n", stream);
}

/* The six of a cell, all with its diagonal, each along the three axes in another order (H. Freudenthal 1942): those
   of neighbours meet in whole triangles */
static inline void TetrahedraWriteCell(FILE *stream, const SceneBody *box, const PetscInt at[3], PetscInt *element)
{
  static const PetscInt order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

  for (PetscInt t = 0; t < 6; ++t) {
    PetscInt corner[3] = {at[0], at[1], at[2]}, vertex[4];

    vertex[0] = TetrahedraVertex(box, corner[0], corner[1], corner[2]);
    for (PetscInt s = 0; s < 3; ++s) {
      ++corner[order[t][s]];
      vertex[1 + s] = TetrahedraVertex(box, corner[0], corner[1], corner[2]);
    }
    fprintf(stream,
      "%" PetscInt_FMT " 4 2 7 1 %" PetscInt_FMT " %" PetscInt_FMT " %" PetscInt_FMT " %" PetscInt_FMT "\n", ++*element,
      vertex[0], vertex[t < 3 ? 1 : 2], vertex[t < 3 ? 2 : 1], vertex[3]);
  }
}

/* The two triangles of a quadrilateral on side 2 d + end */
static inline void TetrahedraWriteFacet(FILE *stream, const SceneBody *box, PetscInt side, PetscInt i, PetscInt j,
  PetscInt *element)
{
  const PetscInt d = side / 2, s = (d + 1) % 3, t = (d + 2) % 3;

  for (PetscInt half = 0; half < 2; ++half) {
    PetscInt at[3][3], vertex[3];

    for (PetscInt a = 0; a < 3; ++a) {
      at[a][d]  = side % 2 ? box->cells[d] : 0;
      at[a][s]  = i + (a == 2 || (a == 1 && !half) ? 1 : 0);
      at[a][t]  = j + (a == 2 || (a == 1 && half) ? 1 : 0);
      vertex[a] = TetrahedraVertex(box, at[a][0], at[a][1], at[a][2]);
    }
    fprintf(stream, "%" PetscInt_FMT " 2 2 %" PetscInt_FMT " 1 %" PetscInt_FMT " %" PetscInt_FMT " %" PetscInt_FMT "\n",
      ++*element, 1 + side, vertex[0], vertex[1], vertex[2]);
  }
}

static inline void TetrahedraWriteElements(FILE *stream, const SceneBody *box)
{
  const PetscInt *n       = box->cells;
  PetscInt        element = 0;

  fprintf(stream, "$Elements\n%" PetscInt_FMT "\n",
    6 * n[0] * n[1] * n[2] + 4 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]));
  for (PetscInt side = 0; side < 6; ++side) {
    for (PetscInt j = 0; j < n[(side / 2 + 2) % 3]; ++j) {
      for (PetscInt i = 0; i < n[(side / 2 + 1) % 3]; ++i) TetrahedraWriteFacet(stream, box, side, i, j, &element);
    }
  }
  for (PetscInt c = 0; c < n[0] * n[1] * n[2]; ++c) {
    const PetscInt at[3] = {c % n[0], c / n[0] % n[1], c / (n[0] * n[1])};

    TetrahedraWriteCell(stream, box, at, &element);
  }
  fputs("$EndElements\n", stream);
}

/* Writes the box as NAME.msh, which is from now on its mesh */
static inline PetscErrorCode TetrahedraFromBox(SceneBody *box)
{
  static char file[4][64];
  static int  nfiles = 0;
  char       *name   = file[nfiles++ % 4];
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(PetscSNPrintf(name, sizeof(file[0]), "%s.msh", box->name));
  if (rank == 0) {
    FILE *stream = NULL;

    PetscCall(PetscFOpen(PETSC_COMM_SELF, name, "w", &stream));
    fprintf(stream,
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n7\n2 1 \"xmin\"\n2 2 \"xmax\"\n2 3 \"ymin\"\n2 4 "
      "\"ymax\"\n2 5 \"zmin\"\n2 6 \"zmax\"\n3 7 \"%s\"\n$EndPhysicalNames\n",
      box->name);
    TetrahedraWriteNodes(stream, box);
    TetrahedraWriteElements(stream, box);
    PetscCall(PetscFClose(PETSC_COMM_SELF, stream));
  }
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  box->shape       = SHAPE_GMSH;
  box->gmsh.file   = name;
  box->gmsh.volume = box->name;
  PetscFunctionReturn(0);
}

#endif
