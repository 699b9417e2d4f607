/*
   The map of tao_ipfilter/friction: the laws of norm terms, which are friction, on the filtered subspace.
   Every file builds on those before it, and on the folders below.
*/
#ifndef IPFILTER_FRICTIONIMPL_H
#define IPFILTER_FRICTIONIMPL_H

#include "tao_ipfilter/subspace/subspaceimpl.h"

/* The system of a Newton step on the laws of constraints and norm terms: system.c */
typedef struct {
  PetscInt      m, k;        /* rows, directions in V */
  Mat           K, FK;       /* K_WW, and its factors */
  Mat           R, RD, G;    /* R, R D and R D R^T */
  Mat           Bv, Bf;      /* what the rows' equations take of v and f */
  Mat           A, F;        /* B_v R D R^T + B_f in the rows' scale, and its factors, */
  Mat           Pv, Pf;      /* and the B_v and B_f that they are of */
  PetscReal    *gives;       /* what rows give way by, by D */
  PetscReal    *scale;       /* force of a row over the root of its energy */
  PetscReal    *V, *ZV, *H;  /* columns of length m; of length kmax; of length k */
  PetscBLASInt *pivots;      /* of H */
  Vec           S;           /* and the scale that A has */
  PetscReal    *f, *v;       /* scratch, of rows */
  Vec           r, z, w, Kw; /* of rows and of W */
  PetscInt      fresh;       /* iterations that GMRES took with the factors when they were new */
  PetscBool     stale;       /* they no longer serve */
  PetscReal    *C;           /* C, where GMRES has given up: dense.c; NULL: it has not */
} IPTermSystem;

/* What is closed and slips of constraints and norm terms: laws.c */
typedef struct {
  PetscInt     m, n;                /* constraints and terms */
  PetscReal   *limit, *coefficient; /* of the terms; coefficient negative: none */
  PetscReal   *rho, *slope;         /* force per length of a term; of its bound by the constraint's force, */
  PetscReal   *theta, *way;         /* bound / |b| and b / |b|, where it was linearized */
  PetscReal   *dead;                /* along which nothing gives way, two a term */
  PetscReal    length;              /* size of the terms of a motion */
  PetscBool   *closed, *slips;
  PetscBool   *takes, listed; /* the rows that take part, once they are known */
  PetscInt     na;            /* and their number */
  PetscBool    met;           /* the last solution fulfils the laws, as far as was asked */
  PetscReal   *F, *Fy;
  IPTermSystem system;
} IPTermSet;

/* system.c */
PETSC_INTERN PetscErrorCode IPTermSystemSetUp(IPTermSystem *, PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R,
  PetscBool *definite);
PETSC_INTERN PetscErrorCode IPTermSystemDestroy(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemSetRow(IPTermSystem *, PetscInt row, PetscInt n, const PetscInt columns[],
  const PetscReal by_v[], const PetscReal by_f[], PetscReal scale);
PETSC_INTERN PetscErrorCode IPTermSystemAssemble(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemApplyCompliance(IPTermSystem *, const PetscReal f[], PetscReal v[]);

/* factor.c */
PETSC_INTERN PetscErrorCode IPTermFactorPrepare(IPTermSystem *, const IPReducedSystem *, PetscBool *ready);
PETSC_INTERN PetscErrorCode IPTermFactorApply(IPTermSystem *, const PetscReal r[], PetscReal z[]);

/* dense.c */
PETSC_INTERN PetscBool      IPTermDenseFits(const IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermDenseSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rf[], PetscReal ry[],
  PetscBool *solved);

/* solve.c */
PETSC_INTERN PetscErrorCode IPTermSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rtol, PetscReal rf[],
  PetscReal ry[], PetscBool *solved);

/* laws.c */
PETSC_INTERN PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPTermSet *,
  PetscBool *definite);
PETSC_INTERN PetscErrorCode IPTermLawsDestroy(IPTermSet *);
PETSC_INTERN PetscInt       IPTermLawsRow(const IPTermSet *, PetscInt term);
PETSC_INTERN PetscReal      IPTermLawsBound(const IPTermSet *, const IPReducedSystem *, PetscInt term);
PETSC_INTERN PetscErrorCode IPTermLawsMove(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN void           IPTermLawsRelieve(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsGiveWay(const IPTermSet *, PetscInt row);
PETSC_INTERN void           IPTermLawsResist(IPTermSet *);
PETSC_INTERN void           IPTermLawsMotion(const IPTermSet *, const IPReducedSystem *, PetscInt term, PetscReal v[2]);
PETSC_INTERN PetscReal      IPTermLawsTrial(const IPTermSet *, const IPReducedSystem *, PetscInt term, PetscReal b[2]);
PETSC_INTERN PetscInt       IPTermLawsOfRow(const IPTermSet *, PetscInt row, PetscInt *component);
PETSC_INTERN PetscErrorCode IPTermLawsResidualOfDirections(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsMerit(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscErrorCode IPTermLawsRenew(IPTermSet *, const IPReducedSystem *);

/* path.c */
PETSC_INTERN PetscErrorCode IPTermPathFollow(IPTermSet *, const IPReducedSystem *, PetscInt *steps,
  PetscBool *followed);

/* convex.c */
PETSC_INTERN PetscErrorCode IPTermConvexSolve(IPTermSet *, const IPReducedSystem *, PetscReal first, PetscInt *steps,
  PetscBool *solved);

/* set.c */
PETSC_INTERN PetscErrorCode IPTermSetSolve(IPTermSet *, const IPReducedSystem *, PetscInt *steps, PetscBool *solved);

/* friction.c */
PETSC_INTERN const IPLawsOps IPLawsFriction;

#endif
