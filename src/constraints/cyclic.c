/*
   Cyclic symmetry. Only a sector of the body is modelled, which ends on two faces. Each node of the second face is the
   image of a node of the first one: x2 = c + R (x1 - c), where the rotation R has the sector's angle. Its displacement
   is u2 = R u1, also at finite strain. A node on the axis is its own image and can move along the axis only.
*/
#include "constraintsimpl.h"
#include <vector3.h>

/* The second face of one cyclic symmetry */
typedef struct {
  PetscInt  n, *nodes, *images; /* number of its nodes; nodes; nodes of the first face whose images they are */
  PetscReal turn[3][3];         /* R minus the identity */
} CyclicImages;

/* Inserts the rows u2 = R u1 of one pair of faces into Y, except for nodes on the axis */
static PetscErrorCode CyclicAdd(const CyclicImages *cut, Mat Y, PetscInt first, const PetscBool kept[],
  PetscBool follows[])
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < 3 * cut->n; ++k) {
    const PetscInt node = cut->nodes[k / 3], image = cut->images[k / 3], i = k % 3;

    if (node == image) continue;
    follows[3 * (node - first) + i] = PETSC_TRUE;
    if (kept && kept[3 * (node - first) + i]) continue;
    for (PetscInt j = 0; j < 3; ++j) {
      const PetscReal value = cut->turn[i][j] + (i == j ? 1.0 : 0.0);

      if (PetscAbsReal(value) > 1e-14) PetscCall(MatSetValue(Y, 3 * node + i, 3 * image + j, value, INSERT_VALUES));
    }
  }
  PetscFunctionReturn(0);
}

/* Creates the matrix Y of u = Y x. cuts: images of each cyclic symmetry; kept: rows that remain unit rows, or NULL;
   images: becomes true in the rows of the second faces */
