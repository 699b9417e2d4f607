/*
   Symmetry planes in inclined directions: n . u = 0 at their nodes. Nodes on the axis of a cyclic symmetry are on two
   such planes. At each node one component per plane is made dependent on the others, by Gauss-Jordan elimination. The
   components with the largest coefficients are chosen, except those that are prescribed.
*/
#include "constraintsimpl.h"
#include <vector3.h>

typedef struct {
  PetscInt  n;       /* number of planes through the node */
  PetscReal a[3][3]; /* unit normals of the planes */
} NodePlanes;

/* Lists the planes at each node of this rank */
static PetscErrorCode PlanesCollect(const Constraints *constraints, PetscInt rstart, NodePlanes nodes[])
{
  PetscFunctionBegin;
  for (PetscInt d = 0; d < constraints->bodies.scene->ndisplacements; ++d) {
    const SceneDisplacement *plane = &constraints->bodies.scene->displacements[d];
    IS                       is;
    const PetscInt          *rows;
    const PetscReal         *m      = plane->normal;
    const PetscReal          length = VectorNorm(m);
    PetscInt                 n;

    if (!plane->inclined) continue;
    PetscCall(MeshGetFaceDofs(constraints->bodies.dm, plane->face, 0, &is));
    PetscCall(ISGetLocalSize(is, &n));
    PetscCall(ISGetIndices(is, &rows));
    for (PetscInt k = 0; k < n; ++k) {
      NodePlanes *node = &nodes[(rows[k] - rstart) / 3];

      if (node->n == 3) continue;
      for (PetscInt c = 0; c < 3; ++c) node->a[node->n][c] = m[c] / length;
      ++node->n;
    }
    PetscCall(ISRestoreIndices(is, &rows));
    PetscCall(ISDestroy(&is));
  }
  for (PetscInt k = 0; k < constraints->bodies.scene->ncyclic; ++k) {
    PetscInt  n, *on;
    PetscReal normals[2][3];

    PetscCall(CyclicGetAxisNodes(constraints, &constraints->bodies.scene->cyclic[k], &n, &on, normals));
    for (PetscInt i = 0; i < 2 * n; ++i) {
      NodePlanes *node = &nodes[on[i / 2]];

      if (node->n == 3) continue;
      PetscCall(PetscArraycpy(node->a[node->n++], normals[i % 2], 3));
    }
    PetscCall(PetscFree(on));
  }
  PetscFunctionReturn(0);
}

/* Chooses the dependent component of each plane by Gauss-Jordan elimination. pivot[p]: that component; -1 if no
   component is left for plane p */
static void PlanesEliminate(NodePlanes *node, const PetscBool prescribed[3], PetscInt pivot[3])
{
  const PetscReal rounding = 1e-10;
  PetscBool       taken[3] = {prescribed[0], prescribed[1], prescribed[2]};

  for (PetscInt p = 0; p < node->n; ++p) {
    PetscInt k = -1;

    for (PetscInt c = 0; c < 3; ++c) {
      if (!taken[c] && PetscAbsReal(node->a[p][c]) > rounding &&
          (k < 0 || PetscAbsReal(node->a[p][c]) > PetscAbsReal(node->a[p][k])))
        k = c;
    }
    pivot[p] = k;
    if (k < 0) continue;
    taken[k] = PETSC_TRUE;
    for (PetscInt c = 0; c < 3; ++c) {
      if (c != k) node->a[p][c] /= node->a[p][k];
    }
    node->a[p][k] = 1.0;
    for (PetscInt q = 0; q < node->n; ++q) {
      const PetscReal factor = node->a[q][k];

      for (PetscInt c = 0; q != p && c < 3; ++c) node->a[q][c] -= factor * node->a[p][c];
    }
  }
}

/* Creates the matrix of u = C x for the planes alone, and marks dependent rows in `follows`. given: prescribed
   displacements at the end of the load program. It is an error if they move a node off a plane. */
