# Two orders in one scene: the same energy on one, two and three ranks, near Lame's; files whose hexahedra are cut at
# the nodes of order 2. Tractions, springs and probes of order 2, and a run that goes on from a checkpoint, refined
cat > pipe.yaml <<'YAML'
problem: pipe
bodies:
  - pipe: {shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 90], extent: [0, 1], cells: [2, 2, 1], young: 1000,
           poisson: 0.4999, element: bbar, order: 2}
  - brick: {lower: [3, 0, 0], upper: [4, 1, 1], cells: [2, 2, 2], young: 1000, poisson: 0.3}
symmetry: [pipe.amin, pipe.amax, pipe.lmin, pipe.lmax, brick.xmin, brick.ymin, brick.zmin]
pressures:
  - inside: {face: pipe.inner, value: 10}
  - top: {face: brick.zmax, value: 10}
YAML
for ranks in 1 2 3; do
  mpiexec --oversubscribe -n "$ranks" "$AMGF_DIR/bin/contact" pipe.yaml -quiet -ksp_rtol 1e-12 -summary "$ranks.json" \
    -output pipe
  echo "$ranks: exit $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
import h5py
import numpy as np
from summaries import load, say, within

one, *more = (load(str(ranks))["steps"][-1] for ranks in (1, 2, 3))
for ranks, step in enumerate(more, 2):
    say(f"energy, {ranks} ranks", within(step["energy"], one["energy"], 1e-9), (step["energy"], one["energy"]))
# Lame in plane strain: u = (1 + nu) p a^2/(E (b^2 - a^2)) ((1 - 2 nu) r + b^2/r), and the brick's p^2/(2 E); work of
# the pressure/2
u = 1.4999 * 10 / 3000 * (0.0002 + 4)
say("energy against Lame's", within(one["energy"], 10 * u * np.pi / 4 + 0.05, 2e-3),
    (one["energy"], 10 * u * np.pi / 4 + 0.05))
with h5py.File("pipe.h5") as mesh, h5py.File("pipe_0001.h5") as state:
    x, cells, body = mesh["vertices"][:], mesh["cells"][:], mesh["body"][:].ravel()
    say("a displacement a vertex, a stress a cell", state["displacement"].shape == x.shape
        and len(state["stress"]) == len(cells), state["stress"].shape)
p = x[cells]
volume = np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 3] - p[:, 0]), p[:, 4] - p[:, 0])
say("cells: 8 of each of order 2", (body == 0).sum() == 32 and (body == 1).sum() == 8, len(cells))
say("none is inside out", volume.min() > 0, volume.min())
radii = np.unique(np.hypot(x[:, 0], x[:, 1])[x[:, 0] < 2.5].round(9))
say("nodes on the shape's circles", np.allclose(radii, [1, 1.25, 1.5, 1.75, 2]), radii)
PY

cat > tied.yaml <<'YAML'
problem: tied
bodies:
  - pipe: {shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 90], extent: [0, 1], cells: [4, 4, 1], young: 1000,
           poisson: 0.3, order: 2}
  - brick: {lower: [3, 0, 0], upper: [4, 1, 1], cells: [2, 1, 1], young: 1000, poisson: 0.3, order: 2}
symmetry: [pipe.amin, pipe.amax, pipe.lmin, pipe.lmax, brick.xmin, brick.ymin]
pressures:
  - inside: {face: pipe.inner, value: 10}
tractions:
  - top: {face: brick.zmax, value: [0, 0, -10]}
springs:
  - ground: {face: brick.zmin, value: [0, 0, 100]}
probes:
  - middle: {point: [1.06066017178, 1.06066017178, 0.4]}
  - inside: {point: [3.3, 0.2, 0.7]}
load: {steps: 2}
YAML
mpiexec --oversubscribe -n 2 "$AMGF_DIR/bin/contact" tied.yaml -quiet -ksp_rtol 1e-12 -summary tied.json \
  -checkpoint_every 1 -checkpoint tied.h5
sed 's/steps: 2/factors: [0.5, 1, 2]/' tied.yaml > beyond.yaml
for refine in 0 1; do
  "$AMGF_DIR/bin/contact" beyond.yaml -quiet -ksp_rtol 1e-12 -refine $refine -summary whole$refine.json
  "$AMGF_DIR/bin/contact" beyond.yaml -quiet -ksp_rtol 1e-12 -refine $refine -summary part$refine.json -restart tied.h5
  echo "restart, refined $refine times: exit $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say, within

probes = {probe["name"]: probe for probe in load("tied")["steps"][-1]["probes"]}
r, sqrt2 = 1.5, 2**0.5
u = 1.3 * 10 / 3000 * (0.4 * r + 4 / r)
radial, hoop = 10 / 3 * (1 - 4 / r**2), 10 / 3 * (1 + 4 / r**2)
middle, inside = probes["middle"], probes["inside"]
say("displacement of the pipe, Lame's", within(middle["displacement"][0], u / sqrt2, 1e-3),
    (middle["displacement"][0], u / sqrt2))
say("its stress",
    within(middle["principal_1"], hoop, 0.02) and within(middle["principal_3"], radial, 0.05),
    (middle["principal_1"], hoop, middle["principal_3"], radial))
# The springs give 10/100, the brick 10/1000 times the height; nu times that sideways
exact = (0.3 * 0.003, 0.2 * 0.003, -0.1 - 0.7 * 0.01)
say("displacement of the brick", all(within(a, b, 1e-9) for a, b in zip(inside["displacement"], exact)),
    inside["displacement"])
say("its stress", within(inside["stress_zz"], -10, 1e-9) and abs(inside["stress_zx"]) < 1e-8, inside["stress_zz"])
for refine in 0, 1:
    whole, part = (load(f"{name}{refine}")["steps"][-1] for name in ("whole", "part"))
    say(f"energy after a restart, refined {refine} times", within(part["energy"], whole["energy"], 1e-9),
        (part["energy"], whole["energy"]))
PY
