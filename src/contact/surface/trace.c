/*
   Faces of order 2 are divided at their nodes into four facets each, and contact forces act on the vertices of these
   facets. Bilinear interpolation between the nodes differs from the quadratic displacement of the face. Without a
   correction, nodal forces from a uniform pressure would bend the cells. The correction is the matrix T. Along each
   edge

     (T u)_middle = u_middle + (2 u_middle - u_first - u_last)/6.

   At the centre of a facet this is applied in both directions. Bilinear interpolation of T u on the four parts has the
   same integral as the quadratic u, and equals u where u is linear. Hence T^T maps nodal forces of bilinear facets to
   nodal forces of the quadratic face. They are exact if the facets are plane, with straight edges, and fully
   covered. The resultant is always exact.
*/
#include <petscsf.h>
#include <mesh.h>
#include "surfaceimpl.h"

#define TRACE_MAX_NODES MESH_MAX_FACET_NODES

/* Marks the mesh points, edges and facets, that carry midside nodes of the surfaces: those of this rank's facets, and
   those that this rank owns */
static PetscErrorCode TraceMark(DM dm, PetscInt nsurfaces, const ContactSurface *const surface[], PetscInt marked[])
{
  PetscSF  sf;
  PetscInt nroots, vstart, vend;

  PetscFunctionBegin;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &vstart, &vend));
  for (PetscInt k = 0; k < nsurfaces; ++k) {
    for (PetscInt i = 0; i < 4 * surface[k]->nfacets; ++i) {
      const PetscInt p = surface[k]->vertex[i];

      if (p < vstart || p >= vend) marked[p] = 1;
    }
  }
  PetscCall(DMGetPointSF(dm, &sf));
  PetscCall(PetscSFGetGraph(sf, &nroots, NULL, NULL, NULL));
  if (nroots < 0) PetscFunctionReturn(0);
  PetscCall(PetscSFReduceBegin(sf, MPIU_INT, marked, marked, MPI_MAX));
  PetscCall(PetscSFReduceEnd(sf, MPIU_INT, marked, marked, MPI_MAX));
  PetscFunctionReturn(0);
}

/* One node's rows of T - 1 or of T^-1 - 1: the nodes that it depends on, and their weights. The weights at a facet's
   centre are products of the weights along edges. */
typedef struct {
  PetscInt  row;                     /* first global row of the node; negative if another rank owns the node */
  PetscInt  n;                       /* number of weights */
  PetscInt  column[TRACE_MAX_NODES]; /* first global column of each node that it depends on */
  PetscReal weight[TRACE_MAX_NODES];
} TracePoint;

