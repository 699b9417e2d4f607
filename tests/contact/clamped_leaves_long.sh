# The test clamped_leaves with further formulations of the gap and three leaves on two ranks
scenes="three_matching three_mortar three_dual" ranks=three_mortar
. "$AMGF_DIR/tests/contact/clamped_leaves.sh"
