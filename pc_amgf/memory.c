/* Memory that all ranks together may use: that of their machines, or less if a control group limits it */
#include "amgfimpl.h"
#include <stdio.h>
#include <unistd.h>

#define MEMORY_LINE 4096

/* The number in a file of a control group; infinite if there is no file or it says "max" */
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
   The smallest limit of a control group and of its parents. Inside a container some folders of the path may not exist.
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

/* Whether a comma-separated list of names contains "memory" */
static PetscBool MemoryIsController(const char list[])
{
  for (const char *at = list; (at = strstr(at, "memory")); at += 6) {
    if ((at == list || at[-1] == ',') && (at[6] == '\0' || at[6] == ',')) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/*
   Limits of the process's control groups [bytes], version 2 (memory.max) and version 1 (memory.limit_in_bytes). root:
   prefix of /proc and /sys, not empty only in tests
*/
static PetscReal MemoryReadGroups(const char root[])
{
  char      path[MEMORY_LINE], line[MEMORY_LINE], mount[MEMORY_LINE];
  FILE     *stream;
  PetscReal limit = PETSC_INFINITY;

  (void)snprintf(path, sizeof(path), "%s/proc/self/cgroup", root);
  stream = fopen(path, "r");
  if (!stream) return limit;
  while (fgets(line, sizeof(line), stream)) { /* number:controllers:path */
    char *controllers = strchr(line, ':'), *group = controllers ? strchr(controllers + 1, ':') : NULL;

    if (!group) continue;
    *group++                    = '\0';
    group[strcspn(group, "\n")] = '\0';
    controllers++;
    if (!*controllers) { /* version 2 */
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

/* Memory of this rank's machine, or less if the process is limited [bytes]. All processes on the machine share it. */
static PetscReal MemoryOfMachine(const char root[])
{
  const PetscReal physical = (PetscReal)sysconf(_SC_PHYS_PAGES) * (PetscReal)sysconf(_SC_PAGESIZE);

  return PetscMin(physical, MemoryReadGroups(root));
}

/*
  PCAMGFSumMemory_Private - what all ranks together may use, if each of them uses as much as the one that has least

  Collective

  Input Parameters:
+ comm    - the ranks
- machine - memory of this rank's machine, which its ranks share; may differ from rank to rank

  Output Parameter:
. all - the same value on all ranks
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
  PCAMGFGetMemory_Private - what all ranks together may use [bytes]; collective, the same on all ranks
*/
PetscErrorCode PCAMGFGetMemory_Private(MPI_Comm comm, PetscReal *all)
{
  PetscFunctionBegin;
  PetscCall(PCAMGFSumMemory_Private(comm, MemoryOfMachine(""), all));
  PetscFunctionReturn(0);
}
