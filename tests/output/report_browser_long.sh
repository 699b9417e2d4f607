# The pages of ten models in a real browser
export REPORT_MODELS="bent_strip bracket dropped_block flange gears hertz o_ring press_fit seal three_point"
. "$AMGF_DIR/tests/output/report_browser.sh"
