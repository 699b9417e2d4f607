# Pictures of a run, without a display: bodies in front hide those behind, bodies are named, contact fields colour only
# the faces of contact pairs, a status has one colour, and errors say what there is.
unset DISPLAY
cp "$AMGF_DIR/tests/lib/boxes.yaml" .
"$AMGF_DIR/bin/contact" boxes.yaml -quiet -output boxes || echo "exit code $?"
draw() { "$PYTHON" -B "$AMGF_DIR/share/plot/draw.py" "$@"; }

draw boxes bodies.png --field body
draw boxes below.png --field body --view -90 0
draw boxes above.png --field body --view 90 0 --only punch
draw boxes one.png --field body --only base --step 1
draw boxes cut.png --field body --hide 'z>4'
draw boxes status.png --field contact_status --only base --view 40 -60 --scale auto
draw boxes pressure.png --field contact_pressure --only punch --view -40 -60 --mirror x
draw boxes stress.png --field stress_zz --around-contact 2 --title "Two boxes"
PYTHONPATH=$AMGF_DIR/share/plot:$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/output/pictures.py" \
  bodies.png=base,punch below.png=base,-punch above.png=punch,-base one.png=base,-punch cut.png=base,-punch \
  status.png=closed,grey pressure.png=grey,high stress.png=high

for refused in "--step 7" "--only base,lid" "--only 2" "--field heat" "--field stress" "--hide y" "--scale big" \
  "--hide z>-1"; do
  # shellcheck disable=SC2086
  draw boxes no.png $refused 2>&1 && echo "$refused: drawn"
done
# Two faces that touch are drawn one in front of the other, the finer one in front
PYTHONPATH=$AMGF_DIR/share/plot "$PYTHON" -B -c 'import draw
from vtkmodules.vtkCommonCore import reference
(_, bodies), _ = draw.scene_of(draw.arguments("boxes no.png --field contact_pressure --contact-only".split()), \
  draw.Files("boxes"))
offsets, mappers = [], [actor.GetMapper() for actor in bodies.GetActors()]
for mapper in (mapper for mapper in mappers if mapper.GetScalarVisibility()):
    factor, units = reference(0.0), reference(0.0)
    mapper.GetRelativeCoincidentTopologyPolygonOffsetParameters(factor, units)
    offsets.append((mapper.GetInput().GetNumberOfCells(), float(units)))
front = min(offsets, key=lambda face: face[1])
units = {layer for _, layer in offsets}
print("faces in contact, one in front:", len(offsets) == len(units) == 2 and front[0] == max(offsets)[0])'
draw nothing no.png 2>&1 || ls no.png 2> /dev/null
PYTHONPATH=$AMGF_DIR/share/python "$PYTHON" -B -c 'from contact.files import Files
for field in ("stress_xx", "contact_pressure", "contact_force", "displacement", "contact_area", \
  "strain_energy_density", "equivalent_plastic_strain", "velocity"):
    print(field, Files("boxes").unit(field))'
"$AMGF_DIR/bin/contact-mesh" "$AMGF_DIR/share/gmsh/two_blocks.msh" -check -picture mesh.png -quiet
"$PYTHON" -B "$AMGF_DIR/tests/output/pictures.py" mesh.png=base,punch
