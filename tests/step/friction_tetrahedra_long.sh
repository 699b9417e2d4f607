# friction_tetrahedra with all kinds of cells
set -- long
. "$AMGF_DIR/tests/step/friction_tetrahedra.sh"
