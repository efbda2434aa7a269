#!/bin/sh
# No data is lost: recordings that were killed, ran out of space or could not be written. The program must not notice.
# limit: 180 s
command -v glxgears >/dev/null || { echo "glxgears (mesa-utils) is not installed"; exit 77; }
if [ -z "${DISPLAY_IS_OURS:-}" ]; then
	DISPLAY_IS_OURS=1 exec tests/xvfb.sh "$0"
fi
set -u
fail() {
	echo "$*"
	exit 1
}
# Number of frames that apitrace reads from a trace.
frames_of() {
	apitrace dump --color=never "$1" 2>/dev/null | grep -cE '^[0-9]+ (glXSwapBuffers|eglSwapBuffers)\('
}
said() {
	sed -n 's/^relume: .*: \([0-9]*\) frames, .*/\1/p' "$1"
}

# Wait until a trace has contents.
until_drawn() {
	for _ in $(seq 300); do
		[ "$(stat -c %s "$1" 2>/dev/null || echo 0)" -gt 20000 ] && return
		sleep 0.1
	done
	fail "$1: nothing drawn in 30 s"
}

# Killed at some moment: the file contains every completed frame.
for delay in 0 0.01 0.05 0.1 0.3; do
	rm -f "$TMPDIR/kill.trace" "$TMPDIR/pid"
	"$RELUME" record -o "$TMPDIR/kill.trace" -- sh -c 'echo $$ >"$TMPDIR/pid"; exec glxgears' >/dev/null 2>"$TMPDIR/log" &
	recorder=$!
	until_drawn "$TMPDIR/kill.trace"
	until [ -s "$TMPDIR/pid" ]; do sleep 0.1; done
	sleep "$delay"
	kill -KILL "$(cat "$TMPDIR/pid")"
	wait $recorder
	[ $? -eq 137 ] || fail "exit code of a killed program is not passed on"
	complete=$(said "$TMPDIR/log")
	got=$(frames_of "$TMPDIR/kill.trace")
	[ "${complete:-0}" -gt 0 ] || fail "killed after $delay s: no frame complete"
	[ "$got" -ge "$complete" ] || fail "killed after $delay s: $complete frames complete, $got in the trace"
done

# The command killed together with the program: the trace is equally complete.
"$RELUME" record -o "$TMPDIR/both.trace" -- sh -c 'echo $$ >"$TMPDIR/pid"; exec glxgears' >/dev/null 2>&1 &
recorder=$!
until_drawn "$TMPDIR/both.trace"
kill -KILL $recorder "$(cat "$TMPDIR/pid")"
wait $recorder 2>/dev/null
[ "$(frames_of "$TMPDIR/both.trace")" -gt 0 ] || fail "command and program killed: no frame in the trace"

# A limit on file size (RLIMIT_FSIZE, which raises SIGXFSZ): the recording stops and reports it once; the program
# continues.
(
	ulimit -f 160 # of 512 bytes: the command's own 72 kB of figures must fit
	SHIM_FRAMES=1200 "$RELUME" record --env "LD_PRELOAD=$RELUME_BUILD/tests/real/checksum_shim.so" -o "$TMPDIR/limit.trace" \
		-- glxgears 2>"$TMPDIR/log"
	echo $? >"$TMPDIR/code"
) | grep -c ^frame >"$TMPDIR/frames"
code=$(cat "$TMPDIR/code")
[ "$(cat "$TMPDIR/frames")" -eq 1200 ] || fail "the program ended with its recording (file size limit)"
[ $code -eq 5 ] || fail "exit code $code where the recording ended early"
[ "$(grep -c 'limit reached: recording stopped' "$TMPDIR/log")" -eq 1 ] || fail "the end of the recording was not said once"
got=$(frames_of "$TMPDIR/limit.trace")
[ "$got" -ge "$(said "$TMPDIR/log")" ] && [ "$got" -gt 0 ] || fail "file size limit: $got frames in the trace"

# A full disk.
mkdir "$TMPDIR/small"
if mount -t tmpfs -o size=80k none "$TMPDIR/small" 2>/dev/null; then
	SHIM_FRAMES=1200 "$RELUME" record --env "LD_PRELOAD=$RELUME_BUILD/tests/real/checksum_shim.so" -o "$TMPDIR/small/full.trace" \
		--ref color -- glxgears >"$TMPDIR/frames" 2>"$TMPDIR/log"
	got=$(frames_of "$TMPDIR/small/full.trace")
	complete=$(said "$TMPDIR/log")
	umount "$TMPDIR/small"
	[ "$(grep -c ^frame "$TMPDIR/frames")" -eq 1200 ] || fail "the program ended with its recording (full disk)"
	[ "$got" -ge "$complete" ] && [ "$got" -gt 0 ] || fail "full disk: $complete frames complete, $got in the trace"
