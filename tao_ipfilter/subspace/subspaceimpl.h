/*
   tao_ipfilter/subspace: the filtered subspace method: directions, the reduced problem, its active set, and the
   interface to the laws of norm terms. Files are in the order in which they depend on each other.
*/
#ifndef IPFILTER_SUBSPACEIMPL_H
#define IPFILTER_SUBSPACEIMPL_H

#include "tao_ipfilter/step/stepimpl.h"
#include "tao_ipfilter/solver/method.h"

/* Directions P of the filtered subspace, oldest first; zero on the constraints' unknowns W */
typedef struct {
  PetscInt   n, max;
  Vec       *p, *q;         /* p_j, and K p_j; NULL where not yet needed */
  PetscReal *gram, *factor; /* P^T K P, columns of length max, and its Cholesky factor, the lower triangle */
  PetscInt   generation;    /* increases when directions change; not when one is appended */
} IPBasis;

/* C = J_W K_WW^-1 J_W^T, on the first rank */
typedef struct {
  PetscInt   m, n;
  Mat        F, J; /* K_WW factored; J_W */
  PetscInt   ncolumns, maxcolumns;
  PetscInt  *column; /* column of C that belongs to a row; negative: not computed yet */
  PetscReal *C;      /* the columns */
} IPCompliance;

/* companions.c: unknowns of W that have a companion, by position in W, and the stiffness of their springs. On the
   first rank; n on all ranks */
typedef struct {
  PetscInt   n, *row;
  PetscReal *spring;
} IPCompanions;

static inline PetscReal *IPComplianceColumn(const IPCompliance *c, PetscInt row)
{
  return c->C + (size_t)c->column[row] * (size_t)c->m;
}

/* The contact problem with w eliminated, as in active_set.c and laws.c: constraints, then two rows per norm term */
typedef struct {
  PetscInt   m, k, kmax;       /* number of rows; number of coordinates y (companions and directions), and its
                                  maximum */
  PetscReal *JZ, *T, *h, *t;   /* JZ: columns of length m; T: of length kmax */
  PetscReal *G;                /* the diagonal of P^T K P */
  PetscReal *lambda, *gap, *y; /* forces and motions of the rows */
  PetscReal *base;             /* forces that h and t already contain: without them bodies that only constraints hold
                                  would move far; zero without norm terms */
  PetscReal  length;           /* magnitude of the terms of a gap, for tolerances */
} IPReducedSystem;

/* The constraints that are active, and the factors that belong to them */
typedef struct {
  PetscInt   m, n, k; /* number of constraints; number of active ones with a compliance that is not zero; number of
                         directions in V */
  PetscBool *active, factored;
  PetscInt  *rows;
  PetscReal *L, *V, *H, *r;
} IPActiveSet;

/* Data for the laws of constraints and norm terms, on the first rank */
typedef struct {
  PetscReal *limit, *coefficient; /* of the terms; a negative coefficient: the bound is the limit alone */
  PetscReal *dead;                /* unit directions along which terms cannot move, two entries a term; zero: none */
  PetscBool *closed;              /* constraints that are closed initially */
} IPLawsData;

/* Interface to solve the problem on the subspace with norm terms: m constraints and n terms with the rows R.
   register.c names the implementation. */
typedef struct _p_IPLaws *IPLaws;
typedef struct _n_IPLawsOps {
  PetscErrorCode (*create)(PetscInt m, PetscInt n, PetscInt kmax, Mat K, Mat R, IPLaws *, PetscBool *definite);
  PetscErrorCode (*getdata)(IPLaws, IPLawsData *);
  PetscErrorCode (*restart)(IPLaws); /* called when the set of closed rows was chosen again */
  PetscErrorCode (*forget)(IPLaws);  /* called when directions were replaced */
  PetscErrorCode (*solve)(IPLaws, const IPReducedSystem *, PetscBool simply, PetscInt *steps, PetscInt *nactive,
    PetscBool *met, PetscBool *solved);
  PetscErrorCode (*destroy)(IPLaws *);
} IPLawsOps;

/* The contact problem on the subspace; n and m are zero on all but the first rank. The space (K_WW and Z) is kept
   between solves, the constraints are not */
