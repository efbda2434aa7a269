#!/usr/bin/python3
"""tests/show/table.py DIR: one table of all `make show-*` measurements; exits with 1 if a bar does not hold.

Each DIR/NAME.json holds {"name": "parity", "command": "make show-parity", "rows": [{"what": "glxgears, 60 frames",
"figure": "60 pass", "bar": "60 pass" or null, "peer": "Mesa 22.3.6" or null, "passed": true, false, or null if nothing
is required}]}
"""
import json
import pathlib
import sys


class Shown:
    """The rows of show-NAME: each is printed at once, and all are written at the end."""

    def __init__(self, build, name):
        self.path, self.name, self.rows = build / "show" / f"{name}.json", name, []

    def row(self, what, figure, bar, passed, peer=None):
        self.rows.append({"what": what, "figure": figure, "bar": bar, "peer": peer, "passed": passed})
        print({True: "holds", False: "FAILS", None: "-    "}[passed], what, figure,
              *([] if bar is None else [f"(bar: {bar})"]), *([peer] if peer else []), sep="  ", flush=True)

    def finish(self):
        """The exit code."""
        self.path.parent.mkdir(exist_ok=True)
        self.path.write_text(
            json.dumps({"name": self.name, "command": f"make show-{self.name}", "rows": self.rows}, indent=1))
        return not self.rows or any(row["passed"] is False for row in self.rows)


def main(folder):
    rows = [("", "what", "figure", "bar", "peer")]
    bad = 0
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        shown = json.loads(path.read_text())
        for row in shown["rows"]:
            bad += row["passed"] is False
            mark = {True: "holds", False: "FAILS", None: "-"}[row["passed"]]
            rows.append((mark, f"{shown['name']}: {row['what']}", str(row["figure"]),
                         str("" if row["bar"] is None else row["bar"]), str(row["peer"] or "")))
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    return 1 if bad or len(rows) == 1 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
