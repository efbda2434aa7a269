#!/usr/bin/python3
# limit: 300 s
"""A CI engineer: a new program is approved; an unchanged run; then a change that must be reported, with its place."""
import re
import xml.etree.ElementTree

from journey import PLACE, begin, check, end, seen, typed

begin("cornell", 3)
(PLACE / "relume-ci.yaml").write_text("programs:\n  - { command: [./game], frames: 2 }\n")
typed("xvfb-run -a relume ci", code=4, says="new")
typed("relume approve --reason 'first version' ci/game/frames approved/game", says="2 new")
typed("xvfb-run -a relume ci", says="2 passed")
(PLACE / "relume-ci.yaml").write_text("programs:\n  - { name: game, command: [./game, --mirror], frames: 2 }\n")
typed("xvfb-run -a relume ci", code=1, says="2 failed")

cases = list(xml.etree.ElementTree.parse(PLACE / "ci/game/junit.xml").getroot().iter("testcase"))
check(len(cases) == 2 and all(c.find("failure") is not None for c in cases), f"junit.xml fails {len(cases)} cases")
check(re.search(r"2 failed", (PLACE / "ci/game/summary.md").read_text()), "the summary reports the failure")
check(
    "<svg" in (PLACE / "ci/game/report/index.html").read_text()
    or "data:image" in (PLACE / "ci/game/report/index.html").read_text(), "the page contains pictures")
seen("ci/game/report/sheet.png")
end()
