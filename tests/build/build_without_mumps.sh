# A PETSc without MUMPS, as -DAMGF_WITHOUT_MUMPS makes of any: no object of ours calls a function of MUMPS, which would
# not link, and PCAMGF's filter is solved by PETSc's own Cholesky, on 1 and 2 ranks.
set -u
unset MAKEFLAGS
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1
export PKG_CONFIG_PATH=${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}${PKG_CONFIG_PATH:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
for name in makefile pc_amgf tao_ipfilter src include apps share; do ln -s "$AMGF_DIR/$name" .; done
make -k CPPFLAGS=-DAMGF_WITHOUT_MUMPS CFLAGS='-g -O0' lib/libpetscamgf.so > log 2>&1 || cat log
for objects in build/pc_amgf build/tao_ipfilter "$AMGF_DIR/build/src" "$AMGF_DIR/build/apps"; do
  find "$objects" -name '*.o' | grep -q . || echo "no objects in $objects"
  calls=$(find "$objects" -name '*.o' -exec nm -A -u {} + | grep 'MatMumps' | sed "s|$AMGF_DIR/||")
  echo "${objects#"$AMGF_DIR"/}: ${calls:-no call}"
done

mpicc -std=c11 -g -O1 -Iinclude $(pkg-config --cflags PETSc) "$AMGF_DIR/tests/pc_amgf/amgf_hermitian.c" -o hermitian \
  -Llib -lpetscamgf -Wl,-rpath,"$work/lib",-rpath,"$(pkg-config --variable=libdir PETSc)" $(pkg-config --libs PETSc) -lm
for ranks in 1 2; do
  mpiexec --oversubscribe -n $ranks ./hermitian -ksp_view > view
  grep -E '^(bfb|fbf|additive)|^  [A-Za-z].*: (ok|[0-9.e+-]* exceeds)' view > found
  petscdiff -j "$AMGF_DIR/tests/pc_amgf/amgf_hermitian_solves.out" found && echo "ranks $ranks: solves"
  sed -n '/KSP Object: (amgf_filter_)/,/linear system matrix/ {
    s/.*package used to perform factorization: /  factored by /p
  }' view | sort -u
done
