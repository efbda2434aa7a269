#!/bin/sh
# Wrong usage of relume record: one clear line and the right exit code.
set -u
bad=0
# expect CODE TEXT ARGUMENTS...: exit code, and a line that contains the text.
expect() {
	code=$1 text=$2
	shift 2
	"$RELUME" record "$@" >"$TMPDIR/out" 2>&1
	got=$?
	if [ $got -ne "$code" ] || ! grep -q -e "$text" "$TMPDIR/out"; then
		echo "relume record $*: exit code $got, expected $code and '$text':"
		cat "$TMPDIR/out"
		bad=1
	fi
}
expect 0 "usage: relume record" --help
expect 2 "no program to record"
expect 2 "no program to record" -o x.trace --
expect 2 "no option .--frobnicate" --frobnicate -- true
expect 2 "--ref takes" --ref colour -- true
expect 2 "takes a number of frames" --quit-after 0 -- true
expect 2 "takes a number of frames" --max-frames 1x -- true
expect 2 "takes a number of frames" --ref-every -3 -- true
expect 2 "NAME=VALUE" --env =x -- true
expect 2 "--frames takes" --frames 10x -- true
expect 2 "--frames takes" --frames 9-3 -- true
expect 2 "--frames takes" --frames -3 -- true
expect 5 "no X display" --start-key F9 --env DISPLAY= -- true
expect 2 "has no key"  --start-key F99x -- true
expect 2 "--frame-end takes" --frame-end sometimes -- true
expect 2 "number of bytes" --max-size 5X -- true
expect 2 "number of bytes" --max-size 0 -- true
expect 2 "number of bytes" --max-size 99999999999999999999G -- true
expect 2 "'' is not a name for a trace" -o "" -- true
expect 2 "is not a name for a trace" -o "$TMPDIR/" -- true
expect 5 "No such file" -o /proc/no/such/folder.trace -- true
expect 5 "loaded no OpenGL" -o "$TMPDIR/made/for/it.trace" -- true
[ -d "$TMPDIR/made/for" ] || { echo "the trace's folder was not made"; bad=1; }
expect 5 "is not a file" -o "$TMPDIR" -- true
expect 5 "cannot start" -o "$TMPDIR/x.trace" -- "$TMPDIR/no-such-program"
expect 5 "true: nothing was recorded: the program loaded no OpenGL" -o "$TMPDIR/x.trace" -- true
expect 7 "nothing was recorded: the program loaded no OpenGL" -o "$TMPDIR/x.trace" -- sh -c 'exit 7'
expect 143 "nothing was recorded: the program loaded no OpenGL" -o "$TMPDIR/x.trace" -- sh -c 'kill -TERM $$'
expect 3 "nothing was recorded: the program loaded no OpenGL" -o "$TMPDIR/x.trace" --env WORD=three -- sh -c '[ "$WORD" = three ] && exit 3'
# A signal that arrives after the program has ended is sent neither to the recorder nor to others of its process group.
trap 'echo "a signal for the recorder reached others"; bad=1' USR1
LD_PRELOAD="$RELUME_BUILD/tests/real/signal_shim.so" timeout --foreground 20 "$RELUME" record -o "$TMPDIR/x.trace" -- sh -c 'exit 7' >"$TMPDIR/out" 2>&1
got=$?
if [ $got -ne 7 ]; then
	echo "a signal as the program has ended: exit code $got, expected 7"
	bad=1
fi
trap - USR1
# A set-group-ID program: the loader preloads nothing if it runs with that group.
group=$(id -G | tr ' ' '\n' | grep -vx "$(id -g)" | head -n 1)
[ "$(id -u)" = 0 ] && group=60
cp "$(command -v env)" "$TMPDIR/owned"
if [ -n "$group" ] && chgrp "$group" "$TMPDIR/owned" && chmod g+s "$TMPDIR/owned"; then
	expect 5 "without the rights of its file" -o "$TMPDIR/x.trace" -- "$TMPDIR/owned"
	expect 5 "LD_PRELOAD=.*librelume" -o "$TMPDIR/x.trace" -- "$TMPDIR/owned"
	(PATH="$TMPDIR:$PATH" && expect 5 "without the rights of its file" -o "$TMPDIR/x.trace" -- owned && exit $bad) || bad=1
fi
if [ -e "$TMPDIR/x.trace" ]; then
	echo "a program without OpenGL left a trace"
	bad=1
fi
exit $bad
