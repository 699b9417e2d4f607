# Rigid surfaces of STL files, text and binary, closed and open; wrong files
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_stl.py" scenes
for scene in box box_mm sheet plane ball sphere; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2> /dev/null || echo "$scene: exit code $?"
done
mpiexec --oversubscribe -n 3 "$contact" ball.yaml -quiet -summary ball_3.json || echo "ball, three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_stl.py"
for scene in word early loop short empty turned none; do
  "$contact" $scene.yaml -quiet 2>&1 | sed "s|$PWD/||g" | cut -c1-220
  echo "exit code ${PIPESTATUS[0]}"
done
