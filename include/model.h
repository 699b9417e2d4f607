/* The model: what is simulated, as plain structs. Every other part of the program uses these structs; they use no
   other part. Lengths, forces and pressures are in any consistent units. */
#ifndef MODEL_H
#define MODEL_H

#include <petscsys.h>
#include "material.h"
#include "formulation.h"

/*
   Each entry of a list of the scene begins with its name and its place in the file, "FILE: line N: "; place NULL: it
   does not come from a file. SceneCheck() is a PetscCheck() about an entry, whose message begins with the place.
*/
typedef struct {
  char       *name;
  const char *place;
} SceneEntry;
#define ScenePlace(entry) ((entry)->place ? (entry)->place : "")
#define SceneCheck(cond, comm, code, entry, message, ...) \
  PetscCheck(cond, comm, code, "%s" message, ScenePlace(entry), __VA_ARGS__)

/* The shapes. A new shape needs a file in src/mesh/shapes and a line here, with its name in C and its name in
   scenes. */
#define BODY_SHAPES(SHAPE) \
  SHAPE(BOX, Box, "box") \
  SHAPE(TUBE_ARC, TubeArc, "tube_arc") \
  SHAPE(CYLINDER, Cylinder, "cylinder") \
  SHAPE(CONE, Cone, "cone") \
  SHAPE(WEDGE, Wedge, "wedge") \
  SHAPE(HOLED_BOX, HoledBox, "holed_box") \
  SHAPE(HALF_ELLIPSE, HalfEllipse, "half_ellipse") \
  SHAPE(SPHERE_SHELL, SphereShell, "sphere_shell") \
  SHAPE(SPHEROID_SHELL, SpheroidShell, "spheroid_shell") \
  SHAPE(BALL, Ball, "ball") \
  SHAPE(RIGID_PLANE, RigidPlane, "rigid_plane") \
  SHAPE(RIGID_SPHERE, RigidSphere, "rigid_sphere") \
  SHAPE(RIGID_CYLINDER, RigidCylinder, "rigid_cylinder") \
  SHAPE(RIGID_CONE, RigidCone, "rigid_cone") \
  SHAPE(RIGID_TORUS, RigidTorus, "rigid_torus") \
  SHAPE(RIGID_EXTRUDED, RigidExtruded, "rigid_extruded") \
  SHAPE(RIGID_REVOLVED, RigidRevolved, "rigid_revolved") \
  SHAPE(RIGID_STL, RigidStl, "rigid_stl")

#define BODY_SHAPE(name, shape, text) SHAPE_##name,
typedef enum { BODY_SHAPES(BODY_SHAPE) SHAPE_GMSH } BodyShape;
#undef BODY_SHAPE
PETSC_EXTERN const char *const BodyShapes[];

#define BODY_OWN 64

#define MODEL_WEAK_SPRINGS 1e-7  /* stiffness of weak springs as a fraction of the body's, if the scene gives none */
#define MODEL_ROUNDING     1e-12 /* rounding error of sums, relative to the largest part */

/* Positions of a rigid surface's parameters in the array `own` of SceneBody. Point and axis have three numbers each. */
#define SURFACE_MAX_PROFILE 40 /* numbers of a profile */

enum {
  SURFACE_POINT   = 0,
  SURFACE_AXIS    = 3,
  SURFACE_RADIUS  = 6,
  SURFACE_SECTION = 7,
  SURFACE_ANGLE   = 8,
  SURFACE_SIZE    = 9,
  SURFACE_ACROSS  = 10, /* three numbers: direction of a profile's first coordinate */
  SURFACE_OUTSIDE = 13, /* distance between the surface and its profile, on the outer side */
  SURFACE_MASS    = 14,
  SURFACE_PROFILE = 16 /* number of coordinates, followed by the coordinates: two for each point of the profile */
};

/* An arc of a tube, or a whole tube. A cylinder uses axis, center, outer radius and extent. A cone uses the radii at
   the start and at the end of its extent. Angles are measured about the axis, from the next axis in the order x, y,
   z, x; for the axis y from z to x. */
