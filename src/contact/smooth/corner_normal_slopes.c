/* Derivatives of the normals of corner_normals.c with respect to the nodes' coordinates. The chain rule is applied in
   the order opposite to the computation. Row i of a 3 x 3 matrix holds the derivatives of the normal's component i. */
#include "smoothimpl.h"

/* Computes C = A + factor a b^T. A may be C; A = NULL stands for 0. */
static void AddOuter(const PetscReal A[9], PetscReal factor, const PetscReal a[3], const PetscReal b[3], PetscReal C[9])
{
  for (PetscInt i = 0; i < 9; ++i) C[i] = (A ? A[i] : 0.0) + factor * a[i / 3] * b[i % 3];
}

/* Computes b = A a */
static void Times(const PetscReal A[9], const PetscReal a[3], PetscReal b[3])
{
  for (PetscInt i = 0; i < 3; ++i) b[i] = VectorDot(&A[3 * i], a);
}

/* Applies the chain rule to a cross product. A is the derivative with respect to v x a (factor 1) or a x v (factor -1);
   B is the derivative with respect to v. */
static void ThroughCross(const PetscReal A[9], const PetscReal a[3], PetscReal factor, PetscReal B[9])
{
  for (PetscInt i = 0; i < 3; ++i) {
    PetscReal row[3];

    VectorCross(a, &A[3 * i], row);
    for (PetscInt c = 0; c < 3; ++c) B[3 * i + c] = factor * row[c];
  }
}

/* Applies the chain rule to a unit vector n = v / length. A is the derivative with respect to n; B is the derivative
   with respect to v. */
static void ThroughUnit(const PetscReal A[9], const PetscReal n[3], PetscReal length, PetscReal B[9])
{
  PetscReal along[3];

  Times(A, n, along);
  AddOuter(A, -1.0, along, n, B);
  for (PetscInt i = 0; i < 9; ++i) B[i] = length > 0.0 ? B[i] / length : 0.0;
}

/* Appends the block A of a node, or only counts it */
static void AddBlock(PetscInt node, const PetscReal A[9], ContactNormalSlopes *slopes)
{
  if (slopes->node) {
    slopes->node[slopes->n] = node;
    for (PetscInt i = 0; i < 9; ++i) slopes->value[9 * slopes->n + i] = A[i];
  }
  ++slopes->n;
}

/* Adds factor A, a derivative with respect to the node at a corner. The position of a mirror image depends on its real
   node, with the opposite sign along the axis of the mirror plane, and on the nodes on the plane. */
static void AddNode(const ContactRing *ring, PetscInt corner, PetscReal factor, const PetscReal A[9],
  ContactNormalSlopes *slopes)
{
  const PetscInt node  = ring->s.node[corner];
  ContactImage   image = {node, {-1, -1, -1}};
  PetscReal      B[9];

  if (node >= ring->nreal) image = ring->image[node - ring->nreal];
  for (PetscInt i = 0; i < 9; ++i) B[i] = (image.plane[i % 3] < 0 ? factor : -factor) * A[i];
  AddBlock(image.of, B, slopes);
  for (PetscInt c = 0; c < 3; ++c) {
    if (image.plane[c] < 0) continue;
    for (PetscInt i = 0; i < 9; ++i) B[i] = i % 3 == c ? 2.0 * factor * A[i] : 0.0;
    AddBlock(image.plane[c], B, slopes);
  }
}

/* Adds A, a derivative with respect to the edge vector from a corner to the next corner (`after`), or to the previous
   one */
static void AddEdge(const ContactRing *ring, PetscInt corner, PetscBool after, const PetscReal A[9],
  ContactNormalSlopes *slopes)
{
  AddNode(ring, after ? MeshCornerAfter(&ring->s, corner) : MeshCornerBefore(&ring->s, corner), 1.0, A, slopes);
  AddNode(ring, corner, -1.0, A, slopes);
}

