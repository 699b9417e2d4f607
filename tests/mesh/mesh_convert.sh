# Meshes of other programs: decks of Abaqus and CalculiX, MED, Exodus, VTU. contact-mesh keeps names, volumes and areas;
# scenes read such files, also with a scale, and give the energy of the same mesh in another format; damaged files are
# refused in one sentence.
"$PYTHON" -B "$AMGF_DIR/tests/mesh/mesh_convert.py" write
mesh() { "$AMGF_DIR/bin/contact-mesh" "$@" 2>&1; }
for file in hexahedron.inp hexahedron20.inp hexahedron27.inp tetra.inp tetra10.inp wedge.inp cells.vtu turned.med \
  blocks.e; do
  mesh "$file" -check
done
mesh hexahedron27.inp there.msh -quiet && mesh there.msh there.inp -quiet && mesh there.inp -check | sed 1d > back
mesh hexahedron27.inp -check | grep -v "^sets" | sed 1d | sort | diff - <(sort back) &&
  echo "hexahedron27: there and back"
mesh hexahedron.inp back.msh -quiet && mesh back.msh back.inp -quiet

names="hexahedron hexahedron20 hexahedron27 tetra10 med exodus gmsh deck scaled"
for name in $names; do
  "$AMGF_DIR/bin/contact" "$name.yaml" -quiet -summary "$name.json" || echo "$name: exit code $?"
done
# shellcheck disable=SC2086
"$PYTHON" -B "$AMGF_DIR/tests/mesh/mesh_convert.py" judge $names
ls -d "${TMPDIR:-/tmp}"/contact-??????/mesh.msh 2> /dev/null

refused() { # file, text
  printf '%s\n' "$2" > "$1"
  mesh "$1" -check | sed "s|$PWD/||"
}
refused no_cells.inp "*NODE
1, 0, 0, 0"
refused word.inp "*NODE
1, 0, zero, 0"
refused short.inp "*NODE
1, 0, 0, 0
*ELEMENT, TYPE=C3D4
1, 1, 1, 1"
refused lacks.inp "*NODE
1, 0, 0, 0
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4"
refused wedge15.inp "*ELEMENT, TYPE=C3D15
1, 1"
refused set.inp "*NODE
1, 0, 0, 0
*ELSET, ELSET=all
other"
refused include.inp "*INCLUDE, INPUT=include.inp"
refused damaged.vtu "<VTKFile>"
refused damaged.med "no HDF5"
refused unknown.stl "solid"
mesh nothing.inp -check
sed 's/^107, .*/107, 0.5, 0.5, -3.0/' hexahedron.inp > inverted.inp
mesh inverted.inp -check -quiet && echo "inverted: exit code 0"
mesh hexahedron.inp out.xyz
mesh hexahedron.inp out.msh -scale -1
mesh hexahedron.inp
sed 's/hexahedron.inp/word.inp/' hexahedron.yaml > word.yaml
"$AMGF_DIR/bin/contact" word.yaml -quiet 2>&1 || echo "exit code $?"
sed 's/scale: 1.0/scale: -2/' hexahedron.yaml > negative.yaml
"$AMGF_DIR/bin/contact" negative.yaml -quiet 2>&1 || echo "exit code $?"

# two cubes whose nodes coincide, in one element set: a volume for each part, in contact as bodies
"$PYTHON" -B "$AMGF_DIR/tests/mesh/mesh_convert.py" touching
mesh touching.inp -check
for scene in touching whole; do
  "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2>&1 || echo "$scene: exit code $?"
done
"$PYTHON" -B "$AMGF_DIR/tests/mesh/mesh_convert.py" pressed
