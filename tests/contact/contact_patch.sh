# Contact patch test: flat faces transmit a uniform pressure exactly, mortar where meshes do not match, on one rank and
# on three, node to segment where they match. Stress by hand: sigma = -0.0105/(1/1 + 0.5/10) = -0.01.
cp "$AMGF_DIR/tests/contact/contact_patch.yaml" mortar.yaml
sed 's/cells: \[4, 3, 3\]/cells: [3, 4, 3]/; s/nonmortar: upper.zmin/&, gap: node/' mortar.yaml > node.yaml
patch() { # scene, ranks
  mpiexec --oversubscribe -n "$2" "$AMGF_DIR/bin/contact" $1.yaml -quiet -output patch -tao_ipfilter_tol 1e-12
  echo "$1, $2: exit $?"
  "$PYTHON" "$AMGF_DIR/tests/contact/contact_patch.py" patch
}
patch mortar 1
patch mortar 3
patch node 1
