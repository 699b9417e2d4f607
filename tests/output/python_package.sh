# The Python package: it runs a scene, reads history, summary, fields and lines, and draws; the cells of the notebook
# run; what is not there is named in one sentence.
unset DISPLAY
cp "$AMGF_DIR/share/scenes/two_block.yaml" .
PYTHONPATH=$AMGF_DIR/share/python "$PYTHON" -B "$AMGF_DIR/tests/output/python_package.py" "$AMGF_DIR/share/python"
