#!/bin/sh
# Arrays in client memory that change, grow, shrink and move between draws, or stay the same for long and then change: the trace
# replays to the program's pictures.
tests/xvfb.sh tests/real/record_and_replay.sh 19 "$RELUME_BUILD/tests/trace/mirrors" &&
	exec tests/xvfb.sh tests/real/record_and_replay.sh 107 "$RELUME_BUILD/tests/trace/watched"
