# refinement on more numbers of ranks
set -- long
. "$AMGF_DIR/tests/run/refinement.sh"