typedef struct {
  PetscInt  axis;      /* 0, 1, 2: along x, y, z */
  PetscReal center[3]; /* a point on the axis [length] */
  PetscReal radii[2];  /* inner, outer; of a cone at its start and end [length] */
  PetscReal angles[2]; /* first and last angle [degrees] */
  PetscReal extent[2]; /* first and last position along the axis [length] */
} SceneTubeArc;

/* Prism whose cross-section is half an ellipse, or a quarter of an ellipse that ends at its plane of symmetry */
typedef struct {
  PetscInt  axis;         /* axis of the prism: 0, 1, 2 */
  PetscInt  depth;        /* direction from the flat side to the crown: 0, 1, 2 for x, y, z; 3, 4, 5 for -x, -y, -z */
  PetscInt  half;         /* direction from the plane of symmetry to the modelled half; PETSC_DECIDE: both halves are
                          modelled */
  PetscReal center[3];    /* a point on the line where the flat side meets the plane of symmetry [length] */
  PetscReal semi_axes[2]; /* semi-axis along depth, and across [length] */
  PetscReal extent[2];    /* first and last position along the axis [length] */
} SceneHalfEllipse;

typedef struct {
  PetscReal radius, center[3]; /* [length] */
} SceneSphere;

#define OCTANT_BOTH 2 /* the octants on both sides of the plane are modelled */

/* Octants of shells and balls, which are bounded by the three coordinate planes through a corner */
typedef struct {
  PetscReal   corner[3];     /* [length] */
  PetscInt    signs[3];      /* +1 or -1: the side of each plane on which the octant lies; OCTANT_BOTH: both sides; 0
                                stands for 1 */
  SceneSphere inner, outer;  /* inner and outer sphere of a sphere_shell; a ball has only the outer one */
  SceneSphere cap;           /* sphere_shell: sphere that cuts the outer surface; none if the radius is 0 */
  PetscReal   inner_axes[3]; /* spheroid_shell: semi-axes [length] */
  PetscReal   outer_axes[3];
  PetscReal   layer_grading; /* thickness of the outermost layer divided by that of the innermost; 0 stands for 1 */
  PetscInt    layer_even;    /* number of equal layers at the fine end of the grading; 0 stands for 1 */
} SceneOctant;

/* One volume of a mesh file */
typedef struct {
  char     *file;       /* with its folder */
  char     *volume;     /* physical name */
  PetscReal scale;      /* factor of its coordinates; 0 stands for 1 */
  char     *converted;  /* name of the temporary Gmsh file into which a file of another format, or with a scale, was
                           converted; otherwise NULL */
  PetscInt  nsurfaces;  /* number of its faces surface_1, surface_2, ..., the parts of the boundary between sharp
                           edges; 0 until a scene refers to such a face */
  int       descriptor; /* descriptor of the temporary file, stored on the first rank for the first body that uses
                           it; 0: none */
} SceneGmsh;

/* The facets of an STL file (src/model/stl.c) */
typedef struct _n_SceneStl *SceneStl;

/* A part of a face: its facets at refinement level 0 whose centroids lie in a box */
typedef struct {
  char       *name; /* "<body>.<name>" is a face */
  const char *place;
  char       *of;                 /* name of the face without the body */
  PetscReal   lower[3], upper[3]; /* bounds of the box, may be infinite [length] */
} SceneSubface;

/* A body: its shape, and its mesh at refinement level 0. For an octant, `cells` are the numbers of cells along x, y
   and z. For a half ellipse they are the numbers of cells of the core along the depth and across half of it, and of
   the ring around the core. */
