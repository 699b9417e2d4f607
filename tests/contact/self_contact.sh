# Contact of a surface with itself: a slit in a block, and a clamp whose jaws meet on one to three ranks; what is
# refused
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact.py" write
run() { # scene, ranks
  name=$1$([ "$2" -eq 1 ] || echo "_$2")
  mpiexec --oversubscribe -n "$2" "$contact" "$1.yaml" -quiet -output "$name" -summary "$name.json" \
    -tao_ipfilter_tol 1e-11 2> "$name.log" || echo "$name: exit code $?"
}
for scene in slit_body jaws named; do run $scene 1; done
run slit_body 3
run whole 2
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact.py" judge

try() { # what replaces the sides of the pair
  sed "s/self: clamp.inner/$1/" jaws.yaml > tried.yaml
  "$contact" tried.yaml -quiet 2>&1 | cut -c1-220
  echo "exit code ${PIPESTATUS[0]}"
}
try 'mortar: clamp.inner, nonmortar: clamp.inner'
try 'self: clamp.inner, mortar: clamp.upper'
try 'self: clamps'
try 'self: clamp.outside'
try 'self: clamp.inner, gap: node'
try 'self: clamp.inner, interference: true'
try 'self: clamp.inner, tie: 0.1'
"$contact" jaws.yaml -quiet -contact_gap node 2>&1 | cut -c1-220
