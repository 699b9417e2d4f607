# A load step without contact factors a small model, and solves a larger one by AMG, unless an option says otherwise.
# Energies agree.
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
for factor in auto true; do run block $factor; done
"$PYTHON" - << 'CHECK'
import json

for scene, other in ("beam", "false"), ("block", "true"):
    auto, asked = (json.load(open(f"{scene}_{way}.json"))["steps"][0] for way in ("auto", other))
    print(scene)
    for way, step in ("auto", auto), (other, asked):
        print("  %s:" % way, "factorization" if step["factored"] else "AMG")
    error = abs(auto["energy"] - asked["energy"]) / asked["energy"]
    print("  energies:", "the same within 1e-7" if error < 1e-7 else error)
step = json.load(open("beam_true.json"))["steps"][0]
print("beam, where it is asked for:", "factorization" if step["factored"] else "AMG",
      "one or two iterations" if sum(step["ksp_iterations"]) <= 2 else step["ksp_iterations"])
CHECK
