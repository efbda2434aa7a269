#!/usr/bin/python3
# limit: 300 s
"""Several --look files apply in order, "auto" among them; the matches of each rule are reported once, and a rule
without matches is a warning."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from helpers import SCRATCH, check, finish, must, record, relume  # noqa: E402

trace = SCRATCH / "gears.trace"
record(trace, "glxgears", "-geometry", "120x120", options=("--quit-after", "2"))


def rules(name, text):
    (SCRATCH / name).write_text(text)
    return SCRATCH / name


def rendered(name, *looks, options=()):
    """The frames' bytes, and render's output."""
    words = [word for look in looks for word in ("--look", look)]
    done = must(
        relume("render", trace, "-o", SCRATCH / name / "x.####.exr", "--device", "reference", *words, *options,
               timeout=110))
    return [f.read_bytes() for f in sorted((SCRATCH / name).glob("*.exr"))], done.stderr


def picture(frame):
    """A file's pixels: the part after its header, which contains the settings."""
    return frame[-len(frame) // 2:]


def same(a, b):
    return len(a) == len(b) == 2 and all(picture(x) == picture(y) for x, y in zip(a, b))


mirror = rules("mirror.yaml", "surfaces:\n  - reflect: 0.9\n  - match: { draws: 2 }\n    reflect: 0.5\n")
dull = rules("dull.yaml", "surfaces:\n  - reflect: 0\n")
light = rules("light.yaml", "lights:\n  - light: 0\n    position: [50, 50, 100, 1]\n")
both = rules(
    "both.yaml",
    "lights:\n  - light: 0\n    position: [50, 50, 100, 1]\nsurfaces:\n  - reflect: 0.9\n  - match: { draws: 2 }\n    "
    "reflect: 0.5\n"
)
typed = rules(
    "typed.yaml",
    "surfaces:\n  - match: { mesh: 0123456789 }\n    reflect: 0.9\n  - match: { lit: yes }\n    roughness: 0\n")

plain, said = rendered("plain")
check("matches" not in said, f"without rules there is no message: {said}")
shiny, said = rendered("shiny", mirror)
check(not same(plain, shiny), "the rule has an effect")
check(
    said.count(f"{mirror}: rule 2 matches 2 draws in 2 of 2 frames\n") == 1
    and said.count(f"{mirror}: rule 1 matches ") == 1 and "warning" not in said,
    f"matches of each rule, once: {said}")
lit, _ = rendered("lit", light)
whole, _ = rendered("whole", both)
for name, order in (("first", (mirror, light)), ("second", (light, mirror))):
    frames, said = rendered(name, *order)
    check(same(frames, whole) and not same(frames, lit) and not same(frames, shiny), f"both files apply, {name}")
last, _ = rendered("last", mirror, dull)
check(same(last, plain) and not same(rendered("other", dull, mirror)[0], plain), "the later rule counts")

# Together with a study's rules, before and after them.
auto, _ = rendered("auto", "auto")
mine, said = rendered("mine", "auto", mirror)
check(not same(mine, auto) and f"{mirror}: rule 2 matches" in said, f"a file after auto has an effect: {said}")
check(same(rendered("behind", mirror, dull, "auto")[0], auto), "auto applies where it is named")

# A mistyped hash.
_, said = rendered("typed", typed)
check(
    said.count(
        f"relume: warning: {typed}: surfaces, rule 1 matches nothing in 2 frames; 'relume scene --json' shows hashes "
        f"and draws\n"
    ) == 1 and f"{typed}: rule 2 matches " in said, f"a rule that matches nothing: {said}")
_, said = rendered("quiet", typed, options=("--progress", "none"))
check("rule 1 matches nothing" in said and "rule 2" not in said, f"--progress none leaves warnings: {said}")

# Every file is part of the settings that --skip-existing compares.
again = relume("render", trace, "-o", SCRATCH / "first" / "x.####.exr", "--device", "reference", "--skip-existing",
               "--dry-run", "--look", mirror, "--look", light)
check(again.stdout.count("leave") == 2, f"the same files: {again.stdout}")
again = relume("render", trace, "-o", SCRATCH / "first" / "x.####.exr", "--device", "reference", "--skip-existing",
               "--dry-run", "--look", dull, "--look", light)
check("leave" not in again.stdout, f"a different first file: {again.stdout}")
finish()
