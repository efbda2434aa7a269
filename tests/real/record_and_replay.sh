#!/bin/sh
# record_and_replay.sh FRAMES PROGRAM ARGUMENTS...: record a program live, read its trace to the end with apitrace,
# replay it, and compare the pictures with the program's own. Run under tests/xvfb.sh.
set -eu
frames=$1
shift
here=$(dirname "$0")
name=$TMPDIR/recorded

"$RELUME" record -o "$name.trace" --ref color --quit-after "$frames" -- "$@" >"$name.log" 2>&1 || {
	cat "$name.log"
	echo "recording failed"
	exit 1
}
grep "^relume: .*: $frames frames, .* 0 calls not recorded$" "$name.log" || {
	cat "$name.log"
	echo "the summary line is not as it should be"
	exit 1
}

apitrace dump --color=never "$name.trace" >"$name.txt" 2>"$name.err" || {
	cat "$name.err"
	echo "apitrace cannot read the trace"
	exit 1
}
swaps=$(grep -cE '^[0-9]+ (glXSwapBuffers|eglSwapBuffers)\(' "$name.txt")
if [ "$swaps" -ne "$frames" ] || [ -s "$name.err" ]; then
	cat "$name.err"
	echo "apitrace reads $swaps frames of $frames"
	exit 1
fi
if grep -q '// incomplete' "$name.txt"; then
	echo "a call has no end"
	exit 1
fi
sizes=$(grep -c 'relume:drawable ' "$name.txt")
times=$(grep -c 'relume:time ' "$name.txt")
if [ "$sizes" -lt 1 ] || [ "$times" -ne "$frames" ]; then
	echo "$sizes size and $times time markers for $frames frames"
	exit 1
fi
/usr/bin/python3 "$here/replayed.py" "$name"
