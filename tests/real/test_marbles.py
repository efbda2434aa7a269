#!/usr/bin/python3
# limit: 300 s
"""The scene of `make demo`: rules turn some marbles into a mirror, glass and an area light. It passes, and clearly
differs from OpenGL's picture."""
from codes import codes
from helpers import ROOT, SCRATCH, check, check_gates, corpus, diff, finish, must, record, relume, render

LOOK = ROOT / "corpus/glx/marbles.look.yaml"
trace = SCRATCH / "marbles.trace"
record(trace, corpus("glx/marbles"), "--frames", "2", "--size", "200x150")
done = must(relume("render", trace, "-f", "0", "--look", LOOK, "-o", SCRATCH / "shown.png", timeout=300))
check("matches nothing" not in done.stderr, f"every rule matches: {done.stderr}")
frames = render(trace, SCRATCH / "frames", "--look", LOOK, "--rays", "8")
code, score = diff(trace, SCRATCH / "frames")
check(code == 0 and len(frames) == 2, f"exit code {code}, {len(frames)} frames")
check_gates(score, 2, "marbles")

must(relume("render", trace, "-f", "0", "--mode", "gl", "-o", SCRATCH / "gl.png"))
shown, drawn = codes(SCRATCH / "shown.png"), codes(SCRATCH / "gl.png")
differs = 100 * (abs(shown - drawn).max(axis=0) > 24).mean()
shaded = 100 * ((drawn - shown).min(axis=0) > 12).mean()
check(15 < differs < 60, f"{differs:.1f} % of the pixels differ visibly")
check(shaded > 3, f"{shaded:.1f} % of the pixels are in shadow")
finish()