typedef struct {
  char        *name;
  const char  *place;
  BodyShape    shape;
  PetscReal    lower[3], upper[3]; /* box: opposite corners [length] */
  PetscInt     cells[3];           /* number of cells. box: along each axis; tube_arc: radially, around and along the
                                     axis; other shapes: see above */
  Material     material;
  char        *material_name; /* NULL: the scene names the law, and no material */
  ElementType  element;
  PetscInt     order; /* polynomial order of the displacements in a cell, 1 or 2; 0: the default, 1 for hexahedra and 2
                      for tetrahedra */
  PetscBool    serendipity; /* hexahedra of order 2 have 20 nodes instead of 27 */
  PetscReal    grading[3];  /* size of the last cell divided by that of the first, in three directions; 0 stands for 1.
                           Directions of box and octants: the axes; of tube_arc: those of `cells`; of half_ellipse: the
                           depth and the width of the core of its mesh, and the radius in the ring around the core */
  PetscInt     even[3];     /* number of equal cells at the fine end of each grading; 0 stands for 1 */
  PetscInt     layers;      /* number of cells along the axis (half_ellipse) or through the shell (octants) */
  PetscBool    curved; /* refinement puts new vertices on the shape's curved surfaces; false: on the facets of level
                           0 */
  SceneTubeArc tube;
  SceneHalfEllipse ellipse;
  SceneOctant      octant;
  SceneGmsh        gmsh;
  SceneStl         stl;           /* of the shape rigid_stl, whose file and scale are those of `gmsh` */
  PetscReal        own[BODY_OWN]; /* parameters of shapes that have no named members in this struct */
  PetscInt         nsubfaces;
  SceneSubface    *subfaces;
  PetscBool        whole; /* the whole boundary is a face with the name "<body>" SCENE_WHOLE_BODY, because it comes into
                      contact with itself */
  PetscReal        velocity[3], spin[3]; /* velocity [length/time], and angular velocity about the centre of mass
                                     [radians/time], both at time 0 */
} SceneBody;

/* A load history (ramp): factors at the ends of the load steps; between them the factor is linear */
typedef struct {
  char       *name;
  const char *place;
  PetscReal   start;  /* factor at the start, before the first load step; always 0 in a static analysis */
  PetscReal  *factor; /* nsteps values */
} SceneRamp;

/* Parameters of a dynamic analysis, in which each load step is a time step */
typedef struct {
  PetscReal      time_step, end_time; /* [time]; time_step 0: a static analysis */
  DynamicsScheme scheme;
  MassType       mass;
  PetscReal      spectral_radius;   /* generalized_alpha: fraction of the highest frequencies that remains after a time
                                     step, 0 to 1 */
  PetscReal      tolerance;         /* tolerance of the error of controlled time steps; 0: all time steps have the same
                                     length */
  PetscReal      damping_mass;      /* mass-proportional damping: the force is this factor times mass times velocity
                                     [1/time] */
  PetscReal      damping_stiffness; /* stiffness-proportional damping: the force is this factor times stiffness times
                                       velocity [time] */
} SceneDynamics;

typedef enum {
  DISPLACEMENT_FACE, /* a face of a body, or a whole rigid body */
  DISPLACEMENT_POINT,
  DISPLACEMENT_EDGE
} DisplacementPlace;

/* stands in place of a face's name for the whole of a rigid body, or for the whole boundary of another body */
#define SCENE_WHOLE_BODY ".*"

typedef struct {
  char       *name;
  const char *place;
  char       *face;        /* "<body>.<face>", the name of a label of facets; or "<body>" SCENE_WHOLE_BODY for a whole
                         rigid body */
  PetscBool   fixed[3];    /* which components are prescribed */
  PetscReal   value[3];    /* prescribed displacement at factor 1 [length] */
  PetscBool   moves;       /* prescribes the rigid motion of a rigid body or a face, with a rotation; several motions of
                         one face or body are added */
  PetscReal   rotation[3]; /* rotation vector about an axis through `center`, at factor 1 [degrees] */
  PetscReal   center[3];   /* center of rotation, which moves by `value` [length] */
  PetscBool   released[6]; /* rigid body: the translations, and rotations about the center, that are free and driven by
                            forces */
  PetscBool   inclined;    /* an inclined symmetry plane: the displacement along `normal` is zero, and no single
                            component is prescribed */
  PetscReal   normal[3];   /* normal of the plane; its length has no influence */
  PetscBool   symmetry;    /* a symmetry plane */
  PetscBool   unnamed;     /* a symmetry plane of which the scene has only the face; `name` is made from it */
  DisplacementPlace at;
  PetscInt          body;           /* body of the point or edge */
  PetscReal         from[3], to[3]; /* ends of the edge; for a point both are the same [length] */
  PetscInt          ramp;
} SceneDisplacement;

