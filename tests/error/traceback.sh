# An error ends every rank, with -traceback and without: one that all ranks meet, one that a rank knows to be its own,
# and one that a rank takes for everybody's. Only rank 2 has the option that is wrong.
contact=$AMGF_DIR/bin/contact
scene="$AMGF_DIR/share/scenes/two_block.yaml -refine 0 -quiet"

# try NAME COMMAND: how it ends, what it says in a sentence, and whether PETSc's traceback leads to where it was raised
try() {
  echo "$1"
  shift
  timeout -k 5 100 mpiexec --oversubscribe "$@" > out 2>&1
  code=$?
  if [ $code -ge 124 ]; then code=hang; elif [ $code -gt 0 ]; then code='not 0'; fi
  echo "  exit $code, traceback to main: $(grep -c 'PETSC ERROR: #[0-9]* AppRun()' out)"
  grep -ao 'contact: error.*' out | sed -e "s|$AMGF_DIR/||" -e 's/ (do not.*//; s/"wide"/wide/' -e 's/^/  /'
}

for traceback in '' ' -traceback'; do
  # shellcheck disable=SC2086
  {
    try "all ranks$traceback" -n 3 "$contact" nowhere.yaml $traceback
    try "a rank that knows$traceback" -n 2 "$contact" $scene $traceback : -n 1 "$contact" $scene $traceback \
      -tao_ipfilter_ksp_norm_type wide
    try "a rank that does not$traceback" -n 2 "$contact" $scene $traceback : -n 1 "$contact" $scene $traceback \
      -load_steps 0
  }
done
