# The figures of tests/lib/cantilever.py anew, by the meshes that they are of
contact=$AMGF_DIR/bin/contact
scene=$AMGF_DIR/share/scenes/cantilever.yaml
(sed 's/poisson: 0.3/&\n      order: 2/' "$scene" \
  && printf 'probes:\n  - tip: {point: [10, 0, 0]}\n  - middle: {point: [5, 0, 0.5]}\n') > tip.yaml
"$contact" "$scene" -quiet -refine 2 -summary energy.json || echo "energy: exit code $?"
"$contact" tip.yaml -quiet -refine 1 -summary tip.json || echo "tip: exit code $?"
"$PYTHON" - <<'PY'
import cantilever
from summaries import load, say, within

energy, tips = load("energy")["steps"][-1]["energy"], [p["displacement"][2] for p in load("tip")["steps"][-1]["probes"]]
say("energy to 1e-8", within(energy, cantilever.ENERGY, 1e-8), energy)
say("displacements to 1e-7", all(within(a, b, 1e-7) for a, b in zip(tips, cantilever.TIP)), tips)
PY
