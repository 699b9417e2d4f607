/*
   Ties. The displacement of a nonmortar vertex A is a weighted mean of the displacement of the mortar face. The weight
   is the dual function psi_A:

     u_A = sum_C int psi_A N2_C / int psi_A u_C,   int psi_A N1_B = delta_AB int N1_B.

   The integrals are over the undeformed faces. psi_A is a combination of the bilinear functions on each facet,
   restricted to its covered part.
*/
#include "contactimpl.h"
#include <vector3.h>

/* largest fraction of the nonmortar face that may remain uncovered, in total and around one vertex. Such gaps arise
   from rounding, or from facets that cut the corners of curved faces. */
static const PetscReal tie_uncovered = 2e-2, tie_uncovered_vertex = 0.3;

/* Sums over all facets: entries of the matrix of weights, and the covered and the whole area of each node [length^2] */
typedef struct {
  ContactEntries entries; /* of the matrix [length^2] */
  Vec            covered, whole;
} TieSums;

/* Computes a = diag(w) mass^-1 for n vertices, where w are the row sums of mass. Returns false if mass is singular,
   which means that almost nothing is covered. */
static PetscBool TieDual(PetscInt n, PetscReal mass[4][4], PetscReal a[4][4])
{
  for (PetscInt i = 0; i < 16; ++i) a[i / 4][i % 4] = mass[i / 4][i % 4];
  if (!MatrixInvertInPlace(n, 4, &a[0][0])) return PETSC_FALSE;
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal w = 0.0;

    for (PetscInt j = 0; j < n; ++j) w += mass[i][j];
    for (PetscInt j = 0; j < n; ++j) a[i][j] *= w;
  }
  return PETSC_TRUE;
}

/* Adds the rows of the two functions of a triangle's last vertex (n = 3) */
static void TieFold(PetscInt n, PetscReal rows[4][4])
{
  for (PetscInt b = 0; n == 3 && b < 4; ++b) {
    rows[2][b] += rows[3][b];
    rows[3][b] = 0.0;
  }
}

/* Adds the rows and the columns of the two functions of a triangle's last vertex in a mass matrix (n = 3) */
static void TieFoldMass(PetscInt n, PetscReal mass[4][4])
{
  TieFold(n, mass);
  for (PetscInt a = 0; n == 3 && a < 3; ++a) {
    mass[a][2] += mass[a][3];
    mass[a][3] = 0.0;
  }
}

/* Adds the integrals of nonmortar facet f over its overlaps with the mortar facets near[0 .. nnear - 1] */
static PetscErrorCode TieAddFacet(const ContactSurface *nonmortar, PetscInt f, const ContactOverlapLimits *limits,
  const ContactRule *rule, const ContactCandidates *mortar, PetscInt nnear, const PetscInt near[], TieSums *sums)
{
  const PetscReal  zero[12] = {0.0}, *x = &nonmortar->x[12 * f];
  const PetscInt  *node = &nonmortar->node[4 * f], n = ContactFacetIsTriangle(x) ? 3 : 4;
  PetscReal        mass[4][4] = {{0.0}}, dual[4][4], whole[4];
  PetscScalar      areas[2][4];
  ContactIntegrals m;
  ContactOverlap   overlap;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < nnear; ++k) {
    if (!ContactOverlapFind(x, &mortar->x[12 * near[k]], limits, rule, &overlap)) continue;
    ContactIntegrate(&overlap, x, &mortar->x[12 * near[k]], zero, NULL, &m);
    for (PetscInt a = 0; a < 16; ++a) mass[a / 4][a % 4] += m.D[a / 4][a % 4];
  }
  TieFoldMass(n, mass);
  (void)ContactFacetMass(x, whole);
  for (PetscInt a = 0; a < 4; ++a) {
    areas[0][a] = mass[a][0] + mass[a][1] + mass[a][2] + mass[a][3];
    areas[1][a] = whole[a];
  }
  PetscCall(VecSetValues(sums->covered, 4, node, areas[0], ADD_VALUES));
  PetscCall(VecSetValues(sums->whole, 4, node, areas[1], ADD_VALUES));
  if (!TieDual(n, mass, dual)) PetscFunctionReturn(0);
  for (PetscInt k = 0; k < nnear; ++k) {
    if (!ContactOverlapFind(x, &mortar->x[12 * near[k]], limits, rule, &overlap)) continue;
    ContactIntegrate(&overlap, x, &mortar->x[12 * near[k]], zero, NULL, &m);
    TieFold(n, m.M);
    for (PetscInt a = 0; a < n; ++a) {
      for (PetscInt c = 0; c < 4; ++c) {
        PetscReal value = 0.0;

        for (PetscInt b = 0; b < n; ++b) value += dual[a][b] * m.M[b][c];
        if (value != 0.0)
          PetscCall(ContactEntriesAdd(&sums->entries, node[a], 1, &mortar->node[4 * near[k] + c], &value));
      }
    }
  }
  PetscFunctionReturn(0);
}

