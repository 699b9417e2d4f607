# Contact patch test: non-matching flat faces transmit a uniform pressure exactly, on one rank and on three.
# Stress by hand: sigma = -0.0105/(1/1 + 0.5/10) = -0.01.
for ranks in 1 3; do
  launch=()
  [ "$ranks" -eq 1 ] || launch=(mpiexec --oversubscribe -n "$ranks")
  "${launch[@]}" "$AMGF_DIR/bin/contact" "$AMGF_DIR/tests/contact/contact_patch.yaml" -quiet -output "patch_$ranks" \
    -tao_ipfilter_tol 1e-12
  echo "$ranks: exit $?"
  "$PYTHON" "$AMGF_DIR/tests/contact/contact_patch.py" "patch_$ranks"
done
