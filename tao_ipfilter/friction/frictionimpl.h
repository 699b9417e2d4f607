/*
   tao_ipfilter/friction: the laws of norm terms (friction) on the filtered subspace. Files are in the order in which
   they depend on each other.
*/
#ifndef IPFILTER_FRICTIONIMPL_H
#define IPFILTER_FRICTIONIMPL_H

#include "tao_ipfilter/subspace/subspaceimpl.h"

/* Linear system of a Newton step for constraints and norm terms: system.c */
typedef struct {
  PetscInt      m, k;        /* rows; directions in V */
  Mat           K, FK;       /* K_WW, and its factors */
  Mat           R, RD, G;    /* R, R D and R D R^T with D = diag(K_WW)^-1 */
  Mat           Bv, Bf;      /* coefficients of v and of f in the rows' equations */
  Mat           A, F;        /* A = B_v R D R^T + B_f in scaled rows, and its incomplete factors */
  Mat           Pv, Pf;      /* the B_v and B_f for which A was factored */
  PetscReal    *compliance;  /* diag(R D R^T), the estimated compliance of each row [length/force] */
  PetscReal    *scale;       /* scale of a row: force divided by square root of energy */
  PetscReal    *V, *ZV, *H;  /* V: columns of length m; ZV: of length kmax; H: of length k */
  PetscBLASInt *pivots;      /* of H */
  Vec           S;           /* scale of the rows of A */
  PetscReal    *f, *v;       /* scratch, of rows */
  Vec           r, z, w, Kw; /* of rows and of W */
  PetscInt      fresh;       /* iterations that GMRES needed when the factors were new */
  PetscBool     stale;       /* the factors must be renewed */
  PetscBool     dense;       /* GMRES has failed: systems of all sizes are solved by dense.c */
  PetscReal    *C;           /* columns of C, of length m; NULL: none is computed */
  PetscBool    *computed;    /* which columns are computed */
} IPTermSystem;

/* State of constraints and norm terms: open or closed, stick or slip: laws.c */
typedef struct {
  PetscInt   m, n;                /* constraints and terms */
  PetscReal *limit, *coefficient; /* of the terms; a negative coefficient: the bound is the limit alone */
  PetscReal *rho, *slope;         /* rho: force per length of a term; slope: derivative of its bound by its
                                       constraint's force */
  PetscReal *theta, *direction;   /* theta = bound / |b| and direction = b / |b| of slipping terms at the last
                                       linearization */
  PetscReal *dead;                /* unit tangent along which a term cannot move, two entries a term; zero: none */
  PetscReal  length;              /* magnitude of the motions, for tolerances [length] */
  PetscBool *closed, *slips;
  PetscBool *active,
    listed;         /* active: rows that are active (may carry a force); listed: whether active is up to date */
  PetscInt     na;  /* number of active rows */
  PetscBool    met; /* the last solution satisfies the laws to the requested tolerance */
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
PETSC_INTERN PetscErrorCode IPTermDenseMeasure(IPTermSystem *, PetscBool held, PetscBool *measured);
PETSC_INTERN PetscErrorCode IPTermDenseSolve(IPTermSystem *, const IPReducedSystem *, PetscInt most, PetscReal rf[],
  PetscReal ry[], PetscBool *solved);

/* solve.c */
PETSC_INTERN PetscErrorCode IPTermSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rtol, PetscReal rf[],
  PetscReal ry[], PetscBool *solved);

/* laws.c */
PETSC_INTERN PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPTermSet *,
  PetscBool *definite);
PETSC_INTERN PetscErrorCode IPTermLawsDestroy(IPTermSet *);
PETSC_INTERN PetscInt       IPTermLawsRow(const IPTermSet *, PetscInt term);
PETSC_INTERN PetscReal      IPTermLawsBound(const IPTermSet *, const IPReducedSystem *, PetscInt term);
PETSC_INTERN void           IPTermLawsList(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscErrorCode IPTermLawsMove(IPTermSet *, const IPReducedSystem *);
PETSC_INTERN void           IPTermLawsRelieve(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscReal      IPTermLawsCompliance(const IPTermSet *, PetscInt row);
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
PETSC_INTERN PetscErrorCode IPTermSetOff(IPTermSet *, const IPReducedSystem *, PetscReal *off);
PETSC_INTERN PetscErrorCode IPTermSetIterate(IPTermSet *, const IPReducedSystem *, PetscInt limit, PetscReal first,
  PetscInt *steps, PetscBool *solved);

/* continuation.c */
PETSC_INTERN PetscErrorCode IPTermSetSolve(IPTermSet *, const IPReducedSystem *, PetscBool simply, PetscInt *steps,
  PetscBool *solved);

/* friction.c */
PETSC_INTERN const IPLawsOps IPLawsFriction;

#endif
