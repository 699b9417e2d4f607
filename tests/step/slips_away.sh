# A flat wedge between a floor and an inclined lid that moves down by 0.002 slips out without friction, to a place where
# no force acts on it: a warning says so. Held at its thick end it remains. With friction the
# vertex at its tip touches both planes and finds no place between them: the load step fails. Where only its thick end
# touches the lid, friction holds it, whatever its law
contact=$AMGF_DIR/bin/contact
wedge() { # law, friction, slope of the lid, further support
  cat > wedge.yaml <<YAML
bodies:
  - wedge: {shape: wedge, axis: y, corners: [0, 0, 0.1, 0, 0, 2], extent: [0, 1], side_cells: 2, length_cells: 1,
            young: 1000, poisson: 0.3, material: $1}
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
  - lid: {shape: rigid_plane, point: [0, 0, 0.1], normal: [-$3, 0, -2]}
symmetry: [wedge.lmin, wedge.lmax]
displacements: [stay: {body: floor, value: [0, 0, 0]}, press: {body: lid, value: [0, 0, -0.002]}$4]
contact:
  - low: {mortar: floor.surface, nonmortar: wedge.side3, friction: $2}
  - high: {mortar: lid.surface, nonmortar: wedge.side2, friction: $2}
load: {steps: 1}
YAML
}
for hold in "" ", hold: {face: wedge.side1, value: [0, free, free]}"; do
  wedge neohookean 0 0.1 "$hold"
  for ranks in 1 2; do
    mpiexec --oversubscribe -n $ranks "$contact" wedge.yaml -quiet -error_estimate 0 > out 2>&1
    echo "$([ "$hold" ] && echo held || echo free), $ranks ranks: exit $?," \
      "$(grep -o 'slips away in load step 1' out || echo no warning)"
  done
done
for law in linear neohookean; do
  wedge $law 0.2 0.1
  "$contact" wedge.yaml -quiet -error_estimate 0 > out 2>&1
  echo "$law, friction 0.2, touches at the tip: exit $?"
  wedge $law 0.2 0.08
  "$contact" wedge.yaml -quiet -error_estimate 0 -summary wedge.json > out 2>&1
  echo "$law, friction 0.2, touches at the thick end: exit $?," \
    "$(grep -o 'slips away in load step 1' out || echo no warning)"
  "$PYTHON" - <<PYTHON
from summaries import load, say
forces = [pair["normal_force"] for pair in load("wedge")["steps"][-1]["pairs"]]
say("the forces are those of a wedge that stays", all(1 < f < 10 for f in forces), forces)
PYTHON
done

# Jaws grip a block, turn, and open by that: it stays between them, and friction has no power any more
cat > jaws.yaml <<'YAML'
bodies:
  - block: {lower: [-0.5, -0.5, -0.5], upper: [0.5, 0.5, 0.5], cells: [2, 2, 2], material: neohookean, young: 100,
      poisson: 0.3}
  - low: {lower: [-0.8, -0.8, -0.8], upper: [0.8, 0.8, -0.5], cells: [1, 1, 1], material: rigid}
  - top: {lower: [-0.8, -0.8, 0.5], upper: [0.8, 0.8, 0.8], cells: [1, 1, 1], material: rigid}
ramps: [press: {expression: 1}, turn: {factors: [0, 2, 4, 6, 7]}]
displacements:
  - up: {body: low, value: [0, 0, 0.02], ramp: press}
  - down: {body: top, value: [0, 0, -0.02], ramp: press}
  - one: {body: low, value: [0, 0, 0], rotation: [15, 0, 0], center: [0, 0, 0], ramp: turn}
  - two: {body: top, value: [0, 0, 0], rotation: [15, 0, 0], center: [0, 0, 0], ramp: turn}
contact:
  - below: {mortar: low.zmax, nonmortar: block.zmin, friction: 0.5}
  - above: {mortar: top.zmin, nonmortar: block.zmax, friction: 0.5}
load: {steps: 5}
YAML
"$contact" jaws.yaml -quiet -error_estimate 0 -summary jaws.json > out 2>&1
echo "jaws that open: exit $?, $(grep -o 'slips away in load step 4' out || echo no warning)"
"$PYTHON" - <<'PYTHON'
from summaries import load, say
steps = load("jaws")["steps"]
spent = [step["dissipated"] for step in steps]
say("nothing is dissipated after that", abs(spent[4] - spent[3]) < 1e-6 * spent[3], spent)
PYTHON

# A strip that only friction holds along a plane is pressed on it, without any force along it: it has not lost contact
cat > strip.yaml <<'YAML'
bodies:
  - strip: {lower: [0, 0, 0], upper: [10, 1, 0.2], cells: [20, 1, 1], young: 1000, poisson: 0}
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
displacements: [stay: {body: floor, value: [0, 0, 0]}]
symmetry: [strip.ymin]
pressures: [press: {face: strip.zmax, value: 0.5}]
contact: [rub: {mortar: floor.surface, nonmortar: strip.zmin, friction: 0.4}]
YAML
"$contact" strip.yaml -quiet -error_estimate 0 > out 2>&1
echo "pressed strip: exit $?, $(grep -o 'slips away in load step 1' out || echo no warning)"

# A block that is heated between two planes is pressed, though nothing resists its slip: it has not lost contact
cat > heated.yaml <<'YAML'
bodies:
  - block: {lower: [1, 1, 2], upper: [3, 3, 4], cells: [3, 3, 1], young: 2e5, poisson: 0.3, expansion: 1e-5}
  - low: {shape: rigid_plane, point: [0, 0, 1.999], normal: [0, 0, 1]}
  - top: {shape: rigid_plane, point: [0, 0, 4.001], normal: [0, 0, -1]}
displacements: [stay: {body: low, value: [0, 0, 0]}, remain: {body: top, value: [0, 0, 0]}]
temperatures: [heat: {value: 300}]
weak_springs: true
contact: [below: {mortar: low.surface, nonmortar: block.zmin}, above: {mortar: top.surface, nonmortar: block.zmax}]
load: {steps: 2}
YAML
"$contact" heated.yaml -quiet -error_estimate 0 -summary heated.json > out 2>&1
echo "heated block: exit $?, $(grep -o 'slips away' out || echo no warning)"
"$PYTHON" - <<'PYTHON'
from summaries import load, say
for pair in load("heated")["steps"][-1]["pairs"]:  # strain 3e-3 without the clearance of 2e-3 of 2, on an area of 4
    force = pair["normal_force"]
    say("it is pressed by the strain that the planes take", abs(force - 1600) < 1e-3, force)
PYTHON
