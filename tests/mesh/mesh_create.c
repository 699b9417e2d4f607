static char help[] =
  "Mesh of two boxes: sizes, faces, outward facets, labels of shared vertices, balance of the partition.\n\n";

#include "../lib/elasticity_problem.h"
#include <petscsf.h>

static const char *const sides[] = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};

/* Facets of a face: number, area vector over the outward vertex order */
static PetscErrorCode CheckFacets(DM dm, const char face[], PetscInt axis, PetscReal sign, PetscInt64 *count)
{
  IS              facets;
  const PetscInt *f;
  PetscInt        n;
  PetscReal       area[3] = {0, 0, 0}, other;

  PetscFunctionBeginUser;
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt  v[4];
    PetscReal p[4][3];

    PetscCall(MeshGetFacetVertices(dm, f[i], v));
    PetscCall(MeshGetVertexCoordinates(dm, 4, v, p));
    for (PetscInt d = 0; d < 3; ++d) {
      const PetscInt s = (d + 1) % 3, t = (d + 2) % 3;

      area[d] += 0.5 * ((p[2][s] - p[0][s]) * (p[3][t] - p[1][t]) - (p[2][t] - p[0][t]) * (p[3][s] - p[1][s]));
    }
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  *count = n;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, area, 3, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 1, MPIU_INT64, MPI_SUM, PETSC_COMM_WORLD));
  other = PetscAbsReal(area[(axis + 1) % 3]) + PetscAbsReal(area[(axis + 2) % 3]);
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "  area %g outward%s", (double)(sign * area[axis]),
    other > 1e-12 ? ", NOT flat" : ""));
  PetscFunctionReturn(0);
}

/* The face's vertices are exactly the local ones that lie on it, also where no facet of it is on this rank */
static PetscErrorCode CheckVertices(DM dm, const char face[], const SceneBody *body, PetscInt axis, PetscReal plane,
  PetscInt *wrong)
{
  IS       vertices;
  PetscInt vstart, vend;

  PetscFunctionBeginUser;
  *wrong = 0;
  PetscCall(MeshGetFaceVertices(dm, face, &vertices));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  for (PetscInt v = vstart; v < vend; ++v) {
    PetscReal p[1][3];
    PetscInt  place;
    PetscBool on = PETSC_TRUE;

    PetscCall(MeshGetVertexCoordinates(dm, 1, &v, p));
    for (PetscInt d = 0; d < 3; ++d)
      on = (on && p[0][d] > body->lower[d] - 1e-10 && p[0][d] < body->upper[d] + 1e-10) ? PETSC_TRUE : PETSC_FALSE;
    on = (on && PetscAbsReal(p[0][axis] - plane) < 1e-10) ? PETSC_TRUE : PETSC_FALSE;
    PetscCall(ISLocate(vertices, v, &place));
    if (on != (place >= 0)) ++*wrong;
  }
  PetscCall(ISDestroy(&vertices));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, wrong, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckFaces(DM dm, const SceneBody *body)
{
  PetscFunctionBeginUser;
  for (PetscInt s = 0; s < 6; ++s) {
    char       face[64];
    IS         rows;
    PetscInt64 nfacets;
    PetscInt   ndofs, wrong;

    PetscCall(PetscSNPrintf(face, sizeof(face), "%s.%s", body->name, sides[s]));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s", face));
    PetscCall(CheckFacets(dm, face, s / 2, s % 2 ? 1 : -1, &nfacets));
    PetscCall(CheckVertices(dm, face, body, s / 2, s % 2 ? body->upper[s / 2] : body->lower[s / 2], &wrong));
    PetscCall(MeshGetFaceDofs(dm, face, 1, &rows));
    PetscCall(ISGetSize(rows, &ndofs));
    PetscCall(ISDestroy(&rows));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
      "  facets %" PetscInt64_FMT "  rows of one component %" PetscInt_FMT
      "  vertices wrongly on or off it %" PetscInt_FMT "\n",
      nfacets, ndofs, wrong));
  }
  PetscFunctionReturn(0);
}

