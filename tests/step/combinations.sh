# Every effect of a scene, and an eighth of the pairs of effects: contact, laws, elements, ties, rigid bodies, supports,
# loads, solvers, ranks, restart. combinations_long runs all pairs
"$PYTHON" "$AMGF_DIR/tests/step/combinations.py" part
