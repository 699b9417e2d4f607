/* The model: what is simulated, as plain structs. All other parts use them; they use none. Lengths, forces and
   pressures are in any consistent set of units. */
#ifndef MODEL_H
#define MODEL_H

#include <petscsys.h>
#include "material.h"
#include "formulation.h"

/* The shapes. A new one is a file in src/mesh/shapes and a line here: name in C, and name in scenes */
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
  SHAPE(RIGID_REVOLVED, RigidRevolved, "rigid_revolved")

#define BODY_SHAPE(name, shape, text) SHAPE_##name,
typedef enum { BODY_SHAPES(BODY_SHAPE) SHAPE_GMSH } BodyShape;
#undef BODY_SHAPE
PETSC_EXTERN const char *const BodyShapes[];

#define BODY_OWN 64

/* Where a rigid surface has its parameters among a body's own: three numbers each of point and axis */
#define SURFACE_MAX_PROFILE 40 /* numbers of a profile */

enum {
  SURFACE_POINT   = 0,
  SURFACE_AXIS    = 3,
  SURFACE_RADIUS  = 6,
  SURFACE_SECTION = 7,
  SURFACE_ANGLE   = 8,
  SURFACE_SIZE    = 9,
  SURFACE_ACROSS  = 10, /* three numbers: direction of a profile's first coordinate */
  SURFACE_OUTSIDE = 13, /* how far the surface is outside of the profile */
  SURFACE_PROFILE = 16  /* number of numbers, then two for each point of the profile */
};

/* Arc of a tube, or a whole one; of a cylinder axis, center, outer radius and extent; of a cone the radii at the start
   and end of the extent. Angles are measured about the axis, from the next axis in the order x, y, z, x (for the axis
   y: from z to x) */
typedef struct {
  PetscInt  axis;      /* 0, 1, 2: along x, y, z */
  PetscReal center[3]; /* a point on the axis [length] */
  PetscReal radii[2];  /* inner, outer; of a cone at its start and end [length] */
  PetscReal angles[2]; /* first and last angle [degrees] */
  PetscReal extent[2]; /* first and last position along the axis [length] */
} SceneTubeArc;

/* Prism with the cross-section of half an ellipse, or of a quarter if it is cut at its plane of symmetry */
typedef struct {
  PetscInt  axis;      /* axis of the prism: 0, 1, 2 */
  PetscInt  depth;     /* direction from the flat side to the crown: 0, 1, 2: x, y, z; 3, 4, 5: -x, -y, -z */
  PetscInt  half;      /* direction from the plane of symmetry to the half that is modelled; PETSC_DECIDE: both halves
                          */
  PetscReal center[3]; /* a point on the line where the flat side meets the plane of symmetry [length] */
  PetscReal semi_axes[2]; /* semi-axis along depth, and across [length] */
  PetscReal extent[2];    /* first and last position along the axis [length] */
} SceneHalfEllipse;

typedef struct {
  PetscReal radius, center[3]; /* [length] */
} SceneSphere;

#define OCTANT_BOTH 2 /* the octants on both sides of the plane are modelled */

/* The octants of shells and balls: cut out by the three coordinate planes through a corner */
typedef struct {
  PetscReal   corner[3];     /* [length] */
  PetscInt    signs[3];      /* +1 or -1 for the side of each plane, or OCTANT_BOTH; 0 stands for 1 */
  SceneSphere inner, outer;  /* of sphere_shell; outer also of ball */
  SceneSphere cap;           /* sphere_shell: cuts the outer sphere; radius 0: none */
  PetscReal   inner_axes[3]; /* spheroid_shell: semi-axes [length] */
  PetscReal   outer_axes[3];
  PetscReal   layer_grading; /* thickness of the outermost layer / that of the innermost; 0: 1 */
  PetscInt    layer_even;    /* number of equal layers at the fine end of the grading; 0 stands for 1 */
} SceneOctant;

/* One volume of a mesh file */
typedef struct {
  char     *file;       /* with its folder */
  char     *volume;     /* physical name */
  PetscReal scale;      /* factor of its coordinates; 0 stands for 1 */
  char     *converted;  /* the temporary Gmsh file that a file of another format, or with a scale, became; else NULL */
  PetscInt  nsurfaces;  /* number of its faces surface_1, surface_2, ..., which are the parts of the boundary between
                           sharp edges; 0: it has none, until something needs them */
  int       descriptor; /* of that file, for the first body that has it, on the first rank; 0: none */
} SceneGmsh;

/* A part of a face: its facets at refinement level 0 whose centroids lie in a box */
typedef struct {
  char     *name;               /* "<body>.<name>" is a face */
  char     *of;                 /* name of the face without the body */
  PetscReal lower[3], upper[3]; /* bounds of the box, may be infinite [length] */
} SceneSubface;

