# A thick ring of few cells between two plates. The contact updates converge with smooth faces and with facets. The
# exception is a ring whose corner touches first, solved by the interior point method: its updates cycle, with any
# damping. The test also checks message and exit code of a run whose gap is inconsistent. gap_cycle.py writes mesh and
# scene of the ring, and judges the runs.
contact=$AMGF_DIR/bin/contact

"$PYTHON" "$AMGF_DIR/tests/contact/gap_cycle.py" write 16
coarse="penetrates the other body\|times as large as those of the mortar face" \
  # true of so few facets, and beside the point here
run() {
  name=$1
  shift
  "$contact" ring.yaml -quiet -error_estimate 0 -summary "$name.json" "$@" 2> err
  echo "$name: exit code $?, $(grep -v "$coarse" err | sed -n 's/^contact: \([a-z]*\).*/\1/p' | tr '\n' ' ')"
}
# The ring rolls easily: a gap off by 1e-6 of its push still leaves a force to the side
run smooth -contact_update_tol 1e-7
run facets -contact_smooth false
run single -contact_updates 1
"$PYTHON" "$AMGF_DIR/tests/contact/gap_cycle.py" write 14
run corner -load_max_cuts 0 -contact_smooth false
run circle -load_max_cuts 0 -contact_smooth false -tao_ipfilter_subspace false
"$PYTHON" "$AMGF_DIR/tests/contact/gap_cycle.py" judge