/* Adds A, a derivative with respect to the unit normal of MeshCornerFanNormal() */
static void AddFan(const ContactRing *ring, PetscInt first, PetscInt last, const PetscReal A[9],
  ContactNormalSlopes *slopes)
{
  PetscReal n[3], S[9];
  PetscReal length = MeshCornerFanNormal(&ring->s, first, last, n);

  ThroughUnit(A, n, length, S);
  for (PetscInt corner = first;; corner = ring->s.twin[MeshCornerBefore(&ring->s, corner)]) {
    PetscReal edge[2][3], product[3], along[3], B[9], squares[2], weight;

    MeshCornerEdges(&ring->s, corner, edge[0], edge[1]);
    VectorCross(edge[0], edge[1], product);
    for (PetscInt k = 0; k < 2; ++k) squares[k] = VectorDot(edge[k], edge[k]);
    weight = squares[0] * squares[1] > 0.0 ? 1.0 / (squares[0] * squares[1]) : 0.0;
    Times(S, product, along);
    for (PetscInt k = 0; k < 2; ++k) {
      ThroughCross(S, edge[1 - k], k ? -weight : weight, B);
      AddOuter(B, weight > 0.0 ? -2.0 * weight / squares[k] : 0.0, along, edge[k], B);
      AddEdge(ring, corner, (PetscBool)(k == 0), B, slopes);
    }
    if (corner == last) break;
  }
}

/* Adds A, a derivative with respect to the mean normal at a corner */
static void AddMean(const ContactRing *ring, PetscInt corner, const PetscReal A[9], ContactNormalSlopes *slopes)
{
  PetscInt first, last;

  (void)MeshCornerFan(&ring->s, corner, &first, &last);
  AddFan(ring, first, last, A, slopes);
}

/*
   Adds A, a derivative with respect to the normal that CorrectCorner() computes, before it is scaled. That normal is n
   + b_0 d_0 + b_1 d_1, where n is the mean normal and d are the edges. D: dual vectors of the edges, D_i.d_j = 1 for i
   = j and 0 otherwise; m: mean normals at the other ends of the edges
*/
static void AddCorrectedCorner(const ContactRing *ring, PetscInt corner, const PetscReal n[3], const PetscReal A[9],
  ContactNormalSlopes *slopes)
{
  PetscReal d[2][3], m[2][3], D[2][3] = {{0}}, G[3], b[2] = {0}, mean[9], B[9], AD[2][3], det;

  MeshCornerEdges(&ring->s, corner, d[0], d[1]);
  for (PetscInt i = 0; i < 2; ++i) {
    MeshCornerMeanNormal(&ring->s, i ? MeshCornerBefore(&ring->s, corner) : MeshCornerAfter(&ring->s, corner), m[i]);
    G[i] = VectorDot(d[i], d[i]);
  }
  G[2] = VectorDot(d[0], d[1]);
  det  = G[0] * G[1] - G[2] * G[2];
  if (det > MESH_FLAT_CORNER * G[0] * G[1]) {
    for (PetscInt i = 0; i < 2; ++i) {
      for (PetscInt c = 0; c < 3; ++c) D[i][c] = (G[1 - i] * d[i][c] - G[2] * d[1 - i][c]) / det;
    }
    for (PetscInt j = 0; j < 2; ++j) {
      for (PetscInt i = 0; i < 2; ++i) b[j] -= VectorDot(D[j], D[i]) * (VectorDot(n, d[i]) + VectorDot(m[i], d[i]));
    }
  }
  for (PetscInt i = 0; i < 9; ++i) mean[i] = A[i];
  for (PetscInt i = 0; i < 2; ++i) {
    Times(A, D[i], AD[i]);
    AddOuter(mean, -1.0, AD[i], d[i], mean);
    AddOuter(NULL, -1.0, AD[i], d[i], B);
    AddMean(ring, i ? MeshCornerBefore(&ring->s, corner) : MeshCornerAfter(&ring->s, corner), B, slopes);
  }
  AddMean(ring, corner, mean, slopes);
  for (PetscInt i = 0; i < 2; ++i) {
    PetscReal sum[3];

    for (PetscInt c = 0; c < 3; ++c) sum[c] = n[c] + m[i][c] + b[0] * d[0][c] + b[1] * d[1][c];
    AddOuter(NULL, -1.0, AD[i], sum, B);
    for (PetscInt k = 0; k < 9; ++k) B[k] += b[i] * mean[k];
    AddEdge(ring, corner, (PetscBool)(i == 0), B, slopes);
  }
}

/* Sums that CorrectBorder() computes over the edges d_k that lead away from the border. With c_k = across.d_k and r_k =
   -(n + m_k).d_k, `squares` is sum c_k^2 and `slope` is sum r_k c_k / sum c_k^2. */
typedef struct {
  PetscReal along[3], across[3], length, slope, squares;
} Border;

