# Shrink fit of two thick rings, a quarter of each, compared with Lame's solution. The facets of the two rings do not
# match. Formulations: smooth surfaces, with either ring as nonmortar side; facets, which overlap by their sagitta; node
# to segment.
rings() { # facets on the inner and the outer ring, mortar, nonmortar, gap, smooth
  cat <<SCENE
bodies:
  - inner: {shape: tube_arc, axis: z, radii: [15, 25.015], angles: [0, 90], extent: [0, 2], cells: [6, $1, 1],
            young: 210000, poisson: 0.3}
  - outer: {shape: tube_arc, axis: z, radii: [24.985, 40], angles: [0, 90], extent: [0, 2], cells: [6, $2, 1],
            young: 210000, poisson: 0.3}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
contact:
  - fit: {mortar: $3, nonmortar: $4, gap: $5, smooth: $6}
contact_updates: 5
SCENE
}

run() { # name, ranks
  local launch=()
  [ "$2" -eq 1 ] || launch=(mpiexec --oversubscribe -n "$2")
  "${launch[@]}" "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -output "$1" -summary "$1.json" -tao_ipfilter_tol 1e-11 \
    >/dev/null || echo "$1: exit code $?"
}

for facets in "24 30" "30 24" "20 32"; do
  name=rings_${facets/ /_}
  rings $facets outer.inner inner.outer mortar true > "${name}_in.yaml"
  rings $facets inner.outer outer.inner mortar true > "${name}_out.yaml"
  run "${name}_in" 1
  run "${name}_out" 1
done
run_as() { # name, of the scene, ranks
  cp "$2.yaml" "$1.yaml"
  run "$1" "$3"
}
run_as two_ranks rings_24_30_in 2
run_as three_ranks rings_24_30_in 3
rings 24 30 outer.inner inner.outer mortar false > facets.yaml
rings 24 30 outer.inner inner.outer node true > node.yaml
run facets 1
run node 1
"$PYTHON" "$AMGF_DIR/tests/contact/shrink_fit.py"
