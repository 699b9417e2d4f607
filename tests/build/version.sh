# contact -version, --version and --help: a text, exit code 0, whoever asks, on one rank and on three; the version is
# that of the header.
contact=$AMGF_DIR/bin/contact
version=$(sed -n 's/^#define PETSCAMGF_VERSION_[A-Z]* *\([0-9]*\)$/\1/p' "$AMGF_DIR/include/petscamgf.h" | paste -sd.)
for word in -version --version --help; do
  for ranks in 1 3; do
    launch=()
    [ $ranks -eq 1 ] || launch=(mpiexec --oversubscribe -n $ranks)
    "${launch[@]}" "$contact" $word > out 2> err
    echo "$word, ranks $ranks: exit $?, $(grep -c . err) lines of errors"
    sed -e "s/$version/VERSION/g" -e '/^petscamgf/ s/PETSc [0-9].*/PETSc .../' -e 's/^running .*/running .../' out |
      grep -E 'VERSION|running|^Quasi|^  -refine|^  7'
  done
done
# -help alone, also for one who reads a line of it and no more
"$contact" -help > out 2> err
echo "-help: exit $?, $(grep -c . err) lines of errors, $(grep -c '^  -refine N' out) line of -refine," \
  "its last: $(tail -n 1 out | cut -d: -f1)"
"$contact" -help 2> err | sed q
code=${PIPESTATUS[0]}
echo "-help | sed q: $([ $code -eq 0 ] || [ $code -eq 141 ] && echo well || echo "exit \
  $code"), $(grep -c . err) lines of errors"
readelf -d "$AMGF_DIR/lib/libpetscamgf.so" | sed -n "s/.*soname: \[\(.*\)\]/soname \1/p" |
  sed "s/${version%.*}/MAJOR.MINOR/"
