#!/usr/bin/python3
"""Roles and lights are stored in a frame rendered under rules, and the report shows them on a page: each with reason,
confidence and picture."""
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from helpers import SCRATCH, check, corpus, finish, record, relume, render  # noqa: E402

trace = SCRATCH / "tricks.trace"
record(trace, corpus("tricks"), "planar", "--frames", 3)


def findings(*look):
    """The report page's data about a frame, and the roles that have pictures."""
    frames, report = SCRATCH / f"frames{len(look)}", SCRATCH / f"report{len(look)}"
    render(trace, frames, "-f", 2, *look)
    relume("diff", trace, frames, "-f", 2, "--report", report)
    page = json.loads(
        re.search(r'<script type="application/json" id="p2">(.*?)</script>', (report / "index.html").read_text(),
                  re.S)[1])
    return [page[key]
            for key in sorted(page)
            if key.startswith("finding ")], [key for key in page if key.startswith("role ")]


says, pictures = findings("--look", "auto")
roles = {(kind, role): (float(confidence), why) for kind, role, confidence, why in says}
check(("surface", "planar shadow") in roles and ("light", "light of a planar shadow") in roles,
      f"the shadow and its light are listed: {says}")
check(all(0 < confidence <= 1 and why for confidence, why in roles.values()),
      f"each with confidence and reason: {says}")
check(len(pictures) >= 2, f"the shadow and its light have pictures: {pictures}")
check(findings() == ([], []), "a frame rendered without rules has none")
finish()