static PetscErrorCode PlanesExpand(const Constraints *constraints, NodePlanes nodes[], const PetscBool prescribed[],
  Vec given, Mat *C, PetscBool follows[])
{
  PetscInt           nlocal, rstart;
  PetscReal          worst = 0.0, size;
  const PetscScalar *u;

  PetscFunctionBegin;
  PetscCall(VecGetLocalSize(given, &nlocal));
  PetscCall(VecGetOwnershipRange(given, &rstart, NULL));
  PetscCall(VecNorm(given, NORM_INFINITY, &size));
  PetscCall(VecGetArrayRead(given, &u));
  PetscCall(
    MatCreateAIJ(constraints->bodies.comm, nlocal, nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 3, NULL, 0, NULL, C));
  for (PetscInt i = 0; i < nlocal; i += 3) {
    PetscInt pivot[3] = {-1, -1, -1};

    PlanesEliminate(&nodes[i / 3], &prescribed[i], pivot);
    for (PetscInt p = 0; p < nodes[i / 3].n; ++p) {
      PetscReal off = 0.0;

      if (pivot[p] >= 0) follows[i + pivot[p]] = PETSC_TRUE;
      for (PetscInt c = 0; c < 3; ++c) off += prescribed[i + c] ? nodes[i / 3].a[p][c] * PetscRealPart(u[i + c]) : 0.0;
      if (pivot[p] < 0) worst = PetscMax(worst, PetscAbsReal(off));
      for (PetscInt c = 0; pivot[p] >= 0 && c < 3; ++c) {
        if (c != pivot[p] && nodes[i / 3].a[p][c] != 0.0)
          PetscCall(MatSetValue(*C, rstart + i + pivot[p], rstart + i + c, -nodes[i / 3].a[p][c], INSERT_VALUES));
      }
    }
    for (PetscInt c = 0; c < 3; ++c) {
      if (!follows[i + c]) PetscCall(MatSetValue(*C, rstart + i + c, rstart + i + c, 1.0, INSERT_VALUES));
    }
  }
  PetscCall(VecRestoreArrayRead(given, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPIU_REAL, MPIU_MAX, constraints->bodies.comm));
  PetscCheck(worst <= 1e-9 * size, constraints->bodies.comm, PETSC_ERR_USER_INPUT,
    "symmetry: prescribed displacements move vertices of a symmetry plane off the plane by %g: prescribe "
    "displacements along the plane only",
    (double)worst);
  PetscCall(MatAssemblyBegin(*C, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*C, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Creates the matrix C of inclined symmetry planes; NULL if there are none. prescribed, follows: for each row of this
   rank, whether its displacement is prescribed, and whether it depends on others by C */
PetscErrorCode PlanesCreate(const Constraints *constraints, const PetscBool prescribed[], Mat *C, PetscBool follows[])
{
  PetscInt    n, rstart;
  PetscBool   any = PETSC_FALSE;
  NodePlanes *nodes;
  Vec         given;

  PetscFunctionBegin;
  *C = NULL;
  for (PetscInt d = 0; d < constraints->bodies.scene->ndisplacements; ++d)
    any = (PetscBool)(any || constraints->bodies.scene->displacements[d].inclined);
  if (!any && !constraints->bodies.scene->ncyclic) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(constraints->bodies.mass, &n));
  PetscCall(VecGetOwnershipRange(constraints->bodies.mass, &rstart, NULL));
  PetscCall(PetscCalloc1(n / 3, &nodes));
  PetscCall(PlanesCollect(constraints, rstart, nodes));
  PetscCall(VecDuplicate(constraints->bodies.mass, &given));
  PetscCall(VecZeroEntries(given));
  PetscCall(PrescribedApply(constraints->prescribed, (PetscReal)constraints->bodies.scene->nsteps, given));
  PetscCall(PlanesExpand(constraints, nodes, prescribed, given, C, follows));
  PetscCall(VecDestroy(&given));
  PetscCall(PetscFree(nodes));
  PetscFunctionReturn(0);
}
