# Contact pressures and areas of rubber at finite strain. A rubber block is compressed to half its height between
# frictionless rigid plates, in one load step: its pressure is uniform and has a closed form. pressure_finite.py writes
# the scenes and checks.
"$PYTHON" "$AMGF_DIR/tests/contact/pressure_finite.py" scenes
for scene in *.yaml; do
  "$AMGF_DIR/bin/contact" "$scene" -quiet -output "out_${scene%.yaml}" -summary "${scene%.yaml}.json"
done
mpiexec -n 2 "$AMGF_DIR/bin/contact" plates_mortar.yaml -quiet -summary plates_mortar_2.json
mpiexec -n 5 "$AMGF_DIR/bin/contact" planes.yaml -quiet -summary planes_5.json # some ranks have no rows
"$PYTHON" "$AMGF_DIR/tests/contact/pressure_finite.py" check
