/*
   tao_ipfilter/subspace: the subspace method, with its directions, the reduced problem, its active set, and
   the interface to the laws of norm terms. The files are listed such that each depends only on those before it.
*/
#ifndef IPFILTER_SUBSPACEIMPL_H
#define IPFILTER_SUBSPACEIMPL_H

#include "tao_ipfilter/iteration/iterationimpl.h"
#include "tao_ipfilter/solver/method.h"

/* Directions P of the subspace, the oldest first. They are zero on the constraints' unknowns W. */
typedef struct {
  PetscInt      n, max;
  PetscInt      nlocal; /* number of unknowns of this rank */
  float       **p;      /* direction j is size[j] p[j], with nlocal entries; NULL if not created yet */
  PetscReal    *size;
  IS            W;             /* NULL before the first IPBasisUpdate() */
  PetscScalar **q;             /* the local entries W of K times direction j; NULL if not created yet */
  Vec           d, Kd;         /* work vectors: a direction, and K d */
  PetscReal    *gram, *factor; /* P^T K P, in columns of length max; the lower triangle of its Cholesky factor */
  PetscInt      generation;    /* number that increases when directions change, but not when one is appended */
  PetscBool     has_modes;     /* whether the given motions are in the span of W and P */
} IPBasis;

/* Compliance C = J_W K_WW^-1 J_W^T of the constraints plus that of their own, on the first rank */
typedef struct {
  PetscInt   m, n;
  Mat        F, J; /* factors of K_WW; J_W */
  PetscInt   ncolumns, maxcolumns;
  PetscInt  *column; /* for each row the number of its column in C; negative: not computed yet */
  PetscReal *C;      /* computed columns of C */
  PetscReal *X;      /* the same columns of K_WW^-1 J_W^T */
  PetscReal *own;    /* compliance of each row itself, which the caller sets; zeros if rows are rigid */
  PetscInt   most;   /* number of columns up to which X is kept; 0: it is not kept */
} IPCompliance;

/*
   companions.c: the unknowns of W that have a companion, by their position in W, and the stiffness of their springs.
   Only n is set on ranks other than the first.
*/
typedef struct {
  PetscInt   n, *row;
  PetscReal *spring;
} IPCompanions;

static inline PetscReal *IPComplianceColumn(const IPCompliance *c, PetscInt row)
{
  return c->C + (size_t)c->column[row] * (size_t)c->m;
}

/* The contact problem after elimination of w, as in active_set.c. Its rows are the constraints. */
typedef struct {
  PetscInt   m, k, kmax;     /* number of rows; number of coordinates y; largest number of coordinates */
  PetscReal *JZ, *T, *h, *t; /* JZ, with columns of length m; T, with columns of length kmax; right-hand sides h
                                  and t */
  PetscReal *G;              /* diagonal of P^T K P */
  PetscInt   ncompanions, *companion; /* number of companions; the unknown of W to which each belongs */
  PetscReal *lambda, *gap, *y;        /* forces of the rows; their motions; coordinates */
  PetscReal  length;                  /* size of the terms of a gap, for tolerances */
  PetscReal  rounding;                /* size of the rounding errors of a gap */
  PetscBool  soft;                    /* some motions have almost no stiffness without constraints */
} IPReducedSystem;

/* The active constraints, and the factors for them */
typedef struct {
  PetscInt   m, n, k;   /* number of constraints; number of active constraints with nonzero compliance; number of
                           directions in V */
  PetscInt   nfactored; /* number of directions in H */
  PetscBool *active, factored;
  PetscInt  *rows;
  PetscReal *L, *V, *H, *r;
  PetscReal  least; /* smallest permitted `shift` */
  PetscReal  shift; /* addition to the diagonal of H, relative to the directions' energies */
} IPActiveSet;

/*
   The reduced problem; n and m are zero on ranks other than the first. Later solves reuse the space (K_WW and Z), but
   not the constraints.
*/
typedef struct {
  PetscBool        first;
  PetscObjectId    K_id; /* K for which the space was set up */
  PetscObjectState K_state;
  IS               W, own;     /* W, and the rows of K that belong to it */
  Mat              KWW;        /* K_WW, including the companions' springs */
  PetscInt         generation; /* generation of the basis when Z was computed */
  PetscInt         n, m;       /* sizes: of W, number of constraints */
  VecScatter       to_W, to_rows;
  Vec              on_W, on_rows;
  Vec              scale; /* scales of the rows, set after a solve; NULL: all are 1 */
  IPCompliance     compliance;
  IPCompanions     companions; /* the displacements of the companions are the first coordinates of y */
  IPReducedSystem  system;
  IPActiveSet      set;
  PetscReal       *Z, *g, *x, *z; /* K_WW^-1 Q_W; gradient at the centre; K_WW^-1 g; work */
  PetscInt         nsteps, nactive;
} IPReduced;

