# A run goes on from a checkpoint: to the same answer on the same ranks, on others, on a refined mesh, with another load
# program; from what SIGKILL, SIGTERM and a full disk leave. What it cannot go on from is said in one sentence.
contact=$AMGF_DIR/bin/contact
cat > press.yaml <<'YAML'
problem: press
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 3], material: neohookean, young: 1, poisson: 0.3}
  - lid: {lower: [0, 0, 1.01], upper: [1.5, 1.5, 1.5], cells: [2, 2, 2], young: 5, poisson: 0.3}
symmetry: [cube.xmin, cube.ymin, cube.zmin, lid.xmin, lid.ymin]
displacements:
  - top: {face: lid.zmax, value: [free, free, -0.2]}
contact:
  - joint: {mortar: lid.zmin, nonmortar: cube.zmax}
load: {steps: 4}
YAML
sed 's/material: neohookean, //; s/problem: press/problem: linear/' press.yaml > linear.yaml
sed 's/steps: 4/factors: [0.25, 0.5, 0.75, 0.5, 0.1]/' press.yaml > later.yaml
options="-quiet -tao_ipfilter_tol 1e-12 -contact_update_tol 1e-12"
judge() { "$PYTHON" "$AMGF_DIR/tests/checkpoint/restart.py" "$@"; }

for scene in press linear; do
  "$contact" $scene.yaml $options -output whole -summary whole.json -checkpoint_every 3 -checkpoint $scene.h5 ||
    echo "exit code $?"
  cp -r whole.csv part.csv
  "$contact" $scene.yaml $options -restart $scene.h5 -summary part.json -output part
  judge "$scene, one rank" 1e-12 whole.json part.json
  echo "lines of its history: $(cut -d, -f1 part.csv | tr '\n' ' ')"
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml $options -restart $scene.h5 -summary part.json
  judge "$scene, three ranks" 1e-9 whole.json part.json
done
mpiexec --oversubscribe -n 2 "$contact" press.yaml $options -checkpoint_every 2 -load_steps 3 -checkpoint two.h5 \
  -summary whole.json
mpiexec --oversubscribe -n 2 "$contact" press.yaml $options -load_steps 3 -restart two.h5 -summary part.json
judge "from two ranks to two" 1e-12 whole.json part.json
# Six cells in a row: ranks of one cell in the middle own no vertices
cat > row.yaml << 'END'
problem: row
bodies:
  - low: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 5], young: 1, poisson: 0.3}
  - lid: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [1, 1, 1], young: 1, poisson: 0.3}
displacements:
  - floor: {face: low.zmin, value: [0, 0, 0]}
  - push: {face: lid.zmax, value: [0, 0, -0.01]}
contact:
  - joint: {mortar: low.zmax, nonmortar: lid.zmin}
load: {steps: 3}
END
"$contact" row.yaml $options -summary whole.json
timeout 600 mpiexec --oversubscribe -n 4 "$contact" row.yaml $options -checkpoint_every 2 -checkpoint row.h5 ||
  echo "a rank without vertices: exit code $?"
"$contact" row.yaml $options -restart row.h5 -summary part.json
judge "from ranks without vertices" 1e-9 whole.json part.json
mpiexec --oversubscribe -n 4 "$contact" row.yaml $options -restart row.h5 -summary part.json
judge "to ranks without vertices" 1e-9 whole.json part.json
"$contact" linear.yaml $options -refine 1 -summary whole.json
"$contact" linear.yaml $options -refine 1 -restart linear.h5 -summary part.json
judge "refined" 1e-9 whole.json part.json energy
"$contact" later.yaml $options -summary whole.json
"$contact" later.yaml $options -restart press.h5 -summary part.json
judge "another load program" 1e-9 whole.json part.json
"$contact" press.yaml -restart press.h5 | grep -A1 '^Problem'

"$contact" press.yaml $options -summary whole.json
# begun PID COMMAND...: waits until the command succeeds, as long as the run lives
begun() {
  pid=$1
  shift
  until "$@" || ! kill -0 $pid 2> /dev/null; do sleep 0.1; done
}
for part in 2 4 6; do
  rm -f killed.h5*
  "$contact" press.yaml $options -checkpoint_every 1 -checkpoint killed.h5 &
  pid=$!
  begun $pid test -f killed.h5
  sleep 0.0$(((part * 37 + $$) % 89 + 10))
  kill -KILL $pid 2> /dev/null
  wait $pid 2> /dev/null
  "$contact" press.yaml $options -restart killed.h5 -summary part.json 2> err &&
    judge "killed" 1e-12 whole.json part.json ||
    sed 's/.*: the analysis is already complete/killed: energy, work and forces as without a stop to 1e-12: yes/' err
