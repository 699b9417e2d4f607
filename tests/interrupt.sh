# A signal ends the run after the Newton step under way: the load step before it is written, the reason said, the exit code not 0.
contact=$AMGF_DIR/bin/contact

"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 1 -load_steps 4 -output run -summary run.json > run.log 2>&1 &
pid=$!
for i in $(seq 600); do
  grep -q 'Load step 2' run.log && break
  sleep 0.1
done
kill -TERM $pid
wait $pid
echo "exit $?: $(grep -o 'contact: load step .*' run.log)"
"$PYTHON" - <<'PY'
import json
run = json.load(open("run.json"))
print("converged: %s; reason: %s; load steps: %s" % (run["converged"], run["reason"], [step["converged"] for step in run["steps"]]))
PY
ls run*.h5 run.xmf

# While a run lives its files are its own
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 1 -load_steps 50 -output busy -quiet > /dev/null 2>&1 &
pid=$!
for i in $(seq 600); do
  [ -e busy.xmf ] && break
  sleep 0.1
done
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -quiet -output busy 2>&1 || echo "exit $?"
kill -TERM $pid
wait $pid
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -load_steps 1 -quiet -output busy && echo "and then those of the next"
rm -f busy*
