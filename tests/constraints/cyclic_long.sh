# A press fit that is turned, as a sector and as a whole, on a refined mesh
"$PYTHON" -B "$AMGF_DIR/tests/constraints/cyclic.py" scenes
for scene in fit_whole fit; do
  "$AMGF_DIR/bin/contact" $scene.yaml -refine 1 -quiet -error_estimate 0 -summary ${scene}_1.json ||
    echo "$scene: exit code $?"
done
"$PYTHON" -B "$AMGF_DIR/tests/constraints/cyclic.py" judge_long
