# The table of keys: -scene_keys prints it, share/scenes/README.md has it. Every key that a scene of every key uses is
# in it.
"$PYTHON" "$AMGF_DIR/tests/scene/scene_keys.py" check
"$AMGF_DIR/bin/contact" -scene_keys > keys.md
for key in $(sed -n 's/^ *\([a-z_]*\):.*/\1/p' "$AMGF_DIR/tests/scene/scene_every_key.yaml" | sort -u); do
  case $key in inner | outer | cap | amgf | ksp_view | tao_ipfilter_tol) continue ;; esac # nested, or of the solver
  grep -q "^| .$key. |" keys.md || echo "not in the table: $key"
done
