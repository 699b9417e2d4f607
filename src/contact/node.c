/* Node to segment: each nonmortar vertex against the closest point of the mortar face */
#include "contactimpl.h"

/* A vertex beyond the mortar face's border by more than this part of the facet's size faces nothing */
#define BORDER_MARGIN 0.05

/* Whether the closest point is on the border of the mortar face */
static PetscBool NodeIsOnBorder(PetscInt border, const PetscReal xi[2])
{
  static const PetscInt vertex[2][2] = {{0, 3}, {1, 2}}; /* at (xi, eta) = (-1 or 1, -1 or 1) */
  const PetscInt        i = xi[0] >= 1.0, j = xi[1] >= 1.0;

  if (PetscAbsReal(xi[0]) >= 1.0 && PetscAbsReal(xi[1]) >= 1.0) return (PetscBool)((border >> (4 + vertex[i][j]) & 1) != 0);
  if (PetscAbsReal(xi[0]) >= 1.0) return (PetscBool)((border >> (i ? 1 : 3) & 1) != 0);
  if (PetscAbsReal(xi[1]) >= 1.0) return (PetscBool)((border >> (j ? 2 : 0) & 1) != 0);
  return PETSC_FALSE;
}

/* Whether the vertex x is beside the mortar face: its closest point y is on the border, and x is not along the facet's normal there */
static PetscBool NodeIsBesideFace(const ContactCandidates *mortar, const ContactNearest *nearest, const PetscReal x[3])
{
  const PetscReal *facet = &mortar->x[12 * nearest->facet];
  PetscReal        t1[3], t2[3], n[3], r[3], area = 0.0, height = 0.0, beside = 0.0;

  if (!NodeIsOnBorder(mortar->border[nearest->facet], nearest->xi)) return PETSC_FALSE;
  ContactFacetTangents(facet, nearest->xi, t1, t2);
  for (PetscInt c = 0; c < 3; ++c) {
    const PetscInt d = (c + 1) % 3, e = (c + 2) % 3;

    n[c] = t1[d] * t2[e] - t1[e] * t2[d];
    r[c] = x[c] - nearest->y[c];
    area += n[c] * n[c]; /* squared, of a quarter of the facet */
    height += n[c] * r[c];
  }
  if (!(area > 0.0)) return PETSC_FALSE;
  for (PetscInt c = 0; c < 3; ++c) beside += PetscSqr(r[c] - height / area * n[c]);
  return (PetscBool)(beside > PetscSqr(BORDER_MARGIN) * 4.0 * PetscSqrtReal(area));
}

/* Box about the balls around this rank's vertices that reach to the mortar face */
static PetscErrorCode ContactBox_Node(Contact contact, PetscInt p, PetscReal box[6])
{
  const ContactRows *rows  = &contact->rows;
  const PetscReal    reach = PetscMax(contact->pairs[p].distance, contact->pairs[p].depth) + contact->pairs[p].bulge;

  PetscFunctionBegin;
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    for (PetscInt c = 0; c < 3; ++c) {
      box[c]     = PetscMin(box[c], rows->x[3 * i + c] - reach);
      box[3 + c] = PetscMax(box[3 + c], rows->x[3 * i + c] + reach);
    }
  }
  PetscFunctionReturn(0);
}

/* Along the normal n, from the vertex x to the closest point, or to the plane that touches the smooth surface beside it where that is off its facet */
static PetscReal VertexGap(const ContactSurface *s, const ContactCandidates *mortar, const ContactNearest *nearest, const PetscReal x[3], const PetscReal n[3])
{
  PetscReal    offset[3] = {0, 0, 0}, r[3], m[3];
  ContactPatch patch;

  for (PetscInt c = 0; c < 3; ++c) r[c] = nearest->y[c] - x[c];
  if (s->patched) {
    ContactPatchCreate(&mortar->x[12 * nearest->facet], &mortar->patch[12 * nearest->facet], &patch);
    ContactPatchEvaluate(&patch, nearest->xi, offset, m);
    for (PetscInt c = 0; c < 3; ++c) r[c] += offset[c];
    if (ContactPatchBulge(&patch) > 0.0) return ContactPatchDistance(r, m, n);
  }
  return r[0] * n[0] + r[1] * n[1] + r[2] * n[2];
}

/* gap = (y - x).n, its coupling N2_B(xi) - 1; both times the mass that the assembly divides by */
static PetscErrorCode NodeAddVertex(Contact contact, PetscInt i, PetscInt row, PetscReal mass, const ContactCandidates *mortar, const ContactNearest *nearest, PetscReal gap, ContactAssembly *assembly)
{
  const PetscScalar weighted = mass * gap;
  PetscSection      global;
  PetscInt          offset;
  PetscReal         value[4];

  PetscFunctionBegin;
  ContactShape(nearest->xi, value);
  for (PetscInt b = 0; b < 4; ++b) value[b] *= mass;
  PetscCall(ContactAssemblyAdd(assembly, row, 4, &mortar->node[4 * nearest->facet], value, &contact->rows.normal[3 * i]));
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  PetscCall(PetscSectionGetOffset(global, contact->rows.vertex[i], &offset));
  offset /= 3;
  value[0] = -mass;
  PetscCall(ContactAssemblyAdd(assembly, row, 1, &offset, value, &contact->rows.normal[3 * i]));
  PetscCall(VecSetValue(assembly->gap, row, weighted, ADD_VALUES));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactAdd_Node(Contact contact, PetscInt p, const ContactCandidates *mortar, ContactAssembly *assembly)
{
  ContactPairData   *pair  = &contact->pairs[p];
  const ContactRows *rows  = &contact->rows;
  const PetscReal    reach = PetscMax(pair->distance, pair->depth) + pair->bulge;
  const PetscScalar *mass;
  PetscInt           rstart;
  ContactTree        tree;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscCall(ContactTreeCreate(mortar, &tree));
  PetscCall(VecGetOwnershipRange(rows->mass, &rstart, NULL));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    const PetscReal *x = &rows->x[3 * i], *n = &rows->normal[3 * i];
    ContactNearest   nearest;
    PetscReal        gap;

    ContactFindNearest(&tree, mortar, contact->cosine, reach, x, n, &nearest);
    if (nearest.facet < 0 || NodeIsBesideFace(mortar, &nearest, x)) continue;
    gap = VertexGap(&pair->mortar, mortar, &nearest, x, n);
    if (gap > pair->distance || gap < -pair->depth) continue;
    PetscCall(NodeAddVertex(contact, i, rstart + i, PetscRealPart(mass[i]), mortar, &nearest, gap, assembly));
    ++pair->nfacing;
  }
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscCall(ContactTreeDestroy(&tree));
  PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

const ContactGapOps ContactGapNode = {ContactBox_Node, ContactAdd_Node};
