# A load step without contact chooses between AMG and a factorization: a slender beam is factored at once, a compact
# block that is all but incompressible once AMG turns out to take too many iterations, and goes on from there; neither
# where that is forbidden. Energies agree.
cat > beam.yaml << 'SCENE'
problem: beam
bodies:
  - beam: {lower: [0, 0, 0], upper: [40, 1, 1], cells: [80, 4, 4], young: 1000, poisson: 0.3}
displacements:
  - wall: {face: beam.xmin, value: [0, 0, 0]}
body_forces:
  - weight: {body: beam, value: [0, 0, -0.001]}
SCENE
cat > block.yaml << 'SCENE'
problem: block
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [19, 19, 19], young: 1000, poisson: 0.4999}
displacements:
  - floor: {face: block.zmin, value: [0, 0, 0]}
body_forces:
  - weight: {body: block, value: [0, 0, -1]}
SCENE
run() {
  timeout 1200 "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -summary "$1_$2.json" -elasticity_pc_amgf_factor "$2" ||
    echo "$1 $2: exit code $?"
}

for factor in auto false true; do run beam $factor; done
for factor in auto false; do run block $factor; done
"$PYTHON" - << 'CHECK'
import json

for scene in "beam", "block":
    auto, amg = (json.load(open(f"{scene}_{way}.json"))["steps"][0] for way in ("auto", "false"))
    iterations = [sum(step["ksp_iterations"]) for step in (auto, amg)]
    print(scene)
    print("  chosen:", "factorization" if auto["factored"] else "AMG",
          "from the beginning" if auto["amg_setups"] == 1 else "after some iterations with AMG")
    print("  where it is forbidden:", "factorization" if amg["factored"] else "AMG")
    print("  iterations of the choice:",
          "fewer than half of AMG's" if iterations[0] < 0.5 * iterations[1] else iterations)
    error = abs(auto["energy"] - amg["energy"]) / amg["energy"]
    print("  energy:", "AMG's within 1e-7" if error < 1e-7 else error)
step = json.load(open("beam_true.json"))["steps"][0]
print("beam, where it is asked for:", "factorization" if step["factored"] else "AMG",
      "one or two iterations" if sum(step["ksp_iterations"]) <= 2 else step["ksp_iterations"])
CHECK
