# Every two effects of a scene together: contact, laws, elements, ties, rigid bodies, supports, loads, solvers, ranks, restart. `combinations.py table` prints what is refused, and why.
"$PYTHON" "$AMGF_DIR/tests/combinations.py"