/* A pressure, whose force is -value times normal and area: of the undeformed face (dead load) or of the deformed
   face (follower load) */
typedef struct {
  char       *name;
  const char *place;
  char       *face;
  PetscBool   follows; /* acts on the deformed normal and area */
  char       *value;   /* an expression in the undeformed coordinates x, y, z [force/length^2], at factor 1; positive
                          values push on the body */
  PetscInt    ramp;
} ScenePressure;

/* A dead load on a face or a rigid body: a uniform traction, or a resultant force. With a moment the traction varies
   linearly over the face. */
typedef struct {
  char       *name;
  const char *place;
  PetscInt    body;    /* body on which the resultant acts; PETSC_DECIDE: the load acts on a face */
  char       *face;    /* the face; for a resultant also "<body>" SCENE_WHOLE_BODY, a whole rigid body, or a point of an
                          elastic body */
  PetscBool resultant; /* `value` is a resultant force [force] and not a traction [force/length^2]; both at factor 1 */
  PetscReal value[3];
  PetscReal moment[3]; /* moment of the resultant about its point of action, at factor 1 [force length] */
  PetscBool placed;    /* the point of action is given; otherwise the resultant acts at the face's centroid */
  PetscReal point[3];  /* [length] */
  PetscInt  ramp;
} SceneTraction;

/* Springs between a face and the ground, or another face */
typedef struct {
  char       *name;
  const char *place;
  char       *face;
  char       *to;       /* NULL: the springs go to the ground; otherwise the face at their other end, which must cover
                         the first one */
  PetscReal   distance; /* largest distance between facets that are joined [length]; 0: computed from the size of the
                         facets */
  PetscReal   value[3]; /* stiffness along x, y, z per undeformed area of face [force/length^3] */
} SceneSpring;

/* A spring and damper between a point of a body and the ground, or a point of another body */
typedef struct {
  char       *name;
  const char *place;
  PetscInt    body, to;    /* to: PETSC_DECIDE: the ground */
  PetscReal   point[2][3]; /* point of the body; point of the other body or of the ground [length] */
  PetscBool   axial;       /* the spring acts along the line between the points, not along the axes */
  PetscReal   stiffness;   /* stiffness along that line, if `axial` is true [force/length] */
  PetscReal   value[3];    /* stiffness along x, y and z, if `axial` is false [force/length] */
  PetscReal   damping; /* force per relative velocity: along the line if `axial` is true, else in any direction [force
                            time/length] */
} SceneConnector;

/* An equation between displacements of one or two points: direction[0] . u(point[0]) + direction[1] . u(point[1]) =
   value */
typedef struct {
  char       *name;
  const char *place;
  PetscInt    body, to;        /* to: PETSC_DECIDE: the equation has one point */
  PetscReal   point[2][3];     /* [length] */
  PetscReal   direction[2][3]; /* factors of the components along x, y and z */
  PetscReal   value;           /* at factor 1 [length] */
  PetscInt    ramp;
} SceneEquation;

/* Pretension of a bolt: a section through a body, with a force or a shortening */
typedef struct {
  char       *name;
  const char *place;
  PetscInt    body;
  PetscReal   point[3], axis[3]; /* a point of the section's plane; normal of the plane, of any length */
  PetscBool   shortens;          /* the shortening is prescribed, not the force */
  PetscReal   force;             /* tension at factor 1 [force] */
  PetscReal   shortening;        /* at factor 1 [length] */
  PetscInt    lock;              /* load step after which the shortening is kept constant; 0: never */
  PetscInt    ramp;
} SceneBolt;

typedef struct {
  char       *name;
  const char *place;
  PetscInt    body;     /* number of the body; PETSC_DECIDE: every body */
  PetscReal   value[3]; /* at factor 1, per reference volume [force/length^3] */
  PetscInt    ramp;
} SceneBodyForce;

