# Contact with rigid surfaces that have no facets: plane, cylinder in rubber on one and three ranks; what is refused
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_surface.py" scenes
for scene in profile pressed driven beside rubber_1 rubber_2 rubber_mesh; do
  "$contact" $scene.yaml -quiet -summary $scene.json 2> /dev/null || echo "$scene: exit code $?"; done
mpiexec --oversubscribe -n 3 "$contact" rubber_1.yaml -quiet -summary rubber_1_3.json ||
  echo "rubber_1, three ranks: exit code $?"
"$PYTHON" "$AMGF_DIR/tests/contact/rigid_surface.py"

try() {
  sed "$2" $1.yaml > tried.yaml
  "$contact" tried.yaml -quiet 2>&1 | cut -c1-220
  echo "exit code ${PIPESTATUS[0]}"
}
try pressed 's/normal: \[0, 0, -2\], material: rigid/normal: [0, 0, -2], young: 1, poisson: 0/'
try pressed 's/normal: \[0, 0, -2\]/normal: [0, 0, 0]/'
try pressed 's/mortar: tool.surface, nonmortar: block.zmax/mortar: block.zmax, nonmortar: tool.surface/'
try cone 's/half_angle: 89.9/half_angle: 90/'
try sphere 's/radius: 1000/radius: -1/'
try punch 's/points: .0, 0, 1, 0, 1, 1./points: [0, 0, 1]/'
try profile 's/across: .-1, 0.5, 0./across: [0, 1, 0]/'
