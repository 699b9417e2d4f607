# The page of a run in a real browser: no message in the console; six answers are found by their ids and are those of
# the summary; the slider shows another picture. REPORT_MODELS: names of scenes in tests/lib/ten. Without a browser
# nothing is tested.
models=${REPORT_MODELS:-flange}
for name in chromium-headless-shell chromium google-chrome; do
  browser=$(command -v $name) && break
done
if [ -z "$browser" ]; then
  echo "report_browser: not tested, since there is no browser (Debian: chromium-headless-shell)" >&2
  models=
fi
dom() { # page: the document after its scripts have run; messages of the console go to the file `console`
  "$browser" --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --user-data-dir="$PWD/profile" \
    --virtual-time-budget=3000 --enable-logging=stderr --dump-dom "file://$PWD/$1" 2> log
  grep CONSOLE log > console && echo "$1: messages in the console" && cat console
}

for model in $models; do
  "$AMGF_DIR/bin/contact" "$AMGF_DIR/tests/lib/ten/$model.yaml" -quiet -report "$model.html" > out 2>&1 ||
    { echo "$model: exit code $?"; cat out; }
  # What a user does: the slider to its left end
  cat "$model.html" - > "$model.moved.html" <<'HTML'
<script>
for (const slider of document.querySelectorAll("input[type=range]")) { slider.value = 0; slider.oninput(); }
</script>
HTML
  dom "$model.html" > "$model.dom"
  dom "$model.moved.html" > "$model.moved.dom"
  "$PYTHON" -B "$AMGF_DIR/tests/output/report_browser.py" "$model" "$(stat -c %s "$model.html")"
done
echo "judged"
