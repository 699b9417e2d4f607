# The bench on one tiny page: tables and figure are made, what has been run is not run again, and one lost record is one
# run to make.
# bench.py: the extrapolation, exponents and crossovers behind its figures. The bench itself is what is tested here, so
# that its modules are imported.
bench() {
  "$PYTHON" -B "$AMGF_DIR/share/bench/run.py" --size tiny --folder bench --only "$@"
}

rm -rf bench
bench material > first.log || echo "exit code $?"
grep -c 'converged, ' first.log
for file in material.md material.csv material.png quadrature.png; do
  [ -s bench/pages/knobs/$file ] && echo "$file" || echo "$file is missing"
done
bench material --plan | tail -n 1
PYTHONPATH=$AMGF_DIR/share/bench:$AMGF_DIR/tests/lib "$PYTHON" "$AMGF_DIR/tests/doc/bench.py" bench
rm "bench/runs/$(ls bench/runs | head -n 1)"
bench material --plan | tail -n 1
bench no-such-page 2>&1 | cut -d: -f2
