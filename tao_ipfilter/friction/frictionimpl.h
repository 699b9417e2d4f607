/*
   tao_ipfilter/friction: the laws of norm terms (friction) in the filtered subspace. The files are listed such that
   each depends only on those before it.
*/
#ifndef IPFILTER_FRICTIONIMPL_H
#define IPFILTER_FRICTIONIMPL_H

#include "tao_ipfilter/subspace/subspaceimpl.h"

/* Data of the preconditioner in cholesky.c. A block consists of the rows of one constraint and of its norm term. */
typedef struct {
  Mat           A, F;        /* K_WW with the softened laws; its Cholesky factors */
  PetscReal    *inverse, *D; /* M^-1 and D of each block: 3 rows of 3 entries */
  PetscBool    *coupled;     /* blocks that A has entries for */
  PetscReal     follow;      /* 1 / (1 + hold) */
  PetscReal    *force;       /* forces for unit coordinates y_d, in columns of length m */
  PetscReal    *companion;   /* the companions' coordinates for unit coordinates y_d */
  PetscReal    *H;           /* factors of the Schur complement of y_d */
  PetscBLASInt *pivots;
} IPTermCholesky;

/*
   The linear system of a Newton step for constraints and norm terms, see system.c. Its rows are those of R: the
   constraints, followed by two rows per term.
*/
typedef struct {
  PetscInt         m, k;                 /* number of rows; number of directions in V */
  PetscInt         nconstraints, nterms; /* numbers of constraints and terms */
  Mat              K, FK;                /* K_WW; its factors */
  Mat              R, RD, G;             /* R; R D and R D R^T with D = diag(K_WW)^-1; NULL before
                                            they are needed */
  Mat              Bv, Bf;               /* coefficients of the motions v and of the forces f in the rows' equations */
  Mat              A, F;                 /* A = B_v R D R^T + B_f in scaled rows; its incomplete factors */
  Mat              Pv, Pf;               /* values of B_v and B_f for which A was factored */
  const PetscReal *spring;      /* per row: stiffness of the spring that K_WW contains for it; NULL: no springs */
  PetscReal       *compliance;  /* estimated compliance of each row, diag(R D R^T) [length/force] */
  PetscReal       *scale;       /* scale of each row: force divided by square root of energy */
  PetscReal       *V, *ZV, *H;  /* V, with columns of length m; ZV, with columns of length kmax; factors of H, with
                                columns of length k */
  PetscBLASInt    *pivots;      /* pivots of the factors of H */
  Vec              S;           /* scale of each row of A */
  PetscReal       *f, *v;       /* work arrays with an entry per row */
  Vec              r, z, w, Kw; /* work vectors: r, z with an entry per row; w, Kw with an entry per unknown of W */
  PetscInt         fresh;       /* number of GMRES iterations when the factors were new */
  PetscBool        stale;       /* the factors must be computed again */
  PetscBool        dense;       /* GMRES has failed, so that factors solve systems of all sizes */
  PetscBool        quick;       /* if GMRES fails, another method follows instead of sparse factors */
  PetscBool        symmetric;   /* B_v and B_f are those of the convex problem, whose systems are almost symmetric */
  PetscReal        hold;        /* stiffness added to the diagonal of T, relative to G; see convex.c */
  PetscReal       *C;           /* columns of C, of length m; NULL: none is computed */
  PetscBool       *computed;    /* which columns of C are computed */
  IPTermCholesky   cholesky;
} IPTermSystem;

/* State of constraints and norm terms, see laws.c: constraints are open or closed, terms stick or slip */
typedef struct {
  PetscInt     m, n;                /* number of constraints; number of terms */
  PetscReal   *limit, *coefficient; /* per term: limit and coefficient of its bound; a negative coefficient: the bound
                                     is the limit */
  PetscReal   *rho, *slope;         /* per term: rho [force/length]; derivative of the bound by the force of its
                                     constraint */
  PetscReal   *theta, *direction;   /* at the last linearization, for slipping terms with b = tau - rho v: theta =
                                     bound / |b|; direction = b / |b| */
  PetscReal   *rigid;  /* two entries per term: unit tangent along which the term cannot move; zero: none */
  PetscReal    length; /* size of the motions, for tolerances [length] */
  PetscBool   *closed, *slips;
  PetscBool   *active, listed; /* active: rows that may carry a force; listed: whether `active` is up to date */
  PetscInt     na;             /* number of active rows */
  PetscReal   *shift;          /* two entries per term: shift of its reference, see stick.c [length] */
  PetscInt     nreleased;      /* number of terms released or shifted so far, see stick.c */
  PetscBool    convex_next;    /* Newton's method ends if the residual becomes large; the convex problem follows */
  PetscBool    convex;         /* the convex problem was solved after Newton's method had failed */
  PetscBool    slides;         /* only the springs of the convex problem hold a body */
  PetscBool    met;            /* whether the last solution satisfies the laws to the requested tolerance */
  PetscReal   *F, *Fy;
  IPTermSystem system;
} IPTermSet;