/* A temperature rise above the temperature without stress; the rises that apply to one body are added */
typedef struct {
  char       *name;
  const char *place;
  PetscInt    body;  /* number of the body; PETSC_DECIDE: every body with thermal expansion */
  char       *value; /* an expression in the undeformed coordinates x, y, z [temperature], at factor 1 */
  PetscInt    ramp;
} SceneTemperature;

typedef struct {
  char       *name;
  const char *place;
  char       *mortar;    /* "<body>.<face>" */
  char       *nonmortar; /* "<body>.<face>": the face that carries the constraints */
  char       *self;      /* the body or face that is in contact with itself, named by both mortar and nonmortar. In a
                            rule "true": all bodies of finite strain. NULL: the pair has two faces */
  GapType     gap;
  PetscReal   distance;          /* largest distance of facets that can come into contact [length]; 0: computed from
                                    the size of the faces */
  PetscReal   interference;      /* largest intended initial overlap [length]; 0: none, PETSC_INFINITY: any */
  PetscInt    interference_ramp; /* ramp of the interference; PETSC_DECIDE: applied from the start */
  PetscReal   stiffness;         /* pressure per depth of penetration [force/length^3]; 0: no penetration */
  PetscReal   exponential[2];    /* gap at which the pressure is a hundredth of that at no gap [length], and that
                                    pressure [force/length^2]; 0: another law */
  PetscReal   friction;          /* friction coefficient; 0: none, PETSC_INFINITY: sticks under any force */
  PetscReal   shear_limit;       /* limit of the friction stress [force/length^2]; PETSC_INFINITY: none */
  PetscInt    friction_ramp;     /* ramp of the coefficient; PETSC_DECIDE: constant */
  PetscReal   tie;               /* only for rules: surfaces that are nearer to each other than this are tied
                                    [length]; 0: none */
  char       *except;            /* only for rules: names of bodies and faces without contact, or of two of them as
                                    "a/b" */
  const char *why;               /* if a rule found the pair: reason why this side is the nonmortar one; NULL: the
                                    scene names both sides */
  PetscReal   apart;  /* if a rule found the pair: smallest distance along a normal in the undeformed state [length] */
  PetscBool   smooth; /* the gap is measured between smooth surfaces through the facets of curved faces */
} SceneContactPair;

static inline PetscBool SceneContactPairHasFriction(const SceneContactPair *pair)
{
  return (PetscBool)(pair->friction > 0.0 && pair->shear_limit > 0.0);
}

/* Returns whether the pressure of a pair depends on the depth of penetration */
static inline PetscBool SceneContactPairIsSoft(const SceneContactPair *pair)
{
  return (PetscBool)(pair->stiffness > 0.0 || pair->exponential[1] > 0.0);
}

/* A tie: two faces that are joined in the undeformed state */
typedef struct {
  char       *name;
  const char *place;
  char       *mortar;
  char       *nonmortar; /* the face whose displacements follow those of the other face */
  PetscReal   distance;  /* largest distance between facets that are joined [length]; 0: computed from the size of the
                          facets */
} SceneTie;

/* Cyclic symmetry: only a sector of the body is modelled. It ends on two faces. The second face is the first one,
   turned about the axis by the angle of the sector. */
typedef struct {
  char       *name;
  const char *place;
  char       *from, *to;          /* "<body>.<face>" of one body */
  PetscReal   axis[3], center[3]; /* direction of the axis, any length, and a point on it [length] */
} SceneCyclic;

/* A zone in which cells are refined further: near a face, near both faces of a contact pair, or in a box */
typedef struct {
  char       *name;
  const char *place;
  char       *face[2];            /* "<body>.<face>"; NULL: none */
  PetscInt    body;               /* PETSC_DECIDE: any */
  PetscReal   lower[3], upper[3]; /* opposite corners of the box, used if no face is given [length] */
  PetscReal   distance;           /* cells within this distance of each face, or of the box, are refined [length] */
  PetscInt    levels;             /* number of refinements in addition to the uniform ones */
} SceneRefinement;

