# make demo's program: a dozen lines, each computed figure within half a per cent of Hertz's, a picture, and files for
# ParaView
folder=build/tests/demo
cd "$AMGF_DIR" && rm -rf $folder || exit 1
"$PYTHON" -B share/demo/hertz.py $folder > "$OLDPWD/demo.out" || echo "exit code $?"
"$PYTHON" -B - "$OLDPWD/demo.out" <<'CHECK'
import os
import re
import sys

with open(sys.argv[1]) as file:
    lines = file.read().splitlines()
print("lines:", "about ten" if 8 <= len(lines) <= 13 else lines)
for name in ("peak pressure", "half-width of the contact", "force per length", "elastic energy per length"):
    rows = [line for line in lines if line.strip().startswith(name)]
    numbers = [float(number)
               for number in re.findall(r"[-+]?\d[\d.e+-]*", rows[0][len(name):])] if len(rows) == 1 else []
    if len(numbers) != 3 or abs(numbers[0] / numbers[1] - 1) > 5e-3 or abs(numbers[2]) > 0.5:
        print(name, "is off:", rows)
estimate = [float(number) for line in lines if "estimates" in line for number in re.findall(r"([\d.]+) %", line)]
print("its own estimate:", "0.2 to 0.8 %" if len(estimate) == 1 and 0.2 <= estimate[0] <= 0.8 else estimate)
for line in lines[-2:]:
    kind, path = line.split()
    print(kind, "there" if os.path.getsize(path) > 1000 else path)
CHECK
