/*
   The rows of vertices at which the same displacement is prescribed along the normal on both faces, such as the common
   clamp of two leaves. If the cells beside the clamp do not match, such a row measures how differently the two faces
   are interpolated there. Its multiplier is not bounded by the loads. Therefore the sums of the row are added to the
   rows of the free neighbours along the edges of the facets, with equal weights. Neighbours that match a vertex of the
   mortar face get nothing. The test functions of the remaining rows still sum to 1. If the gap is measured at nodes,
   the row is removed.
   The same holds for the rows beside these, because the two bodies are stiff near the prescribed vertices: for beams,
   the compliance grows with the third power of the distance. Therefore mean gaps of these rows are added to those of
   their neighbours too, up to `beyond` facets away.
*/
#include "assemblyimpl.h"
#include "src/mesh/query/queryimpl.h"

/* an axis counts as normal to a facet if the unit normal has a larger component along it */
static const PetscReal normal_component = 0.1;
static const PetscInt  beyond           = 3;
/* tolerance for vertices that match, relative to the diameter of the facet */
static const PetscReal match_tolerance = 1e-3;

/* A vertex of a facet that has vertices with a displacement prescribed along its normal. All fields are real, so that
   an array of these structs can be sent as an array of reals. */
typedef struct {
  PetscReal x[3], normal[3]; /* undeformed coordinates [length], unit normal of the facet */
  PetscReal size;            /* diameter of the facet [length] */
  PetscReal motion[3];       /* what prescribes its displacement along each axis, from ContactSurfaceFindMotions() */
  PetscReal prescribed;      /* 1 if that of the vertex itself is prescribed along the normal; 0 if not */
} PrescribedVertex;
#define PRESCRIBED_REALS (PetscInt)(sizeof(PrescribedVertex) / sizeof(PetscReal))

/* What prescribes the displacement of the vertices of a surface's facets, along each axis */
typedef struct {
  PetscInt *along[3];
} PrescribedMotions;

/* Collective */
static PetscErrorCode PrescribedMotionsCreate(Contact contact, const ContactSurface *s, PrescribedMotions *m)
{
  PetscFunctionBegin;
  PetscCall(PetscMalloc3(4 * s->nfacets, &m->along[0], 4 * s->nfacets, &m->along[1], 4 * s->nfacets, &m->along[2]));
  for (PetscInt c = 0; c < 3; ++c)
    PetscCall(
      ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, c, s, m->along[c]));
  PetscFunctionReturn(0);
}

static PetscErrorCode PrescribedMotionsDestroy(PrescribedMotions *m)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(m->along[0], m->along[1], m->along[2]));
  PetscFunctionReturn(0);
}

/* Gets vertex i of the surface's facets. Returns whether its displacement is prescribed along the normal. */
static PetscBool PrescribedVertexGet(const ContactSurface *s, const PrescribedMotions *m, PetscInt i,
  PrescribedVertex *vertex)
{
  const PetscReal *x = &s->reference[12 * (i / 4)];
  PetscBool        prescribed;

  prescribed   = ContactFacetNormal(x, vertex->normal);
  vertex->size = ContactFacetDiameter(x);
  for (PetscInt c = 0; c < 3; ++c) {
    vertex->x[c]      = s->reference[3 * i + c];
    vertex->motion[c] = (PetscReal)m->along[c][i];
    if (PetscAbsReal(vertex->normal[c]) > normal_component && m->along[c][i] == CONTACT_FREE) prescribed = PETSC_FALSE;
  }
  vertex->prescribed = prescribed ? 1.0 : 0.0;
  return prescribed;
}

/* Returns the distance of the point y from x along the facet of x; PETSC_INFINITY if the facets of the two points do
   not face each other. nx, ny: unit normals of the facets */
PetscReal ContactDistanceAlongFacet(const PetscReal x[3], const PetscReal nx[3], const PetscReal y[3],
  const PetscReal ny[3])
{
  PetscReal d[3], along;

  if (VectorDot(nx, ny) > CONTACT_NORMAL_COSINE) return PETSC_INFINITY;
  for (PetscInt c = 0; c < 3; ++c) d[c] = y[c] - x[c];
  along = VectorDot(d, nx);
  for (PetscInt c = 0; c < 3; ++c) d[c] -= along * nx[c];
  return VectorNorm(d);
}

