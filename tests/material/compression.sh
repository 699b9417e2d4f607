# Blocks of order 2 with a law of finite strain are compressed by 44 % between frictionless plates. The block stays in
# uniform strain, up to the strain at which its free sides wrinkle (56 %). compression.py writes the scenes and checks.
"$PYTHON" "$AMGF_DIR/tests/material/compression.py" scenes
for scene in *.yaml; do
  "$AMGF_DIR/bin/contact" "$scene" -quiet -summary "${scene%.yaml}.json"
done
"$PYTHON" "$AMGF_DIR/tests/material/compression.py" check
