/*
   Free motions: the rigid motions of the bodies, and of groups that ties and springs hold together, that no prescribed
   displacement, spring or tie resists. Weak springs do not count. Only contact can resist these motions. They serve the
   search for an equilibrium, the optimizer's search space, and the position of bodies that have lost contact.
*/
#include "measureimpl.h"
#include "src/mesh/supports/supportsimpl.h"

/*
   Creates the matrix of all rigid motions at the positions x, six columns per body: translations, and rotations about
   the mean of the body's nodes by 1/size, with its largest coordinate from there as the size
*/
static PetscErrorCode FreeMotionsCreateModes(const Measured *at, Vec places, Mat *modes)
{
  const PetscInt     nbodies = at->scene->nbodies;
  const PetscScalar *x;
  PetscReal         *center, *size;
  PetscInt           n, N, first;

  PetscFunctionBegin;
  PetscCall(PetscCalloc2(3 * nbodies, &center, nbodies, &size));
  PetscCall(VertexPlacesGetCentres(&at->places, places, nbodies, center));
  PetscCall(VecGetLocalSize(places, &n));
  PetscCall(VecGetSize(places, &N));
  PetscCall(VecGetOwnershipRange(places, &first, NULL));
  PetscCall(VecGetArrayRead(places, &x));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt b = at->places.body[i / 3];

    size[b] = PetscMax(size[b], PetscAbsReal(PetscRealPart(x[i]) - center[3 * b + i % 3]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, (PetscMPIInt)nbodies, MPIU_REAL, MPIU_MAX, at->comm));
  PetscCall(MatCreateAIJ(at->comm, n, PETSC_DECIDE, N, 6 * nbodies, 3, NULL, 3, NULL, modes));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt    b = at->places.body[i / 3], c = i % 3, d = (c + 1) % 3, e = (c + 2) % 3, row = first + i;
    const PetscInt    columns[3] = {6 * b + c, 6 * b + 3 + d, 6 * b + 3 + e};
    const PetscScalar values[3]  = {1.0, (PetscRealPart(x[i - c + e]) - center[3 * b + e]) / size[b],
       (center[3 * b + d] - PetscRealPart(x[i - c + d])) / size[b]};

    PetscCall(MatSetValues(*modes, 1, &row, 3, columns, values, INSERT_VALUES));
  }
  PetscCall(VecRestoreArrayRead(places, &x));
  PetscCall(MatAssemblyBegin(*modes, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*modes, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree2(center, size));
  PetscFunctionReturn(0);
}

/* Creates a vector with 1 in rows that are prescribed or have a spring that is not weak, and 0 in the others */
static PetscErrorCode FreeMotionsMarkResisted(const VertexPlaces *places, const Springs *springs,
  const Prescribed *prescribed, Vec *resisted)
{
  const PetscScalar *k, *weak = NULL;
  PetscScalar       *a;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(places->x, resisted));
  PetscCall(VecZeroEntries(*resisted));
  PetscCall(PrescribedSet(prescribed, 1.0, *resisted));
  if (!springs->stiffness) PetscFunctionReturn(0);
  PetscCall(VecGetLocalSize(*resisted, &n));
  PetscCall(VecGetArray(*resisted, &a));
  PetscCall(VecGetArrayRead(springs->stiffness, &k));
  if (springs->weak) PetscCall(VecGetArrayRead(springs->weak, &weak));
  for (PetscInt i = 0; i < n; ++i) {
    if (PetscRealPart(k[i]) > (weak ? PetscRealPart(weak[i]) : 0.0)) a[i] = 1.0;
  }
  if (weak) PetscCall(VecRestoreArrayRead(springs->weak, &weak));
  PetscCall(VecRestoreArrayRead(springs->stiffness, &k));
  PetscCall(VecRestoreArray(*resisted, &a));
  PetscFunctionReturn(0);
}