/* A body: shape and mesh at refinement level 0. The patches of an octant are its cells along x, y and z. Those of a
   half ellipse are the cells of its core along depth and across half of it, and of the ring around the core. */
typedef struct {
  char       *name;
  BodyShape   shape;
  PetscReal   lower[3], upper[3]; /* box: opposite corners [length] */
  PetscInt    cells[3];           /* number of cells: box: along each axis; tube_arc: radially, around, along; other
                                     shapes: in patches */
  Material    material;
  ElementType element;
  PetscInt  order; /* order of the displacements in a cell, 1 or 2; 0: the default, 1 for hexahedra, 2 for tetrahedra */
  PetscReal grading[3]; /* size of the last cell / size of the first: box, octants: along each axis; tube_arc: like
                           cells; half_ellipse: core along depth, core across, ring; 0: 1 */
  PetscInt  even[3];    /* number of equal cells at the fine end of each grading; 0 stands for 1 */
  PetscInt  layers;     /* number of cells: half_ellipse: along the axis; octants: through the shell */
  PetscBool curved;     /* refined vertices follow the shape's curved surfaces; false: the facets of level 0 */
  SceneTubeArc     tube;
  SceneHalfEllipse ellipse;
  SceneOctant      octant;
  SceneGmsh        gmsh;
  PetscReal        own[BODY_OWN]; /* parameters of shapes without a named member here */
  PetscInt         nsubfaces;
  SceneSubface    *subfaces;
  PetscBool whole; /* its whole boundary is a face, "<body>" SCENE_WHOLE_BODY, which comes into contact with itself */
  PetscReal velocity[3], spin[3]; /* at time 0 [length/time]; about the centre of mass [radians/time] */
} SceneBody;

/* A load history (ramp): the factor at the end of each load step, linear in between */
typedef struct {
  char      *name;
  PetscReal  start;  /* factor before the first load step: 0 but in dynamics */
  PetscReal *factor; /* nsteps values */
} SceneRamp;

/* Inertia: a load step is a time step */
typedef struct {
  PetscReal      time_step, end_time; /* [time]; time_step 0: a static analysis */
  DynamicsScheme scheme;
  MassType       mass;
  PetscReal      spectral_radius; /* of generalized-alpha, at infinite frequency: 0 to 1, 1 dissipates nothing */
  PetscReal      tolerance;       /* of the error of time steps, which are then controlled; 0: all are of one length */
  PetscReal      damping_mass;    /* forces by mass times velocity [1/time] */
  PetscReal      damping_stiffness; /* forces by stiffness times velocity [time] */
} SceneDynamics;

typedef enum {
  DISPLACEMENT_FACE, /* a face, or a whole rigid body */
  DISPLACEMENT_POINT,
  DISPLACEMENT_EDGE
} DisplacementPlace;

/* replaces the face's name for a whole rigid body, and for the whole boundary of another body */
#define SCENE_WHOLE_BODY ".*"

typedef struct {
  char     *name;
  char     *face;     /* "<body>.<face>", the name of a facet label of the mesh; or "<body>" SCENE_WHOLE_BODY: a whole
                         rigid body */
  PetscBool fixed[3]; /* which components are prescribed */
  PetscReal value[3]; /* prescribed displacement at factor 1 [length] */
  PetscBool moves;    /* a rigid motion of a rigid body, or of a face with a rotation; motions of one face or body add
                         up */
  PetscReal rotation[3]; /* rotation vector about an axis through `center`, at factor 1 [degrees] */
  PetscReal center[3];   /* center of rotation, which moves by `value` [length] */
  PetscBool released[6]; /* rigid body: translations and rotations (about the center) that are free and driven by
                            forces */
  PetscBool inclined;    /* an inclined symmetry plane: the displacement along `normal` is 0, no component is
                          prescribed */
  PetscReal normal[3];   /* normal of the plane, any length */
  DisplacementPlace at;
  PetscInt          body;           /* of a point or an edge: body */
  PetscReal         from[3], to[3]; /* ends of the edge; for a point both are the same [length] */
  PetscInt          ramp;
} SceneDisplacement;

/* A pressure: force -value x normal, on the reference face (dead load) or on the deformed face (follower load) */
typedef struct {
  char     *name;
  char     *face;
  PetscBool follows; /* acts on the deformed normal and area */
  PetscReal value;   /* at factor 1; positive values push on the body [force/length^2] */
  PetscInt  ramp;
} ScenePressure;

/* A dead load on a face or a rigid body: a uniform traction, or a resultant force. With a moment the traction varies
   linearly over the face. */
