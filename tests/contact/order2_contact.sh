# Contact of faces of order 2: the patch test across orders and stiffnesses on one rank and on three, Lame's shrink fit
# and Hertz's cylinder with a quarter of the facets that order 1 takes, on one rank and on three, a run that goes on
# from a checkpoint, the facets themselves and node to segment; and ties across orders
contact=$AMGF_DIR/bin/contact
options="-quiet -tao_ipfilter_tol 1e-12"

patch() { # orders of the lower and the upper block, Young's modulus of the upper, ranks, further options
  sed -e "s/^  - lower:/  - lower:\n      order: $1/; s/^  - upper:/  - upper:\n      order: $2/" \
    -e "s/young: 10/young: $3/; s/value: \[free, free, -0.0105\]/value: [free, free, -0.01]/" \
    "$AMGF_DIR/tests/contact/contact_patch.yaml" > patch.yaml
  mpiexec --oversubscribe -n "$4" "$contact" patch.yaml $options "${@:5}" -output "patch_$1_$2_$3_$4" ||
    echo "exit code $?"
}
for young in 1 1e3 1e6; do
  for orders in "1 2" "2 1" "2 2"; do
    patch $orders $young 1
  done
done
patch 2 2 10 3
patch 2 2 100 1 -contact_smooth false

rings() { # name, facets on the inner and the outer ring, their orders, layers, gap, smooth
  cat > "$1.yaml" <<SCENE
bodies:
  - inner: {shape: tube_arc, axis: z, radii: [15, 25.015], angles: [0, 90], extent: [0, 2], cells: [$6, $2, 1],
            young: 210000, poisson: 0.3, order: $4}
  - outer: {shape: tube_arc, axis: z, radii: [24.985, 40], angles: [0, 90], extent: [0, 2], cells: [$6, $3, 1],
            young: 210000, poisson: 0.3, order: $5}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
contact:
  - fit: {mortar: outer.inner, nonmortar: inner.outer, gap: $7, smooth: $8, interference: true}
contact_updates: 20
probes:
  - seam: {point: [17.688276127, 17.688276127, 1], body: inner}
SCENE
}
run() { # name, ranks, of the scene
  mpiexec --oversubscribe -n "$2" "$contact" "${3:-$1}.yaml" $options -output "$1" -summary "$1.json" ||
    echo "$1: exit code $?"
}
rings rings_22 8 10 2 2 2 mortar true
rings rings_12 16 10 1 2 2 mortar true
rings rings_21 8 20 2 1 2 mortar true
rings rings_node 8 10 2 2 2 node true
for name in rings_22 rings_12 rings_21 rings_node; do
  run $name 1
done
run three 3 rings_22

"$PYTHON" "$AMGF_DIR/share/scenes/meshes.py" hertz_cylinder coarse |
  sed 's/poisson: 0.3/poisson: 0.3\n      order: 2/' > cylinder.yaml
"$contact" cylinder.yaml -quiet -output cylinder -summary cylinder.json || echo "cylinder: exit code $?"

cat > press.yaml <<'YAML'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 1, poisson: 0.3, order: 2}
  - lid: {lower: [0, 0, 1.01], upper: [1.5, 1.5, 1.5], cells: [2, 2, 1], young: 5, poisson: 0.3, order: 2}
symmetry: [cube.xmin, cube.ymin, cube.zmin, lid.xmin, lid.ymin]
displacements:
  - top: {face: lid.zmax, value: [free, free, -0.2]}
contact:
  - joint: {mortar: lid.zmin, nonmortar: cube.zmax}
load: {steps: 3}
YAML
"$contact" press.yaml $options -contact_update_tol 1e-10 -checkpoint_every 2 -checkpoint press.h5 -summary press.json
mpiexec --oversubscribe -n 2 "$contact" press.yaml $options -contact_update_tol 1e-10 -restart press.h5 \
  -summary again.json

"$PYTHON" -B "$AMGF_DIR/tests/constraints/ties.py" write
tie() { # scene, orders of the lower and the upper block, ranks
  sed "s/\(  - low: .*\)young: 10/\1order: $2, young: 10/; s/\(  - top: .*\)young: 10/\1order: $3, young: 10/" \
    "$1.yaml" > tied.yaml
  mpiexec --oversubscribe -n "$4" "$contact" tied.yaml -quiet -elasticity_ksp_rtol 1e-13 \
    -summary "tie_$1_$2_$3_$4.json" || echo "tie: exit code $?"
}
tie uniform 1 2 1
tie uniform 2 1 3
tie uniform 2 2 1
"$PYTHON" -B "$AMGF_DIR/tests/contact/order2_contact.py"
