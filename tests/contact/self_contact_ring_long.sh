# The pinched ring on a finer mesh, found by contact: auto, on two and three ranks, and restarted
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact_ring.py" write
run() { # name, scene and options
  name=$1
  shift
  "$contact" "$@" -quiet -summary "$name.json" 2> "$name.log" || echo "$name: exit code $?"
}
run quarter quarter.yaml
run quarter_refined quarter.yaml -refine 1
run half half.yaml -output half -checkpoint half_checkpoint.h5 -checkpoint_every 7
run half_refined half.yaml -refine 1
run auto auto.yaml
run restarted half.yaml -output half -restart half_checkpoint.h5
for ranks in 2 3; do
  mpiexec --oversubscribe -n $ranks "$contact" half.yaml -quiet -summary half_$ranks.json 2> half_$ranks.log ||
    echo "half, $ranks ranks: exit code $?"
done
"$PYTHON" "$AMGF_DIR/tests/contact/self_contact_ring.py" long
