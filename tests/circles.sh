# No two files of a folder call each other in a circle, directly or through others.
"${PYTHON:-python3}" "$AMGF_DIR/tests/circles.py" "$AMGF_DIR" pc_amgf src/material src/output
