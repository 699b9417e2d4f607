# Scenes, meshes, checkpoints and option values that are damaged at random: see scene_mutations.py
bash "$AMGF_DIR/tests/lib/small_scenes.sh" true > /dev/null
"$PYTHON" "$AMGF_DIR/tests/scene/scene_mutations.py" 150 2> /dev/null
