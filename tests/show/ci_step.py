#!/usr/bin/python3
"""tests/show/ci_step.py RELUME VERB ARGUMENTS...: stands in for `relume render` or `relume diff` in show-ci.

A file called "renderer" in the current folder names an entry of faults.py: a broken renderer ("fault NAME") or a
harmless change ("harmless NAME"). The frame is rendered, then altered as that entry says. Further options that
variations need are written to varied.json beside the frames' folder.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
os.environ.pop("LD_PRELOAD", None)
import faults  # noqa: E402


class Rendered(faults.Suite):
    """The interface of faults.py's runs, for frames that `relume ci` has just rendered."""

    def __init__(self, relume, trace, frames):
        self.relume, self.trace, self.work = relume, trace.resolve(), frames.resolve().parent
        self.good = self.work / "good" / "s.0001.exr"
        self.log = open(os.devnull, "w", encoding="utf-8")
        for folder in ("good", "varied"):
            shutil.rmtree(self.work / folder, ignore_errors=True)
        shutil.copytree(frames, self.good.parent)
        (self.work / "varied").mkdir()


def vary(relume, trace, frames):
    kind, name = pathlib.Path("renderer").read_text(encoding="utf-8").strip().split(" ", 1)
    s = Rendered(relume, trace, frames)
    if kind == "fault":
        what, = [fault[3] for fault in faults.FAULTS if fault[0] == name]
        path = faults.make_fault(s, s.work / "varied", what)
        told = {}
    else:
        what, = [variation for other, variation in faults.HARMLESS if other == name]
        reference, path, more, baseline = what(s, s.work / "varied")
        told = {"reference": str(reference.with_suffix(".ref") if reference.suffix == ".trace" else reference),
                "more": [str(word) for word in more], "baseline": baseline}
    (s.work / "varied.json").write_text(json.dumps(told), encoding="utf-8")
    shutil.copy(path, frames / "s.0001.exr")


def main(relume, verb, *words):
    if verb == "render":
        code = subprocess.run([relume, verb, *words], check=False).returncode
        if code == 0:
            vary(relume, pathlib.Path(words[0]), pathlib.Path(words[words.index("-o") + 1]).parent)
        return code
    told = json.loads((pathlib.Path(words[-1]).parent / "varied.json").read_text(encoding="utf-8"))
    words = [*words[:-2], told.get("reference", words[-2]), words[-1]]
    if pathlib.Path(words[-2]).is_dir():  # these are pictures of the varied frame
        words[words.index("-f") + 1] = str(faults.FRAME)
    return subprocess.run([relume, verb, *words], check=False).returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
