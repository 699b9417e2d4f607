/* Private header of elements: shape functions, elements, and data of cells and bodies */
#ifndef ELEMENTSIMPL_H
#define ELEMENTSIMPL_H

#include <elasticity.h>
#include <lanes.h>
#include <vector3.h>
#include <petsccompat.h>
#include <mesh.h>
#include <petscsf.h>

/*
   basis.c: values of shape functions at the quadrature points. Hexahedra have 8 or 27 nodes on [-1,1]^3. Tetrahedra
   have 4 or 10 nodes, with corners at the origin and at the ends of the unit vectors. The node is the last index of
   arrays, so that the compiler can vectorize loops over nodes. The number of nodes n is an argument of inline
   functions; CELL_CALL() makes it a constant for n = 8.
*/
#define CELL_MAX_NODES  27
#define CELL_MAX_POINTS 27
#define CELL_PACKS      ((CELL_MAX_POINTS + LANES - 1) / LANES) /* packs of points, one in each lane */
#define CELL_WIDTH      32                                      /* CELL_MAX_NODES rounded up to a multiple of LANES */

typedef struct {
  PetscInt  nnodes, npoints;
  PetscReal weight[CELL_MAX_POINTS];
  PetscReal xi[CELL_MAX_POINTS][3];
  PetscReal N[CELL_MAX_POINTS][CELL_MAX_NODES];
  PetscReal dN[CELL_MAX_POINTS][3][CELL_MAX_NODES]; /* dN/dxi_k */
  PetscInt  npacks;
  PetscReal packweight[CELL_PACKS][LANES]; /* zero in lanes beyond the last point, which have the
                                                              other values of the last point */
  PetscReal packdN[CELL_PACKS][CELL_MAX_NODES][3][LANES];
} CellBasis;

/* nnodes: number of nodes of a cell, 4, 8, 10 or 27; gausspoints: per axis of a hexahedron, 2 or 3 */
PETSC_INTERN PetscErrorCode CellBasisCreate(PetscInt nnodes, PetscInt gausspoints, CellBasis *);

#define CELL_CALL(function, basis, ...) \
  ((basis)->nnodes == 8 ? function(8, basis, __VA_ARGS__) : function((int)(basis)->nnodes, basis, __VA_ARGS__))

/*
   Computes the gradients G[j][a] = dN_a/dX_j at point q of the cell with nodes X[d][a]. Returns the volume of the
   point, weight times det dX/dxi.
*/
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

/* Computes the displacement gradient H[3 i + j] = du_i/dX_j */
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

/* Adds w P_ij dN_a/dX_j to F[i][a] */
static inline void CellForceAdd(const int n, PetscReal w, PetscReal G[3][CELL_MAX_NODES], const PetscReal P[9],
  PetscReal F[3][CELL_MAX_NODES])
{
  for (int i = 0; i < 3; ++i) {
    const PetscReal p0 = w * P[3 * i], p1 = w * P[3 * i + 1], p2 = w * P[3 * i + 2];

    for (int a = 0; a < n; ++a) F[i][a] += p0 * G[0][a] + p1 * G[1][a] + p2 * G[2][a];
  }
}

/* Volumes, gradients G[j][a] and displacement gradients at the points of a pack */
typedef struct {
  Lanes w, G[3][CELL_MAX_NODES], H[9];
} CellPack;

/* Computes volumes and gradients, which take less time than it takes to read them from memory */
LANES_INLINE void CellPackGradients(const int n, const CellBasis *basis, PetscInt pack, PetscReal X[3][CELL_MAX_NODES],
  CellPack *c)
{
  Lanes J[3][3] = {}, C[3][3], det, inverse;

  for (int a = 0; a < n; ++a) {
    for (int k = 0; k < 3; ++k) {
      const Lanes dN = LANES_OF(basis->packdN[pack][a][k]);

      for (int i = 0; i < 3; ++i) J[i][k] += X[i][a] * dN;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;

    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

      C[i][k] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1];
    }
  }
  det     = J[0][0] * C[0][0] + J[0][1] * C[0][1] + J[0][2] * C[0][2];
  inverse = 1 / det;
  c->w    = LANES_OF(basis->packweight[pack]) * det;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) C[j][k] *= inverse;
  }
  for (int a = 0; a < n; ++a) {
    const Lanes d0 = LANES_OF(basis->packdN[pack][a][0]), d1 = LANES_OF(basis->packdN[pack][a][1]),
                d2 = LANES_OF(basis->packdN[pack][a][2]);

    for (int j = 0; j < 3; ++j) c->G[j][a] = C[j][0] * d0 + C[j][1] * d1 + C[j][2] * d2;
  }
}

