# Pictures of a run, without a display: bodies in front hide those behind, bodies are named, contact fields colour only
# the faces of contact pairs, a status has one colour, and errors say what there is.
unset DISPLAY
cp "$AMGF_DIR/tests/lib/boxes.yaml" .
"$AMGF_DIR/bin/contact" boxes.yaml -quiet -output boxes -summary boxes.json || echo "exit code $?"
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

for refused in "--section y" "--section 1,2=3" "--section z=-9" \
  "--step 7" "--only base,lid" "--only 2" "--field heat" "--field stress" "--hide y" "--scale big" \
  "--hide z>-1"; do
  # shellcheck disable=SC2086
  draw boxes no.png $refused 2>&1 && echo "$refused: drawn"
done
# One side of a pair is coloured, that with the largest pressure; the mark has the largest value and its place; colours
# are not changed by light; a section omits what is in front of it; load steps have one range of colours and one view
PYTHONPATH=$AMGF_DIR/share/plot:$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/output/pictures_parts.py"
# The screen stays when the last picture has closed its window
PYTHONPATH=$AMGF_DIR/share/plot "$PYTHON" -B - <<'PY'
import ctypes
import screen

screen.open_screen()
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype, x11.XCloseDisplay.argtypes = ctypes.c_void_p, [ctypes.c_void_p]
lost = 0
for _ in range(50):
    window = x11.XOpenDisplay(None)
    lost += not window
    if window:
        x11.XCloseDisplay(window)
print("windows without a screen:", lost)
PY
# A Python without modules finds the one of the build; where that has none, one sentence says what is missing
"$PYTHON" -S -B "$AMGF_DIR/share/plot/draw.py" boxes other.png --field body && ls other.png
mkdir -p bare/bin bare/share && cp -r "$AMGF_DIR/share/plot" "$AMGF_DIR/share/python" bare/share
echo 'exec /nowhere/python3 -B' > bare/bin/contact-mesh
for program in draw film curves; do
  "$PYTHON" -S -B bare/share/plot/$program.py boxes no.png 2>&1 | sed 's|Python at [^ ]*|Python at PYTHON|'
done
draw nothing no.png 2>&1 || ls no.png 2> /dev/null
PYTHONPATH=$AMGF_DIR/share/python "$PYTHON" -B -c 'from contact.files import Files
for field in ("stress_xx", "contact_pressure", "contact_force", "displacement", "contact_area", \
  "strain_energy_density", "equivalent_plastic_strain", "velocity"):
    print(field, Files("boxes").unit(field))'
"$AMGF_DIR/bin/contact-mesh" "$AMGF_DIR/share/gmsh/two_blocks.msh" -check -picture mesh.png -quiet
"$PYTHON" -B "$AMGF_DIR/tests/output/pictures.py" mesh.png=base,punch
