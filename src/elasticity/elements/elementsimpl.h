/*
   Cells: shape functions, elements, and the bodies that they are of.
*/
#ifndef ELEMENTSIMPL_H
#define ELEMENTSIMPL_H

#include <elasticity.h>
#include <petsccompat.h>
#include <mesh.h>
#include <petscsf.h>

/*
   basis.c: hexahedra of 8 and of 27 nodes on [-1,1]^3, tetrahedra of 4 and of 10 between the origin and the ends of
   the unit vectors. Arrays over nodes come last, for the compiler to vectorize; n is the number of nodes, which
   CELL_CALL() makes a constant for 8.
*/
#define CELL_MAX_NODES  27
#define CELL_MAX_POINTS 27

typedef struct {
  PetscInt  nnodes, npoints;
  PetscReal weight[CELL_MAX_POINTS];
  PetscReal xi[CELL_MAX_POINTS][3];
  PetscReal N[CELL_MAX_POINTS][CELL_MAX_NODES];
  PetscReal dN[CELL_MAX_POINTS][3][CELL_MAX_NODES]; /* dN/dxi_k */
} CellBasis;

/* Nodes of a cell: 4, 8, 10 or 27; Gauss points per axis of a hexahedron: 2 or 3 */
PETSC_INTERN PetscErrorCode CellBasisCreate(PetscInt nnodes, PetscInt gausspoints, CellBasis *);

#define CELL_CALL(function, basis, ...) \
  ((basis)->nnodes == 8 ? function(8, basis, __VA_ARGS__) : function((int)(basis)->nnodes, basis, __VA_ARGS__))

/* Gradients G[j][a] = dN_a/dX_j at point q of the cell with nodes X[d][a]; returns weight times det dX/dxi */
static inline PetscReal CellGradients(const int n, const CellBasis *basis, PetscInt q, PetscReal X[3][CELL_MAX_NODES],
  PetscReal G[3][CELL_MAX_NODES])
{
  const PetscReal(*dN)[CELL_MAX_NODES] = basis->dN[q];
  PetscReal J[3][3], C[3][3], det;

  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      PetscReal sum = 0;

      for (int a = 0; a < n; ++a) sum += X[i][a] * dN[k][a];
      J[i][k] = sum;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

      C[i][k] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1];
    }
  }
  det = J[0][0] * C[0][0] + J[0][1] * C[0][1] + J[0][2] * C[0][2];
  for (int j = 0; j < 3; ++j) {
    const PetscReal c0 = C[j][0] / det, c1 = C[j][1] / det, c2 = C[j][2] / det;

    for (int a = 0; a < n; ++a) G[j][a] = c0 * dN[0][a] + c1 * dN[1][a] + c2 * dN[2][a];
  }
  return basis->weight[q] * det;
}

/* H[3 i + j] = du_i/dX_j */
static inline void CellDisplacementGradient(const int n, PetscReal U[3][CELL_MAX_NODES], PetscReal G[3][CELL_MAX_NODES],
  PetscReal H[9])
{
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      PetscReal sum = 0;

      for (int a = 0; a < n; ++a) sum += U[i][a] * G[j][a];
      H[3 * i + j] = sum;
    }
  }
}

/* F[i][a] += w P_ij dN_a/dX_j */
static inline void CellForceAdd(const int n, PetscReal w, PetscReal G[3][CELL_MAX_NODES], const PetscReal P[9],
  PetscReal F[3][CELL_MAX_NODES])
{
  for (int i = 0; i < 3; ++i) {
    const PetscReal p0 = w * P[3 * i], p1 = w * P[3 * i + 1], p2 = w * P[3 * i + 2];

    for (int a = 0; a < n; ++a) F[i][a] += p0 * G[0][a] + p1 * G[1][a] + p2 * G[2][a];
  }
}

/* stiffness.c: of a cell, from the tangents at its points; the elements share it. K[(3 a + i) 3 n + 3 b + k] */
typedef struct {
  PetscReal of[3][3][CELL_MAX_NODES * CELL_MAX_NODES]; /* of[i][k][n a + b], k >= i */
} CellSums;

/* Stiffness of a law with constant tangent */
PETSC_INTERN void CellStiffnessConstant(const CellBasis *, const MaterialLaw *, const MaterialModuli *,
  PetscReal X[3][CELL_MAX_NODES], PetscScalar K[]);
/* Clears the sums; adds w dN_a/dX_j A_ijkl dN_b/dX_l, A symmetric, to of[i][k][n a + b]; then the stiffness from the
   sums over all points */
PETSC_INTERN void CellSumsClear(PetscInt n, CellSums *);
PETSC_INTERN void CellStiffnessAdd(const CellBasis *, PetscReal w, PetscReal G[3][CELL_MAX_NODES],
  const PetscReal A[81], CellSums *);
PETSC_INTERN void CellStiffnessFinish(const CellBasis *, const CellSums *, PetscScalar K[]);

/*
   full.c, bbar.c, incompatible.c: elements, which are how energy, force, stiffness and stress of a cell follow from
   its law and its vertices.

   A new element is one file with an Element, and one line in formulation.h.
*/
typedef struct {
  const MaterialLaw *law;
  MaterialModuli     moduli, isochoric; /* all of the law, and what is left of it without its bulk modulus */
} BodyMaterial;

#define ELEMENT_STRAINS 10