static PetscErrorCode CyclicBuild(const Constraints *c, const CyclicImages cuts[], const PetscBool kept[], Mat *Y,
  PetscBool images[])
{
  PetscInt n, rstart;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &rstart, NULL));
  PetscCall(MatCreateAIJ(c->bodies.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 3, NULL, Y));
  PetscCall(PetscArrayzero(images, n));
  for (PetscInt k = 0; k < c->bodies.scene->ncyclic; ++k) PetscCall(CyclicAdd(&cuts[k], *Y, rstart / 3, kept, images));
  for (PetscInt i = 0; i < n; ++i) {
    if (!images[i] || (kept && kept[i])) PetscCall(MatSetValue(*Y, rstart + i, rstart + i, 1.0, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*Y, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*Y, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Raises an error if a displacement is prescribed at a node of the second face that does not agree with the
   displacement of its image */
static PetscErrorCode CyclicCheckPrescribed(const Constraints *c, Mat Y, const PetscBool prescribed[],
  const PetscBool images[])
{
  static const PetscReal weight[3] = {1.0, 1.618, 2.718}; /* values that no rotation between the sectors maps to zero */
  Vec                    given, image, free, reach;
  const PetscScalar     *u, *v, *w;
  PetscScalar           *a;
  PetscInt               n;
  static const PetscReal same   = 1e-4; /* rotations of nodes with coordinates of five digits agree to this fraction */
  PetscReal              worst  = 0.0, largest;
  PetscBool              differ = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(MatCreateVecs(Y, &given, &image));
  PetscCall(VecDuplicate(given, &free));
  PetscCall(VecDuplicate(image, &reach));
  PetscCall(VecZeroEntries(given));
  PetscCall(PrescribedApply(c->prescribed, (PetscReal)c->bodies.scene->nsteps, given));
  PetscCall(VecNorm(given, NORM_INFINITY, &largest));
  PetscCall(VecGetLocalSize(given, &n));
  PetscCall(VecGetArrayWrite(free, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = prescribed[i] ? 0.0 : weight[i % 3];
  PetscCall(VecRestoreArrayWrite(free, &a));
  PetscCall(MatMult(Y, given, image));
  PetscCall(MatMult(Y, free, reach));
  PetscCall(VecGetArrayRead(given, &u));
  PetscCall(VecGetArrayRead(image, &v));
  PetscCall(VecGetArrayRead(reach, &w));
  for (PetscInt i = 0; i < n; ++i) {
    if (!prescribed[i] || !images[i]) continue;
    differ = (PetscBool)(differ || PetscAbsScalar(w[i]) > 1e-12);
    worst  = PetscMax(worst, PetscAbsScalar(u[i] - v[i]));
  }
  PetscCall(VecRestoreArrayRead(reach, &w));
  PetscCall(VecRestoreArrayRead(image, &v));
  PetscCall(VecRestoreArrayRead(given, &u));
  differ = (PetscBool)(differ || worst > same * largest);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &differ, 1, MPI_PETSCBOOL, MPI_LOR, c->bodies.comm));
  PetscCheck(!differ, c->bodies.comm, PETSC_ERR_USER_INPUT,
    "cyclic symmetry: the displacements that are prescribed on a face of the cut are not the same in every sector: "
    "prescribe all three components, or only the one along the axis");
  PetscCall(VecDestroy(&reach));
  PetscCall(VecDestroy(&free));
  PetscCall(VecDestroy(&image));
  PetscCall(VecDestroy(&given));
  PetscFunctionReturn(0);
}

/* Creates the matrix Y of u = Y x for all cyclic symmetries; NULL if there are none. Prescribed rows remain unit
   rows. */
PetscErrorCode CyclicCreate(const Constraints *c, const PetscBool prescribed[], Mat *Y, PetscBool follows[])
{
  const Scene   scene = c->bodies.scene;
  PetscInt      n;
  PetscBool    *images;
  CyclicImages *cuts;
  Mat           all;

  PetscFunctionBegin;
  *Y = NULL;
  if (!scene->ncyclic) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(scene->ncyclic, &cuts));
  for (PetscInt k = 0; k < scene->ncyclic; ++k)
    PetscCall(
      MeshGetCyclicImages(c->bodies.dm, &scene->cyclic[k], cuts[k].turn, &cuts[k].n, &cuts[k].nodes, &cuts[k].images));
  PetscCall(VecGetLocalSize(c->bodies.mass, &n));
  PetscCall(PetscMalloc1(n, &images));
  PetscCall(CyclicBuild(c, cuts, NULL, &all, images));
  PetscCall(CyclicCheckPrescribed(c, all, prescribed, images));
  PetscCall(MatDestroy(&all));
  PetscCall(CyclicBuild(c, cuts, prescribed, Y, images));
  for (PetscInt i = 0; i < n; ++i) follows[i] = (PetscBool)(follows[i] || (images[i] && !prescribed[i]));
  for (PetscInt k = 0; k < scene->ncyclic; ++k) {
    PetscCall(PetscFree(cuts[k].nodes));
    PetscCall(PetscFree(cuts[k].images));
  }
  PetscCall(PetscFree(cuts));
  PetscCall(PetscFree(images));
  PetscFunctionReturn(0);
}

/* Collects the nodes on the axis by their local numbers, and computes two unit normals of the axis */
PetscErrorCode CyclicGetAxisNodes(const Constraints *c, const SceneCyclic *cut, PetscInt *n, PetscInt **nodes,
  PetscReal normals[2][3])
{
  PetscInt  m, first, least = 0, *images;
  PetscReal turn[3][3], axis[3] = {cut->axis[0], cut->axis[1], cut->axis[2]};

  PetscFunctionBegin;
  (void)VectorScaleToUnit(axis);
  for (PetscInt d = 1; d < 3; ++d) least = PetscAbsReal(axis[d]) < PetscAbsReal(axis[least]) ? d : least;
  for (PetscInt d = 0; d < 3; ++d) normals[0][d] = (d == least ? 1.0 : 0.0) - axis[least] * axis[d];
  (void)VectorScaleToUnit(normals[0]);
  VectorCross(axis, normals[0], normals[1]);
  PetscCall(MeshGetCyclicImages(c->bodies.dm, cut, turn, &m, nodes, &images));
  PetscCall(VecGetOwnershipRange(c->bodies.mass, &first, NULL));
  *n = 0;
  for (PetscInt k = 0; k < m; ++k) {
    if ((*nodes)[k] == images[k]) (*nodes)[(*n)++] = images[k] - first / 3;
  }
  PetscCall(PetscFree(images));
  PetscFunctionReturn(0);
}
