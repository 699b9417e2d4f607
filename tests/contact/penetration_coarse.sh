# Faces that touch at a point and are coarser than the motion: the run without force says so. First two saddles of
# coarse tetrahedra that cross, pressed by less than the error of their curved faces
contact=$AMGF_DIR/bin/contact
"$PYTHON" - <<'PY'
from tetrahedra import BOX_FACES, Block

def low(p):
    x, y = 1.4 * p[0] - 0.7, 1.4 * p[1] - 0.7
    return x, y, p[2] * (1 - y * y / 2)

def high(p):
    x, y = 1.4 * p[0] - 0.7, 1.4 * p[1] - 0.7
    return x, y, 1 + x * x / 2 + p[2] * (1 - x * x / 2)

for name, place in ("low", low), ("high", high):
    Block(1, (4, 4, 2), place, BOX_FACES).write(name + ".msh", "2.2")
for depth in 0.0002, 0.1:
    open(f"pressed_{depth}.yaml", "w").write(f"""bodies:
  - low: {{shape: gmsh, mesh: low.msh, volume: block, order: 1, young: 1000, poisson: 0.3}}
  - high: {{shape: gmsh, mesh: high.msh, volume: block, order: 1, young: 1000, poisson: 0.3}}
displacements:
  - hold: {{face: low.zmin, value: [0, 0, 0]}}
  - press: {{face: high.zmax, value: [0, 0, -{depth}]}}
contact: auto
load: {{steps: 1}}
""")
PY
for depth in 0.0002 0.1; do
  "$contact" pressed_$depth.yaml -quiet -error_estimate 0 > out 2>&1 || echo "exit $?"
  grep -o 'carries no force' out || echo "pressed by $depth: no warning of a pair without force"
done
# Two coarse cylinders that cross: where edges cross in their middles, no vertex is inside the other body
for depth in 0.002 0.03; do
  cat > crossed.yaml <<YAML
bodies:
  - low: {shape: cylinder, axis: x, center: [0, 0, 0], radius: 1, extent: [-2, 2], cells: [2, 2, 3], young: 1000,
          poisson: 0.3}
  - high: {shape: cylinder, axis: y, center: [0, 0, 2], radius: 1, extent: [-2, 2], cells: [2, 2, 3], young: 1000,
           poisson: 0.3}
displacements:
  - hold: {face: low.lmin, value: [0, 0, 0]}
  - press: {face: high.lmin, value: [0, 0, -$depth]}
  - press_too: {face: high.lmax, value: [0, 0, -$depth]}
contact: auto
load: {steps: 1}
YAML
  for ranks in 1 3; do
    mpiexec --oversubscribe -n $ranks "$contact" crossed.yaml -quiet -error_estimate 0 > out 2>&1
    echo "crossed cylinders pressed by $depth, $ranks ranks: exit $?, $(grep -o 'carries no force' out)"
  done
done
# A rigid ball over cells as large as its radius: between four nodes, over a node, and over cells that are fine enough
ball() { # position, cells
  cat > ball.yaml <<YAML
bodies:
  - block: {lower: [-2, -2, -2], upper: [2, 2, 0], cells: [$2, $2, 4], young: 1000, poisson: 0.3}
  - ball: {shape: rigid_sphere, center: [$1, $1, 0.5], radius: 0.5}
displacements:
  - ground: {face: block.zmin, value: [0, 0, 0]}
  - press: {body: ball, value: [0, 0, -0.1]}
contact:
  - touch: {mortar: ball.surface, nonmortar: block.zmax}
YAML
  for ranks in 1 3; do
    mpiexec --oversubscribe -n $ranks "$contact" ball.yaml -quiet -error_estimate 0 > said 2>&1
    echo "ball at $1, $2 cells, $ranks ranks: exit $?"
    sed -n '/^contact:/p' said
  done
}
ball 0.25 8
ball 0 8
ball 0 24
# Nothing moves: no share of the largest displacement
sed -e 's/cells: \[24, 24/cells: [7, 7/; s/value: \[0, 0, -0.1\]/value: [0, 0, 0]/; s/0.5\], radius/0.495], radius/' \
  -e 's/block.zmax}/block.zmax, gap: node}/' ball.yaml > still.yaml
"$contact" still.yaml -quiet -error_estimate 0 2>&1 | grep -o 'penetrates.*open'