static PetscErrorCode TraceGetPoint(DM dm, PetscInt point, ContactTraceType type, TracePoint *trace)
{
  /* The first index is the type of the correction, the second the depth of the mesh point that carries the node. */
  static const PetscReal of_edge[2][2]  = {{-1.0 / 6.0, 1.0 / 3.0}, {1.0 / 8.0, -1.0 / 4.0}};
  static const PetscReal of_facet[2][3] = {{1.0 / 36.0, -2.0 / 9.0, 7.0 / 9.0}, {1.0 / 64.0, 3.0 / 32.0, -7.0 / 16.0}};
  PetscSection           global;
  PetscInt               depth, own, npoints, *closure = NULL;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(PetscSectionGetOffset(global, point, &trace->row));
  PetscCall(DMPlexGetPointDepth(dm, point, &own));
  PetscCall(DMPlexGetTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  trace->n = npoints;
  for (PetscInt p = 0; p < npoints; ++p) {
    PetscInt column;

    PetscCall(PetscSectionGetOffset(global, closure[2 * p], &column));
    PetscCall(DMPlexGetPointDepth(dm, closure[2 * p], &depth));
    trace->column[p] = column < 0 ? -(column + 1) : column;
    trace->weight[p] = own == 1 ? of_edge[type][depth] : of_facet[type][depth];
  }
  PetscCall(DMPlexRestoreTransitiveClosure(dm, point, PETSC_TRUE, &npoints, &closure));
  PetscFunctionReturn(0);
}

/* The layout of a correction: its type, and the number of components per node */
typedef struct {
  DM               dm;
  ContactTraceType type;
  PetscInt         components;
} TraceLayout;

/* Processes the rows of the marked points that this rank owns. If diagonal and offdiagonal are given, counts their
   entries; if both are NULL, inserts the entries into the matrix. */
static PetscErrorCode TraceFill(const TraceLayout *layout, PetscInt npoints, const PetscInt marked[], PetscInt rstart,
  PetscInt rend, PetscInt diagonal[], PetscInt offdiagonal[], Mat correction)
{
  const PetscInt n = layout->components;

  PetscFunctionBegin;
  for (PetscInt p = 0; p < npoints; ++p) {
    TracePoint point;

    if (!marked[p]) continue;
    PetscCall(TraceGetPoint(layout->dm, p, layout->type, &point));
    if (point.row < 0) continue;
    for (PetscInt a = 0; a < point.n; ++a) {
      for (PetscInt c = 0; c < n; ++c) {
        const PetscInt row = point.row / 3 * n + c, column = point.column[a] / 3 * n + c;

        if (!diagonal) PetscCall(MatSetValue(correction, row, column, point.weight[a], INSERT_VALUES));
        else ++(column >= rstart && column < rend ? diagonal : offdiagonal)[row - rstart];
      }
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates T - 1 or T^-1 - 1, with nonzero rows at the marked points only */
static PetscErrorCode TraceCreateMatrix(const TraceLayout *layout, PetscInt npoints, const PetscInt marked[],
  Mat *correction)
{
  PetscInt rstart, rend, *diagonal, *offdiagonal;
  Vec      u;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(layout->dm, &u));
  PetscCall(VecGetOwnershipRange(u, &rstart, &rend));
  PetscCall(DMRestoreGlobalVector(layout->dm, &u));
  rstart = rstart / 3 * layout->components;
  rend   = rend / 3 * layout->components;
  PetscCall(MatCreate(PetscObjectComm((PetscObject)layout->dm), correction));
  PetscCall(MatSetSizes(*correction, rend - rstart, rend - rstart, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*correction, MATAIJ));
  PetscCall(PetscCalloc2(rend - rstart, &diagonal, rend - rstart, &offdiagonal));
  PetscCall(TraceFill(layout, npoints, marked, rstart, rend, diagonal, offdiagonal, *correction));
  PetscCall(MatXAIJSetPreallocation(*correction, 1, diagonal, offdiagonal, NULL, NULL));
  PetscCall(PetscFree2(diagonal, offdiagonal));
  PetscCall(TraceFill(layout, npoints, marked, rstart, rend, NULL, NULL, *correction));
  PetscCall(MatAssemblyBegin(*correction, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*correction, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Collective. Creates the matrix T - 1, or T^-1 - 1, for the given number of components per node. *correction is NULL
   if no surface has order 2. */
PetscErrorCode ContactTraceCreate(DM dm, PetscInt nsurfaces, const ContactSurface *const surface[],
  ContactTraceType type, PetscInt components, Mat *correction)
{
  const TraceLayout layout = {dm, type, components};
  PetscInt          npoints, *marked;
  PetscBool         any = PETSC_FALSE;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < nsurfaces; ++k) any = (PetscBool)(any || surface[k]->cut);
  *correction = NULL;
  if (!any) PetscFunctionReturn(0);
  PetscCall(DMPlexGetChart(dm, NULL, &npoints));
  PetscCall(PetscCalloc1(npoints, &marked));
  PetscCall(TraceMark(dm, nsurfaces, surface, marked));
  PetscCall(TraceCreateMatrix(&layout, npoints, marked, correction));
  PetscCall(PetscFree(marked));
  PetscFunctionReturn(0);
}

/* Computes the displacement `local` of the surfaces' vertices from the global displacement u of the mesh: T u */
PetscErrorCode ContactTraceApply(DM dm, Mat correction, Vec u, Vec local)
{
  Vec trace;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(dm, &trace));
  PetscCall(MatMultAdd(correction, u, u, trace));
  PetscCall(DMGlobalToLocal(dm, trace, INSERT_VALUES, local));
  PetscCall(DMRestoreGlobalVector(dm, &trace));
  PetscFunctionReturn(0);
}

/*
   Multiplies rows of a Jacobian by T from the right: derivatives with respect to the displacement of the surfaces'
   vertices become derivatives with respect to the displacement of the mesh's nodes.
*/
PetscErrorCode ContactTraceDifferentiate(Mat correction, Mat jacobian)
{
  Mat product;

  PetscFunctionBegin;
  PetscCall(MatMatMult(jacobian, correction, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatAXPY(jacobian, 1.0, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&product));
  PetscFunctionReturn(0);
}

/* Multiplies `rows` by T^-1 from the left: rows that give the displacement of a surface's vertices become rows that
   give the displacement of the mesh's nodes. correction: T^-1 - 1 */
PetscErrorCode ContactTraceRecover(Mat correction, Mat rows)
{
  Mat product;

  PetscFunctionBegin;
  PetscCall(MatMatMult(correction, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  PetscCall(MatAXPY(rows, 1.0, product, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(&product));
  PetscFunctionReturn(0);
}
