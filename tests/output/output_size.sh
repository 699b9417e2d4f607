# -output_every and -viewer_hdf5_sp_output: which load steps have fields, the history of all of them, the
# precision; files of an earlier run that are not of this one are removed, a restart goes on.
cat > press.yaml <<'YAML'
problem: press
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], young: 1000, poisson: 0.3}
displacements:
  - ground: {face: block.zmin, value: [0, 0, 0]}
  - press: {face: block.zmax, value: [0, 0, -0.03]}
load: {steps: 7, expression: t/10}
YAML
run() { "$AMGF_DIR/bin/contact" press.yaml -quiet -output press "$@" || echo "exit code $?"; }
say() {
  echo "$1: $(ls press_[0-9]*.h5 | tr '\n' ' ')$(grep -c '<Time' press.xmf) in press.xmf, $(wc -l < press.csv) lines"
}
files() {
  run "$@" 2>&1
  say "${*:-no option}"
}

files
cp press_0007.h5 double.h5
touch press_abc.h5 press_10.h5 press_0100.h5
files -output_every 3
ls press_abc.h5 press_10.h5 press_0100.h5 2> /dev/null
sed -i 's/steps: 7/steps: 5/' press.yaml
files -output_last
sed -i 's/steps: 5/steps: 3/' press.yaml
files -output_every 2 -checkpoint_every 3
sed -i 's/steps: 3/steps: 7/' press.yaml
files -output_every 2 -restart press_checkpoint.h5
files -viewer_hdf5_sp_output -checkpoint_every 7
"$PYTHON" -c 'import h5py, numpy
with h5py.File("press_0007.h5") as single, h5py.File("double.h5") as double:
    print({str(single[name].dtype) for name in single}, {str(double[name].dtype) for name in double})
    worst = max(numpy.nanmax(abs(single[name][:] - double[name][:])) / numpy.nanmax(abs(double[name][:])) for name in
                ("displacement", "nodal_stress"))
    print("relative difference below 1e-6, above 0:", 0 < worst < 1e-6)
kinds = set()
for name in ("press.h5", "press_checkpoint.h5"):
    with h5py.File(name) as file:
        file.visititems(lambda _, item: kinds.add(item.dtype.kind + str(item.dtype.itemsize)) if hasattr(item, "dtype")
                        else None)
print("mesh and checkpoint:", sorted(kinds))'
run -output_every 0 2>&1
