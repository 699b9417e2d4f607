# Contact of a surface with itself with friction, with order 2, in two folds, and on one to three ranks
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact.py" write
run() { # scene, ranks
  name=$1$([ "$2" -eq 1 ] || echo "_$2")
  mpiexec --oversubscribe -n "$2" "$contact" "$1.yaml" -quiet -output "$name" -summary "$name.json" \
    -tao_ipfilter_tol 1e-11 2> "$name.log" || echo "$name: exit code $?"
}
for scene in bellows bellows_named slit_face whole jaws_friction named_friction jaws_order2 named_order2; do
  run $scene 1; done
run whole 2
run whole 3
run jaws_friction 3
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact.py" long
