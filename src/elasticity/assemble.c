/*
   Assembles the tangent. Bodies with a constant tangent are assembled once. Later assemblies set the rows of the other
   bodies to zero and add only their cells again. This needs no second copy of the values.
*/
#include "elasticityimpl.h"
#include <petsc/private/petscimpl.h> /* declares PetscObjectStateGet() */

/* Sets the rows and columns of prescribed displacements in a cell's stiffness to zero, except for the diagonal */
static void CellMaskPrescribed(const unsigned char prescribed[], PetscInt n, const PetscInt nodes[], PetscScalar K[])
{
  const PetscInt width = 3 * n;

  for (PetscInt a = 0; a < n; ++a) {
    if (!prescribed[nodes[a]]) continue;
    for (PetscInt i = 0; i < 3; ++i) {
      const PetscInt    r        = 3 * a + i;
      const PetscScalar diagonal = K[width * r + r];

      if (!(prescribed[nodes[a]] >> i & 1)) continue;
      for (PetscInt s = 0; s < width; ++s) K[width * r + s] = K[width * s + r] = 0;
      K[width * r + r] = diagonal;
    }
  }
}

/* Finds whether the matrix still has the values of the last assembly */
static PetscErrorCode ElasticityHoldsAssembled(Elasticity e, Mat tangent, PetscBool *holds)
{
  PetscObjectId    id;
  PetscObjectState state;

  PetscFunctionBegin;
  PetscCall(PetscObjectGetId((PetscObject)tangent, &id));
  PetscCall(PetscObjectStateGet((PetscObject)tangent, &state));
  *holds = (PetscBool)(id == e->assembled.id && state == e->assembled.state);
  PetscFunctionReturn(0);
}

/* Sets the rows of the bodies that are assembled again to zero. Their columns have entries in these rows only. */
static PetscErrorCode ElasticityZeroAssembledAgain(Elasticity e, const PetscInt global[], Mat tangent)
{
  PetscInt   n = 0, first, last, *rows;
  PetscBool *seen;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(tangent, &first, &last));
  PetscCall(PetscMalloc1(last - first, &rows));
  PetscCall(PetscCalloc1(e->nnodes, &seen));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    for (PetscInt i = e->cellstart[c]; i < e->cellstart[c + 1]; ++i) {
      const PetscInt node = e->cellnodes[i], row = 3 * global[node];

      if (seen[node] || e->bodies[e->cellbody[c]].kept || row < first || row >= last) continue;
      seen[node] = PETSC_TRUE;
      for (PetscInt d = 0; d < 3; ++d) rows[n++] = row + d;
    }
  }
  PetscCall(MatSetOption(tangent, MAT_KEEP_NONZERO_PATTERN,
    PETSC_TRUE)); /* PETSc passes options to the blocks of an MPIBAIJ matrix only after its first assembly */
  PetscCall(MatZeroRows(tangent, n, rows, 0, NULL, NULL));
  PetscCall(PetscFree(seen));
  PetscCall(PetscFree(rows));
  PetscFunctionReturn(0);
}

/* The blocks of a tangent of type SEQBAIJ or SEQSBAIJ, in compressed rows with ascending columns; otherwise a is NULL.
   Entries of a block are stored column by column. */
typedef struct {
  PetscInt        n;
  const PetscInt *ia, *ja;
  PetscScalar    *a;
  PetscBool       half; /* only the upper triangle is stored */
} TangentBlocks;

