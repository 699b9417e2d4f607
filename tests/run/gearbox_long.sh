# An assembly of 33 parts from a deck of Abaqus, with contact: auto, friction and pretension, to a report page in one
# command. Without Gmsh there is no deck.
command -v gmsh > /dev/null || { cat "$AMGF_DIR/tests/run/gearbox_long.out"; exit; }
"$PYTHON" "$AMGF_DIR/share/scenes/gearbox.py" > gmsh.log 2>&1 || cat gmsh.log
timeout 3000 "$AMGF_DIR/bin/contact" gearbox.yaml -quiet -report gearbox.html -summary gearbox.json 2> warnings ||
  cat warnings
"$PYTHON" "$AMGF_DIR/tests/run/gearbox_long.py"