/*
   A cell with nodes X[d][a] displaced by U[d][a]. Where a point of it is turned inside out the energy is
   PETSC_INFINITY, and the others return PETSC_FALSE and what they wrote means nothing.
*/
typedef struct {
  PetscInt nnodes; /* of the cells that it takes; 0: any */
  PetscReal (
    *energy)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES]);
  /* Derivative of the energy, F[d][a] */
  PetscBool (*force)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES]);
  /* Second derivative of the energy, K[(3 a + i) 3 n + 3 b + k]; U is not read where the law's tangent is constant */
  PetscBool (*stiffness)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscScalar K[]);
  /* Cauchy stress averaged over the reference cell, xx yy zz xy yz zx */
  PetscBool (*cauchy)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6]);
  /* Volumes of the points; displacement gradient (9) and dilatation there, those whose energy is the cell's */
  void (*strains)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS]);
} Element;

#define ELEMENT_DECLARE(name, element, text) PETSC_INTERN const Element Element##element;
ELEMENT_TYPES(ELEMENT_DECLARE)
#undef ELEMENT_DECLARE

/* element.c: the table of elements */
PETSC_INTERN PetscErrorCode ElementGet(ElementType, PetscInt nnodes, const Element **);

/* events.c: PETSc's log events of this folder */
PETSC_INTERN PetscLogEvent  ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error;
PETSC_INTERN PetscErrorCode ElasticityEventsRegister(void);

typedef struct {
  BodyMaterial     material;
  ElementType      type;
  const Element   *element; /* with the basis, that of the body's cells; NULL on ranks without any */
  const CellBasis *basis;
  PetscBool        kept;       /* constant tangent, and no vertex shared with a body that is assembled again */
  PetscInt         assemblies; /* into any tangent */
  PetscBool        expands;
  PetscReal        expansion[9]; /* thermal, a tensor [1/temperature] */
  PetscReal        density;      /* [mass/length^3] */
  PetscBool        rigid;
} Body;

/* The last tangent assembled, as it was left: a matrix of another id or state is assembled completely */
typedef struct {
  PetscObjectId    id; /* 0: none */
  PetscObjectState state;
} AssembledTangent;

struct _n_Elasticity {
  DM               dm;
  char             mattype[64];
  PetscBool        mattype_given; /* by an option */
  CellBasis       *basis[4];      /* of order 1 and 2, hexahedra and tetrahedra; NULL: no such cells on this rank */
  PetscInt         nbodies;
  Body            *bodies;
  PetscInt         quadrature;     /* Gauss points per axis of order 1 */
  PetscInt         ncells, nnodes; /* of this rank; nodes are numbered as the local section does */
  PetscInt        *cellstart;      /* ncells + 1 */
  PetscInt        *cellnodes;      /* nodes of cell c, in tensor order, from cellnodes[cellstart[c]] */
  PetscInt        *cellbody;
  unsigned char   *prescribed;  /* a node's bit d is set if its component d is prescribed; NULL if nothing is */
  Vec              springs;     /* stiffness of those to the ground, one a row; NULL: none [force/length] */
  Mat              between;     /* of springs between unknowns; NULL: there are none [force/length] */
  PetscReal       *temperature; /* 4 a cell; NULL: none is set */
  AssembledTangent assembled;
  PetscReal        inertia, viscosity; /* of tangents: factor of the mass, 0: none; more than 1 of the stiffness */
  PetscBool        consistent, *light; /* mass; local nodes that have none, NULL: all have theirs */
};

/* locals.c: local values of a displacement (NULL: zero), and the coordinates */
PETSC_INTERN PetscErrorCode ElasticityGetLocals(Elasticity, Vec u, Vec *local, const PetscScalar **ul,
  const PetscScalar **x);
PETSC_INTERN PetscErrorCode ElasticityRestoreLocals(Elasticity, Vec *local, const PetscScalar **ul,
  const PetscScalar **x);

/* Values of a local vector (3 a node) at a cell's nodes, component by component */
static inline void CellGather(PetscInt n, const PetscInt nodes[], const PetscScalar local[],
  PetscReal values[3][CELL_MAX_NODES])
{
  for (PetscInt a = 0; a < n; ++a) {
    for (PetscInt d = 0; d < 3; ++d) values[d][a] = PetscRealPart(local[3 * nodes[a] + d]);
  }
}

/* A cell with its places and displacements */
typedef struct {
  PetscInt        n;
  const PetscInt *nodes;
  const Body     *body;
  PetscReal       X[3][CELL_MAX_NODES], U[3][CELL_MAX_NODES];
} CellState;

/* thermal.c: takes off what a cell would move by in its temperature if it were free */
PETSC_INTERN void ThermalSubtract(const PetscReal temperature[4], CellState *);

static inline void ElasticityGetCell(Elasticity e, PetscInt c, const PetscScalar x[], const PetscScalar u[],
  CellState *cell)
{
  cell->n     = e->cellstart[c + 1] - e->cellstart[c];
  cell->nodes = e->cellnodes + e->cellstart[c];
  cell->body  = &e->bodies[e->cellbody[c]];
  CellGather(cell->n, cell->nodes, x, cell->X);
  CellGather(cell->n, cell->nodes, u, cell->U);
  if (e->temperature && cell->body->expands) ThermalSubtract(e->temperature + 4 * c, cell);
}

#endif
