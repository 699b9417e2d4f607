# A set of constraints without friction terms has no arrays of directions. The row of a constraint must not form an
# address in them: undefined behaviour, which the compiler's sanitizer reports.
cd "$(mktemp -d)" && trap 'rm -rf "$PWD"' EXIT
cat > rows.c <<'C'
#include "tao_ipfilter/friction/set.c"

int main(void)
{
  const IPTermSet set        = {.m = 1};
  PetscReal       by_v[2]    = {2.0, 2.0}, by_f[2] = {2.0, 2.0}, by_lambda = 2.0;

  TermSetRow(&set, 0, by_v, by_f, &by_lambda);
  printf("by motions %g %g, by forces %g %g %g\n", by_v[0], by_v[1], by_f[0], by_f[1], by_lambda);
  return 0;
}
C
objects=$(cd "$AMGF_DIR" && ls pc_amgf/*.c pc_amgf/*/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c |
  sed -e '/friction.set.c$/d' -e "s|^\(.*\)c$|$AMGF_DIR/build/\1o|")
export PKG_CONFIG_PATH=${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}${PKG_CONFIG_PATH:-}
mpicc -std=c11 -fsanitize=undefined -fno-sanitize-recover=all -Wl,--copy-dt-needed-entries \
  -I"$AMGF_DIR/include" -I"$AMGF_DIR" $(pkg-config --cflags PETSc) rows.c $objects \
  $(pkg-config --libs PETSc) -lm -Wl,-rpath,"$(pkg-config --variable=libdir PETSc)" -o rows &&
  ./rows 2>&1 | sed 's/.*runtime error/runtime error/'
