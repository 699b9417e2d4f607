# Calls that PETSc's releases take differently, where compiling with one of them says nothing of the next:
# MPIU_Allreduce() returns a PetscErrorCode before 3.22, for PetscCall(), and an error code of MPI since, for
# PetscCallMPI(). MPI's own MPI_Allreduce() with PetscCallMPI() suits every release.
set -u
cd "$AMGF_DIR" || exit 1
grep -rnE 'PetscCallMPI\(MPI_Allreduce\(' --include='*.[ch]' pc_amgf tao_ipfilter apps src > /dev/null &&
  echo "reductions are called as MPI's"
grep -rnE 'MPIU_Allreduce' --include='*.[ch]' pc_amgf tao_ipfilter include src apps tests || echo "no MPIU_Allreduce"
grep -rnE 'PetscCall\(MPI_' --include='*.[ch]' pc_amgf tao_ipfilter include src apps tests ||
  echo "no MPI error code taken for one of PETSc"
given_up='MPIU_BOOL|PetscContainerSetUserDestroy|TaoSetMonitor\(|PetscOptionsGetViewer|FNORM_NAN'
given_up="$given_up|SNESLINESEARCHBASIC|PetscIgnoreErrorHandler"
grep -rnE "$given_up" --include='*.[ch]' pc_amgf tao_ipfilter include src apps tests |
  grep -v '^include/petsccompat.h:' || echo "no name that a release has given up, but where releases differ"
