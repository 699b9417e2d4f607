# A film of a run: a GIF with a picture of each Nth load step; errors say what is missing.
unset DISPLAY
cat > press.yaml <<'YAML'
problem: press
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1000, poisson: 0.3}
displacements:
  - ground: {face: block.zmin, value: [0, 0, 0]}
  - press: {face: block.zmax, value: [0, 0, -0.3]}
load: {steps: 3}
YAML
"$AMGF_DIR/bin/contact" press.yaml -quiet -output press || echo "exit code $?"
film() { "$PYTHON" -B "$AMGF_DIR/share/plot/film.py" "$@"; }

film press press.gif --every 2 --rate 5 --scale 1 --field displacement --limit 0.3
film press no.gif --every 0 2>&1 && echo "drawn"
film nothing no.gif 2>&1 && echo "drawn"
film press no.gif --field heat 2>&1 && echo "drawn"
ls no.gif 2> /dev/null
"$PYTHON" -c 'from PIL import Image
film, pictures = Image.open("press.gif"), []
for k in range(film.n_frames):
    film.seek(k)
    pictures.append(film.convert("RGB").tobytes())
print(film.n_frames, "pictures,", len(set(pictures)), "different, each", film.info["duration"], "ms")'