/* The tableau of tableau.c */
typedef struct {
  PetscInt               m, n, rows;     /* number of constraints; number of terms; number of rows, m + 2 n */
  PetscReal             *A, *q;          /* basic variables = A (nonbasic variables) + q; A has rows + 1 columns */
  PetscInt              *basic, *others; /* the basic variable of each row; the nonbasic variable of each column */
  PetscInt              *place;          /* of each variable: its row, or -1 - its column */
  PetscReal             *scale; /* per row: the force is scale times the variable, the motion the variable over scale */
  PetscReal             *axis;  /* two entries per term: the first axis of its frame */
  PetscReal             *mu, *limit;      /* per term: b = mu lambda + limit */
  PetscReal             *sign;            /* two entries per term: s */
  PetscBool             *sticks;          /* two entries per term: whether the component sticks */
  PetscBool             *closed;          /* whether each constraint is closed */
  PetscBool             *dropped;         /* whether a row never carries a force */
  PetscReal              length;          /* size of the motions, for tolerances [length] */
  PetscInt               driving;         /* the nonbasic variable that moves; -1: none does */
  PetscReal              direction, last; /* its direction, 1 or -1; its value at the end of the path */
  PetscInt64             seed;            /* of the numbers that separate rows */
  const IPReducedSystem *s;               /* the reduced problem */
} IPTableau;

/* The state of a contact on the path of stick_path.c */
typedef enum {
  IP_STICK_OPEN,
  IP_STICK_HELD,   /* sticks */
  IP_STICK_SLIDES, /* its force along the face vanishes */
  IP_STICK_FREE    /* never sticks */
} IPStickState;

/* The path of stick_path.c */
typedef struct {
  const IPTermSet *set;
  IPTableau       *p;
  PetscReal       *x, *rate;   /* per variable: its value, and its rate */
  IPStickState    *contact;    /* state of each contact */
  PetscInt        *slides;     /* number of times that each contact has slid or opened */
  PetscBool       *moved;      /* whether a contact has slid or opened, so that it sticks where it is when it closes */
  PetscInt         nexchanges; /* number of exchanges since the tableau was set up */
  PetscReal        size[2];    /* size of forces and of motions, for tolerances [square root of energy] */
} IPStickPath;

static inline PetscReal *IPTableauColumn(const IPTableau *p, PetscInt column)
{
  return p->A + (size_t)column * (size_t)p->rows;
}

/* Returns the term of a row, -1 for a constraint, and its component a */
static inline PetscInt IPTableauTerm(const IPTableau *p, PetscInt row, PetscInt *a)
{
  *a = row < p->m ? 0 : (row - p->m) % 2;
  return row < p->m ? -1 : (row - p->m) / 2;
}

/* system.c */
PETSC_INTERN PetscErrorCode IPTermSystemSetUp(IPTermSystem *, PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat factors,
  Mat R, PetscBool *definite);