/* Computes volumes, gradients and displacement gradients */
LANES_INLINE void CellPackSet(const int n, const CellBasis *basis, PetscInt pack, PetscReal X[3][CELL_MAX_NODES],
  PetscReal U[3][CELL_MAX_NODES], CellPack *c)
{
  CellPackGradients(n, basis, pack, X, c);
  for (int i = 0; i < 9; ++i) {
    Lanes sum = {0};

    for (int a = 0; a < n; ++a) sum += U[i / 3][a] * c->G[i % 3][a];
    c->H[i] = sum;
  }
}

/* Adds int P_ij dN_a/dX_j over the points of a pack to F[i][a]. P: values at the points */
LANES_INLINE void CellPackForceAdd(const int n, const CellPack *c, const Lanes P[9], PetscReal F[3][CELL_MAX_NODES])
{
  for (int i = 0; i < 3; ++i) {
    const Lanes p0 = c->w * P[3 * i], p1 = c->w * P[3 * i + 1], p2 = c->w * P[3 * i + 2];

    for (int a = 0; a < n; ++a) {
      const Lanes f = p0 * c->G[0][a] + p1 * c->G[1][a] + p2 * c->G[2][a];

      F[i][a] += LanesSum(&f);
    }
  }
}

/* stiffness.c: stiffness of a cell from the tangents at its points, used by all elements */
typedef struct {
  PetscReal G[CELL_MAX_POINTS][3][CELL_WIDTH]; /* gradients of the shape functions; zero beyond the last node, to a
                                                  multiple of 8 */
  Lanes     A[CELL_PACKS][81];                 /* tangents times the volumes of the points */
} CellTangents;

/* Sets the gradients at the points of a pack */
LANES_INLINE void CellTangentsSetGradients(const int n, const CellBasis *basis, PetscInt pack,
  Lanes G[3][CELL_MAX_NODES], CellTangents *t)
{
  for (int l = 0; l < LANES && LANES * pack + l < basis->npoints; ++l) {
    for (int j = 0; j < 3; ++j) {
      PetscReal *g = t->G[LANES * pack + l][j];

      for (int a = 0; a < n; ++a) g[a] = LANE(G[j][a], l);
      for (int a = n; a % 8; ++a) g[a] = 0;
    }
  }
}

/*
   Computes K_ia,kb = int dN_a/dX_j A_ijkl dN_b/dX_l with symmetric A. The entry for component i of node a and component
   k of node b is K[(3 a + i) 3 n + 3 b + k].
*/
PETSC_INTERN void CellStiffness(const CellBasis *, const CellTangents *, PetscScalar K[]);
/* Computes the stiffness of a cell for a law with constant tangent */
PETSC_INTERN void CellStiffnessConstant(const CellBasis *, const MaterialLaw *, const MaterialModuli *,
  PetscReal X[3][CELL_MAX_NODES], PetscScalar K[]);

/*
   full.c, bbar.c, incompatible.c: elements. An element computes energy, force, stiffness and stress of a cell from its
   law and nodes. A new element is a file with an Element, and a line in formulation.h.
*/
typedef struct {
  const MaterialLaw *law;
  MaterialModuli     moduli, isochoric; /* moduli of the law; moduli of the law without its bulk modulus. If the law
                                           has a history, they refer to that of the cell's points. */
  PetscReal          rest; /* bulk modulus of the part of the dilatation that bbar projects away [force/length^2] */
} BodyMaterial;

/*
   Returns the moduli at point q of a cell. If the law has a history, they are a copy in *own that refers to the history
   of this point.
*/
static inline const MaterialModuli *CellModuli(const MaterialModuli *cell, PetscInt q, MaterialModuli *own)
{
  if (!cell->history) return cell;
  *own = *cell;
  own->history += MATERIAL_HISTORY * q;
  return own;
}

