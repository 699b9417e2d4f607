# Hertz's sphere and cylinder on three meshes, the finest as shipped, cells at the contact by sqrt(2) smaller from one
# to the next;
# hertz.py holds pressures, contact areas and approaches against the exact solutions. Then SSNV104 as shipped.
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
