# Large free rotations of rigid bodies (rolling.py), on one rank or on three (rolling_long: the roller on both)
long=${1-}
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/rolling.py" scenes
for scene in ${long:+roller} wheel tube; do
  "$contact" $scene.yaml -quiet -summary $scene.json || echo "$scene: exit code $?"
done
"$contact" bend.yaml -quiet -summary bend.json -output bend || echo "bend: exit code $?"
mpiexec --oversubscribe -n 3 "$contact" roller.yaml -quiet -summary roller_3.json ||
  echo "roller, three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/constraints/rolling.py"
