/*
   Determines the memory that all ranks together may use: the memory of their machines, or less if a control group of
   Linux limits it
*/
#include "amgfimpl.h"
#include <stdio.h>
#include <unistd.h>

#define MEMORY_LINE 4096

/*
   Returns the limit [bytes] in a file of a control group. Returns infinity if the file does not exist or contains
   "max".
*/
static PetscReal MemoryReadLimit(const char folder[], const char file[])
{
  char   path[2 * MEMORY_LINE];
  FILE  *stream;
  double limit;

  if (snprintf(path, sizeof(path), "%s/%s", folder, file) >= (int)sizeof(path)) return PETSC_INFINITY;
  stream = fopen(path, "r");
  if (!stream) return PETSC_INFINITY;
  if (fscanf(stream, "%lf", &limit) != 1 || !(limit > 0.0)) limit = PETSC_INFINITY;
  (void)fclose(stream);
  return limit;
}

/*
   Returns the smallest limit [bytes] of a control group and its parent groups. Folders of the path that do not exist,
   as inside a container, are skipped.
*/
static PetscReal MemoryReadGroup(const char mount[], const char group[], const char file[])
{
  char      folder[MEMORY_LINE];
  size_t    last;
  PetscReal limit = PETSC_INFINITY;

  if (snprintf(folder, sizeof(folder), "%s%s", mount, group) >= (int)sizeof(folder)) return PETSC_INFINITY;
  for (last = strlen(folder); last >= strlen(mount); last--) {
    if (folder[last] && folder[last] != '/') continue;
    folder[last] = '\0';
    limit        = PetscMin(limit, MemoryReadLimit(folder, file));
  }
  return limit;
}

/* Returns whether a comma-separated list of names contains "memory" */
static PetscBool MemoryIsController(const char list[])
{
  for (const char *at = list; (at = strstr(at, "memory")); at += 6) {
    if ((at == list || at[-1] == ',') && (at[6] == '\0' || at[6] == ',')) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/*
   Returns the smallest limit of the process's control groups [bytes]: memory.max for version 2, memory.limit_in_bytes
   for version 1. root: prefix of the paths /proc and /sys; empty except in tests.
*/
static PetscReal MemoryReadGroups(const char root[])
{
  char      path[MEMORY_LINE], line[MEMORY_LINE], mount[MEMORY_LINE];
  FILE     *stream;
  PetscReal limit = PETSC_INFINITY;

  (void)snprintf(path, sizeof(path), "%s/proc/self/cgroup", root);
  stream = fopen(path, "r");
  if (!stream) return limit;
  while (fgets(line, sizeof(line), stream)) { /* a line reads number:controllers:path */
    char *controllers = strchr(line, ':'), *group = controllers ? strchr(controllers + 1, ':') : NULL;

    if (!group) continue;
    *group++                    = '\0';
    group[strcspn(group, "\n")] = '\0';
    controllers++;
    if (!*controllers) { /* only version 2 has an empty list of controllers */
      (void)snprintf(mount, sizeof(mount), "%s/sys/fs/cgroup", root);
      limit = PetscMin(limit, MemoryReadGroup(mount, group, "memory.max"));
    } else if (MemoryIsController(controllers)) {
      (void)snprintf(mount, sizeof(mount), "%s/sys/fs/cgroup/memory", root);
      limit = PetscMin(limit, MemoryReadGroup(mount, group, "memory.limit_in_bytes"));
    }
  }
  (void)fclose(stream);
  return limit;
}

/*
   Returns the memory of this rank's machine [bytes], or the limit of its control group if that is less. All processes
   on the machine share it.
*/
static PetscReal MemoryOfMachine(const char root[])
{
  const PetscReal physical = (PetscReal)sysconf(_SC_PHYS_PAGES) * (PetscReal)sysconf(_SC_PAGESIZE);

  return PetscMin(physical, MemoryReadGroups(root));
}

/*
   PCAMGFSumMemory_Private - computes the memory that all ranks together may use if all use equal amounts

   Collective

   Input Parameters:
   + comm    - the ranks
   - machine - memory of this rank's machine [bytes], which the ranks on this machine share; may differ from rank to
   rank

   Output Parameter:
   . all - number of ranks times the smallest share of a rank [bytes]; the same on all ranks
*/
PetscErrorCode PCAMGFSumMemory_Private(MPI_Comm comm, PetscReal machine, PetscReal *all)
{
  MPI_Comm    node;
  PetscMPIInt size, here;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCallMPI(MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node));
  PetscCallMPI(MPI_Comm_size(node, &here));
  PetscCallMPI(MPI_Comm_free(&node));
  *all = machine / here;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all, 1, MPIU_REAL, MPIU_MIN, comm));
  *all *= size;
  PetscFunctionReturn(0);
}

/*
   PCAMGFGetMemory_Private - computes the memory that all ranks of comm together may use [bytes], see
   PCAMGFSumMemory_Private()

   Collective
*/
PetscErrorCode PCAMGFGetMemory_Private(MPI_Comm comm, PetscReal *all)
{
  PetscFunctionBegin;
  PetscCall(PCAMGFSumMemory_Private(comm, MemoryOfMachine(""), all));
  PetscFunctionReturn(0);
}
