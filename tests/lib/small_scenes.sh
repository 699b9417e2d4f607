# Writes small scenes that together use all features, and runs each: small_scenes.sh CONTACT..., where CONTACT is the
# program, perhaps with another that runs it.
# A run that fails prints the end of its messages. SCENES="ring sector" runs some. For `make memcheck`, and for any
# other tool that makes runs slow.
set -u
failed=0
run() { # name, options...
  local name=$1
  shift
  case " ${SCENES-$name} " in *" $name "*) echo "$name" ;; *) return ;; esac
  "${contact[@]}" "$@" -quiet > "$name.log" 2>&1 && return
  echo "$name: exit code $?"
  tail -n 60 "$name.log"
  failed=1
}
contact=("$@")

# blocks NAME LAW PAIR REST: a cube under a lid
blocks() {
  cat > "$1.yaml" <<YAML
problem: $1
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 1], $2, young: 1, poisson: 0.3}
  - lid: {lower: [0, 0, 1], upper: [1.5, 1.5, 1.5], cells: [2, 1, 1], young: 5, poisson: 0.3}
symmetry: [cube.xmin, cube.ymin, cube.zmin, lid.xmin, lid.ymin]
displacements:
  - top: {face: lid.zmax, value: [free, free, -0.05]}
contact:
  - joint: {mortar: lid.zmin, nonmortar: cube.zmax, $3}
load: {steps: 2}
$4
YAML
}
blocks linear 'material: linear, element: incompatible' 'gap: mortar' ''
run linear linear.yaml -output linear -summary linear.json -report linear.html
blocks node 'material: linear' 'gap: node, contact_stiffness: 100' 'refine: 0'
run node node.yaml
blocks friction 'material: neohookean' 'friction: 0.3' ''
run friction friction.yaml -output friction
blocks stick 'material: linear, order: 2' 'stick: true, contact_exponential: [0.02, 0.01]' ''
run stick stick.yaml
blocks plastic 'material: j2, yield: 0.02, hardening: 0.1, element: bbar' 'friction: 0.2, shear_limit: 0.01' ''
run plastic plastic.yaml
blocks rubber 'material: neohookean, element: bbar' 'gap: mortar' \
  'probes: [middle: {point: [0.5, 0.5, 0.5], body: cube}]'
run rubber rubber.yaml -checkpoint rubber.h5 -checkpoint_every 1
sed "s|steps: 2|factors: [0.5, 1, 0.7]|" rubber.yaml > further.yaml
run restart further.yaml -restart rubber.h5 -output restart
run multigrid linear.yaml -refine 1 -options_file "$AMGF_DIR/share/options/published.opts"
run adaptive linear.yaml -accuracy 0.2 -accuracy_adaptive

cat > tied.yaml <<'YAML'
problem: tied
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 2], young: 1, poisson: 0.3}
  - high: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [2, 2, 1], young: 3, poisson: 0.2}
  - tool: {shape: rigid_sphere, center: [0.5, 0.5, 2.5], radius: 0.5}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
  - push: {body: tool, value: [0.02, 0, -0.1]}
ties:
  - seam: {mortar: low.zmax, nonmortar: high.zmin}
contact:
  - dent: {mortar: tool.surface, nonmortar: high.zmax, friction: 0.2}
pressures:
  - side: {face: high.xmin, value: 0.01}
load: {steps: 1}
YAML
run tied tied.yaml -output tied

cat > impact.yaml <<'YAML'
problem: impact
bodies:
  - wall: {lower: [-0.01, -0.02, -0.02], upper: [0, 0.04, 0.04], cells: [1, 1, 1], material: rigid, density: 8000}
  - bar: {lower: [0.002, 0, 0], upper: [0.202, 0.02, 0.02], cells: [8, 1, 1], young: 2e11, poisson: 0, density: 8000,
          initial_velocity: [-100, 0, 0]}
displacements:
  - hold: {body: wall, value: [0, 0, 0]}
symmetry: [bar.ymin, bar.zmin]
contact:
  - hit: {mortar: wall.xmax, nonmortar: bar.xmin}
dynamics: {time_step: 10e-6, end_time: 60e-6}
YAML
run impact impact.yaml

cat > ring.yaml <<'YAML'
problem: ring
bodies:
  - ring: {shape: tube_arc, axis: y, radii: [0.85, 1], angles: [0, 180], extent: [0, 0.2], cells: [1, 16, 1],
           material: neohookean, young: 1, poisson: 0.3}
  - top: {shape: rigid_cylinder, center: [0, 0, 1.4], direction: [0, 1, 0], radius: 0.4}
  - bottom: {shape: rigid_cylinder, center: [0, 0, -1.4], direction: [0, 1, 0], radius: 0.4}
displacements:
  - push: {body: top, value: [0, 0, -0.3]}
  - stay: {body: bottom, value: [0, 0, 0.3]}
symmetry: [ring.lmin, ring.lmax, ring.amin, ring.amax]
contact:
  - auto: {self: true}
load: {steps: 1}
YAML
run ring ring.yaml

cat > sector.yaml <<'YAML'
problem: sector
bodies:
  - disc: {shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 30], extent: [0, 0.5], cells: [2, 2, 1], young: 1000,
           poisson: 0.3, density: 1}
cyclic:
  - cut: {from: disc.amin, to: disc.amax, axis: [0, 0, 1]}
displacements:
  - bottom: {face: disc.lmin, value: [0, 0, 0]}
pressures:
  - bore: {face: disc.inner, value: 1}
YAML
run sector sector.yaml
exit $failed
