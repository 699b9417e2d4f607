/*
   The slip of the rows of pairs with friction. It is the displacement of the mortar side relative to the nonmortar
   side, along the tangents t1, t2 of the row, averaged like the mortar gap:

     slip_A = (1/m_A) int phi_A (u2 - u1).t  [length]

   Here u is any displacement of the vertices. A rigid motion of both faces gives no slip where the faces touch. If a
   row has no slip along an axis, or across a symmetry plane (no_slip.c), its tangent in that direction is set to zero.
*/
#include "assemblyimpl.h"

/* Projects the unit vector v to the plane perpendicular to n and scales the result t to length 1. Returns false if v is
   almost parallel to n. */
static PetscBool SlipTangentOf(const PetscReal n[3], const PetscReal v[3], PetscReal t[3])
{
  const PetscReal least = 0.1, along = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];

  for (PetscInt c = 0; c < 3; ++c) t[c] = v[c] - along * n[c];
  return (PetscBool)(VectorScaleToUnit(t) > least);
}

/* Computes the unit tangent t that is nearest to a coordinate axis. Returns false if the axis is almost parallel to
   n. */
static PetscBool SlipTangentAlong(const PetscReal n[3], PetscInt axis, PetscReal t[3])
{
  PetscReal v[3] = {0.0, 0.0, 0.0};

  v[axis] = 1.0;
  return SlipTangentOf(n, v, t);
}

/* Computes two tangents at a vertex on a symmetry plane: a unit tangent in the plane, and zero in place of the tangent
   across the plane. Returns false if the contact face is parallel to the plane. */
static PetscBool SlipTangentsInPlane(const PetscReal n[3], const PetscReal plane[3], PetscReal t[6])
{
  if (!SlipTangentOf(n, plane, t + 3)) return PETSC_FALSE;
  VectorCross(t + 3, n, t);
  for (PetscInt d = 0; d < 3; ++d) t[3 + d] = 0.0;
  return PETSC_TRUE;
}

/* Computes two unit tangents t perpendicular to n and to each other. held: bit c is set if there is no slip along axis
   c; the tangent along such an axis is set to zero */
static void SlipTangents(const PetscReal n[3], PetscInt no_slip, PetscReal t[6])
{
  PetscInt  axis = 0;
  PetscReal along[3];

  for (PetscInt c = 1; c < 3; ++c)
    if (PetscAbsReal(n[c]) < PetscAbsReal(n[axis])) axis = c;
  for (PetscInt c = 0; c < 3; ++c)
    if (no_slip >> c & 1 && SlipTangentAlong(n, c, along)) axis = c;
  (void)SlipTangentAlong(n, axis, t + 3);
  VectorCross(t + 3, n, t);
  for (PetscInt c = 0; c < 3; ++c) {
    if (!(no_slip >> c & 1) || !SlipTangentAlong(n, c, along)) continue;
    for (PetscInt d = 0; d < 3; ++d) t[(c == axis ? 3 : 0) + d] = 0.0;
  }
}

/* Sets the tangent t to zero if its component along a held axis is larger than 1/2 */
static void SlipDropHeld(PetscInt no_slip, PetscReal t[3])
{
  const PetscReal half  = 0.5;
  PetscReal       along = 0.0;

  for (PetscInt c = 0; c < 3; ++c)
    if (no_slip >> c & 1) along = PetscMax(along, PetscAbsReal(t[c]));
  for (PetscInt c = 0; c < 3; ++c) t[c] = along > half ? 0.0 : t[c];
}

/* Computes the two tangents of a row; those along directions in which its vertex is held are zero */
static void SlipRowTangents(Contact contact, PetscInt row, PetscReal t[6])
{
  const PetscReal *n       = &contact->rows.normal[3 * row];
  const PetscInt   no_slip = contact->rows.no_slip[row], plane = no_slip / 8 - 1;
  PetscReal        across[3];

  if (plane >= 0) {
    for (PetscInt c = 0; c < 3; ++c) across[c] = contact->displacements[plane].normal[c];
    (void)VectorScaleToUnit(across);
    if (SlipTangentsInPlane(n, across, t)) {
      SlipDropHeld(no_slip, t);
      return;
    }
  }
  SlipTangents(n, no_slip % 8, t);
}

/* Returns the covered area of a row, int phi_A over the mortar side, from the row's couplings [length^2] */
static PetscReal SlipCover(PetscInt n, const PetscScalar values[])
{
  PetscReal sum = 0.0;

  for (PetscInt k = 0; k < n; ++k) sum += 0.5 * PetscAbsScalar(values[k]);
  return sum;
}

/* Inserts the two slip rows `to` and `to` + 1, computed from a row of the couplings. *cover: covered area of the row
   [length^2] */
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

/* Collective. Creates a matrix with two empty rows for each row of J, preallocated for rows with friction */
static PetscErrorCode SlipCreateMatrix(Contact contact, Mat couplings, const PetscInt kept[], ContactLinearization lin,
  Mat *slip)
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
    diagonal, 0, offdiagonal, slip));
  PetscCall(PetscFree2(diagonal, offdiagonal));
  PetscFunctionReturn(0);
}

/* Collective. Creates lin->slip, lin->tangent and lin->covered for the rows that remain. couplings: int phi_A (N2 - N1)
   of all rows with vertices [length^2] */
PetscErrorCode ContactSlipCreate(Contact contact, Mat couplings, const PetscInt kept[], ContactLinearization lin)
{
  const PetscScalar *mass;
  PetscInt           rstart, start;

  PetscFunctionBegin;
  PetscCall(ContactFindNoSlip(contact));
  PetscCall(SlipCreateMatrix(contact, couplings, kept, lin, &lin->slip));
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
    /* Dual functions, and the weights of a rigid surface's corners, have negative values. SlipCover(), a sum of
       magnitudes, would therefore be too large. */
    if (ContactPairIsDual(pair) || pair->formula) lin->covered[k] = PetscMin(lin->covered[k], PetscRealPart(mass[k]));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(MatAssemblyBegin(lin->slip, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(lin->slip, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* Creates the part of the slip by the mortar side, after ContactSlipCreate(). couplings: integrals of rows with its
   vertices */
PetscErrorCode ContactSlipCreateMortar(Contact contact, Mat couplings, const PetscInt kept[], ContactLinearization lin)
{
  const PetscScalar *mass;
  PetscReal          cover;
  PetscInt           rstart, start;

  PetscFunctionBegin;
  PetscCall(SlipCreateMatrix(contact, couplings, kept, lin, &lin->mortar_slip));
  PetscCall(MatGetOwnershipRange(couplings, &rstart, NULL));
  PetscCall(MatGetOwnershipRange(lin->mortar_slip, &start, NULL));
  PetscCall(VecGetArrayRead(lin->mass, &mass));
  for (PetscInt k = 0; k < lin->nlocal; ++k) {
    if (!contact->pairs[lin->pair[k]].frictional) continue;
    PetscCall(SlipFillRow(couplings, rstart + kept[k], PetscRealPart(mass[k]), &lin->tangent[6 * k], start + 2 * k,
      lin->mortar_slip, &cover));
  }
  PetscCall(VecRestoreArrayRead(lin->mass, &mass));
  PetscCall(MatAssemblyBegin(lin->mortar_slip, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(lin->mortar_slip, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}
