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
given_up="$given_up|SNESLINESEARCHBASIC|PetscIgnoreErrorHandler|VecChop|VecPointwiseDivide"
grep -rnE "$given_up" --include='*.[ch]' pc_amgf tao_ipfilter include src apps tests |
  grep -v '^include/petsccompat.h:' || echo "no name that a release has given up, but where releases differ"

# Members of PETSc's structs have no promise of staying. An implementation of a type fills its object's table of
# functions, and reads what PETSc's own types read of their objects, and what no public call gives.
table='ops->(setup|solve|apply|applytranspose|presolve|postsolve|reset|destroy|view|setfromoptions|matsolve|computedual'
table="$table|convergencetest|choleskyfactornumeric|choleskyfactorsymbolic)"
tao='data|solution|gradient|hessian(_pre)?|X[LU]|I[LU]|D[EI]|ksp|ksp_its|ksp_tot_its|niter|reason|fc|residual|cnorm'
tao="$tao|(gatol|catol|crtol)(_changed)?|(in)?eq_constrained|constraints_(in)?equality|jacobian_(in)?equality(_pre)?"
tao="$tao|user_update|cnvP|ops->computeconstraints"
pc='data|pmat|mat|erroriffailure|setupcalled'
ksp='normtype_set|pc_side_set|normsupporttable'
factors='data|factorerrortype|factorerror_zeropivot_(value|row)|assembled|solvertype'
# others FOLDER...: FILE:LINE:MEMBER for every other member
others() {
  grep -rnowE '(tao|pc|ksp|F)->(ops->)?\w+' --include='*.[ch]' "$@" |
    grep -vE ":(tao->($tao|$table)|pc->($pc|$table)|ksp->($ksp)|F->($factors|$table))$"
}
others pc_amgf tao_ipfilter src apps || echo "no other member of PETSc's structs"
work=$(mktemp -d)
echo 'return tao->ops->computehessian == Hessian || pc->useAmat || tao->solution;' > "$work/wrong.c"
others "$work" | cut -d: -f3
rm -r "$work"