/*
   points.c: functions of a law at the points of a pack. Each returns false if a point is inverted.
*/
PETSC_INTERN PetscBool PointsEnergy(const MaterialLaw *, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes *W);
PETSC_INTERN PetscBool PointsStress(const MaterialLaw *, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes P[9]);
PETSC_INTERN void PointsDilatation(const MaterialLaw *, PetscInt pack, PetscInt npoints, const Lanes H[9], Lanes C[9],
  Lanes *theta);
PETSC_INTERN PetscBool PointsTangent(const MaterialLaw *, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes A[81]);

/* Replaces the displacement gradient at point q by its elastic part */
static inline void CellElastic(const BodyMaterial *cell, PetscInt q, PetscReal H[9])
{
  if (cell->moduli.history) cell->law->elastic(cell->moduli.history + MATERIAL_HISTORY * q, H);
}

#define ELEMENT_STRAINS 10

/*
   Functions of a cell with nodes X[d][a] and displacements U[d][a]. If a point is inverted, `energy` returns
   PETSC_INFINITY, and the other functions return PETSC_FALSE with undefined results.
*/
typedef struct {
  PetscInt nnodes; /* number of nodes of the cells that the element supports; 0: any */
  PetscReal (
    *energy)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES], PetscReal U[3][CELL_MAX_NODES]);
  /* computes the derivative F[d][a] of the energy */
  PetscBool (*force)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal F[3][CELL_MAX_NODES]);
  /* computes the second derivative of the energy, K[(3 a + i) 3 n + 3 b + k]; U is not used if the law's tangent is
     constant. `before`: displacements from which the pressure in it is linearized (bbar.c); NULL: the pressure of U */
  PetscBool (*stiffness)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal before[3][CELL_MAX_NODES], PetscScalar K[]);
  /* computes the Cauchy stress averaged over the reference cell: xx yy zz xy yz zx */
  PetscBool (*cauchy)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal sigma[6]);
  /* computes for each point the volume, and the displacement gradient (9 values) and dilatation that the cell's
     energy uses, including plastic strain */
  void (*strains)(const CellBasis *, const BodyMaterial *, PetscReal X[3][CELL_MAX_NODES],
    PetscReal U[3][CELL_MAX_NODES], PetscReal w[], PetscReal H[][ELEMENT_STRAINS]);
} Element;

/*
   modes.c: computes det J0 J0^(-1) of a cell; the incompatible modes at point q, which has volume w; a Cholesky factor
*/
#define INCOMPATIBLE_MODES 12
PETSC_INTERN void IncompatibleCentre(PetscReal X[3][CELL_MAX_NODES], PetscReal cofactor[3][3]);
PETSC_INTERN void IncompatibleModes(const CellBasis *, PetscInt q, PetscReal w, PetscReal cofactor[3][3],
  PetscReal M[INCOMPATIBLE_MODES][9]);
PETSC_INTERN void IncompatibleFactor(PetscReal L[INCOMPATIBLE_MODES][INCOMPATIBLE_MODES]);

/* condensed.c: functions of an Element with incompatible modes, for laws that are not linear */
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

/* element.c: gets an element from the table */
PETSC_INTERN PetscErrorCode ElementGet(ElementType, PetscInt nnodes, const Element **);

typedef struct {
  Material         given; /* material that the caller has set */
  BodyMaterial     material;
  ElementType      type;
  const Element   *element; /* element of the body's cells; NULL on ranks without such cells */
  const CellBasis *basis;
  const CellBasis *mass;       /* basis with all points, for the mass */
  PetscBool        kept;       /* whether the body has a constant tangent and shares no vertex with a body that is
                                  assembled again */
  PetscInt         assemblies; /* number of assemblies of this body into any tangent */
  PetscBool        expands;
  PetscReal        expansion[9]; /* thermal expansion tensor [1/temperature] */
  PetscReal        density;      /* [mass/length^3] */
  PetscBool        rigid;
} Body;

/* Identifies the tangent that was assembled last, and its state. Any other matrix is assembled completely. */
typedef struct {
  PetscObjectId    id; /* 0: no tangent has been assembled */
  PetscObjectState state;
} AssembledTangent;

