/* The elasticity object: creation, options, prescribed displacements */
#include "elasticityimpl.h"
#include <mesh.h>
#include <rankerror.h>

static PetscErrorCode ElasticityReadOptions(Elasticity e)
{
  PetscFunctionBegin;
  e->quadrature = 2;
  PetscCall(PetscStrncpy(e->mattype, MATBAIJ, sizeof(e->mattype)));
  PetscOptionsBegin(PetscObjectComm((PetscObject)e->dm), NULL, "Elasticity options", NULL);
  PetscCall(PetscOptionsInt("-elasticity_quadrature", "Gauss points per axis of a hexahedron, 2 or 3",
    "ElasticityCreate", e->quadrature, &e->quadrature, NULL));
  PetscCall(PetscOptionsFList("-elasticity_mat_type", "Type of the tangent matrix", "ElasticityCreateTangent", MatList,
    e->mattype, e->mattype, sizeof(e->mattype), &e->mattype_given));
  PetscOptionsEnd();
  PetscCheck(e->quadrature == 2 || e->quadrature == 3, PetscObjectComm((PetscObject)e->dm), PETSC_ERR_ARG_OUTOFRANGE,
    "A hexahedron is integrated with 2 or 3 Gauss points per axis, not %" PetscInt_FMT, e->quadrature);
  PetscCheck(strstr(e->mattype, "aij"), PetscObjectComm((PetscObject)e->dm), PETSC_ERR_USER_INPUT,
    "-elasticity_mat_type %s is none of baij, aij and sbaij", e->mattype);
  PetscFunctionReturn(0);
}

/* Gets the basis of cells with `nnodes` nodes. reduced: with 2 points per axis */
static PetscErrorCode ElasticityGetBasis(Elasticity e, PetscInt nnodes, PetscBool reduced, const CellBasis **basis)
{
  const PetscInt order = MeshOrder(nnodes);
  CellBasis    **mine  = &e->basis[reduced ? 4 : order - 1 + (MeshIsTetrahedron(nnodes) ? 2 : 0)];

  PetscFunctionBegin;
  if (!*mine) {
    PetscCall(PetscNew(mine));
    PetscCall(CellBasisCreate(nnodes, reduced ? 2 : order == 1 ? e->quadrature : 3, *mine));
  }
  *basis = *mine;
  PetscFunctionReturn(0);
}

/* Sets the bases of cells with `nnodes` nodes, and the body's element */
static PetscErrorCode ElasticitySetBasis(Elasticity e, PetscInt nnodes, Body *body)
{
  const CellBasis *before = body->mass;

  PetscFunctionBegin;
  PetscCall(ElasticityGetBasis(e, nnodes, PETSC_FALSE, &body->mass));
  PetscCheck(!before || body->mass == before, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
    "A body has cells with different numbers of nodes, one with %" PetscInt_FMT, nnodes);
  PetscCall(ElasticityGetBasis(e, nnodes, (PetscBool)(body->type == ELEMENT_REDUCED), &body->basis));
  PetscCall(ElementGet(body->type, nnodes, &body->element));
  PetscFunctionReturn(0);
}

/*
   Sets the nodes and the body of every cell of this rank. The array of nodes grows if cells have more nodes than linear
   hexahedra.
*/
static PetscErrorCode ElasticityNumberCells(Elasticity e, DMLabel label, PetscInt start)
{
  PetscSection section;
  PetscInt     capacity = 8 * e->ncells;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(e->dm, &section));
  PetscCall(PetscMalloc2(e->ncells + 1, &e->cellstart, e->ncells, &e->cellbody));
  PetscCall(PetscMalloc1(capacity, &e->cellnodes));
  e->cellstart[0] = 0;
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscInt n, nodes[MESH_MAX_NODES];

    PetscCall(DMLabelGetValue(label, start + c, &e->cellbody[c]));
    PetscCheck(e->cellbody[c] >= 0 && e->cellbody[c] < e->nbodies, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
      "Some cells belong to no body: the value of their label \"%s\" is not below the number of materials, "
      "%" PetscInt_FMT,
      MESH_BODY_LABEL, e->nbodies);
    PetscCall(MeshGetCellNodes(e->dm, start + c, &n, nodes));
    PetscCall(ElasticitySetBasis(e, n, &e->bodies[e->cellbody[c]]));
    e->cellstart[c + 1] = e->cellstart[c] + n;
    if (e->cellstart[c + 1] > capacity) {
      capacity = 2 * e->cellstart[c + 1];
      PetscCall(PetscRealloc((size_t)capacity * sizeof(*e->cellnodes), &e->cellnodes));
    }
    for (PetscInt a = 0; a < n; ++a) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(section, nodes[a], &offset));
      e->cellnodes[e->cellstart[c] + a] = offset / 3;
    }
  }
  if (e->cellstart[e->ncells] < capacity)
    PetscCall(PetscRealloc((size_t)e->cellstart[e->ncells] * sizeof(*e->cellnodes), &e->cellnodes));
  PetscFunctionReturn(0);
}

