#!/usr/bin/python3
"""Examples in help texts and man pages: each names only options that exist, and all that can run here run on a
recording, in order.

limit: 600 s
"""
import os
import re
import shutil
import sys

from helpers import BUILD, RELUME, ROOT, SCRATCH, check, corpus, finish, must, on_display, relume, run

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "packaging"))
import manual  # noqa: E402

# Commands that wait for a person or for something unavailable here, and their replacements.
CANNOT_RUN = {
    "relume record -o game.trace --start-key F9 -- ./game": "nobody presses the key",
    "relume farm submit game.trace -f 0-499 --chunk 50 -o farm/game.####.exr --gres gpu:1 --sbatch=--partition=gpu":
        "farm/test_farm.py has a cluster",
    "relume farm status farm/game.farm": "asks about that job",
    "relume devices --check": "takes minutes; real/test_families.py runs it",
    'relume reduce game.trace --frame 3 -o small.trace': "no frame fails; real/test_reduce.py has one that does",
}
# Further valid exit codes: recordings or frames differ, or nothing is approved.
ALSO = {"bisect": (1,), "diff": (1, 4), "ci": (1, 4)}
PLACE = SCRATCH / "place"


def options_of(verb):
    text = relume("help", verb).stdout.split("\nExamples:\n")[0]
    return set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", text))


def files_of(blocks):
    """The files and commands of a page's examples."""
    under = False
    for kind, content in blocks:
        under = content == "EXAMPLES" if kind == "heading" else under
        if not under or kind != "code":
            continue
        for part in "\n".join(content).split("\n\n"):
            named = re.match(r"(?:#|//) (\S+\.\w+): .*\n", part)
            if named:
                last = named[1]
                yield last, part[named.end():]
            elif not re.match(r"(xvfb-run -a )?relume ", part):
                yield last, "\n" + part  # a file continues after an empty line
            else:
                yield None, part


# Every help text has examples of its verb, using existing options.
verbs = [v for v in re.findall(r"^  (\w+) ", relume("help").stdout, re.M) if v != "help"]
examples = manual.examples()
check(
    set(examples) == {"relume", *verbs},
    f"packaging/examples.txt has exactly the verbs, except: {set(examples) ^ set(verbs)}")
commands = [("relume", line) for line in examples["relume"] if not line.startswith("#")]
check(all(line in relume("help").stdout for _, line in commands), "relume help has examples")
for verb in verbs:
    shown = relume("help", verb).stdout.partition("\nExamples:\n")[2].split("\n")
    lines = [line.strip() for line in shown if line.strip()]
    check(any(f"relume {verb} " in line for line in lines), f"relume help {verb} has an example of it")
    check(all(len(line) <= manual.PAGE_COLUMNS for line in shown),
          f"relume help {verb}: examples of at most {manual.PAGE_COLUMNS} columns")
    commands += [(verb, line) for line in examples.get(verb, ()) if not line.startswith("#")]
for form in manual.FORMATS:
    text = relume("help", f"{form.name}-file")
    check(text.returncode == 0 and "\nEXAMPLES\n" in text.stdout, f"relume help {form.name}-file has examples")
    pairs = list(files_of(manual.read(form.source)))
    check(
        any(name for name, _ in pairs) and any(not name for name, _ in pairs),
        f"{form.source}: a file and a command to use it")
    for name, part in pairs:
        commands += [("FILE", (name, part))] if name else [("ci" if "relume ci" in c else c.split()[1], c)
                                                           for c in part.split("\n")]
for page in sorted((BUILD / "pages/man").glob("*.[15]")):
    check(".SH EXAMPLES" in page.read_text(), f"{page.name} has a section EXAMPLES")
# No help text names a source file, because users of a package do not have it.
for word in ["", *verbs, *(f"{form.name}-file" for form in manual.FORMATS)]:
    named = re.findall(r"\b[a-z]+(?:/[a-z_]+)*/[\w.]+\.(?:h|c|md|cl)\b",
                       relume("help", *([word] if word else [])).stdout)
    check(not named, f"relume help {word} names files of the source: {named}")

for verb, line in commands:
    for part in re.split(r"[|;&]+ | -- \./game.*", line) if verb != "FILE" else ():
        found = re.search(r"\brelume (\w+)(.*)", part)
        if found:
            given = set(re.findall(r"(?<=\s)--?[a-z][a-z-]*", found[2].partition(" -- ")[0]))
            given |= set(re.findall(r"(?<=\s)--[a-z-]+",
                                    found[2].partition(" -- ")[2])) if found[1] != "farm" else set()
            unknown = given - options_of(found[1])
            check(not unknown, f"{line}: relume {found[1]} has no {unknown}")

# A folder as it would be for a user who tries the examples.
(PLACE / "bin").mkdir(parents=True)
(PLACE / "bin/relume").symlink_to(RELUME)
game = PLACE / "game"
game.write_text(f'#!/bin/sh\nexec "{corpus("spheres")}" --frames 10 --size 160x120 --animate camera "$@"\n')
game.chmod(0o755)
for hook in (ROOT / "corpus/hooks").glob("*.cl"):
    shutil.copy(hook, PLACE)
env = {**os.environ, "PATH": f"{PLACE / 'bin'}:{os.environ['PATH']}", "XDG_CACHE_HOME": str(BUILD / "tests/cache")}
must(on_display(RELUME, "record", "-o", PLACE / "good.trace", "--", game, cwd=PLACE, env=env))
must(
    on_display(RELUME, "record", "-o", PLACE / "bad.trace", "--", game, "--mirror", "--animate", "light", cwd=PLACE,
               env=env))

for name, part in (pair for verb, pair in commands if verb == "FILE"):
    with open(PLACE / name, "a" if part.startswith("\n") else "w", encoding="utf-8") as file:
        file.write(part + "\n")
for verb, line in commands:
    if verb == "FILE" or line in CANNOT_RUN:
        continue
    if "broken.trace" in line:
        whole = (PLACE / "game.trace").read_bytes()
        (PLACE / "broken.trace").write_bytes(whole[:len(whole) * 2 // 3])
    done = on_display("sh", "-c", line, cwd=PLACE, env=env, timeout=300)
    check(done.returncode in (0, *ALSO.get(verb, ())),
          f"{line}: exit code {done.returncode}\n{done.stdout[-500:]}{done.stderr[-2000:]}")
    for written in re.findall(r"-o (\S+\.(?:png|trace|glb|exr|webm|mp4|yaml))", line):
        found = list(PLACE.glob(re.sub(r"#+", "*", written)))
        check(found and all(f.stat().st_size for f in found) or "farm script" in line, f"{line} writes {written}")
finish()
