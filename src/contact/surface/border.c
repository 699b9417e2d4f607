/* The border of a face, and the vertices of a face whose displacement is prescribed. An edge is on the border if only
   one facet of the face, on any rank, has it. */
#include <string.h>
#include <mesh.h>
#include "surfaceimpl.h"
#include "src/mesh/query/queryimpl.h"

/*
   Finds the edge of the mesh between two vertices of a facet. If the facet is a part of a facet of order 2, one of its
   vertices may be the midside node of an edge, or the centre of a facet; the result is then that edge or facet. *edge
   is -1 for an edge inside a triangle, and for the edge of length zero of a triangle, whose last vertex is stored
   twice.
*/
static PetscErrorCode BorderFindEdge(DM dm, PetscInt v, PetscInt w, PetscInt *edge)
{
  const PetscInt  vertices[2] = {v, w};
  const PetscInt *edges;
  PetscInt        n, depth[2];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 2; ++i) PetscCall(DMPlexGetPointDepth(dm, vertices[i], &depth[i]));
  *edge = v == w || (depth[0] == 1 && depth[1] == 1) ? -1 : depth[0] > depth[1] ? v : w;
  if (*edge < 0 || depth[0] || depth[1]) PetscFunctionReturn(0);
  PetscCall(DMPlexGetJoin(dm, 2, vertices, &n, &edges));
  PetscCheck(n == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB,
    "Vertices %" PetscInt_FMT " and %" PetscInt_FMT " of a facet have %" PetscInt_FMT " common edges instead of one", v,
    w, n);
  *edge = edges[0];
  PetscCall(DMPlexRestoreJoin(dm, 2, vertices, &n, &edges));
  PetscFunctionReturn(0);
}

/* Collective. Finds the border of the surface s. Sets s->border, s->rim and s->bordered. */
PetscErrorCode ContactSurfaceFindBorder(DM dm, ContactSurface *s)
{
  PetscSF   sf;
  PetscInt  npoints, *count; /* 2 for each facet of the face at an edge of the mesh, or 1 for each half of the edge */
  PetscInt *ends;            /* 1 for each vertex on the border */
  PetscInt *edge;            /* mesh edge from each vertex of a facet to the next */

  PetscFunctionBegin;
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(DMPlexGetChart(dm, NULL, &npoints));
  PetscCall(PetscCalloc2(npoints, &count, npoints, &ends));
  PetscCall(PetscMalloc1(4 * s->nfacets, &edge));
  PetscCall(PetscCalloc1(s->nfacets, &s->border));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    PetscCall(BorderFindEdge(dm, s->vertex[i], s->vertex[4 * (i / 4) + (i + 1) % 4], &edge[i]));
    if (edge[i] >= 0)
      count[edge[i]] += edge[i] == s->vertex[i] || edge[i] == s->vertex[4 * (i / 4) + (i + 1) % 4] ? 1 : 2;
  }
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_SUM, count));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    if (edge[i] >= 0 && count[edge[i]] == 2) ends[s->vertex[i]] = ends[s->vertex[4 * (i / 4) + (i + 1) % 4]] = 1;
  }
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_MAX, ends));
  PetscCall(PetscBTCreate(npoints, &s->rim));
  for (PetscInt v = 0; v < npoints; ++v) {
    if (ends[v]) PetscCall(PetscBTSet(s->rim, v));
  }
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    /* The last vertex of a triangle is stored twice. The edge of length zero in between is on the border if the vertex
       is. */
    const PetscBool point = (PetscBool)(i % 4 == 2 && s->vertex[i] == s->vertex[i + 1]);

    if (point ? ends[s->vertex[i]] : edge[i] >= 0 && count[edge[i]] == 2) s->border[i / 4] |= 1 << (i % 4);
    if (ends[s->vertex[i]]) s->border[i / 4] |= 16 << (i % 4);
  }
  s->bordered = PETSC_TRUE;
  PetscCall(PetscFree(edge));
  PetscCall(PetscFree2(count, ends));
  PetscFunctionReturn(0);
}

/* Combines `value` with the marks of the nodes of all facets of a face on this rank: by bitwise or if op is MPI_BOR,
   else by the maximum */
