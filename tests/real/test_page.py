#!/usr/bin/python3
# limit: 600 s
"""The report's page in a browser (show/operate.js). With 1,000 frames: list, chart, filters, keys, views, zoom, the
pixel under the pointer. With a baseline: the approved frame beside the present one. Both also on a screen 390 pixels
wide.
"""
import base64
import json
import re
import shutil
import sys

from codes import whole_codes
from helpers import ROOT, SCRATCH, check, corpus, finish, must, record, relume, render, skip

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import browser  # noqa: E402
import numpy  # noqa: E402
import exr_numpy  # noqa: E402
from exr_numpy import write_png  # noqa: E402

N_FRAMES, EVERY = 1000, 5  # one frame in five is damaged
SIDE = ["reference", "compared", "difference", "flip"]
WANTED = {
    "errors": [],
    "opened": 995,
    "shown_at_first": [200, "not passed"],
    "title": "run: not passed - relume diff",
    "verdicts": [
        "failed: Not as the reference: R1 interior colour, R3 gross errors, R4 silhouette, P perceptual; fidelity "
        "95.833 %"
    ],
    "frames": N_FRAMES,
    "order": [0, 5, 10],
    "about": "ref; 1000 frames",
    "zooms": "0.5 x1 x2 x4 x8 x",
    "verdict": "not passed, failed",
    "counts": "800 passed200 failed",
    "bars": N_FRAMES,
    "bar": [0, 90, 50, "0.86"],  # fidelity 0.9583 with the axis from 0.9, and a height of 86
    "chart": "the floor of the chart is 90 %, its top 100 %",
    "heading": "frame 995 failed fidelity 95.833 %",
    "in_sight": True,
    "corner": "x 0  y 0   raster (reference) 0 90 30   beauty 0 90 30",
    "outside": "x -1  y 0",
    "row": "0|failed|R1 R3 R4 P",
    "gate": "4.16667 %|<= 0.1 %|failed",
    "approve": "relume approve -f 995 run",
    "outcomes": ["", "not passed", "passed", "failed"],
    "nothing_chosen": ["", True],
    "chosen": ["relume approve -f 5", True, False],
    "chosen_by_key": ["relume approve -f 0,5", 2],
    "chosen_all": [True, "0-999"],
    "dropped": 200,
    "chosen_none": "",
    "line": ["50%", True],
    "line_moved": "25%",
    "clicked": [0, "#0", 1],
    "thumbnails": ["data:image/", ""],
    "before_first": 0,
    "next": 5,
    "after": 10,
    "back": 0,
    "bar_clicked": 1,
    "after_last": True,
    "typed": True,
    "focus": "filter",
    "by_number": [1, 999],
    "by_gate": [200, 200, 0],
    "among_filtered": 5,
    "by_draw": 0,
    "nothing": 0,
    "all_again": N_FRAMES,
    "passed": [800, "100 %"],
    "failed": 200,
    "both": 38,
    "all": [*SIDE, "failing"],
    "side": SIDE,
    "pressed": ["side by side"],
    "blink": ["raster (reference)", "reference"],
    "blinked": ["beauty", "compared"],
    "blinked_back": "reference",
    "swipe": [SIDE[:2], "left raster (reference), right beauty", "inset(0px 0px 0px 50%)"],
    "wide": [1, "absolute"],
    "swiped": ["inset(0px 0px 0px 25%)", 25],
    "slid": "inset(0px 0px 0px 80%)",
    "other": [["reference", "failing"], "failing"],
    "other_a": ["compared", "failing"],
    "button": 4,
    "timer_ended": 4,
    "roles": SIDE,
    "zoom": [1, 2, 4, 8, 8, 8, 4, 2, 1, 0.5, 0.5, 1],
    "scaling": "pixelated",
    "scaling_small": "auto",
    "chosen": [4, 4],
    "pixel": "x 3  y 2   raster (reference) 0 90 30   beauty 250 40 200",
}

if not shutil.which(browser.NAME):
    skip(f"no {browser.NAME} here: the report's page was not tested")
for side in ("ref", "run"):
    (SCRATCH / side).mkdir()
for frame in range(N_FRAMES):
    codes = numpy.full((16, 24, 3), (frame % 250, 90, 30), "u1")
    write_png(SCRATCH / "ref" / f"p.{frame:04}.png", codes)
    if frame % EVERY == 0:
        codes[2:6, 3:7] = (250, 40, 200)
    write_png(SCRATCH / "run" / f"p.{frame:04}.png", codes)
done = relume("diff", "ref", "run", "--report", "report", cwd=SCRATCH, timeout=400)
check(done.returncode == 1, f"diff: exit code {done.returncode}: {done.stderr[-500:]}")
found = browser.operate(SCRATCH, SCRATCH / "report", "#995") or {}
for name, value in WANTED.items():
    check(found.get(name) == value, f"{name}: {found.get(name)} instead of {value}")

