# make PETSC_DIR=... compiles and links with the PETSc that is there, not with the one that pkg-config finds first.
set -u
unset MAKEFLAGS
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/another/lib/pkgconfig"
cat > "$work/another/lib/pkgconfig/PETSc.pc" << PC
prefix=$work/another
libdir=$work/another/lib
Name: PETSc
Description: of the user's own
Version: 3.18.5
Cflags: -I$work/another/include
Libs: -L$work/another/lib -lpetsc_of_the_user
PC
for arguments in "PETSC_DIR=$work/another PETSC_ARCH=" "PETSC_DIR=$work PETSC_ARCH=another"; do
  make -C "$AMGF_DIR" --no-print-directory -Bn V=1 $arguments lib/libpetscamgf.so > commands
  echo "${arguments//$work/DIR}"
  grep -q -- "-I$work/another/include .*pc_amgf/amgf.c" commands && echo "  compiled with its headers"
  grep -q -- "-shared .*-lpetsc_of_the_user" commands && echo "  linked with its library"
  grep -q -- '-lpetsc_real' commands && echo "  linked with another, too"
done
exit 0
