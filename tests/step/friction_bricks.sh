# 32 bodies that only contact and friction hold, with 4,000 rows of which most stay open: Newton's method fails on them,
# and dense factors are large (friction_bricks.py)
"$PYTHON" "$AMGF_DIR/tests/step/friction_bricks.py" scene
timeout 1200 "$AMGF_DIR/bin/contact" bricks.yaml -quiet -summary bricks.json 2> warnings
"$PYTHON" "$AMGF_DIR/tests/step/friction_bricks.py"
