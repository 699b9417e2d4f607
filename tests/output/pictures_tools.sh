# Rigid tools are drawn by their own surfaces: for each shape the points of the drawn surface lie on the exact one, also
# after the tool has moved and turned; the cube that stands for the tool in the mesh is not drawn. A run whose files
# have no tools says which files have them.
"$PYTHON" -B "$AMGF_DIR/tests/output/pictures_tools.py" write
"$AMGF_DIR/bin/contact" tools.yaml -output plain | grep -o 'plain\.xmf (.*)'
"$AMGF_DIR/bin/contact" tools.yaml -quiet -output tools.pvd || echo "exit code $?"
cat > roller.yaml <<'YAML'
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1, poisson: 0.3}
  - roller: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [1, 1, 1], material: rigid}
displacements:
  - foot: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: roller, value: [0, 0, -0.01]}
contact:
  - touch: {mortar: roller.zmin, nonmortar: block.zmax}
YAML
"$AMGF_DIR/bin/contact" roller.yaml -quiet -output roller || echo "exit code $?"
"$PYTHON" -B "$AMGF_DIR/tests/output/pictures_tools.py" check
"$PYTHON" -B "$AMGF_DIR/share/plot/draw.py" tools tools.png --view 30 -50 || echo "exit code $?"
