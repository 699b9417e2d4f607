# Every two effects of a scene together: contact, laws, elements, ties, rigid bodies, supports, loads, solvers, ranks,
# restart. `combinations.py table` prints what is refused, and why; `make stress STRESS=together` runs all of it, and
# three together.
"$PYTHON" "$AMGF_DIR/tests/step/combinations.py"
