/*
   Detection: pairs of surfaces that face each other, from the facets of refinement level 0.
*/
#ifndef DETECTIMPL_H
#define DETECTIMPL_H

#include "src/contact/search/searchimpl.h"

/* The rigid motion of a body at one time of the load program */
typedef struct {
  /* whether the motion is not zero; whether it is, at least partly, that of free flight */
  PetscBool moves, falls;
  PetscReal shift[3], rotation[3], center[3]; /* shift [length], rotation vector [rad] and a point on its axis
                                                 [length] */
} DetectMove;

/* The facets of all bodies, and sizes of surfaces and bodies; equal on all ranks */
typedef struct {
  MPI_Comm     comm;
  MeshSurfaces surfaces;
  PetscReal   *area; /* [surfaces] area of each surface [length^2]; PETSC_MAX_REAL for a rigid surface without facets */
  PetscInt    *nfacets;   /* [surfaces] number of facets of each surface */
  PetscReal   *normal;    /* [12 facets] normals of the curved surfaces at the corners of the facets */
  PetscReal   *bulge;     /* [surfaces] largest distance between the curved surface and its facets [length] */
  PetscReal   *thickness; /* [bodies] mean thickness of each body: 2 volume / area [length] */
  PetscReal   *box;       /* [6 bodies] bounding box of each undeformed body */
  PetscReal    size;      /* diagonal of the box of all bodies [length] */
  PetscReal   *mass;      /* [bodies] mass of each body; 0 if it has no density */
  PetscReal   *fine; /* [bodies] area of a facet's parts in the contact search relative to the facet: 1/4 if the body
                        has order 2, or unspecified order and triangular facets; else 1 */

  /* [bodies] bodies of the scene */
  const SceneBody *bodies;
  PetscInt         ntools, *tool; /* number of rigid surfaces without facets; for each of them, the facet that
                                     represents it */
} DetectModel;

/* free_flight.c: the motion in free flight; the body to which a face belongs */
PETSC_INTERN PetscErrorCode DetectFall(const DetectModel *, Scene, PetscReal time, DetectMove moves[]);
PETSC_INTERN PetscInt       DetectFindBody(Scene, const char face[]);

/* prescribed_motions.c: the motion that the scene prescribes, or else the motion in free flight */
PETSC_INTERN PetscErrorCode DetectMoves(const DetectModel *, Scene, PetscReal time, DetectMove moves[]);
PETSC_INTERN void           DetectMovePoints(const DetectMove *, PetscInt n, const PetscReal from[], PetscReal to[]);

/* load_times.c: the times at which the bodies are tested [load steps] */
#define DETECT_STATES 32 /* largest number of times */
PETSC_INTERN PetscErrorCode DetectChooseTimes(const DetectModel *, Scene, PetscReal *extent, PetscInt *nstates,
  PetscReal time[DETECT_STATES]);

/* contact_rules.c: the rule that applies to two surfaces. It is NULL if they get no contact. The public function is in
   detect.c. */
PETSC_INTERN const SceneContactPair *DetectFindRule(const DetectModel *, Scene, PetscInt surface, PetscInt other);
PETSC_INTERN PetscBool               DetectWantsSelf(Scene, const SceneContactPair *rule, const SceneBody *);

/*
   rays.c: the facets at one time of the load program, in a tree. A ray starts at a facet and runs along its normal. Its
   hits are facets of other bodies: all facets behind the start up to half the thickness of the bodies, and the first
   facet in front of it within the search distance.
*/
typedef struct {
  PetscInt  from, to; /* the facet at which the ray starts, and the facet that it hits. For a rigid surface without
                         facets this is the facet that represents it. */
  PetscReal distance; /* distance along the ray; negative if the bodies overlap [length] */
} DetectHit;
typedef struct {
  const DetectModel *model;
  const DetectMove  *moves;
  ContactCandidates  facets;
  ContactTree        tree;
} DetectState;
PETSC_INTERN PetscErrorCode DetectStateCreate(const DetectModel *, const DetectMove[], DetectState *);
PETSC_INTERN PetscErrorCode DetectStateDestroy(DetectState *);
PETSC_INTERN void           DetectGetStart(PetscInt ray, PetscReal xi[2]);
#define DETECT_RAYS 5  /* number of rays of a facet */
#define DETECT_HITS 16 /* largest number of hits of a ray */
PETSC_INTERN PetscInt DetectShoot(const DetectState *, PetscInt facet, PetscInt ray, PetscReal reach,
  DetectHit hits[DETECT_HITS]);

/* rigid_surface.c: returns whether a point of a facet with this normal faces a rigid surface, and the distance from the
   surface [length] */
PETSC_INTERN PetscBool DetectFacesRigidSurface(const DetectState *, PetscInt tool, const PetscReal x[3],
  const PetscReal normal[3], PetscReal *distance);
/* bulge.c: the height of a curved surface above its plane facets */
PETSC_INTERN PetscErrorCode DetectNormals(const MeshSurfaces *, PetscReal normal[]);
PETSC_INTERN PetscReal      DetectBulge(const PetscReal x[12], const PetscReal normal[12], const PetscReal xi[2]);

/* facing.c: two surfaces that face each other. surface[0] is the smaller number. */
typedef struct {
  PetscInt  surface[2];
  PetscReal apart;    /* smallest distance in the undeformed state [length]; PETSC_MAX_REAL if the surfaces face each
                      other at later times only */
  PetscReal facet[2]; /* for each surface, the mean area of its facets that face the other surface [length^2]; 0 if
                         there are none */
  PetscInt  tied[2];  /* for each surface, the number of its facets whose rays all hit the other surface within the
                        rule's distance for ties */
} DetectPair;
PETSC_INTERN PetscErrorCode DetectFacing(const DetectModel *, Scene, PetscInt *n, DetectPair **);

/* nonmortar_side.c: returns which of two surfaces is nonmortar, and the reason as a text */
PETSC_INTERN PetscInt DetectNonmortar(const DetectModel *, Scene, const DetectPair *, const char **why);

#endif
