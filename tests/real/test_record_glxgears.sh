#!/bin/sh
# A GLX program, recorded live: apitrace reads the trace and replays the same pictures.
command -v glxgears >/dev/null || { echo "glxgears (mesa-utils) is not installed"; exit 77; }
exec tests/xvfb.sh tests/real/record_and_replay.sh 24 glxgears