static PetscReal PrescribedVertexDistance(const PrescribedVertex *a, const PrescribedVertex *b)
{
  return ContactDistanceAlongFacet(a->x, a->normal, b->x, b->normal);
}

/* Returns whether the same displacements are prescribed at two vertices along the normal of a */
static PetscBool PrescribedVertexIsAlike(const PrescribedVertex *a, const PrescribedVertex *b)
{
  if (b->prescribed == 0.0) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c)
    if (PetscAbsReal(a->normal[c]) > normal_component && a->motion[c] != b->motion[c]) return PETSC_FALSE;
  return PETSC_TRUE;
}

/* Collective. Lists the vertices of the facets of the mortar face that have prescribed vertices, from all ranks */
static PetscErrorCode PrescribedVerticesGather(Contact contact, const ContactSurface *s, PetscInt *n,
  PrescribedVertex **list)
{
  PrescribedMotions m;

  PetscFunctionBegin;
  *n = 0;
  PetscCall(PrescribedMotionsCreate(contact, s, &m));
  PetscCall(PetscMalloc1(4 * s->nfacets, list));
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    PetscBool any = PETSC_FALSE;

    for (PetscInt a = 0; a < 4; ++a) {
      const PetscBool prescribed = PrescribedVertexGet(s, &m, 4 * f + a, &(*list)[*n + a]);

      any = (PetscBool)(any || prescribed);
    }
    if (any) *n += 4;
  }
  PetscCall(PrescribedMotionsDestroy(&m));
  PetscCall(RecordsGather(contact->comm, PRESCRIBED_REALS, n, list));
  PetscFunctionReturn(0);
}

/* Collective. Sets `free` to zero on the pair's rows whose vertices have the same prescribed displacement as one of the
   n mortar vertices that is closer than a facet, and above zero on other rows */
static PetscErrorCode PrescribedRowsMarkFree(const ContactPairData *pair, const PrescribedMotions *m, PetscInt n,
  const PrescribedVertex list[], Vec free)
{
  PetscFunctionBegin;
  PetscCall(VecZeroEntries(free));
  for (PetscInt i = 0; i < 4 * pair->nonmortar.nfacets; ++i) {
    PrescribedVertex vertex;
    PetscBool        prescribed = PETSC_FALSE;

    if (PrescribedVertexGet(&pair->nonmortar, m, i, &vertex)) {
      for (PetscInt k = 0; k < n && !prescribed; ++k)
        prescribed = (PetscBool)(PrescribedVertexIsAlike(&vertex, &list[k]) &&
                                 PrescribedVertexDistance(&vertex, &list[k]) <= PetscMax(vertex.size, list[k].size));
    }
    if (!prescribed) PetscCall(VecSetValue(free, pair->row[i], 1.0, ADD_VALUES));
  }
  PetscCall(VecAssemblyBegin(free));
  PetscCall(VecAssemblyEnd(free));
  PetscFunctionReturn(0);
}

/* Collective. Creates a sequential vector with the values of `rows` at the vertices of the pair's facets */
static PetscErrorCode PrescribedRowsGather(const ContactPairData *pair, Vec rows, Vec *gathered)
{
  IS from;

  PetscFunctionBegin;
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, 4 * pair->nonmortar.nfacets, pair->row, PETSC_USE_POINTER, &from));
  PetscCall(ContactGatherEntries(rows, from, gathered));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(0);
}

/*
   Returns whether vertex i of the nonmortar facets matches one of the n mortar vertices. If so, the mean gaps of the
   facets beside it vanish while both faces bend alike. Other formulations of the gap do not have this property when the
   faces slide.
*/
static PetscBool PrescribedRowsMatch(const ContactPairData *pair, const PrescribedMotions *m, PetscInt i, PetscInt n,
  const PrescribedVertex list[])
{
  PrescribedVertex vertex;

  if (pair->gap == GAP_NODE || ContactPairIsDual(pair)) return PETSC_FALSE;
  (void)PrescribedVertexGet(&pair->nonmortar, m, i, &vertex);
  for (PetscInt k = 0; k < n; ++k)
    if (PrescribedVertexDistance(&vertex, &list[k]) <= match_tolerance * vertex.size) return PETSC_TRUE;
  return PETSC_FALSE;
}

