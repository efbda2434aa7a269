#!/usr/bin/python3
"""tests/show/hooks.py BUILD (as `make show-hooks`): the examples of corpus/hooks/ rendered, the cost of a hook that
repeats the built-in code, and the error messages for wrong hooks.

Pictures are left as PNG in BUILD/show/hooks for inspection. Times are processor time of whole commands: medians of runs
that alternate with and without the hook, after one run of each to compile kernels.
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy
from exr_numpy import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SIZE, FRAMES, ROUNDS, BAR = "480x360", 12, 7, 1.1
MIRRORS = "surfaces:\n  - { match: { lit: yes }, reflect: 0.3 }\n"
CLOSEST = "struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)\n{\n%s\n}\n"
# name: program, further options
EXAMPLES = {
    "repeat": ("still_life", ), "toon": ("still_life", ), "car_paint": ("still_life", ),
    "thin_lens": ("spheres", "--samples", "16"), "fisheye": ("spheres", ), "sunset": ("spheres", "--look", MIRRORS),
    "sphere": ("still_life", ), "distance": ("still_life", ), "boxes": ("spheres", ), "cutout": ("still_life", ),
    "gobo": ("still_life", )
}
# fault: hook, wrapper command, seconds, words that the message must contain
WRONG = {
    "syntax": (CLOSEST % "\treturn relume_color(hit.color;", "wrong.cl:3:"),
    "a member that is not there": ("\n\n" + CLOSEST % "\treturn relume_color(hit.colour);", "wrong.cl:5:"),
    "a function that is not there": (CLOSEST % "\treturn relume_colour(hit.color);", "wrong.cl:3:"),
    "no stage": ("float f(void) { return 1; }\n", "defines none of the functions"),
    "a parameter of no type": ("#pragma relume parameter vector v = 1\n" + CLOSEST % "\treturn relume_go_on();",
                               "line 1: there is no type vector"),
    "intersection without bounds": (
        "struct relume_request intersection(struct relume_crossing c, struct relume_parameters p)\n{\n\treturn "
        "relume_ignore();\n}\n",
        "without bounds"),
    "an endless loop": (CLOSEST %
                        "\tvolatile int i = 0;\n\n\twhile (i >= 0)\n\t\ti = (i + 1) % 7;\n\treturn relume_go_on();",
                        "endless loop"),
}
BEYOND = CLOSEST % "\tvolatile float table[4];\n\n\tfor (int i = 0; i < 4 + (int)hit.front; i++)\n\t\ttable[i] = hit.color.x;\n\treturn relume_go_on();"


def run(*command, good=True):
    done = subprocess.run([str(part) for part in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          errors="replace", check=False)
    if good and done.returncode:
        sys.exit(
            f"{' '.join(map(str, command))}: exit code {done.returncode}:\n{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return done


def look_file(work, options):
    """Options, with the rules written to a file."""
    out = []
    for option in options:
        if str(option).endswith("\n"):
            rules = work / f"{abs(hash(option))}.look.yaml"
            rules.write_text(option)
            option = rules
        out.append(option)
    return out


def same(a, b):
    first, second = Image(a).planes, Image(b).planes
    return first.keys() == second.keys() and all(
        numpy.array_equal(first[name], second[name], equal_nan=True) for name in first)


def processor_s(*command):
    before = os.times()
    run(*command)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


class Show:
    def __init__(self, build, work):
        self.build, self.work, self.rows, self.pictures = build, work, [], build / "show/hooks"
        self.pictures.mkdir(parents=True, exist_ok=True)
        self.traces = {}
        for program in ("still_life", "spheres"):
            self.traces[program] = work / f"{program}.trace"
            run(ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", self.traces[program], "--",
                build / "corpus" / program, "--frames", FRAMES, "--size", SIZE)

    def row(self, what, figure, bar, passed):
        self.rows.append({"what": what, "figure": figure, "bar": bar, "peer": None, "passed": passed})
        print(f"{what}: {figure}" + (f" (bar: {bar})" if bar else "") + ("" if passed else ": falls short"), flush=True)

    def render(self, program, out, *options):
        run(self.build / "relume", "render", self.traces[program], "-o", out, *look_file(self.work, options))

    def examples(self):
        found = {path.stem for path in (ROOT / "corpus/hooks").glob("*.cl")}
        self.row("examples of corpus/hooks/ rendered here", len(found & EXAMPLES.keys()),
                 len(found | EXAMPLES.keys()), found == EXAMPLES.keys())
        for name, (program, *options) in EXAMPLES.items():
            rules = ROOT / f"corpus/hooks/{name}.look.yaml"
            options += ["--look", rules] if rules.exists() else []
            hooked, plain = self.work / f"{name}.exr", self.work / f"{name}_plain.exr"
            self.render(program, plain, "-f", 1, *options)
            hook = ("--hook", ROOT / f"corpus/hooks/{name}.cl")
            self.render(program, hooked, "-f", 1, *options, *hook)
            self.render(program, self.pictures / f"{name}.png", "-f", 1, *options, *hook)
            a, b = (numpy.stack([Image(path).planes[c] for c in "RGB"]) for path in (hooked, plain))
            share = 100 * (abs(a - b).max(axis=0) > 0.01).mean()
            if name == "repeat":
                self.row("example repeat: every number of every channel",
                         "the same" if same(hooked, plain) else "other", "the same", same(hooked, plain))
            else:
                self.row(f"example {name}: percentage of pixels changed", round(share, 1),
                         "more than 1, and all finite", share > 1 and bool(numpy.isfinite(a).all()))

    def repeat(self):
        hook = ("--hook", ROOT / "corpus/hooks/repeat.cl")
        scenes = {
            "plain frames, still life": ("still_life", ), "plain frames, spheres": ("spheres", ),
            "with mirrors": ("spheres", "--look", MIRRORS),
            "with mirrors, 4 samples": ("still_life", "--look", MIRRORS, "--samples", "4"),
            "mode path, 4 samples": ("spheres", "--mode", "path", "--samples", "4")
        }
        for what, (program, *options) in scenes.items():
            paths = [self.work / folder / "f.####.exr" for folder in ("without", "with")]
            commands = [(self.build / "relume", "render", self.traces[program], "-o", path,
                         *look_file(self.work, options), *more) for path, more in zip(paths, ((), hook))]
            for command in commands:
                run(*command)
            equal = sum(
                same(paths[0].with_name(f"f.{i:04}.exr"), paths[1].with_name(f"f.{i:04}.exr")) for i in range(FRAMES))
            times = [[processor_s(*command) for command in commands] for _ in range(ROUNDS)]
            without, with_hook = (statistics.median(column) for column in zip(*times))
            self.row(f"repeat, {what}: identical frames", f"{equal} of {FRAMES}", f"{FRAMES} of {FRAMES}",
                     equal == FRAMES)
            self.row(
                f"repeat, {what}: times the processor time ({without:.2f} s for {FRAMES} frames, with the hook "
                f"{with_hook:.2f} s)",
                round(with_hook / without, 2), f"at most {BAR}", with_hook <= BAR * without)

    def wrong(self):
        path = self.work / "wrong.cl"
        for what, (text, words) in WRONG.items():
            path.write_text(text)
            done = run(self.build / "relume", "hook", "--check", "--seconds", 30, path, good=False)
            said = done.returncode == 3 and words in done.stderr
            self.row(f"a wrong hook, {what}", words if said else done.stderr[-300:], words, said)
        path.write_text(BEYOND)
        done = run("oclgrind", "--build-options", "-cl-opt-disable -D LANES_PORTABLE", "--max-errors", "2",
                   self.build / "relume", "hook", "--check", "--seconds", 300, path, good=False)
        said = "Invalid write of size 4" in done.stdout + done.stderr and "At line 6" in done.stdout + done.stderr
        self.row("a wrong hook, an out-of-bounds write, under Oclgrind",
                 "Invalid write of size 4, At line 6" if said else (done.stdout + done.stderr)[-300:],
                 "the write and its line", said)


def main(build):
    with tempfile.TemporaryDirectory(prefix="relume-") as folder:
        show = Show(build, pathlib.Path(folder))
        show.examples()
        show.wrong()
        show.repeat()
    (build / "show/hooks.json").write_text(
        json.dumps({"name": "hooks", "command": "make show-hooks", "rows": show.rows}, indent=1))
    return any(not row["passed"] for row in show.rows)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
