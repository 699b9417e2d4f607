# All sources and tests compile where GCC 14 makes errors of what older compilers warn of: pointers of other types,
# integers as pointers, functions without declaration, casts between kinds of functions. Formats of printed values
# count, too. Also with a PETSc of 64-bit integers, where a PetscInt is not an int, if its headers are there:
# libpetsc64-real-dev, or PETSC64=its prefix.
set -u
cd "$AMGF_DIR" || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
refused=(incompatible-pointer-types int-conversion implicit-function-declaration implicit-int cast-function-type format)
PETSC64=${PETSC64-$(ls -d /usr/lib/petscdir/petsc64-*/*-real 2> /dev/null | tail -n 1)}
hdf5=$(pkg-config --cflags hdf5-openmpi 2> /dev/null || pkg-config --cflags hdf5)
ours=$(pkg-config --cflags PETSc)

# compile HEADERS FILE...: errors only
compile() {
  local headers=$1
  shift
  mpicc -std=c11 -fsyntax-only -Wall -Wextra "${refused[@]/#/-Werror=}" '-DCONTACT_PYTHON=""' -Iinclude \
    -I. $headers $hdf5 "$@" 2>&1 | grep -E 'error|fatal'
}

all="$(ls pc_amgf/*.c pc_amgf/*/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c src/*/*.c src/*/*/*.c apps/*.c)
$(ls tests/*/*.c | grep -vE '^tests/(stress|fuzz)/')"
compile "$ours" $all || echo "32-bit integers: compiles"
wide="-I$PETSC64/include"
[ -f "$PETSC64/include/petscconf.h" ] || wide=$ours
compile "$wide" $all || echo "64-bit integers, where installed: compiles"

# What is refused is seen
refuses() { compile "$1" "$work/wrong.c" > "$work/log" && grep -oE '\[-Werror=[a-z=-]*\]' "$work/log" | sort -u; }
wrong() { printf '#include <petscsys.h>\nPetscErrorCode Count(PetscInt *n);\n%s\n' "$1" > "$work/wrong.c"; }
wrong 'PetscErrorCode Wrong(short *n) { return Count(n); }'
refuses "$ours"
wrong 'int Wrong(char *text) { return text; }'
refuses "$ours"
wrong 'PetscErrorCode (*Wrong(void))(PetscInt) { return (PetscErrorCode (*)(PetscInt))Count; }'
refuses "$ours"
wrong 'PetscErrorCode Wrong(PetscInt *n) { return PetscPrintf(PETSC_COMM_SELF, "%f", *n); }'
refuses "$ours"
exit 0
