# Contact and ties of tetrahedra: the patch test across kinds, orders and stiffnesses, on one rank and on three, and
# between facets; ties; a shrink fit of two rings on one rank and on three, mortar and node to segment; finite strain, a
# run that goes on, and the force of the same body of hexahedra
contact=$AMGF_DIR/bin/contact
options="-quiet -tao_ipfilter_tol 1e-12"
block() { "$PYTHON" -B "$AMGF_DIR/tests/lib/tetrahedra.py" "$@"; }
scene() { "$PYTHON" -B "$AMGF_DIR/tests/contact/tetrahedra_contact.py" mesh "$@"; }

block box low.msh 1 0 0 0 1 1 1 3 4 2
block box up.msh 1 0 0 1 1 1 1.5 4 3 3
patch() { # kind and order of the lower and the upper block, Young's modulus of the upper, ranks, further options
  local bodies=()
  sed "s/young: 10/young: $3/; s/value: \[free, free, -0.0105\]/value: [free, free, -0.01]/" \
    "$AMGF_DIR/tests/contact/contact_patch.yaml" > blocks.yaml
  case $1 in h*) sed -i "s/^  - lower:/  - lower:\n      order: ${1#h}/" blocks.yaml ;;
    *) bodies+=("lower=low.msh:${1#t}") ;; esac
  case $2 in h*) sed -i "s/^  - upper:/  - upper:\n      order: ${2#h}/" blocks.yaml ;;
    *) bodies+=("upper=up.msh:${2#t}") ;; esac
  scene blocks.yaml "${bodies[@]}" > patch.yaml
  mpiexec --oversubscribe -n "$4" "$contact" patch.yaml $options "${@:5}" -output "patch_$1_$2_$3_$4" ||
    echo "exit code $?"
}
for young in 1 1e3 1e6; do
  patch h1 t2 $young 1
  patch t2 h2 $young 1
done
patch t2 h1 10 3
patch h2 t2 10 1
patch t1 t2 10 1
patch t2 t2 10 1
patch t2 t2 100 3 -contact_smooth false

"$PYTHON" -B "$AMGF_DIR/tests/constraints/ties.py" write
block box tielow.msh 1 0 0 0 3 2 1 3 2 2
block box tietop.msh 1 0 0 1 3 2 2.5 4 5 3
tie() { # name, ranks, bodies of tetrahedra
  scene uniform.yaml "${@:3}" > tied.yaml
  mpiexec --oversubscribe -n "$2" "$contact" tied.yaml -quiet -elasticity_ksp_rtol 1e-13 -summary "tie_$1.json" ||
    echo "tie: exit code $?"
}
tie low 1 low=tielow.msh:2
tie top 3 top=tietop.msh:2
tie both 1 low=tielow.msh:2 top=tietop.msh:2

block ring inner.msh 2 15 25.015 2 8 1
block ring outer.msh 2 24.985 40 2 10 1
rings() { # gap
  cat <<SCENE
bodies:
  - inner: {mesh: inner.msh, volume: block, young: 210000, poisson: 0.3}
  - outer: {mesh: outer.msh, volume: block, young: 210000, poisson: 0.3}
symmetry:
  - ib: {face: inner.bottom, normal: y}
  - il: {face: inner.left, normal: x}
  - if: {face: inner.front, normal: z}
  - ik: {face: inner.back, normal: z}
  - ob: {face: outer.bottom, normal: y}
  - ol: {face: outer.left, normal: x}
  - of: {face: outer.front, normal: z}
  - ok: {face: outer.back, normal: z}
contact:
  - fit: {mortar: outer.inner, nonmortar: inner.outer, gap: $1, interference: true}
contact_updates: 20
SCENE
}
rings mortar > ring.yaml
rings node > ring_node.yaml
for ranks in 1 3; do
  mpiexec --oversubscribe -n $ranks "$contact" ring.yaml $options -summary ring_$ranks.json || echo "ring: exit code $?"
done
"$contact" ring_node.yaml $options -output ring_node -summary ring_node.json || echo "ring: exit code $?"

block box cube.msh 1 0 0 0 1 1 1 2 2 2
cat > hexahedra.yaml <<'YAML'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], order: 2, young: 1, material: neohookean, poisson: 0.3}
  - lid: {lower: [0, 0, 1.01], upper: [1.5, 1.5, 1.5], cells: [2, 2, 1], young: 5, poisson: 0.3, order: 2}
symmetry:
  - lid.xmin
  - lid.ymin
  - cx: {face: cube.xmin, normal: x}
  - cy: {face: cube.ymin, normal: y}
  - cz: {face: cube.zmin, normal: z}
displacements:
  - top: {face: lid.zmax, value: [free, free, -0.2]}
contact:
  - joint: {mortar: lid.zmin, nonmortar: cube.zmax}
load: {steps: 3}
YAML
scene hexahedra.yaml cube=cube.msh:2 > press.yaml
"$contact" hexahedra.yaml $options -contact_update_tol 1e-10 -summary hexahedra.json
"$contact" press.yaml $options -contact_update_tol 1e-10 -checkpoint_every 2 -checkpoint press.h5 -summary press.json
mpiexec --oversubscribe -n 2 "$contact" press.yaml $options -contact_update_tol 1e-10 -restart press.h5 \
  -summary again.json
"$PYTHON" -B "$AMGF_DIR/tests/contact/tetrahedra_contact.py" check
