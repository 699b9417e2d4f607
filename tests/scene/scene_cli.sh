# What bin/contact says to bad input, on one rank, and on three if that differs: its exit code, and one sentence. A run
# of ten minutes hangs.
contact=$AMGF_DIR/bin/contact
sound=$AMGF_DIR/share/scenes/two_block.yaml

# A scene that differs from the sound one by a sed command
change() { sed "$1" "$sound" > changed.yaml; }

try() {
  name=$1
  shift
  before=
  for ranks in ${RANKS:-1}; do
    launch=()
    [ "$ranks" -eq 1 ] || launch=(mpiexec --oversubscribe -n "$ranks")
    timeout 600 "${launch[@]}" "$contact" "$@" > out 2> err
    code=$?
    sentence=$(grep -h 'contact: ' err)
    said="exit $([ $code -eq 0 ] && echo 0 || { [ $code -eq 124 ] && echo hang || echo 'not 0'; })"
    said="$said, $(grep -c . <<< "$sentence") sentence: ${sentence//$AMGF_DIR\//}"
    [ "$said" = "$before" ] || echo "$name, ranks $ranks: $said"
    before=$said
  done
}

try "no scene"
RANKS="1 3" try "no such scene" nowhere.yaml
change 's/young: 1$/yuong: 1/' && try "misspelt key" changed.yaml
change 's/young: 1$/young: 0/' && try "E = 0" changed.yaml
change 's/0.499/0.5/' && try "nu = 0.5" changed.yaml
change 's/0.499/nan/' && try "NaN" changed.yaml
change 's/slab.zmin/slab.bottom/' && try "no such face" changed.yaml
change 's/mortar: slab/mortar: slob/' && try "pair with an unknown body" changed.yaml
change '/bottom:/d' && try "body held by contact alone" changed.yaml
change 's/upper: \[4.5/upper: [-5/' && try "negative box" changed.yaml
RANKS="1 3" try "refine -1" "$sound" -refine -1
echo 'refine 1' > word.opts
for file in nowhere.opts . word.opts; do # PETSc's own sentences
  try "-options_file $file" "$sound" -options_file $file | sed 's/\(contact: error: \).*/\1.../'
done
try "how -accuracy works without it" "$sound" -accuracy_adaptive
try "the same, of" "$sound" -accuracy_of pressure
try "the same, order" "$sound" -accuracy_order 2
try "the same, unknowns" "$sound" -accuracy_max_dofs 1e5
try "no load steps" "$sound" -load_steps 0
try "output that is a folder" "$sound" -output ./
RANKS="1 3" try "unwritable output" "$sound" -output nowhere/results -refine 0
RANKS="1 3" try "unwritable summary" "$sound" -summary nowhere/summary.json -refine 0 -load_steps 1
RANKS="1 3" try "checkpoint in place of the mesh" "$sound" -output results -checkpoint results.h5
try "checkpoint in place of a step, by another path" "$sound" -output results -checkpoint ./results_0002.h5
try "summary in place of the history" "$sound" -output results -summary results.csv
change 's/young: 1$/young: 2/' && cp changed.yaml copy.yaml
try "summary in place of the scene" changed.yaml -summary changed.yaml
try "summary and checkpoint of one name" "$sound" -summary same -checkpoint ./same
cmp changed.yaml copy.yaml && [ -z "$(ls | grep -e results -e same)" ] && echo "  nothing was written"
