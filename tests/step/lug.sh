# The shipped part of tetrahedra: the force of its pin as hexahedra have it, on its coarse mesh and refined along its
# curves, on one rank and on two; and what its fillets make of the stress. The balance asked for is below the default
# tolerance of 1e-8
for refine in 0 1; do
  mpiexec --oversubscribe -n $((1 + refine)) "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/lug.yaml" -quiet \
    -tao_gatol 1e-9 -refine $refine -summary $refine.json -output lug_$refine
  echo "refined $refine times: exit $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
import h5py
import numpy as np
from summaries import load, say, within

HEXAHEDRA = 544.6  # of share/gmsh/lug.geo with -setnumber hexahedra 1 -setnumber size 0.35, order 2: 92,034 unknowns
# Peterson's of a stepped flat bar, D/d 2, r/d 2/15; long thin bars of this program have 2.276, CalculiX's 2.287
CHART = 2.282
CENTER, RADIUS, THICK = np.array([47, 9.5]), 2, 2  # of the fillet; half of the thickness
for refine, tolerance in (0, 0.01), (1, 0.003):
    step = load(str(refine))["steps"][-1]
    force = step["pairs"][0]["force"][0]
    say(f"refined {refine} times: force of hexahedra", within(force, HEXAHEDRA, tolerance), force)
    say("balance", step["balance"] < 1e-9, step["balance"])
with h5py.File("lug_1.h5") as mesh, h5py.File("lug_1_0001.h5") as fields:
    x, factor = mesh["vertices"][:], fields["principal_stress"][:, 0] / (force / (7.5 * THICK))
angle = np.degrees(np.arctan2(CENTER[0] - x[:, 0], CENTER[1] - x[:, 1]))
# the peak is at 18 degrees
fillet = (np.abs(np.hypot(*(x[:, :2] - CENTER).T) - RADIUS) < 5e-3) & (angle > 4) & (angle < 33)
# a polynomial in the angle, even across the thickness, and its mean there: what is plane stress is true of means
powers = [(i, j) for i in range(5) for j in (0, 2, 4)]
terms = np.stack([(angle[fillet] / 30)**i * (x[fillet, 2] / THICK)**j for i, j in powers], 1)
fitted = np.linalg.lstsq(terms, factor[fillet], rcond=None)[0]
across = np.linspace(10, 28, 100) / 30
mean = sum(c * across**i / (j + 1) for c, (i, j) in zip(fitted, powers)).max()
middle = sum(c * across**i for c, (i, j) in zip(fitted, powers) if j == 0).max()
say("stress concentration of the fillets, mean across the thickness: the chart's within 2 %", within(mean, CHART, 0.02),
    mean)
say("in the middle of the thickness within 3 %", within(middle, CHART, 0.03), middle)
PY
