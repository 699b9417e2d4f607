# Large free rotations of rigid bodies (rolling.py). rolling_long.sh runs the roller on three ranks, too.
long=${1-}
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/rolling.py" scenes
for scene in roller wheel tube; do
  "$contact" $scene.yaml -quiet -summary $scene.json || echo "$scene: exit code $?"
done
"$contact" bend.yaml -quiet -summary bend.json -output bend || echo "bend: exit code $?"
[ -z "$long" ] || mpiexec --oversubscribe -n 3 "$contact" roller.yaml -quiet -summary roller_3.json ||
  echo "roller, three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/constraints/rolling.py"
