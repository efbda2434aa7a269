#!/usr/bin/python3
# limit: 300 s
"""A recording that the system stops: a full disk, a quota, a limit, an I/O error. One line reports it; the recording is
complete up to that point and the reported figures are right; `record` exits with 5; and --quit-after ends the program,
which would otherwise draw forever.
"""
import contextlib
import errno
import os
import re
import shutil

from helpers import BUILD, RELUME, SCRATCH, check, finish, must, on_display, relume, run, skip

if not shutil.which("glxgears"):
    skip("glxgears (mesa-utils) is not installed")
CHECKSUMS = f"LD_PRELOAD={BUILD}/tests/real/checksum_shim.so"
FULL = f"LD_PRELOAD={BUILD}/tests/real/full_shim.so"
ENDS = "the program ends as well (--quit-after)"
GOES_ON = "the program keeps running"


def recorded(trace, *options, program=("glxgears",), timeout=60, **variables):
    """Output of `record`; a program that it does not end runs into the time limit."""
    env = dict(os.environ, **{name: str(value) for name, value in variables.items()})
    return on_display("timeout", "--foreground", "-k", 5, timeout, RELUME, "record", "-o", trace, *options, "--",
                      *program, env=env)


def check_whole(what, done, trace, reason, after):
    """Require one line that reports the stop, with figures that match the file."""
    said = done.stderr
    check(done.returncode == 5, f"{what}: exit code {done.returncode}, expected 5: {said[-600:]}")
    line = re.findall(
        rf"^relume: {re.escape(str(trace))}: {reason}: recording stopped after (\d+) frames?; {re.escape(after)}$",
        said, re.M)
    check(len(line) == 1 and said.count("recording stopped") == 1,
          f"{what}: reported once, with the reason: {said[-600:]}")
    total = re.search(r": (\d+) frames?, (\d+) calls?, (\d+) bytes, .*stopped early: ", said)
    info = must(relume("info", trace)).stdout
    held = {name: int(re.search(rf"^{name} +(\d+)", info, re.M)[1]) for name in ("frames", "calls")}
    check(
        total and line and {int(total[1]), int(line[0])} == {held["frames"]} and held["frames"] > 0
        and int(total[2]) == held["calls"], f"{what}: {total and total[0]} but {held} in the file")
    check(total and int(total[3]) == trace.stat().st_size,
          f"{what}: {total and total[3]} bytes but {trace.stat().st_size}")
    dump = run("apitrace", "dump", "--color=never", trace)
    check(dump.returncode == 0 and not dump.stderr and dump.stdout.count(" glXSwapBuffers(") == held["frames"],
          f"{what}: apitrace reads it: {dump.stderr}")
    return held["frames"]


# Errors that this machine cannot produce, with a program that would draw forever.
for number, reason in ((errno.ENOSPC, "disk full"), (errno.EDQUOT, "disk quota exceeded"),
                       (errno.EFBIG, "file size limit reached"), (errno.EIO, "cannot write: Input/output error")):
    trace = SCRATCH / f"e{number}.trace"
    done = recorded(trace, "--env", FULL, "--quit-after", 1000000, FULL_NAME=".trace", FULL_BYTES=50000,
                    FULL_ERRNO=number)
    check_whole(f"errno {number}", done, trace, reason, ENDS)

# Both stop, which is reported once (every name ends in nothing).
trace = SCRATCH / "both.trace"
done = recorded(trace, "--env", FULL, "--quit-after", 1000000, "--ref", "color", FULL_NAME="", FULL_BYTES=50000,
                FULL_ERRNO=errno.ENOSPC)
check(done.returncode == 5 and done.stderr.count("stopped early") == 1,
      f"recording and reference frames: exit code {done.returncode}: {done.stderr[-600:]}")

