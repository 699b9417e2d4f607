/*
   Bodies with the equations K x + g = R^T f, whose systems with A = K + R^T D R are solved in a subspace: the
   unknowns W that contacts touch, and the directions P, which are zero on W. With x = w + P y and Q = K_WP
     [A_WW Q; Q^T P^T K P] (dw, dy) = (R^T s - r)
   is solved by a factorization and a dense Schur complement. The residual that is left is zero on W. A direction is
   added for it until it is small. With a fixed D this is CG with the cycle `fbf` of PCAMGF. Later systems, with other
   D, use the directions again.

   Only the symmetric matrix A_WW = K_WW + R_W^T S R_W is factored. The rest D - S couples slip and normal force. Its
   forces e = (D - S) R dx are found by GMRES, whose vectors have the size of R's rows. The files are listed such that
   each depends only on those before it.
*/
#ifndef IPFILTER_SUBSPACE_BODIES_H
#define IPFILTER_SUBSPACE_BODIES_H

#include "frictionimpl.h"

typedef struct _p_InterfaceMatrix *InterfaceMatrix;

struct _p_SubspaceBodies {
  Tao             tao;
  IPRecycle      *recycle; /* the preconditioner of K, and the directions */
  Mat             K;
  IS              W;
  Mat             R, RW;    /* rows of the contacts: three for each contact of this rank; columns W of R */
  InterfaceMatrix A;        /* A_WW */
  Mat             F;        /* its factors */
  KSP             coupling; /* GMRES for the forces e of D - S */
  Vec             e, off;   /* the forces e divided by their scales, and a correction of these */
  Vec             scale;    /* of the forces of contacts [square root of stiffness]; 0: the contact has no stiffness */
  PetscBool       coupled;  /* whether D differs from S */
  Vec             x, dx, r, Kx, Kdx, g; /* K x is kept beside x, K dx beside dx */
  Vec             kept_x, kept_Kx;
  Vec             first;     /* the residual of which a part is left out; NULL: none */
  PetscReal       lacks;     /* that part */
  PetscReal       load_norm; /* largest residual [2-norm] of the normal laws since the begin */
  IPReduced       normal;    /* the problem of the normal laws, whose unknowns are those in W */
  Mat             JW;        /* normal rows of R_W */
  IS              places;    /* all unknowns of W by their number in W */
  Vec             base, rhs; /* dx = base + what the subspace adds, for the right-hand side rhs of the latter */
  Vec             on_W, dw0, load, rows;    /* work vectors on W; one with the entries of contacts */
  PetscReal      *factored, *rest;          /* S of the factors F, and D - S */
  PetscReal      *X, *schur, *factors, *dy; /* A_WW^-1 Q: columns on W; Schur complement in columns of length max; its
                                          factors */
  PetscReal      *loads;                    /* loads of the first nloads directions in this solve */
  PetscInt        nloads;
  PetscInt        nX, generation; /* number of columns of X; generation of the directions that it belongs to */
  PetscReal       enough;         /* residual [2-norm] that any solve may leave */
  PetscBLASInt   *pivots;
};

/* contact_rows.c */
PETSC_INTERN PetscErrorCode BodiesCreateRows(Mat J, Mat T, PetscInt n, Mat *R);

/* interface_matrix.c */
PETSC_INTERN PetscErrorCode InterfaceMatrixCreate(Mat R, Mat K, InterfaceMatrix *);
PETSC_INTERN PetscErrorCode InterfaceMatrixDestroy(InterfaceMatrix *);
PETSC_INTERN PetscErrorCode InterfaceMatrixAssemble(InterfaceMatrix, const PetscReal S[]);
PETSC_INTERN Mat            InterfaceMatrixGet(InterfaceMatrix);

/* bodies_factors.c */
PETSC_INTERN PetscReal      BodiesDot(PetscInt n, const PetscScalar a[], const PetscScalar b[]);
PETSC_INTERN PetscErrorCode BodiesSolveSchur(SubspaceBodies b, PetscReal dy[], Vec w);
PETSC_INTERN PetscErrorCode BodiesFactor(SubspaceBodies b, const PetscReal S[], PetscBool *factored);
PETSC_INTERN PetscErrorCode BodiesPrepare(void *data, const PetscReal D[], const PetscReal S[], PetscBool *prepared);
PETSC_INTERN PetscErrorCode BodiesFactorDirections(SubspaceBodies b, PetscBool *factored);

/* bodies_coupling.c */
PETSC_INTERN PetscErrorCode BodiesCreateCoupling(SubspaceBodies b);
PETSC_INTERN PetscErrorCode BodiesSolveCoupled(SubspaceBodies b, PetscReal error, PetscBool *solved);

/* bodies_space.c */
PETSC_INTERN PetscErrorCode BodiesDestroySpace(SubspaceBodies b);
PETSC_INTERN PetscErrorCode BodiesCreateSpace(SubspaceBodies b, IS W);
PETSC_INTERN PetscErrorCode BodiesSpread(SubspaceBodies b, const PetscReal f[], PetscBool add, Vec y);
PETSC_INTERN PetscErrorCode BodiesSize(SubspaceBodies b, Vec v, PetscReal *size);

/* bodies_solve.c */
PETSC_INTERN PetscErrorCode BodiesLeft(SubspaceBodies b, Vec v, PetscReal *norm);
PETSC_INTERN PetscErrorCode BodiesExtend(SubspaceBodies b, Vec left, PetscBool *added);
PETSC_INTERN PetscErrorCode BodiesSolve(void *data, const PetscReal s[], PetscReal fraction, PetscReal target,
  PetscReal du[], PetscBool *solved);

/* bodies_normal.c */
PETSC_INTERN PetscErrorCode BodiesSolveNormal(void *data, const PetscReal own[], const PetscReal D[],
  const PetscReal s[], const PetscReal f[], const PetscReal u[], PetscReal du[], PetscReal df[], PetscBool *solved);

#endif
