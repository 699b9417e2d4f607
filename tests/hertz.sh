# Hertz's sphere and cylinder on three meshes, the finest as shipped, cells at the contact by sqrt(2) smaller from one to the next;
# check_hertz.py holds pressures, contact areas and approaches against the exact solutions. Then SSNV104 as shipped.
run() {
  "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -output "$1" -summary "$1.json" || echo "$1: exit code $?"
}

shipped() {
  cp "$AMGF_DIR/share/scenes/$1.yaml" "$2.yaml"
  run "$2"
}

sphere() { # one of the bench's meshes
  PYTHONPATH=$AMGF_DIR/share/bench "$PYTHON" -B -c 'import sys; from problems import PROBLEMS; print(PROBLEMS["hertz_sphere"].scene(sys.argv[1]))' "$1" > "sphere_$1.yaml"
  run "sphere_$1"
}
sphere coarse
sphere medium
shipped hertz_sphere sphere_fine
"$PYTHON" "$AMGF_DIR/tests/check_hertz.py" sphere sphere_coarse sphere_medium sphere_fine

cylinder() { # name, cells around, grading, even; in the ring, grading, even
  sed -e "s/^ *patches: .*/      patches: [8, $2, $5]/" -e "s/^ *grading: .*/      grading: [1, $3, $6]/" -e "s/^ *even: .*/      even: [1, $4, $7]/" \
      "$AMGF_DIR/share/scenes/hertz_cylinder.yaml" > "$1.yaml"
  run "$1"
}
cylinder cylinder_coarse 19 361.2 6 14 0.004865 2
cylinder cylinder_medium 28 432.9 9 20 0.00386 3
shipped hertz_cylinder cylinder_fine
"$PYTHON" "$AMGF_DIR/tests/check_hertz.py" cylinder cylinder_coarse cylinder_medium cylinder_fine

shipped ssnv104 ssnv104
"$PYTHON" "$AMGF_DIR/tests/check_hertz.py" ssnv104 ssnv104
