# A plugin that was built with another PETSc than the program's is refused in one sentence, on every rank, wherever
# integers, scalars or release differ.
# The other PETSc is pretended to library.c, which asks; where Debian's with complex scalars or 64-bit integers are
# installed, they build a whole plugin.
. "$AMGF_DIR/tests/lib/own_folder.sh"
export PKG_CONFIG_PATH=${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}${PKG_CONFIG_PATH:-}
cat > program.c << 'C'
#include <petscksp.h>
int main(int argc, char **argv)
{
  PC pc;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PCCreate(PETSC_COMM_WORLD, &pc));
  PetscCall(PCSetType(pc, "amgf"));
  PetscCall(PCDestroy(&pc));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "taken\n"));
  PetscCall(PetscFinalize());
  return 0;
}
C
mpicc $(pkg-config --cflags PETSc) program.c -o program $(pkg-config --libs PETSc) \
  -Wl,-rpath,"$(pkg-config --variable=libdir PETSc)"

# try WHAT PLUGIN: one sentence and an error, or what the program says
try() {
  echo "$1:"
  for ranks in 1 2; do
    if timeout 600 mpiexec --oversubscribe -n $ranks ./program -dll_append "$2" > out 2>&1; then cat out; else
      compiled='s/.*ERROR: libpetscamgf was compiled with'
      sed -n -e "$compiled a PETSc whose \([A-Za-z]*\) has .* but runs in one whose .*/refused for its \1/p" \
        -e "$compiled PETSc [0-9.]*, but runs in PETSc .*/refused for its release/p" out | sort -u
    fi
  done
}

objects=$(cd "$AMGF_DIR" && ls pc_amgf/*.c pc_amgf/*/*.c src/plugin/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c \
  | grep -v 'src/plugin/library.c' | sed "s|^\(.*\)c$|$AMGF_DIR/build/\1o|")

# pretend WHAT DEFINITIONS...: a plugin whose library.c was compiled after them
pretend() {
  local what=$1
  shift
  printf '%s\n' "$@" > pretend.h
  mpicc -std=c11 -fPIC -I"$AMGF_DIR/include" \
    -I"$AMGF_DIR" $(pkg-config --cflags PETSc) -include pretend.h -c "$AMGF_DIR/src/plugin/library.c" -o library.o
  mpicc -shared -Wl,-z,nodelete $objects library.o $(pkg-config --libs PETSc) -lm -o libpetscamgf.so
  try "$what" ./libpetscamgf.so
  rm -f library.o libpetscamgf.so
}

# toggle NAME: the lines that turn a setting of PETSc's over
toggle() { printf '#include <petscconf.h>\n#ifdef %s\n#undef %s\n#else\n#define %s 1\n#endif\n' "$1" "$1" "$1"; }

try "the program's PETSc" "$AMGF_DIR/lib/libpetscamgf.so"
pretend "integers of another size" "$(toggle PETSC_USE_64BIT_INDICES)"
pretend "scalars of another type" "$(toggle PETSC_USE_COMPLEX)"
pretend "another release" '#include <petscversion.h>' '#undef PETSC_VERSION_MINOR' '#define PETSC_VERSION_MINOR 17'

[ -z "${PETSC_DIR:-}" ] || exit 0
for name in makefile pc_amgf tao_ipfilter src include apps share; do ln -s "$AMGF_DIR/$name" .; done
for other in /usr/lib/petscdir/petsc-complex /usr/lib/petscdir/petsc64-real; do
  [ -d $other ] || continue
  make PETSC_DIR=$other PETSC_ARCH= CFLAGS='-g -O0' lib/libpetscamgf.so > log 2>&1 || cat log
  try $other ./lib/libpetscamgf.so > verdict
  [ "$(grep -c refused verdict)" = 2 ] || cat verdict
done
