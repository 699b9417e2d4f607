# Every option of the plugin stands on a manual page, and every option on a page is asked for. Every page of a function
# has the parts of a manual page
"${PYTHON:-python3}" "$AMGF_DIR/tests/doc/manual_pages.py" "$AMGF_DIR"
