#!/usr/bin/python3
"""tests/show/generated.py BUILD [--first N] [--count N] [--only N]... (as `make show-generated`): random legacy
programs (tests/generated), recorded on Mesa, rendered in mode gl and scored by all gates. Each failing program is
reduced to a minimal list of steps that still fails.

Program number N is the same on every machine, so a number identifies a failure: BUILD/tests/generated/program N shows
it. Recordings are in BUILD/show/generated, failures with their steps in failures.txt there. With --only, or as `make
show-generated ONLY="17 23"`, only these programs run.
"""
import argparse
import pathlib
import shutil
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from scoring import Scorer  # noqa: E402
from table import Shown  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BATCH = 50
BAR, BAR_HOURLY = 0.97, 1000
UNABLE = "the program ends on Mesa without Relume, too"


class Generator(Scorer):
    """Runs generated programs. Each is named "NUMBER" or "NUMBER:STEP,STEP"."""

    def __init__(self, build, ref):
        build = build.resolve()
        work = build / "show/generated"
        work.mkdir(parents=True, exist_ok=True)
        super().__init__(build / "relume", work, work / "log")
        self.program, self.ref = build / "tests/generated/program", ref

    def score(self, names, folder):
        """{name: {gate: figure} for the gates that fail}, or a message if a program does not get that far."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        trace, pictures = folder / "all.trace", folder / "x.####.exr"
        code, _, _ = self.run(ROOT / "tests/xvfb.sh", self.relume, "record", "-o", trace, "--ref", self.ref, "--",
                              self.program, *names)
        if code:
            bare = len(names) == 1 and self.run(ROOT / "tests/xvfb.sh", self.program, *names)[0]
            return self.apart(names, folder, UNABLE if bare else f"record: exit code {code}")
        code, _, err = self.run(self.relume, "render", trace, "--mode", "gl", "--encoding", "display", "--aov",
                                "gl,Z,layers,id", "-o", pictures)
        if code:
            return self.apart(names, folder, f"render: exit code {code}: {err[-300:]}")
        scored = self.json(self.relume, "diff", trace, pictures, "--json", "-") or {"frames": []}
        if len(scored["frames"]) != len(names):
            return self.apart(names, folder, f"diff: {len(scored['frames'])} frames")
        return {name: failures(frame) for name, frame in zip(names, scored["frames"])}

    def apart(self, names, folder, text):
        """Scores of a failed batch, found by halving it."""
        if len(names) == 1:
            return {names[0]: text}
        half = len(names) // 2
        return {**self.score(names[:half], folder), **self.score(names[half:], folder)}

    def steps(self, number):
        lines = self.run(self.program, "--list", number)[1].splitlines()
        return {int(line.split()[0]): line.split()[1] for line in lines}

    def reduce(self, number, folder):
        """A short list of steps that still fails; no step can be removed."""
        steps = list(self.steps(number))
        size = max(len(steps) // 2, 1)
        while True:
            parts = [steps[i:i + size] for i in range(0, len(steps), size)]
            fewer = [[step for step in steps if step not in part] for part in parts]
            names = [f"{number}:{','.join(map(str, left)) or 0}" for left in fewer]
            bad = self.score(names, folder)
            left = next((left for left, name in zip(fewer, names) if bad[name] and bad[name] is not UNABLE), None)
            if left is not None:
                steps = left
                if not steps:
                    return steps
                size = min(size, max(len(steps) // 2, 1))
            elif size == 1:
                return steps
            else:
                size = size // 2


def failures(frame):
    """{gate: text of its first figure that exceeds its bar}"""
    return {name: f"{gate['figures'][0]['value']:.4g}" for name, gate in frame["gates"].items()
            if gate["state"] == "failed" and gate["figures"]}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--only", type=int, action="append")
    parser.add_argument("--ref", default="color,depth", help="reference frames, as for relume record")
    args = parser.parse_args()
    numbers = args.only or range(args.first, args.first + args.count)
    generator, shown = Generator(args.build, args.ref), Shown(args.build, "generated")
    begin, failed, unable = time.monotonic(), [], []
    with open(generator.work / "failures.txt", "w", encoding="utf-8") as out:
        for at in range(0, len(numbers), BATCH):
            names = [str(n) for n in numbers[at:at + BATCH]]
            for name, bad in generator.score(names, generator.work / "batch").items():
                if bad is UNABLE:
                    unable.append(name)
                elif bad:
                    failed.append(name)
                    steps, left = generator.steps(name), generator.reduce(name, generator.work / "fewer")
                    print(f"{name}:{','.join(map(str, left))}  {' '.join(steps[step] for step in left)}  {bad}",
                          file=out, flush=True)
    seconds, count = time.monotonic() - begin, len(numbers)
    share = 1 - len(failed) / count
    shown.row(f"programs {numbers[0]} to {numbers[-1]}: all gates pass", f"{100 * share:.2f} %",
              f">= {100 * BAR:.0f} %", share >= BAR)
    shown.row("programs that crash on Mesa even without Relume", len(unable), None, None)
    if not args.only:
        shown.row("programs per hour, failures reduced", f"{count / seconds * 3600:.0f}", f">= {BAR_HOURLY}",
                  count / seconds * 3600 >= BAR_HOURLY)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main())
