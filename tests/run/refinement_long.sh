# The test refinement, on further numbers of ranks
set -- long
. "$AMGF_DIR/tests/run/refinement.sh"
