/*
   tao_ipfilter/friction: contact with friction. The laws of contacts are solved by an interior point method on
   second-order cones and by a semismooth Newton method. Both know the bodies only as a ContactBodies. The files are
   listed such that each depends only on those before it.
*/
#ifndef IPFILTER_FRICTIONIMPL_H
#define IPFILTER_FRICTIONIMPL_H

#include "tao_ipfilter/subspace/subspaceimpl.h"

/*
   Rows of closed and sticking contacts, u = 0, become springs -u = weak x compliance x df. Their forces are changes, so
   that the solution does not depend on the springs: each step leaves a small fraction of u. The ratio of stiffnesses
   limits the accuracy of a system; its square root is lost here.
*/
#define CONTACT_WEAK 1e-5

/* The law of a contact's tangential force tau for the slip v: |tau| <= b, tau = -b v / |v| if it slips */
typedef enum {
  CONTACT_SMOOTH,  /* b = 0 */
  CONTACT_COULOMB, /* b = coefficient x normal force */
  CONTACT_LIMITED, /* b = min(limit, coefficient x normal force) */
  CONTACT_TRESCA,  /* b = limit */
  CONTACT_STICKS   /* v = 0 if it is held, otherwise b = 0 (stick.c) */
} ContactLaw;

/*
   The contacts of this rank. Each has a normal and two tangential components, which are neighbours in f and u. A
   contact is without its normal component if its norm term does not depend on a constraint.
*/
typedef struct {
  MPI_Comm    comm;
  PetscInt    n;
  ContactLaw *law;
  PetscBool  *normal;              /* whether there is a normal component that some unknown moves */
  PetscBool  *closed;              /* states in Newton's method */
  PetscBool  *held, *released;     /* whether a contact that sticks is held at its place; whether it was before */
  PetscReal  *coefficient, *limit; /* of the law; unused ones are zero */
  PetscReal  *rigid;               /* two per contact: unit direction along which it cannot slip; zeros: none */
  PetscReal
    *compliance;    /* two per contact: estimates for the normal and for the tangential components [length/force] */
  PetscReal *own;   /* compliance of the normal component itself, which is part of compliance[2 i]; 0: rigid */
  PetscReal *f, *u; /* three per contact: forces, and motions: the gap, plus own x normal force, and the slip */
  PetscReal *f_start, *u_start; /* the same at the begin of the solve */
  PetscReal *shift, *place; /* two per contact: by how much the place was moved from which the slip is measured; slip at
                               which the contact closed last */
  PetscReal *D, *s;         /* nine and three per contact: linearized laws df = s - D du */
  PetscReal *S;             /* nine per contact: symmetric D, without the dependence of slip and normal force */
  PetscReal  rounding;      /* size of the rounding errors of a gap [length] */
  PetscReal  least;         /* normal force up to which a contact counts as open at the begin */
} Contacts;

/*
   Linear bodies: K x + g = R^T f, with the motions u = R x + u_0 of the contacts. Functions of all ranks together. The
   unknowns x, their change dx, and the residual r = K x + g - R^T f are kept by the implementation.
*/
typedef struct {
  void *data;
  /* computes r. size: its largest entry, where each is divided by the square root of K's diagonal entry [square root of
     energy]; NULL: not computed */
  PetscErrorCode (*residual)(void *, const PetscReal f[], PetscReal *size);
  /* sets the matrix K + R^T D R. S: symmetric blocks near D. *prepared: false if K + R^T S R is singular */
  PetscErrorCode (*prepare)(void *, const PetscReal D[], const PetscReal S[], PetscBool *prepared);
  /* solves (K + R^T D R) dx = R^T s - r until the residual is at most that fraction of the first one, or at most the
     target, in the measure of `size`; du = R dx */
  PetscErrorCode (
    *solve)(void *, const PetscReal s[], PetscReal fraction, PetscReal target, PetscReal du[], PetscBool *solved);
  PetscErrorCode (*work)(void *, PetscReal *); /* computes the work r^T dx of the residual */
  /* solves K dx = R^T df - r with the linearized laws df = s - D du of tangential components, and f >= s, u >= 0 and
     (f - s) u = 0 for the normal ones, where own[i] df is added to du of normal components */
  PetscErrorCode (*solve_normal)(void *, const PetscReal own[], const PetscReal D[], const PetscReal s[],
    const PetscReal f[], const PetscReal u[], PetscReal du[], PetscReal df[], PetscBool *solved);
  PetscErrorCode (*load)(void *, PetscReal fraction);    /* leaves out all but that fraction of the residual that was
                                                         computed before the first call */
  PetscErrorCode (*advance)(void *, PetscReal fraction); /* adds fraction dx to x */
  PetscErrorCode (*keep)(void *, PetscBool back);        /* copies x to a second place, or from there */
  PetscBool definite;                                    /* K is known to be positive definite */
  PetscErrorCode (*interrupted)(void *, PetscBool *);    /* whether the user wants to end the solve */
} ContactBodies;

