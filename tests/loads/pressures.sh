# Pressures that vary over the face: the reactions of a wall under water, two rings under p + q cos 2 theta, a pressure
# that follows its face, and what is wrong with an expression
contact=$AMGF_DIR/bin/contact
wall() {
  cat <<YAML
bodies:
  - wall: {lower: [0, 0, 0], upper: [3, 0.5, 2], cells: [3, 1, 2], young: 1e5, poisson: 0.3, $1}
displacements: [{foot: {face: wall.zmin, value: [0, 0, 0]}}]
pressures: [{water: {face: wall.ymin, value: $2$3}}]
YAML
}
wall "order: 1" '"10*(2 - z)"' > linear.yaml
wall "order: 2" '"10*(2 - z)"' > quadratic.yaml
wall "order: 2" '"6*(x + 1)*(2 - z)"' > bilinear.yaml
wall "material: neohookean" 5000 ", follows: true" > follows.yaml
wall "material: neohookean" '"5000 + 0*x"' ", follows: true" > same.yaml
wall "material: neohookean" '"2500*z*(1 + 0*x)"' ", follows: true" > more.yaml
"$PYTHON" -B "$AMGF_DIR/share/published/cases.py" --scene rings > rings.yaml
for name in linear quadratic bilinear follows same more rings; do
  "$contact" $name.yaml -quiet -error_estimate 0 -ksp_rtol 1e-12 -tao_gatol 1e-10 \
    -summary $name.json || echo "$name: exit code $?"
done
mpiexec --oversubscribe -n 3 "$contact" more.yaml -quiet -error_estimate 0 -tao_gatol 1e-10 -summary more_3.json
"$PYTHON" -B - <<'CHECK'
from summaries import load, say, within

LINEAR = 10 * 2**2 / 2 * 3  # 10 N/m^3 of water 2 m deep at a wall of 3 m
for name, force in (("linear", LINEAR), ("quadratic", LINEAR), ("bilinear", 6 * (3**2 / 2 + 3) * 2**2 / 2)):
    reaction = load(name)["steps"][-1]["faces"][0]["reaction"]
    say(f"{name}: the reaction is the integral of the pressure", within(-reaction[1], force, 1e-9), (reaction, force))
energy = {name: load(name)["steps"][-1]["energy"] for name in ("follows", "same", "more", "more_3")}
say("follows: an expression of the same value has the same energy",
    within(energy["same"], energy["follows"], 1e-12), energy)
say("follows: one that varies has another", not within(energy["more"], energy["follows"], 0.1), energy)
say("the same on three ranks", within(energy["more_3"], energy["more"], 1e-8), energy)
peak = max(one["value"] for one in load("rings")["figures"] if one["quantity"] == "contact pressure")
say("rings: the largest pressure of Michell's solution within 0.2 %", within(peak, 93.2711, 2e-3), peak)
CHECK
for value in 20*q 'log(x)'; do
  sed "s|10\*(2 - z)|$value|" linear.yaml > wrong.yaml
  "$contact" wrong.yaml -quiet 2>&1
  echo "exit code $?"
done