typedef struct {
  PetscBool        first;
  PetscObjectId    K_id; /* K and W that the space belongs to */
  PetscObjectState K_state;
  IS               W;
  Mat              KWW;          /* with the companions' springs */
  PetscInt         generation;   /* that of the basis when Z was computed */
  PetscInt         n, m, nterms; /* sizes of W, constraints, norm terms */
  VecScatter       to_W, to_rows, to_terms;
  Vec              on_W, on_rows, on_terms;
  Vec              scale;   /* of the rows, after a solve; NULL: 1 */
  const IPLawsOps *lawsops; /* NULL: no implementation is registered */
  IPLaws           laws;    /* NULL without norm terms, and on all but the first rank */
  IPCompliance     compliance;
  IPCompanions     companions; /* their displacements are the first coordinates of y */
  IPReducedSystem  system;
  IPActiveSet      set;
  PetscReal       *Z, *g, *x, *z; /* K_WW^-1 Q_W; gradient and K_WW^-1 g at the centre; work */
  PetscInt         nsteps, nactive;
  PetscBool        simply; /* with norm terms: give up if Newton's method fails, because W can be extended */
  PetscBool        met;    /* the last solution satisfies the laws to the requested tolerance */
} IPReduced;

/* Data that the filtered subspace method keeps between solves */
typedef struct {
  PC               pc;            /* the Krylov method's preconditioner, set up with K alone */
  PetscBool        held;          /* whether it was set up with K + J^T D J instead, for bodies that only constraints
                                     hold */
  PetscBool        negative;      /* held only while K stays: K was negative along a direction */
  PetscBool        changing;      /* K has changed since it was first seen */
  PetscBool        whole;         /* W is all unknowns, as norm terms need it */
  PetscInt         napplications; /* applications of the preconditioner in the last solve */
  PetscObjectId    K_id;
  PetscObjectState K_state;
  IPBasis          basis;
  IPReduced        reduced;
} IPSubspaceState;

/* State of the filtered subspace method within a solve */
typedef struct {
  PetscBool      newton;  /* by Newton's method, as the objective is not quadratic */
  PetscContainer kept;    /* an IPSubspaceState */
  IS             W;       /* the unknowns whose unit vectors are all in V: those of the constraints, and their
                             neighbours */
  IPReduced     *reduced; /* that of kept; NULL: not set up */
  Vec            centre, gradient, c; /* the point that the reduced problem counts from; grad f, c_I */
  PetscReal      f;                   /* and f there */
  PetscReal     *pg, *y;              /* P^T grad f there; coefficients of the directions */
  PetscInt       ncentred;            /* steps in a row without a new direction */
  PetscInt       nfutile;             /* steps since the KKT error was last halved */
  PetscReal      halved;              /* KKT error when it was last halved */
  PetscReal      begin;               /* KKT error after the first reduced problem */
} IPFiltered;

#define IPFilteredOf(tao) ((IPFiltered *)((TAO_IPFILTER *)(tao)->data)->method->data)

