#!/bin/sh
# tests/fuzz/campaign.sh BUILD SECONDS: libFuzzer on reader and state machine, half of the time each way. `replay` starts from
# kept/ and from the streams of the golden recordings, `calls` from kept_calls. What breaks is left in BUILD/fuzz/; exits with
# 1 then. Inputs that reach new code are kept in BUILD/fuzz/found_TARGET; `make fuzz-keep` takes the smallest set that reaches
# all of it into tests/fuzz.
set -eu
build=$1 seconds=$2
here=$(dirname "$0")
mkdir -p "$build/fuzz/found_replay" "$build/fuzz/found_calls" "$build/fuzz/seeds" "$build/fuzz/kept_calls"
"$here/pack_calls.py" unpack "$here/kept_calls" "$build/fuzz/kept_calls"
/usr/bin/python3 -B - "$here" "$build/fuzz/seeds" <<'SEEDS'
import pathlib
import sys
sys.path.insert(0, sys.argv[1])
from mutate import unpack
for trace in pathlib.Path(sys.argv[1], "../golden").glob("*.trace"):
    pathlib.Path(sys.argv[2], trace.stem).write_bytes(unpack(trace.read_bytes(), 1 << 16)[:1 << 16])
SEEDS

# fuzz TARGET LONGEST_INPUT FOLDER...
fuzz() {
	target=$1 longest=$2
	shift 2
	"$build/fuzz/$target" -max_total_time=$((seconds / 2)) -timeout=10 -rss_limit_mb=2048 -max_len="$longest" -close_fd_mask=3 \
		-print_final_stats=1 -artifact_prefix="$build/fuzz/$target-" "$build/fuzz/found_$target" "$@"
}
fuzz calls 16384 "$build/fuzz/kept_calls"
fuzz replay 65536 "$here/kept" "$build/fuzz/seeds"
