/*
   Slip of the rows of pairs with friction: the displacement of the mortar side relative to the nonmortar side along
   the tangents t1, t2 of the row, averaged like the mortar gap, slip_A = (1/m_A) int phi_A (u2 - u1).t, for any
   displacement u of the vertices. A rigid motion of both faces gives no slip where both touch. If a row has no slip
   along an axis, or across a plane (held.c), the tangent in that direction is zero.
*/
#include "assemblyimpl.h"

/* t: the unit vector v projected to the plane normal to n, scaled to length 1; false if almost nothing is left */
static PetscBool SlipTangentOf(const PetscReal n[3], const PetscReal v[3], PetscReal t[3])
{
  const PetscReal least = 0.1, along = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];

  for (PetscInt c = 0; c < 3; ++c) t[c] = v[c] - along * n[c];
  return (PetscBool)(VectorScaleToUnit(t) > least);
}

static PetscBool SlipTangentAlong(const PetscReal n[3], PetscInt axis, PetscReal t[3])
{
  PetscReal v[3] = {0.0, 0.0, 0.0};

  v[axis] = 1.0;
  return SlipTangentOf(n, v, t);
}

/* t: two unit tangents at a vertex on a symmetry plane. The one across the plane is set to zero. Returns false if
   the contact face is parallel to the plane. */
static PetscBool SlipTangentsInPlane(const PetscReal n[3], const PetscReal plane[3], PetscReal t[6])
{
  if (!SlipTangentOf(n, plane, t + 3)) return PETSC_FALSE;
  VectorCross(t + 3, n, t);
  for (PetscInt d = 0; d < 3; ++d) t[3 + d] = 0.0;
  return PETSC_TRUE;
}

/* t: two unit tangents normal to n and to each other. held: bits of the axes without slip; tangents along these are
   set to zero */
static void SlipTangents(const PetscReal n[3], PetscInt held, PetscReal t[6])
{
  PetscInt  axis = 0;
  PetscReal along[3];

  for (PetscInt c = 1; c < 3; ++c)
    if (PetscAbsReal(n[c]) < PetscAbsReal(n[axis])) axis = c;
  for (PetscInt c = 0; c < 3; ++c)
    if (held >> c & 1 && SlipTangentAlong(n, c, along)) axis = c;
  (void)SlipTangentAlong(n, axis, t + 3);
  VectorCross(t + 3, n, t);
  for (PetscInt c = 0; c < 3; ++c) {
    if (!(held >> c & 1) || !SlipTangentAlong(n, c, along)) continue;
    for (PetscInt d = 0; d < 3; ++d) t[(c == axis ? 3 : 0) + d] = 0.0;
  }
}

/* Sets a tangent to zero if its largest component is along a held axis */
static void SlipDropHeld(PetscInt held, PetscReal t[3])
{
  const PetscReal half  = 0.5;
  PetscReal       along = 0.0;

  for (PetscInt c = 0; c < 3; ++c)
    if (held >> c & 1) along = PetscMax(along, PetscAbsReal(t[c]));
  for (PetscInt c = 0; c < 3; ++c) t[c] = along > half ? 0.0 : t[c];
}

/* Tangents of a row, without directions in which its vertex is held */
static void SlipRowTangents(Contact contact, PetscInt row, PetscReal t[6])
{
  const PetscReal *n    = &contact->rows.normal[3 * row];
  const PetscInt   held = contact->rows.held[row], plane = held / 8 - 1;
  PetscReal        across[3];

  if (plane >= 0) {
    for (PetscInt c = 0; c < 3; ++c) across[c] = contact->displacements[plane].normal[c];
    (void)VectorScaleToUnit(across);
    if (SlipTangentsInPlane(n, across, t)) {
      SlipDropHeld(held, t);
      return;
    }
  }
  SlipTangents(n, held % 8, t);
}

/* Covered area of a row: int phi_A over the mortar side, from its coupling entries [length^2] */
static PetscReal SlipCover(PetscInt n, const PetscScalar values[])
{
  PetscReal sum = 0.0;

  for (PetscInt k = 0; k < n; ++k) sum += 0.5 * PetscAbsScalar(values[k]);
  return sum;
}

