/*
   Detection: pairs of surfaces that face each other, from the facets of refinement level 0.
*/
#ifndef DETECTIMPL_H
#define DETECTIMPL_H

#include "src/contact/search/searchimpl.h"

/* moves.c: rigid motions of the bodies that the scene prescribes, in one state of the load program */
typedef struct {
  PetscBool moves;
  PetscReal shift[3], rotation[3], center[3]; /* [length], [radians], [length] */
} DetectMove;
PETSC_INTERN PetscErrorCode DetectMoves(Scene, PetscReal time, DetectMove moves[]);
PETSC_INTERN void           DetectMovePoints(const DetectMove *, PetscInt n, const PetscReal from[], PetscReal to[]);

/* The facets, and sizes of surfaces and bodies; the same on all ranks */
typedef struct {
  MPI_Comm     comm;
  MeshSurfaces surfaces;
  PetscReal   *area;      /* of each surface [length^2] */
  PetscInt    *nfacets;   /* of each surface */
  PetscReal   *thickness; /* of each body: 2 volume / area [length] */
  PetscReal   *box;       /* [6 bodies] undeformed */
  PetscReal   *fine;      /* of each body: area of the parts of its facets relative to that of the facets; 1/4 if it
                             has order 2 */

  const SceneBody *bodies;
  PetscInt         ntools, *tool; /* for each rigid surface without facets: the facet that stands for it */
} DetectModel;

/* rules.c: the rule that applies to two surfaces; NULL: they get no contact. detect.c has the public function */
PETSC_INTERN const SceneContactPair *DetectFindRule(const DetectModel *, Scene, PetscInt surface, PetscInt other);

/* rays.c: the facets in one state, in a tree. A ray starts at a facet and runs along its normal. Its hits are the
   facets of other bodies: all behind the start up to depth, and the first in front of it up to reach */
typedef struct {
  PetscInt  from, to; /* facets; to is that which stands for a rigid surface */
  PetscReal distance; /* negative: the bodies overlap [length] */
} DetectHit;
typedef struct {
  const DetectModel *model;
  const DetectMove  *moves;
  ContactCandidates  facets;
  ContactTree        tree;
} DetectState;
PETSC_INTERN PetscErrorCode DetectStateCreate(const DetectModel *, const DetectMove[], DetectState *);
PETSC_INTERN PetscErrorCode DetectStateDestroy(DetectState *);
#define DETECT_RAYS 5  /* of a facet */
#define DETECT_HITS 16 /* of a ray, at most */
PETSC_INTERN PetscInt DetectShoot(const DetectState *, PetscInt facet, PetscInt ray, PetscReal reach,
  DetectHit hits[DETECT_HITS]);

/* rigid_surface.c: whether a point of a facet faces a rigid surface, and the distance [length] */
PETSC_INTERN PetscBool DetectFacesRigidSurface(const DetectState *, PetscInt tool, const PetscReal x[3],
  const PetscReal normal[3], PetscReal *distance);
#define DETECT_COSINE \
  -0.174 /* largest cosine of the angle between the normals of facing surfaces; that of the
                                contact search */

/* facing.c: two surfaces that face each other. Number 0 is the surface with the smaller number */
typedef struct {
  PetscInt  surface[2];
  PetscReal apart;    /* smallest distance in the undeformed state; PETSC_MAX_REAL: they are near only in later
                         states [length] */
  PetscReal facet[2]; /* mean area of the facets that face the other surface; 0: none */
  PetscInt  tied[2];  /* number of facets whose rays all hit the other surface within the rule's distance for ties */
} DetectPair;
PETSC_INTERN PetscErrorCode DetectFacing(const DetectModel *, Scene, PetscInt *n, DetectPair **);

/* sides.c: which of two surfaces is nonmortar, and why */
PETSC_INTERN PetscInt DetectNonmortar(const DetectModel *, Scene, const DetectPair *, const char **why);

#endif