/* cone.c: algebra of the second-order cone {(a, b): |b| <= a} of three dimensions */
PETSC_INTERN void      ConeMultiply(const PetscReal A[9], const PetscReal x[3], PetscReal y[3]);
PETSC_INTERN void      ConeProduct(const PetscReal a[3], const PetscReal b[3], PetscReal product[3]);
PETSC_INTERN void      ConeDivide(const PetscReal a[3], const PetscReal b[3], PetscReal quotient[3]);
PETSC_INTERN void      ConeScaling(const PetscReal y[3], const PetscReal f[3], PetscReal W[9], PetscReal inverse[9]);
PETSC_INTERN void      ConeSquare(const PetscReal W[9], PetscReal square[9]);
PETSC_INTERN PetscBool ConeInvert(PetscInt n, const PetscReal A[9], PetscReal inverse[9]);
PETSC_INTERN PetscReal ConeLongestStep(const PetscReal a[3], const PetscReal da[3]);

/* contacts.c */
PETSC_INTERN PetscErrorCode ContactsCreate(MPI_Comm, PetscInt n, Contacts *);
PETSC_INTERN PetscErrorCode ContactsDestroy(Contacts *);
PETSC_INTERN void           ContactsSetLaw(Contacts *, PetscInt i, PetscReal limit, PetscReal coefficient);
PETSC_INTERN PetscReal      ContactsBound(const Contacts *, PetscInt i, PetscReal normal_force);
PETSC_INTERN void           ContactsRemoveRigid(const Contacts *, PetscInt i, PetscReal u[3]);
PETSC_INTERN void           ContactsFinishLaw(const Contacts *, PetscInt i);
PETSC_INTERN void           ContactsSetForce(const Contacts *, PetscInt i, PetscReal normal_force);
PETSC_INTERN void           ContactsSetNoSlip(const Contacts *, PetscInt i);
PETSC_INTERN PetscErrorCode ContactsViolation(const Contacts *, const PetscReal force[], const PetscReal motion[],
  PetscReal *violation);
PETSC_INTERN PetscErrorCode ContactsNorm(const Contacts *, const PetscReal du[], PetscReal *norm);
PETSC_INTERN PetscErrorCode ContactsStep(Contacts *, const ContactBodies *, PetscReal fraction, PetscReal target,
  PetscReal du[], PetscReal df[], PetscBool *solved);

/* cones.c */
typedef struct _p_Cones *Cones;

PETSC_INTERN PetscErrorCode ConesCreate(Contacts *, const ContactBodies *, Cones *);
PETSC_INTERN PetscErrorCode ConesDestroy(Cones *);
PETSC_INTERN PetscErrorCode ConesStart(Cones, PetscBool *started);
PETSC_INTERN PetscErrorCode ConesIterate(Cones, PetscReal tolerance, PetscReal *error, PetscBool *solved);

/* newton.c */
PETSC_INTERN PetscBool      ContactsLinearize(const Contacts *, PetscInt i);
PETSC_INTERN void           ContactsGuessStates(Contacts *, PetscBool interior);
PETSC_INTERN PetscErrorCode ContactsNewtonStep(Contacts *, const ContactBodies *, PetscReal *merit, PetscReal *change,
  PetscBool *solved);

