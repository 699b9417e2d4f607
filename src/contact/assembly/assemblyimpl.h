/*
   Contact rows: which exist, and how the linearized gap is assembled.
*/
#ifndef ASSEMBLYIMPL_H
#define ASSEMBLYIMPL_H

#include "src/contact/smooth/smoothimpl.h"

/* The object */
typedef struct {
  char          *name; /* name of the pair, for messages */
  ContactSurface mortar, nonmortar;
  ContactRing    mortar_ring, nonmortar_ring; /* facets around the surfaces, for smooth pairs */
  GapType        gap;
  PetscBool      frictional;    /* whether the pair has friction */
  PetscBool      sticks;        /* whether friction allows no slip (`stick: true`) */
  PetscInt       nfrictionless; /* number of rows, on all ranks, at which friction cannot act although the faces
                                   slide; set when the slip rows are created */
  PetscBool      smooth;        /* whether the gap is measured between smooth surfaces */
  PetscReal  bulge;    /* largest distance of the smooth surfaces from the undeformed facets, sum of both faces [length]
                        */
  PetscBool  dual;     /* use dual functions for mortar gaps even if the pair does not ask for them */
  PetscReal  given;    /* search distance of the scene; 0: computed from the size of the faces [length] */
  PetscInt  *row;      /* [4 nonmortar facets] global row of each of the facets' vertices */
  PetscReal *normal;   /* [12 nonmortar facets] averaged unit normals at the facets' vertices */
  PetscReal  distance; /* search distance: facets that are farther apart do not pair [length] */
  PetscReal  depth;    /* search depth: facets that penetrate deeper do not pair, as they are on the far side of a
                          body [length] */
  PetscInt   nfacing;  /* in the last contact update, on this rank: overlapping facet pairs, or vertices opposite a
                          facet */
  const SceneBody *formula;     /* the mortar side is a rigid surface; NULL: it is a face of facets */
  PetscInt         corner[4];   /* global numbers of four corners of its cube */
  PetscReal        place[4][3]; /* where they are [length] */
} ContactPairData;

/* Whether patches follow the bending of order-2 faces between their nodes. Otherwise vertices move with the mean
   displacement (trace.c). */
static inline PetscBool ContactPairFollows(const ContactPairData *pair)
{
  return (PetscBool)(pair->mortar.patched && pair->gap != GAP_NODE);
}

/* All possible rows, before any is dropped: for each pair in turn, the nonmortar vertices that this rank owns */
typedef struct {
  PetscInt   nlocal, *first; /* rows first[p] to first[p + 1] - 1 of this rank belong to pair p */
  PetscInt  *vertex;         /* [nlocal] local DMPlex points of the nonmortar vertices */
  PetscInt  *held;    /* [nlocal] directions without slip: a bit for each axis, plus 8 (1 + number of the symmetry
                        plane) for an inclined plane; NULL: not computed yet */
  PetscReal *normal;  /* [3 nlocal] averaged unit normals */
  PetscReal *x;       /* [3 nlocal] coordinates of the deformed vertices [length] */
  Vec        mass;    /* int phi_A over the whole undeformed nonmortar face [length^2] */
  Vec        weight;  /* the same, after the masses of hanging vertices were distributed to the vertices that they
                         depend on */
  Mat        hanging; /* distributes the sums of hanging rows; NULL: no vertex hangs */
} ContactRows;

/* Derivatives of the normals of all smooth surfaces by the displacement. A rank stores the normals at the corners of
   its own facets. */
typedef struct {
  PetscInt            nlocal; /* normals */
  ContactNormalSlopes blocks; /* nodes and their order do not depend on the displacement */
  Mat                 slopes; /* three rows per normal, columns are global rows of the DM; NULL: no pair is smooth */
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
  PetscBool                frictional; /* whether any pair has friction */
  ContactRows              rows;
  ContactNormals           normals;
  PetscInt                 ndisplacements;
  const SceneDisplacement *displacements; /* prescribed displacements of the bodies' faces; borrowed from the caller */
  PetscBool                smoothed;      /* whether ContactSmoothFind() has found the curved pairs */
  ContactSmoothNormals     smooth;
  Mat         trace;     /* added to the mesh's displacement at the surfaces' vertices; NULL: no face has order 2 */
  ContactRule rule;      /* of the triangles that overlaps are cut into */
  PetscReal   reach;     /* least search distance of pairs without one of their own [length] */
  PetscReal reach_depth; /* least search depth of all pairs, for any angle of the normals; 0: the usual one [length] */
  PetscReal depth;       /* 0: from the thickness of the bodies */
  PetscInt  nrows;       /* of the last linearization, on all ranks */
};