typedef struct {
  char     *name;
  PetscInt  body;      /* rigid body on which the resultant acts; PETSC_DECIDE: it acts on a face */
  char     *face;      /* with a resultant also a whole rigid body, "<body>" SCENE_WHOLE_BODY */
  PetscBool resultant; /* value is a force [force], not a traction [force/length^2]; at factor 1 */
  PetscReal value[3];
  PetscReal moment[3]; /* moment of the resultant about its point of action, at factor 1 [force length] */
  PetscBool placed;    /* the point of action is given; otherwise it is the face's centroid */
  PetscReal point[3];  /* [length] */
  PetscInt  ramp;
} SceneTraction;

/* Springs between a face and the ground, or another face */
typedef struct {
  char     *name;
  char     *face;
  char     *to;       /* NULL: the ground; else a face that covers the first one */
  PetscReal distance; /* largest distance of facets that are joined [length]; 0: from their size */
  PetscReal value[3]; /* stiffness along x, y, z per undeformed area of face [force/length^3] */
} SceneSpring;

/* A spring between a point of a body and the ground, or a point of another body */
typedef struct {
  char     *name;
  PetscInt  body, to;    /* to: PETSC_DECIDE: the ground */
  PetscReal point[2][3]; /* of the body, and of the other one [length] */
  PetscBool axial;       /* the spring acts along the line between the points, not along the axes */
  PetscReal stiffness;   /* then [force/length] */
  PetscReal value[3];    /* else: along x, y, z [force/length] */
} SceneConnector;

/* Pretension of a bolt: a section through a body, with a force or a shortening */
typedef struct {
  char     *name;
  PetscInt  body;
  PetscReal point[3], axis[3]; /* of the plane of the section; axis: any length */
  PetscBool shortens;          /* the shortening is prescribed, not the force */
  PetscReal force;             /* tension at factor 1 [force] */
  PetscReal shortening;        /* at factor 1 [length] */
  PetscInt  lock;              /* load step after which the shortening stays as it is; 0: never */
  PetscInt  ramp;
} SceneBolt;

typedef struct {
  char     *name;
  PetscInt  body;     /* index, or PETSC_DECIDE: every body */
  PetscReal value[3]; /* at factor 1, per reference volume [force/length^3] */
  PetscInt  ramp;
} SceneBodyForce;

/* A temperature rise above the stress-free temperature; several for one body add up */
typedef struct {
  char    *name;
  PetscInt body;  /* index, or PETSC_DECIDE: every body that expands */
  char    *value; /* an expression in the undeformed coordinates x, y, z [temperature], at factor 1 */
  PetscInt ramp;
} SceneTemperature;

typedef struct {
  char       *name;
  char       *mortar;    /* "<body>.<face>" */
  char       *nonmortar; /* "<body>.<face>": the face that carries the constraints */
  char       *self;      /* body or face in contact with itself, which mortar and nonmortar both name; of a rule "true":
                            all bodies of finite strain; NULL: two faces */
  GapType     gap;
  PetscReal   distance;          /* largest distance of facets that pair [length]; 0: from the size of the faces */
  PetscReal   interference;      /* largest intended initial overlap [length]; 0: none, PETSC_INFINITY: any */
  PetscInt    interference_ramp; /* ramp of the interference; PETSC_DECIDE: applied from the start */
  PetscReal   friction;          /* friction coefficient; 0: none, PETSC_INFINITY: sticks under any force */
  PetscReal   shear_limit;       /* limit of the friction stress [force/length^2]; PETSC_INFINITY: none */
  PetscInt    friction_ramp;     /* ramp of the coefficient; PETSC_DECIDE: constant */
  PetscReal   tie;               /* only of rules: surfaces that are nearer than this are tied [length]; 0: none */
  char       *except;            /* only of rules: bodies and faces without contact, or two of them as "a/b" */
  const char *why;               /* found by a rule: why the nonmortar side is that; NULL: the scene names both sides */
  PetscReal   apart;  /* found by a rule: smallest distance along a normal in the undeformed state [length] */
  PetscBool   smooth; /* measure the gap between smooth surfaces through the facets of curved faces */
} SceneContactPair;

static inline PetscBool SceneContactPairHasFriction(const SceneContactPair *pair)
{
  return (PetscBool)(pair->friction > 0.0 && pair->shear_limit > 0.0);
}

/* A tie: two faces that are joined in the undeformed state */
typedef struct {
  char     *name;
  char     *mortar;
  char     *nonmortar; /* the face whose displacements follow the other's */
  PetscReal distance;  /* largest distance of facets that are joined [length]; 0: from their size */
} SceneTie;

/* Cyclic symmetry: a body of which a sector is modelled ends on two faces; the second is the first one, turned about
   the axis by the sector's angle */
typedef struct {
  char     *name;
  char     *from, *to;          /* "<body>.<face>" of one body */
  PetscReal axis[3], center[3]; /* direction of the axis, any length, and a point on it [length] */
} SceneCyclic;

