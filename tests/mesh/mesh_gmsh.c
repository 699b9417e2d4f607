static char help[] = "Gmsh files: a sound one, and every way in which one is not; one sentence each, the same on every "
                     "rank, and no hang.\n\n";

#include <scene.h>
#include <mesh.h>
#include "../lib/attempt.h"

/* Two unit cubes in a row */
static const char sound[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                            "$PhysicalNames\n3\n3 1 \"bar\"\n2 2 \"left\"\n2 3 \"right\"\n$EndPhysicalNames\n"
                            "$Nodes\n12\n"
                            "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
                            "9 2 0 0\n10 2 1 0\n11 2 0 1\n12 2 1 1\n$EndNodes\n"
                            "$Elements\n4\n"
                            "1 3 2 2 1 1 4 8 5\n2 3 2 3 2 9 10 12 11\n"
                            "3 5 2 1 1 1 2 3 4 5 6 7 8\n4 5 2 1 1 2 9 10 3 6 11 12 7\n$EndElements\n";

static const char tets[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
  "$Elements\n2\n1 2 2 2 1 1 2 3\n2 4 2 1 1 1 2 3 4\n$EndElements\n";

static const char inside_out[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
  "$Elements\n2\n1 2 2 2 1 1 2 3\n2 4 2 1 1 2 1 3 4\n$EndElements\n";

/* The same, curved: the edge from 2 to 3 bulges */
static const char tets10[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .6 .6 0\n7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 "
  ".5\n$EndNodes\n"
  "$Elements\n2\n1 9 2 2 1 1 2 3 5 6 7\n2 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";

/* Sound at its nodes, inside out between them, where it is integrated */
static const char inside_out10[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .147 .316 -.144\n6 .67 .869 .09\n7 .153 .706 -.301\n8 .398 -.185 "
  ".194\n9 .02 .143 .425\n10 .728 .267 .442\n$EndNodes\n"
  "$Elements\n2\n1 9 2 2 1 1 2 3 5 6 7\n2 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";

/* A tetrahedron on a cube, of one volume */
static const char both[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 .5 .5 2\n$EndNodes\n"
  "$Elements\n3\n1 3 2 2 1 1 4 8 5\n2 5 2 1 1 1 2 3 4 5 6 7 8\n3 4 2 1 1 5 6 7 9\n$EndElements\n";

static const char hex20[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n20\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 0 0 2\n6 2 0 2\n7 2 2 2\n8 0 2 2\n9 1 0 0\n10 0 1 0\n11 0 0 1\n12 "
  "2 1 0\n13 2 0 1\n14 1 2 0\n15 2 2 1\n16 0 2 1\n17 1 0 2\n18 0 1 2\n19 2 1 2\n20 1 2 2\n$EndNodes\n"
  "$Elements\n2\n2 16 2 2 1 1 4 8 5 10 16 18 11\n1 17 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 "
  "20\n$EndElements\n";

static const char hex27[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n27\n1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 0 0 2\n6 2 0 2\n7 2 2 2\n8 0 2 2\n9 1 0 0\n10 0 1 0\n11 0 0 1\n12 "
  "2 1 0\n13 2 0 1\n14 1 2 0\n15 2 2 1\n16 0 2 1\n17 1 0 2\n18 0 1 2\n19 2 1 2\n20 1 2 2\n21 1 1 0\n22 1 0 1\n23 0 1 "
  "1\n24 2 1 1\n25 1 2 1\n26 1 1 2\n27 1 1 1\n$EndNodes\n"
  "$Elements\n2\n2 10 2 2 1 1 4 8 5 10 16 18 11 23\n1 12 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 "
  "22 23 24 25 26 27\n$EndElements\n";

static const char flat[] =
  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"bar\"\n2 2 \"left\"\n$EndPhysicalNames\n"
  "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n1\n1 3 2 2 1 1 2 3 4\n$EndElements\n";

typedef struct {
  const char *name;
  const char *change, *by; /* text of the sound file, and what replaces it; by NULL: the file ends there */
  const char *scene;       /* more of the scene, after the body */
} Mistake;

#define HELD "displacements:\n  - wall: {face: bar.left, value: [0, 0, 0]}\n"

static const Mistake mistakes[] = {
  {"sound", "bar", "bar", HELD},
  {"no file", sound, NULL, HELD},
  {"empty file", sound, "\n", HELD},
  {"not a mesh", sound, "just a sentence\n", HELD},
  {"truncated in the names", "\"right\"", NULL, HELD},
  {"truncated in the nodes", "11 2 0 1", NULL, HELD},
  {"truncated in the elements", "4 5 2 1 1", NULL, HELD},
  {"truncated in an element", "11 12 7\n", NULL, HELD},
  {"no such volume", "\"bar\"", "\"rod\"", HELD},
  {"no names", "3\n3 1 \"bar\"\n2 2 \"left\"\n2 3 \"right\"\n", "0\n", HELD},
  {"volume without cells", "3 1 \"bar\"", "3 7 \"bar\"", HELD},
  {"no such surface", "\"left\"", "\"port\"", HELD},
  {"surface that is not of the body", "1 3 2 2 1 1 4 8 5\n", "1 3 2 3 1 1 4 8 5\n", HELD},
  {"surface inside the body", "1 3 2 2 1 1 4 8 5\n", "1 3 2 2 1 2 3 7 6\n", HELD},
  {"surface that is no facet", "1 3 2 2 1 1 4 8 5\n", "1 3 2 2 1 1 3 8 5\n", HELD},
  {"tetrahedra", sound, tets, HELD},
  {"10-node tetrahedra", sound, tets10, HELD},
  {"inverted tetrahedron", sound, inside_out, HELD},
  {"10-node tetrahedron, inside out between its nodes", sound, inside_out10, HELD},
  {"a tetrahedron among hexahedra", sound, both, HELD},
  {"a prism among hexahedra", "2 3 2 3 2 9 10 12 11\n3 5 2 1 1 1 2 3 4 5 6 7 8\n4 5 2 1 1 2 9 10 3 6 11 12 7",
    "2 3 2 3 2 2 9 11 6\n3 5 2 1 1 1 2 3 4 5 6 7 8\n4 6 2 1 1 2 9 3 6 11 7", HELD},
  {"20-node hexahedra", sound, hex20, HELD},
  {"27-node hexahedra", sound, hex27, HELD},
  {"no volumes at all", sound, flat, HELD},
  {"inverted element", "2 9 10 3 6 11 12 7", "6 11 12 7 2 9 10 3", HELD},
  {"twisted element", "9 2 0 0\n", "9 2 0 1.5\n", HELD},
  {"node given twice", "12 2 1 1\n", "11 2 1 1\n", HELD},
  {"node that does not exist", "11 12 7\n", "11 99 7\n", HELD},
  {"node twice in an element", "11 12 7\n", "11 12 11\n", HELD},
  {"element given twice", "$Elements\n4\n", "$Elements\n5\n5 5 2 1 1 2 9 10 3 6 11 12 7\n", HELD},
  {"two nodes at one place", "12\n1 0 0 0\n", "13\n13 1 1 1\n1 0 0 0\n", HELD},
  {"two nodes at one place, used",
    "12 2 1 1\n$EndNodes\n$Elements\n4\n1 3 2 2 1 1 4 8 5\n2 3 2 3 2 9 10 12 11\n3 5 2 1 1 1 2 3 4 5 6 7 8\n4 5 2 1 1 "
    "2 9 10 3 6 11 12 7",
    "13 1 1 1\n$EndNodes\n$Elements\n3\n1 3 2 2 1 1 4 8 5\n3 5 2 1 1 1 2 3 4 5 6 7 8\n4 5 2 1 1 2 9 10 3 6 11 13 7",
    HELD},
  {"part of an unknown face", "bar", "bar", "faces:\n  - part: {of: bar.top}\n" HELD},
  {"part of an unknown body", "bar", "bar", "faces:\n  - part: {of: rod.left}\n" HELD},
  {"empty part", "bar", "bar", "faces:\n  - part: {of: bar.left, lower: [-inf, 2, -inf]}\n" HELD},
  {"part with a taken name", "bar", "bar", "faces:\n  - right: {of: bar.left}\n" HELD},
  {"bound that is no number", "bar", "bar", "faces:\n  - part: {of: bar.left, lower: [-inf, low, -inf]}\n" HELD},
  {"part that holds the body", "bar", "bar",
    "faces:\n  - part: {of: bar.left, upper: [0, 1, inf]}\ndisplacements:\n  - wall: {face: bar.part, value: [0, 0, "
    "0]}\n"},
  {"not held", "bar", "bar", "displacements:\n  - wall: {face: bar.left, value: [0, free, free]}\n"},
};

static PetscErrorCode WriteText(const char file[], size_t n, const char text[], const char rest[])
{
  FILE *stream;

  PetscFunctionBeginUser;
  PetscCall(PetscFOpen(PETSC_COMM_SELF, file, "w", &stream));
  (void)fwrite(text, 1, n, stream);
  (void)fputs(rest, stream);
  PetscCall(PetscFClose(PETSC_COMM_SELF, stream));
  PetscFunctionReturn(0);
}

static PetscErrorCode WriteFiles(const Mistake *mistake)
{
  static const char body[] = "problem: bar\nbodies:\n  - bar: {mesh: bar.msh, volume: bar, young: 1, poisson: 0.3}\n";
  PetscMPIInt       rank;
  size_t            length;
  char             *where, *rest;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) {
    PetscCall(PetscStrstr(sound, mistake->change, &where));
    PetscCheck(where, PETSC_COMM_SELF, PETSC_ERR_PLIB, "The sound mesh does not hold \"%s\"", mistake->change);
    PetscCall(PetscStrlen(mistake->change, &length));
    (void)remove("bar.msh");
    if (mistake->by) {
      PetscCall(PetscMalloc1(sizeof(sound) + strlen(mistake->by), &rest));
      (void)snprintf(rest, sizeof(sound) + strlen(mistake->by), "%s%s", mistake->by, where + length);
      PetscCall(WriteText("bar.msh", (size_t)(where - sound), sound, rest));
      PetscCall(PetscFree(rest));
    } else if (where > sound) PetscCall(WriteText("bar.msh", (size_t)(where - sound), sound, ""));
    PetscCall(WriteText("bar.yaml", sizeof(body) - 1, body, mistake->scene));
  }
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode LoadAndMesh(void)
{
  Scene scene;
  DM    dm;

  PetscFunctionBeginUser;
  PetscCall(SceneLoad(PETSC_COMM_WORLD, "bar.yaml", &scene));
  PetscCall(MeshCreate(PETSC_COMM_WORLD, scene->nbodies, scene->bodies, 1, &dm));
  PetscCall(MeshCheckScene(dm, scene));
  PetscCall(DMDestroy(&dm));
  PetscCall(SceneDestroy(&scene));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(mistakes); ++i) {
    PetscErrorCode ierr;

    PetscCall(WriteFiles(&mistakes[i]));
    PetscCall(AttemptBegin());
    ierr = LoadAndMesh();
    PetscCall(AttemptEnd());
    PetscCall(AttemptCompareRanks(mistakes[i].name, ierr));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %s\n", mistakes[i].name, ierr ? attempt_sentence : "a mesh"));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}
      args: -malloc_dump 0
      filter: sed -e "s|complete Gmsh mesh: .*|complete Gmsh mesh|"
      output_file: output/mesh_gmsh_1.out

TEST*/
