# friction_unload with the block on two ranks
set -- block
. "$AMGF_DIR/tests/step/friction_unload.sh"
