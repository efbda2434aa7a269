#!/bin/sh
# tests/xvfb.sh CMD ARGS...: run a command on a display of its own.
#
# Starts an Xvfb on a free display with Mesa's software rasterizer, gives the command a scratch home, and ends the
# server when the command is done. Exits with the command's code; 5 where there is no display to be had.
set -u

if [ $# -eq 0 ]; then
	echo "usage: tests/xvfb.sh CMD ARGS..." >&2
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

# -displayfd finds a free number; without -noreset the server resets when its last client leaves, and a client that
# comes at that moment is refused.
mkdir -m 700 "$scratch/home" "$scratch/runtime" && mkfifo "$scratch/display" || exit 5
Xvfb -displayfd 3 -screen 0 1024x768x24 +extension GLX -nolisten tcp -noreset -ac \
	3>"$scratch/display" >"$scratch/log" 2>&1 &
server=$!
if ! read -r number <"$scratch/display"; then
	echo "tests/xvfb.sh: Xvfb did not start:" >&2
	cat "$scratch/log" >&2
	exit 5
fi

export DISPLAY=":$number" HOME="$scratch/home" XDG_RUNTIME_DIR="$scratch/runtime"
export LIBGL_ALWAYS_SOFTWARE=1 vblank_mode=0 SDL_AUDIODRIVER=dummy ALSOFT_DRIVERS=null
# Debian keeps games and screen savers out of a plain PATH.
export PATH="$PATH:/usr/games:/usr/libexec/xscreensaver"
unset XDG_CACHE_HOME XDG_CONFIG_HOME XDG_DATA_HOME WAYLAND_DISPLAY XAUTHORITY
"$@"
