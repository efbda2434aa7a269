#!/bin/sh
# tests/xvfb.sh CMD ARGS...: run a command on a private display.
#
# Starts an Xvfb on a free display with Mesa's software rasterizer, gives the command a scratch home, and stops the
# server when the command is done. Exits with the command's code, or 5 if no display can be started.
usage="tests/xvfb.sh CMD ARGS..."
# shellcheck source=tests/server.sh
. "$(dirname "$0")/server.sh"

# -displayfd finds a free number. Without -noreset the server resets when its last client leaves, and refuses a client
# that connects at that moment.
mkfifo "$scratch/display" || exit 5
Xvfb -displayfd 3 -screen 0 1024x768x24 +extension GLX -nolisten tcp -noreset -ac \
	3>"$scratch/display" >"$scratch/log" 2>&1 &
server=$!
read -r number <"$scratch/display" || did_not_start Xvfb

export DISPLAY=":$number" vblank_mode=0 SDL_AUDIODRIVER=dummy ALSOFT_DRIVERS=null
# Debian's games and screen savers are not in a plain PATH.
export PATH="$PATH:/usr/games:/usr/libexec/xscreensaver"
unset WAYLAND_DISPLAY XAUTHORITY
"$@"