/* Computes the two slip rows from a row of the couplings; slip NULL: only counts entries */
static PetscErrorCode SlipFillRow(Mat couplings, PetscInt row, PetscReal mass, const PetscReal tangent[6], PetscInt to,
  Mat slip, PetscReal *cover)
{
  const PetscInt    *node;
  const PetscScalar *value;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MatGetRow(couplings, row, &n, &node, &value));
  *cover = SlipCover(n, value);
  for (PetscInt k = 0; k < n; ++k) {
    const PetscInt rows[2] = {to, to + 1}, columns[3] = {3 * node[k], 3 * node[k] + 1, 3 * node[k] + 2};
    PetscScalar    entries[6];

    for (PetscInt e = 0; e < 6; ++e) entries[e] = value[k] * tangent[e] / mass;
    PetscCall(MatSetValues(slip, 2, rows, 3, columns, entries, INSERT_VALUES));
  }
  PetscCall(MatRestoreRow(couplings, row, &n, &node, &value));
  PetscFunctionReturn(0);
}

/* Creates an empty matrix with two rows for each row of J, and room for entries in rows with friction */
static PetscErrorCode SlipCreateMatrix(Contact contact, Mat couplings, const PetscInt kept[], ContactLinearization lin)
{
  PetscInt rstart, cstart, cend, *diagonal, *offdiagonal;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(couplings, &rstart, NULL));
  PetscCall(MatGetOwnershipRangeColumn(couplings, &cstart, &cend));
  PetscCall(PetscCalloc2(2 * lin->nlocal, &diagonal, 2 * lin->nlocal, &offdiagonal));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    const PetscInt *node;
    PetscInt        n;

    if (!contact->pairs[lin->pair[k]].frictional) continue;
    PetscCall(MatGetRow(couplings, rstart + kept[k], &n, &node, NULL));
    for (PetscInt b = 0; b < n; ++b) diagonal[2 * k] += 3 * (node[b] >= cstart && node[b] < cend);
    offdiagonal[2 * k]     = 3 * n - diagonal[2 * k];
    diagonal[2 * k + 1]    = diagonal[2 * k];
    offdiagonal[2 * k + 1] = offdiagonal[2 * k];
    PetscCall(MatRestoreRow(couplings, rstart + kept[k], &n, &node, NULL));
  }
  PetscCall(MatCreateAIJ(contact->comm, 2 * lin->nlocal, 3 * (cend - cstart), PETSC_DETERMINE, PETSC_DETERMINE, 0,
    diagonal, 0, offdiagonal, &lin->slip));
  PetscCall(PetscFree2(diagonal, offdiagonal));
  PetscFunctionReturn(0);
}

/* Sets lin->slip, lin->tangent and lin->covered of the kept rows. couplings: integrals of rows with vertices */
PetscErrorCode ContactSlipCreate(Contact contact, Mat couplings, const PetscInt kept[], ContactLinearization lin)
{
  const PetscScalar *mass;
  PetscInt           rstart, start;

  PetscFunctionBegin;
  PetscCall(ContactFindHeld(contact));
  PetscCall(SlipCreateMatrix(contact, couplings, kept, lin));
  PetscCall(PetscCalloc1(6 * lin->nlocal, &lin->tangent));
  PetscCall(PetscCalloc1(lin->nlocal, &lin->covered));
  PetscCall(MatGetOwnershipRange(couplings, &rstart, NULL));
  PetscCall(MatGetOwnershipRange(lin->slip, &start, NULL));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    const ContactPairData *pair = &contact->pairs[lin->pair[k]];

    SlipRowTangents(contact, kept[k], &lin->tangent[6 * k]);
    if (!pair->frictional) continue;
    PetscCall(SlipFillRow(couplings, rstart + kept[k], PetscRealPart(mass[k]), &lin->tangent[6 * k], start + 2 * k,
      lin->slip, &lin->covered[k]));
    /* Dual functions have negative values, so that SlipCover(), a sum of magnitudes, would be too large */
    if (pair->gap == GAP_DUAL || pair->dual) lin->covered[k] = PetscMin(lin->covered[k], PetscRealPart(mass[k]));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(MatAssemblyBegin(lin->slip, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(lin->slip, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}