static PetscErrorCode ElasticitySetUpCells(Elasticity e)
{
  MPI_Comm     comm = PetscObjectComm((PetscObject)e->dm);
  PetscSection section;
  DMLabel      label;
  PetscInt     start, end, size;

  PetscFunctionBegin;
  PetscCall(DMGetLabel(e->dm, MESH_BODY_LABEL, &label));
  PetscCheck(label, comm, PETSC_ERR_ARG_WRONG, "The mesh has no label \"%s\" that gives the body of each cell",
    MESH_BODY_LABEL);
  PetscCall(DMGetLocalSection(e->dm, &section));
  PetscCall(DMPlexGetHeightStratum(e->dm, 0, &start, &end));
  PetscCall(PetscSectionGetStorageSize(section, &size));
  e->nnodes = size / 3;
  e->ncells = end - start;
  RankCall(comm, PETSC_TRUE, ElasticityNumberCells(e, label, start));
  PetscFunctionReturn(0);
}

/*
   Collective. Sets the stiffness of the rest of the dilatation (bbar.c) in hyperelastic bodies of order 2: the shear
   modulus, so that cells do not lock, or the bulk modulus if that is smaller
*/
static PetscErrorCode ElasticitySetRest(Elasticity e)
{
  PetscInt *nnodes;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(e->nbodies, &nnodes));
  PetscCall(MeshGetBodyNodes(e->dm, e->nbodies, nnodes));
  for (PetscInt b = 0; b < e->nbodies; ++b) {
    BodyMaterial *m = &e->bodies[b].material;

    if (e->bodies[b].type != ELEMENT_BBAR || nnodes[b] <= 8 || !m->law->finite || MaterialYields(&e->bodies[b].given))
      continue;
    m->rest = PetscMin(m->moduli.bulk, m->moduli.mu);
  }
  PetscCall(PetscFree(nnodes));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCreate - Creates the elasticity of the bodies of a mesh, made of hexahedra and tetrahedra of order 1 and 2

  Collective

  Input Parameters:
+ dm        - the mesh, from `MeshCreate()`
. nbodies   - number of bodies
. materials - materials[b] belongs to the cells whose "body" label is b
- elements  - elements[b] is the element of those cells: `ELEMENT_FULL`; `ELEMENT_BBAR`, which does not lock as
              Poisson's ratio nears 1/2; or `ELEMENT_INCOMPATIBLE`, which does not lock in bending either, for laws of
              small strain; `NULL` for full integration everywhere

  Output Parameter:
. elasticity - the new context

  Options Database Keys:
+ -elasticity_quadrature <2>   - Gauss points per axis in cells of order 1, 2 or 3; 2 is exact for the linear law on
                                 parallelepipeds
- -elasticity_mat_type <baij>  - type of the tangent: baij, aij or sbaij

  Level: beginner

.seealso: `MeshCreate()`, `ElasticitySetPrescribed()`, `ElasticityCreateTangent()`, `ElasticityForce()`
@*/
PetscErrorCode ElasticityCreate(DM dm, PetscInt nbodies, const Material materials[], const ElementType elements[],
  Elasticity *elasticity)
{
  Elasticity e;

  PetscFunctionBegin;
  PetscCall(EventsRegister());
  PetscCall(PetscNew(&e));
  PetscCall(PetscObjectReference((PetscObject)dm));
  e->dm      = dm;
  e->nbodies = nbodies;
  PetscCall(PetscCalloc1(nbodies, &e->bodies));
  for (PetscInt b = 0; b < nbodies; ++b) {
    BodyMaterial *m = &e->bodies[b].material;

    e->bodies[b].given = materials[b];
    PetscCall(MaterialGetModuli(&e->bodies[b].given, &m->moduli, &m->isochoric));
    PetscCall(MaterialGetLaw(&materials[b], &m->law));
    PetscCall(MaterialGetExpansion(&materials[b], e->bodies[b].expansion));
    for (int i = 0; i < 9; ++i)
      e->bodies[b].expands = (PetscBool)(e->bodies[b].expands || e->bodies[b].expansion[i] != 0);
    PetscCheck(!m->law->finite || !e->bodies[b].expands, PetscObjectComm((PetscObject)dm), PETSC_ERR_SUP,
      "Body %" PetscInt_FMT ": only laws of small strain support thermal expansion", b);
    e->bodies[b].rigid = (PetscBool)(materials[b].type == MATERIAL_RIGID);
    e->bodies[b].type  = elements ? elements[b] : ELEMENT_FULL;
    PetscCheck(!m->law->finite || e->bodies[b].type != ELEMENT_INCOMPATIBLE, PetscObjectComm((PetscObject)dm),
      PETSC_ERR_SUP,
      "Body %" PetscInt_FMT ": incompatible modes are for small strain; under compression at finite strain they are "
      "unstable",
      b);
    PetscCheck(materials[b].type != MATERIAL_SAINT_VENANT || e->bodies[b].type != ELEMENT_BBAR,
      PetscObjectComm((PetscObject)dm), PETSC_ERR_SUP,
      "Body %" PetscInt_FMT ": the element bbar cannot be used with Saint Venant-Kirchhoff, whose dilatation tr E is "
      "not the change of volume",
      b);
  }
  PetscCall(ElasticityReadOptions(e));
  PetscCall(ElasticitySetUpCells(e)); /* refuses cells that are not known, on all ranks */
  PetscCall(ElasticitySetRest(e));
  PetscCall(ElasticitySetUpKept(e));
  PetscCall(ElasticitySetUpHistory(e));
  *elasticity = e;
  PetscFunctionReturn(0);
}

