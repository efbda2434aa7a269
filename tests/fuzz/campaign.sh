#!/bin/sh
# tests/fuzz/campaign.sh BUILD SECONDS: libFuzzer on reader and state machine, starting from the kept inputs and from the
# streams of the golden recordings. What breaks is left in BUILD/fuzz/; exits with 1 then. Inputs that reach new code are kept
# in BUILD/fuzz/found; `make fuzz-keep` takes the smallest set that reaches all of it into tests/fuzz/kept.
set -eu
build=$1 seconds=$2
here=$(dirname "$0")
mkdir -p "$build/fuzz/found" "$build/fuzz/seeds"
/usr/bin/python3 -B - "$here" "$build/fuzz/seeds" <<'SEEDS'
import pathlib
import sys
sys.path.insert(0, sys.argv[1])
from mutate import unpack
for trace in pathlib.Path(sys.argv[1], "../golden").glob("*.trace"):
    pathlib.Path(sys.argv[2], trace.stem).write_bytes(unpack(trace.read_bytes(), 1 << 16)[:1 << 16])
SEEDS
exec "$build/fuzz/replay" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 -close_fd_mask=3 \
	-print_final_stats=1 -artifact_prefix="$build/fuzz/" "$build/fuzz/found" "$here/kept" "$build/fuzz/seeds"
