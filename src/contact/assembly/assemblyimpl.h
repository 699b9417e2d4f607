/* The rows of the gap: which exist, and how the linearized gap is assembled from them. */
#ifndef ASSEMBLYIMPL_H
#define ASSEMBLYIMPL_H

#include "src/contact/smooth/smoothimpl.h"

/* An edge of a nonmortar facet with a convex corner of a rigid profile opposite it (rigid_corner.c) */
typedef struct {
  PetscInt  row, vertex; /* global number of the row, and local number of its vertex */
  PetscInt  node[2];     /* global numbers of the edge's vertices */
  PetscReal phi[2];      /* their shape functions opposite the corner */
  PetscReal gap;         /* height of the corner above the edge [length] */
  PetscReal normal[3];   /* unit normal of the nonmortar face */
  PetscReal weight[4];   /* weights of the rigid body's four corners */
  PetscReal share;       /* mass of the row, divided by the number of its edges with corners [length^2] */
} ContactProfileCorner;

/* A contact pair */
typedef struct {
  char          *name;              /* name of the pair, for messages */
  const char    *place;             /* place of the pair in the scene file, which the scene owns; NULL: none */
  ContactSurface mortar, nonmortar; /* the two faces, deformed to the displacement of the last contact update */
  ContactRing    mortar_ring, nonmortar_ring; /* the facets around the two faces, for the normals of smooth pairs */
  GapType        gap;                         /* GAP_AUTO is replaced by GAP_MORTAR and may_be_dual */
  PetscBool      may_be_dual;                 /* whether dual functions may replace those of GAP_MORTAR */
  PetscBool      frictional;                  /* whether the pair has friction */
  PetscBool      sticks;                      /* whether friction allows no slip (scene key `stick: true`) */
  PetscInt       nfrictionless; /* number of rows, on all ranks, on which no friction acts although the faces slide;
                                   set when the slip rows are created */
  PetscBool      stretches;     /* whether the nonmortar body has a law of finite strain */
  PetscBool      smooth;        /* whether the gap is measured between smooth surfaces */
  PetscReal      bulge; /* largest distance between the smooth surface and the facets, in the undeformed state, summed
                       over both faces [length] */
  PetscBool      dual;  /* whether mortar gaps use dual functions although the scene does not ask for them */
  PetscReal      given; /* search distance that the scene sets [length]; 0: it is computed from the size of the faces */
  PetscInt      *row;   /* [4 nonmortar facets] global row of each vertex of the facets */
  PetscReal     *normal;   /* [12 nonmortar facets] averaged unit normals at the facets' vertices */
  PetscReal      distance; /* search distance: facets farther apart are ignored [length] */
  PetscReal      depth; /* search depth: facets that overlap deeper are ignored, because they are on the far side of a
                       body [length] */
  const SceneBody *formula;   /* the rigid surface on the mortar side; NULL if the mortar side is a face of facets */
  PetscInt         corner[4]; /* global numbers of four corners of the cube that represents the rigid surface in the
                                 mesh */
  PetscReal        corner_at[4][3]; /* current coordinates of these corners [length] */
  PetscInt         ncorners;        /* number of edges of this rank's facets with a corner of a profile opposite */
  ContactProfileCorner *corners;
} ContactPairData;

/* Returns whether the smooth surfaces of a pair include the bending of order-2 facets between their nodes. For other
   pairs the facets' vertices move by the corrected displacement T u of trace.c. */
static inline PetscBool ContactPairFollows(const ContactPairData *pair)
{
  return (PetscBool)(pair->mortar.patched && pair->gap != GAP_NODE);
}

/* Returns whether the mortar gaps of a pair use dual functions */
static inline PetscBool ContactPairIsDual(const ContactPairData *pair)
{
  return (PetscBool)(pair->gap == GAP_DUAL || pair->dual);
}

/* All possible rows, before any is removed. For each pair in turn, they are the nonmortar vertices that this rank
   owns. */