/* choice.c */
PETSC_INTERN PetscErrorCode ContactsChoose(Contacts *, const ContactBodies *, PetscBool *chosen);

/* stick.c */
typedef struct {
  Contacts            *contacts;
  const ContactBodies *bodies;
  PetscInt             part, nparts; /* the present part of the load, and the number of parts */
  PetscReal            tension;      /* normal force that contacts bear before the whole load acts [force] */
  PetscBool            whole;        /* whether the whole load acts and is settled but for the rest of the tension */
  PetscBool            predicted;    /* whether it is known where contacts would close in this part */
  PetscReal           *du, *df;      /* changes of motions and forces in a step */
  PetscReal           *first;        /* motions and forces at the begin */
  PetscReal           *from;         /* motions at the begin of this part of the load */
  PetscBool            divides;      /* whether the load may grow in parts: the bodies are linear */
} ContactStick;

PETSC_INTERN PetscErrorCode ContactsHaveHeld(const Contacts *, PetscBool *some, PetscBool *exact);
PETSC_INTERN PetscErrorCode StickBegin(Contacts *, const ContactBodies *, PetscBool linear, ContactStick *);
PETSC_INTERN PetscErrorCode StickIterate(ContactStick *, PetscBool *settled, PetscBool *solved);
PETSC_INTERN PetscErrorCode StickUpdate(Contacts *, PetscInt *released, PetscInt *held);
PETSC_INTERN PetscErrorCode StickEnd(ContactStick *);

/* iteration.c */
typedef enum {
  CONTACT_HELD,  /* exact normal laws, while contacts that stick are held or released */
  CONTACT_WARM,  /* Newton's method from the present state */
  CONTACT_CONES, /* the interior point method from a cold start */
  CONTACT_LAST   /* Newton's method from its end */
} ContactPhase;

typedef struct {
  Contacts     *contacts;
  ContactBodies bodies;
  ContactPhase  phase;
  ContactStick  stick;
  PetscBool     sticks;          /* whether there are contacts that stick while they are closed */
  PetscBool     cold;            /* no contact has a force, from which Newton's method could start */
  Cones         cones;           /* NULL before the phase CONTACT_CONES */
  PetscInt      nsteps, nfutile; /* numbers of steps of this phase; of those in a row that hardly reduced the merit */
  PetscReal  size, best; /* change of motions in this solve, or violation at its start; smallest merit of this phase */
  PetscReal  known;      /* error of the interior point method at which Newton's method is tried */
  PetscReal  violation;  /* relative violation of the laws; infinite in the interior point method */
  PetscBool  chosen, keeps; /* whether forces were chosen (choice.c); whether `kept` has those before */
  PetscReal *kept;          /* state at the start of Newton's method */
} ContactIteration;

PETSC_INTERN PetscErrorCode ContactIterationBegin(Contacts *, ContactBodies, PetscBool linear, ContactIteration *);
PETSC_INTERN PetscErrorCode ContactIterationEnd(ContactIteration *);
PETSC_INTERN PetscErrorCode ContactIterate(ContactIteration *, PetscBool *done);

/* subspace_bodies.c */
typedef struct _p_SubspaceBodies *SubspaceBodies;

PETSC_INTERN PetscErrorCode SubspaceBodiesCreate(Tao, IPRecycle *, IS W, PetscInt n, SubspaceBodies *);
PETSC_INTERN PetscErrorCode SubspaceBodiesDestroy(SubspaceBodies *);
PETSC_INTERN PetscErrorCode SubspaceBodiesCentre(SubspaceBodies, Vec g);
PETSC_INTERN void           SubspaceBodiesSetEnough(SubspaceBodies, PetscReal enough);
PETSC_INTERN PetscErrorCode SubspaceBodiesGetCompliance(SubspaceBodies, PetscInt n, PetscReal compliance[]);
PETSC_INTERN Vec            SubspaceBodiesGet(SubspaceBodies);
PETSC_INTERN ContactBodies  SubspaceBodiesInterface(SubspaceBodies);

/* friction.c */
PETSC_INTERN const IPLawsOps IPLawsFriction;

#endif
