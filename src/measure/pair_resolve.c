/*
   Smooths pressures that the mortar side cannot resolve. If the nonmortar side is finer and stiffer than the mortar
   facets, few rows carry all of the force. The rows between them have no pressure, and gaps that are small compared
   with the mortar facets' deformation. The mortar side only responds to means over its shape functions. Therefore the
   pressures of open rows that are surrounded by closed ones, and of the rows around them, are replaced: first the rows'
   values are averaged at the mortar nodes, weighted by the shared area, then these means are interpolated back to
   the rows. The sum of value x area over the rows is preserved.
*/
#include "pair_rows.h"
#include "src/state/contact_state.h"

static const PetscReal resolve_enclosed = 0.4; /* limit of the distance between the centres of closed rows and of all
                                                  rows, relative to their spread; the ratio is about 0.57 at a
                                                  straight border of contact, and about 0.2 between strips of contact */

/* Computes the mean of the marked rows' values at the mortar nodes, interpolated back to the rows. Collective. */
static PetscErrorCode ResolveMean(const PairRows *rows, Vec mark, Vec value, Vec mean)
{
  Vec weight, node;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->sides, &weight));
  PetscCall(VecDuplicate(rows->sides, &node));
  PetscCall(VecPointwiseMult(mean, mark, value));
  PetscCall(MatMultTranspose(rows->shares, mark, weight));
  PetscCall(MatMultTranspose(rows->shares, mean, node));
  PetscCall(VecQuotient_AMGF(node, node, weight)); /* a quotient by 0 is 0 */
  PetscCall(PairGather(rows, node, mean));
  PetscCall(VecDestroy(&node));
  PetscCall(VecDestroy(&weight));
  PetscFunctionReturn(0);
}

/* Computes the undeformed coordinates of the rows' vertices relative to the mean of all, and the sum of their squares
   [length; length^2]. place[4]: a work vector */
static PetscErrorCode ResolvePlaces(DM dm, const VertexPlaces *places, ContactState *solved, const PairRows *rows,
  Vec place[5])
{
  PetscSection       global;
  const PetscScalar *x;
  PetscScalar      **a, sum, all;
  PetscInt           first, i;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(VecGetOwnershipRange(places->x, &first, NULL));
  PetscCall(VecGetArrayRead(places->x, &x));
  PetscCall(VecGetArrays(place, 3, &a));
  for (PetscInt r = 0; r < rows->n; ++r) {
    PetscCall(PetscSectionGetOffset(global, solved->linearization->vertex[r], &i));
    for (PetscInt c = 0; c < 3; ++c) a[c][r] = x[i - first + c];
  }
  PetscCall(VecRestoreArrays(place, 3, &a));
  PetscCall(VecRestoreArrayRead(places->x, &x));
  PetscCall(VecSum(rows->value[ROW_AREA], &all));
  PetscCall(VecZeroEntries(place[3]));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecDot(place[c], rows->value[ROW_AREA], &sum));
    PetscCall(VecShift(place[c], -sum / all));
    PetscCall(VecPointwiseMult(place[4], place[c], place[c]));
    PetscCall(VecAXPY(place[3], 1.0, place[4]));
  }
  PetscFunctionReturn(0);
}

/*
   Unmarks open rows that closed rows do not surround. A row remains marked if the centre of the closed rows within two
   mortar facets is close to the centre of all rows there, relative to their spread. This excludes open rows beside the
   contact area.
*/
static PetscErrorCode ResolveEnclosed(const Measured *at, const PairRows *rows, Vec covered, Vec open)
{
  Vec          *place, *mean;
  PetscScalar **m, *o;

  PetscFunctionBegin;
  PetscCall(VecDuplicateVecs(open, 5, &place));
  PetscCall(VecDuplicateVecs(open, 7, &mean)); /* of all rows: places and squares; of closed rows: places */
  PetscCall(ResolvePlaces(at->dm, &at->places, at->solved, rows, place));
  for (PetscInt c = 0; c < 7; ++c)
    PetscCall(ResolveMean(rows, c < 4 ? covered : rows->value[ROW_CLOSED], place[c % 4], mean[c]));
  PetscCall(VecGetArrays(mean, 7, &m));
  PetscCall(VecGetArray(open, &o));
  for (PetscInt r = 0; r < rows->n; ++r) {
    PetscReal spread = PetscRealPart(m[3][r]), off = 0.0;

    for (PetscInt c = 0; c < 3; ++c) {
      spread -= PetscSqr(PetscRealPart(m[c][r]));
      off += PetscSqr(PetscRealPart(m[4 + c][r] - m[c][r]));
    }
    if (off > PetscSqr(resolve_enclosed) * spread) o[r] = 0.0;
  }
  PetscCall(VecRestoreArray(open, &o));
  PetscCall(VecRestoreArrays(mean, 7, &m));
  PetscCall(VecDestroyVecs(7, &mean));
  PetscCall(VecDestroyVecs(5, &place));
  PetscFunctionReturn(0);
}

