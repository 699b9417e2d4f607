# The subspace method on shipped scenes, against the interior point method, on several numbers of ranks;
# subspace_method_long on more.
# Tolerances and limits of the cost are in subspace_method.py.
long=${1-}
run() {
  name=$1
  ranks=$2
  scene=$3
  shift 3
  launch=()
  [ "$ranks" -eq 1 ] || launch=(mpiexec --oversubscribe -n "$ranks")
  timeout 1200 "${launch[@]}" "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/$scene.yaml" -quiet -refine 0 \
    -contact_updates 1 -tao_gatol 1e-10 -summary "$name.json" "$@" 2> /dev/null || echo "$name: exit code $?"
}

run beam_sphere 1 beam_sphere_linear -load_steps 3 -tao_ipfilter_subspace false -tao_gatol 1e-12
for ranks in 1 3; do
  run "beam_sphere_$ranks" "$ranks" beam_sphere_linear -load_steps 3 -tao_ipfilter_subspace true \
    -tao_ipfilter_pc_amgf_factor false -contact_free
done
for ranks in ${long:+1} 2; do
  run "beam_sphere_direct_$ranks" "$ranks" beam_sphere_linear -load_steps 3 \
    -options_file "$AMGF_DIR/share/options/direct.opts" -log_view ":beam_sphere_direct_$ranks.log"
done
run ironing 1 ironing -load_steps 4 -tao_ipfilter_subspace false -tao_gatol 1e-12
for ranks in 1 ${long:+5}; do
  run "ironing_$ranks" "$ranks" ironing -load_steps 4 -tao_ipfilter_subspace true -tao_ipfilter_pc_amgf_factor false \
    -contact_free
done
for ranks in ${long:+1} 3; do run "ironing_chosen_$ranks" "$ranks" ironing -load_steps 4; done
# At finite strain: Newton's method on the subspace
run neo_hookean 1 beam_sphere_neo_hookean -load_steps 3 -tao_ipfilter_subspace false
for ranks in 1 ${long:+3}; do
  run "neo_hookean_$ranks" "$ranks" beam_sphere_neo_hookean -load_steps 3 -tao_ipfilter_pc_amgf_factor false
done
# The AMG of a nearly incompressible block needs more directions than there may be Newton steps
sed '/element: full/d; s/poisson: 0.499 */poisson: 0.4999\n      element: bbar/' \
  "$AMGF_DIR/share/scenes/two_block.yaml" > incompressible.yaml
"$AMGF_DIR/bin/contact" incompressible.yaml -quiet -refine 0 -load_steps 1 -contact_updates 1 \
  -tao_ipfilter_pc_amgf_factor false -error_estimate 0 > /dev/null && echo 'nearly incompressible: converged'
"$PYTHON" "$AMGF_DIR/tests/tao_ipfilter/subspace_method.py"
