#!/bin/sh
# Usage: report-tests.sh COUNTS LABEL...
# Adds up what PETSc's harness left in COUNTS for every test; one that left nothing did not build or died: it failed.
# Prints how long that took, since COUNTS/../began was written, then the tests that failed, then the sum.
counts=$1
shift
count() { awk -v key="$1" '$1 == key {n += $2} END {print n + 0}' "$file"; }
passed=0 failed=0 skipped=0 failures=
for label; do
  file=$counts/$label.counts
  if [ ! -f "$file" ]; then
    failed=$((failed + 1))
    failures="$failures $label(no result)"
    continue
  fi
  skipped=$((skipped + $(count skip) + $(count todo)))
  passed=$((passed + $(count success)))
  failed=$((failed + $(count failed)))
  failures="$failures$(awk '$1 == "failures" {for (i = 2; i <= NF; i++) printf " %s", $i}' "$file")"
done
seconds() { awk '$1 == "time" {name = FILENAME; gsub(/.*\/(shell-|tests-)?|\.counts/, "", name); print $3, name}' \
  "$counts"/*.counts; }
took=$(($(date +%s) - $(cat "$counts/../began")))
seconds | awk -v took=$took '{s += $1}
  END {printf "# took %.1f minutes; processor time of the tests %.1f minutes, of the longest:", took / 60, s / 60}'
seconds | sort -rn | awk 'NR <= 10 && $1 > 1 {printf " %s %.0f s,", $2, $1}' | sed 's/,$//'
echo
[ $skipped -eq 0 ] || echo "# skipped: $skipped"
[ ! -f "$counts/../stacks.txt" ] || sed '1i # stacks of runs that reached their time limit:' "$counts/../stacks.txt"
[ -z "$failures" ] || echo "# failed:$failures"
echo "$passed passed, $failed failed" | tee "$counts/../summary"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