PETSC_INTERN PetscErrorCode IPTermSystemDestroy(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemMakeRows(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemSetRow(IPTermSystem *, PetscInt row, PetscInt n, const PetscInt columns[],
  const PetscReal by_v[], const PetscReal by_f[], PetscReal scale);
PETSC_INTERN PetscErrorCode IPTermSystemAssemble(IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermSystemApplyCompliance(IPTermSystem *, const PetscReal f[], PetscReal v[]);
PETSC_INTERN PetscErrorCode IPTermSystemFindCoupled(const IPTermSystem *, const PetscReal rf[], PetscInt *n,
  PetscInt rows[], PetscReal x[]);
PETSC_INTERN PetscErrorCode IPTermSystemMultiplyMotions(IPTermSystem *, PetscReal a[]);
PETSC_INTERN PetscErrorCode IPTermSystemSubtract(IPTermSystem *, const IPReducedSystem *, const PetscReal x[],
  PetscReal rf[], PetscReal ry[]);

/* factor.c */
PETSC_INTERN PetscErrorCode IPTermFactorPrepare(IPTermSystem *, const IPReducedSystem *, PetscBool *ready);
PETSC_INTERN PetscErrorCode IPTermFactorApply(IPTermSystem *, const PetscReal r[], PetscReal z[]);

/* cholesky.c */
PETSC_INTERN PetscErrorCode IPTermCholeskyDestroy(IPTermCholesky *);
PETSC_INTERN PetscErrorCode IPTermCholeskyPrepare(IPTermSystem *, const IPReducedSystem *, PetscBool *ready);
PETSC_INTERN PetscErrorCode IPTermCholeskyApply(IPTermSystem *, const IPReducedSystem *, PetscReal f[], PetscReal y[]);

/* dense.c */
PETSC_INTERN PetscBool      IPTermDenseFits(const IPTermSystem *);
PETSC_INTERN PetscBool      IPTermDenseIsComplete(const IPTermSystem *);
PETSC_INTERN PetscErrorCode IPTermDenseMeasure(IPTermSystem *, PetscBool held, PetscBool *measured);
PETSC_INTERN PetscErrorCode IPTermDenseSolve(IPTermSystem *, const IPReducedSystem *, PetscInt most, PetscReal rf[],
  PetscReal ry[], PetscBool *solved);

/* sparse.c */
PETSC_INTERN PetscErrorCode IPTermSparseSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rf[], PetscReal ry[],
  PetscBool *solved);

/* solve.c */
PETSC_INTERN PetscErrorCode IPTermSolve(IPTermSystem *, const IPReducedSystem *, PetscReal rtol, PetscReal rf[],
  PetscReal ry[], PetscBool *solved);

/* laws.c */
PETSC_INTERN PetscErrorCode IPTermLawsCreate(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat factors, Mat R,
  IPTermSet *, PetscBool *definite);
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
PETSC_INTERN PetscReal      IPTermLawsRounding(const IPTermSet *, const IPReducedSystem *);
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

/* tableau.c */
PETSC_INTERN PetscErrorCode IPTableauCreate(const IPTermSet *, IPTableau *);
PETSC_INTERN PetscErrorCode IPTableauDestroy(IPTableau *);
PETSC_INTERN PetscErrorCode IPTableauSubtract(IPTableau *, const PetscReal c[], const PetscReal along[]);
PETSC_INTERN PetscErrorCode IPTableauExchange(IPTableau *, PetscInt row, PetscInt column);
PETSC_INTERN void           IPTableauChoose(const IPTermSet *, const IPReducedSystem *, IPTableau *);
PETSC_INTERN PetscErrorCode IPTableauSetUp(const IPTermSet *, const IPReducedSystem *, IPTableau *, PetscBool *made);
PETSC_INTERN void           IPTableauRotate(const IPTableau *, PetscReal f[], size_t stride, PetscBool back);
PETSC_INTERN PetscErrorCode IPTableauEnter(IPTableau *);
PETSC_INTERN PetscErrorCode IPTableauTake(IPTermSet *, const IPReducedSystem *, const IPTableau *);

/* stick_path.c */
PETSC_INTERN PetscErrorCode IPStickPathCreate(const IPTermSet *, IPTableau *, IPStickPath *);
PETSC_INTERN PetscErrorCode IPStickPathDestroy(IPStickPath *);
PETSC_INTERN void           IPStickPathLoad(const IPStickPath *);
PETSC_INTERN PetscErrorCode IPStickPathFollow(IPStickPath *, PetscInt *events, PetscBool *reached);

/* stick.c */
PETSC_INTERN PetscBool      IPTermStickApplies(const IPTermSet *, const IPReducedSystem *);
PETSC_INTERN PetscErrorCode IPTermStickSolve(IPTermSet *, const IPReducedSystem *, const PetscReal force[],
  const PetscReal motion[], PetscInt *steps, PetscBool *found);

/* pivot.c */
PETSC_INTERN PetscErrorCode IPTermPivotFollow(IPTermSet *, const IPReducedSystem *, PetscBool open, PetscInt *steps,
  PetscBool *found);

/* continuation.c */
PETSC_INTERN PetscErrorCode IPTermSetSolve(IPTermSet *, const IPReducedSystem *, PetscBool simply, PetscInt *steps,
  PetscBool *solved);

/* friction.c */
PETSC_INTERN const IPLawsOps IPLawsFriction;

#endif
