# Tolerances near the rounding errors of double precision, in metres, millimetres and lengths x 1e-6. Steps of the size
# of rounding errors do not shift the Hessian. Slacks that are almost zero neither make a positive definite system look
# indefinite nor increase the iterations of PCG.
"$PYTHON" - <<'PY'
import json
import os
import subprocess
import sys

top = os.environ["AMGF_DIR"]
sys.path.insert(0, os.path.join(top, "tests", "stress"))
from units import UNITS, in_units


def solve(shipped, length=1.0, pressure=1.0):
    with open("scene.yaml", "w") as file:
        json.dump(in_units(shipped, ".", length, pressure), file)
    subprocess.run([
        os.path.join(top, "bin", "contact"), "scene.yaml", "-quiet", "-tao_ipfilter_tol", "1e-11", "-summary",
        "run.json"
    ], check=True, timeout=200)
    with open("run.json") as file:
        return json.load(file)["steps"][0]


runs = [solve("patch_test", length, pressure) for length, pressure in UNITS.values()]
newton = [run["ip_iterations"] for run in runs]
print("patch test: Newton steps differ by one at most:", max(newton) - min(newton) <= 1)
runs.append(solve("press_fit"))
print("press fit: no solve needs 200 iterations:", max(runs[-1]["ksp_iterations"]) < 200)
print("shifted Hessians:", sum(run["regularizations"] for run in runs))
PY