done

"$contact" press.yaml -load_steps 4000 -checkpoint term.h5 > log 2>&1 &
pid=$!
begun $pid grep -qs 'Load step 3' log
kill -TERM $pid
wait $pid
echo "SIGTERM: exit $?, $(ls term.h5*)"
"$contact" press.yaml -load_steps 4000 -restart term.h5 -checkpoint term.h5 > again.log 2>&1 &
pid=$!
begun $pid grep -qsz 'Load step.*Load step' again.log # the first load step is complete
kill -TERM $pid
wait $pid
echo "and again: exit $?," \
  "$(grep -c '^Continuing from term.h5 at time \([2-9]\|[1-9][0-9][0-9]*\)' again.log)" \
  "$(grep -c '^Checkpoint term.h5: time' again.log)"

rm -f full.h5
trap '' XFSZ # the disk is full: a write fails, and no signal says so
"$contact" press.yaml -quiet -load_steps 4000 -checkpoint_every 1 -checkpoint full.h5 2> err &
pid=$!
begun $pid test -f full.h5
prlimit --pid $pid --fsize=16384
wait $pid
echo "full disk: exit $?, $(sed 's/full? .*/full?/' err)"
"$PYTHON" -c '
import h5py
with h5py.File("full.h5") as file:
    print("the checkpoint before is there:", file.attrs["time"] >= 1 and file["displacement"][...].shape[1] == 3)'

try() {
  "$contact" "$@" -quiet 2>&1 | grep -a 'contact: error\|HDF5' || echo "no error: $*"
}
sed 's/young: 5/young: 6/' press.yaml > other.yaml
sed 's/\[0.25, 0.5, 0.75/[0.25, 0.5, 0.7/' later.yaml > sooner.yaml
sed '/joint/d; /contact:/d; s/lid.zmax, value: \[free, free/lid.zmax, value: [0, 0/' press.yaml > alone.yaml
try other.yaml -restart press.h5
try alone.yaml -restart press.h5
try sooner.yaml -restart press.h5
try press.yaml -load_steps 3 -restart press.h5
try press.yaml -restart whole.h5
try press.yaml -restart press.yaml
try press.yaml -restart nowhere.h5
head -c 3000 press.h5 > torn.h5
try press.yaml -restart torn.h5 | sed "s/instead of $(stat -c %s press.h5)$/instead of all of them/"
try press.yaml -restart press.h5 -accuracy 0.1
try press.yaml -checkpoint_every 1 -checkpoint nowhere/press.h5
# Numbers and sizes of a file that is damaged, on the mesh that it is of and on a refined one
"$PYTHON" - <<'PY'
import shutil
import h5py
import numpy as np


def damage(name, change):
    shutil.copy("press.h5", name + ".h5")
    with h5py.File(name + ".h5", "r+") as file:
        change(file)


def number(key, value):
    damage("bad_" + key, lambda file: file.attrs.modify(key, np.array(value, file.attrs[key].dtype)))


def data(name, field, values):

    def replace(file):
        old = file[field]
        new = values(old[...])
        del file[field]
        file.create_dataset(field, data=new, dtype=old.dtype)

    damage(name, replace)


def put(index, value):

    def change(a):
        a[index] = value
        return a

    return change


damage("bad_earlier", lambda file: file.attrs.__delitem__("largest_speed"))
number("step", 7), number("time", np.nan), number("previous_time", 100.0), number("increment",
                                                                                  -1.0), number("work", np.inf)
data("bad_cells", "cells", lambda a: a[:-1])
data("bad_body", "body", lambda a: np.concatenate((a, a)))
data("bad_vertex", "cells", put((0, 3), 100000))
data("bad_field", "displacement", lambda a: a[:-1])
data("bad_value", "displacement", put((3, 1), np.nan))
data("bad_place", "vertices", put((3, 1), np.nan))
with open("press.h5", "rb") as file:
    whole = bytearray(file.read())
root = int.from_bytes(whole[64:72], "little")  # where the file's own group begins
whole[root:root + 8] = bytes(8 * [255])
with open("bad_root.h5", "wb") as file:
    file.write(whole)
