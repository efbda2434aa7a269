#!/usr/bin/python3
"""tests/show/table.py DIR: one table of all that `make show-*` measured; exits with 1 where a bar does not hold.

Each DIR/NAME.json holds
    {"name": "parity", "command": "make show-parity",
     "rows": [{"what": "glxgears, 60 frames", "figure": "60 pass", "bar": "60 pass" or null, "peer": "Mesa 22.3.6" or null,
               "passed": true, false, or null where nothing is demanded}]}
"""
import json
import pathlib
import sys


def main(folder):
    rows = [("", "what", "figure", "bar", "peer")]
    bad = 0
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        shown = json.loads(path.read_text())
        for row in shown["rows"]:
            bad += row["passed"] is False
            mark = {True: "holds", False: "FAILS", None: "-"}[row["passed"]]
            rows.append((mark, f"{shown['name']}: {row['what']}", str(row["figure"]), str("" if row["bar"] is None else row["bar"]),
                         str(row["peer"] or "")))
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    return 1 if bad or len(rows) == 1 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
