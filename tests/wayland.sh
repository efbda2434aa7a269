#!/bin/sh
# tests/wayland.sh CMD ARGS...: run a command on a Wayland compositor of its own.
#
# Starts Weston without a screen, and ends it when the command is done. Mesa draws with its software rasterizer. Exits with the command's
# code; 5 where there is no compositor to be had.
set -u

if [ $# -eq 0 ]; then
	echo "usage: tests/wayland.sh CMD ARGS..." >&2
	exit 2
fi

scratch=$(mktemp -d) || exit 5
server=
# shellcheck disable=SC2317 # reached by the trap
clean_up() {
	[ -n "$server" ] && kill "$server" 2>/dev/null && wait "$server" 2>/dev/null
	rm -rf "$scratch"
}
trap clean_up EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

mkdir -m 700 "$scratch/home" "$scratch/runtime" || exit 5
export HOME="$scratch/home" XDG_RUNTIME_DIR="$scratch/runtime" WAYLAND_DISPLAY=relume LIBGL_ALWAYS_SOFTWARE=1
unset XDG_CACHE_HOME XDG_CONFIG_HOME XDG_DATA_HOME DISPLAY
weston --backend=headless-backend.so --socket="$WAYLAND_DISPLAY" --idle-time=0 --no-config >"$scratch/log" 2>&1 &
server=$!
tries=0
until [ -S "$XDG_RUNTIME_DIR/$WAYLAND_DISPLAY" ]; do
	tries=$((tries + 1))
	if [ $tries -gt 300 ] || ! kill -0 "$server" 2>/dev/null; then
		echo "tests/wayland.sh: Weston did not start:" >&2
		cat "$scratch/log" >&2
		exit 5
	fi
	sleep 0.1
done
"$@"
