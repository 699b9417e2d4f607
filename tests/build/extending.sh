# The worked example of share/doc/extending.md: its law is compiled with its one line, linked with all that is built,
# and its scene runs. What is compiled again is the table of laws alone, since a law at the end of the list changes none
# of the others.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cp -rL "$AMGF_DIR/include" .
mkdir -p src/material
cp "$AMGF_DIR"/src/material/*.h "$AMGF_DIR"/src/material/material.c src/material

"$PYTHON" - "$AMGF_DIR/share/doc/extending.md" << 'PY'
import re, sys
blocks = re.findall(r"```\w+\n(.*?)```", open(sys.argv[1]).read(), flags=re.S)
law, line, scene = blocks
open("src/material/cubic.c", "w").write(law)
open("cubic.yaml", "w").write(scene)
open("soft.yaml", "w").write(scene.replace("shear: 4e5", "shear: 2e5"))
open("wrong.yaml", "w").write(scene.replace("shear: 4e5", "shear: -1"))
open("linear.yaml", "w").write(scene.replace("material: cubic", "material: linear").replace("      shear: 4e5\n", ""))
header = open("include/material.h").read()
last = re.findall(r"^  LAW\(.*$", header, flags=re.M)[-1]
open("include/material.h", "w").write(header.replace(last, last + " \\\n" + line.rstrip("\n")))
PY

hdf5=$(pkg-config --cflags hdf5-openmpi 2> /dev/null || pkg-config --cflags hdf5 2> /dev/null)
for file in material cubic; do
  mpicc -std=c11 -Wall -Wextra -O1 -Iinclude \
    -I. $(pkg-config --cflags PETSc) $hdf5 -c "src/material/$file.c" -o "$file.o" || exit 1
done
folders=$AMGF_DIR/lib,-rpath,$(pkg-config --variable=libdir PETSc)
mpicc "$AMGF_DIR"/build/apps/*.o material.o cubic.o "$AMGF_DIR/lib/libcontact.a" \
  -L"$AMGF_DIR/lib" -lpetscamgf "-Wl,-rpath,$folders" \
  $(pkg-config --libs PETSc) $(make -s --no-print-directory -C "$AMGF_DIR" print-contact-libs) -o contact || exit 1
echo "compiles and links"
for name in cubic linear soft; do
  ./contact "$name.yaml" -quiet -summary "$name.json" || echo "$name: exit code $?"
done
./contact wrong.yaml -quiet 2>&1 | grep -o 'body "beam" has .*'
"$PYTHON" - << 'PY'
import json

cubic, linear, soft = (json.load(open(name + ".json"))["steps"][-1]["energy"] for name in ("cubic", "linear", "soft"))
print("isotropic shear modulus: the energy of the law linear to 1e-8:",
      "yes" if abs(cubic - linear) < 1e-8 * linear else ("NO", cubic, linear))
print("half of it: more energy:", "yes" if 1.01 * linear < soft < 2 * linear else ("NO", soft, linear))
PY