/* Data of the subspace method that later solves reuse */
typedef struct {
  PC               pc;       /* the Krylov method's preconditioner, set up for K alone */
  PetscBool        held;     /* whether the preconditioner was set up for K + J^T D J instead, for bodies that
                                     are held by constraints only */
  PetscBool        negative; /* K was negative along a direction, so that `held` ends when K changes */
  PetscBool        whole;    /* W has all unknowns, since directions were slow */
  PetscObjectId    K_id;
  PetscObjectState K_state;
  IPBasis          basis;
  IPReduced        reduced;
} IPRecycle;

/*
   Interface of a solver for problems with norm terms (friction) or with many constraints, which works in the same
   space. register.c stores the implementation. Its functions are collective.
*/
typedef struct _p_IPLaws *IPLaws;
typedef struct _n_IPLawsOps {
  PetscErrorCode (*create)(Tao, IPRecycle *, IS W, IPLaws *); /* for the present Hessian, constraints and terms */
  PetscErrorCode (*begin)(IPLaws, Vec gradient, Vec c, Vec values, Vec force,
    Vec terms); /* moves to a point with these values of constraints and terms, and these forces */
  PetscErrorCode (*step)(IPLaws, PetscReal enough, Vec x, Vec force, Vec terms, PetscReal *violation, PetscInt *nclosed,
    PetscBool *done); /* takes a step. enough: residual [2-norm] that may be left; x: the point,
                                            relative to the begin; violation: relative violation of the laws */
  PetscErrorCode (*destroy)(IPLaws *);
} IPLawsOps;

/* State of the subspace method during a solve */
typedef struct {
  PetscBool        newton;  /* whether Newton's method is used, since the objective is not quadratic */
  PetscContainer   recycle; /* contains an IPRecycle */
  IS               W;       /* unknowns that the reduced problem has: those of the constraints, and their neighbours */
  IPReduced       *reduced; /* the reduced problem in `recycle`; NULL: not set up */
  PetscBool        by_laws; /* whether a solver for contacts with laws is used in place of the reduced problem */
  const IPLawsOps *lawsops;
  IPLaws           laws;                           /* NULL: not set up */
  PetscInt         nclosed;                        /* by laws: number of closed contacts */
  Vec start_t, start_c, start_values, start_force; /* by laws: offsets of the norm terms, values of constraints and
                                                      terms, and forces of the constraints when the solve began */
  Vec centre, gradient, c;       /* the point to which the reduced problem is relative; grad f and c_I there */
  PetscReal  f;                  /* f at that point */
  PetscReal *pg, *y;             /* P^T grad f at that point; coefficients of the directions */
  PetscBool  renewed;            /* whether all directions were removed in this solve */
  PetscBool  ready;              /* false if the Hessian was indefinite at the first point */
  PetscInt   ncentred;           /* number of consecutive steps without a new direction */
  PetscInt   nfutile;            /* number of steps since the KKT error was last halved */
  PetscReal  halved;             /* KKT error when it was last halved */
  PetscReal  residual, promised; /* Newton's method: residual before the last step, 0: none; and of its model */
} IPSubspace;

#define IPSubspaceOf(tao) ((IPSubspace *)((TAO_IPFILTER *)(tao)->data)->method->data)

/* single_precision.c */
PETSC_INTERN void IPSingleRound(PetscInt n, const PetscScalar *v, PetscReal size, float *p);
PETSC_INTERN void IPSingleDots(PetscInt n, PetscInt k, float *const p[], const PetscScalar *v, PetscReal s[]);
PETSC_INTERN void IPSingleCombine(PetscInt n, PetscInt k, const PetscReal a[], float *const p[], PetscScalar *v);

