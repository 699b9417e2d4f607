/*
   The rows of the gap: which there are, and how a linearization is put together.
*/
#ifndef ASSEMBLYIMPL_H
#define ASSEMBLYIMPL_H

#include "src/contact/smooth/smoothimpl.h"

/* The object */
typedef struct {
  char          *name; /* of the pair, for messages */
  ContactSurface mortar, nonmortar;
  ContactRing    mortar_ring, nonmortar_ring; /* where the surfaces are patched */
  GapType        gap;
  PetscBool      rubs;      /* whether the pair's slip is asked for */
  PetscBool      sticks;    /* whether none is allowed */
  PetscInt   nfrictionless; /* number of rows, on all ranks, where friction cannot act although the faces slide; known
                              once there are rows of slip */
  PetscBool  smooth;        /* whether the gap is measured between smooth surfaces */
  PetscReal  bulge;    /* largest distance of the smooth surfaces from the undeformed facets, sum of both faces [length]
                        */
  PetscBool  dual;     /* mortar gaps by dual functions, whether the pair asks for them or not */
  PetscReal  given;    /* the pair's own search distance; 0: from the size of the faces [length] */
  PetscInt  *row;      /* [4 nonmortar facets] global row of each of the facets' vertices */
  PetscReal *normal;   /* [12 nonmortar facets] averaged unit normals at the facets' vertices */
  PetscReal  distance; /* facets farther apart than this do not pair [length] */
  PetscReal  depth;    /* facets that penetrate deeper than this do not pair: they are on the other side of a body
                          [length] */
  PetscInt   nfacing;  /* of the last contact update, on this rank: overlapping facets, or vertices opposite a facet */
} ContactPairData;

/* Whether patches follow the bending of order-2 faces between their nodes; else their vertices move with the mean of
   it */
static inline PetscBool ContactPairFollows(const ContactPairData *pair)
{
  return (PetscBool)(pair->smooth && pair->gap != GAP_NODE);
}

/* All rows there may be, before any is dropped: for each pair in turn, the nonmortar vertices this rank owns */
typedef struct {
  PetscInt   nlocal, *first; /* rows first[p] to first[p + 1] - 1 of this rank belong to pair p */
  PetscInt  *vertex;         /* [nlocal] local DMPlex points */
  PetscInt  *held;   /* [nlocal] bits of the axes without slip, plus 8 times (1 + the number of an inclined plane across
                      which there is none); NULL: not computed yet */
  PetscReal *normal; /* [3 nlocal] averaged unit normals */
  PetscReal *x;      /* [3 nlocal] coordinates of the deformed vertices [length] */
  Vec        mass;   /* int phi_A over the whole undeformed nonmortar face [length^2] */
  Vec        weight; /* the same, with that of hanging vertices passed on to their neighbours */
  Mat        hanging; /* target rows of the sums of each row; NULL: no vertex hangs, each row keeps its own */
} ContactRows;

/* Derivatives of the normals of all smooth surfaces by the displacement; a rank has those of its own facets' corners */
typedef struct {
  PetscInt            nlocal; /* normals */
  ContactNormalSlopes blocks; /* the same nodes in the same order at every displacement */
  Mat                 slopes; /* three rows a normal, columns are the DM's global rows; NULL where no pair is smooth */
} ContactSmoothNormals;

/* Direction along which a mortar gap is measured */
typedef enum {
  CONTACT_NORMALS_NODAL, /* the averaged normal of the row's vertex */
  CONTACT_NORMALS_FACET  /* the normal of each nonmortar facet */
} ContactNormals;

#define CONTACT_FEATURE_ANGLE 35.0   /* edges between undeformed facets that make more degrees stay sharp */
#define CONTACT_NORMAL_COSINE -0.174 /* facets pair when n1.n2 is at most this */
#define CONTACT_OVERLAP_DROP  1e-8   /* overlaps below this part of the smaller facet's area are left out */
#define CONTACT_ROW_DROP      1e-5   /* rows whose 1-norm is below this part of the largest row's are left out */

