# The scripts of the bench, on one tiny page. They make the tables and the figure. They do not repeat a run that has a
# record, and repeat only the run whose record is lost. bench.py imports their modules, and tests the extrapolation,
# exponents and crossovers.
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
