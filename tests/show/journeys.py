#!/usr/bin/python3
"""tests/show/journeys.py BUILD (as `make show-journeys`): the experience of new users.

Runs the five journeys of tests/journeys and prints the processor time of each; prints forty wrong inputs, each with its
exit code and message; and counts the commands and seconds from a program to its first noise-free picture.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from display import need_display
from table import Shown

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
JOURNEYS = ("developer", "ci_engineer", "farm_td", "artist", "trouble")
MOST_SECONDS = 30  # limit in processor time, kernels already compiled
WRONG = 40
sys.path.insert(0, str(ROOT / "tests/journeys"))
import wrong_inputs  # noqa: E402


def environment(build, tmp):
    return {**os.environ, "RELUME": str(build / "relume"), "RELUME_BUILD": str(build), "TMPDIR": tmp,
            "POCL_CACHE_DIR": str(build / "tests/pocl-cache"), "XDG_CACHE_HOME": str(build / "tests/cache")}


def journey(build, name):
    with tempfile.TemporaryDirectory(prefix="relume-") as tmp:
        return subprocess.run([ROOT / f"tests/journeys/test_{name}.py"], env=environment(build, tmp),
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)


def show_journeys(shown, build):
    for name in JOURNEYS:  # compiles the kernels
        journey(build, name)
    for name in JOURNEYS:
        done = journey(build, name)
        seconds = float((re.search(r"^([\d.]+) s of processor time", done.stdout, re.M) or [0, "inf"])[1])
        checks = re.search(r"Checks: (\d+), Failures: (\d+)", done.stdout)
        figure = f"{int(checks[1]) - int(checks[2])} of {checks[1]} checks, {seconds:.1f} s" if checks else f"exit code {done.returncode}"
        shown.row(f"{name.replace('_', ' ')}, from the start to a picture", figure,
                  f"all checks, {MOST_SECONDS} s of processor time", done.returncode == 0 and seconds <= MOST_SECONDS)


def show_wrong_inputs(shown, build, tmp):
    place = pathlib.Path(tmp)
    env = environment(build, tmp)
    game = place / "game"
    game.write_text(f'#!/bin/sh\nexec "{build}/corpus/two_triangles" --frames 3 --size 160x120 "$@"\n')
    game.chmod(0o755)
    for words in (["record", "-o", "game.trace", "--ref", "color,depth", "--",
                   "./game"], ["render", "game.trace", "-o", "out/game.####.exr"]):
        subprocess.run([build / "relume", *words], cwd=place, env=env, stdin=subprocess.DEVNULL,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    good = 0
    for outcome in wrong_inputs.try_all(build / "relume", place, env):
        good += not outcome.faults
        print(f"       {outcome.typed}\n           {outcome.code}  {outcome.line.removeprefix('relume: ')}",
              *outcome.faults, sep="\n           FAULT: ")
    shown.row("wrong inputs: one line, the right exit code, no partial output",
              f"{good} of {len(wrong_inputs.CASES)}", f"{WRONG} of {WRONG}", good == len(wrong_inputs.CASES) == WRONG)


def show_first_picture(shown, build, program, name, tmp):
    """Commands and seconds from a program to a noise-free picture with `--look auto`, kernels already compiled."""
    place, env = pathlib.Path(tmp), environment(build, tmp)
    commands = ([build / "relume", "record", "-o", "game.trace", "--quit-after", "10", "--", *program], [
        build / "relume", "render", "game.trace", "-f", "5", "--look", "auto", "--samples", "16", "--denoise", "-o",
        "nice.png"
    ])
    seconds, codes = [], []
    for command in commands:
        begin = time.monotonic()
        done = subprocess.run(command, cwd=place, env=env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        seconds.append(time.monotonic() - begin)
        codes.append(done.returncode)
        if done.returncode:
            print(done.stdout)
    picture = place / "nice.png"
    kept = build / "show/journeys" / f"{name}.png"
    kept.parent.mkdir(parents=True, exist_ok=True)
    if picture.exists():
        kept.write_bytes(picture.read_bytes())
    shown.row(
        f"{name} to a first nice picture (build/show/journeys/{name}.png)",
        f"{len(commands)} commands, {sum(seconds):.1f} s ({seconds[0]:.1f} to record, {seconds[1]:.1f} to render)",
        "2 commands",
        picture.exists() and codes == [0, 0])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve())
    build = parser.parse_args().build
    need_display()
    shown = Shown(build, "journeys")
    show_journeys(shown, build)
    with tempfile.TemporaryDirectory(prefix="relume-") as tmp:
        show_wrong_inputs(shown, build, tmp)
    for name, program in (("hall", [build / "corpus/hall"]), ("spheres", [build / "corpus/spheres"]), ("glxgears",
                                                                                                       ["glxgears"])):
        with tempfile.TemporaryDirectory(prefix="relume-") as tmp:
            show_first_picture(shown, build, program, name, tmp)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main())
