# -tao_type ipfilter in PETSc's own constrained tutorials, not recompiled for it: ex1 (with and without its equality)
# and maros with its HS21 data, to the solutions that almm, pdipm and ipm find. PDIPM runs on one rank only, where it
# ends, and not in maros, where PETSc 3.18's crashes; ipm is the solver that maros is written for.
set -u
plugin=$AMGF_DIR/lib/libpetscamgf.so
prefix=$(pkg-config --variable=prefix PETSc)
for folder in "$prefix/share/petsc/examples" "$prefix" "${PETSC_DIR:-/nonexistent}"; do
  tutorials=$folder/src/tao/constrained/tutorials
  [ -f "$tutorials/ex1.c" ] && break
done
for tutorial in ex1 maros; do
  mpicc $(pkg-config --cflags PETSc) "$tutorials/$tutorial.c" -o $tutorial $(pkg-config --libs PETSc) ${LDFLAGS:-} \
    -Wl,-rpath,"$(pkg-config --variable=libdir PETSc)" -lm || exit 1
done

# objective NAME RANKS PROGRAM...: the line of the run, and its objective in $value; almm views its inner solver first
objective() {
  local name=$1 ranks=$2
  shift 2
  timeout 600 mpiexec --oversubscribe -n "$ranks" "$@" -tao_view -tao_converged_reason > out 2>&1
  value=$(sed -n 's/.*Objective value=//p' out | tail -n 1)
  echo "$name: $(grep -o 'CONVERGED_[A-Z]*' out | head -n 1)"
}

# same REFERENCE VALUE
same() {
  awk -v a="$1" -v b="$2" '
    function abs(x) { return x < 0 ? -x : x }
    BEGIN {
      same = a != "" && b != "" && abs(a - b) <= 1e-4 * (1 + abs(a))
      print same ? "  same objective" : "  NOT THE SAME: " a " " b
    }'
}

ipfilter=(-dll_append "$plugin" -tao_type ipfilter)
# almm's own tolerance of 1e-4 leaves 4e-4 of the objective with PETSc 3.25
almm_tightly=(-tao_type almm -tao_gatol 1e-7)
objective "ex1, almm" 1 ./ex1 "${almm_tightly[@]}"
almm=$value
objective "ex1, pdipm" 1 ./ex1 -tao_type pdipm -tao_pdipm_kkt_shift_pd -tao_gatol 1e-6
same "$almm" "$value"
for ranks in 1 2; do
  objective "ex1, ipfilter, $ranks" $ranks ./ex1 "${ipfilter[@]}"
  same "$almm" "$value"
done
objective "ex1 -no_eq, almm" 1 ./ex1 -no_eq "${almm_tightly[@]}"
almm=$value
for ranks in 1 2; do
  objective "ex1 -no_eq, ipfilter, $ranks" $ranks ./ex1 -no_eq "${ipfilter[@]}"
  same "$almm" "$value"
done
# maros looks for its data where it runs; they are of 32-bit integers
cp -rL "$tutorials/HS21" .
ipm=(-tao_type ipm)
if grep -qs 'define PETSC_USE_64BIT_INDICES' "$(pkg-config --variable=includedir PETSc)/petscconf.h"; then
  "$PYTHON" "$AMGF_DIR/tests/build/indices64.py" HS21/*
fi
# maros asks for SuperLU, which Debian has for 32-bit integers alone
grep -qs 'define PETSC_HAVE_SUPERLU 1' "$(pkg-config --variable=includedir PETSc)/petscconf.h" ||
  ipm+=(-pc_factor_mat_solver_type mumps)
objective "maros HS21, ipm" 1 ./maros "${ipm[@]}"
reference=$value
objective "maros HS21, ipfilter" 1 ./maros "${ipfilter[@]}"
same "$reference" "$value"