/*
   Collective. Lists the rows of the pair where `free` is zero, each with its neighbours on the same facet where `free`
   is not zero, unless the neighbour matches one of the n mortar vertices. neighbours: row and neighbour, one after the
   other, as global numbers
*/
static PetscErrorCode PrescribedRowsFindNeighbours(const ContactPairData *pair, const PrescribedMotions *m, PetscInt n,
  const PrescribedVertex list[], Vec free, PetscInt *nneighbours, PetscInt (**neighbours)[2])
{
  Vec                gathered;
  const PetscScalar *at;

  PetscFunctionBegin;
  *nneighbours = 0;
  PetscCall(PetscMalloc1(8 * pair->nonmortar.nfacets, neighbours));
  PetscCall(PrescribedRowsGather(pair, free, &gathered));
  PetscCall(VecGetArrayRead(gathered, &at));
  for (PetscInt i = 0; i < 4 * pair->nonmortar.nfacets; ++i) {
    const PetscInt edge[2] = {4 * (i / 4) + (i + 1) % 4, 4 * (i / 4) + (i + 3) % 4};

    for (PetscInt e = 0; e < 2 && PetscRealPart(at[i]) == 0.0; ++e) {
      if (PetscRealPart(at[edge[e]]) == 0.0 || PrescribedRowsMatch(pair, m, edge[e], n, list)) continue;
      (*neighbours)[*nneighbours][0]     = pair->row[i];
      (*neighbours)[(*nneighbours)++][1] = pair->row[edge[e]];
    }
  }
  PetscCall(VecRestoreArrayRead(gathered, &at));
  PetscCall(VecDestroy(&gathered));
  PetscFunctionReturn(0);
}

/* Collective. Sets `free` to zero on the free neighbours of rows where it is zero, unless they match a mortar vertex */
static PetscErrorCode PrescribedRowsMarkBeside(const ContactPairData *pair, const PrescribedMotions *m, PetscInt n,
  const PrescribedVertex list[], Vec free)
{
  PetscInt nbeside, (*beside)[2];

  PetscFunctionBegin;
  PetscCall(PrescribedRowsFindNeighbours(pair, m, n, list, free, &nbeside, &beside));
  for (PetscInt k = 0; k < nbeside; ++k) PetscCall(VecSetValue(free, beside[k][1], 0.0, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(free));
  PetscCall(VecAssemblyEnd(free));
  PetscCall(PetscFree(beside));
  PetscFunctionReturn(0);
}

/* Collective. For each prescribed row, adds 1 to `weights` in the columns of its free neighbours, and adds the number
   of these entries to `neighbours` */
static PetscErrorCode PrescribedRowsAddWeights(Contact contact, const ContactPairData *pair, PetscInt n,
  const PrescribedVertex list[], PetscInt beside, Vec free, Vec neighbours, Mat weights)
{
  PrescribedMotions m;
  PetscInt          nfound, (*found)[2];

  PetscFunctionBegin;
  PetscCall(PrescribedMotionsCreate(contact, &pair->nonmortar, &m));
  PetscCall(PrescribedRowsMarkFree(pair, &m, n, list, free));
  for (PetscInt k = 0; k < beside; ++k) PetscCall(PrescribedRowsMarkBeside(pair, &m, n, list, free));
  PetscCall(PrescribedRowsFindNeighbours(pair, &m, n, list, free, &nfound, &found));
  for (PetscInt k = 0; k < nfound; ++k) {
    PetscCall(MatSetValue(weights, found[k][0], found[k][1], 1.0, ADD_VALUES));
    PetscCall(VecSetValue(neighbours, found[k][0], 1.0, ADD_VALUES));
  }
  PetscCall(PetscFree(found));
  PetscCall(PrescribedMotionsDestroy(&m));
  PetscFunctionReturn(0);
}

/* Collective. Completes the weights. A row without entries gets the entry 1 on the diagonal. The others are divided by
   their number of entries. If the gap of their pair is measured at nodes, they are set to zero instead. */
static PetscErrorCode PrescribedRowsFinish(Contact contact, Vec neighbours, Mat weights)
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

      if (count == 0.0) PetscCall(MatSetValue(weights, rstart + i, rstart + i, 1.0, ADD_VALUES));
      n[i] = count == 0.0 ? 1.0 : contact->pairs[p].gap == GAP_NODE ? 0.0 : 1.0 / count;
    }
  }
  PetscCall(VecRestoreArray(neighbours, &n));
  PetscCall(MatAssemblyBegin(weights, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(weights, MAT_FINAL_ASSEMBLY));
  PetscCall(MatDiagonalScale(weights, neighbours, NULL));
  PetscFunctionReturn(0);
}

