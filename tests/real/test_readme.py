#!/usr/bin/python3
# limit: 600 s
"""The README's commands work as shown, and commands in docs/ use existing options.

A README line "$ COMMAND" is run; the lines below it are its expected output, with any numbers in place of theirs, and
"..." for any lines or words. The examples of its groups are run as well. Commands run in order in one folder.
"""
import os
import re

from codes import codes
from helpers import BUILD, RELUME, ROOT, SCRATCH, check, finish, must, on_display, relume, run

# Commands that wait for a person or for something unavailable here.
CANNOT_RUN = {
    "make demo": "installs packages; tests/show/suites.py runs it",
    "make": "builds",
    "make check": "runs this test",
    "make install": "real/test_install.py runs it",
    "make deb": "needs debhelper",
    "relume farm submit gears.trace -f 0-59 -o farm/gears.####.exr": "farm/test_farm.py has a cluster",
}
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
PLACE = SCRATCH / "place"


def blocks_of(page):
    """Code blocks: their lines, without the indentation."""
    for block in re.findall(r"(?:^    .*\n)+", page.read_text(encoding="utf-8"), re.M):
        yield [line[4:] for line in block.split("\n")[:-1]]


def commands_of(page):
    """[(command, expected output lines or None)]"""
    found = []
    for lines in blocks_of(page):
        shows = lines[0].startswith("$ ")
        for line in lines:
            if line.startswith("$ ") or not shows:
                found.append((re.sub(r"\s+# .*", "", line.removeprefix("$ ")), [] if shows else None))
            else:
                found[-1][1].append(line)
    return found


def pattern_of(lines):
    """A regular expression for a transcript."""
    def of_line(line):
        if line == "...":
            return r"(?:.*\n)*?"
        parts = re.split(r"(\d+(?:\.\d+)?|\.\.\.)", line)  # every other part is a number or dots
        return "".join((".*" if part == "..." else r"\d+(?:\.\d+)?") if i % 2 else re.escape(part)
                       for i, part in enumerate(parts)) + "\n"

    return "".join(of_line(line) for line in lines)


def options_of(verb):
    return set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", relume("help", verb).stdout.split("\nExamples:\n")[0]))


verbs = [v for v in re.findall(r"^  (\w+) ", relume("help").stdout, re.M) if v != "help"]
readme = (ROOT / "README.md").read_text(encoding="utf-8")
groups = re.findall(r"^\*\*([\w ]+)\*\*: ((?:.+\n)+)\n((?:    .*\n)+)", readme, re.M)
named = [verb for _, words, _ in groups for verb in re.findall(r"`(\w+)`", words)]
check(sorted(named) == sorted(verbs), f"the README's groups name each verb once: {sorted(named)}, {sorted(verbs)}")
for title, words, example in groups:
    check(any(f"relume {verb} " in example for verb in re.findall(r"`(\w+)`", words)),
          f"{title} has an example of one of its verbs")

n = 0
for page in DOCUMENTS:
    for command, _ in commands_of(page):
        for part in re.split(r"[|;&]+ ", command):
            asked = re.search(r"(?:^|[ /])relume (\w+)(.*)", part)
            if not asked:
                continue
            n += 1
            before, _, behind = asked[2].partition(" -- ")
            given = {(asked[1], option) for option in re.findall(r"(?<=\s)--?[a-z][a-z-]*", before)}
            given |= {("render", option)
                      for option in re.findall(r"(?<![\w-])--[a-z-]+", behind)} if asked[1] == "farm" else set()
            check(asked[1] in verbs, f"{page.name}: {command}: unknown verb {asked[1]}")
            unknown = [option for verb, option in given if option not in options_of(verb)]
            check(not unknown, f"{page.name}: {command}: relume has no {unknown}")
check(n > 20, f"documents show commands: {n}")

(PLACE / "build").mkdir(parents=True)
(PLACE / "build/relume").symlink_to(RELUME)
(PLACE / "build/demo").mkdir()  # with the recording that `make demo` leaves, as far as it is needed
must(on_display(RELUME, "record", "-o", PLACE / "build/demo/marbles.trace", "--quit-after", "21", "--",
                BUILD / "corpus/glx/marbles", "--size", "400x300"))
(BUILD / "tests/cache").mkdir(parents=True, exist_ok=True)  # otherwise Mesa would report that it is missing
env = {**os.environ, "PATH": f"{PLACE / 'build'}:{os.environ['PATH']}", "XDG_CACHE_HOME": str(BUILD / "tests/cache")}
ran = 0
for command, printed in commands_of(ROOT / "README.md"):
    if command in CANNOT_RUN:
        continue
    ran += 1
    words = ("sh", "-c", f"{{ {command}; }} 2>&1")
    done = run(*words, cwd=PLACE, env=env, timeout=200) if "xvfb-run" in command else on_display(
        *words, cwd=PLACE, env=env, timeout=200)
    check(done.returncode == 0, f"{command}: exit code {done.returncode}\n{done.stdout[-2000:]}")
    check(printed is None or re.fullmatch(pattern_of(printed), done.stdout),
          f"{command} prints\n{done.stdout}instead of\n" + "\n".join(printed or []))
    for written in re.findall(r"-o (\S+\.(?:png|trace|exr))", command):
        found = list(PLACE.glob(re.sub(r"#+", "*", written)))
        check(found and all(f.stat().st_size for f in found), f"{command} writes {written}")
check(ran >= 5, f"the README's commands are run: {ran}")

# The marble at the pixel that README picks shows the sky and the board: above and below its centre, other colours.
without = PLACE / "plain.png"
must(relume("render", PLACE / "build/demo/marbles.trace", "-f", "20", "-o", without))
apart = abs(codes(without) - codes(PLACE / "mirror.png")).max(axis=0) > 20
rows, columns = apart.any(axis=1).nonzero()[0], apart.any(axis=0).nonzero()[0]
check(len(rows) > 80 and len(columns) > 80 and 100 <= columns[0] and columns[-1] <= 210,
      f"the README's rule makes a mirror of one marble: {len(rows)} rows, columns {columns}")

# `make demo` prints a line as a stage begins, and one as it ends. Nothing is built here, and the command is a stub.
stub = SCRATCH / "stub/relume"
stub.parent.mkdir()
stub.write_text("#!/bin/sh\necho '60 frames: 60 passed'\n")
stub.chmod(0o755)
printed = run(ROOT / "corpus/demo.sh", stub.parent, env={**os.environ, "MAKE": "true"}).stdout
stages = re.findall(r"^(\w+) +\.\.\. +\S.*\n\1 +\d+\.\d s +\S.*$", printed, re.M)
check(stages == ["install", "build", "record", "render", "film", "score"],
      f"make demo announces each stage: {stages}\n{printed}")
finish()