/* A zone of finer cells: near a face, near both faces of a contact pair, or in a box */
typedef struct {
  char     *name;
  char     *face[2];            /* "<body>.<face>"; NULL: none */
  PetscInt  body;               /* PETSC_DECIDE: any */
  PetscReal lower[3], upper[3]; /* box, if there is no face [length] */
  PetscReal distance;           /* the zone's distance from each face, or from the box [length] */
  PetscInt  levels;             /* refinements beyond the uniform ones */
} SceneRefinement;

/* A probe: a point, or equally spaced points along a line, of the undeformed bodies */
typedef struct {
  char     *name;
  PetscInt  body; /* PETSC_DECIDE: any */
  PetscBool line;
  PetscInt  n;              /* points */
  PetscReal from[3], to[3]; /* ends of the line; for a point only `from` is used [length] */
} SceneProbe;

/* A PETSc option, without its leading dash */
typedef struct {
  char     *name, *value;
  PetscBool set; /* the scene's value is in use: neither the command line nor an options file set the option */
} SceneOption;

typedef struct _n_Scene {
  char              *name;
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
  PetscReal       weak_springs; /* stiffness of the weak springs on bodies that move freely, relative to Young's modulus
                             times the cube root of the volume; 0: none */
  PetscInt        nconnectors;
  SceneConnector *connectors;
  PetscInt        nbolts;
  SceneBolt      *bolts;
  PetscInt        nforces;
  SceneBodyForce *forces;
  PetscInt        ntemperatures;
  SceneTemperature *temperatures;
  PetscInt          npairs;
  SceneContactPair *pairs;
  PetscInt          nrules; /* contact entries that name no faces; ContactDetect() turns them into pairs and ties */
  SceneContactPair *rules;
  PetscInt          nties;
  SceneTie         *ties;
  PetscInt          ncyclic;
  SceneCyclic      *cyclic;
  PetscInt          nrefinements;
  SceneRefinement  *refinements;
  PetscInt          nprobes;
  SceneProbe       *probes;
  SceneDynamics     dynamics;
  PetscInt          nsteps; /* load steps, at least 1 */
  PetscInt          nramps; /* at least 1: ramp 0 is the load, for everything that names no ramp */
  SceneRamp        *ramps;
  PetscInt          refine; /* uniform refinements of level 0 */
  StepModel         model;
  PetscInt contact_updates;     /* limit of contact updates per load step; 1: one update, and the gap is not required
                                   to be consistent */
  PetscInt displacement_bounds; /* first load step (from 1) whose displacements are bounded by the largest increment so
                                   far; 0: none */
  PetscInt noptions;            /* number of PETSc options */
  SceneOption *options;
} * Scene;

/* Returns whether the analysis is dynamic, so that bodies have inertia */
static inline PetscBool SceneIsDynamic(Scene scene)
{
  return (PetscBool)(scene->dynamics.time_step > 0.0);
}

/* Returns the time step; load step k ends at k times this value. It is 1 in a static analysis. */
static inline PetscReal SceneTimeStep(Scene scene)
{
  return SceneIsDynamic(scene) ? scene->dynamics.time_step : 1.0;
}

/* Factor of a ramp at a time in load steps: load step k ends at time k, from 1 */
PETSC_EXTERN PetscErrorCode SceneGetFactor(Scene, PetscInt ramp, PetscReal time, PetscReal *factor);
/* Returns whether a body is a rigid surface, whose contact uses a formula instead of facets */
static inline PetscBool SceneBodyIsSurface(const SceneBody *body)
{
  return (PetscBool)(body->shape >= SHAPE_RIGID_PLANE && body->shape <= SHAPE_RIGID_REVOLVED);
}

/* The cube of one cell that moves a rigid surface: corner, unit vectors of its edges, length of the edges */
typedef struct {
  PetscReal corner[3], edge[3][3], size;
} SceneSurfaceCube;
PETSC_EXTERN void SceneSurfaceGetCube(const SceneBody *, SceneSurfaceCube *);
/* Returns the distance of a point from an undeformed rigid surface, negative inside [length]; computes its gradient */
PETSC_EXTERN PetscReal SceneSurfaceDistance(const SceneBody *, const PetscReal x[3], PetscReal gradient[3]);
/* Sets both sides of a pair whose `self` is set, and marks the body if they are its whole boundary */
PETSC_EXTERN PetscErrorCode SceneContactPairSetSelf(PetscInt nbodies, SceneBody bodies[], SceneContactPair *);
/* Returns the body that a face belongs to */
PETSC_EXTERN const SceneBody *SceneFaceBody(Scene, const char face[]);
/* Evaluates an expression in x, y and z at a point */
PETSC_EXTERN PetscErrorCode SceneEvaluatePlace(const char expression[], const PetscReal x[3], PetscReal *value);

#endif