else
	echo "no tmpfs to be mounted here: the full disk was not tried"
fi

# Nowhere to write: known before the program starts.
"$RELUME" record -o /proc/nowhere/x.trace -- touch "$TMPDIR/started" 2>"$TMPDIR/log"
[ $? -eq 5 ] || fail "exit code for an unwritable output"
[ "$(wc -l <"$TMPDIR/log")" -eq 1 ] || fail "more or less than one line for an unwritable output"
[ ! -e "$TMPDIR/started" ] || fail "the program was started all the same"

# A program that closes all descriptors that it does not know.
"$RELUME" record -o "$TMPDIR/closed.trace" --quit-after 20 -- "$RELUME_BUILD/tests/real/closer" >"$TMPDIR/log" 2>&1 ||
	fail "closer: exit code $?"
[ "$(frames_of "$TMPDIR/closed.trace")" -eq 20 ] || fail "a program that closes descriptors: $(cat "$TMPDIR/log")"
[ "$(wc -c <"$TMPDIR/victim")" -eq 6 ] || fail "the recorder wrote into the program's file"

# A program whose child draws as well: one trace each.
"$RELUME" record -o "$TMPDIR/two.trace" -- sh -c 'timeout 3 glxgears; timeout 3 glxgears; exit 3' >/dev/null 2>"$TMPDIR/log"
[ $? -eq 3 ] || fail "the program's exit code is not passed on"
[ "$(frames_of "$TMPDIR/two.trace")" -gt 0 ] && [ "$(frames_of "$TMPDIR/two.1.trace")" -gt 0 ] ||
	fail "two processes: $(cat "$TMPDIR/log")"

# --no-children: a program started by exec is recorded, child processes are not.
"$RELUME" record -o "$TMPDIR/one.trace" --no-children --quit-after 5 -- sh -c 'timeout 1 glxgears; exec glxgears' \
	>/dev/null 2>"$TMPDIR/log" || fail "no children: exit code $?"
[ "$(frames_of "$TMPDIR/one.trace")" -eq 5 ] && [ ! -e "$TMPDIR/one.1.trace" ] || fail "no children: $(cat "$TMPDIR/log")"

# A maximum size: the frame that reaches it is the last one recorded; the program continues.
SHIM_FRAMES=1200 "$RELUME" record --env "LD_PRELOAD=$RELUME_BUILD/tests/real/checksum_shim.so" -o "$TMPDIR/size.trace" \
	--max-size 20K -- glxgears >"$TMPDIR/frames" 2>"$TMPDIR/log" || fail "largest size: exit code $?"
[ "$(grep -c ^frame "$TMPDIR/frames")" -eq 1200 ] || fail "the program ended with its recording (largest size)"
size=$(stat -c %s "$TMPDIR/size.trace")
[ "$size" -ge 20480 ] && [ "$size" -lt 30000 ] || fail "largest size 20K: $size bytes"
[ "$(frames_of "$TMPDIR/size.trace")" -eq "$(said "$TMPDIR/log")" ] || fail "largest size: $(cat "$TMPDIR/log")"

# A program that exits by _exit or abort: its drawing is complete, and its exit code is passed on.
leaver=$RELUME_BUILD/tests/trace/leaver
"$RELUME" record -o "$TMPDIR/exit.trace" -- "$leaver" _exit 2>"$TMPDIR/log"
[ $? -eq 9 ] || fail "_exit: exit code is not passed on"
[ "$(frames_of "$TMPDIR/exit.trace")" -eq 20 ] && [ "$(said "$TMPDIR/log")" -eq 20 ] || fail "_exit: $(cat "$TMPDIR/log")"
"$RELUME" record -o "$TMPDIR/abort.trace" -- "$leaver" abort 2>"$TMPDIR/log"
[ $? -eq 134 ] || fail "abort: exit code is not passed on"
[ "$(frames_of "$TMPDIR/abort.trace")" -eq 20 ] && [ "$(said "$TMPDIR/log")" -eq 20 ] || fail "abort: $(cat "$TMPDIR/log")"

# After a fork, child and parent draw at the same time, into a trace each; a copy that exits without drawing removes
# nothing.
"$RELUME" record -o "$TMPDIR/fork.trace" -- "$leaver" fork 2>"$TMPDIR/log" || fail "fork: exit code $?: $(cat "$TMPDIR/log")"
both=$(for trace in "$TMPDIR/fork.trace" "$TMPDIR/fork.1.trace"; do frames_of "$trace"; done | sort -n | tr '\n' ' ')
[ "$both" = "7 40 " ] || fail "fork: $both frames: $(cat "$TMPDIR/log")"
exit 0
