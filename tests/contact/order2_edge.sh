# Order 2 where contact ends at a sharp edge: two_block with a consistent gap has the force of order 1 on as many
# unknowns, for both elements
two_block() { # name, order, element, refinements
  sed "/element:/d; /^contact_updates\|^refine/d; s/^\( *\)poisson: .*/&\n\1order: $2\n\1element: $3/" \
    "$AMGF_DIR/share/scenes/two_block.yaml" > "$1.yaml"
  "$AMGF_DIR/bin/contact" "$1.yaml" -refine "$4" -quiet -error_estimate 0 -summary "$1.json" > /dev/null 2> "$1.err" \
    || echo "$1: exit code $?"
}
two_block order1 1 bbar 1
two_block bbar 2 bbar 0
two_block full 2 full 0
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - << 'CHECK'
from summaries import each, load, say, within

order1 = [force[2] for force in each(load("order1"), "contact_force")]
for name in "bbar", "full":
    order2 = [force[2] for force in each(load(name), "contact_force")]
    say(f"{name}: forces of both load steps within 10 % of order 1's",
        all(within(a, b, 0.1) for a, b in zip(order2, order1)), (order2, order1))
CHECK
