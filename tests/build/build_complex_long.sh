# A PETSc with complex scalars: make builds the plugin, in a tree of its own, and PCAMGF solves Hermitian positive
# definite systems on 1 and 2 ranks.
. "$AMGF_DIR/tests/lib/own_folder.sh"
for name in makefile pc_amgf tao_ipfilter src include apps share; do ln -s "$AMGF_DIR/$name" .; done
make PETSC_DIR="$COMPLEX_PETSC" PETSC_ARCH= CFLAGS='-g -O1 -Werror=incompatible-pointer-types' all > log 2>&1 || cat log
find lib bin ! -type d 2> /dev/null | sed 's/\.so\..*/.so/' | sort -u

export PKG_CONFIG_PATH=$COMPLEX_PETSC/lib/pkgconfig
mpicc -std=c11 -g -O1 -Iinclude $(pkg-config --cflags PETSc) "$AMGF_DIR/tests/pc_amgf/amgf_hermitian.c" -o hermitian \
  -Llib -lpetscamgf -Wl,-rpath,"$work/lib" $(pkg-config --libs PETSc) -lm
for ranks in 1 2; do
  for kind in solves transposes; do
    arguments=
    [ $kind = solves ] || arguments=$(sed \
      -n '/suffix: transposes/,$s/^ *args: //p' "$AMGF_DIR/tests/pc_amgf/amgf_hermitian.c")
    mpiexec --oversubscribe -n $ranks ./hermitian $arguments > found
    petscdiff -j "$AMGF_DIR/tests/pc_amgf/amgf_hermitian_$kind.out" found && echo "$kind, ranks $ranks: ok"
  done
done
