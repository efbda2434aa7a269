#!/usr/bin/python3
# limit: 300 s
"""Objects spared as light blockers are decided once per recording. corpus/arena --by ball has a lantern at the edge of
the lit world, and a lit ball in every third frame. In single frames, the lantern casts a shadow on the figure only
while the ball is there."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from exr import Image  # noqa: E402
from helpers import SCRATCH, check, corpus, finish, must, record, relume, render  # noqa: E402

FRAMES = 4
trace, rules = SCRATCH / "arena.trace", SCRATCH / "arena.look.yaml"
record(trace, corpus("arena"), "--frames", FRAMES, "--size", "400x300", "--by", "ball", options=())


def shadows(name, *look):
    """Remaining light where the lantern's shadow may fall on the figure, frame by frame."""
    shares = []
    for picture in sorted(render(trace, SCRATCH / name, "-f", f"0-{FRAMES - 1}", *look)):
        rows = Image(picture, {"shadow.G"}).planes["shadow.G"][136:178]
        shares.append(sum(sum(row[195:230]) for row in rows) / (42 * 35))
    return shares


must(relume("look", trace, "-o", rules))
text = rules.read_text()
check("role: spared" in text and "match: { lit: no }\n    passes: suns" in text,
      f"the rules list spared objects: {text}")
alone, once = shadows("alone"), shadows("once", "--look", "auto")
check(abs(alone[2] - alone[1]) > 0.1, f"in single frames the shadow comes and goes: {alone}")
check(max(once) - min(once) < 0.005, f"rules of the whole recording keep it constant: {once}")

# The file decides: `spare: no`, and objects named to let light pass.
rules.write_text("spare: no\n" + text)
sealed = shadows("sealed", "--look", rules)
check(max(sealed) < min(once) - 0.1, f"with spare: no walls and lantern stop the light: {sealed}, {once}")
rules.write_text("surfaces:\n  - match: { lit: no, textured: no }\n    passes: none\n")
stopped = shadows("stopped", "--look", rules)
check(
    max(stopped) - min(stopped) < 0.005 and max(stopped) < min(once) - 0.1,
    f"a lantern that lets no light pass casts its shadow in each frame: {stopped}")
rules.write_text("surfaces:\n  - passes: most\n")
done = relume("render", trace, "-f", 1, "-o", SCRATCH / "x.####.exr", "--look", rules)
check(done.returncode == 3 and len(done.stderr.strip().splitlines()) == 1 and "passes" in done.stderr,
      f"{done.returncode} {done.stderr}")
finish()
