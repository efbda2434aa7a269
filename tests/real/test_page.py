#!/usr/bin/python3
"""The report's page with 1,000 frames in a browser: list, chart, filters, keys, views, zoom, the pixel under the pointer (show/operate.js)."""
import shutil
import sys

from helpers import ROOT, SCRATCH, check, finish, relume, skip

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import browser  # noqa: E402
import numpy  # noqa: E402
from exr_numpy import write_png  # noqa: E402

N_FRAMES, EVERY = 1000, 5  # one of five frames is damaged
SIDE = ["reference", "compared", "difference", "flip"]
WANTED = {
    "errors": [], "opened": 995, "frames": N_FRAMES, "order": [0, 5, 10], "about": "ref; 1000 frames", "zooms": "0.5 x1 x2 x4 x8 x",
    "verdict": "not passed, failed", "counts": "800 passed200 failed", "bars": N_FRAMES,
    "bar": [0, 90, 50, "0.86"],  # fidelity 0.9583 on a floor of 0.9, of 86
    "chart": "the floor of the chart is 90 %, its top 100 %", "heading": "frame 995 failed fidelity 95.833 %", "in_sight": True, "corner": "x 0  y 0   raster (reference) 0 90 30   beauty 0 90 30",
    "outside": "x -1  y 0",
    "row": "0|failed|R1 R3 R4 P", "gate": "4.16667 %|<= 0.1 %|failed", "approve": "relume approve -f 995 run", "outcomes": ["", "passed", "failed"],
    "clicked": [0, "#0", 1], "thumbnails": ["data:image/", ""], "before_first": 0, "next": 5, "after": 10, "back": 0, "bar_clicked": 1, "after_last": True, "typed": True,
    "focus": "filter", "by_number": [1, 999], "by_gate": [200, 200, 0], "among_filtered": 5, "by_draw": 0, "nothing": 0, "all_again": N_FRAMES, "passed": [800, "100 %"],
    "failed": 200, "both": 38, "all": [*SIDE, "failing"], "side": SIDE, "pressed": ["side by side"], "blink": ["raster (reference)", "reference"],
    "blinked": ["beauty", "compared"], "blinked_back": "reference", "swipe": [SIDE[:2], "left raster (reference), right beauty", "inset(0px 0px 0px 50%)"], "wide": [1, "absolute"],
    "swiped": ["inset(0px 0px 0px 25%)", 25], "slid": "inset(0px 0px 0px 80%)", "other": [["reference", "failing"], "failing"], "other_a": ["compared", "failing"],
    "button": 4, "timer_ended": 4, "roles": SIDE, "zoom": [1, 2, 4, 8, 8, 8, 4, 2, 1, 0.5, 0.5, 1], "scaling": "pixelated", "scaling_small": "auto", "chosen": [4, 4],
    "pixel": "x 3  y 2   raster (reference) 0 90 30   beauty 250 40 200",
}

if not shutil.which(browser.NAME):
    skip(f"no {browser.NAME} here: the report's page is not operated")
for side in ("ref", "run"):
    (SCRATCH / side).mkdir()
for frame in range(N_FRAMES):
    codes = numpy.full((16, 24, 3), (frame % 250, 90, 30), "u1")
    write_png(SCRATCH / "ref" / f"p.{frame:04}.png", codes)
    if frame % EVERY == 0:
        codes[2:6, 3:7] = (250, 40, 200)
    write_png(SCRATCH / "run" / f"p.{frame:04}.png", codes)
done = relume("diff", "ref", "run", "--report", "report", cwd=SCRATCH)
check(done.returncode == 1, f"diff: exit code {done.returncode}: {done.stderr[-500:]}")
found = browser.operate(SCRATCH, SCRATCH / "report", "#995") or {}
for name, value in WANTED.items():
    check(found.get(name) == value, f"{name}: {found.get(name)} instead of {value}")
finish()
