# A shaft pushed out of its hub against its closed form (friction_axial.py), on two meshes, one rank and three
"$PYTHON" "$AMGF_DIR/tests/step/friction_axial.py" scenes
for scene in axial_16 axial_32; do timeout 1200 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json; done
for scene in held_1 held_5 held_swapped held_sticks; do
  timeout 1200 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2> $scene.err; done
timeout 1200 mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" axial_16.yaml -quiet -summary axial_16_3.json
"$PYTHON" "$AMGF_DIR/tests/step/friction_axial.py"
# What is exact to rounding needs no more unknowns in the reduced problem
extended=$("$AMGF_DIR/bin/contact" axial_16.yaml -quiet -info :tao | grep -c 'extended to all unknowns')
echo "axial_16: reduced problems that were extended: $extended"
