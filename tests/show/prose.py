#!/usr/bin/python3
"""tests/show/prose.py BUILD (as `make show-words`): by folder, how often comments, messages and documents have habits
that make them read as translated (tests/words.py), beside the number that tests/words.txt allows. ONLY=look counts one
folder."""
import argparse
import collections
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "tests/show"), str(ROOT / "tests")]
import words  # noqa: E402
from table import Shown  # noqa: E402


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", help="one folder")
    args = parser.parse_args()
    files, bars = words.sources(ROOT), words.allowed(ROOT)
    found = {key: len(where) for key, where in words.places(ROOT, files).items()}
    counted = collections.Counter(words.folder_of(file) for file in files)
    shown = Shown(args.build, "words")
    for folder, n in sorted(counted.items()):
        if args.only not in (None, folder):
            continue
        habits = {habit: count for (habit, there), count in found.items() if there == folder}
        most = sum(bar for (_, there), bar in bars.items() if there == folder)
        over = [habit for habit, count in habits.items() if count > bars.get((habit, folder), 0)]
        where = "the top folder" if folder == "." else folder
        shown.row(f"{where}: {n} files", f"{sum(habits.values())} places", f"<= {most}", not over,
                  ", ".join(over) or None)
    if not args.only:
        shown.row(f"all: {sum(counted.values())} files, {len(words.HABITS)} habits", f"{sum(found.values())} places",
                  f"<= {sum(bars.values())}", sum(found.values()) <= sum(bars.values()))
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main())
