#!/bin/sh
# Draws sentences at random for a reader who does not know the code: 20 from pages, 20 comments, 20 messages. Whoever
# reads them says what each one means; what is misunderstood is rewritten, and its neighbours with it.
# usage: share/prose/sample.sh [SEED]     from the top folder; the same seed draws the same sentences
case $1 in -*) sed -n '2,4s/^# //p' "$0" && exit ;; esac
python=/usr/bin/python3
[ -x $python ] || python=python3
exec $python -B "$(dirname "$0")/sample.py" "${1:-$(date +%s)}"
