# Friction of tetrahedra of first and second order, on each other and beside hexahedra: a block that is pushed a little
# less and a little more than friction holds, and one that is moved to and fro (the scenes are those of friction.py).
# friction_tetrahedra_long has all kinds
"$PYTHON" "$AMGF_DIR/tests/step/friction.py" scenes
for order in 1 2; do
  "$PYTHON" -B "$AMGF_DIR/tests/lib/tetrahedra.py" box ground_$order.msh $order -0.5 -0.5 -0.5 2.5 1.5 0 6 4 2
  "$PYTHON" -B "$AMGF_DIR/tests/lib/tetrahedra.py" box block_$order.msh $order 0 0 0 2 1 0.5 5 3 2
done
run() { # scene, kind and order of the ground and the block, ranks
  local bodies=() name=$1_$2_$3
  case $2 in t*) bodies+=("ground=ground_${2#t}.msh:${2#t}") ;; esac
  case $3 in t*) bodies+=("block=block_${3#t}.msh:${3#t}") ;; esac
  "$PYTHON" -B "$AMGF_DIR/tests/contact/tetrahedra_contact.py" mesh "$1.yaml" "${bodies[@]}" > "$name.yaml"
  [ "$4" = 1 ] || set -- "$1" "$2" "$3" "$4" mpiexec --oversubscribe -n "$4"
  timeout 1200 "${@:5}" "$AMGF_DIR/bin/contact" "$name.yaml" -quiet -summary "$name${5:+_$4}.json" 2> /dev/null
}
long=${1-}
for kind in "t1 t1" "t2 h1" ${long:+"t2 t2" "h1 t2"}; do
  run sticks $kind 1
  run slides $kind 1
done
for kind in "h1 h1" "t1 t1" ${long:+"t2 t2"}; do run cycle $kind 1; done
run cycle t1 t1 3
"$PYTHON" -B "$AMGF_DIR/tests/step/friction_tetrahedra.py" $long
