#!/usr/bin/python3
# limit: 300 s
"""A stale frame of glxgears must be caught, with the calls that drew the pixels named; the other frames must pass."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from replayed import REF_COLOR, REF_DEPTH, records, whole_record

RELUME = os.environ["RELUME"]
FRAMES = 24  # glxgears follows the clock: on a fast machine adjacent frames look nearly the same
STALE, SHOWN = FRAMES - 1, 1


def relume(*args, display=False):
    words = (["tests/xvfb.sh"] if display else []) + [RELUME, *map(str, args)]
    return subprocess.run(words, capture_output=True, text=True, timeout=200)


def main():
    if not shutil.which("glxgears"):
        print("glxgears (mesa-utils) is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        trace, ref, out = folder / "g.trace", folder / "g.ref", folder / "out"
        for done in (relume("record", "-o", trace, "--ref", "color,depth", "--quit-after", FRAMES, "--", "glxgears",
                            display=True), relume("render", trace, "-f", f"0,2,{STALE}", "-o",
                                                  out / "g.####.exr"), relume("diff", trace, out, "-f",
                                                                              f"0,2,{STALE}")):
            assert done.returncode == 0, done.stdout + done.stderr

        shown = {kind: {frame: picture for frame, *picture in records(ref, kind)} for kind in (REF_COLOR, REF_DEPTH)}
        ref.write_bytes(b"RELREF2\n" + b"".join(
            whole_record(kind, frame, *shown[kind][SHOWN if frame == STALE else frame])
            for frame in shown[REF_COLOR]
            for kind in shown))

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