# --- With a baseline: frames 1 and 2 of 4 have changed --------------------------------------------------------------

PATCH = (slice(10, 30), slice(40, 60))
trace, approved = SCRATCH / "a.trace", SCRATCH / "approved"
record(trace, corpus("still_life"), "--frames", "4", "--size", "96x64")
frames = render(trace, SCRATCH / "frames")
must(relume("approve", SCRATCH / "frames", approved))
for path in frames[1:3]:
    image = exr_numpy.Image(path)
    for channel in ("R", "reflect.R"):  # all light channels together
        if channel in image.planes:
            image.planes[channel][PATCH] += image.planes[channel].dtype.type(0.5)
    exr_numpy.write(path, image)
done = relume("diff", "--all", "--baseline", approved, trace, SCRATCH / "frames", "--report", SCRATCH / "changed",
              "--markdown", SCRATCH / "changed.md")
check(done.returncode == 1, f"diff of changed frames: exit code {done.returncode}: {done.stderr[-500:]}")
found = browser.operate(SCRATCH, SCRATCH / "changed") or {}
NOW = ["approved", "beauty"]
for name, value in {
        "errors": [], "opened": 1, "shown_at_first": [2, "not passed"], "counts": "2 passed2 failed",
        "heading": "frame 1 failed", "side": [*NOW, "change"],
        "swipe": [NOW, "left approved, right now (beauty)",
                  "inset(0px 0px 0px 50%)"], "blink": ["approved", "approved"], "blinked": ["now (beauty)", "beauty"],
        "blinked_back": "approved", "passed": [2, "100 %"]
}.items():
    check(found.get(name) == value, f"with a baseline: {name}: {found.get(name)} instead of {value}")
check({"approved", "change", "changed", "reference", "compared", "beauty", "difference"} <= set(found.get("all", [])),
      f"all channels: {found.get('all')}")
verdicts = found.get("verdicts", ["", ""])
check(
    verdicts[0].startswith("failed: Not as approved: pixels off from the approved frame 6.5")
    and "R reflect.R" in verdicts[0] or "hashes: R" in verdicts[0], f"the failed comparison: {verdicts}")
check(verdicts[1] == "passed: As the reference, fidelity 100 %.", f"the passed comparison: {verdicts}")
page = (SCRATCH / "changed/index.html").read_text()


def picture_of(frame, name):
    block = json.loads(re.search(rf'id="p{frame}">(.*?)</script>', page, re.S)[1])
    (SCRATCH / "one.png").write_bytes(base64.b64decode(block[name].partition(",")[2]))
    return whole_codes(SCRATCH / "one.png").astype(int)


change, marks = picture_of(1, "change"), picture_of(1, "changed")
red = (marks == (255, 40, 30)).all(2)
check(red[PATCH].all() and red.sum() == 400, f"the marks cover the patch: {red.sum()} pixels, {red[PATCH].sum()} in it")
check((change[PATCH][:, :, 0] > 100).all() and change[red == 0].max() == 0,
      "the difference shows the patch, and nothing else")
check((abs(picture_of(1, "approved") - picture_of(1, "beauty")).max(2) > 0).sum() == 400,
      "the approved frame differs")
check((picture_of(1, "blame 0") == (255, 40, 30)).all(2).any(), "the blamed draw's picture shows the failing pixels")
check("approved" not in re.search(r'id="p0">(.*?)</script>', page, re.S)[1],
      "an approved frame has no second picture")
sheet = whole_codes(SCRATCH / "changed/sheet.png").astype(int)
check(sheet.shape[1] == 8 + 3 * (96 + 8), f"the sheet's columns are approved, now, difference: {sheet.shape}")
text = (SCRATCH / "changed.md").read_text()
check("| 1-2 | failed | not as approved: " in text,
      f"Markdown names the failed comparison, once for both frames:\n{text}")

# --- On a narrow screen ---------------------------------------------------------------------------------------------

for report in ("report", "changed"):
    found = browser.narrow(SCRATCH, SCRATCH / report, 390) or {}
    check(
        len(found) == 4 and all(inner == 390 >= wide for inner, wide in found.values()),
        f"{report} on a screen of 390 pixels: {found}")

# --- Accessibility: low vision, screen readers, keyboard; and print -------------------------------------------------

for scheme in ("light", "dark"):
    found = browser.accessible(SCRATCH, SCRATCH / "changed", scheme) or {}
    check(found.get("wrong") == [], f"accessible, {scheme}: {found}")
found = browser.printed(SCRATCH, SCRATCH / "changed") or {}
check(
    found == {
        "shown": sorted(["H1", "H2", "IMG", "TABLE", "chart", "verdicts"]), "wide": False, "back": "rgb(255, 255, 255)"
    }, f"printed: {found}")
finish()
