# Taylor's impact test with finer cells and shorter time steps
export CELLS="5, 1, 40" STEP=0.5e-6
. "$AMGF_DIR/tests/dynamics/dynamics_taylor.sh"