/* Collective. Multiplies rows->hanging by the weights, and computes rows->weight anew */
static PetscErrorCode PrescribedRowsCombine(Contact contact, Mat weights)
{
  ContactRows *rows = &contact->rows;

  PetscFunctionBegin;
  if (rows->hanging) {
    Mat both;

    PetscCall(MatMatMult(rows->hanging, weights, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &both));
    PetscCall(MatDestroy(&rows->hanging));
    rows->hanging = both;
  } else {
    PetscCall(PetscObjectReference((PetscObject)weights));
    rows->hanging = weights;
  }
  PetscCall(ContactHangingRowsWeigh(rows));
  PetscFunctionReturn(0);
}

/*
   Collective. Distributes the rows of vertices that are `beside` facets away from prescribed ones among their
   neighbours. *any: whether there are such rows
*/
static PetscErrorCode PrescribedRowsDistribute(Contact contact, PetscInt beside, PetscBool *any)
{
  ContactRows *rows = &contact->rows;
  Vec          free, neighbours;
  Mat          weights;
  PetscReal    most;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->mass, &free));
  PetscCall(VecDuplicate(rows->mass, &neighbours));
  PetscCall(VecZeroEntries(neighbours));
  PetscCall(MatCreateAIJ(contact->comm, rows->nlocal, rows->nlocal, PETSC_DETERMINE, PETSC_DETERMINE, 4, NULL, 4, NULL,
    &weights));
  PetscCall(MatSetOption(weights, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];
    PrescribedVertex      *list;
    PetscInt               n;

    if (pair->formula || pair->nonmortar.self || (beside && pair->gap == GAP_NODE)) continue;
    PetscCall(PrescribedVerticesGather(contact, &pair->mortar, &n, &list));
    if (n) PetscCall(PrescribedRowsAddWeights(contact, pair, n, list, beside, free, neighbours, weights));
    PetscCall(PetscFree(list));
  }
  PetscCall(VecAssemblyBegin(neighbours));
  PetscCall(VecAssemblyEnd(neighbours));
  PetscCall(VecNorm(neighbours, NORM_INFINITY, &most));
  *any = (PetscBool)(most > 0.0);
  if (*any) {
    PetscCall(PrescribedRowsFinish(contact, neighbours, weights));
    PetscCall(PrescribedRowsCombine(contact, weights));
  }
  PetscCall(MatDestroy(&weights));
  PetscCall(VecDestroy(&neighbours));
  PetscCall(VecDestroy(&free));
  PetscFunctionReturn(0);
}

/*
   Collective. Adds the sums of the rows of prescribed vertices to the rows of vertices beside them, by a change of
   rows->hanging. Does nothing if this was done before.
*/
PetscErrorCode ContactPrescribedRowsDistribute(Contact contact)
{
  ContactRows *rows = &contact->rows;
  PetscBool    any  = PETSC_TRUE;

  PetscFunctionBegin;
  if (rows->distributed || !contact->ndisplacements) PetscFunctionReturn(0);
  rows->distributed = PETSC_TRUE;
  for (PetscInt k = 0; k <= beyond && any; ++k) PetscCall(PrescribedRowsDistribute(contact, k, &any));
  PetscFunctionReturn(0);
}

/* Collective. Undoes ContactPrescribedRowsDistribute(), because the prescribed displacements change */
PetscErrorCode ContactPrescribedRowsReset(Contact contact)
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