static PetscErrorCode BorderMarkFace(DM dm, const char face[], MPI_Op op, PetscInt value, PetscInt marks[])
{
  IS              facets;
  const PetscInt *f;
  PetscInt        nfacets;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &nfacets));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < nfacets; ++i) {
    PetscInt nnodes, nodes[MESH_MAX_FACET_NODES];

    PetscCall(MeshGetFacetNodes(dm, f[i], &nnodes, nodes));
    for (PetscInt a = 0; a < nnodes; ++a)
      marks[nodes[a]] = op == MPI_BOR ? marks[nodes[a]] | value : PetscMax(marks[nodes[a]], value);
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Returns whether a face is of the body of the surface. Bodies have no nodes in common, so that other faces cannot hold
   the surface. */
static PetscBool BorderIsOfBody(const char face[], const ContactSurface *s)
{
  const size_t length = strcspn(s->name, ".");

  return (PetscBool)(strcspn(face, ".") == length && !strncmp(face, s->name, length));
}

/* Collective. Finds the vertices of s at which faces with these prescribed displacements hold the mesh. Sets
   s->prescribed. */
PetscErrorCode ContactSurfaceFindPrescribed(DM dm, PetscInt n, const SceneDisplacement displacements[],
  ContactSurface *s)
{
  PetscSF  sf;
  PetscInt npoints, *bits;

  PetscFunctionBegin;
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(DMPlexGetChart(dm, NULL, &npoints));
  PetscCall(PetscCalloc1(npoints, &bits));
  for (PetscInt k = 0; k < n; ++k) {
    const SceneDisplacement *d    = &displacements[k];
    const PetscInt           axes = (d->fixed[0] ? 1 : 0) | (d->fixed[1] ? 2 : 0) | (d->fixed[2] ? 4 : 0);

    if (!d->moves && BorderIsOfBody(d->face, s)) PetscCall(BorderMarkFace(dm, d->face, MPI_BOR, axes, bits));
  }
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_BOR, bits));
  PetscCall(PetscFree(s->prescribed));
  PetscCall(PetscCalloc1(s->nfacets, &s->prescribed));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) s->prescribed[i / 4] |= bits[s->vertex[i]] << 3 * (i % 4);
  PetscCall(PetscFree(bits));
  PetscFunctionReturn(0);
}

/* Returns the number of the first displacement that prescribes the same motion along the axis as displacement k: an
   equal value with an equal ramp. Returns CONTACT_AT_REST if displacement k prescribes zero. */
static PetscInt BorderFindMotion(const SceneDisplacement displacements[], PetscInt k, PetscInt axis)
{
  const SceneDisplacement *d     = &displacements[k];
  PetscInt                 first = 0;

  if (d->value[axis] == 0.0) return CONTACT_AT_REST;
  while (first < k && !(displacements[first].fixed[axis] && displacements[first].value[axis] == d->value[axis] &&
                        displacements[first].ramp == d->ramp))
    ++first;
  return first;
}

/* Collective. Computes motion[4 i + a], which says what prescribes the displacement of vertex a of facet i along the
   axis: the number of a displacement, CONTACT_AT_REST, or CONTACT_FREE */
PetscErrorCode ContactSurfaceFindMotions(DM dm, PetscInt n, const SceneDisplacement displacements[], PetscInt axis,
  const ContactSurface *s, PetscInt motion[])
{
  PetscSF  sf;
  PetscInt npoints, *marks;

  PetscFunctionBegin;
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(DMPlexGetChart(dm, NULL, &npoints));
  PetscCall(PetscMalloc1(npoints, &marks));
  for (PetscInt v = 0; v < npoints; ++v) marks[v] = CONTACT_FREE;
  for (PetscInt k = 0; k < n; ++k) {
    if (displacements[k].moves || !displacements[k].fixed[axis] || !BorderIsOfBody(displacements[k].face, s)) continue;
    PetscCall(BorderMarkFace(dm, displacements[k].face, MPI_MAX, BorderFindMotion(displacements, k, axis), marks));
  }
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_MAX, marks));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) motion[i] = marks[s->vertex[i]];
  PetscCall(PetscFree(marks));
  PetscFunctionReturn(0);
}

/* Collective. Computes plane[4 i + a]: 1 + the number of the inclined symmetry plane that contains vertex a of facet i,
   or 0 if there is none */
PetscErrorCode ContactSurfaceFindPlanes(DM dm, PetscInt n, const SceneDisplacement displacements[],
  const ContactSurface *s, PetscInt plane[])
{
  PetscSF  sf;
  PetscInt npoints, *marks;

  PetscFunctionBegin;
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(DMPlexGetChart(dm, NULL, &npoints));
  PetscCall(PetscCalloc1(npoints, &marks));
  for (PetscInt k = 0; k < n; ++k) {
    if (displacements[k].inclined && !displacements[k].moves && BorderIsOfBody(displacements[k].face, s))
      PetscCall(BorderMarkFace(dm, displacements[k].face, MPI_MAX, k + 1, marks));
  }
  PetscCall(ValuesReduce(sf, MPIU_INT, MPI_MAX, marks));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) plane[i] = marks[s->vertex[i]];
  PetscCall(PetscFree(marks));
  PetscFunctionReturn(0);
}
