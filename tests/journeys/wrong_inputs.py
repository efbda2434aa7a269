"""Forty wrong inputs that users make: the typed line, the exit code, and a word that the message must contain."""
import dataclasses
import os
import pathlib
import subprocess

USAGE, INPUT, SYSTEM = 2, 3, 5

# Files in the folder besides game.trace and out/, which holds three of its frames.
FILES = {
    "empty.trace": "",
    "text.trace": "this is no recording\n",
    "unknown.yaml": "surfaces:\n  - { reflekt: 0.5 }\n",
    "broken.yaml": "surfaces: [{\n",
    "range.yaml": "surfaces:\n  - { reflect: 7 }\n",
    "camera.yaml": "kind: fisheye\n",
    "diff.yaml": "rules:\n  - { mask: missing.png, colour: 3 }\n",
    "broken.cl": "struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters p) { return "
                 "no(hit); }\n",
    "ci.yaml": "programs:\n  - { comand: [./game] }\n",
}

# (text after "relume", exit code, word of the message)
CASES = (
    ("rendr game.trace -o x.png", USAGE, "did you mean 'render'"),
    ("help lok-file", USAGE, "look-file"),
    ("render game.trace", USAGE, "-o"),
    ("render -o x.png", USAGE, "one trace"),
    ("render game.trace --frmes 1 -o x.png", USAGE, "--frames"),
    ("render missing.trace -o x.####.png", INPUT, "missing.trace"),
    ("render empty.trace -o x.####.png", INPUT, "empty.trace"),
    ("render text.trace -o x.####.png", INPUT, "text.trace"),
    ("render out -o x.####.png", INPUT, "out"),
    ("render game.trace -f 99 -o x.####.png", USAGE, "3 frames"),
    ("render game.trace -f 1-x -o x.####.png", USAGE, "1-x"),
    ("render game.trace -f 5-2 -o x.####.png", USAGE, "5-2"),
    ("render game.trace -o x.png", USAGE, "####"),
    ("render game.trace -f 0 -o x.bmp", USAGE, ".png"),
    ("render game.trace -f 0 -o game.trace/x.png", SYSTEM, "game.trace"),
    ("render game.trace -f 0 --samples 0 -o x.png", USAGE, "--samples"),
    ("render game.trace -f 0 --mode raytrace -o x.png", USAGE, "whitted"),
    ("render game.trace -f 0 --device quantum -o x.png", USAGE, "relume devices"),
    ("render game.trace -f 0 --aov depth -o x.exr", USAGE, "depth"),
    ("render game.trace -f 0 --exposure 1 -o x.exr", USAGE, "--exposure"),
    ("render game.trace -f 0 --look missing.yaml -o x.png", INPUT, "missing.yaml"),
    ("render game.trace -f 0 --look unknown.yaml -o x.png", INPUT, "reflekt"),
    ("render game.trace -f 0 --look broken.yaml -o x.png", INPUT, "broken.yaml"),
    ("render game.trace -f 0 --look range.yaml -o x.png", INPUT, "reflect"),
    ("render game.trace -f 0 --camera camera.yaml -o x.png", INPUT, "fisheye"),
    ("render game.trace -f 0 --hook missing.cl -o x.png", INPUT, "missing.cl"),
    ("record -o x.trace", USAGE, "no program"),
    ("record -o x.trace -- ./no-such-game", SYSTEM, "no-such-game"),
    ("record -o x.trace -- true", SYSTEM, "OpenGL"),
    ("record -o x.trace --ref sound -- ./game", USAGE, "color"),
    ("diff game.trace", USAGE, "REF"),
    ("diff game.trace nowhere", INPUT, "nowhere"),
    ("diff game.trace out --config diff.yaml", INPUT, "colour"),
    ("diff game.trace out --effects shadow", USAGE, "shadow"),
    ("film nowhere -o x.webm", INPUT, "nowhere"),
    ("trim -f 2-9 -o x.trace game.trace", USAGE, "3 frames"),
    ("repair -o x.trace text.trace", INPUT, "text.trace"),
    ("export -f 99 -o x.glb game.trace", USAGE, "frame 99"),
    ("ci --programs ci.yaml", INPUT, "comand"),
    ("farm status out", INPUT, "is no job"),
)


@dataclasses.dataclass
class Outcome:
    typed: str
    code: int
    line: str
    faults: list  # empty if there is one line with the reason, the right exit code, and no new file


def prepare(place):
    for name, text in FILES.items():
        (place / name).write_text(text)


def try_all(relume, place, env=None):
    """Type each in a folder with game.trace, game and out/; yields an Outcome."""
    prepare(place)
    for typed, code, word in CASES:
        before = {p: p.stat().st_size for p in pathlib.Path(place).rglob("*")}
        done = subprocess.run(f"'{relume}' {typed}", shell=True, cwd=place, env=env or dict(os.environ),
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              errors="replace", timeout=100, check=False)
        lines = done.stderr.splitlines()
        after = {p: p.stat().st_size for p in pathlib.Path(place).rglob("*") if p.name != "game.trace.index"}
        faults = []
        if done.returncode != code:
            faults.append(f"exit code {done.returncode}, expected {code}")
        if len(lines) != 1 or not lines[0].startswith("relume: "):
            faults.append(f"{len(lines)} lines: {lines[:4]}")
        elif word not in lines[0]:
            faults.append(f"does not mention {word}")
        if set(after) - set(before) or any(after.get(p, size) != size for p, size in before.items()):
            faults.append(f"wrote {sorted(p.name for p in set(after) - set(before))}")
        yield Outcome(f"relume {typed}", done.returncode, lines[0] if lines else "", faults)