static PetscErrorCode TangentBlocksGet(Mat tangent, TangentBlocks *t)
{
  PetscBool full, done;

  PetscFunctionBegin;
  PetscCall(PetscMemzero(t, sizeof(*t)));
  PetscCall(PetscObjectTypeCompare((PetscObject)tangent, MATSEQBAIJ, &full));
  PetscCall(PetscObjectTypeCompare((PetscObject)tangent, MATSEQSBAIJ, &t->half));
  if (!full && !t->half) PetscFunctionReturn(0);
  PetscCall(MatGetRowIJ(tangent, 0, PETSC_FALSE, PETSC_TRUE, &t->n, &t->ia, &t->ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_PLIB, "The rows of the tangent cannot be accessed");
  if (t->half) PetscCall(MatSeqSBAIJGetArray(tangent, &t->a));
  else PetscCall(MatSeqBAIJGetArray(tangent, &t->a));
  PetscFunctionReturn(0);
}

static PetscErrorCode TangentBlocksRestore(Mat tangent, TangentBlocks *t)
{
  PetscBool done;

  PetscFunctionBegin;
  if (!t->a) PetscFunctionReturn(0);
  if (t->half) PetscCall(MatSeqSBAIJRestoreArray(tangent, &t->a));
  else PetscCall(MatSeqBAIJRestoreArray(tangent, &t->a));
  PetscCall(MatRestoreRowIJ(tangent, 0, PETSC_FALSE, PETSC_TRUE, &t->n, &t->ia, &t->ja, &done));
  PetscFunctionReturn(0);
}

/*
   Adds the matrix K of a cell to the blocks. rows: numbers of the cell's n nodes. MatSetValuesBlocked() would search
   each block in its row; here the nodes in ascending order are found in one pass over the row.
*/
static PetscErrorCode TangentBlocksAdd(const TangentBlocks *t, PetscInt n, const PetscInt rows[], const PetscScalar K[])
{
  PetscInt sorted[CELL_MAX_NODES], node[CELL_MAX_NODES];

  PetscFunctionBegin;
  for (PetscInt a = 0; a < n; ++a) node[a] = a;
  PetscCall(PetscArraycpy(sorted, rows, n));
  PetscCall(PetscSortIntWithArray(n, sorted, node));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscScalar *from = K + 9 * n * node[i];
    PetscInt           k    = t->ia[sorted[i]];

    for (PetscInt j = t->half ? i : 0; j < n; ++j) {
      PetscScalar *block;

      while (t->ja[k] < sorted[j]) ++k; /* all nodes of a cell have a block in each of its rows */
      block = t->a + 9 * (size_t)k;
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) block[3 * c + r] += from[3 * n * r + 3 * node[j] + c];
    }
  }
  PetscFunctionReturn(0);
}

