/* The partitioner "metis": serial METIS on the graph gathered on the first rank. ParMETIS is not used, because Debian's
   PETSc is built without it. For the same reason this file registers METIS's ordering for factorizations. */
#include "meshimpl.h"
#include <petsc/private/partitionerimpl.h>
#include <metis.h>

#define PETSCPARTITIONERMETIS "metis"

/* largest number of parts for recursive bisection. For more parts multilevel k-way partitioning is as good, and faster
   (METIS manual, section 5.1). */
#define METIS_RECURSIVE_MAX_PARTS 8

/* Partitions a whole graph by METIS. part[v] is in [0, nparts). If there are more parts than vertices, the last parts
   are empty; METIS itself does not create empty parts. */
PetscErrorCode MetisPartitionGraph(PetscInt nparts, PetscInt nv, const PetscInt start[], const PetscInt adjacency[],
  const PetscInt weights[], PetscInt part[])
{
  idx_t n, ncon = 1, np, cut, *xadj, *adjncy, *vwgt = NULL, *where, options[METIS_NOPTIONS];
  int   status;

  PetscFunctionBegin;
  if (nparts >= nv) {
    for (PetscInt v = 0; v < nv; ++v) part[v] = v;
    PetscFunctionReturn(0);
  }
  PetscCall(PetscMalloc3(nv + 1, &xadj, start[nv], &adjncy, nv, &where));
  for (PetscInt v = 0; v <= nv; ++v) xadj[v] = (idx_t)start[v];
  for (PetscInt e = 0; e < start[nv]; ++e) adjncy[e] = (idx_t)adjacency[e];
  if (weights) {
    PetscCall(PetscMalloc1(nv, &vwgt));
    for (PetscInt v = 0; v < nv; ++v) vwgt[v] = (idx_t)weights[v];
  }
  n  = (idx_t)nv;
  np = (idx_t)nparts;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (nparts <= METIS_RECURSIVE_MAX_PARTS)
    status = METIS_PartGraphRecursive(&n, &ncon, xadj, adjncy, vwgt, NULL, NULL, &np, NULL, NULL, options, &cut, where);
  else status = METIS_PartGraphKway(&n, &ncon, xadj, adjncy, vwgt, NULL, NULL, &np, NULL, NULL, options, &cut, where);
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS failed with status %d", status);
  for (PetscInt v = 0; v < nv; ++v) part[v] = (PetscInt)where[v];
  PetscCall(PetscFree(vwgt));
  PetscCall(PetscFree3(xadj, adjncy, where));
  PetscFunctionReturn(0);
}

/* Orders the rows of a sequential matrix with a symmetric pattern for its factorization, by METIS's nested
   dissection */
static PetscErrorCode MetisOrder(Mat A, MatOrderingType type, IS *rows, IS *columns)
{
  const PetscInt *ia, *ja;
  PetscInt        nv, m = 0, *order;
  idx_t           n, *xadj, *adjncy, *perm, *place, options[METIS_NOPTIONS];
  PetscBool       done;
  int             status;

  PetscFunctionBegin;
  (void)type;
  PetscCall(MatGetRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &nv, &ia, &ja, &done));
  PetscCheck(done, PETSC_COMM_SELF, PETSC_ERR_SUP, "A matrix of type %s has no compressed rows",
    ((PetscObject)A)->type_name);
  PetscCall(PetscMalloc4(nv + 1, &xadj, ia[nv], &adjncy, nv, &perm, nv, &place));
  xadj[0] = 0;
  for (PetscInt v = 0; v < nv; ++v) {
    for (PetscInt k = ia[v]; k < ia[v + 1]; ++k)
      if (ja[k] != v) adjncy[m++] = (idx_t)ja[k];
    xadj[v + 1] = (idx_t)m;
  }
  PetscCall(MatRestoreRowIJ(A, 0, PETSC_FALSE, PETSC_FALSE, &nv, &ia, &ja, &done));
  PetscCall(MatGetSize(A, &nv, NULL));
  n = (idx_t)nv;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  status                     = METIS_NodeND(&n, xadj, adjncy, NULL, options, perm, place);
  PetscCheck(status == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS failed with status %d", status);
  PetscCall(PetscMalloc1(nv, &order));
  for (PetscInt v = 0; v < nv; ++v) order[v] = (PetscInt)perm[v];
  PetscCall(PetscFree4(xadj, adjncy, perm, place));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, nv, order, PETSC_OWN_POINTER, rows));
  PetscCall(PetscObjectReference((PetscObject)*rows));
  *columns = *rows;
  PetscFunctionReturn(0);
}

/* Partitions a gathered graph, which is given by the degrees of its vertices. Allocates *part. */
static PetscErrorCode MetisPartitionGathered(PetscInt nparts, PetscInt nv, const PetscInt degree[],
  const PetscInt adjacency[], const PetscInt weights[], PetscInt **part)
{
  PetscInt *start;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nv, part));
  PetscCall(PetscMalloc1(nv + 1, &start));
  start[0] = 0;
  for (PetscInt v = 0; v < nv; ++v) start[v + 1] = start[v] + degree[v];
  PetscCall(MetisPartitionGraph(nparts, nv, start, adjacency, weights, *part));
  PetscCall(PetscFree(start));
  PetscFunctionReturn(0);
}

/* Collective. Checks that no gather of the graph's arrays is larger than an MPI message. n: entries on this rank. The
   limit keeps the graph within METIS's index type, too. */
static PetscErrorCode MetisCheckSize(MPI_Comm comm, PetscInt n)
{
  PetscInt64 sum = 0, local = n;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(&local, &sum, 1, MPIU_INT64, MPI_SUM, comm));
  PetscCheck(sum <= PETSC_MPI_INT_MAX, comm, PETSC_ERR_SUP,
    "The graph for METIS has %" PetscInt64_FMT " entries, which exceeds the size of an MPI message: start from a "
    "coarser mesh and refine it with -refine, which is done after the distribution",
    sum);
  PetscFunctionReturn(0);
}

