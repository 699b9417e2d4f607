# Where the resultant of a pair's pressure can stand, and what dual functions make of the patch test and of Hertz's
# cylinder (edge_resultant.py)
"$PYTHON" "$AMGF_DIR/tests/contact/edge_resultant.py" scenes
for scene in {dual,node}_{1,6}_{450,495,505} {mortar,auto}_6_{450,495,505}; do
  timeout 300 "$AMGF_DIR/bin/contact" $scene.yaml -quiet -summary $scene.json 2> $scene.err; done
"$AMGF_DIR/bin/contact" auto_three.yaml -quiet -checkpoint two.h5 -checkpoint_every 2 -summary auto_three.json \
  2> two.err
"$AMGF_DIR/bin/contact" auto_three.yaml -quiet -restart two.h5 -summary auto_rest.json
for gap in mortar dual; do
  end=${gap/mortar/}
  "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/hertz_cylinder.yaml" -quiet -contact_gap $gap \
    -summary cylinder${end:+_$end}.json
  "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/patch_test.yaml" -quiet -contact_gap $gap -tao_ipfilter_tol 1e-12 \
    -summary patch${end:+_$end}.json
done
"$PYTHON" "$AMGF_DIR/tests/contact/edge_resultant.py"