PY
# Which call of HDF5 fails is PETSc's affair
try press.yaml -restart bad_root.h5 | sed 's/Error in HDF5 call .*/Error in HDF5 call .../'
for name in earlier step time previous_time increment work field value; do
  try press.yaml -restart bad_$name.h5; done
for name in cells body vertex field value place; do
  try press.yaml -restart bad_$name.h5 -refine 1
  [ $name = vertex ] || [ $name = field ] || continue
  timeout 600 mpiexec --oversubscribe -n 2 "$contact" press.yaml -restart bad_$name.h5 -refine 1 -quiet > err 2>&1
  echo "two ranks: exit $?, $(grep -ac 'contact: error' err) sentence"
done
# Nothing that a run refuses touches the results of an earlier one, nor does a run before it has solved a load step
earlier="-output earlier -checkpoint_every 1 -checkpoint earlier_state.h5 -summary earlier.json"
"$contact" press.yaml -quiet $earlier
refuse() {
  sums=$(md5sum earlier*)
  timeout 600 "$contact" "$@" -quiet $earlier > err 2>&1
  code=$?
  changed=$(md5sum earlier* | diff <(echo "$sums") - | sed -n 's/^[<>].* //p' | sort -u | tr '\n' ' ')
  echo "exit $code, changed: ${changed:-nothing}; $(grep -ah 'contact: ' err)"
}
refuse press.yaml -restart nowhere.h5
refuse other.yaml -restart press.h5
refuse press.yaml -restart torn.h5 | sed "s/instead of $(stat -c %s press.h5)$/instead of all of them/"
refuse press.yaml -load_steps 3 -restart press.h5
refuse press.yaml -restart earlier_state.h5
refuse press.yaml -restart press.h5 -refin 1
refuse press.yaml -tao_type none_such | sed 's/error: .*/error: .../'
refuse press.yaml -load_steps 1 -load_max_cuts 0 -tao_max_it 1 -tao_ipfilter_subspace false | sed 's/failed: .*/failed/'
# Files that another run has under way
parts="busy.h5.part busy.json.part busy_state.h5.part"
for part in $parts; do echo "of another run" > $part; done
"$contact" linear.yaml -quiet -load_steps 1 -output busy -checkpoint_every 1 -checkpoint busy_state.h5 \
  -summary busy.json
cat $parts
# The load step that fails after a restart has its number in the scene
cat > fails.yaml <<'YAML'
bodies:
  - cube: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [1, 1, 1], material: neohookean, young: 1, poisson: 0.3}
displacements:
  - foot: {face: cube.zmin, value: [0, 0, 0]}
  - head: {face: cube.zmax, value: [0, 0, -1]}
load: {factors: [0.05, 0.1, 2]}
YAML
for from in '-checkpoint_every 1 -checkpoint' -restart; do
  "$contact" fails.yaml -quiet -load_max_cuts 0 $from fails.h5 2>&1 | grep -o 'load step . failed'
done

# A dynamic run goes on to a later end time as if it had had that from the start; an end time before that of the
# checkpoint is an error
cat > fall.yaml <<'YAML'
bodies:
  - block: {lower: [0, 0, 0.01], upper: [1, 1, 1], cells: [2, 2, 2], young: 1e6, poisson: 0.3, density: 1000,
            initial_velocity: [0, 0, -1]}
  - floor: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
displacements:
  - fix: {body: floor, value: [0, 0, 0]}
contact:
  - hit: {mortar: floor.surface, nonmortar: block.zmin}
dynamics: {time_step: 2e-3, end_time: 0.01}
YAML
sed 's/end_time: 0.01/end_time: 0.04/' fall.yaml > later.yaml
sed 's/end_time: 0.01/end_time: 0.004/' fall.yaml > sooner.yaml
"$contact" fall.yaml -quiet -checkpoint fall.h5 -checkpoint_every 5 2> /dev/null || echo "exit code $?"
"$contact" later.yaml -quiet -restart fall.h5 -summary part.json || echo "exit code $?"
"$contact" later.yaml -quiet -summary whole.json || echo "exit code $?"
"$PYTHON" - <<'CHECK'
from summaries import load, say

whole, part = [load(name)["steps"][-1] for name in ("whole", "part")]
energy = [step["motions"][0]["momentum"][2] for step in (whole, part)]
say("a later end time: the same as from the start",
    part["step"] == whole["step"] == 20 and abs(energy[1] - energy[0]) < 1e-6 * abs(energy[0]), energy)
CHECK
"$contact" sooner.yaml -quiet -restart fall.h5 2>&1 || echo "exit code $?"
