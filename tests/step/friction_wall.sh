# A wall of bricks that is pushed at its top: its reduced problem with friction has more than 400 rows, and the rounds
# of the convex problem approach the solution slowly. The run must end although no method solves such a problem exactly
"$PYTHON" "$AMGF_DIR/tests/step/friction_wall.py" scene > wall.yaml
timeout 1200 "$AMGF_DIR/bin/contact" wall.yaml -quiet -summary wall.json -tao_ipfilter_tol 2e-6 2> wall.err
echo "exit $?"
"$PYTHON" "$AMGF_DIR/tests/step/friction_wall.py"
