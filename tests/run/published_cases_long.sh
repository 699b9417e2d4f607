# All cases whose values others published
export CASES=
. "$AMGF_DIR/tests/run/published_cases.sh"