/* Adds the matrix B, which is then destroyed, to A */
static PetscErrorCode FreeMotionsAdd(Mat A, PetscReal factor, Mat *B)
{
  PetscFunctionBegin;
  PetscCall(MatAXPY(A, factor, *B, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatDestroy(B));
  PetscFunctionReturn(0);
}

/*
   Computes the matrix of the resistance to the modes, with a stiffness of 1 of each prescribed, sprung or tied row,
   on all ranks
*/
static PetscErrorCode FreeMotionsMeasureResistance(Model model, Mat modes, Mat *resistance)
{
  Mat       part, more, *all;
  Vec       resisted;
  IS        rows;
  PetscReal size;

  PetscFunctionBegin;
  PetscCall(FreeMotionsMarkResisted(&model->places, &model->springs, &model->prescribed, &resisted));
  PetscCall(MatDuplicate(modes, MAT_COPY_VALUES, &part));
  PetscCall(MatDiagonalScale(part, resisted, NULL));
  PetscCall(VecDestroy(&resisted));
  PetscCall(MatTransposeMatMult(part, part, MAT_INITIAL_MATRIX, PETSC_DEFAULT, resistance));
  PetscCall(MatDestroy(&part));
  if (model->ties.C) {
    PetscCall(MatMatMult(model->ties.C, modes, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &part));
    PetscCall(MatAXPY(part, -1.0, modes, DIFFERENT_NONZERO_PATTERN));
    PetscCall(MatTransposeMatMult(part, part, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &more));
    PetscCall(MatDestroy(&part));
    PetscCall(FreeMotionsAdd(*resistance, 1.0, &more));
  }
  if (model->springs.between) {
    PetscCall(MatNorm(model->springs.between, NORM_INFINITY, &size));
    PetscCall(MatPtAP(model->springs.between, modes, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &more));
    PetscCall(FreeMotionsAdd(*resistance, size > 0.0 ? 1.0 / size : 0.0, &more));
  }
  PetscCall(ISCreateStride(PETSC_COMM_SELF, 6 * model->scene->nbodies, 0, 1, &rows));
  PetscCall(MatCreateSubMatrices(*resistance, 1, &rows, &rows, MAT_INITIAL_MATRIX, &all));
  PetscCall(ISDestroy(&rows));
  PetscCall(MatDestroy(resistance));
  PetscCall(PetscObjectReference((PetscObject)all[0]));
  *resistance = all[0];
  PetscCall(MatDestroySubMatrices(1, &all));
  PetscFunctionReturn(0);
}

/* Finds groups of bodies that ties or springs connect. group[b]: the first body of the group of body b */
static PetscErrorCode FreeMotionsGroup(Mat resistance, PetscInt nbodies, PetscInt group[])
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < nbodies; ++b) group[b] = b;
  for (PetscInt i = 0; i < 6 * nbodies; ++i) {
    PetscInt        n;
    const PetscInt *columns;

    PetscCall(MatGetRow(resistance, i, &n, &columns, NULL));
    for (PetscInt k = 0; k < n; ++k) {
      const PetscInt a = group[i / 6], b = group[columns[k] / 6];

      for (PetscInt c = 0; a != b && c < nbodies; ++c)
        if (group[c] == PetscMax(a, b)) group[c] = PetscMin(a, b);
    }
    PetscCall(MatRestoreRow(resistance, i, &n, &columns, NULL));
  }
  PetscFunctionReturn(0);
}

/*
   Finds the free motions of the group with the given first body as combinations of the modes. member: its bodies;
   motion: an orthonormal basis, with six numbers per member, one after the other
*/
static PetscErrorCode FreeMotionsSolveGroup(Mat resistance, PetscInt nbodies, const PetscInt group[], PetscInt first,
  PetscInt *nmembers, PetscInt member[], PetscInt *nmotions, PetscReal **motion)
{
  PetscInt n, size, *place;

  PetscFunctionBegin;
  *nmembers = 0;
  PetscCall(PetscMalloc1(nbodies, &place));
  for (PetscInt b = 0; b < nbodies; ++b) {
    place[b] = *nmembers;
    if (group[b] == first) member[(*nmembers)++] = b;
  }
  size = 6 * *nmembers;
  PetscCall(PetscCalloc1(size * size, motion));
  for (PetscInt i = 0; i < size; ++i) {
    const PetscInt     row = 6 * member[i / 6] + i % 6;
    const PetscInt    *columns;
    const PetscScalar *values;

    PetscCall(MatGetRow(resistance, row, &n, &columns, &values));
    for (PetscInt k = 0; k < n; ++k)
      (*motion)[size * i + 6 * place[columns[k] / 6] + columns[k] % 6] = PetscRealPart(values[k]);
    PetscCall(MatRestoreRow(resistance, row, &n, &columns, &values));
  }
  PetscCall(SupportFindNull(size, *motion, nmotions));
  PetscCall(PetscFree(place));
  PetscFunctionReturn(0);
}

