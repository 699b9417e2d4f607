/* Faces of the bodies as facets: coordinates, borders, and vertices with prescribed displacements. */
#ifndef SURFACEIMPL_H
#define SURFACEIMPL_H

#include "src/contact/geometry/geometryimpl.h"
#include <mesh.h>
#include <petscbt.h>

/* boundary.c: the boundary facets of all bodies on this rank, undeformed unless ContactBoundaryDeform() moves them */
typedef struct {
  MPI_Comm   comm;
  PetscInt   nbodies;
  PetscInt   n, *body; /* number of facets, and the body of each */
  PetscInt  *vertex;   /* [4 n] the facets' vertices */
  PetscReal *x;        /* [12 n] coordinates of the facets' vertices, counterclockwise seen from outside [length] */
} ContactBoundary;
PETSC_INTERN PetscErrorCode ContactBoundaryCreate(DM, ContactBoundary *);
PETSC_INTERN PetscErrorCode ContactBoundaryDestroy(ContactBoundary *);
PETSC_INTERN PetscErrorCode ContactBoundaryDeform(DM, Vec u, ContactBoundary *);
PETSC_INTERN PetscErrorCode ContactBoundaryThickness(const ContactBoundary *, PetscReal thickness[]);
PETSC_INTERN PetscReal      ContactBoundarySolidAngle(const ContactBoundary *, PetscInt body, const PetscReal from[3]);

/* surface.c: the facets of a named face that this rank owns */
typedef struct {
  char      *name;
  PetscInt   nfacets;
  PetscInt  *vertex;     /* [4 nfacets] local DMPlex points that carry the vertices' nodes, counterclockwise seen from
                        outside; a triangle stores its last vertex twice */
  PetscInt  *node;       /* [4 nfacets] global numbers of the vertices (first global row / 3) */
  PetscReal *reference;  /* [12 nfacets] coordinates of the undeformed vertices [length] */
  PetscReal *x;          /* [12 nfacets] coordinates of the deformed vertices [length] */
  PetscReal *patch;      /* [12 nfacets] unit normals of the smooth deformed surface at the vertices */
  PetscBool  patched;    /* whether patch exists; equal on all ranks */
  PetscBool  cut;        /* whether the facets are parts of facets of order 2; equal on all ranks */
  PetscInt  *prescribed; /* [nfacets] Bit 3 a + c is set if a face of the mesh prescribes the displacement of vertex a
                        along axis c. */
  PetscInt  *border;    /* [nfacets] Bit a is set if the edge from vertex a to the next is on the face's border, and bit
                       4 + a if vertex a is on the border. Bit 2 of a triangle stands for its last vertex. */
  PetscBT    rim;       /* Bit p is set if the local DMPlex point p is a vertex on the border. NULL unless bordered. */
  PetscBool  bordered;  /* whether `border` has been computed; equal on all ranks */
  PetscBool  self;      /* whether the face comes into contact with itself; equal on all ranks */
  PetscReal *rank;      /* [nfacets] rank of each facet: of two facets in contact, that with the smaller rank is
                           nonmortar; NULL unless self */
  PetscReal *below;     /* [nfacets] smallest depth of the undeformed cell below the facet [length]; NULL unless self */
  PetscReal  area;      /* area of the whole undeformed face, summed over all ranks [length^2] */
  PetscInt   body;      /* number of the body that the face belongs to */
  PetscReal  thickness; /* mean thickness of that body [length] */
} ContactSurface;
PETSC_INTERN PetscErrorCode ContactSurfaceCreate(DM, const char[], const PetscReal thickness[], ContactSurface *);
PETSC_INTERN PetscErrorCode ContactVerticesDeform(DM, Vec ulocal, PetscInt n, const PetscInt vertex[], PetscReal x[]);
PETSC_INTERN PetscErrorCode ContactSurfaceDeform(DM, Vec ulocal, ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceNormals(DM, const ContactSurface *, const PetscBool only[],
  PetscReal normal[], PetscInt n, const PetscInt vertex[], PetscReal vertexnormal[]);
PETSC_INTERN PetscErrorCode ContactSurfaceDestroy(ContactSurface *);

/* trace.c: the matrix T - 1, or T^-1 - 1, where T maps the displacement of the mesh's nodes to that of the surfaces'
   vertices. A NULL matrix stands for T = 1. */
typedef enum { CONTACT_TRACE_FORWARD, CONTACT_TRACE_INVERSE } ContactTraceType;
PETSC_INTERN PetscErrorCode ContactTraceCreate(DM, PetscInt nsurfaces, const ContactSurface *const surface[],
  ContactTraceType, PetscInt components, Mat *correction);
PETSC_INTERN PetscErrorCode ContactTraceApply(DM, Mat correction, Vec u, Vec local);
PETSC_INTERN PetscErrorCode ContactTraceDifferentiate(Mat correction, Mat jacobian);
PETSC_INTERN PetscErrorCode ContactTraceRecover(Mat correction, Mat rows);

/* border.c: the border of a surface, and the vertices whose displacement is prescribed */
#define CONTACT_FREE    -2 /* no displacement is prescribed */
#define CONTACT_AT_REST -1 /* a displacement of 0 is prescribed */
PETSC_INTERN PetscErrorCode ContactSurfaceFindBorder(DM, ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceFindPrescribed(DM, PetscInt n, const SceneDisplacement[], ContactSurface *);
PETSC_INTERN PetscErrorCode ContactSurfaceFindMotions(DM, PetscInt n, const SceneDisplacement[], PetscInt axis,
  const ContactSurface *, PetscInt motion[]);
PETSC_INTERN PetscErrorCode ContactSurfaceFindPlanes(DM, PetscInt n, const SceneDisplacement[], const ContactSurface *,
  PetscInt plane[]);

#endif
