#!/usr/bin/python3
"""test_batch_faults.py [BUILD] (with BUILD as `make show-batch-faults`): faults while frames are rendered.

A full disk, a read-only folder, a recording that is truncated during the run, one that disappears, a device that fails.
Each run must end with the right exit code and a line that names the fault; all files must be complete, with no partial
ones; and the same command with --skip-existing must continue once the fault is gone.

limit: 300 s
"""
import json
import os
import pathlib
import resource
import sys
import tempfile

if len(sys.argv) > 1:
    os.environ["RELUME_BUILD"] = sys.argv[1]
    os.environ.setdefault("TMPDIR", tempfile.mkdtemp(prefix="relume-faults-"))

from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, must, record, relume, run  # noqa: E402

FRAMES = 6
trace = SCRATCH / "two.trace"
record(trace, corpus("two_triangles"), "--frames", str(FRAMES), options=())
rows = []


def files(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir()} if folder.is_dir() else {}


def command(source, folder, *options):
    return ["render", source, "-o", folder / "x.{frame}.exr", "-j", "1", *options]


must(relume(*command(trace, SCRATCH / "whole")))
whole = files(SCRATCH / "whole")
frame_bytes = min(map(len, whole.values()))


def judge(what, done, folder, code, words):
    """Check the consequences of a fault, then remove it and continue the run."""
    left = files(folder)
    lines = [line for line in done.stderr.splitlines() if line.startswith("relume: ") and "warning" not in line]
    good = [check(done.returncode == code, f"{what}: exit code {done.returncode}, expected {code}: {done.stderr}"),
            check(any(words in line for line in lines), f"{what}: a line contains '{words}': {done.stderr}"),
            check(all(whole.get(name) == data for name, data in left.items()),
                  f"{what}: no partial file: {sorted(left)}")]
    rows.append({
        "what": f"{what}: exit code, line, partial files",
        "figure": f"{done.returncode}, {lines[0][8:80] if lines else ''}, "
        f"{sum(whole.get(n) != d for n, d in left.items())}", "bar": f"{code}, one that names it, 0", "peer": None,
        "passed": all(good)
    })
    return left


def goes_on(what, folder):
    must(relume(*command(trace, folder, "--skip-existing")))
    check(files(folder) == whole, f"{what}: the same command with --skip-existing continues")


# A full disk: first with files limited to half a frame (without PoCL, whose compiler writes files too); then on a real
# file system of two and a half frames, if one can be mounted.
folder = SCRATCH / "limited"
limit = frame_bytes // 2
done = run(RELUME, *command(trace, folder, "--device", "reference"),
           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
check(not judge("file too large", done, folder, 5, "cannot be written"), "file too large: no file is left")
goes_on("file too large", folder)
folder = SCRATCH / "small"
folder.mkdir()
size = int(2.5 * frame_bytes) // 1024 + 8
if run("mount", "-t", "tmpfs", "-o", f"size={size}k", "none", folder).returncode == 0:
    try:
        done = relume(*command(trace, folder))
        left = judge("full disk", done, folder, 5, "cannot be written")
        check(left, "full disk: frames that fitted exist")
        must(run("mount", "-o", "remount,size=64m", folder))
        goes_on("full disk", folder)
    finally:
        run("umount", "-l", folder)
else:
    print("no tmpfs can be mounted here: the full disk was only simulated by a limit on file size")

# A folder that cannot be written; a file in its place stops root, too.
(SCRATCH / "plain").write_text("a file where a folder should be\n")
done = relume(*command(trace, SCRATCH / "plain"))
judge("output folder is a file", done, SCRATCH / "plain", 5, "Not a directory")
done = relume(*command(trace, pathlib.Path("/proc/self/fdinfo")))
judge("output folder cannot be written", done, SCRATCH / "nothing", 5, "cannot be written")

# A recording that is truncated after it was indexed, and one that has disappeared.
cut = SCRATCH / "cut.trace"
cut.write_bytes(trace.read_bytes())
must(relume("index", cut))
shim = dict(os.environ, LD_PRELOAD=str(BUILD / "tests/real/failing_cl.so"))
with open(cut, "r+b") as file:
    file.truncate(trace.stat().st_size // 2)
done = relume(*command(cut, SCRATCH / "cutted"))
check(done.returncode in (0, 3), f"a truncated recording: exit code {done.returncode}: {done.stderr}")
check("anew" in done.stderr or "cut" in done.stderr or "whole frame" in done.stderr,
      f"a truncated recording is reported: {done.stderr}")
cut.unlink()
judge("recording is gone", relume(*command(cut, SCRATCH / "gone")), SCRATCH / "gone", 3, "cannot be read")

# A device that fails at the first launch, and one that fails later.
for after in (0, 40):
    folder = SCRATCH / f"device{after}"
    done = relume(*command(trace, folder), env=dict(shim, FAIL_CALL=str(after + 1), FAIL_NAME="clEnqueueNDRangeKernel",
                                                    FAIL_GONE="1"))
    judge(f"device fails at launch {after}", done, folder, 5, "CL_OUT_OF_RESOURCES")
    goes_on(f"device fails at launch {after}", folder)

if len(sys.argv) > 1:
    show = pathlib.Path(sys.argv[1]) / "show"
    show.mkdir(exist_ok=True)
    (show / "batch-faults.json").write_text(
        json.dumps({"name": "batch-faults", "command": "make show-batch-faults", "rows": rows}, indent=1))
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar {row['bar']}): {'passed' if row['passed'] else 'FAILED'}")
finish()
