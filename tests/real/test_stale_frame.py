#!/usr/bin/python3
# limit: 300 s
"""A stale frame of glxgears is caught, the others pass, and the calls that drew the pixels are named."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

RELUME = os.environ["RELUME"]
HEADER = struct.Struct("<IIIQQ")  # kind, width, height, frame, packed bytes: capture/format/ref.h
FRAMES = 24  # glxgears turns by the clock: on a fast machine neighbouring frames are nearly the same picture
STALE, SHOWN = FRAMES - 1, 1


def relume(*args, display=False):
    words = (["tests/xvfb.sh"] if display else []) + [RELUME, *map(str, args)]
    return subprocess.run(words, capture_output=True, text=True, timeout=200)


def read_records(path):
    data, at = path.read_bytes(), 8
    while at + HEADER.size <= len(data):
        kind, width, height, frame, packed = HEADER.unpack_from(data, at)
        at += HEADER.size
        yield kind, width, height, frame, data[at:at + packed]
        at += packed


def main():
    if not shutil.which("glxgears"):
        print("glxgears (mesa-utils) is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        trace, ref, out = folder / "g.trace", folder / "g.ref", folder / "out"
        for done in (relume("record", "-o", trace, "--ref", "color,depth", "--quit-after", FRAMES, "--", "glxgears", display=True),
                     relume("render", trace, "-f", f"0,2,{STALE}", "-o", out / "g.####.exr"), relume("diff", trace, out, "-f", f"0,2,{STALE}")):
            assert done.returncode == 0, done.stdout + done.stderr

        records = list(read_records(ref))
        pixels = {(kind, frame): packed for kind, _, _, frame, packed in records}
        with ref.open("wb") as f:
            f.write(b"RELREF1\n")
            for kind, width, height, frame, packed in records:
                packed = pixels[kind, SHOWN if frame == STALE else frame]
                f.write(HEADER.pack(kind, width, height, frame, len(packed)) + packed)

        done = relume("diff", trace, out, "-f", f"0,2,{STALE}", "--json", "-")
        assert done.returncode == 1, done.stdout + done.stderr
        frames = json.loads(done.stdout)["frames"]
        assert [f["outcome"] for f in frames] == ["passed", "passed", "failed"]
        gates = {name for name, gate in frames[2]["gates"].items() if gate["state"] == "failed"}
        assert {"R4", "R5", "P"} <= gates, gates
        assert not {"V", "E1", "E2"} & gates, gates
        drawn = [b for b in frames[2]["blame"] if b["draw"]]
        assert drawn and all(b["call"] == "glCallList" and b["list"] in (1, 2, 3) for b in drawn), drawn
    return 0


if __name__ == "__main__":
    sys.exit(main())
