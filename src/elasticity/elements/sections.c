/*
   Sections through bodies for the pretension of bolts. The nodes of the body on one side of a plane are beyond the
   section. A cell with nodes on both sides is cut. In cut cells the displacement of nodes beyond the section is u +
   shortening x axis; in all other cells it is u. The body is thus cut along the faces between cut cells and the cells
   beyond, and the two sides are displaced relative to each other, without additional nodes.
   The force of the section is the derivative of the energy with respect to the shortening: the sum of the nodal forces,
   along the axis, of the cut cells' nodes beyond the section.
*/
#include "elementsimpl.h"
#include <mesh.h>
#include <vector3.h>

/* Sets the values of hanging nodes in `beyond` to the means of the values of the nodes on which they depend */
static PetscErrorCode SectionHang(Elasticity e, Vec beyond)
{
  Mat                means;
  Vec                node, mean;
  PetscInt           start, end;
  PetscScalar       *b, *v;
  const PetscScalar *m;

  PetscFunctionBegin;
  PetscCall(MeshGetDependent(e->dm, &means));
  if (!means) PetscFunctionReturn(0);
  PetscCall(MatCreateVecs(means, &node, &mean));
  PetscCall(MatGetOwnershipRange(means, &start, &end));
  PetscCall(VecGetArray(beyond, &b));
  PetscCall(VecGetArrayWrite(node, &v));
  for (PetscInt i = 0; i < end - start; ++i) v[i] = b[3 * i];
  PetscCall(VecRestoreArrayWrite(node, &v));
  PetscCall(MatMult(means, node, mean));
  PetscCall(VecGetArrayRead(mean, &m));
  for (PetscInt i = 0; i < end - start; ++i) {
    PetscInt n;

    PetscCall(MatGetRow(means, start + i, &n, NULL, NULL));
    if (n) b[3 * i] = m[i];
    PetscCall(MatRestoreRow(means, start + i, &n, NULL, NULL));
  }
  PetscCall(VecRestoreArrayRead(mean, &m));
  PetscCall(VecRestoreArray(beyond, &b));
  PetscCall(VecDestroy(&node));
  PetscCall(VecDestroy(&mean));
  PetscFunctionReturn(0);
}

/*
   Finds which local nodes are beyond the plane through `point` with normal `axis`. *sides: a local vector with 1 or 0
   in the first of three values per node.
*/
static PetscErrorCode SectionGetSides(Elasticity e, const PetscReal point[3], const PetscReal axis[3], Vec *sides)
{
  const PetscReal    rounding = 1e-10;
  const PetscScalar *x, *none;
  PetscScalar       *b;
  PetscReal          size = 0.0;
  Vec                beyond, local;

  PetscFunctionBegin;
  PetscCall(DMGetLocalVector(e->dm, sides));
  PetscCall(ElasticityGetLocals(e, NULL, &local, &none, &x));
  for (PetscInt i = 0; i < 3 * e->nnodes; ++i) size = PetscMax(size, PetscAbsScalar(x[i]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)e->dm)));
  PetscCall(VecGetArrayWrite(*sides, &b));
  for (PetscInt i = 0; i < 3 * e->nnodes; i += 3) {
    PetscReal along = 0.0;

    for (int d = 0; d < 3; ++d) along += axis[d] * (PetscRealPart(x[i + d]) - point[d]);
    b[i]     = along > rounding * size ? 1.0 : 0.0;
    b[i + 1] = b[i + 2] = 0.0;
  }
  PetscCall(VecRestoreArrayWrite(*sides, &b));
  PetscCall(ElasticityRestoreLocals(e, &local, &none, &x));
  PetscCall(DMGetGlobalVector(e->dm, &beyond));
  PetscCall(DMLocalToGlobal(e->dm, *sides, INSERT_VALUES, beyond));
  PetscCall(SectionHang(e, beyond));
  PetscCall(DMGlobalToLocal(e->dm, beyond, INSERT_VALUES, *sides));
  PetscCall(DMRestoreGlobalVector(e->dm, &beyond));
  PetscFunctionReturn(0);
}