typedef struct {
  PetscInt   nlocal, *first; /* rows first[p] to first[p + 1] - 1 of this rank belong to pair p; nlocal is their
                                total number */
  PetscInt  *vertex;         /* [nlocal] local DMPlex points of the nonmortar vertices */
  PetscInt  *no_slip;        /* [nlocal] directions without slip: bit c for axis c, plus 8 (1 + number of the prescribed
                      displacement) for an inclined symmetry plane; NULL until ContactFindNoSlip() has computed them */
  PetscReal *normal;         /* [3 nlocal] averaged unit normals of the deformed nonmortar faces */
  PetscReal *x;              /* [3 nlocal] coordinates of the deformed vertices [length] */
  PetscBool *at_corner;      /* [nlocal] whether the row has the gap of a corner of a rigid profile instead of that of
                                its vertex */
  Vec        mass;        /* lumped mass of each row: int phi_A over the whole undeformed nonmortar face [length^2] */
  Vec        weight;      /* masses after those of hanging and prescribed vertices were distributed to other rows
                        [length^2] */
  Mat        hanging;     /* transposed, it distributes the sums of the rows of hanging and prescribed vertices to other
                             rows; NULL if there are none */
  PetscBool  distributed; /* whether ContactPrescribedRowsDistribute() has changed `hanging` */
} ContactRows;

#define CONTACT_OVERLAP_DROP 1e-8 /* Overlaps smaller than this fraction of the smaller facet's area are ignored. */
#define CONTACT_ROW_DROP     1e-5 /* Rows whose 1-norm is less than this fraction of the largest row's are removed. */

typedef struct _n_ContactCyclic *ContactCyclic;

struct _n_Contact {
  DM               dm;
  MPI_Comm         comm;
  PetscInt         npairs;
  ContactPairData *pairs;
  PetscBool        frictional; /* whether any pair has friction */
  PetscBool        self;       /* whether any pair is a face in contact with itself */
  PetscBool        stretches;  /* whether the nonmortar body of any pair has a law of finite strain */
  ContactDualPairs dual;       /* set by ContactSetDual() */
  ContactRows      rows;
  ContactCyclic    cyclic; /* cuts of sectors; NULL: none */
  PetscInt         ndisplacements;
  /* prescribed displacements of the bodies' faces; the caller owns them */
  const SceneDisplacement *displacements;
  PetscBool                smoothed; /* whether ContactSmoothFind() has determined the curved pairs */
  PetscBool                smooth;   /* whether there are any */
  Mat         trace;   /* T - 1 (trace.c): added to the mesh's displacement at the surfaces' vertices; NULL if no face
                        has order 2 */
  ContactRule rule[2]; /* quadrature rules on the triangles of overlaps: between facets, and between smooth surfaces */
  PetscReal   reach;   /* lower bound of the search distance, for pairs whose distance the scene does not set
                          [length] */
  PetscReal
    reach_depth;   /* lower bound of the search depth of all pairs [length]; 0: none. If positive, facets face each
                            other whose normals make an angle of more than 90 degrees */
  PetscReal depth; /* search depth from the option -contact_search_depth [length]; 0: computed from the thickness of
                      the bodies */
};

/* gap_rows.c: the list of all possible rows */
PETSC_INTERN PetscErrorCode ContactRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactRowsDestroy(Contact);
PETSC_INTERN PetscErrorCode ContactGatherEntries(Vec, IS from, Vec *gathered);

/* areas.c: lumped areas of nonmortar faces whose bodies have a law of finite strain */
PETSC_INTERN PetscErrorCode ContactRowAreas(Contact, PetscBool weights, ContactLinearization, PetscReal area[]);

/* hanging_rows.c: distributes the sums of hanging vertices' rows to the rows of other vertices */
PETSC_INTERN PetscErrorCode ContactHangingRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactHangingRowsWeigh(ContactRows *);
PETSC_INTERN PetscErrorCode ContactHangingRowsVector(Contact, Vec sums);
PETSC_INTERN PetscErrorCode ContactHangingRowsMatrix(Contact, Mat *sums);

