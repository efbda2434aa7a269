#!/bin/sh
# tests/xvfb.sh CMD ARGS...: run a command on a display of its own.
#
# Starts an Xvfb on a free display with Mesa's software rasterizer, gives the command a scratch home, and ends the
# server when the command is done. Exits with the command's code; 5 where there is no display to be had.
usage="tests/xvfb.sh CMD ARGS..."
# shellcheck source=tests/server.sh
. "$(dirname "$0")/server.sh"

# -displayfd finds a free number; without -noreset the server resets when its last client leaves, and a client that
# comes at that moment is refused.
mkfifo "$scratch/display" || exit 5
Xvfb -displayfd 3 -screen 0 1024x768x24 +extension GLX -nolisten tcp -noreset -ac \
	3>"$scratch/display" >"$scratch/log" 2>&1 &
server=$!
read -r number <"$scratch/display" || did_not_start Xvfb

export DISPLAY=":$number" vblank_mode=0 SDL_AUDIODRIVER=dummy ALSOFT_DRIVERS=null
# Debian keeps games and screen savers out of a plain PATH.
export PATH="$PATH:/usr/games:/usr/libexec/xscreensaver"
unset WAYLAND_DISPLAY XAUTHORITY
"$@"
