# A balloon is inflated beyond the largest pressure that it carries. The run ends soon and names the limit load. The
# last equilibrium is near the closed form for incompressible rubber.
contact=$AMGF_DIR/bin/contact
cat > balloon.yaml <<'YAML'
bodies:
  - ball: {shape: sphere_shell, inner: {radius: 1}, outer: {radius: 1.1}, patches: [2, 2, 2], layers: 1,
      material: neohookean, young: 1, poisson: 0.45}
symmetry: [ball.x0, ball.y0, ball.z0]
pressures:
  - inflate: {face: ball.inner, value: 0.06, follows: true}
load: {steps: 3}
YAML
for ranks in 1 2; do
  mpiexec --oversubscribe -n $ranks "$contact" balloon.yaml -quiet -error_estimate 0 -load_max_cuts 3 > said 2>&1
  echo "$ranks ranks: exit $?, $(grep -o 'seem to exceed a limit load' said | sort -u)"
  "$PYTHON" - <<'PY'
import re

from summaries import say

def pressure(inner):
    """The pressure of an incompressible neo-Hookean shell whose inner radius grows by the factor `inner`"""
    outer = (1 + (inner**3 - 1) / 1.1**3)**(1 / 3)
    return (2 / outer + 0.5 / outer**4 - 2 / inner - 0.5 / inner**4) / 3

limit = max(pressure(1 + k / 1000) for k in range(1000))
last = float(re.search("the last equilibrium is at time ([0-9.]*)", open("said").read())[1])
say("the last equilibrium is below the limit by at most 15 %", 0.85 < last * 0.02 / limit < 1, last * 0.02 / limit)
PY
done