/* Finds the cells of this rank that the last section cuts. *twice: another section cuts one of them already. */
static PetscErrorCode SectionCut(Elasticity e, const PetscScalar sides[], PetscInt *ncells, PetscBool *twice)
{
  const PetscInt s = e->nsections - 1;

  PetscFunctionBegin;
  *ncells = 0;
  *twice  = PETSC_FALSE;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt *nodes = e->cellnodes + e->cellstart[c], n = e->cellstart[c + 1] - e->cellstart[c];
    PetscReal       least = 1.0, most = 0.0;

    if (e->cellbody[c] != e->sections[s].body) continue;
    for (PetscInt a = 0; a < n; ++a) {
      least = PetscMin(least, PetscRealPart(sides[3 * nodes[a]]));
      most  = PetscMax(most, PetscRealPart(sides[3 * nodes[a]]));
    }
    if (most == least) continue;
    *twice = (PetscBool)(*twice || e->cellsection[c] >= 0);
    ++*ncells;
    e->cellsection[c] = s;
    e->cellbeyond[c]  = e->nbeyond;
    PetscCall(PetscRealloc((size_t)(e->nbeyond + n) * sizeof(*e->beyond), &e->beyond));
    for (PetscInt a = 0; a < n; ++a) e->beyond[e->nbeyond + a] = PetscRealPart(sides[3 * nodes[a]]);
    e->nbeyond += n;
  }
  PetscFunctionReturn(0);
}

/*@
  ElasticityAddSection - Adds a section through a body, for the pretension of a bolt

  Collective

  Input Parameters:
+ e     - the context
. body  - number of the body
. point - a point of the plane [length]
- axis  - normal of the plane, of any length but 0

  Output Parameter:
. ncells - number of cells that the plane cuts, on all ranks; negative: another section also cuts one of them

  Level: beginner

.seealso: `ElasticitySetShortening()`, `ElasticityGetSectionForces()`
@*/
PetscErrorCode ElasticityAddSection(Elasticity e, PetscInt body, const PetscReal point[3], const PetscReal axis[3],
  PetscInt *ncells)
{
  const PetscReal    length = VectorNorm(axis);
  BodySection       *section;
  const PetscScalar *s;
  PetscBool          twice;
  Vec                sides;

  PetscFunctionBegin;
  PetscCall(PetscRealloc((size_t)(e->nsections + 1) * sizeof(*e->sections), &e->sections));
  section  = &e->sections[e->nsections++];
  *section = (BodySection){.body = body, .axis = {axis[0] / length, axis[1] / length, axis[2] / length}};
  if (!e->cellsection) {
    PetscCall(PetscMalloc2(e->ncells, &e->cellsection, e->ncells, &e->cellbeyond));
    for (PetscInt c = 0; c < e->ncells; ++c) e->cellsection[c] = PETSC_DECIDE;
  }
  PetscCall(SectionGetSides(e, point, section->axis, &sides));
  PetscCall(VecGetArrayRead(sides, &s));
  PetscCall(SectionCut(e, s, ncells, &twice));
  PetscCall(VecRestoreArrayRead(sides, &s));
  PetscCall(DMRestoreLocalVector(e->dm, &sides));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ncells, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)e->dm)));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &twice, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)e->dm)));
  if (twice) *ncells = -*ncells;
  PetscFunctionReturn(0);
}

/*@
  ElasticitySetShortening - Sets the length by which a section shortens its body

  Logically Collective

  Input Parameters:
+ e          - the context
. section    - number of the section, in the order of `ElasticityAddSection()`
- shortening - the shortening [length]

  Level: beginner

.seealso: `ElasticityAddSection()`
@*/
PetscErrorCode ElasticitySetShortening(Elasticity e, PetscInt section, PetscReal shortening)
{
  PetscFunctionBegin;
  e->sections[section].shortening = shortening;
  PetscFunctionReturn(0);
}

/*@
  ElasticityGetSectionForces - Gets the forces in all sections

  Collective

  Input Parameters:
+ e - the context
- u - displacement, global, 3 components per node [length]

  Output Parameter:
. force - force of each section along its axis, positive for tension [force]; infinite if a cut cell is inverted

  Level: beginner

.seealso: `ElasticityAddSection()`
@*/
PetscErrorCode ElasticityGetSectionForces(Elasticity e, Vec u, PetscReal force[])
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(force, e->nsections));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt s = e->cellsection[c];
    CellState      cell;
    PetscReal      F[3][CELL_MAX_NODES];
    PetscBool      valid;

    if (s < 0) continue;
    ElasticityGetCell(e, c, x, ul, &cell);
    valid = cell.body->element->force(cell.body->basis, cell.material, cell.X, cell.U, F);
    if (!valid) force[s] = PETSC_INFINITY;
    for (int a = 0; a < cell.n && valid; ++a) {
      for (int d = 0; d < 3; ++d) force[s] += e->beyond[e->cellbeyond[c] + a] * e->sections[s].axis[d] * F[d][a];
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, force, (PetscMPIInt)e->nsections, MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)e->dm)));
  PetscFunctionReturn(0);
}