/*
   A section through a body. In the cells that it cuts, nodes beyond the section are displaced additionally by
   shortening x axis.
*/
typedef struct {
  PetscInt  body;
  PetscReal axis[3];    /* unit normal of the section */
  PetscReal shortening; /* [length] */
} BodySection;

struct _n_Elasticity {
  DM             dm;
  char           mattype[64];
  PetscBool      mattype_given; /* whether an option has set the type */
  CellBasis     *basis[5];      /* bases of hexahedra of order 1 and 2, of tetrahedra of order 1 and 2, and of
                                     hexahedra of order 2 with 2 points per axis; NULL: there are no such cells on this
                                     rank */
  PetscInt       nbodies;
  Body          *bodies;
  PetscInt       quadrature;     /* Gauss points per axis for order 1 */
  PetscInt       ncells, nnodes; /* number of cells and nodes on this rank; nodes are numbered as in the local
                                      section */
  PetscInt      *cellstart;      /* ncells + 1 entries, see cellnodes */
  PetscInt      *cellnodes;      /* nodes of the cells in tensor order; those of cell c start at
                                      cellnodes[cellstart[c]] */
  PetscInt      *cellbody;
  unsigned char *prescribed;  /* bit d of a node's entry: its component d is prescribed; NULL: no component is
                                   prescribed */
  Vec            springs;     /* stiffness of springs to the ground, one entry per row [force/length]; NULL: no
                                   springs */
  Mat            between;     /* stiffness of springs between unknowns [force/length]; NULL: no springs */
  PetscReal     *temperature; /* 4 values per cell, see ThermalSubtract(); NULL: no temperature */
  PetscBool      yields;      /* true if the law of any body has a history */
  PetscInt      *firstpoint;  /* index in `history` of the first point of each cell; PETSC_DECIDE if the law of the cell
                                   has no history; NULL if no law has one */
  PetscInt       npoints;     /* number of points with a history on this rank */
  PetscReal     *history;     /* MATERIAL_HISTORY values per point, at the last state of equilibrium */
  PetscInt       nsections;
  BodySection   *sections;
  PetscInt      *cellsection, *cellbeyond; /* per cell: its section, or PETSC_DECIDE if none; index of its first
                                                value in `beyond` */
  PetscReal     *beyond;                   /* for each node of a cut cell: 1 if it is beyond the section, otherwise
                                                0 */
  PetscInt       nbeyond;
  AssembledTangent assembled;
  Vec              before;             /* see ElasticitySetPressureBase(); NULL: none */
  PetscReal        inertia, viscosity; /* of tangents in a dynamic analysis: factor of the mass matrix, 0 in a static
                                          analysis; factor by which viscosity increases the stiffness, minus 1 */
  PetscBool        consistent, *light; /* true if the mass is consistent; for each local node: true if it has no
                                          mass; NULL: all nodes have mass */
};

/* locals.c: gets local values of a displacement (NULL: zero), and the coordinates */
PETSC_INTERN PetscErrorCode ElasticityGetLocals(Elasticity, Vec u, Vec *local, const PetscScalar **ul,
  const PetscScalar **x);
PETSC_INTERN PetscErrorCode ElasticityRestoreLocals(Elasticity, Vec *local, const PetscScalar **ul,
  const PetscScalar **x);

/* locals.c: gets the values of a local vector (3 per node) at a cell's nodes, sorted by component */
PETSC_INTERN void CellGather(PetscInt n, const PetscInt nodes[], const PetscScalar local[],
  PetscReal values[3][CELL_MAX_NODES]);

/* A cell with its coordinates and displacements */
typedef struct {
  PetscInt            n;
  const PetscInt     *nodes;
  const Body         *body;
  const BodyMaterial *material; /* the body's material, or `own` */
  BodyMaterial        own;      /* copy of the body's material that refers to the cell's history */
  PetscReal           X[3][CELL_MAX_NODES], U[3][CELL_MAX_NODES];
} CellState;

/* thermal.c: subtracts the free thermal displacement of a cell from its displacement */
PETSC_INTERN void ThermalSubtract(const PetscReal temperature[4], CellState *);

/* cell.c: gets cell c from the local coordinates x and displacements u; subtracts the thermal displacement and adds
   the shortening of a section */
PETSC_INTERN void ElasticityGetCell(Elasticity, PetscInt c, const PetscScalar x[], const PetscScalar u[], CellState *);

#endif