/* prescribed_rows.c: distributes the rows of vertices at which both faces have the same prescribed displacement */
PETSC_INTERN PetscErrorCode ContactPrescribedRowsDistribute(Contact);
PETSC_INTERN PetscErrorCode ContactPrescribedRowsReset(Contact);
PETSC_INTERN PetscReal      ContactDistanceAlongFacet(const PetscReal x[3], const PetscReal nx[3], const PetscReal y[3],
       const PetscReal ny[3]);

/* smooth.c: determines which pairs are curved, and computes their smooth surfaces */
PETSC_INTERN PetscErrorCode ContactSmoothFind(Contact, Vec);
PETSC_INTERN PetscErrorCode ContactSmoothDeform(Contact, Vec u);
PETSC_INTERN PetscErrorCode ContactSmoothReset(Contact);

/* entries.c: blocks of matrix entries in any order, to which repeated blocks are added. Block b of a row consists of
   columns width b to width (b + 1) - 1. The struct is initialized with zeros, apart from the width. */
typedef struct {
  PetscInt     n, size, width; /* number of blocks used; number of blocks allocated; number of entries of a block */
  PetscInt    *row, *block;    /* [n] global row and number of each block */
  PetscScalar *value;          /* [width n] entries of the blocks */
} ContactEntries;
PETSC_INTERN PetscErrorCode ContactEntriesAdd(ContactEntries *, PetscInt row, PetscInt n, const PetscInt block[],
  const PetscReal value[]);
PETSC_INTERN PetscErrorCode ContactEntriesCreateMatrix(MPI_Comm, PetscInt m, PetscInt n, ContactEntries *, Mat *);
PETSC_INTERN PetscErrorCode ContactEntriesDestroy(ContactEntries *);

/* cyclic_rows.c: rows of vertices on the cuts of a sector */
PETSC_INTERN PetscErrorCode ContactCyclicMerge(Contact, ContactLinearization);
PETSC_INTERN PetscErrorCode ContactCyclicDestroy(Contact);

/* no_slip.c: computes rows->prescribed once: the directions along which rows with friction have no slip */
PETSC_INTERN PetscErrorCode ContactFindNoSlip(Contact);

/* slip.c: the slip rows of the contact rows that remain */
PETSC_INTERN PetscErrorCode ContactSlipCreate(Contact, Mat couplings, const PetscInt kept[], ContactLinearization);
PETSC_INTERN PetscErrorCode ContactSlipCreateMortar(Contact, Mat couplings, const PetscInt kept[],
  ContactLinearization);

/* assemble.c: the data of one contact update while it is assembled */
typedef struct _n_ContactAssembly {
  ContactParts parts;
  Vec          gap;   /* weighted gap of each row: int phi_A gap [length^3] */
  Vec          cover; /* int phi_A over the covered part, for smooth mortar pairs [length^2] */
  Vec          doubt; /* int phi_A times the uncertainty of the smooth surfaces [length^3] */
  /* couplings of rows with vertices: int phi_A (N2 - N1) [length^2]. Multiplied by the normal and divided by the row's
     mass, a coupling is the derivative of the gap with respect to the vertex's displacement. */
  ContactEntries coupling;
  ContactEntries rigid,
    by_cover; /* derivatives of the weighted gaps of smooth pairs, as in ContactSlopes: three columns
                                     per vertex */
  /* couplings and rigid derivatives with respect to the mortar side alone, of pairs whose two sides are one face; NULL:
     there are none */
  struct _n_ContactAssembly *mortar;
} ContactAssembly;
PETSC_INTERN PetscErrorCode ContactAssemblyCreate(Contact, ContactParts, ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyAddSlopes(ContactAssembly *, const PetscInt row[4], const PetscInt node[4],
  const ContactSlopes *);
PETSC_INTERN PetscErrorCode ContactAssemblyDestroy(ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyFinish(Contact, ContactAssembly *, ContactLinearization *);

#endif