/*
   Marks the rows whose gap the mortar pressure would close by a small strain of the mortar facets, and which share a
   mortar node with an enclosed open row. mark: 1 for these rows; *any: whether any rank has such a row. work: three
   vectors
*/
static PetscErrorCode ResolveMark(const Measured *at, PetscReal young, const PairRows *rows, Vec mark, Vec work[],
  PetscBool *any)
{
  const Vec          covered = work[0], mean = work[1], open = work[2];
  const PetscScalar *z;
  PetscScalar      **a, *m;
  PetscReal          largest;

  PetscFunctionBegin;
  PetscCall(VecQuotient_AMGF(covered, rows->value[ROW_AREA], rows->value[ROW_AREA])); /* a quotient by 0 is 0 */
  PetscCall(ResolveMean(rows, covered, rows->value[ROW_PRESSURE], mean));
  PetscCall(VecGetArrayRead(mean, &z));
  PetscCall(VecGetArrays(rows->value, ROW_VALUES, &a));
  PetscCall(VecGetArrayWrite(mark, &m));
  for (PetscInt r = 0; r < rows->n; ++r)
    m[r] = PetscRealPart(a[ROW_AREA][r]) > 0.0 &&
           PairIsClosed(PetscRealPart(z[r]), PetscRealPart(a[ROW_GAP][r]), young, PetscRealPart(a[ROW_FACING][r]));
  PetscCall(VecRestoreArrayWrite(mark, &m));
  PetscCall(VecRestoreArrays(rows->value, ROW_VALUES, &a));
  PetscCall(VecRestoreArrayRead(mean, &z));
  PetscCall(VecPointwiseMult(open, mark, rows->value[ROW_CLOSED]));
  PetscCall(VecAYPX(open, -1.0, mark));
  PetscCall(VecNorm(open, NORM_INFINITY, &largest));
  if (largest > 0.0) PetscCall(ResolveEnclosed(at, rows, covered, open));
  if (largest > 0.0) PetscCall(VecNorm(open, NORM_INFINITY, &largest));
  *any = (PetscBool)(largest > 0.0);
  if (!*any) PetscFunctionReturn(0);
  PetscCall(ResolveMean(rows, covered, open, mean));
  PetscCall(VecGetArrayRead(mean, &z));
  PetscCall(VecGetArray(mark, &m));
  for (PetscInt r = 0; r < rows->n; ++r) m[r] *= PetscRealPart(z[r]) > PETSC_SQRT_MACHINE_EPSILON;
  PetscCall(VecRestoreArray(mark, &m));
  PetscCall(VecRestoreArrayRead(mean, &z));
  PetscFunctionReturn(0);
}

/*
   Replaces the values of marked rows by their means over mortar facets: pressure, gap, and those of friction. A row
   slips if slipping rows carry more than half of its pressure. mean: a work vector
*/
static PetscErrorCode ResolveValues(PairRows *rows, Vec mark, Vec mean)
{
  const PetscScalar *m, *to;
  PetscScalar      **a;

  PetscFunctionBegin;
  PetscCall(VecGetArrayRead(mark, &m));
  for (PetscInt k = ROW_GAP; k < ROW_SUMS; ++k) {
    const PetscBool resolved = (PetscBool)(k < ROW_SHEAR || (rows->frictional && (k < ROW_EVEN || k >= ROW_SLIPPING)));

    if (!resolved) continue;
    PetscCall(ResolveMean(rows, mark, rows->value[k], mean));
    PetscCall(VecGetArrayRead(mean, &to));
    PetscCall(VecGetArrays(&rows->value[k], 1, &a));
    for (PetscInt r = 0; r < rows->n; ++r) a[0][r] = PetscRealPart(m[r]) > 0.0 ? to[r] : a[0][r];
    PetscCall(VecRestoreArrays(&rows->value[k], 1, &a));
    PetscCall(VecRestoreArrayRead(mean, &to));
  }
  PetscCall(VecGetArrays(rows->value, ROW_VALUES, &a));
  for (PetscInt r = 0; r < rows->n; ++r) {
    const PetscScalar pressure = a[ROW_PRESSURE][r];

    if (!(PetscRealPart(m[r]) > 0.0)) continue;
    a[ROW_CLOSED][r]   = 1.0;
    a[ROW_LENGTH][r]   = a[ROW_FACING][r];
    a[ROW_SLIPPING][r] = PetscRealPart(a[ROW_SLIPPING][r]) > 0.5 * PetscRealPart(pressure) ? pressure : 0.0;
  }
  PetscCall(VecRestoreArrays(rows->value, ROW_VALUES, &a));
  PetscCall(VecRestoreArrayRead(mark, &m));
  PetscFunctionReturn(0);
}

/* Smooths the pressures of a pair that the mortar side cannot resolve. Collective. */
PetscErrorCode PairRowsResolve(const Measured *at, PetscInt pair, PairRows *rows)
{
  const Material   *material = &SceneFaceBody(at->scene, at->scene->pairs[pair].mortar)->material;
  const char *const mortar   = at->scene->pairs[pair].mortar;
  PetscBool         any      = PETSC_FALSE;
  Vec               size, *work;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->sides, &size));
  PetscCall(PairFacetsMeasure(at->elasticity, &at->places, 1, &mortar, size));
  PetscCall(VecSqrtAbs(size));
  PetscCall(PairGather(rows, size, rows->value[ROW_FACING]));
  PetscCall(VecDestroy(&size));
  if (material->type == MATERIAL_RIGID) PetscFunctionReturn(0);
  PetscCall(VecDuplicateVecs(rows->value[0], 4, &work));
  PetscCall(ResolveMark(at, material->young, rows, work[3], work, &any));
  if (any) PetscCall(ResolveValues(rows, work[3], work[0]));
  PetscCall(VecDestroyVecs(4, &work));
  PetscFunctionReturn(0);
}
