#!/bin/sh
# An EGL program (all of Debian's screen savers use EGL), recorded live: apitrace reads the trace and replays the same
# pictures.
hack=/usr/libexec/xscreensaver/superquadrics
[ -x "$hack" ] || { echo "superquadrics (xscreensaver-gl) is not installed"; exit 77; }
exec tests/xvfb.sh tests/real/record_and_replay.sh 12 "$hack" -geometry 320x240
