/*
   Serendipity hexahedra: hexahedra of 20 nodes. They are hexahedra of 27 nodes whose nodes in the middle of the sides
   and of the cell depend on the others, such that the displacement is that of 20 nodes.
*/
#include "refineimpl.h"

/* key under which the matrix of all dependent nodes is composed with the mesh */
#define MESH_DEPENDENT "dependent"

/*
   Sets the row of the node at a point of the mesh, a side or a cell: the weight of each of its vertices is -1/4, that
   of each node in the middle of an edge 1/2 on a side and 1/4 in a cell.
*/
static PetscErrorCode SerendipitySetRow(DM dm, PetscInt point, PetscReal edges, Mat dependent)
{
  PetscSection global;
  PetscInt     offset, npoints, *closure = NULL, vstart, vend, estart, eend;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(PetscSectionGetOffset(global, point, &offset));
  if (offset < 0) PetscFunctionReturn(0);
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  PetscCall(DMPlexGetDepthStratum(dm, 1, &estart, &eend));
  PetscCall(DMPlexGetTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  for (PetscInt i = 0; i < npoints; ++i) {
    const PetscInt p = closure[2 * i];
    PetscInt       from;

    if (!(p >= vstart && p < vend) && !(p >= estart && p < eend)) continue;
    PetscCall(PetscSectionGetOffset(global, p, &from));
    PetscCall(MatSetValue(dependent, offset / 3, (from < 0 ? -(from + 1) : from) / 3,
      p < vend && p >= vstart ? -0.25 : edges, INSERT_VALUES));
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  PetscFunctionReturn(0);
}

static PetscErrorCode SerendipitySetRows(DM dm, const SceneBody bodies[], Mat dependent)
{
  PetscInt cstart, cend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    const PetscInt *sides;
    PetscInt        b, nsides;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &b));
    PetscCall(DMPlexGetConeSize(dm, c, &nsides));
    if (!bodies[b].serendipity || nsides != 6) continue;
    PetscCall(DMPlexGetCone(dm, c, &sides));
    for (PetscInt s = 0; s < nsides; ++s) PetscCall(SerendipitySetRow(dm, sides[s], 0.5, dependent));
    PetscCall(SerendipitySetRow(dm, c, 0.25, dependent));
  }
  PetscFunctionReturn(0);
}

/* Collective. Composes the matrix of the dependent nodes of serendipity hexahedra and of hanging vertices with the
   mesh. The unknowns and the hanging vertices must be known. */
PetscErrorCode MeshSerendipityFinish(DM dm, PetscInt nbodies, const SceneBody bodies[])
{
  PetscInt  n;
  PetscBool any = PETSC_FALSE;
  Mat       hanging, dependent;
  Vec       u;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) any = (PetscBool)(any || bodies[b].serendipity);
  PetscCall(MeshGetHanging(dm, &hanging));
  if (!any) {
    if (hanging) PetscCall(PetscObjectCompose((PetscObject)dm, MESH_DEPENDENT, (PetscObject)hanging));
    PetscFunctionReturn(0);
  }
  PetscCall(DMGetGlobalVector(dm, &u));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(DMRestoreGlobalVector(dm, &u));
  PetscCall(MatCreateAIJ(PetscObjectComm((PetscObject)dm), n / 3, n / 3, PETSC_DETERMINE, PETSC_DETERMINE, 20, NULL, 20,
    NULL, &dependent));
  PetscCall(SerendipitySetRows(dm, bodies, dependent));
  PetscCall(MatAssemblyBegin(dependent, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(dependent, MAT_FINAL_ASSEMBLY));
  if (hanging) PetscCall(MatAXPY(dependent, 1.0, hanging, DIFFERENT_NONZERO_PATTERN));
  PetscCall(PetscObjectCompose((PetscObject)dm, MESH_DEPENDENT, (PetscObject)dependent));
  PetscCall(MatDestroy(&dependent));
  PetscFunctionReturn(0);
}

/*
   Gets the matrix of the nodes that depend on others: hanging vertices, and the nodes in the middle of sides and cells
   of serendipity hexahedra. dependent: a square AIJ matrix with one row and one column per node, owned by the mesh. The
   row of such a node has the weights of the nodes on which it depends; none of these is dependent. Other rows are
   empty. NULL if there is no dependent node.
*/
PetscErrorCode MeshGetDependent(DM dm, Mat *dependent)
{
  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)dm, MESH_DEPENDENT, (PetscObject *)dependent));
  PetscFunctionReturn(0);
}
