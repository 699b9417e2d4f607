# subspace_method on more numbers of ranks
set -- long
. "$AMGF_DIR/tests/tao_ipfilter/subspace_method.sh"
