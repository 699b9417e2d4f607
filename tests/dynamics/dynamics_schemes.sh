# Schemes of time integration and mass matrices: free vibration, an impact on a wall, and what is refused
# (dynamics_schemes.py)
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_schemes.py" scenes
for scene in vibration_*.yaml damped_*.yaml wall_*.yaml; do
  "$AMGF_DIR/bin/contact" $scene -quiet -error_estimate 0 -output ${scene%.yaml} 2> ${scene%.yaml}.err; done
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_schemes.py"
for scene in refused_*.yaml; do "$AMGF_DIR/bin/contact" $scene -quiet 2>&1; echo "exit $?"; done
