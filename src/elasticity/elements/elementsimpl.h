/*
   Cells: shape functions, elements, and data of bodies.
*/
#ifndef ELEMENTSIMPL_H
#define ELEMENTSIMPL_H

#include <elasticity.h>
#include <vector3.h>
#include <petsccompat.h>
#include <mesh.h>
#include <petscsf.h>

/*
   basis.c: hexahedra with 8 or 27 nodes on [-1,1]^3; tetrahedra with 4 or 10 nodes, corners at the origin and the unit
   vectors' ends. The node index of arrays is last, so that the compiler can vectorize; n is the number of nodes, which
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

/* nnodes: 4, 8, 10 or 27 nodes of a cell; gausspoints per axis of a hexahedron: 2 or 3 */
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
  det = MatrixCofactors(J, C);
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

/* stiffness.c: stiffness of a cell from the tangents at its points, for all elements. K[(3 a + i) 3 n + 3 b + k] */
typedef struct {
  PetscReal of[3][3][CELL_MAX_NODES * CELL_MAX_NODES]; /* of[i][k][n a + b]: entry of component i at node a and
                                                          component k >= i at node b */
} CellSums;

/* Stiffness of a law with constant tangent */
PETSC_INTERN void CellStiffnessConstant(const CellBasis *, const MaterialLaw *, const MaterialModuli *,
  PetscReal X[3][CELL_MAX_NODES], PetscScalar K[]);
/* Clear: zeroes the sums. Add: adds w dN_a/dX_j A_ijkl dN_b/dX_l, A symmetric, to of[i][k][n a + b]. Finish: the
   stiffness from the sums over all points */
PETSC_INTERN void CellSumsClear(PetscInt n, CellSums *);
PETSC_INTERN void CellStiffnessAdd(const CellBasis *, PetscReal w, PetscReal G[3][CELL_MAX_NODES],
  const PetscReal A[81], CellSums *);
PETSC_INTERN void CellStiffnessFinish(const CellBasis *, const CellSums *, PetscScalar K[]);

/*
   full.c, bbar.c, incompatible.c: elements. An element computes energy, force, stiffness and stress of a cell from its
   law and nodes. A new element is a file with an Element, and a line in formulation.h.
*/
typedef struct {
  const MaterialLaw *law;
  MaterialModuli     moduli, isochoric; /* of the law; and of the law without its bulk modulus. With a history: of a
                                           cell's points in turn */
} BodyMaterial;

/* The moduli at point q of a cell: a copy of its own if the law has a history */
static inline const MaterialModuli *CellModuli(const MaterialModuli *cell, PetscInt q, MaterialModuli *own)
{
  if (!cell->history) return cell;
  *own = *cell;
  own->history += MATERIAL_HISTORY * q;
  return own;
}

/* Leaves the elastic part of the displacement gradient at point q */
static inline void CellElastic(const BodyMaterial *cell, PetscInt q, PetscReal H[9])
{
  if (cell->moduli.history) cell->law->elastic(cell->moduli.history + MATERIAL_HISTORY * q, H);
}

#define ELEMENT_STRAINS 10

/*
   Functions of a cell with nodes X[d][a] and displacements U[d][a]. If a point is inverted the energy is
   PETSC_INFINITY; the other functions then return PETSC_FALSE, and their results are undefined.
*/
typedef struct {
  PetscInt nnodes; /* number of nodes of the cells it supports; 0: any */
  PetscReal (
    *energy)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES]);
  /* Derivative of the energy, F[d][a] */
  PetscBool (*force)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES]);
  /* Second derivative of the energy, K[(3 a + i) 3 n + 3 b + k]; U is not used if the law's tangent is constant */
  PetscBool (*stiffness)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscScalar K[]);
  /* Cauchy stress averaged over the reference cell, xx yy zz xy yz zx */
  PetscBool (*cauchy)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6]);
  /* For each point: volume, displacement gradient (9) and dilatation as used in the cell's energy, plastic strain
     included */
  void (*strains)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS]);
} Element;

/* modes.c: det J0 J0^(-1) of a cell, its incompatible modes at point q, which has volume w, and Cholesky's factor */
#define INCOMPATIBLE_MODES 12
PETSC_INTERN void IncompatibleCentre(PetscReal X[3][CELL_MAX_NODES], PetscReal cofactor[3][3]);
PETSC_INTERN void IncompatibleModes(const CellBasis *, PetscInt q, PetscReal w, PetscReal cofactor[3][3],
  PetscReal M[INCOMPATIBLE_MODES][9]);
PETSC_INTERN void IncompatibleFactor(PetscReal L[INCOMPATIBLE_MODES][INCOMPATIBLE_MODES]);

/* condensed.c: incompatible modes of a law that is not linear, members of an Element */
PETSC_INTERN PetscReal CondensedEnergy(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES]);
PETSC_INTERN PetscBool CondensedForce(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES]);
PETSC_INTERN PetscBool CondensedStiffness(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscScalar K[]);
PETSC_INTERN PetscBool CondensedCauchy(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6]);
PETSC_INTERN void      CondensedStrains(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
       PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS]);

#define ELEMENT_DECLARE(name, element, text) PETSC_INTERN const Element Element##element;
ELEMENT_TYPES(ELEMENT_DECLARE)
#undef ELEMENT_DECLARE

/* element.c: the table of elements */
PETSC_INTERN PetscErrorCode ElementGet(ElementType, PetscInt nnodes, const Element **);

/* events.c: PETSc's log events of this folder */
PETSC_INTERN PetscLogEvent  ELASTICITY_Tangent, ELASTICITY_Force, ELASTICITY_Error;
PETSC_INTERN PetscErrorCode ElasticityEventsRegister(void);

