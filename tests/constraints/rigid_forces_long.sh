# rigid_forces with all scenes on three ranks, too
set -- long
. "$AMGF_DIR/tests/constraints/rigid_forces.sh"
