/*
   The rows of vertices at which both faces are held along the normal by the same displacement, such as the common clamp
   of two leaves. Between other vertices of two meshes that do not match, such a row measures how differently the two
   faces are interpolated beside the clamp. Its multiplier is not bounded by the loads. Therefore the sums of the row
   are added to the rows of the free neighbours along the edges of the facets, in equal parts. The test functions of the
   remaining rows still sum to 1. If the gap is measured at nodes, the row is removed.
*/
#include "assemblyimpl.h"
#include "src/mesh/query/queryimpl.h"

static const PetscReal held_component = 0.1; /* an axis counts as normal to a facet if the unit normal has a larger
                                                component along it */

/* A vertex of a facet that is held along the facet's normal. All fields are real, so that an array of these structs can
   be sent as an array of reals. */
typedef struct {
  PetscReal x[3], normal[3]; /* undeformed coordinates [length], unit normal of the facet */
  PetscReal size;            /* diameter of the facet [length] */
  PetscReal motion[3];       /* what prescribes its displacement along each axis, from ContactSurfaceFindMotions() */
} HeldVertex;
#define HELD_REALS (PetscInt)(sizeof(HeldVertex) / sizeof(PetscReal))

/* Fills *vertex for vertex i of the surface's facets. Returns false if it is not held along the normal. */
static PetscBool HeldVertexFill(const ContactSurface *s, PetscInt *const motion[3], PetscInt i, HeldVertex *vertex)
{
  const PetscReal *x = &s->reference[12 * (i / 4)];

  if (!ContactFacetNormal(x, vertex->normal)) return PETSC_FALSE;
  vertex->size = ContactFacetDiameter(x);
  for (PetscInt c = 0; c < 3; ++c) {
    vertex->x[c]      = s->reference[3 * i + c];
    vertex->motion[c] = (PetscReal)motion[c][i];
    if (PetscAbsReal(vertex->normal[c]) > held_component && motion[c][i] == CONTACT_FREE) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

/* Returns whether two held vertices are opposite each other, closer than a facet, and held by the same displacements */
static PetscBool HeldVertexFaces(const HeldVertex *a, const HeldVertex *b)
{
  PetscReal d[3], along, square = 0.0;

  if (VectorDot(a->normal, b->normal) > CONTACT_NORMAL_COSINE) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) {
    d[c] = b->x[c] - a->x[c];
    if (PetscAbsReal(a->normal[c]) > held_component && a->motion[c] != b->motion[c]) return PETSC_FALSE;
  }
  along = VectorDot(d, a->normal);
  for (PetscInt c = 0; c < 3; ++c) square += PetscSqr(d[c] - along * a->normal[c]);
  return (PetscBool)(square <= PetscSqr(PetscMax(a->size, b->size)));
}

/* Collective. Lists the held vertices of the mortar face from all ranks */
static PetscErrorCode HeldVerticesGather(Contact contact, const ContactSurface *s, PetscInt *n, HeldVertex **list)
{
  PetscInt *motion[3];

  PetscFunctionBegin;
  *n = 0;
  PetscCall(PetscMalloc1(4 * s->nfacets, list));
  PetscCall(PetscMalloc3(4 * s->nfacets, &motion[0], 4 * s->nfacets, &motion[1], 4 * s->nfacets, &motion[2]));
  for (PetscInt c = 0; c < 3; ++c)
    PetscCall(
      ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, c, s, motion[c]));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    if (HeldVertexFill(s, motion, i, &(*list)[*n])) ++*n;
  }
  PetscCall(PetscFree3(motion[0], motion[1], motion[2]));
  PetscCall(RecordsGather(contact->comm, HELD_REALS, n, list));
  PetscFunctionReturn(0);
}

/* Collective. Sets free[row] above zero for the pair's rows whose vertices are not held, or do not face one of the n held
   vertices of the mortar face, and to zero for other rows */
static PetscErrorCode HeldRowsMarkFree(Contact contact, const ContactPairData *pair, PetscInt n,
  const HeldVertex list[], Vec free)
{
  const ContactSurface *s = &pair->nonmortar;
  PetscInt             *motion[3];

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(free));
  PetscCall(PetscMalloc3(4 * s->nfacets, &motion[0], 4 * s->nfacets, &motion[1], 4 * s->nfacets, &motion[2]));
  for (PetscInt c = 0; c < 3; ++c)
    PetscCall(
      ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, c, s, motion[c]));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    HeldVertex vertex;
    PetscBool  held = PETSC_FALSE;

    if (HeldVertexFill(s, motion, i, &vertex)) {
      for (PetscInt k = 0; k < n && !held; ++k) held = HeldVertexFaces(&vertex, &list[k]);
    }
    if (!held) PetscCall(VecSetValue(free, pair->row[i], 1.0, ADD_VALUES));
  }
  PetscCall(PetscFree3(motion[0], motion[1], motion[2]));
  PetscCall(VecAssemblyBegin(free));
  PetscCall(VecAssemblyEnd(free));
  PetscFunctionReturn(0);
}

/* Collective. Creates a sequential vector with the values of `rows` at the vertices of the pair's facets */
static PetscErrorCode HeldRowsGather(const ContactPairData *pair, Vec rows, Vec *gathered)
{
  IS from;

  PetscFunctionBegin;
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, 4 * pair->nonmortar.nfacets, pair->row, PETSC_USE_POINTER, &from));
  PetscCall(ContactGatherEntries(rows, from, gathered));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(0);
}

