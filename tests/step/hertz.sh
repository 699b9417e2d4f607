# Hertz's sphere and cylinder on three meshes. The cells at the contact are sqrt(2) smaller from mesh to mesh, and the
# finest mesh is the shipped one. hertz.py compares pressures, contact areas and approaches with the exact solutions.
# SSNV104 is run as shipped.
run() {
  "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -output "$1" -summary "$1.json" || echo "$1: exit code $?"
}

shipped() {
  cp "$AMGF_DIR/share/scenes/$1.yaml" "$2.yaml"
  run "$2"
}

coarser() {
  "$PYTHON" "$AMGF_DIR/share/scenes/meshes.py" "hertz_$1" "$2" > "$1_$2.yaml"
  run "$1_$2"
}

judge() {
  PYTHONPATH=$AMGF_DIR/share/scenes:$AMGF_DIR/tests/lib "$PYTHON" "$AMGF_DIR/tests/step/hertz.py" "$@"
}

for body in sphere cylinder; do
  coarser $body coarse
  coarser $body medium
  shipped hertz_$body ${body}_fine
  judge $body ${body}_coarse ${body}_medium ${body}_fine
done

shipped ssnv104 ssnv104
judge ssnv104 ssnv104
