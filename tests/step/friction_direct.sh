# Blocks with friction against another program's answer, in Python (friction_direct.py), and Coulomb's law at every
# vertex; on one rank and on three
"$PYTHON" "$AMGF_DIR/tests/step/friction_direct.py" scenes
for ranks in 1 3; do
  echo "ranks: $ranks"
  for scene in driven lifted; do
    mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" "$scene.yaml" -quiet -output "$scene" \
      -summary "$scene.json"
  done
  "$PYTHON" "$AMGF_DIR/tests/step/friction_direct.py"
done