struct _n_Contact {
  DM                       dm;
  MPI_Comm                 comm;
  PetscInt                 npairs;
  ContactPairData         *pairs;
  PetscBool                rubs; /* whether any of them does */
  ContactRows              rows;
  ContactNormals           normals;
  PetscInt                 ndisplacements;
  const SceneDisplacement *displacements; /* prescribed displacements of the bodies' faces; borrowed from the caller */
  PetscBool                smoothed;      /* whether it is known which pairs are curved */
  ContactSmoothNormals     bends;
  Mat         trace;     /* added to the mesh's displacement at the surfaces' vertices; NULL: no face has order 2 */
  ContactRule rule;      /* of the triangles that overlaps are cut into */
  PetscReal   reach;     /* least search distance of pairs without one of their own [length] */
  PetscReal reach_depth; /* least search depth of all pairs, for any angle of the normals; 0: the usual one [length] */
  PetscReal depth;       /* 0: from the thickness of the bodies */
  PetscInt  nrows;       /* of the last linearization, on all ranks */
};

/* rows.c: the rows there may be */
PETSC_INTERN PetscErrorCode ContactRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactRowsDestroy(Contact);

/* hanging_rows.c: rows of hanging vertices */
PETSC_INTERN PetscErrorCode ContactHangingRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactHangingRowsVector(Contact, Vec sums);
PETSC_INTERN PetscErrorCode ContactHangingRowsMatrix(Contact, Mat *sums);

/* surface_normals.c: numbers the normals of the pairs that are patched, and has their derivatives at the rings'
   displacement */
PETSC_INTERN PetscErrorCode ContactSmoothNormalsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactSmoothNormalsUpdate(Contact);
PETSC_INTERN PetscErrorCode ContactSmoothNormalsDestroy(Contact);

/* smooth.c: which pairs are curved, and their smooth surfaces */
PETSC_INTERN PetscErrorCode ContactSmoothDeform(Contact, Vec u);
PETSC_INTERN PetscErrorCode ContactSmoothReset(Contact);

/* entries.c: entries of a matrix, as they come; added up where they repeat */
typedef struct {
  PetscInt     n, size; /* in use, and space for them */
  PetscInt    *row, *column;
  PetscScalar *value;
} ContactEntries;
PETSC_INTERN PetscErrorCode ContactEntriesAdd(ContactEntries *, PetscInt row, PetscInt n, const PetscInt block[],
  const PetscReal value[]);
PETSC_INTERN PetscErrorCode ContactEntriesCreateMatrix(MPI_Comm, PetscInt m, PetscInt n, ContactEntries *, Mat *);
PETSC_INTERN PetscErrorCode ContactEntriesDestroy(ContactEntries *);

/* held.c: computes rows->held once: the directions in which rows of pairs with friction have no slip */
PETSC_INTERN PetscErrorCode ContactFindHeld(Contact);

/* slip.c: the rows of slip that go with those of the gap */
PETSC_INTERN PetscErrorCode ContactSlipCreate(Contact, Mat couplings, const PetscInt kept[], ContactLinearization);

/* assemble.c: one contact update under construction. entries: (row, node, value), added up where they repeat */
typedef struct {
  Vec       gap;        /* int phi_A gap [length^3] */
  Vec       cover;      /* int phi_A over what smooth mortar pairs cover [length^2] */
  PetscInt  n, size;    /* entries in use, and space for them */
  PetscInt *row, *node; /* global row, global number of the vertex */
  PetscInt  dim;        /* 1: one value an entry, since all share the row's normal; 3: a vector */
  PetscScalar
    *value[3]; /* int phi_A (N2 - N1) [length^2]; times the normal it is the derivative of the gap by the vertex's
                  displacement */

  ContactEntries rigid, by_cover, by_node,
    by_bend; /* of smooth pairs, as in ContactSlopes: three columns a vertex or a normal */
} ContactAssembly;
PETSC_INTERN PetscErrorCode ContactAssemblyCreate(Contact, ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyAdd(ContactAssembly *, PetscInt row, PetscInt n, const PetscInt node[],
  const PetscReal value[], const PetscReal normal[3]);
PETSC_INTERN PetscErrorCode ContactAssemblyAddSlopes(ContactAssembly *, const PetscInt row[4], const PetscInt node[4],
  const PetscInt bend[4], const ContactSlopes *);
PETSC_INTERN PetscErrorCode ContactAssemblyDestroy(ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyFinish(Contact, ContactAssembly *, ContactLinearization *);

#endif
