#!/bin/sh
# limit: 180 s
# References made from a trace with glretrace equal the frames that the program showed, under the same numbers.
set -u
command -v glxgears >/dev/null || { echo "glxgears (mesa-utils) is not installed"; exit 77; }
command -v glretrace >/dev/null || { echo "glretrace (apitrace) is not installed"; exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
fail() { echo "failed: $*"; exit 1; }

tests/xvfb.sh "$RELUME" record -o "$dir/g.trace" --ref color,depth --quit-after 5 -- glxgears >/dev/null 2>&1 ||
	fail "recording"

# Without a display it starts its own.
(unset DISPLAY; exec "$RELUME" raster "$dir/g.trace" -f 0-9 -o "$dir/new/folder/g.####.png") 2>"$dir/log" || {
	cat "$dir/log"; fail "raster"; }
files=$(cd "$dir/new/folder" && find . -mindepth 1 | sort | tr '\n' ' ')
[ "$files" = "./g.0000.png ./g.0001.png ./g.0002.png ./g.0003.png ./g.0004.png " ] || fail "wrong files: $files"
grep -q "the trace has 5 frames" "$dir/log" || fail "no warning about frames that are not there"
"$RELUME" diff "$dir/g.trace" "$dir/new/folder" -f 0-4 || fail "the frames differ"

# Frames shifted by one must not compare equal.
mkdir "$dir/off"
for n in 1 2 3; do cp "$dir/new/folder/g.000$((n + 1)).png" "$dir/off/g.000$n.png"; done
"$RELUME" diff "$dir/g.trace" "$dir/off" -f 1-3 >/dev/null 2>&1
[ $? = 1 ] || fail "swapped frames passed"

# For another recorder's trace the first frame is omitted.
tests/xvfb.sh timeout 3 apitrace trace -o "$dir/other.trace" glxgears >/dev/null 2>&1
"$RELUME" raster "$dir/other.trace" -f 0-1 -o "$dir/other.####.png" 2>"$dir/log" || fail "another recorder's trace"
grep -q "frame 0 is left out" "$dir/log" || fail "no warning about the first frame"
[ ! -e "$dir/other.0000.png" ] || fail "the first frame"
"$RELUME" raster "$dir/other.trace" -f 0 -o "$dir/x.####.png" 2>"$dir/log"
[ $? = 2 ] || fail "the first frame alone"

# Four samples per pixel, in the references too (in later frames a framebuffer object is bound, which glretrace shows
# instead).
if tests/xvfb.sh "$RELUME" record -o "$dir/m.trace" --ref color -- "$RELUME_BUILD/tests/real/multisampled" >/dev/null 2>&1; then
	"$RELUME" raster "$dir/m.trace" -f 0-1 -o "$dir/m/m.####.png" || fail "several samples"
	"$RELUME" diff "$dir/m.trace" "$dir/m" -f 0-1 >"$dir/log" 2>&1 || fail "several samples: the frames differ: $(cat "$dir/log")"
fi
"$RELUME" raster "$dir/g.trace" -f 90 -o "$dir/x.####.png" 2>"$dir/log"
[ $? = 2 ] || fail "a frame that is not there"
PATH=/nowhere "$RELUME" raster "$dir/g.trace" -f 1 -o "$dir/x.####.png" 2>"$dir/log"
[ $? = 5 ] || fail "no glretrace, no Xvfb"
DISPLAY=:1 PATH=/nowhere "$RELUME" raster "$dir/g.trace" -f 1 -o "$dir/x.####.png" 2>"$dir/log"
[ $? = 5 ] || fail "no glretrace"
grep -q "package apitrace" "$dir/log" || fail "does not say what to install: $(cat "$dir/log")"
left=$(find "$dir" -name 'x*' -o -name '.raster*')
[ -z "$left" ] || fail "left behind: $left"
