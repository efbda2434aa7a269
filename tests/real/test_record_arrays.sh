#!/bin/sh
# Client arrays that change, grow, shrink and move between draws, or stay the same for long and then change: the trace
# must replay to the program's pictures. Copies kept of arrays are released with the context that drew from them.
tests/xvfb.sh tests/real/record_and_replay.sh 19 "$RELUME_BUILD/tests/trace/mirrors" &&
	tests/xvfb.sh tests/real/record_and_replay.sh 107 "$RELUME_BUILD/tests/trace/watched" &&
	tests/xvfb.sh tests/real/record_and_replay.sh 107 "$RELUME_BUILD/tests/trace/watched" on an older kernel &&
	exec tests/xvfb.sh tests/real/record_and_replay.sh 16 "$RELUME_BUILD/tests/trace/contexts"
