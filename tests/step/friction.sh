# Friction against closed forms and statics (friction.py), on several numbers of ranks, restarted, and what is refused
"$PYTHON" "$AMGF_DIR/tests/step/friction.py" scenes
run() {
  name=$1
  scene=$2
  shift 2
  timeout 1200 "$@" "$AMGF_DIR/bin/contact" "$scene.yaml" -quiet -summary "$name.json" $options 2> "$name.err" ||
    sed 's/ (KKT error [^;]*//; s/: it fell [^;]*//' "$name.err"
}
for scene in sticks slides limited capped rough oiled grips finite cycle node swapped_limited shaft inclined foreseen \
  few thin guided brink over proportional_1 proportional_2 proportional_5 proportional_20; do
  run $scene $scene
done
for scene in cattaneo swapped; do options="-output $scene" run $scene $scene; done
run thin_3 thin mpiexec --oversubscribe -n 3
options="-options_file $AMGF_DIR/share/options/direct.opts" run opens opens
options="-checkpoint_every 4 -checkpoint cycle.h5" run part cycle
options="-restart cycle.h5" run cycle_restarted cycle mpiexec --oversubscribe -n 2
"$PYTHON" "$AMGF_DIR/tests/step/friction.py"
# Columns of the monitor: the second is the objective, the eighth the systems that a reduced problem took
"$AMGF_DIR/bin/contact" plates.yaml | awk 'NF == 10 && $1 ~ /^[0-9]+$/ && $2 ~ /e/ { systems += $8; problems++ }
  END {
    few = problems > 20 && systems < 2.7 * problems
    print "plates that a bolt holds: " (few ? "at most 2.7" : systems / problems) " systems a reduced problem"
  }'

refuse() {
  sed "$1" cycle.yaml > wrong.yaml
  shift
  "$AMGF_DIR/bin/contact" wrong.yaml -quiet "$@" 2>&1 | sed "s|$AMGF_DIR|.|"
  echo "exit code ${PIPESTATUS[0]}"
}
refuse 's/friction: 0.3/friction: -0.3/'
refuse 's/friction: 0.3/friction: nan/'
refuse 's/friction: 0.3/fricton: 0.3/'
refuse 's/friction: 0.3/friction: 0.3, stick: true/'
refuse 's/friction: 0.3/shear_limit: -1/'
refuse 's/friction: 0.3/stick: true, friction_ramp: across/'
refuse 's/friction: 0.3/friction: 0.3, friction_ramp: across/'
refuse 's/^load/displacement_bounds: 3\nload/'
refuse '' -tao_type almm
