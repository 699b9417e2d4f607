# The documents: links lead somewhere, every column of every table is explained, options and manual pages are there; the
# user guide's commands, one after the other, as it has them.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$PYTHON" -B "$AMGF_DIR/share/doc/manpages.py" "$AMGF_DIR" "$work/man" 0
"$PYTHON" -B "$AMGF_DIR/tests/doc/doc.py" "$work/man"
for page in "$work"/man/man*/*; do
  if command -v groff > /dev/null; then groff -man -Tutf8 -ww -z "$page"; fi
done
if command -v pandoc > /dev/null; then (cd "$AMGF_DIR" && ./share/doc/html.sh "$work/html" share/doc/guide.md) &&
  grep -q '<table' "$work/html/share/doc/guide.html" || echo "no HTML"; fi

cd "$work" && ln -s "$AMGF_DIR/bin" "$AMGF_DIR/share" . || exit 1
"$PYTHON" -B "$AMGF_DIR/tests/doc/doc.py" --commands . > commands
while read -r command; do
  echo "$command"
  bash -c "$command" > out 2> err < /dev/null || { echo "  exit $?"; cat err; }
  grep warning err # the first problem has none
done < commands
ls press.xmf press.json
