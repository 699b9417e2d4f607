# A run says how far it is: each load step, with time and what is left once that can be known; nothing of a short run,
# nothing with -quiet.
contact=$AMGF_DIR/bin/contact
cat > press.yaml <<'YAML'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 1, poisson: 0.3}
symmetry: [cube.xmin, cube.ymin, cube.zmin]
displacements:
  - top: {face: cube.zmax, value: [free, free, -0.2]}
load: {steps: 4}
YAML
sed 's/material: neohookean, //' press.yaml > linear.yaml
for scene in press linear; do
  for ranks in 1 2; do
    mpiexec --oversubscribe -n $ranks "$contact" $scene.yaml -progress_every 1e-9 > log || echo "exit code $?"
    "$PYTHON" - <<'PY'
import re

said = [line.rstrip("\n") for line in open("log") if line.startswith("Progress")]
form = re.compile(
    r"Progress: load step (\d) of 4(, iteration \d+ with an error of \S+ \(ends at 1e-\d\d\))?, (\d+) s so "
    r"far(|, about \d+ s left)")
words = [form.fullmatch(line) for line in said]
print("each line says it:", all(words) or said)
print("load steps:", sorted({int(word[1]) for word in words}))
print("in the midst of a step and between two:", {bool(word[2]) for word in words} == {True, False})
print("what is left is not said before the third:", not any(word[4] for word in words if word[1] in "12") or said)
print("that nothing is left is not said:", ", about 0 s left" not in "".join(said) or said)
PY
  done
done
"$contact" "$AMGF_DIR/share/scenes/patch_test.yaml" -progress_every 1e-9 > log
"$PYTHON" - <<'PY'
said = [line for line in open("log") if line.startswith("Progress")]
first = ["iteration 1 " in line for line in said].index(True)
print("with contact, within the first iteration:", any("iteration" not in line for line in said[:first]) or said)
PY
"$contact" press.yaml -quiet -progress_every 1e-9
"$contact" press.yaml -progress_every 0 | grep -c Progress || true
"$contact" press.yaml | grep -c Progress || true
"$contact" press.yaml -progress_every -1 2>&1 || echo "exit code $?"
