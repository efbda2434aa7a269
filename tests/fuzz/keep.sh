#!/bin/sh
# tests/fuzz/keep.sh BUILD: the small inputs that campaigns found, as few as reach what all of them reach, into tests/fuzz.
set -eu
build=$1
here=$(dirname "$0")
# small TARGET LARGEST: those found that are smaller, in BUILD/fuzz/small
small() {
	rm -rf "$build/fuzz/small"
	mkdir -p "$build/fuzz/small"
	find "$build/fuzz/found_$1" -type f -size "-$2" -exec cp -t "$build/fuzz/small" {} +
}
small replay 3k
"$build/fuzz/replay" -merge=1 -close_fd_mask=3 "$here/kept" "$build/fuzz/small"

small calls 2k
mkdir -p "$build/fuzz/kept_calls"
"$here/pack_calls.py" unpack "$here/kept_calls" "$build/fuzz/small"
# edges alone: how often each is passed would be thousands of sequences
"$build/fuzz/calls" -set_cover_merge=1 -use_counters=0 -close_fd_mask=3 "$build/fuzz/kept_calls" "$build/fuzz/small"
"$here/pack_calls.py" pack "$here/kept_calls" "$build/fuzz/kept_calls"
