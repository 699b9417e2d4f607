# PETSC_DIR, given to make or in the environment, is the PETSc of every target, not the one that pkg-config finds first;
# one that has none is an error. Another PETSc, compiler or flag compiles everything anew, and nothing else does.
set -u
unset MAKEFLAGS
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for name in another third; do
  mkdir -p "$work/$name/lib/pkgconfig"
  cat > "$work/$name/lib/pkgconfig/PETSc.pc" << PC
prefix=$work/$name
libdir=$work/$name/lib
Name: PETSc
Description: of the user's own
Version: 3.18.5
Cflags: -I$work/$name/include
Libs: -L$work/$name/lib -lpetsc_of_the_user
PC
done

# commands GOAL ASSIGNMENTS...: what make would run, with the assignments given to it or in the environment
judge() {
  sed -i -e ':join' -e '/\\$/ { N; s/\\\n[\t ]*//; b join' -e '}' commands
  grep -q -- "-I$work/another/include .*pc_amgf/amgf.c" commands && echo "  compiled with its headers"
  grep -q -- "-shared .*-lpetsc_of_the_user" commands && echo "  linked with its library"
  grep -E -- ' -c | -o (bin|lib)/' commands | grep -v -- "$work/another" | grep -v '^mkdir'
  grep -q -- '-lpetsc_real' commands && echo "  linked with another, too"
}
for arguments in "PETSC_DIR=$work/another PETSC_ARCH=" "PETSC_DIR=$work PETSC_ARCH=another"; do
  for goal in all $([ "$arguments" = "${arguments%/another *}" ] || echo lib/libpetscamgf.so install); do
    echo "$goal ${arguments//$work/DIR}"
    make -C "$AMGF_DIR" --no-print-directory -Bn V=1 $arguments $goal > commands
    judge
    env -u PKG_CONFIG_PATH $arguments make -C "$AMGF_DIR" --no-print-directory -Bn V=1 $goal > commands
    judge
  done
done
for goal in all install check; do
  make -C "$AMGF_DIR" PETSC_DIR="$work/none" PETSC_ARCH= $goal > out 2>&1 && echo "$goal: taken"
  sed -n "s|$work|DIR|g; s/.*\*\*\* \(PETSC_DIR=.*\)\.  Stop\./$goal: \1/p" out
done

# A compiler that only counts
cd "$work" || exit 1
for name in makefile pc_amgf tao_ipfilter src include apps share; do ln -s "$AMGF_DIR/$name" .; done
for name in cc1 cc2; do
  cat > $name <<COMPILER
#!/bin/sh
case \$1 in
  --version) echo $name ;;
  *) while [ "\$1" != -o ]; do shift; done; touch "\$2"; echo "\$2" >> $work/made ;;
esac
COMPILER
  chmod +x $name
done
objects=$(ls pc_amgf/*.c pc_amgf/*/*.c src/plugin/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c | wc -l)
again() {
  rm -f made
  sleep 0.01
  make "$@" lib/libpetscamgf.so > log 2>&1 || cat log
  touch made
  echo "${*//$work/DIR}: $(grep -c '\.o$' made | sed "s/^$objects$/everything/;
    s/^0$/nothing/") compiled, $(grep -c '\.so' made) linked"
}
first="PETSC_DIR=$work/another PETSC_ARCH="
again $first CC=./cc1
again $first CC=./cc1
again $first CC=./cc2
again $first CC=./cc2 CFLAGS=-O0
again $first CC=./cc2 CFLAGS=-O0 LDFLAGS=-Wl,-z,now
again PETSC_DIR="$work/third" PETSC_ARCH= CC=./cc2 CFLAGS=-O0 LDFLAGS=-Wl,-z,now
mkdir third/include
echo '#define PETSC_USE_64BIT_INDICES 1' > third/include/petscconf.h
again PETSC_DIR="$work/third" PETSC_ARCH= CC=./cc2 CFLAGS=-O0 LDFLAGS=-Wl,-z,now
exit 0
