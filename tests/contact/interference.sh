# An overlap that follows a ramp: a shrink fit of two rings whose force grows with it, and ends where it ends all at
# once
rings() { # keys of the pair, load steps
  cat <<SCENE
bodies:
  - inner: {shape: tube_arc, axis: z, radii: [15, 25.015], angles: [0, 90], extent: [0, 2], cells: [3, 12, 1],
            young: 210000, poisson: 0.3}
  - outer: {shape: tube_arc, axis: z, radii: [24.985, 40], angles: [0, 90], extent: [0, 2], cells: [3, 15, 1],
            young: 210000, poisson: 0.3}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
contact:
  - fit: {mortar: outer.inner, nonmortar: inner.outer, $1}
load: {steps: $2}
ramps:
  - heat: {factors: [1/4, 1/2, 1, 1/8]}
SCENE
}

run() { # name, options
  local name=$1
  shift
  "$AMGF_DIR/bin/contact" "$name.yaml" -quiet -summary "$name.json" -tao_ipfilter_tol 1e-10 "$@" ||
    echo "$name: exit code $?"
}

rings "interference: 0.0301, ramp: heat" 4 > ramped.yaml
rings "gap: node, interference: 0.0301, ramp: heat" 4 > node.yaml
rings "interference: 0.0301" 4 > whole.yaml
rings "interference: 0.0301, ramp: load" 1 | sed '/^ramps/,$d' > load.yaml
run ramped
run node
run whole
run load
mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" ramped.yaml -quiet -summary ranks.json -tao_ipfilter_tol 1e-10 ||
  echo "ranks: exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say


def forces(name):
    return [step["pairs"][0]["normal_force"] for step in load(name)["steps"]]


whole = forces("whole")[0]
for name in ("ramped", "node"):
    seen = forces(name)
    say(name + ": the force follows the overlap that the ramp leaves",
        all(abs(f / seen[2] - (0.0301 * k - 0.0001) / 0.03) < 2e-3 for f, k in zip(seen, (0.25, 0.5, 1, 0.125))), seen)
say("all of it: the same as at once",
    abs(forces("ramped")[2] / whole - 1) < 1e-6 and abs(forces("load")[0] / whole - 1) < 1e-6,
    (forces("ramped"), forces("load"), whole))
say("three ranks: the same",
    max(abs(a - b) for a, b in zip(forces("ranks"), forces("ramped"))) < 1e-6 * whole,
    (forces("ranks"), forces("ramped")))
say("no warning of an overlap", not any(load(name)["warnings"] for name in ("ramped", "whole", "load")),
    load("ramped")["warnings"])
PY
# Back to where nothing is asked for: no overlap is left, or no displacement, and the bodies are undeformed again
blocks() { # where the upper one begins, other keys of the scene
  cat <<SCENE
bodies:
  - lower: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], young: 1000, poisson: 0.3}
  - upper: {lower: [0, 0, $1], upper: [1, 1, 2], cells: [4, 4, 4], material: neohookean, young: 1000, poisson: 0.3}
contact:
  - fit: {mortar: lower.zmax, nonmortar: upper.zmin$2}
load: {factors: [1/2, 1, 0, 1/2]}
SCENE
}
{ blocks 0.9 ", interference: 0.1, ramp: load" \
  && echo "symmetry: [lower.xmin, lower.ymin, lower.zmin, upper.xmin, upper.ymin, upper.zmax]"; } > overlap.yaml
{ blocks 1 &&
  echo "displacements: [bottom: {face: lower.zmin, value: [0, 0, 0]}, top: {face: upper.zmax, value: [0, 0, -0.1]}]"
} > press.yaml
rings "interference: 0.04, ramp: heat" 5 | sed 's|1/8]|0, 1/2]|' > back.yaml
for name in overlap press back; do run $name -error_estimate 0; done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say

for name in ("overlap", "press", "back"):
    steps = load(name)["steps"]
    force = [step["pairs"][0]["normal_force"] for step in steps]
    first = 0 if name != "back" else 1
    say(name + ": nothing is left where nothing is asked for, and no step is cut", force[-2] == 0
        and steps[-2]["energy"] == 0 and not any(step["cuts"] for step in steps), force)
    say(name + ": pressed again, the same force as at first", abs(force[-1] / force[first] - 1) < 1e-6, force)
PY
for keys in "ramp: heat" "interference: true, ramp: heat" "interference: 0.03, ramp: cold"; do
  rings "$keys" 4 > wrong.yaml
  "$AMGF_DIR/bin/contact" wrong.yaml -scene_check 2>&1 | grep contact:
done
