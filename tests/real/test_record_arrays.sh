#!/bin/sh
# Arrays in client memory that change, grow, shrink and move between draws: the trace replays to the program's pictures.
exec tests/xvfb.sh tests/real/record_and_replay.sh 19 "$RELUME_BUILD/tests/trace/mirrors"
