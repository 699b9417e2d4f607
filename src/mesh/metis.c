/* The partitioner "metis" for meshes that are still on the first rank. ParMETIS is not used, because Debian's PETSc is
   built without it. */
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

static PetscErrorCode PetscPartitionerPartition_Metis(PetscPartitioner part, PetscInt nparts, PetscInt nv,
  PetscInt start[], PetscInt adjacency[], PetscSection vertexsection, AMGF_EDGE_SECTION PetscSection targetsection,
  PetscSection partsection, IS *partition)
{
  MPI_Comm    comm = PetscObjectComm((PetscObject)part);
  PetscInt   *assignment, *weights = NULL, *points, *next;
  PetscBool   first;
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCheck(!targetsection, comm, PETSC_ERR_SUP, "The partitioner metis supports only parts of equal weight");
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  first = (PetscBool)(!nv || !rank);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_PETSCBOOL, MPI_LAND, comm));
  PetscCheck(first, comm, PETSC_ERR_SUP, "The partitioner metis takes a mesh that is on the first rank");
  PetscCall(PetscMalloc3(nv, &assignment, vertexsection ? nv : 0, &weights, nparts, &next));
  if (vertexsection) {
    for (PetscInt v = 0; v < nv; ++v) PetscCall(PetscSectionGetDof(vertexsection, v, &weights[v]));
  }
  RankCallFor(comm, nv > 0,
    MetisPartitionGraph(nparts, nv, start, adjacency, vertexsection ? weights : NULL, assignment),
    "The first rank cannot partition the graph of the mesh into %" PetscInt_FMT " parts: ", nparts);

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

static PetscErrorCode PetscPartitionerCreate_Metis(PetscPartitioner part)
{
  PetscFunctionBegin;
  part->noGraph        = PETSC_FALSE;
  part->ops->partition = PetscPartitionerPartition_Metis;
  PetscFunctionReturn(0);
}

/* Registers the partitioner "metis" */
PetscErrorCode MeshRegisterPartitioner(void)
{
  PetscFunctionBegin;
  PetscCall(PetscPartitionerRegister(PETSCPARTITIONERMETIS, PetscPartitionerCreate_Metis));
  PetscFunctionReturn(0);
}