/* Computes the sums at the node of an open fan of corners with the mean normal n */
static void BorderCreate(const ContactRing *ring, PetscInt first, PetscInt last, const PetscReal n[3], Border *border)
{
  PetscReal after[3], before[3], d[3], m[3], sum = 0.0;

  MeshCornerEdges(&ring->s, first, after, d);
  MeshCornerEdges(&ring->s, last, d, before);
  for (PetscInt c = 0; c < 3; ++c) border->along[c] = after[c] - before[c];
  VectorCross(n, border->along, border->across);
  border->length  = VectorScaleToUnit(border->across);
  border->squares = 0.0;
  for (PetscInt corner = first; corner != last; corner = ring->s.twin[MeshCornerBefore(&ring->s, corner)]) {
    MeshCornerEdges(&ring->s, corner, after, d);
    MeshCornerMeanNormal(&ring->s, MeshCornerBefore(&ring->s, corner), m);
    sum -= (VectorDot(n, d) + VectorDot(m, d)) * VectorDot(border->across, d);
    border->squares += PetscSqr(VectorDot(border->across, d));
  }
  border->slope = border->squares > 0.0 ? sum / border->squares : 0.0;
}

/* Adds A, a derivative with respect to the normal that CorrectBorder() computes, before it is scaled: the mean normal n
   plus slope times `across` */
static void AddCorrectedBorder(const ContactRing *ring, PetscInt first, PetscInt last, const PetscReal n[3],
  const PetscReal A[9], ContactNormalSlopes *slopes)
{
  PetscReal AX[3], mean[9], across[9], B[9];
  Border    border;

  BorderCreate(ring, first, last, n, &border);
  Times(A, border.across, AX);
  for (PetscInt i = 0; i < 9; ++i) {
    mean[i]   = A[i];
    across[i] = border.slope * A[i];
  }
  for (PetscInt corner = first; corner != last; corner = ring->s.twin[MeshCornerBefore(&ring->s, corner)]) {
    PetscReal       after[3], d[3], m[3], c, r, by_edge[3];
    const PetscReal inverse = border.squares > 0.0 ? 1.0 / border.squares : 0.0;

    MeshCornerEdges(&ring->s, corner, after, d);
    MeshCornerMeanNormal(&ring->s, MeshCornerBefore(&ring->s, corner), m);
    c = VectorDot(border.across, d);
    r = -VectorDot(n, d) - VectorDot(m, d) - 2.0 * border.slope * c;
    for (PetscInt k = 0; k < 3; ++k) by_edge[k] = -c * (n[k] + m[k]) + r * border.across[k];
    AddOuter(mean, -c * inverse, AX, d, mean);
    AddOuter(across, r * inverse, AX, d, across);
    AddOuter(NULL, inverse, AX, by_edge, B);
    AddEdge(ring, corner, PETSC_FALSE, B, slopes);
    AddOuter(NULL, -c * inverse, AX, d, B);
    AddMean(ring, MeshCornerBefore(&ring->s, corner), B, slopes);
  }
  ThroughUnit(across, border.across, border.length, across);
  ThroughCross(across, border.along, 1.0, B);
  for (PetscInt i = 0; i < 9; ++i) mean[i] += B[i];
  AddFan(ring, first, last, mean, slopes);
  ThroughCross(across, n, -1.0, B);
  AddEdge(ring, first, PETSC_TRUE, B, slopes);
  for (PetscInt i = 0; i < 9; ++i) B[i] = -B[i];
  AddEdge(ring, last, PETSC_FALSE, B, slopes);
}

/* Computes the derivative blocks of the normal at a corner. Their number and their nodes do not depend on the
   displacement. */
void ContactRingNormalSlopes(const ContactRing *ring, PetscInt corner, ContactNormalSlopes *slopes)
{
  const PetscReal identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  PetscInt        first, last;
  PetscReal       n[3], corrected[3], length, A[9];

  if (MeshCornerFan(&ring->s, corner, &first, &last)) {
    AddFan(ring, first, last, identity, slopes);
    return;
  }
  (void)MeshCornerFanNormal(&ring->s, first, last, n);
  for (PetscInt c = 0; c < 3; ++c) corrected[c] = n[c];
  MeshCornerCorrectNormal(&ring->s, first, last, corrected);
  length = VectorScaleToUnit(corrected);
  ThroughUnit(identity, corrected, length, A);
  if (first == last) AddCorrectedCorner(ring, corner, n, A, slopes);
  else AddCorrectedBorder(ring, first, last, n, A, slopes);
}
