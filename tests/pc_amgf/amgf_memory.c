static char help[] = "PCAMGF: the memory that a factorization may take is that of control groups, where they limit it, "
                     "and the same on all ranks.\n\n";

#include "../../pc_amgf/memory.c"
#include <sys/stat.h>

#define GB (1024.0 * 1024.0 * 1024.0)

/* A file under root, with its folders */
static PetscErrorCode WriteFile(const char root[], const char name[], const char text[])
{
  char  path[PETSC_MAX_PATH_LEN];
  FILE *file;

  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(path, sizeof(path), "%s/%s", root, name));
  for (char *at = strchr(path + strlen(root) + 1, '/'); at; at = strchr(at + 1, '/')) {
    *at = '\0';
    (void)mkdir(path, 0777);
    *at = '/';
  }
  file = fopen(path, "w");
  PetscCheck(file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s", path);
  (void)fputs(text, file);
  (void)fclose(file);
  PetscFunctionReturn(0);
}

typedef struct {
  const char *what, *cgroup, *file, *limit, *outer, *outer_limit;
  PetscReal   expected;
} Case;

/* "root" is removed by PetscRMTree(), so it is empty at the beginning of each */
static PetscErrorCode CheckGroups(const char top[])
{
  const Case cases[] = {
    {"no control groups", NULL, NULL, NULL, NULL, NULL, PETSC_INFINITY},
    {"version 2", "0::/job\n", "sys/fs/cgroup/job/memory.max", "1073741824\n", NULL, NULL, GB},
    {"version 2, no limit", "0::/job\n", "sys/fs/cgroup/job/memory.max", "max\n", NULL, NULL, PETSC_INFINITY},
    {"version 2, the limit of the group around it", "0::/user/job\n", "sys/fs/cgroup/user/job/memory.max", "max\n",
      "sys/fs/cgroup/user/memory.max", "2147483648\n", 2 * GB},
    {"version 2, in a container", "0::/\n", "sys/fs/cgroup/memory.max", "1073741824\n", NULL, NULL, GB},
    {"version 2, its path from outside the container", "0::/../pod/job\n", "sys/fs/cgroup/memory.max", "1073741824\n",
      NULL, NULL, GB},
    {"version 1", "5:cpu,memory:/job\n0::/\n", "sys/fs/cgroup/memory/job/memory.limit_in_bytes", "1073741824\n",
      "sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n", GB},
    {"version 1, another controller", "5:cpuset:/job\n", "sys/fs/cgroup/memory/job/memory.limit_in_bytes",
      "1073741824\n", NULL, NULL, PETSC_INFINITY},
    {"version 1, in a container", "4:memory:/docker/1\n", "sys/fs/cgroup/memory/memory.limit_in_bytes", "3221225472\n",
      NULL, NULL, 3 * GB},
  };

  PetscFunctionBeginUser;
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(cases); i++) {
    const Case *c = &cases[i];
    char        root[PETSC_MAX_PATH_LEN];
    PetscReal   limit, machine;

    PetscCall(PetscSNPrintf(root, sizeof(root), "%s/%d", top, (int)i));
    PetscCall(PetscMkdir(root));
    if (c->cgroup) PetscCall(WriteFile(root, "proc/self/cgroup", c->cgroup));
    if (c->file) PetscCall(WriteFile(root, c->file, c->limit));
    if (c->outer) PetscCall(WriteFile(root, c->outer, c->outer_limit));
    limit   = MemoryReadGroups(root);
    machine = MemoryOfMachine(root);
    PetscCall(PetscPrintf(PETSC_COMM_SELF, "%s: %s\n", c->what,
      limit == c->expected && machine > 0.0 && machine <= limit && machine < 1e15 ? "ok" : "no"));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscMPIInt rank, size;
  PetscReal   all, bounds[2];
  char        top[PETSC_MAX_PATH_LEN] = "amgf_memory.tmp";

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (!rank) {
    PetscCall(PetscRMTree(top));
    PetscCall(PetscMkdir(top));
    PetscCall(CheckGroups(top));
    PetscCall(PetscRMTree(top));
  }
  /* machines of 5, 6, ... GB: the ranks of this one share the least of them */
  PetscCall(PCAMGFSumMemory_Private(PETSC_COMM_WORLD, (5.0 + rank) * GB, &all));
  bounds[0] = all;
  bounds[1] = -all;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 2, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "unequal machines: %s\n",
    bounds[0] == -bounds[1] && PetscAbsReal(all - 5.0 * GB) < 1.0 ? "ok" : "no"));
  PetscCall(PCAMGFGetMemory_Private(PETSC_COMM_WORLD, &all));
  PetscCheck(all > 0.0 && all < 1e15, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "memory %g", (double)all);
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: 1
      nsize: {{1 3}}

TEST*/
