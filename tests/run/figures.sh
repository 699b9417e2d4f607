# The largest values of a run: maximum and place against closed forms of a cantilever, Hertz's cylinder, and a thick
# tube; the same numbers in the summary, on the terminal, in the history and on any number of ranks; a rigid tool; a
# tube that yields; bodies of one layer of cells; cells that turn and yield; a contact that is one facet wide; torques
# of a face and a roll; the largest of many bodies; load steps that fail are left out; a yield stress that is none.
contact=$AMGF_DIR/bin/contact
check="$AMGF_DIR/tests/run/figures.py"
"$PYTHON" "$check" write
for scene in cantilever tube tool bolt layer hinge roll crank brake; do
  "$contact" $scene.yaml -output $scene -summary $scene.json > $scene.txt || echo "$scene: exit code $?"
done
for scene in tool bolt brake; do
  mpiexec --oversubscribe -n 3 "$contact" $scene.yaml -quiet -summary ${scene}_3.json || echo "$scene, 3: exit code $?"
done
"$contact" many.yaml > many.txt || echo "many: exit code $?"
"$contact" "$AMGF_DIR/share/scenes/hertz_cylinder.yaml" -quiet -summary hertz.json || echo "hertz: exit code $?"
"$contact" "$AMGF_DIR/share/scenes/thick_tube.yaml" -quiet -summary yields.json || echo "yields: exit code $?"
"$contact" tube.yaml -quiet -error_estimate 0 -summary plain.json || echo "plain: exit code $?"
sed 's/load:.*/load: {factors: [0.74, 2]}/' "$AMGF_DIR/share/scenes/thick_tube.yaml" > burst.yaml
"$contact" burst.yaml -quiet -summary burst.json -load_max_cuts 0 > /dev/null 2>&1; echo "burst: exit code $?"
"$PYTHON" "$check" check
sed 's/yield: 240/yield: -240/' tube.yaml > bad.yaml
"$contact" bad.yaml -quiet 2>&1; echo "exit code $?"
