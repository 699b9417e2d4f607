# The element of bodies that name none: -scene_check prints the choice and its reason; the run has the energy of the
# chosen element, of another order too
cat > bodies.yaml <<'SCENE'
bodies:
  - steel: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3}
  - rubber: {lower: [2, 0, 0], upper: [3, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.49, material: neohookean}
  - foam: {lower: [4, 0, 0], upper: [5, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.2, material: neohookean}
  - seal: {lower: [6, 0, 0], upper: [7, 1, 1], cells: [1, 1, 1], material: mooney_rivlin, c10: 1, c01: 1, bulk: 100}
  - strip: {lower: [8, 0, 0], upper: [9, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.45, material: saint_venant}
  - metal: {lower: [10, 0, 0], upper: [11, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3, material: j2, yield: 1}
  - forged: {lower: [18, 0, 0], upper: [19, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3, material: j2_finite,
             yield: 1}
  - forged2: {lower: [20, 0, 0], upper: [21, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3, material: j2_finite,
              yield: 1, order: 2}
  - fine: {lower: [12, 0, 0], upper: [13, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.45, order: 2}
  - wood: {lower: [24, 0, 0], upper: [25, 1, 1], cells: [1, 1, 1], order: 2, material: orthotropic, young: [10, 2, 1],
           poisson: [0.4, 0.3, 0.03], shear: [0.7, 0.4, 0.8], first_axis: [1, 1, 0], second_axis: [-1, 1, 1]}
  - gel: {lower: [26, 0, 0], upper: [27, 1, 1], cells: [1, 1, 1], order: 2, material: orthotropic, young: [10, 10, 10],
          poisson: [0.45, 0.45, 0.45], shear: [3.4, 3.4, 3.4]}
  - named: {lower: [14, 0, 0], upper: [15, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3, element: full}
  - balloon: {lower: [22, 0, 0], upper: [23, 1, 1], cells: [1, 1, 1], young: 10, poisson: 0.3, material: neohookean}
  - tool: {lower: [16, 0, 0], upper: [17, 1, 1], cells: [1, 1, 1], material: rigid}
displacements:
  - tool: {body: tool, value: [0, 0, 0]}
pressures:
  - inside: {face: balloon.zmin, value: 0.1, follows: true}
weak_springs: true
SCENE
"$AMGF_DIR/bin/contact" bodies.yaml -scene_check | sed -n 's/^  \([a-z0-9]*\): .*/\1/p; s/.*; element/  element/p' |
  sed '/problem/d' | head -27
beam() { # name, keys of the beam
  cat > "$1.yaml" <<SCENE
bodies:
  - beam: {lower: [0, 0, 0], upper: [8, 1, 1], cells: [8, 1, 1], young: 1000, poisson: 0.3$2}
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
body_forces:
  - weight: {body: beam, value: [0, 0, -0.1]}
SCENE
  "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -summary "$1.json" || echo "$1: exit code $?"
}
beam auto ""
beam said ", element: auto"
beam incompatible ", element: incompatible"
beam full ", element: full"
beam auto2 ", order: 2"
beam full2 ", order: 2, element: full"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

energy = {
    name: load(name)["steps"][-1]["energy"]
    for name in ("auto", "said", "incompatible", "full", "auto2", "full2")
}
say(
    "order 1: incompatible, not full",
    within(energy["auto"], energy["incompatible"], 1e-12) and energy["said"] == energy["auto"]
    and not within(energy["full"], energy["auto"], 0.1), energy)
say("order 2: full", within(energy["auto2"], energy["full2"], 1e-12), energy)
CHECK
