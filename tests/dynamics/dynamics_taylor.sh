# Taylor's impact test: a copper cylinder, 32.4 mm long and 3.2 mm in radius, hits a rigid wall at 227 m/s, and its foot
# is strained by 3. Published at 80 us, by different programs (Kamoulakos 1990; Zhu and Cescotto 1995; Camacho and Ortiz
# 1997): length 21.26 to 21.66 mm, radius of the foot 6.89 to 7.24 mm, largest plastic strain 2.5 to 3.3.
# CELLS, STEP: cells along radius, around the sector and along the axis, and the time step
contact=$AMGF_DIR/bin/contact
"$PYTHON" -B "$AMGF_DIR/share/published/cases.py" --scene taylor |
  sed "s/cells: .*]/cells: [${CELLS:-2, 1, 12}]/; s/time_step: [^,]*/time_step: ${STEP:-1.6e-6}/" > taylor.yaml
"$contact" taylor.yaml -quiet -error_estimate 0 -output taylor -summary taylor.json || echo "exit $?"
"$PYTHON" - <<'PY'
import math
import os
from histories import history
from summaries import load, say

steps = load("taylor")["steps"]
moved = {probe["name"]: probe["displacement"] for probe in steps[-1]["probes"]}
length, radius, strain = 32.4 + moved["tail"][2], 3.2 + moved["foot"][0], steps[-1]["plastic_strain"]
more = 0 if "CELLS" in os.environ else 0.006  # of coarse cells
say("length of the bar", 21.26 * (1 - more) < length < 21.66 * (1 + more), length)
say("radius of its foot", 6.89 < radius < 7.27, radius)
say("largest plastic strain", 2.5 < strain < 3.5, strain)
cuts = [step["cuts"] for step in steps]
say("no time step was cut", not any(cuts), cuts)
start = 0.5 * 8.93e-9 * 32.4 * math.radians(10) / 2 * 3.2**2 * 227e3**2
run = history("taylor")
lost = [a - b for a, b in zip(run["dynamics.numerical_dissipation"], run["contact_work"])]
say("energy is kinetic, stored, plastic work or taken by contact to 1e-4 at every instant",
    max(map(abs, lost)) < 1e-4 * start, (start, max(map(abs, lost))))
PY
