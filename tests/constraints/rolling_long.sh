# rolling with the roller on one rank, too
set -- long
. "$AMGF_DIR/tests/constraints/rolling.sh"
