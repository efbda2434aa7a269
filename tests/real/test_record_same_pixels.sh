#!/bin/sh
# The program is unaffected: glxgears draws the same frames, bit by bit, with and without the recorder and its reference
# frames.
command -v glxgears >/dev/null || { echo "glxgears (mesa-utils) is not installed"; exit 77; }
if [ -z "${DISPLAY_IS_OURS:-}" ]; then
	DISPLAY_IS_OURS=1 exec tests/xvfb.sh "$0"
fi
set -eu
shim=$RELUME_BUILD/tests/real/checksum_shim.so
export SHIM_FRAMES=50

LD_PRELOAD=$shim glxgears 2>/dev/null | grep ^frame >"$TMPDIR/bare"
"$RELUME" record -o "$TMPDIR/a.trace" --env "LD_PRELOAD=$shim" -- glxgears 2>/dev/null | grep ^frame >"$TMPDIR/recorded"
"$RELUME" record -o "$TMPDIR/b.trace" --env "LD_PRELOAD=$shim" --ref color,depth -- glxgears 2>/dev/null | grep ^frame >"$TMPDIR/read"
if [ "$(wc -l <"$TMPDIR/bare")" -ne $SHIM_FRAMES ] || [ "$(sort -u -k4 "$TMPDIR/bare" | wc -l)" -lt 40 ]; then
	cat "$TMPDIR/bare"
	echo "the program drew no $SHIM_FRAMES different frames"
	exit 1
fi
cmp "$TMPDIR/bare" "$TMPDIR/recorded"
cmp "$TMPDIR/bare" "$TMPDIR/read"
