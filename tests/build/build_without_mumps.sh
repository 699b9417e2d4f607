# A PETSc without MUMPS, as -DAMGF_WITHOUT_MUMPS makes of any: no object of ours calls a function of MUMPS, which would
# not link, and PCAMGF's filter is solved by PETSc's own Cholesky, on 1 and 2 ranks.
. "$AMGF_DIR/tests/lib/own_folder.sh"
export PKG_CONFIG_PATH=${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}${PKG_CONFIG_PATH:-}
# Only files that include pc_amgf/mumps.h depend on the macro
for name in makefile pc_amgf tao_ipfilter src include apps share; do ln -s "$AMGF_DIR/$name" .; done
mkdir build lib && cp -r "$AMGF_DIR"/build/{pc_amgf,tao_ipfilter,src,apps} build
for list in $(grep -rl 'pc_amgf/mumps\.h' build/*/ --include=*.d); do
  source=${list#build/}
  mpicc -std=c11 -g -O0 -fPIC -DAMGF_WITHOUT_MUMPS -I. -Iinclude $(pkg-config --cflags PETSc) \
    -c "${source%d}c" -o "${list%d}o"
done
for folder in pc_amgf tao_ipfilter src apps; do
  find "build/$folder" -name '*.o' | grep -q . || echo "no objects in $folder"
  calls=$(find "build/$folder" -name '*.o' -exec nm -A -u {} + | grep 'MatMumps')
  echo "$folder: ${calls:-no call}"
done
objects=$(ls pc_amgf/*.c pc_amgf/blockamg/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c src/plugin/*.c |
  sed 's|^\(.*\)c$|build/\1o|')
mpicc -shared $objects -o lib/libpetscamgf.so \
  $(pkg-config --libs PETSc) -Wl,-rpath,"$(pkg-config --variable=libdir PETSc)" -lm

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