/* basis.c */
PETSC_INTERN PetscErrorCode IPBasisCreate(PetscInt max, IPBasis *);
PETSC_INTERN PetscErrorCode IPBasisDestroy(IPBasis *);
PETSC_INTERN PetscErrorCode IPBasisAppend(IPBasis *, Mat K, Vec, PetscBool *appended);
PETSC_INTERN PetscErrorCode IPBasisCompress(IPBasis *, PetscInt best, PetscInt last, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPBasisMultiply(IPBasis *, Mat K);
PETSC_INTERN PetscErrorCode IPBasisRestrict(IPBasis *, Mat K, IS W);

/* compliance.c */
PETSC_INTERN PetscErrorCode IPComplianceSetUp(IPCompliance *, Mat K, PetscBool *definite);
PETSC_INTERN PetscErrorCode IPComplianceSetRows(IPCompliance *, Mat J);
PETSC_INTERN PetscErrorCode IPComplianceDestroy(IPCompliance *);
PETSC_INTERN PetscErrorCode IPComplianceSolve(IPCompliance *, PetscInt k, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceMultiply(IPCompliance *, PetscInt k, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceSpread(IPCompliance *, const PetscReal[], PetscReal[]);
PETSC_INTERN PetscErrorCode IPComplianceColumns(IPCompliance *, PetscInt n, const PetscInt rows[]);

/* companions.c */
PETSC_INTERN PetscErrorCode IPCompanionsAreNeeded(Mat K, IPCompliance *, PetscBool *needed);
PETSC_INTERN PetscErrorCode IPCompanionsTake(Mat K, IPCompanions *);
PETSC_INTERN PetscErrorCode IPCompanionsDestroy(IPCompanions *);

/* active_set.c */
PETSC_INTERN PetscErrorCode IPActiveSetCreate(PetscInt m, IPActiveSet *);
PETSC_INTERN PetscErrorCode IPActiveSetDestroy(IPActiveSet *);
PETSC_INTERN PetscErrorCode IPActiveSetSolveRows(IPActiveSet *, IPCompliance *, const IPReducedSystem *,
  PetscBool *solved);
PETSC_INTERN PetscErrorCode IPActiveSetSolve(IPActiveSet *, IPCompliance *, const IPReducedSystem *, PetscInt *steps,
  PetscBool *solved);

/* reduced.c */
PETSC_INTERN PetscErrorCode IPReducedIsOf(const IPReduced *, Mat K, PetscBool *same);
PETSC_INTERN PetscErrorCode IPReducedSetUp(IPReduced *, const IPLawsOps *, Mat K, Mat J, const IPTerms *, IS W, Vec x,
  Vec c, const IPBasis *, PetscBool *definite);
PETSC_INTERN PetscErrorCode IPReducedRelease(IPReduced *);
PETSC_INTERN PetscErrorCode IPReducedScale(IPReduced *, Vec scale);
PETSC_INTERN PetscErrorCode IPReducedDestroy(IPReduced *);
PETSC_INTERN PetscErrorCode IPReducedSetTerms(IPReduced *, const IPTerms *, Vec scale);
PETSC_INTERN PetscErrorCode IPReducedGuess(IPReduced *, Vec guess, Vec force, const IPTerms *);
PETSC_INTERN PetscErrorCode IPReducedCenter(IPReduced *, Vec gradient, Vec c, Vec value, const PetscReal pg[]);
PETSC_INTERN PetscErrorCode IPReducedAppend(IPReduced *, const IPBasis *, const PetscReal pg[]);
PETSC_INTERN PetscErrorCode IPReducedForget(IPReduced *, const IPBasis *);
PETSC_INTERN PetscErrorCode IPReducedCoupling(const IPReduced *, const IPBasis *, PetscReal E[]);
PETSC_INTERN PetscErrorCode IPReducedSolve(IPReduced *, PetscReal y[], Vec v, Vec force, Vec terms, PetscBool *solved);
PETSC_INTERN PetscErrorCode IPReducedSolveActive(IPReduced *, const IPBasis *, Vec f, Vec c, Vec v, Vec force,
  PetscBool *solved);

/* state.c, beside the public functions */
PETSC_INTERN PetscErrorCode IPSubspaceStateCompose(Tao, PetscBool attach);
PETSC_INTERN PetscErrorCode IPSubspaceStateGet(Tao, IPSubspaceState **);
PETSC_INTERN PetscErrorCode IPSubspaceStateReset(IPSubspaceState *);
PETSC_INTERN PetscErrorCode IPSubspaceStateCondense(Tao, Vec D, Vec Dt, Mat *A);
PETSC_INTERN PetscErrorCode IPSubspaceStateHold(Tao, IPSubspaceState *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPSubspaceStateReconsider(Tao, IPSubspaceState *, PetscReal left, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPSubspaceStateUpdate(Tao, IPSubspaceState *, PetscBool *possible);

/* subspace.c */
PETSC_INTERN PetscErrorCode IPFilteredTakeAll(Tao, IS *W);
PETSC_INTERN PetscErrorCode IPFilteredWiden(Tao, IPSubspaceState *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPFilteredSetUp(Tao, IPSubspaceState *, PetscBool *possible);
PETSC_INTERN PetscErrorCode IPFilteredDestroy(IPFiltered *);
PETSC_INTERN PetscErrorCode IPFilteredCentre(Tao, const IPBasis *, Vec x, Vec centre, Vec gradient, Vec c);
PETSC_INTERN PetscErrorCode IPFilteredSolve(Tao, const IPBasis *, Vec v, Vec force, PetscBool *solved);
PETSC_INTERN PetscErrorCode IPFilteredSetPairs(Tao, Vec force);
PETSC_INTERN PetscErrorCode IPFilteredMakeRoom(Tao, IPBasis *);
PETSC_INTERN PetscBool      IPFilteredProgresses(IPFiltered *, PetscReal error, PetscInt patience);
PETSC_INTERN PetscErrorCode IPFilteredAllows(Tao, PetscBool *);
PETSC_INTERN PetscErrorCode IPFilteredExtend(Tao, IPSubspaceState *, Vec r, PetscBool *extended);

/* monitor.c */
PETSC_INTERN PetscErrorCode IPFilteredMonitor(Tao, PetscBool *monitored);

/* newton.c */
PETSC_INTERN PetscErrorCode IPNewtonSubspaceStep(Tao, PetscBool *done);

/* method.c: min f(x), c_I(x) >= 0 on the filtered subspace */
PETSC_INTERN const IPMethodOps IPMethodSubspace;

#endif
