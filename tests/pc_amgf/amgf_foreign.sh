#!/usr/bin/env bash
# The plugin in programs that were never compiled for it: PETSc's tutorials ksp/ex10 (a system from a file) and ksp/ex56
# (elasticity), and a petsc4py script; the subspace from a file, from a composed IS, and by detection. Each line: the
# filter at least halves the iterations of the same AMG alone.
set -eu
top=${AMGF_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
plugin=${AMGF_PLUGIN:-$top/lib/libpetscamgf.so}
python=${PYTHON:-python3}
export PKG_CONFIG_PATH=${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}${PKG_CONFIG_PATH:-}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

prefix=$(pkg-config --variable=prefix PETSc)
for tutorial in ex10 ex56; do
  for folder in "$prefix/share/petsc/examples" "$prefix" "${PETSC_DIR:-/nonexistent}"; do
    source=$folder/src/ksp/ksp/tutorials/$tutorial.c
    if [ -f "$source" ]; then break; fi
  done
  mpicc $(pkg-config --cflags PETSc) "$source" -o $tutorial $(pkg-config --libs PETSc) \
    -Wl,-rpath,"$(pkg-config --variable=libdir PETSc)" -lm
done

# iterations RANKS PROGRAM ARGUMENTS...: of the last solve; "none" if it did not converge
iterations() {
  local ranks=$1 output
  shift
  output=$(mpiexec --oversubscribe -n "$ranks" "$@" -ksp_type cg -ksp_rtol 1e-10 -ksp_max_it 3000 -ksp_converged_reason)
  echo "$output" | sed -n 's/.*solve converged due to .* iterations \([0-9]*\)$/\1/p' | tail -n 1 | grep . || echo none
}

# alone RANKS PROGRAM ARGUMENTS...: sets the program and what it is compared with
alone() {
  ranks=$1
  shift
  program=("$@")
  unfiltered=$(iterations "$ranks" "${program[@]}" -dll_append "$plugin" -pc_type amgf)
}

# filtered NAME FILTER_OPTIONS...
filtered() {
  local name=$1 its
  shift
  its=$(iterations "$ranks" "${program[@]}" -dll_append "$plugin" -pc_type amgf "$@")
  if [ "$its" != none ] && { [ "$unfiltered" = none ] || [ $((2 * its)) -le "$unfiltered" ]; }; then
    echo "$name, ranks $ranks: ok"
  else
    echo "$name, ranks $ranks: $its iterations, AMG alone $unfiltered"
  fi
}

script="$python $top/tests/pc_amgf/amgf_foreign.py"
$script -write system > /dev/null
mpiexec --oversubscribe -n 1 ./ex56 -ne 7 -alpha 1e6 -log_stages 0 -ksp_view_mat binary:ex56.mat -ksp_max_it 1 \
  > /dev/null
$script -stiff ex56.mat

alone 1 $script
filtered "petsc4py, composed IS" -filter composed
filtered "petsc4py, file" -pc_amgf_filter_file system.is
filtered "petsc4py, detection" -pc_amgf_detect 20
alone 3 ./ex10 -f system.dat
filtered "ex10, file" -pc_amgf_filter_file system.is
filtered "ex10, detection" -pc_amgf_detect 20
alone 1 ./ex56 -ne 7 -alpha 1e6 -log_stages 0
filtered "ex56, file" -pc_amgf_filter_file ex56.mat.is
filtered "ex56, detection" -pc_amgf_detect 50
