# The two-block benchmark: the published configuration on a coarse mesh against the defaults and against AMG alone; on
# mesh 1 the defaults against MUMPS, and on three ranks. two_block_long has the published figures. Figures and
# tolerances are in two_block.py.
contact=$AMGF_DIR/bin/contact
scene=$AMGF_DIR/share/scenes/two_block.yaml
published=$AMGF_DIR/share/options/published.opts

run() {
  name=$1
  ranks=$2
  shift 2
  launch=()
  [ "$ranks" -eq 1 ] || launch=(mpiexec --oversubscribe -n "$ranks")
  timeout 1200 "${launch[@]}" "$contact" "$scene" -quiet -summary "$name.json" "$@" || echo "$name: exit code $?"
}

run published 1 -refine 0 -contact_free -options_file "$published"
run coarse 1 -refine 0
# the same method with every system solved by MUMPS
run exact 1 -options_file "$AMGF_DIR/share/options/direct.opts" -tao_ipfilter_subspace false -tao_ipfilter_tol 1e-9
for ranks in 1 3; do run "default_$ranks" "$ranks"; done
# without the filter, the last Newton systems need more iterations than the bound allows
run amg 1 -load_steps 1 -refine 0 -options_file "$published" -tao_ipfilter_pc_type hypre -tao_ipfilter_ksp_max_it 10000
"$PYTHON" "$AMGF_DIR/tests/step/two_block.py"
