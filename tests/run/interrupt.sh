# A signal ends the run after the Newton step under way: the load step before it is written, the reason said, the exit
# code not 0.
contact=$AMGF_DIR/bin/contact

# begun PID COMMAND...: waits until the command succeeds, as long as the run lives
begun() {
  pid=$1
  shift
  until "$@" || ! kill -0 $pid 2> /dev/null; do sleep 0.1; done
}

"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 1 -load_steps 400 -output run -summary run.json \
  > run.log 2>&1 &
pid=$!
begun $pid grep -q 'Load step 2' run.log
kill -TERM $pid
wait $pid
echo "exit $?: $(grep -o 'contact: load step .*' run.log | sed 's/step [0-9]* /step N /')"
"$PYTHON" - <<'PY'
import glob, json

run = json.load(open("run.json"))
steps = [step["converged"] for step in run["steps"]]
print("converged: %s; reason: %s; all load steps but the last: %s" %
      (run["converged"], run["reason"], steps[:-1] == [True] *
       (len(steps) - 1) and not steps[-1] and 2 <= len(steps) < 400))
files = ["run.h5", "run.xmf", "run_checkpoint.h5"] + ["run_%04d.h5" % (k + 1) for k in range(len(steps) - 1)]
print("files of mesh, state and converged load steps:", sorted(files) == sorted(glob.glob("run*.h5") + ["run.xmf"]))
PY
rm -f run*

# While a run lives its files are its own
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 1 -load_steps 400 -output busy -quiet > /dev/null 2>&1 &
pid=$!
begun $pid test -e busy.xmf
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -quiet -output busy 2>&1 || echo "exit $?"
kill -TERM $pid
wait $pid
"$contact" "$AMGF_DIR/share/scenes/two_block.yaml" -refine 0 -load_steps 1 -quiet -output busy &&
  echo "and then those of the next"
rm -f busy*