/* Creates the matrix whose columns are the free motions as combinations of the modes */
static PetscErrorCode FreeMotionsCombine(MPI_Comm comm, Scene scene, Mat modes, Mat resistance, PetscInt *n,
  Mat *combined)
{
  const PetscInt nbodies = scene->nbodies;
  PetscInt      *group, *member, nmembers, nmotions, local;
  PetscReal     *motion;
  PetscMPIInt    rank;

  PetscFunctionBegin;
  *n = 0;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscMalloc2(nbodies, &group, nbodies, &member));
  PetscCall(FreeMotionsGroup(resistance, nbodies, group));
  PetscCall(MatGetLocalSize(modes, NULL, &local));
  PetscCall(MatCreate(comm, combined));
  PetscCall(MatSetSizes(*combined, local, PETSC_DECIDE, PETSC_DETERMINE, 6 * nbodies));
  PetscCall(MatSetType(*combined, MATAIJ));
  PetscCall(MatSetUp(*combined));
  for (PetscInt b = 0; b < nbodies; ++b) {
    if (group[b] != b) continue;
    PetscCall(FreeMotionsSolveGroup(resistance, nbodies, group, b, &nmembers, member, &nmotions, &motion));
    for (PetscInt i = 0; i < 6 * nmembers && !rank; ++i) {
      for (PetscInt k = 0; k < nmotions; ++k)
        PetscCall(
          MatSetValue(*combined, 6 * member[i / 6] + i % 6, *n + k, motion[6 * nmembers * k + i], INSERT_VALUES));
    }
    *n += nmotions;
    PetscCall(PetscFree(motion));
  }
  PetscCall(MatAssemblyBegin(*combined, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*combined, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree2(group, member));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes the free motions at the last state. Bodies at small strain are at their undeformed positions, as
   in the energy, unless rigid bodies turn.
*/
PetscErrorCode FreeMotionsCreate(Model model, State state, FreeMotions *m)
{
  const Measured at = MeasuredAt(model, state, NULL);
  PetscBool      linear;
  Mat            modes, resistance, combined;
  Vec            places;

  PetscFunctionBegin;
  PetscCall(ElasticityIsLinear(model->elasticity, &linear));
  PetscCall(VecDuplicate(model->places.x, &places));
  PetscCall(VecCopy(model->places.x, places));
  if (!linear || model->rigid.turns) PetscCall(VecAXPY(places, 1.0, state->path->u));
  PetscCall(FreeMotionsCreateModes(&at, places, &modes));
  PetscCall(VecDestroy(&places));
  PetscCall(FreeMotionsMeasureResistance(model, modes, &resistance));
  m->comm = model->comm;
  PetscCall(FreeMotionsCombine(model->comm, model->scene, modes, resistance, &m->n, &combined));
  PetscCall(MatMatMult(modes, combined, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &m->Z));
  PetscCall(MatDestroy(&combined));
  PetscCall(MatDestroy(&resistance));
  PetscCall(MatDestroy(&modes));
  PetscFunctionReturn(0);
}

/* Computes the product of row i of a matrix, which this rank owns, with `motion` */
PetscErrorCode FreeMotionsGetRate(Mat A, PetscInt row, const PetscReal motion[], PetscReal *rate)
{
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscInt           n;

  PetscFunctionBegin;
  *rate = 0.0;
  PetscCall(MatGetRow(A, row, &n, &columns, &values));
  for (PetscInt k = 0; k < n; ++k) *rate += PetscRealPart(values[k]) * motion[columns[k]];
  PetscCall(MatRestoreRow(A, row, &n, &columns, &values));
  PetscFunctionReturn(0);
}

/* Computes the displacements w of a combination of the free motions */
PetscErrorCode FreeMotionsDisplace(const FreeMotions *m, const PetscReal motion[], Vec w)
{
  PetscScalar *a;
  PetscInt     first, end;

  PetscFunctionBegin;
  PetscCall(VecGetOwnershipRange(w, &first, &end));
  PetscCall(VecGetArrayWrite(w, &a));
  for (PetscInt i = first; i < end; ++i) {
    PetscReal value;

    PetscCall(FreeMotionsGetRate(m->Z, i, motion, &value));
    a[i - first] = value;
  }
  PetscCall(VecRestoreArrayWrite(w, &a));
  PetscFunctionReturn(0);
}

/* Computes the work of forces on the free motions */
PetscErrorCode FreeMotionsSum(const FreeMotions *m, Vec force, PetscReal motion[])
{
  const PetscScalar *f, *values;
  const PetscInt    *columns;
  PetscInt           first, end, n;

  PetscFunctionBegin;
  PetscCall(PetscArrayzero(motion, m->n));
  PetscCall(VecGetOwnershipRange(force, &first, &end));
  PetscCall(VecGetArrayRead(force, &f));
  for (PetscInt i = first; i < end; ++i) {
    PetscCall(MatGetRow(m->Z, i, &n, &columns, &values));
    for (PetscInt k = 0; k < n; ++k) motion[columns[k]] += PetscRealPart(values[k] * f[i - first]);
    PetscCall(MatRestoreRow(m->Z, i, &n, &columns, &values));
  }
  PetscCall(VecRestoreArrayRead(force, &f));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, motion, (PetscMPIInt)m->n, MPIU_REAL, MPIU_SUM, m->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode FreeMotionsDestroy(FreeMotions *m)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&m->Z));
  PetscFunctionReturn(0);
}
