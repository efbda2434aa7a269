#!/bin/sh
# tests/xvfb.sh tests/fuzz/campaign.sh BUILD SECONDS: libFuzzer on reader and state machine, half of the time each way. `replay` starts from
# kept/ and from recordings made here of programs of ours, `calls` from kept_calls. What breaks is left in BUILD/fuzz/; exits
# with 1 then. Inputs that reach new code are kept in BUILD/fuzz/found_TARGET; `make fuzz-keep` takes the smallest set that
# reaches all of it into tests/fuzz. Says of each target how many edges were reached, those of the sanitizers' checks, which no
# sound program reaches, among the whole.
set -eu
build=$1 seconds=$2
here=$(dirname "$0")
mkdir -p "$build/fuzz/found_replay" "$build/fuzz/found_calls" "$build/fuzz/kept_calls"
"$here/pack_calls.py" unpack "$here/kept_calls" "$build/fuzz/kept_calls"
if [ ! -d "$build/fuzz/seeds" ]; then
	mkdir -p "$build/fuzz/traces"
	for program in "$build"/corpus/* "$build"/tests/real/*; do
		case $program in *.* | */test_*) continue ;; esac
		timeout 5 "$build/relume" record -o "$build/fuzz/traces/${program##*/}.trace" -- "$program" --frames 2 \
			>"$build/fuzz/traces.log" 2>&1 || echo "$program: no recording, or none that is whole"
	done
	mkdir "$build/fuzz/seeds"
	/usr/bin/python3 -B - "$here" "$build/fuzz" <<'SEEDS'
import pathlib
import sys
sys.path.insert(0, sys.argv[1])
from mutate import unpack
for trace in [*pathlib.Path(sys.argv[1], "../golden").glob("*.trace"), *pathlib.Path(sys.argv[2], "traces").glob("*.trace")]:
    pathlib.Path(sys.argv[2], "seeds", trace.stem).write_bytes(unpack(trace.read_bytes(), 1 << 16)[:1 << 16])
SEEDS
fi

# fuzz TARGET LONGEST_INPUT FOLDER...
fuzz() {
	target=$1 longest=$2 failed=0
	shift 2
	"$build/fuzz/$target" -max_total_time=$((seconds / 2)) -timeout=10 -rss_limit_mb=2048 -max_len="$longest" -close_fd_mask=3 \
		-print_final_stats=1 -artifact_prefix="$build/fuzz/$target-" "$build/fuzz/found_$target" "$@" 2>"$build/fuzz/$target.log" ||
		failed=$?
	sed -n '/^==.*ERROR\|runtime error:\|^SUMMARY:\|Test unit written/p' "$build/fuzz/$target.log"
	awk -v target="$target" '/inline 8-bit counters/ { edges = substr($6, 2) }
		/ cov: / { runs = substr($1, 2); for (i = 2; i < NF; i++) if ($i == "cov:") reached = $(i + 1) }
		END { print target ": " runs " runs, " reached " of " edges " edges reached" }' "$build/fuzz/$target.log"
	return "$failed"
}
broken=0
fuzz calls 16384 "$build/fuzz/kept_calls" || broken=1
fuzz replay 65536 "$here/kept" "$build/fuzz/seeds" || broken=1
echo "processor time of this shell and of all it ran:"
times
exit "$broken"
