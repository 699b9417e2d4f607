# The scene whose mesh Gmsh made: the same energy and contact force on one, two and three ranks
for ranks in 1 2 3; do
  mpiexec --oversubscribe -n "$ranks" "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/gmsh_blocks.yaml" -quiet \
    -tao_ipfilter_tol 1e-10 -summary "$ranks.json"
  echo "$ranks: exit $?"
done
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - <<'PY'
from summaries import load, say, within

one, *more = (load(str(ranks))["steps"][-1] for ranks in (1, 2, 3))
for ranks, step in enumerate(more, 2):
    say(f"energy, {ranks} ranks", within(step["energy"], one["energy"], 1e-9), (step["energy"], one["energy"]))
    say(f"contact force, {ranks} ranks", within(step["contact_force"][2], one["contact_force"][2], 1e-8),
        (step["contact_force"], one["contact_force"]))
PY