typedef struct {
  Material         given; /* as given by the caller */
  BodyMaterial     material;
  ElementType      type;
  const Element   *element; /* the element and the basis of the body's cells; NULL on ranks without cells of it */
  const CellBasis *basis;
  PetscBool        kept;       /* constant tangent, and no common vertex with a body that is assembled again */
  PetscInt         assemblies; /* number of assemblies into any tangent */
  PetscBool        expands;
  PetscReal        expansion[9]; /* thermal expansion tensor [1/temperature] */
  PetscReal        density;      /* [mass/length^3] */
  PetscBool        rigid;
} Body;

/* Identifies the last assembled tangent and its state; any other matrix is assembled completely */
typedef struct {
  PetscObjectId    id; /* 0: none */
  PetscObjectState state;
} AssembledTangent;

/* A section through a body: the cells that it cuts take the nodes beyond it as displaced by shortening x axis */
typedef struct {
  PetscInt  body;
  PetscReal axis[3];    /* unit vector */
  PetscReal shortening; /* [length] */
} BodySection;

struct _n_Elasticity {
  DM               dm;
  char             mattype[64];
  PetscBool        mattype_given; /* set by an option */
  CellBasis       *basis[4];      /* of order 1 and 2, hexahedra and tetrahedra; NULL: no such cells on this rank */
  PetscInt         nbodies;
  Body            *bodies;
  PetscInt         quadrature;     /* Gauss points per axis for order 1 */
  PetscInt         ncells, nnodes; /* on this rank; nodes are numbered as in the local section */
  PetscInt        *cellstart;      /* ncells + 1 */
  PetscInt        *cellnodes;      /* the nodes of cell c start at cellnodes[cellstart[c]], in tensor order */
  PetscInt        *cellbody;
  unsigned char   *prescribed;  /* bit d of a node: its component d is prescribed; NULL: none is */
  Vec              springs;     /* stiffness of springs to the ground, one per row; NULL: none [force/length] */
  Mat              between;     /* stiffness of springs between unknowns; NULL: none [force/length] */
  PetscReal       *temperature; /* 4 per cell; NULL: none */
  PetscBool        yields;      /* some body's law has a history */
  PetscInt        *firstpoint;  /* then: first point of cell c in history; PETSC_DECIDE: its law has none */
  PetscInt         npoints;     /* number of points with a history on this rank */
  PetscReal       *history;     /* at the last state of equilibrium, MATERIAL_HISTORY values per point */
  PetscInt         nsections;
  BodySection     *sections;
  PetscInt        *cellsection, *cellbeyond; /* of each cell: its section, PETSC_DECIDE: none; its first value in */
  PetscReal       *beyond;                   /* 1 for nodes of a cut cell beyond the section, 0 for the others */
  PetscInt         nbeyond;
  AssembledTangent assembled;
  PetscReal        inertia, viscosity; /* of tangents: factor of the mass, 0: none; more than 1 of the stiffness */
  PetscBool        consistent, *light; /* mass; local nodes that have none, NULL: all have theirs */
};

/* locals.c: local values of a displacement (NULL: zero), and the coordinates */
PETSC_INTERN PetscErrorCode ElasticityGetLocals(Elasticity, Vec u, Vec *local, const PetscScalar **ul,
  const PetscScalar **x);
PETSC_INTERN PetscErrorCode ElasticityRestoreLocals(Elasticity, Vec *local, const PetscScalar **ul,
  const PetscScalar **x);

/* Gathers the values of a local vector (3 per node) at a cell's nodes, by component */
static inline void CellGather(PetscInt n, const PetscInt nodes[], const PetscScalar local[],
  PetscReal values[3][CELL_MAX_NODES])
{
  for (PetscInt a = 0; a < n; ++a) {
    for (PetscInt d = 0; d < 3; ++d) values[d][a] = PetscRealPart(local[3 * nodes[a] + d]);
  }
}

/* A cell with coordinates and displacements */
typedef struct {
  PetscInt            n;
  const PetscInt     *nodes;
  const Body         *body;
  const BodyMaterial *material; /* the body's material, or */
  BodyMaterial        own;      /* a copy with the cell's history */
  PetscReal           X[3][CELL_MAX_NODES], U[3][CELL_MAX_NODES];
} CellState;

/* thermal.c: subtracts the free thermal displacement of a cell */
PETSC_INTERN void ThermalSubtract(const PetscReal temperature[4], CellState *);

/* sections.c: adds the shortening of a section to the displacements of a cell's nodes beyond it */
PETSC_INTERN void SectionAdd(Elasticity, PetscInt c, CellState *);

static inline void ElasticityGetCell(Elasticity e, PetscInt c, const PetscScalar x[], const PetscScalar u[],
  CellState *cell)
{
  cell->n        = e->cellstart[c + 1] - e->cellstart[c];
  cell->nodes    = e->cellnodes + e->cellstart[c];
  cell->body     = &e->bodies[e->cellbody[c]];
  cell->material = &cell->body->material;
  if (e->history && e->firstpoint[c] >= 0) {
    cell->own                = cell->body->material;
    cell->own.moduli.history = cell->own.isochoric.history = e->history + MATERIAL_HISTORY * e->firstpoint[c];
    cell->material                                         = &cell->own;
  }
  CellGather(cell->n, cell->nodes, x, cell->X);
  CellGather(cell->n, cell->nodes, u, cell->U);
  if (e->temperature && cell->body->expands) ThermalSubtract(e->temperature + 4 * c, cell);
  if (e->cellsection && e->cellsection[c] >= 0) SectionAdd(e, c, cell);
}

#endif