/* products.c */
PETSC_INTERN PetscErrorCode IPProductsMultiply(Mat K, const PetscReal *X, Vec x, Vec y, PetscReal *Y);
PETSC_INTERN void IPProductsSpread(PetscInt n, PetscInt k, float *const p[], const PetscReal size[], PetscReal *X);
PETSC_INTERN void IPProductsDots(PetscInt n, PetscInt k, float *const p[], const PetscReal *Y, PetscReal s[]);

/* basis.c */
PETSC_INTERN PetscErrorCode IPBasisCreate(PetscInt max, Vec like, IPBasis *);
PETSC_INTERN PetscErrorCode IPBasisDestroy(IPBasis *);
PETSC_INTERN PetscErrorCode IPBasisAppend(IPBasis *, Mat K, Vec, PetscBool *appended);
PETSC_INTERN PetscErrorCode IPBasisCompress(IPBasis *, PetscInt best, PetscInt last, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPBasisDropOldest(IPBasis *, PetscInt n);
PETSC_INTERN PetscErrorCode IPBasisMultiply(IPBasis *, Mat K);
PETSC_INTERN PetscErrorCode IPBasisUpdate(IPBasis *, Mat K, PetscBool new_K, IS fixed, IS W);
PETSC_INTERN PetscErrorCode IPBasisDots(const IPBasis *, PetscInt first, PetscInt k, Vec, PetscReal[]);
PETSC_INTERN PetscErrorCode IPBasisAdd(const IPBasis *, const PetscReal[], Vec);
PETSC_INTERN PetscErrorCode IPBasisGetForces(const IPBasis *, PetscInt j, Vec);

/* compliance.c */
PETSC_INTERN PetscErrorCode IPComplianceSetUp(IPCompliance *, Mat K, PetscBool *definite);
PETSC_INTERN PetscErrorCode IPComplianceIsNegative(Mat K, PetscBool *negative);
PETSC_INTERN PetscErrorCode IPComplianceSetRows(IPCompliance *, Mat J, PetscInt most);
PETSC_INTERN PetscErrorCode IPComplianceDestroy(IPCompliance *);
PETSC_INTERN PetscErrorCode IPComplianceSolve(IPCompliance *, PetscInt k, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceMultiply(IPCompliance *, PetscInt k, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceSpread(IPCompliance *, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceColumns(IPCompliance *, PetscInt n, const PetscInt rows[]);
PETSC_INTERN PetscErrorCode IPComplianceExpand(const IPCompliance *, const PetscReal lambda[], PetscReal x[],
  PetscBool *known);

/* companions.c */
PETSC_INTERN PetscErrorCode IPCompanionsAreNeeded(Mat K, IPCompliance *, PetscBool *needed);
PETSC_INTERN PetscErrorCode IPCompanionsTake(Mat K, IPCompanions *);
PETSC_INTERN PetscErrorCode IPCompanionsDestroy(IPCompanions *);

/* modes.c */
PETSC_INTERN PetscErrorCode IPModesGetNumber(Tao, PetscInt *);
PETSC_INTERN PetscErrorCode IPModesAppend(Tao, IPRecycle *);

/* active_set.c */
PETSC_INTERN PetscErrorCode IPActiveSetCreate(PetscInt m, IPActiveSet *);
PETSC_INTERN PetscErrorCode IPActiveSetDestroy(IPActiveSet *);
PETSC_INTERN PetscErrorCode IPActiveSetSolveRows(IPActiveSet *, IPCompliance *, const IPReducedSystem *,
  PetscBool *solved);
PETSC_INTERN PetscErrorCode IPActiveSetSolve(IPActiveSet *, IPCompliance *, const IPReducedSystem *, PetscInt *steps,
  PetscBool *solved);

/* gather_first.c */
PETSC_INTERN PetscErrorCode IPGatherStiffness(Mat K, IS own, PetscBool gather, Mat *);
PETSC_INTERN PetscErrorCode IPGatherRows(Mat J, PetscInt nw, const PetscInt w[], PetscBool first, Mat *);
PETSC_INTERN PetscErrorCode IPReducedBroadcast(const IPReduced *, PetscErrorCode, PetscBool *verdict);
PETSC_INTERN PetscErrorCode IPReducedAgree(const IPReduced *, PetscErrorCode);
PETSC_INTERN PetscErrorCode IPReducedFetch(VecScatter, Vec, Vec on_first, PetscInt n, PetscReal a[]);
PETSC_INTERN PetscErrorCode IPReducedSpread(VecScatter, PetscInt n, const PetscReal a[], Vec on_first, Vec);

/* reduced.c */

PETSC_INTERN PetscErrorCode IPReducedSetUp(IPReduced *, Mat K, Mat J, Vec compliance, IS own, IS W, Vec x, Vec c,
  const IPBasis *, PetscBool *definite);
PETSC_INTERN PetscErrorCode IPReducedRelease(IPReduced *);
PETSC_INTERN PetscErrorCode IPReducedScale(IPReduced *, Vec scale);
PETSC_INTERN PetscErrorCode IPReducedDestroy(IPReduced *);
PETSC_INTERN PetscErrorCode IPReducedGuess(IPReduced *, Vec guess);
PETSC_INTERN PetscErrorCode IPReducedCenter(IPReduced *, Vec gradient, Vec c, const PetscReal pg[]);
PETSC_INTERN PetscErrorCode IPReducedAppend(IPReduced *, const IPBasis *, const PetscReal pg[]);
PETSC_INTERN PetscErrorCode IPReducedForget(IPReduced *, const IPBasis *);
PETSC_INTERN PetscErrorCode IPReducedCoupling(const IPReduced *, const IPBasis *, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPReducedSolve(IPReduced *, PetscReal y[], Vec v, Vec force, PetscBool *solved);
PETSC_INTERN PetscErrorCode IPReducedSolveActive(IPReduced *, const IPBasis *, Vec f, Vec c, Vec v, Vec force,
  PetscBool *solved);

/* recycle.c */
PETSC_INTERN PetscErrorCode IPRecycleGet(Tao, IPRecycle **);
PETSC_INTERN PetscErrorCode IPRecycleReset(IPRecycle *);
PETSC_INTERN PetscErrorCode IPRecycleStiffnessOfTerms(Tao, Vec Dt);
PETSC_INTERN PetscErrorCode IPRecycleCondense(Tao, Vec D, Vec Dt, Mat *A);
PETSC_INTERN PetscErrorCode IPRecycleHold(Tao, IPRecycle *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPRecycleReconsider(Tao, IPRecycle *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPRecycleIsOf(const IPRecycle *, Mat K, PetscBool *same);
PETSC_INTERN PetscErrorCode IPRecycleUpdate(Tao, IPRecycle *, PetscBool *possible);

/* precondition.c */
PETSC_INTERN PetscErrorCode IPSubspacePrecondition(Tao, IPRecycle *, Vec r, Vec d, PetscBool *definite);

/* subspace.c */
PETSC_INTERN PetscErrorCode IPSubspaceSetUp(Tao, IPRecycle *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPSubspaceDestroy(IPSubspace *);
PETSC_INTERN PetscErrorCode IPSubspaceCentre(Tao, const IPBasis *, Vec centre, Vec gradient, Vec c);
PETSC_INTERN PetscErrorCode IPSubspaceBeginLaws(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceStepLaws(Tao, PetscReal enough, Vec x, Vec force, PetscReal *violation,
  PetscBool *done);
PETSC_INTERN PetscErrorCode IPSubspaceSolve(Tao, const IPBasis *, Vec v, Vec force, PetscBool *solved);
PETSC_INTERN PetscErrorCode IPSubspaceSetPairs(Tao, Vec force);
PETSC_INTERN PetscErrorCode IPSubspaceCompress(Tao, IPBasis *, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPSubspaceMakeRoom(Tao, IPBasis *);
PETSC_INTERN PetscBool      IPSubspaceProgresses(IPSubspace *, PetscReal error, PetscInt patience);
PETSC_INTERN PetscErrorCode IPSubspaceInterrupted(Tao, PetscBool *stop);
PETSC_INTERN PetscErrorCode IPSubspaceAllows(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPSubspaceTakeAll(Tao);
PETSC_INTERN PetscErrorCode IPSubspaceExtend(Tao, IPRecycle *, Vec r, PetscBool *extended);

/* monitor.c */
PETSC_INTERN PetscErrorCode IPSubspaceMonitor(Tao, PetscBool *monitored);

/* newton.c */
PETSC_INTERN PetscErrorCode IPNewtonSubspaceStep(Tao, PetscBool *done);

/* api.c, beside the public functions */
PETSC_INTERN PetscErrorCode IPSubspaceCompose(Tao, PetscBool attach);

/* method.c: min f(x), c_I(x) >= 0 on the subspace */
PETSC_INTERN const IPMethodOps IPMethodSubspace;

#endif