/*
   Adds the stiffness of all cells, or, unless `all`, only of cells of the bodies that are assembled again. If a cell is
   inverted, its stiffness at zero displacement is used.
*/
static PetscErrorCode ElasticityAddCells(Elasticity e, Vec u, PetscBool all, const PetscInt global[], Mat tangent)
{
  Vec                local, local_before;
  const PetscScalar *x, *ul, *before;
  TangentBlocks      blocks;

  PetscFunctionBegin;
  PetscCall(TangentBlocksGet(tangent, &blocks));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(ElasticityGetLocals(e, e->before ? e->before : u, &local_before, &before, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState   cell, last;
    PetscInt    rows[CELL_MAX_NODES];
    PetscScalar K[9 * CELL_MAX_NODES * CELL_MAX_NODES];

    if (e->bodies[e->cellbody[c]].kept && !all) continue;
    ElasticityGetCell(e, c, x, ul, &cell);
    if (e->before) ElasticityGetCell(e, c, x, before, &last);
    if (!cell.body->element->stiffness(cell.body->basis, cell.material, cell.X, cell.U, e->before ? last.U : NULL, K)) {
      PetscReal undeformed[3][CELL_MAX_NODES] = {{0}};

      (void)cell.body->element->stiffness(cell.body->basis, cell.material, cell.X, undeformed, NULL, K);
    }
    CellAddInertia(e, &cell, K);
    if (e->prescribed) CellMaskPrescribed(e->prescribed, cell.n, cell.nodes, K);
    for (PetscInt a = 0; a < cell.n; ++a) rows[a] = global[cell.nodes[a]];
    if (blocks.a) PetscCall(TangentBlocksAdd(&blocks, cell.n, rows, K));
    else PetscCall(MatSetValuesBlocked(tangent, cell.n, rows, cell.n, rows, K, ADD_VALUES));
  }
  PetscCall(TangentBlocksRestore(tangent, &blocks));
  PetscCall(ElasticityRestoreLocals(e, &local_before, &before, &x));
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCall(SpringsAddTangent(e, all, global, tangent));
  PetscCall(MatAssemblyBegin(tangent, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(tangent, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Sets the displacement from which elements with mean dilatation linearize the pressure in later tangents, see bbar.c;
   NULL: they use the pressure at the displacement of the tangent */
void ElasticitySetPressureBase(Elasticity e, Vec before)
{
  e->before = before;
}

/*@
  ElasticityTangent - Assembles the second derivative of the energy

  Collective

  Input Parameters:
+ e       - the context
. u       - displacement, global, 3 components per node [length]; may be `NULL` (no displacement)
- tangent - matrix from `ElasticityCreateTangent()`

  Output Parameter:
. tangent - the tangent [force/length]; rows and columns of prescribed unknowns are zero apart from the diagonal

  Level: beginner

  Notes:
  If the matrix is that of the last call and its `PetscObjectState` has not changed since, bodies with a constant
  tangent are not assembled again, unless they share nodes with a body that is. If the tangents of all bodies are
  constant, nothing is done and the state does not change. Any other matrix is assembled completely, and so is one of a
  type without `MatZeroRows()` (sbaij).

  An inverted cell, whose energy is infinite, gets the stiffness of zero displacement, so that the matrix contains no
  NaN.

.seealso: `ElasticityCreateTangent()`, `ElasticitySetPrescribed()`, `ElasticityForce()`, `ElasticityGetAssemblies()`
@*/
PetscErrorCode ElasticityTangent(Elasticity e, Vec u, Mat tangent)
{
  ISLocalToGlobalMapping map;
  const PetscInt        *global;
  PetscBool              holds = PETSC_FALSE, linear = PETSC_FALSE, again = PETSC_FALSE, kept = PETSC_FALSE;

  PetscFunctionBegin;
  PetscCall(ElasticityHoldsAssembled(e, tangent, &holds));
  PetscCall(ElasticityIsLinear(e, &linear));
  if (holds && linear) PetscFunctionReturn(0);
  PetscCall(PetscLogEventBegin(ELASTICITY_Tangent, tangent, 0, 0, 0));
  PetscCall(MatHasOperation(tangent, MATOP_ZERO_ROWS, &again));
  for (PetscInt b = 0; b < e->nbodies; ++b) kept = (PetscBool)(kept || e->bodies[b].kept);
  if (!holds || !kept) again = PETSC_FALSE;
  PetscCall(DMGetLocalToGlobalMapping(e->dm, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  if (again) PetscCall(ElasticityZeroAssembledAgain(e, global, tangent));
  else PetscCall(MatZeroEntries(tangent));
  PetscCall(ElasticityAddCells(e, u, (PetscBool)!again, global, tangent));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  for (PetscInt b = 0; b < e->nbodies; ++b) e->bodies[b].assemblies += again && e->bodies[b].kept ? 0 : 1;
  PetscCall(PetscObjectGetId((PetscObject)tangent, &e->assembled.id));
  PetscCall(PetscObjectStateGet((PetscObject)tangent, &e->assembled.state));
  PetscCall(PetscLogEventEnd(ELASTICITY_Tangent, tangent, 0, 0, 0));
  PetscFunctionReturn(0);
}

/*@
  ElasticityGetAssemblies - Gets how often a body has been assembled into a tangent

  Not Collective

  Input Parameters:
+ e    - the context
- body - the body, from 0

  Output Parameter:
. assemblies - number of assemblies, into any matrix

  Level: intermediate

.seealso: `ElasticityTangent()`
@*/
PetscErrorCode ElasticityGetAssemblies(Elasticity e, PetscInt body, PetscInt *assemblies)
{
  PetscFunctionBegin;
  PetscCheck(body >= 0 && body < e->nbodies, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
    "There is no body %" PetscInt_FMT " among %" PetscInt_FMT, body, e->nbodies);
  *assemblies = e->bodies[body].assemblies;
  PetscFunctionReturn(0);
}