/* Collective. Adds the integrals of all nonmortar facets. distance: search distance on both sides of the facets
   [length] */
static PetscErrorCode TieAddFacets(MPI_Comm comm, const ContactSurface *mortar, const ContactSurface *nonmortar,
  PetscReal distance, TieSums *sums)
{
  const ContactOverlapLimits limits = {.cosine = -0.5, .overlap_drop = 1e-10, .distance = distance, .depth = distance};
  PetscReal   box[6] = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL};
  ContactRule rule;
  ContactCandidates candidates;
  ContactNear       near;

  PetscFunctionBegin;
  PetscCall(ContactRuleCreate(4, &rule));
  for (PetscInt f = 0; f < nonmortar->nfacets; ++f) {
    PetscReal swept[6];

    ContactSweptBox(&nonmortar->x[12 * f], distance, distance, swept);
    for (PetscInt c = 0; c < 3; ++c) {
      box[c]     = PetscMin(box[c], swept[c]);
      box[3 + c] = PetscMax(box[3 + c], swept[3 + c]);
    }
  }
  PetscCall(ContactExchange(comm, box, mortar, &candidates));
  PetscCall(ContactSearch(nonmortar, distance, distance, &candidates, &near));
  for (PetscInt f = 0; f < nonmortar->nfacets; ++f)
    PetscCall(TieAddFacet(nonmortar, f, &limits, &rule, &candidates, near.offset[f + 1] - near.offset[f],
      near.facet + near.offset[f], sums));
  PetscCall(ContactNearDestroy(&near));
  PetscCall(ContactCandidatesDestroy(&candidates));
  PetscFunctionReturn(0);
}

/* Collective. Creates the matrix of weights: divides the sums by the covered areas. It is an error if the mortar face
   does not cover the nonmortar face. */
static PetscErrorCode TieFinish(MPI_Comm comm, const char what[], const SceneTie *tie, PetscReal distance,
  TieSums *sums, Mat *rows)
{
  PetscScalar *covered;
  PetscReal    least = 1.0, areas[2] = {0.0, 0.0};
  PetscInt     n;

  const PetscScalar *whole;

  PetscFunctionBegin;
  PetscCall(VecAssemblyBegin(sums->covered));
  PetscCall(VecAssemblyEnd(sums->covered));
  PetscCall(VecAssemblyBegin(sums->whole));
  PetscCall(VecAssemblyEnd(sums->whole));
  PetscCall(VecGetLocalSize(sums->covered, &n));
  PetscCall(ContactEntriesCreateMatrix(comm, n, n, &sums->entries, rows));
  PetscCall(VecGetArray(sums->covered, &covered));
  PetscCall(VecGetArrayRead(sums->whole, &whole));
  for (PetscInt i = 0; i < n; ++i) {
    if (!(PetscRealPart(whole[i]) > 0.0)) continue;
    areas[0] += PetscRealPart(covered[i]);
    areas[1] += PetscRealPart(whole[i]);
    least      = PetscMin(least, PetscRealPart(covered[i] / whole[i]));
    covered[i] = PetscRealPart(covered[i]) > 0.0 ? 1.0 / covered[i] : 0.0;
  }
  PetscCall(VecRestoreArrayRead(sums->whole, &whole));
  PetscCall(VecRestoreArray(sums->covered, &covered));
  PetscCall(MatDiagonalScale(*rows, sums->covered, NULL));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPIU_REAL, MPIU_MIN, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, areas, 2, MPIU_REAL, MPIU_SUM, comm));
  SceneCheck(areas[0] > 0.0, comm, PETSC_ERR_USER_INPUT, tie,
    "%s \"%s\": no facet of the mortar face %s is within the distance %.4g of the nonmortar face %s: increase the key "
    "distance, or move the bodies together",
    what, tie->name, tie->mortar, (double)distance, tie->nonmortar);
  SceneCheck(areas[0] >= (1.0 - tie_uncovered) * areas[1] && least >= 1.0 - tie_uncovered_vertex, comm,
    PETSC_ERR_USER_INPUT, tie,
    "%s \"%s\": the mortar face %s covers %.4g %% of the nonmortar face %s, but must cover all of it: exchange mortar "
    "and nonmortar, or define the covered part as a face with the key faces",
    what, tie->name, tie->mortar, (double)(100.0 * areas[0] / areas[1]), tie->nonmortar);
  PetscFunctionReturn(0);
}

