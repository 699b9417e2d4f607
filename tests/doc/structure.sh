# The rules of the tree's structure, by nm and by reading the sources: structure.py says which they are, and a line or
# more where one is broken
"$PYTHON" "$AMGF_DIR/tests/doc/structure.py"
