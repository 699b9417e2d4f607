/* Polygons in the plane: the area, and clipping by a convex polygon */
#include "geometryimpl.h"

/* Returns the signed area of a polygon, positive if its vertices are counterclockwise. Coordinates are taken relative
   to the first vertex, so that small polygons far from the origin lose no accuracy. */
PetscReal ContactPolygonArea(PetscInt n, const PetscReal p[][2])
{
  PetscReal area = 0.0;

  for (PetscInt i = 1; i + 1 < n; ++i)
    area += 0.5 * ((p[i][0] - p[0][0]) * (p[i + 1][1] - p[0][1]) - (p[i + 1][0] - p[0][0]) * (p[i][1] - p[0][1]));
  return area;
}

/* Returns twice the signed area of the triangle (a, b, p): positive if p is left of the line from a to b */
static PetscReal ClipLeftOf(const PetscReal a[2], const PetscReal b[2], const PetscReal p[2])
{
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Stores the vertex y, at which the edge number `before` ends and the edge number `after` begins */
static void ClipPutVertex(const PetscReal y[2], PetscInt before, PetscInt after, PetscReal out[2], PetscInt edge[2])
{
  out[0]  = y[0];
  out[1]  = y[1];
  edge[0] = before;
  edge[1] = after;
}

/*
   Clips the polygon `subject` by every edge of the convex polygon `clip` (algorithm of Sutherland and Hodgman). Returns
   the number of vertices of the result `out`, or 0 if nothing is left. A vertex on an edge of clip counts as inside. An
   edge is cut only if its two ends lie strictly on different sides, so that there is no division by zero. Where edges
   or vertices of the polygons coincide, the result has repeated vertices, which enclose no area. edge[i] are the two
   edges that meet at vertex i of the result. Edge e < nsubject starts at vertex e of subject; edge nsubject + e starts
   at vertex e of clip.
*/
PetscInt ContactClip(PetscInt nsubject, const PetscReal subject[][2], PetscInt nclip, const PetscReal clip[][2],
  PetscReal out[][2], PetscInt edge[][2])
{
  PetscReal in[CONTACT_MAX_POLYGON][2];
  PetscInt  n = nsubject, along[CONTACT_MAX_POLYGON][2];

  for (PetscInt i = 0; i < n; ++i) ClipPutVertex(subject[i], (i + n - 1) % n, i, out[i], edge[i]);
  for (PetscInt e = 0; e < nclip && n > 2; ++e) {
    const PetscReal *a = clip[e], *b = clip[(e + 1) % nclip];
    const PetscInt   nin = n;
    PetscReal        last;

    for (PetscInt i = 0; i < nin; ++i) ClipPutVertex(out[i], edge[i][0], edge[i][1], in[i], along[i]);
    n    = 0;
    last = ClipLeftOf(a, b, in[nin - 1]);
    for (PetscInt i = 0; i < nin; ++i) {
      const PetscReal *p = in[(i + nin - 1) % nin], *q = in[i];
      const PetscReal  d = ClipLeftOf(a, b, q);

      if ((d >= 0.0) != (last >= 0.0)) {
        const PetscReal t    = last / (last - d);
        const PetscReal y[2] = {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};

        ClipPutVertex(y, d >= 0.0 ? nsubject + e : along[i][0], d >= 0.0 ? along[i][0] : nsubject + e, out[n], edge[n]);
        ++n;
      }
      if (d >= 0.0) {
        ClipPutVertex(q, along[i][0], along[i][1], out[n], edge[n]);
        ++n;
      }
      last = d;
    }
  }
  return n > 2 ? n : 0;
}
