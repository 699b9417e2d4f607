/*
   Geometry of facets, polygons and boxes, independent of the mesh.
*/
#ifndef GEOMETRYIMPL_H
#define GEOMETRYIMPL_H

#include <contact.h>
#include <vector3.h>
#include <petsccompat.h>

/* quadrature.c: quadrature rules on triangles */
#define CONTACT_RULE_DEGREE 8 /* highest degree of the polynomials that a rule integrates exactly */
#define CONTACT_RULE_POINTS 16
typedef struct {
  /* degree of exactness and number of points */
  PetscInt degree, n;
  /* barycentric coordinates of the points, and weights as fractions of the triangle's area (their sum is 1) */
  PetscReal barycentric[CONTACT_RULE_POINTS][3], weight[CONTACT_RULE_POINTS];
} ContactRule;
PETSC_INTERN PetscErrorCode ContactRuleCreate(PetscInt degree, ContactRule *);

/*
   facet.c: bilinear facets. A facet is stored as the coordinates of its four vertices, x[3 * vertex + component], in
   counterclockwise order seen from outside its body. A triangle stores its last vertex twice. The sum of the two shape
   functions of that vertex is the linear shape function of the triangle there.
*/
PETSC_INTERN PetscBool ContactFacetIsTriangle(const PetscReal x[12]);
PETSC_INTERN void      ContactShape(const PetscReal xi[2], PetscReal phi[4]);
PETSC_INTERN void      ContactShapeSlopes(const PetscReal xi[2], PetscReal dphi[4][2]);
PETSC_INTERN PetscReal ContactFacetDiameter(const PetscReal x[12]);
PETSC_INTERN void      ContactFacetAreaVector(const PetscReal x[12], PetscReal a[3]);
PETSC_INTERN void      ContactFacetTurn(const PetscReal x[12], const PetscReal moment[3], PetscReal by_x[12]);
PETSC_INTERN void ContactFacetTangents(const PetscReal x[12], const PetscReal xi[2], PetscReal t1[3], PetscReal t2[3]);
PETSC_INTERN PetscReal ContactFacetMass(const PetscReal x[12], PetscReal mass[4]);

/* The map of a plane facet, y = c0 + c1 xi + c2 eta + c3 xi eta, and its vertices q */
typedef struct {
  PetscReal q[4][2], c[4][2];
  PetscBool triangle;
} ContactBilinear;
PETSC_INTERN void ContactBilinearCreate(const PetscReal q[4][2], ContactBilinear *);
PETSC_INTERN void ContactInverseMap(const ContactBilinear *, const PetscReal y[2], PetscReal bound, PetscReal xi[2]);

/* frame.c: the plane onto which a nonmortar facet is projected. axis[0] and axis[1] span the plane; axis[2] is its unit
   normal. */
typedef struct {
  PetscReal origin[3], axis[3][3];
} ContactFrame;
PETSC_INTERN PetscBool ContactFacetNormal(const PetscReal x[12], PetscReal n[3]);
PETSC_INTERN PetscBool ContactFrameCreate(const PetscReal x[12], ContactFrame *);
PETSC_INTERN void      ContactFrameProject(const ContactFrame *, const PetscReal x[12], PetscReal p[4][2],
       PetscReal height[4]);

/* clip.c: convex polygons in the plane. Their vertices are counterclockwise. */
#define CONTACT_MAX_POLYGON 32
PETSC_INTERN PetscReal ContactPolygonArea(PetscInt n, const PetscReal p[][2]);
PETSC_INTERN PetscInt  ContactClip(PetscInt nsubject, const PetscReal subject[][2], PetscInt nclip,
   const PetscReal clip[][2], PetscReal out[][2], PetscInt edge[][2]);

/* extend.c: extends mortar facets beyond the border of their face where the border of the nonmortar face coincides with
   it */
PETSC_INTERN PetscBool ContactExtendBorder(const PetscReal p1[4][2], PetscInt border1, PetscInt border2,
  PetscReal p2[4][2]);

/* overlap.c: the part of a nonmortar facet onto which a mortar facet projects. The weighted gap is linear in the
   coordinates as long as quadrature points, weights and nodal normals are held fixed. */
#define CONTACT_MAX_CORNERS (2 * CONTACT_MAX_POLYGON)
#define CONTACT_MAX_POINTS  (CONTACT_MAX_POLYGON * CONTACT_RULE_POINTS)
typedef struct {
  /* position in the plane of the nonmortar facet [length] */
  PetscReal y[2];
  PetscInt  line[2][2]; /* the two lines that intersect at the corner. Each is given by the numbers of two vertices:
                           0 to 3 of the nonmortar facet, 4 to 7 of the mortar facet. */
} ContactCorner;
typedef struct {
  /* corners of the triangle, as numbers into the array corner of ContactOverlap */
  PetscInt corner[3];
  /* -1 if the part of the nonmortar facet that holds the triangle is clockwise in the plane, else 1 */
  PetscReal sign;
} ContactTriangle;
typedef struct {
  PetscInt        ncorners, ntriangles;
  ContactCorner   corner[CONTACT_MAX_CORNERS];
  ContactTriangle triangle[CONTACT_MAX_CORNERS]; /* triangle t has the quadrature points t * rule->n to (t + 1) *
                                                    rule->n - 1 */

  /* number of quadrature points */
  PetscInt  n;
  PetscReal gap;  /* mean height of the mortar facet above the nonmortar facet, along the nonmortar facet's normal
                    [length] */
  PetscReal area; /* area of the overlap in the plane of the nonmortar facet [length^2] */
  PetscReal weight[CONTACT_MAX_POINTS]; /* weights of the quadrature points [length^2] */
  PetscReal xi1[CONTACT_MAX_POINTS][2]; /* parameters of the points on the nonmortar facet */
  PetscReal xi2[CONTACT_MAX_POINTS][2]; /* parameters of the points on the mortar facet */
} ContactOverlap;
typedef struct {
  /* Two facets overlap only if the cosine of the angle between their normals is at most `cosine`, if their overlap is
     larger than `overlap_drop` times the smaller facet, and if their mean gap [length] lies between -depth and
     distance. */
  PetscReal cosine, overlap_drop, distance, depth;
} ContactOverlapLimits;
PETSC_INTERN PetscBool ContactOverlapFind(const PetscReal x1[12], const PetscReal x2[12], const ContactOverlapLimits *,
  const ContactRule *, ContactOverlap *);
PETSC_INTERN PetscBool ContactOverlapFindAtBorder(const PetscReal x1[12], PetscInt border1, const PetscReal x2[12],
  PetscInt border2, const ContactOverlapLimits *, const ContactRule *, ContactOverlap *);

/* closest.c: the point of a facet closest to another point */
PETSC_INTERN PetscReal ContactClosestPoint(const PetscReal x[12], const PetscReal p[3], PetscReal xi[2],
  PetscReal y[3]);

/* box.c: axis-aligned boxes, each given by its lower corner and its upper corner, around facets and the prisms that
   facets sweep */
PETSC_INTERN void      ContactFacetBox(const PetscReal x[12], PetscReal box[6]);
PETSC_INTERN void      ContactSweptBox(const PetscReal x[12], PetscReal distance, PetscReal depth, PetscReal box[6]);
PETSC_INTERN PetscBool ContactBoxesMeet(const PetscReal a[6], const PetscReal b[6]);

#endif
