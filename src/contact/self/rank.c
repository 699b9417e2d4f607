/* Order of the facets of a surface in contact with itself, and how deep the body is below them */
#include <mesh.h>
#include "selfimpl.h"

/* Direction along which facets are ordered. It is irregular, so that no face is likely to be perpendicular to it. */
static const PetscReal rank_direction[3] = {0.4359, 0.2719, 0.8579};

/* Computes the distance by which the other vertices of the facet's cell lie behind the plane of the undeformed
   facet: that of the nearest vertex; 0 if one of them lies in the plane. facet: a facet of the mesh; normal: its
   unit normal */
static PetscErrorCode RankDepthBelow(DM dm, PetscInt facet, PetscReal *below)
{
  const PetscInt *cell;
  PetscInt        ncorners, corner[4], vertex[8];
  PetscReal       x[12], y[8][3], normal[3] = {0.0, 0.0, 0.0};

  PetscFunctionBegin;
  PetscCall(DMPlexGetSupport(dm, facet, &cell));
  PetscCall(MeshGetFacetVertices(dm, facet, corner));
  PetscCall(MeshGetCellCorners(dm, cell[0], &ncorners, vertex));
  PetscCall(MeshGetVertexCoordinates(dm, 4, corner, (PetscReal(*)[3])x));
  PetscCall(MeshGetVertexCoordinates(dm, ncorners, vertex, y));
  (void)ContactFacetNormal(x, normal);
  *below = PETSC_MAX_REAL;
  for (PetscInt b = 0; b < ncorners; ++b) {
    PetscBool own   = PETSC_FALSE;
    PetscReal depth = 0.0;

    for (PetscInt a = 0; a < 4; ++a) own = (PetscBool)(own || corner[a] == vertex[b]);
    for (PetscInt c = 0; c < 3; ++c) depth += normal[c] * (x[c] - y[b][c]);
    if (!own) *below = PetscMin(*below, PetscMax(depth, 0.0));
  }
  PetscFunctionReturn(0);
}

/* Returns the rank of a facet, by which facets are ordered: the coordinate, along rank_direction, of a point at this
   depth below the centre of the undeformed facet. Facets that touch each other thus have different ranks. */
static PetscReal RankFacet(const PetscReal x[12], PetscReal depth)
{
  PetscReal normal[3] = {0.0, 0.0, 0.0}, rank = 0.0;

  (void)ContactFacetNormal(x, normal);
  for (PetscInt c = 0; c < 3; ++c)
    rank += rank_direction[c] * (0.25 * (x[c] + x[3 + c] + x[6 + c] + x[9 + c]) - depth * normal[c]);
  return rank;
}

/* Collective. Prepares a surface for contact with itself: computes the rank of its facets, and the depth of the
   cells below them */
PetscErrorCode ContactSelfCreate(DM dm, ContactSurface *s)
{
  IS              facets;
  const PetscInt *f;
  PetscInt        n, k = 0;
  PetscReal       largest = 0.0;

  PetscFunctionBegin;
  s->self = PETSC_TRUE;
  PetscCall(PetscMalloc2(s->nfacets, &s->rank, s->nfacets, &s->below));
  for (PetscInt i = 0; i < s->nfacets; ++i) largest = PetscMax(largest, ContactFacetDiameter(&s->reference[12 * i]));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, PetscObjectComm((PetscObject)dm)));
  for (PetscInt i = 0; i < s->nfacets; ++i) s->rank[i] = RankFacet(&s->reference[12 * i], largest);
  PetscCall(MeshGetFacets(dm, s->name, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt  npieces, pieces[MESH_MAX_FACET_PIECES][4];
    PetscReal below = 0.0;

    PetscCall(MeshGetFacetPieces(dm, f[i], &npieces, pieces));
    PetscCall(RankDepthBelow(dm, f[i], &below));
    for (PetscInt p = 0; p < npieces; ++p) s->below[k++] = below;
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

ContactSelfFacet ContactSelfOwn(const ContactSurface *s, PetscInt f)
{
  return (ContactSelfFacet){&s->node[4 * f], &s->reference[12 * f], s->rank[f], s->below[f]};
}

ContactSelfFacet ContactSelfCandidate(const ContactCandidates *facets, PetscInt k)
{
  const PetscReal *self = &facets->self[CONTACT_SELF_REALS * k];

  return (ContactSelfFacet){&facets->node[4 * k], self, self[12], self[13]};
}