/* rows.c: all possible rows */
PETSC_INTERN PetscErrorCode ContactRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactRowsDestroy(Contact);

/* hanging_rows.c: rows of hanging vertices */
PETSC_INTERN PetscErrorCode ContactHangingRowsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactHangingRowsVector(Contact, Vec sums);
PETSC_INTERN PetscErrorCode ContactHangingRowsMatrix(Contact, Mat *sums);

/* surface_normals.c: global numbers of the normals of smooth surfaces, and their derivatives at the current
   displacement */
PETSC_INTERN PetscErrorCode ContactSmoothNormalsCreate(Contact);
PETSC_INTERN PetscErrorCode ContactSmoothNormalsUpdate(Contact);
PETSC_INTERN PetscErrorCode ContactSmoothNormalsDestroy(Contact);

/* smooth.c: finds the curved pairs and computes their smooth surfaces */
PETSC_INTERN PetscErrorCode ContactSmoothFind(Contact, Vec);
PETSC_INTERN PetscErrorCode ContactSmoothDeform(Contact, Vec u);
PETSC_INTERN PetscErrorCode ContactSmoothReset(Contact);

/* entries.c: blocks of matrix entries in any order; repeated ones are added. Block b of a row is columns width b to
   width (b + 1) - 1. Starts as zeros but for the width */
typedef struct {
  PetscInt     n, size, width; /* blocks used; blocks allocated; entries of a block */
  PetscInt    *row, *block;
  PetscScalar *value; /* [width n] */
} ContactEntries;
PETSC_INTERN PetscErrorCode ContactEntriesAdd(ContactEntries *, PetscInt row, PetscInt n, const PetscInt block[],
  const PetscReal value[]);
PETSC_INTERN PetscErrorCode ContactEntriesCreateMatrix(MPI_Comm, PetscInt m, PetscInt n, ContactEntries *, Mat *);
PETSC_INTERN PetscErrorCode ContactEntriesDestroy(ContactEntries *);

/* held.c: computes rows->held once: the directions in which rows with friction have no slip */
PETSC_INTERN PetscErrorCode ContactFindHeld(Contact);

/* slip.c: the slip rows that belong to the rows of the gap */
PETSC_INTERN PetscErrorCode ContactSlipCreate(Contact, Mat couplings, const PetscInt kept[], ContactLinearization);

/* assemble.c: data of a contact update under construction */
typedef struct {
  PetscBool      gaps_only;   /* without derivatives of smooth pairs */
  Vec            gap;         /* int phi_A gap [length^3] */
  Vec            cover;       /* int phi_A over the covered part, for smooth mortar pairs [length^2] */
  PetscInt       dim;         /* 1: one value per vertex, multiplied by the row's normal; 3: a vector per vertex */
  ContactEntries coupling[3]; /* dim times, by vertices: int phi_A (N2 - N1) [length^2]; times the normal: derivative of
                                 the gap by the vertex's displacement */
  ContactEntries rigid, by_cover, by_node,
    by_normal; /* derivatives of smooth pairs, as in ContactSlopes: three columns per vertex or per normal */
} ContactAssembly;
PETSC_INTERN PetscErrorCode ContactAssemblyCreate(Contact, ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyAdd(ContactAssembly *, PetscInt row, PetscInt n, const PetscInt node[],
  const PetscReal value[], const PetscReal normal[3]);
PETSC_INTERN PetscErrorCode ContactAssemblyAddSlopes(ContactAssembly *, const PetscInt row[4], const PetscInt node[4],
  const PetscInt normal_id[4], const ContactSlopes *);
PETSC_INTERN PetscErrorCode ContactAssemblyDestroy(ContactAssembly *);
PETSC_INTERN PetscErrorCode ContactAssemblyFinish(Contact, ContactAssembly *, ContactLinearization *);

#endif
