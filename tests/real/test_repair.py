#!/usr/bin/python3
"""Truncated or damaged recordings: `relume repair` keeps every call up to the damage, and other tools read the result
to its end.

limit: 200 s
"""
import gzip
import pathlib
import re
import struct
import sys

from helpers import ROOT, SCRATCH, check, corpus, finish, must, record, relume, run

sys.path.insert(0, str(ROOT / "tests" / "fuzz"))
from mutate import unpack  # noqa: E402

CUTS = 20
END = re.compile(r"^\d* ?glXSwapBuffers\(")


def dump(path):
    """apitrace's text of a trace, without call numbers, and its complaints."""
    done = run("apitrace", "dump", "--color=never", "--call-nos=no", "--arg-names=no", path)
    lines = [line for line in done.stdout.splitlines() if line.strip()]
    return lines, done.stderr + "".join(
        line for line in lines if "// incomplete" in line) + "x" * (done.returncode != 0)


def frames(lines):
    return sum(bool(END.match(line)) for line in lines)


def repaired(path, what):
    """The calls of a repaired trace, as text."""
    new = SCRATCH / "new.trace"
    new.unlink(missing_ok=True)
    done = relume("repair", "-o", new, path)
    if not check(done.returncode == 0, f"{what}: exit code {done.returncode}: {done.stderr}"):
        return []
    lines, wrong = dump(new)
    check(not wrong, f"{what}: apitrace reads it to the end: {wrong[:300]}")
    info = relume("info", "--json", new)
    check(info.returncode == 0 and not info.stderr, f"{what}: relume reads it without a warning: {info.stderr}")
    found = re.match(r"kept  (\d+) calls?, (\d+) frames?", done.stdout)
    check(found and int(found[2]) == frames(lines), f"{what}: reports the number of frames: {done.stdout}")
    check(f'"frames":{frames(lines)},' in info.stdout.replace(" ", ""),
          f"{what}: relume and apitrace count the same frames")
    check(not list(SCRATCH.glob("*.part")), f"{what}: no partial file is left")
    return lines


def chunks(data):
    """[(offset, bytes)] of the Snappy chunks of a trace."""
    at, found = 2, []
    while at + 4 <= len(data):
        size, = struct.unpack_from("<I", data, at)
        found.append((at, 4 + size))
        at += 4 + size
    return found