/*@
  ElasticitySetPrescribed - Sets the unknowns whose displacement is prescribed

  Collective

  Input Parameters:
+ e    - the context
- rows - global rows owned by this rank, repeated ones allowed; `NULL` for none

  Level: beginner

  Notes:
  The tangent has zero rows and columns there, apart from the diagonal. Energy and force are not affected. The next
  tangent is assembled completely.

.seealso: `ElasticityCreateTangent()`, `MeshGetFaceDofs()`
@*/
PetscErrorCode ElasticitySetPrescribed(Elasticity e, IS rows)
{
  Vec                global, local;
  PetscScalar       *g;
  const PetscScalar *l;
  const PetscInt    *r;
  PetscInt           n, first, last, bad = -1;

  PetscFunctionBegin;
  PetscCall(PetscFree(e->prescribed));
  e->assembled.id = 0;
  if (!rows) PetscFunctionReturn(0);
  PetscCall(DMGetGlobalVector(e->dm, &global));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(global));
  PetscCall(VecGetOwnershipRange(global, &first, &last));
  PetscCall(ISGetLocalSize(rows, &n));
  PetscCall(ISGetIndices(rows, &r));
  PetscCall(VecGetArray(global, &g));
  for (PetscInt i = 0; i < n; ++i) {
    if (r[i] < first || r[i] >= last) bad = r[i];
    else g[r[i] - first] = 1;
  }
  PetscCall(VecRestoreArray(global, &g));
  PetscCall(ISRestoreIndices(rows, &r));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &bad, 1, MPIU_INT, MPI_MAX, PetscObjectComm((PetscObject)e->dm)));
  PetscCheck(bad < 0, PetscObjectComm((PetscObject)e->dm), PETSC_ERR_ARG_OUTOFRANGE,
    "Prescribed row %" PetscInt_FMT " is not owned by the rank that gives it", bad);
  PetscCall(DMGlobalToLocal(e->dm, global, INSERT_VALUES, local));
  PetscCall(PetscCalloc1(e->nnodes + 1, &e->prescribed));
  PetscCall(VecGetArrayRead(local, &l));
  for (PetscInt i = 0; i < 3 * e->nnodes; ++i) {
    if (PetscRealPart(l[i]) > 0) e->prescribed[i / 3] |= (unsigned char)(1 << i % 3);
  }
  PetscCall(VecRestoreArrayRead(local, &l));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscCall(DMRestoreGlobalVector(e->dm, &global));
  PetscFunctionReturn(0);
}

/*@
  ElasticityDestroy - Destroys an elasticity context

  Collective

  Input Parameter:
. e - the context

  Level: beginner

.seealso: `ElasticityCreate()`
@*/
PetscErrorCode ElasticityDestroy(Elasticity *e)
{
  PetscFunctionBegin;
  if (!*e) PetscFunctionReturn(0);
  PetscCall(DMDestroy(&(*e)->dm));
  PetscCall(PetscFree((*e)->bodies));
  PetscCall(PetscFree2((*e)->cellstart, (*e)->cellbody));
  PetscCall(PetscFree((*e)->cellnodes));
  for (PetscInt k = 0; k < 5; ++k) PetscCall(PetscFree((*e)->basis[k]));
  PetscCall(PetscFree((*e)->prescribed));
  PetscCall(PetscFree((*e)->temperature));
  PetscCall(PetscFree((*e)->sections));
  PetscCall(PetscFree2((*e)->cellsection, (*e)->cellbeyond));
  PetscCall(PetscFree((*e)->beyond));
  PetscCall(PetscFree((*e)->light));
  PetscCall(PetscFree((*e)->firstpoint));
  PetscCall(PetscFree((*e)->history));
  PetscCall(VecDestroy(&(*e)->springs));
  PetscCall(MatDestroy(&(*e)->between));
  PetscCall(PetscFree(*e));
  PetscFunctionReturn(0);
}
