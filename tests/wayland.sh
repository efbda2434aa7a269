#!/bin/sh
# tests/wayland.sh CMD ARGS...: run a command on a private Wayland compositor.
#
# Starts headless Weston, and stops it when the command is done. Mesa uses its software rasterizer. Exits with the
# command's code, or 5 if no compositor can be started.
usage="tests/wayland.sh CMD ARGS..."
# shellcheck source=tests/server.sh
. "$(dirname "$0")/server.sh"

export WAYLAND_DISPLAY=relume
unset DISPLAY
weston --backend=headless-backend.so --socket="$WAYLAND_DISPLAY" --idle-time=0 --no-config >"$scratch/log" 2>&1 &
server=$!
tries=0
until [ -S "$XDG_RUNTIME_DIR/$WAYLAND_DISPLAY" ]; do
	tries=$((tries + 1))
	if [ $tries -gt 300 ] || ! kill -0 "$server" 2>/dev/null; then
		did_not_start Weston
	fi
	sleep 0.1
done
"$@"