/* Cells a body, volume from the tensor order of the vertices, fewest and most cells a rank */
static PetscErrorCode CheckCells(DM dm, PetscInt nbodies)
{
  PetscInt    start, end, fewest, most, counts[2] = {0, 0};
  PetscMPIInt size;
  PetscReal   volume = 0, smallest = PETSC_MAX_REAL;

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt  v[8], body;
    PetscReal p[8][3], e[3][3], det;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    PetscCheck(body >= 0 && body < nbodies, PETSC_COMM_SELF, PETSC_ERR_PLIB,
      "Cell %" PetscInt_FMT " has body %" PetscInt_FMT, c, body);
    ++counts[body];
    PetscCall(MeshGetCellVertices(dm, c, v));
    PetscCall(MeshGetVertexCoordinates(dm, 8, v, p));
    for (PetscInt k = 0; k < 3; ++k) {
      for (PetscInt d = 0; d < 3; ++d) e[k][d] = p[1 << k][d] - p[0][d];
    }
    det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    volume += det;
    smallest = PetscMin(smallest, det);
    for (PetscInt d = 0; d < 3; ++d) {
      const PetscReal opposite = p[0][d] + e[0][d] + e[1][d] + e[2][d];

      PetscCheck(PetscAbsReal(p[7][d] - opposite) < 1e-10, PETSC_COMM_SELF, PETSC_ERR_PLIB,
        "Cell %" PetscInt_FMT " is not in tensor order", c);
    }
  }
  fewest = most = end - start;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &fewest, 1, MPIU_INT, MPI_MIN, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPIU_INT, MPI_MAX, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPIU_REAL, MPIU_MIN, PETSC_COMM_WORLD));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "cells %" PetscInt_FMT " + %" PetscInt_FMT ", volume %g, %s\n", counts[0],
    counts[1], (double)volume, smallest > 0 ? "all of positive volume" : "SOME TURNED INSIDE OUT"));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "partition: %s\n",
    fewest > 0 && most < 1.1 * (counts[0] + counts[1]) / size ? "no rank has 10% more cells than its share"
                                                              : "OUT OF BALANCE"));
  PetscFunctionReturn(0);
}

/* METIS cuts the two-block mesh with a shorter interface than slices of the cell numbering ("simple") would */
static PetscErrorCode CheckInterface(DM dm, const SceneBody bodies[], PetscInt refine)
{
  DM          simple, meshes[2];
  PetscInt    shared[2];
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(PetscOptionsSetValue(NULL, "-petscpartitioner_type", "simple"));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, refine, &simple));
  PetscCall(PetscOptionsClearValue(NULL, "-petscpartitioner_type"));
  meshes[0] = dm;
  meshes[1] = simple;
  for (PetscInt m = 0; m < 2; ++m) {
    PetscSF sf;

    PetscCall(DMGetPointSF(meshes[m], &sf));
    PetscCall(PetscSFGetGraph(sf, NULL, &shared[m], NULL, NULL));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, shared, 2, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "interface: %s\n",
    size == 1 || shared[0] < shared[1] ? "smaller than that of slices" : "NOT smaller than that of slices"));
  PetscCall(DMDestroy(&simple));
  PetscFunctionReturn(0);
}

/* A facet whose vertices DMPlex stores the other way round is still seen from outside */
static PetscErrorCode CheckTurnedFacets(DM dm)
{
  IS              facets;
  const PetscInt *f;
  PetscInt        n;
  PetscInt64      count;

  PetscFunctionBeginUser;
  PetscCall(MeshGetFacets(dm, "slab.zmax", &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) PetscCall(DMPlexOrientPoint(dm, f[i], -1));
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "turned facets"));
  PetscCall(CheckFacets(dm, "slab.zmax", 2, 1, &count));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "\n"));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  DM        dm;
  Vec       u;
  SceneBody bodies[2];
  PetscInt  n, bs, refine = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-refine", &refine, NULL));
  PetscCall(ProblemBodies(MATERIAL_LINEAR, bodies));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, refine, &dm));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecGetSize(u, &n));
  PetscCall(VecGetBlockSize(u, &bs));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "unknowns %" PetscInt_FMT ", block size %" PetscInt_FMT "\n", n, bs));
  PetscCall(CheckCells(dm, 2));
  for (PetscInt b = 0; b < 2; ++b) PetscCall(CheckFaces(dm, &bodies[b]));
  PetscCall(CheckInterface(dm, bodies, refine));
  PetscCall(CheckTurnedFacets(dm));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&dm));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 5 2 3}}
      output_file: output/mesh_create_1.out

   # level 0 is refined before it is distributed
   test:
      suffix: 2
      nsize: {{2 7}}
      args: -refine 2
      output_file: output/mesh_create_2.out

TEST*/
