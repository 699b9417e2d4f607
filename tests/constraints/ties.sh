# Faces whose meshes do not match are tied: patch tests to rounding, finite strain as of one body, with contact beside
# it, some on three ranks; what cannot be tied is said in one sentence.
contact=$AMGF_DIR/bin/contact
"$PYTHON" "$AMGF_DIR/tests/constraints/ties.py" write
run() { # ranks, scene
  mpiexec --oversubscribe -n $1 "$contact" $2.yaml -quiet \
    -summary $2.json -elasticity_ksp_rtol 1e-13 -tao_ipfilter_tol 1e-11 || echo "$2: exit code $?"
}
for scene in pull whole tied_touch; do run 1 $scene; done
for scene in uniform finite touch; do run 3 $scene; done
# Another unit of force: moduli and loads by a factor
for unit in e-15 e-11 e14; do
  for scene in pull tied_touch; do
    sed "s/young: 10,/young: 10$unit,/; s/0, 0, 0.1\]/0, 0, 0.1$unit]/; s/0, 0, -0.3\]/0, 0, -0.3$unit]/" $scene.yaml \
      > ${scene}_$unit.yaml
    "$contact" ${scene}_$unit.yaml -quiet -summary ${scene}_$unit.json -elasticity_ksp_rtol 1e-13 \
      -tao_ipfilter_tol 1e-11 || echo "$scene, unit $unit: exit code $?"
  done
done
"$PYTHON" "$AMGF_DIR/tests/constraints/ties.py" judge
# try NAME FROM TO: the sentence where a scene has something else
try() {
  sed "s/$2/$3/" pull.yaml > other.yaml
  echo "$1: $("$contact" other.yaml -quiet 2>&1 || echo "exit code $?")"
}
try "uncovered" "upper: \[3, 2, 1\]" "upper: [2.5, 2, 1]"
try "far apart" "lower: \[0, 0, 1\]" "lower: [0, 0, 1.3]"
try "one face" "nonmortar: top.zmin" "nonmortar: low.zmax"
try "no face" "nonmortar: top.zmin" "nonmortar: top.under"
glue="  - glue: {mortar: low.zmax, nonmortar: top.zmin}\n"
try "a chain" "  - glue: .*" "$glue  - more: {mortar: top.zmin, nonmortar: low.zmax}"
try "twice" "  - glue: .*" "$glue  - more: {mortar: low.zmax, nonmortar: top.zmin, distance: 1}"
try "no distance" "nonmortar: top.zmin" "nonmortar: top.zmin, distance: 0"
