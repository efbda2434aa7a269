#!/bin/sh
# Pixels that are uploaded repeatedly: the trace replays to the program's pictures, and stores each content at most
# twice.
tests/xvfb.sh tests/real/record_and_replay.sh 39 "$RELUME_BUILD/tests/trace/uploads" || exit 1
bytes=$(stat -c %s "$TMPDIR/recorded.trace")
# Three pictures of 16 KiB and 24 parts of 5 KB, each at most twice; it would be 860 KB if each call stored its own.
if [ "$bytes" -gt 330000 ]; then
	echo "the trace has $bytes bytes"
	exit 1
fi
