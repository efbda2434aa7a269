#!/usr/bin/python3
"""The short form of `make show-sweep`: two hacks of xscreensaver, recorded live, pass all gates.

atunnel is a large area with a linearly filtered texture; blinkbox blends some twenty layers. They pass only if
filtering and blending round like Mesa's.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "show"))

import helpers
import programs
import recording
import scoring
import sweep

HACKS = ("atunnel", "blinkbox")


def main():
    if not shutil.which("apitrace"):
        helpers.skip("apitrace is not installed")
    with tempfile.TemporaryDirectory(dir=helpers.SCRATCH) as scratch:
        for name in HACKS:
            folder = pathlib.Path(scratch) / name
            done = recording.record(pathlib.Path(helpers.RELUME), programs.xscreensaver(name), folder)
            if not helpers.check(done.trace and len(done.references) == 11, f"{name}: recorded: {done.said}"):
                continue
            line = scoring.score_recording(scoring.Scorer(pathlib.Path(helpers.RELUME), folder, folder / "log"),
                                           scoring.Line(name), done, 2, "gl", sweep.GATES)
            helpers.check(line.frames == 2 and line.good, f"{name}: {line}")
            helpers.check(line.dump == "whole", f"{name}: apitrace dump: {line.dump}")
            helpers.check(line.replay == "same", f"{name}: glretrace: {line.replay}")
            helpers.check(not line.unhandled, f"{name}: {line.unhandled}")
    helpers.finish()


if __name__ == "__main__":
    if "DISPLAY_IS_OURS" in __import__("os").environ:
        main()
    sys.exit(
        subprocess.run(["env", "DISPLAY_IS_OURS=1", helpers.ROOT / "tests/xvfb.sh", sys.executable, "-B", *sys.argv],
                       check=False).returncode)