/* A probe: a point, or equally spaced points along a line, in the undeformed bodies */
typedef struct {
  char       *name;
  const char *place;
  PetscInt    body; /* PETSC_DECIDE: any */
  PetscBool   line;
  PetscInt    n;              /* points */
  PetscReal   from[3], to[3]; /* ends of the line; for a point only `from` is used [length] */
} SceneProbe;

/* A PETSc option, without its leading dash */
typedef struct {
  char       *name;
  const char *place;
  char       *value;
  PetscBool   set; /* whether the scene's value is used, because neither the command line nor an options file sets the
                      option */
} SceneOption;

/* units.c: kinds of units */
typedef enum { UNIT_LENGTH, UNIT_FORCE, UNIT_STRESS, UNIT_TIME } UnitKind;
PETSC_EXTERN const char *UnitsFind(const char text[], UnitKind, PetscReal *si);

/* The keys of a scene file, and their places "FILE: line N: " */
typedef struct {
  PetscInt n;
  char   **keys, **places, *file; /* file: "FILE: " */
} ScenePlaces;

typedef struct _n_Scene {
  char              *name;
  char              *file; /* the file that it was read from; NULL: none */
  ScenePlaces        places;
  char              *units; /* units as text for tables; NULL: none */
  PetscInt           nbodies;
  SceneBody         *bodies;
  PetscInt           ndisplacements;
  SceneDisplacement *displacements;
  PetscInt           npressures;
  ScenePressure     *pressures;
  PetscInt           ntractions; /* including forces and moments on faces and bodies */
  SceneTraction     *tractions;
  PetscInt           nsprings;
  SceneSpring       *springs;
  PetscReal          weak_springs; /* stiffness of the weak springs of bodies that can move freely, divided by Young's
                                   modulus times the cube root of the volume; 0: no weak springs */
  PetscInt           nconnectors;
  SceneConnector    *connectors;
  PetscInt           nequations;
  SceneEquation     *equations;
  PetscInt           nbolts;
  SceneBolt         *bolts;
  PetscInt           nforces;
  SceneBodyForce    *forces;
  PetscInt           ntemperatures;
  SceneTemperature  *temperatures;
  PetscInt           npairs;
  SceneContactPair  *pairs;
  PetscInt           nrules; /* contact entries that name no faces; ContactDetect() turns them into pairs and ties */
  SceneContactPair  *rules;
  PetscInt           nties;
  SceneTie          *ties;
  PetscInt           ncyclic;
  SceneCyclic       *cyclic;
  PetscInt           nrefinements;
  SceneRefinement   *refinements;
  PetscInt           nprobes;
  SceneProbe        *probes;
  SceneDynamics      dynamics;
  PetscInt           nsteps; /* load steps, at least 1 */
  PetscInt           nramps; /* at least 1: ramp 0 is the load, for everything that names no ramp */
  SceneRamp         *ramps;
  PetscInt           refine; /* uniform refinements of level 0 */
  StepModel          model;
  PetscInt           contact_updates; /* largest number of contact updates per load step. If it is 1, the gap need not
                                   agree with that of the deformed bodies. */
  PetscInt           displacement_bounds; /* number (from 1) of the first load step in which displacement increments are
                                   bounded by the largest earlier increment; 0: none */
  PetscInt           noptions;            /* number of PETSc options */
  SceneOption       *options;
} * Scene;

/* Returns whether the analysis is dynamic, so that bodies have inertia */
static inline PetscBool SceneIsDynamic(Scene scene)
{
  return (PetscBool)(scene->dynamics.time_step > 0.0);
}

/* Returns whether a force acts at a point of an elastic body */
static inline PetscBool SceneForceIsAtPoint(Scene scene, const SceneTraction *t)
{
  return (PetscBool)(t->body >= 0 && scene->bodies[t->body].material.type != MATERIAL_RIGID);
}

/* Returns whether any motion of a rigid body is free */
static inline PetscBool SceneFreesMotion(const SceneDisplacement *d)
{
  PetscBool frees = PETSC_FALSE;

  for (PetscInt m = 0; m < 6; ++m) frees = (PetscBool)(frees || d->released[m]);
  return frees;
}

