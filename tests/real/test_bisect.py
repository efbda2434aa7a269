#!/usr/bin/python3
"""relume bisect: two recordings of a program with one change diverge at that call, and nowhere else."""
import re
import tempfile

from helpers import BUILD, RELUME, SCRATCH, check, finish, must, on_display, pathlib, relume

# change: first differing call in either recording; frame; the state reported; first frame whose picture differs. None:
# no difference.
CASES = {
    "nothing": None,
    "numbers": None,
    "query": None,
    "argument": ("glBlendFunc(sfactor = GL_ONE, dfactor = GL_ZERO)", "glBlendFunc(sfactor = GL_ONE, dfactor = GL_ONE)",
                 1, "color.dst_rgb: 0, 1", 1),
    "inserted": ("nothing", "glEnable(cap = GL_LIGHTING)", 3, "lighting.enabled: 0, 1", 3),
    "removed": ("glEnable(cap = GL_TEXTURE_2D)", "nothing", 2, "texturing.units[0].enabled: 2, 0", 2),
    "texture": ("glBindTexture(target = GL_TEXTURE_2D, texture = 2)",
                "glBindTexture(target = GL_TEXTURE_2D, texture = 1)", 4, "bound", 4),
    "frame": ("nothing", "glClearColor(", 2, "calls more", None),
    "texel": ("glTexImage2D(", "glTexImage2D(", 0, "differs in  pixels", 0),
    "list": ("glVertex2f(x = 0, y = 1)", "glVertex2f(x = 0.5, y = 1)", 0, "a display list", 0),
    "array": ("glVertexPointer(", "glVertexPointer(", 3, "vertex arrays", 3),
    "matrix": ("glRotatef(angle = 35", "glRotatef(angle = 40", 5, "modelview: ", 5),
    "last": ("glClearColor(red = 0, green = 0, blue = 0.5", "glClearColor(red = 0, green = 0, blue = 1", 5,
             "color.clear: ", 5),
}
SIDE = re.compile(r"^    (good|bad) +(?:(\d+) )?(.*) \(frame (\d+)\)$", re.M)


def sides(text):
    return {side: (what, int(frame)) for side, _, what, frame in SIDE.findall(text.split("\nthen at")[0])}


with tempfile.TemporaryDirectory(dir=SCRATCH) as folder:
    out = pathlib.Path(folder)
    each = f"for i in {' '.join(CASES)}; do '{RELUME}' record -o \"$i.trace\" -- '{BUILD}/tests/real/parting' $i || exit 1; done"
    must(on_display("sh", "-c", each, cwd=out))
    good = out / "nothing.trace"
    for what, wanted in CASES.items():
        done = relume("bisect", good, out / f"{what}.trace")
        if wanted is None:
            check(done.returncode == 0 and "they are the same" in done.stdout,
                  f"{what}: exit code {done.returncode}: {done.stdout}{done.stderr}")
            continue
        a, b, frame, beside, seen = wanted
        found = sides(done.stdout)
        check(done.returncode == 1, f"{what}: exit code {done.returncode}: {done.stderr}")
        check(found["good"][0].startswith(a) and found["bad"][0].startswith(b), f"{what}: the call: {done.stdout}")
        check(found["bad"][1] == frame, f"{what}: frame {frame}: {found}")
        check(beside in done.stdout and "then at" not in done.stdout, f"{what}: the changed state, once: {done.stdout}")
        check(f"frame {seen} of good" in done.stdout or (seen is None and "the same in all 4" in done.stdout),
              f"{what}: its picture: {done.stdout}")

    done = relume("bisect", good, out / "query.trace", "--all", "--by", "pictures")
    check(done.returncode == 0 and "glGetError" in done.stdout and "changes nothing of the state" in done.stdout,
          f"--all --by pictures: {done.stdout}")
    done = relume("bisect", good, out / "matrix.trace", "--ignore", "glMul*,glRot*", "--pictures", "0")
    check(done.returncode == 0, f"--ignore: {done.stdout}")
    done = relume("bisect", out / "query.trace", out / "last.trace", "--by", "pictures", "--report", out / "report")
    page = (out / "report/index.html").read_text()
    check(done.returncode == 1 and "glClearColor(red = 0" in page and "good.png" in page,
          f"the page: {done.stdout}{done.stderr}")
    check(all((out / "report" / f"{name}.png").stat().st_size > 100 for name in ("good", "bad", "difference")),
          "its pictures")
    check(
        relume("bisect", good, out / "argument.trace", "--by", "pictures", "-p", "0").returncode == 125,
        "without pictures there is no verdict")
    check(relume("bisect", good, out / "missing.trace").returncode == 125, "no such recording")
    (out / "cut.trace").write_bytes(good.read_bytes()[:300])
    check(relume("bisect", good, out / "cut.trace").returncode in (1, 125), "a truncated recording")
    check(relume("bisect", good).returncode == 2, "one recording cannot be compared")
finish()