/* Collective. Converts rows and columns for the facets' vertices into rows and columns for the nodes of faces of order
   2 */
static PetscErrorCode TieSetTrace(DM dm, const ContactSurface *mortar, const ContactSurface *nonmortar, Mat rows)
{
  Mat correction;

  PetscFunctionBegin;
  PetscCall(ContactTraceCreate(dm, 1, &mortar, CONTACT_TRACE_FORWARD, 1, &correction));
  if (correction) PetscCall(ContactTraceDifferentiate(correction, rows));
  PetscCall(MatDestroy(&correction));
  PetscCall(ContactTraceCreate(dm, 1, &nonmortar, CONTACT_TRACE_INVERSE, 1, &correction));
  if (correction) PetscCall(ContactTraceRecover(correction, rows));
  PetscCall(MatDestroy(&correction));
  PetscFunctionReturn(0);
}

/*@C
  ContactTieCreate - Computes the weights of a tie: the displacement of each vertex of one face is a weighted mean of
  displacements of another face

  Collective

  Input Parameters:
+ dm   - the mesh
. what - what the tie is in the scene, for error messages, e.g. "tie" or "springs"
- tie  - the two faces

  Output Parameter:
. rows - a square AIJ matrix with one row and one column per node of the mesh. The row of a node of the nonmortar face
         holds the weights of the mortar face's nodes, which sum to 1. Other rows are empty.

  Level: intermediate

  Note:
  It is an error if the undeformed mortar face does not cover the nonmortar face.

.seealso: `ContactCreate()`
@*/
PetscErrorCode ContactTieCreate(DM dm, const char what[], const SceneTie *tie, Mat *rows)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)dm);
  ContactBoundary boundary;
  ContactSurface  mortar = {0}, nonmortar = {0};
  TieSums         sums = {.entries = {.width = 1}};
  PetscReal      *thickness, distance;
  PetscInt        n, total;
  Vec             u;

  PetscFunctionBegin;
  PetscCall(EventsRegister());
  PetscCall(ContactBoundaryCreate(dm, &boundary));
  PetscCall(PetscCalloc1(boundary.nbodies, &thickness));
  PetscCall(ContactBoundaryDestroy(&boundary));
  PetscCall(ContactSurfaceCreate(dm, tie->mortar, thickness, &mortar));
  PetscCall(ContactSurfaceCreate(dm, tie->nonmortar, thickness, &nonmortar));
  PetscCall(PetscFree(thickness));
  PetscCall(PetscArraycpy(mortar.x, mortar.reference, 12 * mortar.nfacets));
  PetscCall(PetscArraycpy(nonmortar.x, nonmortar.reference, 12 * nonmortar.nfacets));
  PetscCallMPI(MPI_Allreduce(&nonmortar.nfacets, &total, 1, MPIU_INT, MPI_SUM, comm));
  distance = tie->distance > 0.0 ? tie->distance : 0.5 * PetscSqrtReal(nonmortar.area / (PetscReal)total);
  PetscCall(DMGetGlobalVector(dm, &u));
  PetscCall(VecGetLocalSize(u, &n));
  PetscCall(DMRestoreGlobalVector(dm, &u));
  PetscCall(VecCreateMPI(comm, n / 3, PETSC_DETERMINE, &sums.covered));
  PetscCall(VecDuplicate(sums.covered, &sums.whole));
  PetscCall(TieAddFacets(comm, &mortar, &nonmortar, distance, &sums));
  PetscCall(TieFinish(comm, what, tie, distance, &sums, rows));
  PetscCall(TieSetTrace(dm, &mortar, &nonmortar, *rows));
  PetscCall(VecDestroy(&sums.covered));
  PetscCall(VecDestroy(&sums.whole));
  PetscCall(ContactEntriesDestroy(&sums.entries));
  PetscCall(ContactSurfaceDestroy(&mortar));
  PetscCall(ContactSurfaceDestroy(&nonmortar));
  PetscFunctionReturn(0);
}