/* Collective. Computes part[v] for the nv vertices of this rank. The graph is gathered on the first rank. On a rank
   without vertices, weights may be NULL even if `weighted` is true. */
static PetscErrorCode MetisPartitionDistributed(MPI_Comm comm, PetscInt nparts, PetscInt nv, const PetscInt start[],
  const PetscInt adjacency[], PetscBool weighted, const PetscInt weights[], PetscInt part[])
{
  PetscMPIInt rank, size, *counts, *displs, nvlocal;
  PetscInt    nvall, neall, *degree, *alldegree, *alladjacency, *allweights = NULL, *allpart = NULL;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc3(size, &counts, size, &displs, nv, &degree));
  for (PetscInt v = 0; v < nv; ++v) degree[v] = start[v + 1] - start[v];
  PetscCall(MetisCheckSize(comm, PetscMax(nv, nv ? start[nv] : 0)));
  PetscCall(
    IntegersGather(comm, "the graph for METIS", nv ? start[nv] : 0, adjacency, counts, displs, &neall, &alladjacency));
  if (weighted)
    PetscCall(IntegersGather(comm, "the graph for METIS", nv, weights, counts, displs, &nvall, &allweights));
  PetscCall(IntegersGather(comm, "the graph for METIS", nv, degree, counts, displs, &nvall, &alldegree));
  RankCallFor(comm, !rank, MetisPartitionGathered(nparts, nvall, alldegree, alladjacency, allweights, &allpart),
    "The first rank cannot partition a graph of %" PetscInt_FMT " vertices into %" PetscInt_FMT " parts: ", nvall,
    nparts);
  PetscCall(PetscMPIIntCast(nv, &nvlocal));
  PetscCallMPI(MPI_Scatterv(allpart, counts, displs, MPIU_INT, part, nvlocal, MPIU_INT, 0, comm));
  PetscCall(PetscFree(allpart));
  PetscCall(PetscFree(alldegree));
  PetscCall(PetscFree(alladjacency));
  PetscCall(PetscFree(allweights));
  PetscCall(PetscFree3(counts, displs, degree));
  PetscFunctionReturn(0);
}

static PetscErrorCode PetscPartitionerPartition_Metis(PetscPartitioner part, PetscInt nparts, PetscInt nv,
  PetscInt start[], PetscInt adjacency[], PetscSection vertexsection, AMGF_EDGE_SECTION PetscSection targetsection,
  PetscSection partsection, IS *partition)
{
  MPI_Comm  comm = PetscObjectComm((PetscObject)part);
  PetscInt *assignment, *weights = NULL, *points, *next;

  PetscFunctionBegin;
  PetscCheck(!targetsection, comm, PETSC_ERR_SUP, "The partitioner metis supports only parts of equal weight");
  PetscCall(PetscMalloc3(nv, &assignment, vertexsection ? nv : 0, &weights, nparts, &next));
  if (vertexsection) {
    for (PetscInt v = 0; v < nv; ++v) PetscCall(PetscSectionGetDof(vertexsection, v, &weights[v]));
  }
  PetscCall(MetisPartitionDistributed(comm, nparts, nv, start, adjacency, vertexsection ? PETSC_TRUE : PETSC_FALSE,
    weights, assignment));

  PetscCall(PetscArrayzero(next, nparts));
  for (PetscInt v = 0; v < nv; ++v) ++next[assignment[v]];
  for (PetscInt p = 0, offset = 0; p < nparts; ++p) {
    const PetscInt n = next[p];

    PetscCall(PetscSectionSetDof(partsection, p, n));
    next[p] = offset;
    offset += n;
  }
  PetscCall(PetscMalloc1(nv, &points));
  for (PetscInt v = 0; v < nv; ++v) points[next[assignment[v]]++] = v;
  PetscCall(ISCreateGeneral(comm, nv, points, PETSC_OWN_POINTER, partition));
  PetscCall(PetscFree3(assignment, weights, next));
  PetscFunctionReturn(0);
}

/*MC
  PETSCPARTITIONERMETIS = "metis" - A PetscPartitioner that gathers the graph on rank 0 and calls METIS there

  Level: intermediate

  Notes:
  The partitioner is intended for the level 0 mesh, before uniform refinement: the whole graph must fit into the memory
  of rank 0. Up to 8 parts are computed by recursive bisection, more by multilevel k-way partitioning.

  References:
. * - G. Karypis, V. Kumar, A fast and high quality multilevel scheme for partitioning irregular graphs, SIAM J. Sci.
      Comput. 20 (1998)

.seealso: `PetscPartitionerSetType()`
M*/
static PetscErrorCode PetscPartitionerCreate_Metis(PetscPartitioner part)
{
  PetscFunctionBegin;
  part->noGraph        = PETSC_FALSE;
  part->ops->partition = PetscPartitionerPartition_Metis;
  PetscFunctionReturn(0);
}

/* Registers the partitioner "metis" and, if PETSc does not have it, the ordering "metisnd". MeshCreate() calls this
   function. A program that distributes its own DMPlex must call it before the option -petscpartitioner_type metis is
   read. */
PetscErrorCode MeshRegisterPartitioner(void)
{
  PetscFunctionBegin;
  if (!PetscDefined(HAVE_METIS)) PetscCall(MatOrderingRegister(MATORDERINGMETISND, MetisOrder));
  PetscCall(PetscPartitionerRegister(PETSCPARTITIONERMETIS, PetscPartitionerCreate_Metis));
  PetscFunctionReturn(0);
}
