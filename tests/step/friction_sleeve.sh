# A sleeve that is shrunk between a shaft and a hub, which is turned until the sleeve slides on the shaft. Friction
# alone holds the sleeve, and its tangent is indefinite in the rotation, because the outer face carries more force times
# radius than the inner one. Friction's laws then have a second solution far away. The torque must be friction times
# radius times the force between sleeve and shaft, and the same at both ends
cat > sleeve.yaml <<YAML
bodies:
  - shaft: {shape: tube_arc, axis: z, radii: [5, 10], angles: [0, 360], extent: [0, 5], cells: [1, 20, 1]}
  - sleeve: {shape: tube_arc, axis: z, radii: [9.996, 12], angles: [0, 360], extent: [0, 5], cells: [1, 20, 1]}
  - hub: {shape: tube_arc, axis: z, radii: [11.996, 20], angles: [0, 360], extent: [0, 5], cells: [2, 20, 1]}
displacements:
  - hold: {face: shaft.inner, value: [0, 0, 0]}
  - turn: {face: hub.outer, value: [0, 0, 0], rotation: [0, 0, 0.5], center: [0, 0, 0], ramp: turn}
symmetry: [sleeve.lmin]
contact:
  - inside: {mortar: shaft.outer, nonmortar: sleeve.inner, friction: 0.1, interference: true}
  - outside: {mortar: sleeve.outer, nonmortar: hub.inner, friction: 0.1, interference: true}
ramps: [turn: {factors: [0, 0.2, 1]}]
YAML
sed -i 's/1]}$/1], material: neohookean, young: 2e5, poisson: 0}/' sleeve.yaml
sed -i 's/, material: neohookean, young: 2e5, poisson: 0}]/}]/' sleeve.yaml
for ranks in 1 2; do
  mpiexec --oversubscribe -n $ranks "$AMGF_DIR/bin/contact" sleeve.yaml -quiet -summary sleeve_$ranks.json 2> /dev/null
  echo "$ranks ranks: exit $?"
done
"$PYTHON" - <<'PY'
from summaries import load, say, within

for ranks in (1, 2):
    last = load(f"sleeve_{ranks}")["steps"][-1]
    torque = {face["name"]: abs(face["moment"][2]) for face in last["faces"]}
    say(f"{ranks} ranks: the same torque at both ends",
        within(torque["hub.outer"], torque["shaft.inner"], 1e-5), torque)
    say(f"{ranks} ranks: torque of friction on the shaft",
        within(torque["hub.outer"], 0.1 * 10 * last["pairs"][0]["normal_force"], 0.02), torque)
    say(f"{ranks} ranks: no cut", not any(step["cuts"] for step in load(f"sleeve_{ranks}")["steps"]), "cuts")
PY
