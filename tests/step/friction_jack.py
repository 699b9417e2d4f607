"""The force that pushes the lower wedge of friction_jack.sh, against statics."""
import math

from summaries import load, say, within

WEIGHT, SLOPE, FRICTION = 300, math.atan(3 / 12), 0.15

run = load("jack")
push = [face["reaction"][0] for step in run["steps"] for face in step["faces"] if face["name"] == "low.side1"]
expected = WEIGHT * (FRICTION + math.tan(SLOPE + math.atan(FRICTION)))
say("the force is that of statics within 1 %", all(within(p, expected, 0.01) for p in push[1:]), push)
