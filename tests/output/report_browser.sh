# The page of a run in a real browser: no message in the console; six answers are found by their ids and are those of
# the summary; the slider shows another picture; dragging turns the bodies. REPORT_MODELS: names of
# scenes in tests/lib/models. Without a browser nothing is tested.
models=${REPORT_MODELS:-flange}
for name in chromium-headless-shell chromium google-chrome; do
  browser=$(command -v $name) && break
done
if [ -z "$browser" ]; then
  echo "report_browser: not tested, since there is no browser (Debian: chromium-headless-shell)" >&2
  models=
fi
dom() { # page: the document after its scripts have run; messages of the console go to the file `console`
  "$browser" --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
    --user-data-dir="$PWD/profile" --virtual-time-budget=3000 --enable-logging=stderr --dump-dom "file://$PWD/$1" 2> log
  grep CONSOLE log > console && echo "$1: messages in the console" && cat console
}

for model in $models; do
  "$AMGF_DIR/bin/contact" "$AMGF_DIR/tests/lib/models/$model.yaml" -quiet -report "$model.html" > out 2>&1 ||
    { echo "$model: exit code $?"; cat out; }
  # What a user does: the slider to its left end
  cat "$model.html" - > "$model.moved.html" <<'HTML'
<script>
for (const slider of document.querySelectorAll("input[type=range]")) { slider.value = 0; slider.oninput(); }
const canvas = document.getElementById("turn"), pictures = [];
function pixels() {
  const copy = document.createElement("canvas"), context = copy.getContext("2d");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  canvas.onwheel({deltaY: 0, preventDefault() {}}); // draws, so that the pixels can be read
  context.drawImage(canvas, 0, 0);
  return context.getImageData(0, 0, copy.width, copy.height).data;
}
for (const buttons of [1, 1, 0]) { // two drags, and a motion without a button, which turns nothing
  canvas.onpointermove({buttons: buttons, movementX: 60, movementY: 30});
  pictures.push(pixels());
}
const changed = (a, b) => a.filter((value, k) => Math.abs(value - b[k]) > 32).length / a.length;
document.body.dataset.turned = [changed(pictures[0], pictures[1]) > 0.01, changed(pictures[1], pictures[2]) > 0.001];
</script>
HTML
  dom "$model.html" > "$model.dom"
  dom "$model.moved.html" > "$model.moved.dom"
  "$PYTHON" -B "$AMGF_DIR/tests/output/report_browser.py" "$model" "$(stat -c %s "$model.html")"
done
echo "judged"
