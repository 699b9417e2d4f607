# Forces of pairs that turn, and where the work of the loads goes (friction_energy.py), on one rank, on three, and restarted
"$PYTHON" "$AMGF_DIR/tests/step/friction_energy.py" scenes
contact=$AMGF_DIR/bin/contact
for scene in sticks rubs slides eases pin seam swapped; do timeout 1200 "$contact" $scene.yaml -quiet -summary $scene.json; done
timeout 1200 mpiexec --oversubscribe -n 3 "$contact" pin.yaml -quiet -summary pin_3.json
timeout 1200 "$contact" pin.yaml -quiet -checkpoint_every 4 -checkpoint pin.h5 -summary part.json
timeout 1200 "$contact" pin.yaml -quiet -restart pin.h5 -summary pin_restarted.json
"$PYTHON" "$AMGF_DIR/tests/step/friction_energy.py"
# The table has the balance where there is friction
"$contact" pin.yaml | sed -n '/stored/,/^$/p' | awk 'NR == 1 || $1 == 6 { print NR == 1 ? $0 : $1 " " $(NF - 1) " %" }'
