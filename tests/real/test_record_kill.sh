#!/bin/sh
# Twenty programs killed at random moments lose no completed frame: the short form of `make show-kill`.
# limit: 300 s
command -v glxgears >/dev/null || { echo "glxgears (mesa-utils) is not installed"; exit 77; }
exec /usr/bin/python3 tests/show/kill.py "$RELUME_BUILD" 20 "$(date +%s)"
