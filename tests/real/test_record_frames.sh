#!/bin/sh
# Recordings that start in the middle of a program: their pictures, replayed by apitrace and by us, equal those of the
# whole recording, although they depend on earlier objects, state and pixels.
if [ -z "${DISPLAY_IS_OURS:-}" ]; then
	DISPLAY_IS_OURS=1 exec tests/xvfb.sh "$0"
fi
set -u
fail() {
	echo "$*"
	exit 1
}
record() {
	name=$1
	shift
	"$RELUME" record -o "$TMPDIR/$name.trace" --ref color "$@" >"$TMPDIR/log" 2>&1 || fail "$name: $(cat "$TMPDIR/log")"
}
frames_of() {
	apitrace dump --color=never "$1" 2>/dev/null | grep -cE '^[0-9]+ (@[0-9]+ )?(glXSwapBuffers|eglSwapBuffers)\('
}
program=$RELUME_BUILD/tests/trace/frames
for range in 2-9 5-8:clear 7-; do
	how=${range#*:} range=${range%:*}
	[ "$how" = clear ] || how=
	# shellcheck disable=SC2086 # no argument where there is none
	record whole -- "$program" $how
	# shellcheck disable=SC2086
	record part --frames "$range" -- "$program" $how
	first=${range%-*} last=${range#*-}
	n=$((${last:-9} - first + 1))
	[ "$(frames_of "$TMPDIR/part.trace")" -eq $n ] || fail "--frames $range: not $n frames"
	/usr/bin/python3 - "$TMPDIR" "$first" $n <<'PYTHON' || exit 1
import sys
sys.path.insert(0, "tests/real")
from replayed import reference_frames, replayed_frames
folder, first, n = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
whole, part = reference_frames(folder + "/whole.ref"), reference_frames(folder + "/part.ref")
if sorted(part) != list(range(n)) or any(part[i] != whole[first + i] for i in part):
    sys.exit("the program showed something else, or other frames were kept")
if len({whole[i][2] for i in whole}) != len(whole):
    sys.exit("frames look alike: the test shows nothing")
replayed = replayed_frames(folder + "/part.trace")
bad = [i for i in range(n) if replayed[i] != part[i]]
print(f"from frame {first}: {n} frames replayed by apitrace, {len(bad)} differ: {bad}")
sys.exit(1 if bad else 0)
PYTHON
done

# No frame recorded: the message says what ends frames, or that none was requested.
"$RELUME" record -o "$TMPDIR/none.trace" -- "$RELUME_BUILD/tests/trace/readback" >"$TMPDIR/log" 2>&1
grep -q "0 frames" "$TMPDIR/log" && grep -q "record it with --frame-end flush, which ends [1-9]" "$TMPDIR/log" || fail "single-buffered: $(cat "$TMPDIR/log")"
"$RELUME" record -o "$TMPDIR/none.trace" --frames 100- -- "$program" >"$TMPDIR/log" 2>&1
grep -q "the program ended after 10 frames, before the first" "$TMPDIR/log" || fail "beyond the end: $(cat "$TMPDIR/log")"

# Switched on by a signal, off and on again (in a program with 25 frames per second): the interval is missing, the later
# part is complete.
"$RELUME" record -o "$TMPDIR/switched.trace" --ref color --paused --quit-after 40 -- superquadrics -geometry 320x240 >/dev/null 2>"$TMPDIR/log" &
recorder=$!
# until CONDITION: wait for at most 30 s
until_so() {
	for _ in $(seq 300); do
		eval "$1" && return
		sleep 0.1
	done
	fail "never: $1"
}
frames_so_far() { # in the file
	frames_of "$TMPDIR/switched.trace"
}
until_so '[ -s "$TMPDIR/switched.trace" ]'
[ "$(frames_so_far)" -eq 0 ] || fail "frames while recording is paused"
kill -USR2 $recorder
until_so '[ "$(frames_so_far)" -ge 5 ]'
kill -USR2 $recorder
sleep 0.5
paused=$(frames_so_far)
sleep 0.5
[ "$(frames_so_far)" -eq "$paused" ] || fail "frames while recording is switched off"
[ "$paused" -lt 40 ] || fail "not switched off in time"
kill -USR2 $recorder
wait $recorder || fail "switched: exit code $?: $(cat "$TMPDIR/log")"
[ "$(frames_so_far)" -eq 40 ] || fail "switched: $(cat "$TMPDIR/log")"
/usr/bin/python3 tests/real/replayed.py "$TMPDIR/switched" || fail "switched: other pictures"
"$RELUME" render "$TMPDIR/switched.trace" --mode gl -f 0,39 -o "$TMPDIR/rendered/x.####.exr" >"$TMPDIR/log" 2>&1 || fail "$(cat "$TMPDIR/log")"
"$RELUME" diff "$TMPDIR/switched.trace" "$TMPDIR/rendered" -f 0,39 >"$TMPDIR/log" 2>&1 || fail "switched: $(cat "$TMPDIR/log")"

# The same by a key, which the program receives as well. xdotool presses it.
command -v xdotool >/dev/null || { echo "xdotool is not installed: the key was not tried"; exit 0; }
"$RELUME" record -o "$TMPDIR/key.trace" --start-key F9 --quit-after 5 -- glxgears >/dev/null 2>"$TMPDIR/log" &
recorder=$!
until_so '[ -s "$TMPDIR/key.trace" ]'
sleep 0.5
[ "$(frames_of "$TMPDIR/key.trace")" -eq 0 ] || fail "frames before the key"
until_so 'xdotool keydown F9 sleep 0.2 keyup F9 && sleep 1 && [ "$(frames_of "$TMPDIR/key.trace")" -gt 0 ]'
wait $recorder || fail "key: exit code $?: $(cat "$TMPDIR/log")"
[ "$(frames_of "$TMPDIR/key.trace")" -eq 5 ] || fail "key: $(cat "$TMPDIR/log")"