/* Returns the time step; load step k ends at k times this value. It is 1 in a static analysis. */
static inline PetscReal SceneTimeStep(Scene scene)
{
  return SceneIsDynamic(scene) ? scene->dynamics.time_step : 1.0;
}

/* Computes the factor of a ramp at a time; load step k, counted from 1, ends at time k */
PETSC_EXTERN PetscErrorCode SceneGetFactor(Scene, PetscInt ramp, PetscReal time, PetscReal *factor);
/* Returns whether a body is a rigid surface, whose contact uses a formula instead of facets */
static inline PetscBool SceneBodyIsSurface(const SceneBody *body)
{
  return (PetscBool)(body->shape >= SHAPE_RIGID_PLANE && body->shape <= SHAPE_RIGID_STL);
}

/* Returns whether a body is a rigid surface with a profile */
static inline PetscBool SceneSurfaceHasProfile(const SceneBody *body)
{
  return (PetscBool)(body->shape == SHAPE_RIGID_EXTRUDED || body->shape == SHAPE_RIGID_REVOLVED);
}

/* The cube of one cell that represents a rigid surface in the mesh: corner, unit vectors of its edges, length of the
   edges */
typedef struct {
  PetscReal corner[3], edge[3][3], size;
} SceneSurfaceCube;
PETSC_EXTERN void           SceneSurfaceGetCube(const SceneBody *, SceneSurfaceCube *);
PETSC_EXTERN PetscErrorCode SceneSurfaceWrite(const SceneBody *, const char shape[], char text[], size_t length);
PETSC_EXTERN PetscErrorCode SceneStlCreate(MPI_Comm, const char place[], const char file[], PetscReal scale, SceneStl *,
  PetscReal centre[3], PetscReal *edge);
PETSC_EXTERN PetscErrorCode SceneStlDestroy(SceneStl *);
/* Returns the distance of a point from an undeformed rigid surface, negative inside [length]; computes its gradient */
PETSC_EXTERN PetscReal SceneSurfaceDistance(const SceneBody *, const PetscReal x[3], PetscReal gradient[3]);
/* A convex corner of the profile of a rigid surface, opposite an edge of another body's face */
typedef struct {
  PetscReal share;     /* position of the opposite point on the edge, from 0 to 1 */
  PetscReal normal[3]; /* unit normal of the face there */
  PetscReal gap;       /* height of the corner above that point, along the normal [length] */
} SceneSurfaceCorner;
PETSC_EXTERN PetscInt SceneSurfaceFindCorners(const SceneBody *, const PetscReal ends[6], const PetscReal normals[6],
  SceneSurfaceCorner deepest[2]);
/* Returns the radius of a rigid sphere or cylinder, or of the section of a rigid torus [length]; of other bodies
   PETSC_INFINITY */
PETSC_EXTERN PetscReal SceneSurfaceRadius(const SceneBody *);
/* Sets both sides of a pair whose `self` is set, and marks the body if they are its whole boundary */
PETSC_EXTERN PetscErrorCode SceneContactPairSetSelf(PetscInt nbodies, SceneBody bodies[], SceneContactPair *);
/* Returns the body that a face belongs to */
PETSC_EXTERN const SceneBody *SceneFaceBody(Scene, const char face[]);
/* Returns whether a pair is between two rigid bodies */
static inline PetscBool SceneContactPairIsRigid(Scene scene, const SceneContactPair *pair)
{
  return (PetscBool)(SceneFaceBody(scene, pair->mortar)->material.type == MATERIAL_RIGID &&
                     SceneFaceBody(scene, pair->nonmortar)->material.type == MATERIAL_RIGID);
}
PETSC_EXTERN void      SceneFindStiffest(Scene, const SceneBody **soft, const SceneBody **hard);
PETSC_EXTERN PetscReal SceneRatioBeyondRounding(Scene, const SceneBody **soft, const SceneBody **hard);
/* Evaluates the expression of an entry at a position x, y, z. It is an error if the value is not finite. what: what the
   entry is, "Pressure" for example */
PETSC_EXTERN PetscErrorCode SceneEvaluatePlace(const void *entry, const char what[], const char expression[],
  const PetscReal x[3], PetscReal *value);

#endif
