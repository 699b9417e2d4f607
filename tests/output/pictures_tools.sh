# Rigid tools are drawn by their own surfaces: for each shape the points of the drawn surface lie on the exact one, also
# after the tool has moved and turned; the cube that stands for the tool in the mesh is not drawn.
"$PYTHON" -B "$AMGF_DIR/tests/output/pictures_tools.py" write
"$AMGF_DIR/bin/contact" tools.yaml -quiet -output tools || echo "exit code $?"
"$PYTHON" -B "$AMGF_DIR/tests/output/pictures_tools.py" check
"$PYTHON" -B "$AMGF_DIR/share/plot/draw.py" tools tools.png --view 30 -50 || echo "exit code $?"
