# contact -report: one page of a run, from the tree and from an installed copy, on one rank and on two; of a run that
# fails, whose exit code stays; and what is said where a module or the script is missing
contact=$AMGF_DIR/bin/contact
sed "s/problem: boxes/& \& <others>/" "$AMGF_DIR/tests/lib/boxes.yaml" > boxes.yaml
judge() { "$PYTHON" -B "$AMGF_DIR/tests/output/report.py" "$@"; }

sed 's/load:.*/load: {factors: [1, 0.5]}/' boxes.yaml > one.yaml
"$contact" one.yaml -quiet -report one.html || echo "exit code $?"
judge one 5
mkdir -p installed/bin installed/share/amgf
cp "$contact" installed/bin
cp -r "$AMGF_DIR/share/plot" "$AMGF_DIR/share/python" "$AMGF_DIR/share/report" installed/share/amgf
# Tilted, so that the largest stress is at the corner of the punch that is behind it
sed 's/value: \[0, 0, -0.1\]/&, rotation: [-0.1, -0.1, 0], center: [5, 5, 8]/' boxes.yaml > tilted.yaml
LD_LIBRARY_PATH=$AMGF_DIR/lib mpiexec --oversubscribe -n 2 installed/bin/contact tilted.yaml -quiet -load_steps 1 \
  -report two.html -output fields -summary two.json || echo "exit code $?"
judge two 4 # with the section: a corner of the punch hides the largest stress
ls fields.xmf two.xmf 2> /dev/null

sed 's/-0.1\]/-9]/' boxes.yaml > crushed.yaml
"$contact" crushed.yaml -quiet -report crushed.html > out 2> err
code=$?
written=$("$PYTHON" -c 'import json; print(json.load(open("crushed.json"))["exit_code"])')
echo "crushed: exit code $code, the summary's $written"
judge crushed 4
"$contact" crushed.yaml -quiet -load_steps 1 -report first.html > out 2> err || judge first 0 # no load step converged

"$contact" boxes.yaml -quiet -report page.txt 2>&1; echo "exit code $?"
mkdir less && cat > less/sitecustomize.py <<'PY'
import importlib.util as util
find = util.find_spec
util.find_spec = lambda name, *more: None if name == "vtkmodules" else find(name, *more)
PY
PYTHONPATH=less "$contact" boxes.yaml -quiet -report less.html 2>&1 | sed "s|at [^ ]*python3[0-9.]*|at PYTHON|"
ls less.h5 2> /dev/null
# As VTK ends where there is no screen: in colours
mkdir dies && echo 'import os; os.write(2, b"\033[0m\033[31mno screen\n\033[0m\n"); os._exit(1)' > dies/sitecustomize.py
PYTHONPATH=dies "$contact" boxes.yaml -quiet -report dies.html 2>&1
rm -r installed/share
LD_LIBRARY_PATH=$AMGF_DIR/lib installed/bin/contact boxes.yaml -quiet -report bare.html 2>&1; echo "exit code $?"
# Of many pairs an answer has the largest; the table of the largest values is closed
PYTHONPATH=$AMGF_DIR/share/report:$AMGF_DIR/share/plot:$AMGF_DIR/share/python "$PYTHON" -B - <<'PY'
import report

many = [{"quantity": "contact area", "name": f"pair{k}", "value": k, "unit": "mm^2", "step": 1, "place": [None],
         "components": [None]} for k in range(70)]
run = {"figures": many, "steps": [{}]}
print(report.listed(run, "contact area"))
print("closed table:", "<details>" in "".join(report.results(run)))
PY
