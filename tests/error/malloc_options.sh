# PETSc's options that trace memory: no error, and no memory is left at the end
for option in -malloc_debug -malloc_dump "-malloc_view :blocks.txt" "-log_view_memory -log_view :log.txt"; do
  "$AMGF_DIR/bin/contact" "$AMGF_DIR/share/scenes/patch_test.yaml" -quiet $option 2>&1
  echo "$option: exit code $?"
done
