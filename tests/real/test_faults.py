#!/usr/bin/python3
# limit: 400 s
"""The short form of `make show-faults`: some of its faults must be caught by their gates and blamed on their draws, and
some of its variations must pass."""
import pathlib
import sys

from helpers import BUILD, ROOT, SCRATCH, check, diff, finish

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import faults  # noqa: E402

(SCRATCH / "show").mkdir()
for name in ("relume", "corpus", "librelume.so"):
    (SCRATCH / name).symlink_to(BUILD / name)
suite = faults.Suite(SCRATCH)
chosen = {
    "a box is not drawn", "wrong blend function", "one NaN in a normal", "a drift of 1/255", "a drift of 3/255",
    "the shadows are gone", "light without a reason", "shadows in the beauty alone"
}
for name, gates, draw, what in faults.FAULTS:
    if name not in chosen:
        continue
    chosen.discard(name)
    folder = suite.work / name.replace(" ", "_").replace("/", "_")
    folder.mkdir()
    code, frame = suite.score(suite.trace, faults.make_fault(suite, folder, what))
    caught, named, failed, first = faults.judge_fault(code, frame, gates, draw)
    check(caught, f"{name}: {failed} failed, expected {' or '.join(gates)}")
    check(named, f"{name}: {first} is blamed, not {draw}")
    # compare with the recording itself, which has names: the floor is the draw with its texture
    if name == "the shadows are gone":
        _, score = diff(suite.trace, folder / "s.####.exr", "-f", faults.FRAME, "--baseline", suite.base)
        blamed = score["frames"][0]["blame"][0]
        check(blamed["draw"] == draw and blamed.get("call") == "glBegin" and "texture" in blamed, f"{name}: {blamed}")
check(not chosen, f"no such fault: {chosen}")
for name, vary in faults.HARMLESS:
    if name not in ("1 thread", "other last bits", "a clock that is ignored"):
        continue
    folder = suite.work / name.replace(" ", "_")
    folder.mkdir()
    reference, path, more, baseline = vary(suite, folder)
    code, frame = suite.score(reference, pathlib.Path(path), more, baseline)
    check(code == 0 and frame["outcome"] == "passed", f"{name}: {frame['outcome']}, {frame['gates']}")
finish()
