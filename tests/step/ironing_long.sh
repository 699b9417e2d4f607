# The ironing benchmark on a coarser mesh than the published ones: the defaults against the published configuration
for options in "published -options_file $AMGF_DIR/share/options/published.opts -tao_ipfilter_tol 1e-9" \
  "coarse -contact_smooth false -contact_updates 1"; do
  set -- $options
  name=$1
  shift
  timeout 1200 "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/ironing.yaml" -quiet -refine 0 \
    -summary "$name.json" "$@" || echo "$name: exit code $?"
done
"$PYTHON" - <<'PY'
from summaries import each, load, say, within

energies = list(zip(each(load("coarse"), "energy"), each(load("published"), "energy")))
say("ironing, coarse: energies of the published configuration at tolerance 1e-9, to 1e-6",
    all(within(a, b, 1e-6) for a, b in energies), energies)
PY
