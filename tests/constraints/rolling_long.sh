# The test rolling. The roller runs on three ranks, too.
set -- long
. "$AMGF_DIR/tests/constraints/rolling.sh"
