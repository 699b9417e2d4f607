# Two cells on four ranks: ranks that own nothing take part in friction, output, checkpoints and restarts. The answers
# are those of one rank.
cat > two.yaml << 'YAML'
problem: two
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], young: 1, poisson: 0.3}
  - lid: {lower: [-0.2, -0.1, 1], upper: [1.5, 1.5, 1.5], cells: [1, 1, 1], young: 5, poisson: 0.3}
displacements:
  - bottom: {face: cube.zmin, value: [0, 0, 0]}
  - top: {face: lid.zmax, value: [0.05, 0, -0.05]}
contact:
  - joint: {mortar: lid.zmin, nonmortar: cube.zmax, friction: 0.3, gap: node}
load: {steps: 2}
YAML
sed 's/young: 1,/material: j2, yield: 0.01, hardening: 0.1, young: 1,/; s/, friction: 0.3//; s/, gap: node//' two.yaml \
  > plastic.yaml
sed 's/steps: 2/factors: [0.5, 1, 0.7]/' two.yaml > further.yaml
run() { # scene, ranks, options
  mpiexec --oversubscribe -n "$2" "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -tao_ipfilter_tol 1e-12 \
    -summary "$1_$2.json" "${@:3}" > log 2>&1 ||
    { echo "$1 on $2 ranks: exit code $?"; cat log; }
  grep -i "graph" log # METIS
}
for ranks in 1 4; do
  run two $ranks -output "two_$ranks" -checkpoint "state_$ranks.h5" -checkpoint_every 1
  run plastic $ranks -output "plastic_$ranks"
  run further $ranks -output "two_$ranks" -restart "state_$ranks.h5"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - << 'PY'
import h5py
import numpy
from summaries import load, say


def size(step):
    return max(abs(force) for force in step["contact_force"])


for scene in ("two", "plastic", "further"):
    pairs = list(zip(load(f"{scene}_1")["steps"], load(f"{scene}_4")["steps"], strict=True))
    seen = [abs(a["energy"] / b["energy"] - 1) for a, b in pairs]
    seen += [abs(f - g) / size(a) for a, b in pairs for f, g in zip(a["contact_force"], b["contact_force"])]
    say(f"{scene}: energies and forces of all load steps as on one rank to 1e-9", max(seen) < 1e-9, seen)
for scene in ("two", "plastic"):
    with h5py.File(f"{scene}_1_0002.h5") as one, h5py.File(f"{scene}_4_0002.h5") as four:
        names = [[], []]
        for found, file in zip(names, (one, four)):
            file.visititems(lambda name, item: found.append((name, item.shape))
                            if isinstance(item, h5py.Dataset) else None)
        say(f"{scene}: the same fields in the results", names[0] == names[1] and len(names[0]) > 5, names)
        sums = [sorted(numpy.linalg.norm(file["stress"], axis=1)) for file in (one, four)]
        say(f"{scene}: the same stress", numpy.allclose(*sums, rtol=1e-8), sums)
PY
