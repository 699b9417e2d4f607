# filtered_subspace on more numbers of ranks
set -- long
. "$AMGF_DIR/tests/tao_ipfilter/filtered_subspace.sh"