# Also if frames end in another way than by a swap.
trace = SCRATCH / "flush.trace"
done = recorded(trace, "--env", FULL, "--quit-after", 1000000, "--frame-end", "clear", FULL_NAME=".trace",
                FULL_BYTES=50000, FULL_ERRNO=errno.ENOSPC)
check(done.returncode == 5, f"frames that end with a clear: exit code {done.returncode}: {done.stderr[-600:]}")

# Only the reference frames fail: the recording continues to its end, and the exit code reports that something is
# missing.
trace = SCRATCH / "ref.trace"
done = recorded(trace, "--env", FULL, "--quit-after", 40, "--ref", "color", FULL_NAME=".ref", FULL_BYTES=200000,
                FULL_ERRNO=errno.ENOSPC)
check(
    done.returncode == 5
    and done.stderr.count("ref.ref: disk full: no more reference frames; the recording goes on without them") == 1
    and ": 40 frames, " in done.stderr
    and " bytes of reference frames (stopped early), 0 calls not recorded" in done.stderr,
    f"reference frames: exit code {done.returncode}: {done.stderr[-600:]}")
frames = SCRATCH / "ref.frames"
must(relume("render", trace, "-f", "0-2", "--mode", "gl", "--device", "reference", "-o", frames / "ref.####.exr"))
scored = relume("diff", trace, frames, "-f", "0-2")
check(scored.returncode == 0 and "3 frames" in scored.stdout,
      f"the references written are complete: {scored.returncode}: {scored.stdout}{scored.stderr}")

# The limit on file size, whose signal would kill the program. Mesa 25 keeps its shaders in one large file, which would
# hit the limit first.
trace = SCRATCH / "limit.trace"
done = on_display(
    "sh", "-c",
    f"ulimit -f 160; MESA_SHADER_CACHE_DISABLE=true exec timeout 60 '{RELUME}' record --quit-after 1000000 -o "
    f"'{trace}' -- glxgears"
)
check_whole("RLIMIT_FSIZE", done, trace, "file size limit reached", ENDS)

@contextlib.contextmanager
def small_disk(name):
    """A folder with 200 KiB of space, or None if none can be mounted. One per case, because a removed file frees its
    space later."""
    folder = SCRATCH / name
    folder.mkdir()
    mounted = run("mount", "-t", "tmpfs", "-o", "size=200k", "none", folder).returncode == 0
    try:
        yield folder if mounted else None
    finally:
        if mounted:
            run("umount", "-l", folder)


# A full disk.
for name, options in (("plain", ()), ("ref", ("--ref", "color,depth"))):
    with small_disk(name) as small:
        if not small:
            print("no tmpfs to be mounted here: the full disk was only simulated by errno")
            finish()
        done = recorded(small / "x.trace", "--quit-after", 1000000, *options)
        check_whole(f"full disk, {name}", done, small / "x.trace", "disk full", ENDS)

# A disk that is full from the start: one line, and the program draws as usual.
with small_disk("before") as small:
    (small / "filler").write_bytes(bytes(200 << 10))
    plain = must(on_display("env", CHECKSUMS, "SHIM_FRAMES=30", "glxgears")).stdout
    done = recorded(small / "x.trace", "--env", CHECKSUMS, SHIM_FRAMES=30)
    check(
        done.returncode == 5
        and done.stderr.count("x.trace: disk full: recording stopped after 0 frames; the program keeps running") == 1
        and done.stdout == plain, f"a disk without any room: exit code {done.returncode}: {done.stderr}")

# A disk that fills up: the program continues, and shows the same as without a recorder.
with small_disk("during") as small:
    plain = must(on_display("env", CHECKSUMS, "SHIM_FRAMES=900", "glxgears")).stdout
    done = recorded(small / "x.trace", "--env", CHECKSUMS, "--ref", "color", SHIM_FRAMES=900)
    check_whole("a program that draws on", done, small / "x.trace", "disk full", GOES_ON)
    check(plain.count("\n") >= 900 and done.stdout == plain, "the same pictures as without a recorder")
finish()
