# Public reports about contact in other programs, with default settings: share/doc/hard_cases.md has what they state,
# and what was assumed.
contact=$AMGF_DIR/bin/contact
for scene in $("$PYTHON" "$AMGF_DIR/tests/run/hard_cases.py" write); do
  "$contact" "$scene.yaml" -quiet -summary "$scene.json" 2> "$scene.err" ||
    { echo "$scene: exit code $?"; cat "$scene.err"; }
done
"$PYTHON" "$AMGF_DIR/tests/run/hard_cases.py" judge
