# The pages of four models in a real browser
export REPORT_MODELS="dropped_block flange gears o_ring"
. "$AMGF_DIR/tests/output/report_browser.sh"
