# Cases whose values others published: the cheap ones, each within its tolerance
cheap=hertz_cylinder,gears,dovetail,press_fit,patch,plate,roller,punch_0,punch_0.1,belt,cube,incline
"$PYTHON" -B "$AMGF_DIR/share/published/cases.py" --folder "$PWD" ${CASES---only $cheap} > log 2> errors ||
  { echo "exit code $?"; cat log errors; }