/* Collective. Adds to `share` the entries of held rows at their free neighbours, and their number to `neighbours`. free:
   1 or more for free rows; it is 0 for held ones */
static PetscErrorCode HeldRowsShare(const ContactPairData *pair, Vec free, Vec neighbours, Mat share)
{
  Vec                gathered;
  const PetscScalar *at;

  PetscFunctionBegin;
  PetscCall(HeldRowsGather(pair, free, &gathered));
  PetscCall(VecGetArrayRead(gathered, &at));
  for (PetscInt i = 0; i < 4 * pair->nonmortar.nfacets; ++i) {
    const PetscInt edge[2] = {4 * (i / 4) + (i + 1) % 4, 4 * (i / 4) + (i + 3) % 4};

    for (PetscInt e = 0; e < 2 && PetscRealPart(at[i]) == 0.0; ++e) {
      if (PetscRealPart(at[edge[e]]) == 0.0) continue;
      PetscCall(MatSetValue(share, pair->row[i], pair->row[edge[e]], 1.0, ADD_VALUES));
      PetscCall(VecSetValue(neighbours, pair->row[i], 1.0, ADD_VALUES));
    }
  }
  PetscCall(VecRestoreArrayRead(gathered, &at));
  PetscCall(VecDestroy(&gathered));
  PetscFunctionReturn(0);
}

/* Collective. Completes `share`: rows without entries keep their own sums, and the others are divided by the number of
   their entries, or emptied if the gap of the pair is measured at nodes */
static PetscErrorCode HeldRowsFinish(Contact contact, Vec neighbours, Mat share)
{
  const ContactRows *rows = &contact->rows;
  PetscInt           rstart;
  PetscScalar       *n;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(neighbours, &rstart, NULL));
  PetscCall(VecGetArray(neighbours, &n));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
      const PetscReal count = PetscRealPart(n[i]);

      if (count == 0.0) PetscCall(MatSetValue(share, rstart + i, rstart + i, 1.0, ADD_VALUES));
      n[i] = count == 0.0 ? 1.0 : contact->pairs[p].gap == GAP_NODE ? 0.0 : 1.0 / count;
    }
  }
  PetscCall(VecRestoreArray(neighbours, &n));
  PetscCall(MatAssemblyBegin(share, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(share, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDiagonalScale(share, neighbours, NULL));
  PetscFunctionReturn(0);
}

/* Collective. Combines `share` with rows->hanging, and distributes the masses again */
static PetscErrorCode HeldRowsCombine(Contact contact, Mat share)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  if (rows->hanging) {
    Mat both;

    PetscCall(MatMatMult(rows->hanging, share, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &both));
    PetscCall(MatDestroy(&rows->hanging));
    rows->hanging = both;
  } else {
    PetscCall(PetscObjectReference((PetscObject)share));
    rows->hanging = share;
  }
  PetscCall(VecDestroy(&rows->weight));
  PetscCall(VecDuplicate(rows->mass, &rows->weight));
  PetscCall(MatMultTranspose(rows->hanging, rows->mass, rows->weight));
  PetscFunctionReturn(0);
}

/* Collective. Distributes the rows that both faces hold, unless this is done already */
PetscErrorCode ContactHeldRowsDistribute(Contact contact)
{
  const ContactRows *rows = &contact->rows;
  Vec                free, neighbours;
  Mat                share;
  PetscReal          any;

  PetscFunctionBegin;
  if (contact->rows.distributed || !contact->ndisplacements) PetscFunctionReturn(0);
  contact->rows.distributed = PETSC_TRUE;
  PetscCall(VecDuplicate(rows->mass, &free));
  PetscCall(VecDuplicate(rows->mass, &neighbours));
  PetscCall(VecZeroEntries(neighbours));
  PetscCall(MatCreateAIJ(contact->comm, rows->nlocal, rows->nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 4, NULL,
    &share));
  PetscCall(MatSetOption(share, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];
    HeldVertex            *list;
    PetscInt               n;

    if (pair->formula || pair->nonmortar.self) continue;
    PetscCall(HeldVerticesGather(contact, &pair->mortar, &n, &list));
    if (n) {
      PetscCall(HeldRowsMarkFree(contact, pair, n, list, free));
      PetscCall(HeldRowsShare(pair, free, neighbours, share));
    }
    PetscCall(PetscFree(list));
  }
  PetscCall(VecAssemblyBegin(neighbours));
  PetscCall(VecAssemblyEnd(neighbours));
  PetscCall(VecNorm(neighbours, NORM_INFINITY, &any));
  if (any > 0.0) {
    PetscCall(HeldRowsFinish(contact, neighbours, share));
    PetscCall(HeldRowsCombine(contact, share));
  }
  PetscCall(MatDestroy(&share));
  PetscCall(VecDestroy(&neighbours));
  PetscCall(VecDestroy(&free));
  PetscFunctionReturn(0);
}

/* Collective. Undoes ContactHeldRowsDistribute(), because the prescribed displacements change */
PetscErrorCode ContactHeldRowsReset(Contact contact)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  if (!rows->distributed) PetscFunctionReturn(0);
  rows->distributed = PETSC_FALSE;
  PetscCall(MatDestroy(&rows->hanging));
  PetscCall(VecDestroy(&rows->weight));
  PetscCall(ContactHangingRowsCreate(contact));
  PetscFunctionReturn(0);
}