live, cut = SCRATCH / "live.trace", SCRATCH / "cut.trace"
record(live, corpus("viewer"), "--frames", "40", options=())
for trace in (live, ROOT / "tests/golden/cornell.trace"):
    data = trace.read_bytes()
    whole, _ = dump(trace)
    check(repaired(trace, f"{trace.name}, whole") == whole, f"{trace.name}: a complete recording is unchanged")
    kept = []
    for i in range(1, CUTS + 1):
        cut.write_bytes(data[:len(data) * i // (CUTS + 1)])
        reads, _ = dump(cut)
        lines = repaired(cut, f"{trace.name} cut at {i} of {CUTS + 1}")
        check(lines == whole[:len(lines)], f"{trace.name} cut at {i}: the calls equal the recorded ones")
        shown = [line for line in reads if "// incomplete" not in line]
        check(
            len(lines) >= len(shown),
            f"{trace.name} cut at {i}: as many calls as apitrace reads: {len(lines)} of {len(shown)}")
        kept.append(len(lines))
    check(kept == sorted(kept) and kept[-1] > 0.8 * len(whole),
          f"{trace.name}: a later cut loses less: {kept} of {len(whole)}")

# A damaged chunk in the middle: exactly the frames that end before it are kept. The recorder ends a chunk with each
# frame.
data, (whole, _) = live.read_bytes(), dump(live)
found = chunks(data)
for i in (len(found) // 3, len(found) // 2, len(found) - 2):
    at, size = found[i]
    cut.write_bytes(data[:at + 4] + b"\xff" * (size - 4) + data[at + size:])
    lines = repaired(cut, f"chunk {i} damaged")
    (SCRATCH / "before.trace").write_bytes(data[:at])
    before, _ = dump(SCRATCH / "before.trace")
    check(lines == [line for line in before if "// incomplete" not in line] and frames(lines) == frames(before) > 0,
          f"chunk {i} damaged: exactly the calls before it: {len(lines)} of {len(before)} calls")

# A single compressed stream instead of chunks.
stream = bytes(unpack(data))
packed = gzip.compress(stream)
cut.write_bytes(packed)
check(repaired(cut, "gzip") == whole, "gzip: the same calls in Snappy chunks")
check((SCRATCH / "new.trace").read_bytes()[:2] == b"at", "gzip: the result is in Snappy chunks")
for what, damaged in (("cut", packed[:len(packed) // 2]), ("damaged", packed[:len(packed) // 2] + b"\xff" * 4000)):
    cut.write_bytes(damaged)
    lines = repaired(cut, f"gzip {what}")
    check(
        len(lines) > len(whole) // 4 and lines == whole[:len(lines)],
        f"gzip {what}: {len(lines)} of {len(whole)} calls")
must(run("apitrace", "repack", "--brotli=1", live, SCRATCH / "brotli.trace"))
packed = (SCRATCH / "brotli.trace").read_bytes()
cut.write_bytes(packed)
check(repaired(cut, "Brotli") == whole, "Brotli: the same calls")
cut.write_bytes(packed[:len(packed) * 2 // 3])
lines = repaired(cut, "Brotli cut")
check(len(lines) > len(whole) // 4 and lines == whole[:len(lines)], f"Brotli cut: {len(lines)} of {len(whole)} calls")

# A second recording in the same file: the first is kept, and a line reports how many bytes follow.
other = (ROOT / "tests/golden/two_triangles.trace").read_bytes()
odd = b"at" + struct.pack("<I", 1 << 16) + b"\x80\x80\x04" + bytes(
    (1 << 16) - 3)  # read as a chunk, it ends before the file does
for what, first, second in (("itself", data, data), ("another one", data, other),
                            ("one that begins with a chunk of 64 KiB",
                             data, odd), ("gzip", gzip.compress(stream),
                                          other), ("gzip in gzip", gzip.compress(stream),
                                                   gzip.compress(bytes(unpack(other)))), ("Brotli", packed, other)):
    cut.write_bytes(first + second)
    check(repaired(cut, f"followed by {what}") == whole, f"followed by {what}: the first one is kept")
    done = relume("repair", "-o", SCRATCH / "new.trace", cut)
    check(f"left  {len(second)} bytes of another recording" in done.stdout and " 0 of the file's" in done.stdout,
          f"followed by {what}: {done.stdout}")
    said = relume("info", cut).stderr
    check(
        re.search(rf" {len(second)} bytes follow the recording after call \d+,", said) and said.count("\n") == 1,
        f"followed by {what}: info: {said}")

# Reference frames stay beside the old recording; a line says how the new one gets them.
cut.write_bytes(data[:len(data) // 2])
new = SCRATCH / "new.trace"
for there in (False, True):
    if there:
        cut.with_suffix(".ref").write_bytes(b"RELREF2\n")
    said = relume("repair", "-o", new, cut).stdout
    old_ref, new_ref = cut.with_suffix(".ref"), new.with_suffix(".ref")
    check((f"cp {old_ref} {new_ref}, or name it: relume diff {old_ref} FRAMES\n" in said) == there,
          f"reference frames {there}: {said}")

# Nothing to save, and wrong usage: one line, and no file.
new = SCRATCH / "none.trace"
for what, content in (("its first bytes", data[:2]), ("its header", data[:12]), ("no trace", b"\x89PNG" + bytes(100))):
    cut.write_bytes(content)
    done = relume("repair", "-o", new, cut)
    check(done.returncode == 3 and not new.exists(), f"{what}: nothing to save: {done.returncode} {done.stderr}")
check(relume("repair", live).returncode == 2 and relume("repair", "-o", live, live).returncode == 2, "usage")
check(live.read_bytes() == data, "the recording itself is not written")
check(relume("repair", "-o", pathlib.Path("/dev/full/x"), live).returncode == 5, "a place that cannot be written")
finish()
