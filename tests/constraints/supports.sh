# Tractions and forces on faces, springs and weak springs against closed forms and statics, some on three ranks.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/supports.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-10 || echo "$2: exit code $?"
}
for scene in pull twist bed float edges soft pad plug; do run 1 $scene; done
for scene in stack pads pins; do run 3 $scene; done
"$PYTHON" "$AMGF_DIR/tests/constraints/supports.py" judge
for scene in float stack; do
  sed '/weak_springs/d' $scene.yaml > loose.yaml
  "$contact" loose.yaml -quiet 2>&1
done
# Loads that nothing but weak springs carries; a stack so soft that a linearized gap lets it slide apart, though it
# stands
{ sed '/pressures:/,/probes:/d; /point/d' float.yaml \
  && printf 'body_forces:\n  - weight: {value: [0, 0, -1]}\n'; } > drop.yaml
sed 's/young: 100/young: 5/' soft.yaml > slide.yaml
for scene in drop slide; do
  "$contact" $scene.yaml -quiet 2>&1 | grep -v warning
  echo "exit code ${PIPESTATUS[0]}"
done
# Squeezed out between larger blocks, which a little friction prevents
sed 's/nonmortar: .*zm[a-z]*/&, friction: 0.1/' squeezed.yaml > rubbed.yaml
for scene in squeezed rubbed; do
  "$contact" $scene.yaml -quiet 2>&1 | grep -v warning
  echo "exit code ${PIPESTATUS[0]}"
done
sed 's/point: \[1, 0, 0\]/point: [0.9, 0.1, 0]/' pins.yaml > beside.yaml
"$contact" beside.yaml -quiet 2>&1
sed '/  - c: /d' pins.yaml > two.yaml
"$contact" two.yaml -quiet 2>&1
try() {
  sed "$1" pad.yaml > tried.yaml
  "$contact" tried.yaml -quiet 2>&1
  echo "exit code $?"
}
"$contact" pad.yaml -scene_check | grep '  springs'
try 's/distance: 0.3/distance: 0.1/'
try 's/distance: 0.3/distance: -1/'
try 's/to: low.zmax, //'
try 's/to: low.zmax/to: low.zmx/'
try 's/to: low.zmax/to: top.zmin/'
try 's/to: low.zmax/onto: low.zmax/'
try 's/4, 4, 20/0, 4, 20/'
try 's/4, 4, 20/4, 4, inf/'
# Many bodies on one another, each held by the one below; one of them, in the midst, along one axis by nothing
pile() {
  echo "bodies:"
  for i in $(seq 60); do
    echo "  - b$i: {lower: [0, 0, $((i - 1))], upper: [1, 1, $i], cells: [1, 1, 1], young: 1, poisson: 0.3}"
  done
  printf 'displacements:\n  - foot: {face: b1.zmin, value: [0, 0, 0]}\ncontact:\n'
  for i in $(seq 59); do echo "  - p$i: {mortar: b$i.zmax, nonmortar: b$((i + 1)).zmin, friction: 0.3}"; done
}
pile > pile.yaml
sed 's/b40.zmin, friction: 0.3/b40.zmin/; s/b41.zmin, friction: 0.3/b41.zmin/' pile.yaml > slips.yaml
for scene in pile slips; do # seconds of the processor: far more than it takes
  (ulimit -t 2 && "$contact" $scene.yaml -scene_check > /dev/null 2> err)
  echo "$scene: exit code $? $(cat err)"
done
# 800 keys more, which PETSc's options database could not hold
for i in $(seq 200); do echo "  - more$i: {body: b1, point: [0, 0, 0], value: [0, 0, 0]}"; done > more.yaml
sed '/foot:/r more.yaml' pile.yaml > many.yaml
"$contact" many.yaml -scene_check > said 2>&1
echo "many: exit code $?, $(grep -o 'more[0-9]*' said | sort -u | wc -l) supports"
# A half ring on a plane without friction rolls and slides along it, whatever normals the facets of the ring have
wheel() {
  cat <<'END'
bodies:
  - ring: {shape: tube_arc, axis: z, radii: [8, 10], angles: [-180, 0], extent: [0, 4], cells: [1, 8, 1], young: 2000,
           poisson: 0.3}
  - floor: {FLOOR, material: rigid}
symmetry: [ring.lmin, ring.lmax, ring.amin, ring.amax]
displacements:
  - push: {body: floor, value: [0, 0.1, 0]}
contact:
  - touch: {mortar: floor.FACE, nonmortar: ring.outer}
END
}
wheel | sed 's/FLOOR/shape: rigid_plane, point: [0, -10, 0], normal: [0, 1, 0]/; s/FACE/surface/' > wheel.yaml
wheel | sed 's/FLOOR/lower: [-9, -12, -1], upper: [9, -10, 5], cells: [1, 1, 1]/; s/FACE/ymax/' > wheel_box.yaml
for scene in wheel wheel_box; do
  "$contact" $scene.yaml -scene_check 2>&1 > /dev/null
  echo "exit code $?"
done
