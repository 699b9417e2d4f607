# Values that keys cannot have, a part of them: unknown faces, bodies and ramps, numbers that are none, not finite or
# too many, keys misspelt. `bad_values.py all` tries every one.
"$PYTHON" "$AMGF_DIR/tests/options/bad_values.py"
cat > names.yaml << 'END'
problem: names
bodies:
  - "lower, block": {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3}
displacements:
  - floor: {face: "lower, block.zmin", value: [0, 0, 0]}
END
"$AMGF_DIR/bin/contact" names.yaml -scene_check 2>&1 || echo "exit code $?"
# Held at one point a body turns about it
cat > point.yaml << 'END'
problem: point
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 10, poisson: 0.3}
displacements:
  - pin: {body: block, point: [0, 0, 0], value: [0, 0, 0]}
END
"$AMGF_DIR/bin/contact" point.yaml -scene_check 2>&1 || echo "exit code $?"
