# What share/packaging and share/python/pyproject.toml have in common with the sources: the version; every file that make install
# puts somewhere is in one Debian package; AMGF.py is Python; pip's copy of the Python package finds the program in PATH
set -u
unset MAKEFLAGS
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$AMGF_DIR" || exit 1
version=$(sed -n 's/^#define PETSCAMGF_VERSION_[A-Z]* *\([0-9]*\)$/\1/p' include/petscamgf.h | paste -sd.)
for file in share/python/pyproject.toml share/packaging/{petsc/AMGF.py,spack/package.py,conda/meta.yaml,README.md}; do
  grep -qE "(version|amgf-).*\b${version//./\\.}\b" "$file" || echo "$file: not version $version"
done

make --no-print-directory install DESTDIR="$work" PREFIX=/usr > "$work/log" 2>&1 || cat "$work/log"
grep -v '^/' "$work/usr/share/amgf/installed" | sed 's|^|usr/|' | while read -r path; do
  [ -d "$work/$path" ] && [ ! -L "$work/$path" ] && continue
  packages=$(for list in share/packaging/debian/*.install; do
    while read -r pattern; do
      case $path in $pattern | $pattern/*) basename "$list" .install ;; esac
    done < "$list"
  done)
  [ "$(echo "$packages" | wc -w)" -eq 1 ] || echo "$path is in the packages: $packages"
  echo "$packages" >> "$work/packages"
done
sort -u "$work/packages" | paste -sd' '

# As AMGF.py does
make --no-print-directory install PLUGIN_ONLY=1 PREFIX="$work/petsc" > "$work/log" 2>&1 || cat "$work/log"
(cd "$work/petsc" && ls -d bin include/* lib/*.so lib/*.a lib/pkgconfig/* share/* share/amgf/*) 2> /dev/null | paste -sd' '

"$PYTHON" - << 'P'
import ast
for name in ("petsc/AMGF.py", "spack/package.py"):
    ast.parse(open("share/packaging/" + name).read())
print("recipes: Python")
P

# Where Python has no pip, from the sources: which of both depends on the machine
cp -r share/python "$work/source"
if "$PYTHON" -c 'import setuptools, pip, wheel' 2> "$work/log"; then
  (cd "$work/source" && "$PYTHON" -m pip install -q --no-deps --no-build-isolation --no-warn-script-location \
    --root-user-action=ignore --target "$work/site" .) > "$work/log" 2>&1 || { echo "pip install"; cat "$work/log"; }
  mesh=$work/site/bin/contact-mesh
else
  mv "$work/source" "$work/site"
  mesh="-m contact.meshes"
fi
cd "$work" || exit 1
PATH=$AMGF_DIR/bin:$PATH PYTHONPATH=$work/site "$PYTHON" -B - << 'P'
import contact, contact.places
print("package:", contact.__file__.startswith(__import__("os").getcwd()))
print("program:", contact.places.program().endswith("bin/contact"))
print("script:", contact.places.script("plot/draw.py").endswith("share/plot/draw.py"))
P
# shellcheck disable=SC2086
PYTHONPATH=$work/site "$PYTHON" -B $mesh "$AMGF_DIR/share/gmsh/two_blocks.msh" -check | sed 's/:.*//;q' | xargs basename
env -u CONTACT PATH=/usr/bin PYTHONPATH=$work/site "$PYTHON" -B -c 'import contact.places as p; p.program()' 2>&1 | tail -n 1
