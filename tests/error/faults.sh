# What breaks from outside or inside a run: each ends by itself with a reason and an exit code that is not 0, and what
# was written before stays readable. A signal: tests/run/interrupt.sh.
contact=$AMGF_DIR/bin/contact
blocks=$AMGF_DIR/share/scenes/two_block.yaml

# try NAME COMMAND: its exit code, and the sentence it ends with, without figures
try() {
  echo "$1"
  shift
  timeout 600 "$@" -quiet > out 2> err
  code=$?
  echo "  exit $([ $code -eq 124 ] && echo hang || echo $code): $(grep -ah 'contact: ' err | head -n 1 |
    sed -e "s|$PWD/||g" -e 's/KKT error .*/KKT error/' -e 's/||b - A d|| = .*/.../' -e 's/full? .*/full?/')"
}

one_step=(-refine 0 -load_steps 1 -load_max_cuts 0 -tao_max_it 20 -tao_ipfilter_subspace false)
no_space=(-options_file "$AMGF_DIR/share/options/direct.opts" -tao_ipfilter_mat_mumps_icntl_23 1 \
  -tao_ipfilter_mat_mumps_icntl_14 0)
for memory in 2000 0; do
  try "MUMPS without work space, allowed for another: $memory MB" "$contact" "$blocks" "${one_step[@]}" \
    "${no_space[@]}" -tao_ipfilter_direct_memory $memory
  try "limit of PCG, allowed for MUMPS: $memory MB" "$contact" "$blocks" "${one_step[@]}" -tao_ipfilter_ksp_max_it 1 \
    -tao_ipfilter_direct_memory $memory
done

cat > crush.yaml <<'YAML'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 1, poisson: 0.3}
displacements:
  - bottom: {face: cube.zmin, value: [0, 0, 0]}
  - top: {face: cube.zmax, value: [0, 0, -1.5]}
load: {steps: 2}
YAML
try "element turned inside out" "$contact" crush.yaml -output crush -summary crush.json
written() {
  "$PYTHON" - "$1" <<'PY'
import h5py, sys
with h5py.File(sys.argv[1]) as step:
    print("  %s is readable: %s" % (sys.argv[1], step["displacement"].shape[0] > 0))
PY
}
written crush_0001.h5
"$PYTHON" - <<'PY'
import json

run = json.load(open("crush.json"))
print("  the summary says so: converged %s, load steps %s" %
      (run["converged"], [step["converged"] for step in run["steps"]]))
PY

# The second load step's file goes where there is no room
sed 's/-1.5/-0.1/' crush.yaml > press.yaml
for ranks in 1 2; do
  rm -f full*
  ln -s /dev/full full_0002.h5
  try "full disk, ranks: $ranks" mpiexec --oversubscribe -n $ranks "$contact" press.yaml -output full
  written full_0001.h5
done
try "full disk for the summary" "$contact" "$blocks" -refine 0 -load_steps 1 -summary /dev/full
ls -l /dev/full | cut -c1
# PETSc 3.25 sees it before the program does
"$contact" "$blocks" -refine 0 -load_steps 1 > /dev/full 2> err
echo "full disk for what is printed
  exit $?: $(grep 'contact: ' err | sed 's/Error in fflush() due to "\(.*\)"/cannot print: \1/')"

# One rank is gone without a word: mpiexec ends the others
sed -i 's/neohookean/linear/' press.yaml
rm -f killed*
mpiexec --oversubscribe -n 3 "$contact" press.yaml -load_steps 100000 -output killed > run.log 2>&1 &
pid=$!
until [ -f killed_0002.h5 ] || ! kill -0 $pid 2> /dev/null; do sleep 0.1; done
ranks=$(tr ' ' '\n' < /proc/$pid/task/$pid/children | sed '/^$/d') # a bare machine has no pgrep
kill -KILL "$(tail -n 1 <<< "$ranks")" || kill $pid
SECONDS=0
wait $pid
code=$?
left() { for rank in $ranks; do kill -0 $rank 2> /dev/null && echo $rank; done | wc -l; }
while [ "$(left)" -gt 0 ] && [ $SECONDS -le 600 ]; do sleep 0.5; done
echo "one of three ranks killed
  exit $([ $code -eq 137 ] && echo 'of SIGKILL' || echo $code), ranks left in the end: $(left)"
written killed_0001.h5

# A crash, on one rank and on two
for ranks in 1 2; do
  rm -f crash*
  mpiexec --oversubscribe -n $ranks "$contact" press.yaml -load_steps 100000 -output crash > run.log 2> err &
  pid=$!
  until [ -f crash_0002.h5 ] || ! kill -0 $pid 2> /dev/null; do sleep 0.1; done
  child=$(tr ' ' '\n' < /proc/$pid/task/$pid/children | sed '/^$/d' | tail -n 1) # one rank runs without mpiexec
  kill -SEGV "${child:-$pid}" || kill $pid
  wait $pid
  echo "crash, ranks: $ranks
  exit $?: $(grep -a 'contact: ' err)"
done
