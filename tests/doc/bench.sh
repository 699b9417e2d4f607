# The scripts of the bench: extrapolation, scenes, and records of runs, which are not repeated (bench.py); a scene of
# the front page, and the page itself without problems
PYTHONPATH=$AMGF_DIR/share/bench:$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/doc/bench.py"
"$PYTHON" -B "$AMGF_DIR/share/bench/front.py" --scene "cantilever, 0, order 2" > scene.yaml
"$AMGF_DIR/bin/contact" scene.yaml -scene_check > /dev/null && echo 'a scene of the front page'
rm -rf bench
"$PYTHON" -B "$AMGF_DIR/share/bench/front.py" --only none --folder bench > front.log
for file in README.md front.csv front.png; do [ -s bench/pages/$file ] && echo "$file" || echo "$file is missing"; done
