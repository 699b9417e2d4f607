# A misspelt option ends a run before it computes, with the nearest name, wherever it was given; those of PETSc go on.
# options.py holds the list of ours against the sources.
contact=$AMGF_DIR/bin/contact
scene=$AMGF_DIR/share/scenes/cantilever.yaml

try() {
  "$contact" "$scene" -quiet -load_steps 1 "$@" > out 2> err
  echo "$*: exit $?: $(sed "s|$AMGF_DIR/||" err)"
  [ ! -s out ] || head -n 3 out
}

"$PYTHON" "$AMGF_DIR/tests/doc/options.py"
try -outptu results
try -rfeine 1
try -contact_updats 3
try -tao_ipfilter_tlo 1e-8
try -tao_ipfilter_pc_amgf_cycel fbf
try -accuracy_shar 0.2
try -accuracy_shar 0.2 -scene_check
try -kps_rtol 1e-8
try -refine 0 1
try -no_quite
echo "-rfeine 1" > file.opts
try -options_file file.opts
export PETSC_OPTIONS='-outptu results'
try -refine 0
unset PETSC_OPTIONS
try -elasticity_ksp_rtoll 1e-8 -options_left 0 -elasticity_pc_amgf_cycle fbf \
  -tao_ipfilter_amgf_amg_pc_hypre_boomeramg_agg_nl 0 -no_tables_view -malloc_dump 0 -Refine 0
mpiexec --oversubscribe -n 3 "$contact" "$scene" -quiet -outptu results 2>&1 | grep '^contact'
# Options of ours without the value that they need, or with one of another kind
for option in refine output restart summary accuracy model contact_gap_tol tao_ipfilter_tol checkpoint_every; do
  try -$option
  try -$option -quiet
done
try -refine abc
try -refine 1.5
try -load_steps 4294967297
try -checkpoint_every 99999999999999999999
try -checkpoint_every -1
try -load_max_cuts -1
try -tao_max_it true
try -elasticity_ksp_rtol small
try -tao_ipfilter_tol small
try -tao_ipfilter_max_soc many
try -quiet nofile
try -tao_ipfilter_monitor 3x
try -contact_gap wide
try -tao_ipfilter_pc_amgf_cycle bbf
try -load_steps 1 -tao_ipfilter_subspace maybe
try -elasticity_mat_type xyz
try -load_steps 1 -traceback maybe
sed 's/^solver:.*//' "$scene" > solver.yaml
echo 'solver: {tao_ipfilter_tol: tight}' >> solver.yaml
sed 's/tao_ipfilter_tol: tight/tao_ipfilter_tl: 1/' solver.yaml > misspelt.yaml
scene=solver.yaml
try -refine 0
scene=misspelt.yaml
try -refine 0
