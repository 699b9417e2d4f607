# rolling with the roller on three ranks, too
set -- long
. "$AMGF_DIR/tests/constraints/rolling.sh"
