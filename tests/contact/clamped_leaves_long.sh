# The test clamped_leaves with three leaves
set -- 3
. "$AMGF_DIR/tests/contact/clamped_leaves.sh"
