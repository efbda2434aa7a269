#!/bin/sh
# Repeated quads and line loops become display lists in the trace; replayed, they give exactly the program's pictures.
set -eu
tests/xvfb.sh tests/real/record_and_replay.sh 6 "$RELUME_BUILD/tests/trace/loops"
apitrace dump --color=never "$TMPDIR/recorded.trace" >"$TMPDIR/dump"
[ "$(grep -c 'glCallList(.* // fake' "$TMPDIR/dump")" -eq 12 ] || { echo "the runs are no lists"; exit 1; }
tests/xvfb.sh tests/real/record_and_replay.sh 6 "$RELUME_BUILD/tests/trace/loops" back
hack=/usr/libexec/xscreensaver/flipscreen3d
[ -x "$hack" ] || exit 0
exec tests/xvfb.sh tests/real/record_and_replay.sh 16 "$hack" -geometry 320x240
