#!/usr/bin/python3
"""The dependency graph of the sources, derived from object files and #include lines.

usage: house.py BUILD [--root DIR]           check for cycles and for arrows that docs/architecture.md does not show
       house.py BUILD --dot                  the graph for Graphviz: files in folders, arrows between folders
       house.py BUILD --text                 the graph as docs/architecture.md shows it
       house.py BUILD --count [--json FILE]  the figures of `make show-house` with their limits

An arrow goes from a file to what it uses: a symbol that another object file defines, or a header. A folder's arrows are
those of its files. docs/architecture.md shows one line for each folder: `folder -> folders`. The check fails on a cycle
between files or folders, on an arrow missing from the document, and on a documented arrow that no file uses any more.
"""
import argparse
import collections
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys

DRAWING = "docs/architecture.md"
STAGES = ("base", "capture", "ci", "diff", "kernels", "look", "replay", "scene", "tracer", "verbs")
SOURCES = (".c", ".h", ".inc", ".cl", ".cpp")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
SHOWN = re.compile(r"^    ([\w./]+) +-> +([\w./ ]+)$", re.M)
# Generated sources belong to the folder that makes them.
GENERATED = {
    "gen/commands": "replay/machine/commands.gen", "gen/handlers": "replay/gl/handlers.gen",
    "gen/kernels": "kernels/kernels.gen", "gen/page": "diff/report/page.gen",
    "gen/surfaces": "verbs/render/surfaces.gen", "recorder/gen/thunks": "capture/gen/thunks.gen",
    "recorder/gen/tables/commands": "capture/tables/commands.gen",
    "recorder/gen/tables/enums": "capture/tables/enums.gen"
}
# {(from, to): reason}; files or folders. Each entry is an arrow that the check lets pass.
EXCEPTIONS = {}

LONG_FUNCTION = 80
SAME_LINES = 6


def sources(root):
    """Source files as paths below root, without tests and the programs to record."""
    files = [root / "relume.c"
             ] + [f for stage in STAGES for f in sorted((root / stage).rglob("*")) if f.suffix in SOURCES]
    return [f.relative_to(root).as_posix() for f in files if f.is_file()]


def unit(path):
    """A path without its suffix, so that a .c file and its .h share a name."""
    return path.rpartition(".")[0]


def folder(name):
    return os.path.dirname(name) or "relume.c"


def objects(build, known):
    """[(object file, unit, program it is linked into)]"""
    found = []
    for path in sorted(build.rglob("*.o")):
        name = path.relative_to(build).as_posix()[:-2]
        part = "recorder" if name.startswith("recorder/") else "command"
        plain = GENERATED.get(name, name.removeprefix("recorder/"))
        if plain in known or name in GENERATED:
            found.append((path, plain, part))
    return found


def symbol_arrows(build, known):
    """{unit: {unit: symbols}}: symbols that each unit uses from other object files of the same program."""
    defined, wanted = collections.defaultdict(set), []
    for path, name, part in objects(build, known):
        for line in subprocess.run(["nm", path], capture_output=True, text=True, check=True).stdout.splitlines():
            kind, symbol = line.split()[-2:]
            if kind == "U" and not symbol.startswith(("_Zn", "_Zd")):  # C++'s new and delete come from its runtime
                wanted.append((part, name, symbol))
            elif kind in "TDBRVWC":
                defined[part, symbol].add(name)
    arrows = collections.defaultdict(lambda: collections.defaultdict(set))
    for part, name, symbol in wanted:
        for other in defined[part, symbol] - {name}:
            arrows[name][other].add(symbol)
    return arrows


def include_arrows(root, files):
    """{file: {file: {"#include"}}}"""
    arrows = collections.defaultdict(lambda: collections.defaultdict(set))
    for file in files:
        for name in INCLUDE.findall((root / file).read_text(encoding="utf-8")):
            if (root / name).is_file():
                arrows[file][name].add("#include")
    return arrows


def circles(arrows):
    """Strongly connected components with more than one node (Tarjan 1972)."""
    order, low, stack, found = {}, {}, [], []

    def visit(node):
        order[node] = low[node] = len(order)
        stack.append(node)
        for other in arrows.get(node, ()):
            if other not in order:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], order[other])
        if low[node] == order[node]:
            part = [stack.pop()]
            while part[-1] != node:
                part.append(stack.pop())
            if len(part) > 1:
                found.append(sorted(part))

    sys.setrecursionlimit(10000)
    for node in sorted(arrows):
        if node not in order:
            visit(node)
    return found


def between_folders(*graphs):
    """{folder: {folder: files that draw the arrow}}"""
    arrows = collections.defaultdict(lambda: collections.defaultdict(set))
    for graph in graphs:
        for name, others in graph.items():
            for other in others:
                if folder(name) != folder(other) and (name, other) not in EXCEPTIONS:
                    arrows[folder(name)][folder(other)].add((name, other))
    return arrows


class House:
    def __init__(self, root, build):
        self.root, self.files = root, sources(root)
        self.symbols = symbol_arrows(build, {unit(f) for f in self.files})
        self.includes = include_arrows(root, self.files)
        self.folders = between_folders(self.symbols, self.includes)
        self.file_circles = circles(self.symbols) + circles(self.includes)
        self.folder_circles = circles(self.folders)

    def text(self):
        """The graph as text, a line per folder, those with the fewest dependencies first."""
        names = sorted(set(self.folders) | {o for others in self.folders.values() for o in others})
        lines, done = [], set()
        while len(done) < len(names):
            ready = [n for n in names if n not in done and set(self.folders.get(n, ())) <= done]
            for name in ready or [n for n in names if n not in done]:
                if self.folders.get(name):
                    lines.append("    %-22s -> %s" % (name, " ".join(sorted(self.folders[name]))))
                done.add(name)
        return "\n".join(lines)

    def dot(self):
        lines = ["digraph house {", "\trankdir=LR; node [shape=box]; compound=true;"]
        for name, group in itertools.groupby(sorted(self.files, key=folder), folder):
            group = list(group)
            lines.append('\tsubgraph "cluster_%s" { label="%s";' % (name, name))
            lines += ['\t\t"%s";' % file for file in group] + ["\t}"]
        first = {folder(file): file for file in reversed(sorted(self.files))}
        lines += ['\t"%s" -> "%s" [ltail="cluster_%s", lhead="cluster_%s"];' % (first[a], first[b], a, b)
                  for a in sorted(self.folders) for b in sorted(self.folders[a])]
        return "\n".join(lines + ["}"])

    def faults(self, drawing):
        """Violations, one per line. @param drawing  the text of DRAWING"""
        lines = ["circle between files: " + " ".join(part) for part in self.file_circles]
        lines += ["circle between folders: " + " ".join(part) for part in self.folder_circles]
        shown = {(a, b) for a, others in SHOWN.findall(drawing) for b in others.split()}
        there = {(a, b) for a, others in self.folders.items() for b in others}
        for a, b in sorted(there - shown):
            pair = min(self.folders[a][b])
            what = " ".join(sorted(self.symbols.get(pair[0], {}).get(pair[1], {"#include"}))[:3])
            lines.append(f"{a} -> {b} is not in {DRAWING}: {pair[0]} uses {pair[1]} ({what})")
        lines += [f"{a} -> {b} is in {DRAWING}, and nobody uses it" for a, b in sorted(shown - there)]
        return lines


def functions(text):
    """[(name, lines)] of a C file: a body begins and ends with a brace in the first column."""
    found, start, lines = [], None, text.split("\n")
    for number, line in enumerate(lines):
        if line == "{" and number and not lines[number - 1].startswith((" *", "\\")):
            start = number
            while start and lines[start - 1][:1] not in ("", "}", "#", "/") and not lines[start - 1].endswith(
                (";", "*/")):
                start -= 1
        elif line.rstrip() in ("}", "};") and start is not None:
            name = re.search(r"(\w+)\s*\(", " ".join(lines[start:start + 4]))
            found.append((name[1] if name else "?", number - start + 1))
            start = None
    return found


def significant(text):
    """[(line number, line)] of the lines that count: no comments, lone braces or includes."""
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m[0].count("\n"), text, flags=re.S)
    lines = [(n, " ".join(line.split("//")[0].split())) for n, line in enumerate(text.split("\n"), 1)]
    return [(n, line) for n, line in lines if re.search(r"\w", line) and not line.startswith("#include")]


def repeated(root, files):
    """Pairs of places that share SAME_LINES consecutive lines; a longer match is one pair."""
    places = collections.defaultdict(list)
    for file in files:
        lines = significant((root / file).read_text(encoding="utf-8"))
        for i in range(len(lines) - SAME_LINES + 1):
            places["\n".join(line for _, line in lines[i:i + SAME_LINES])].append((file, i))
    pairs = {(a, b) for where in places.values() for a, b in itertools.combinations(where, 2)}
    return sorted((a, b) for a, b in pairs if ((a[0], a[1] - 1), (b[0], b[1] - 1)) not in pairs)


def counts(house):
    """[(name, figure, bar, detail)]; bar is the largest figure allowed, or None if the figure is only reported"""
    root, files = house.root, house.files
    text = {file: (root / file).read_text(encoding="utf-8") for file in files}
    headers = {f: t.count("\n") for f, t in text.items() if f.endswith(".h")}
    users = collections.Counter(other for others in house.includes.values() for other in others)
    largest = max(headers, key=headers.get)
    common = max((h for h in headers if not h.startswith("base/")), key=lambda h: users[h])
    lengths = [(n, f"{f}:{name}") for f in files for name, n in functions(text[f]) if n > LONG_FUNCTION]
    loops = [f for f in files for _ in re.findall(r"\bgetopt_long\(", re.sub(r"/\*.*?\*/", "", text[f], flags=re.S))]
    tracked = subprocess.run(["git", "-C", root, "ls-files", ":!tests"], capture_output=True, text=True,
                             check=True).stdout.split("\n")
    texts = ((root / f).read_bytes() for f in tracked if f and (root / f).is_file())
    lines = sum(text.count(b"\n") for text in texts if b"\0" not in text)  # pictures have no lines
    same = repeated(root, files)
    return [("circles between files", len(house.file_circles), 0, "; ".join(" ".join(c) for c in house.file_circles)),
            ("circles between folders", len(house.folder_circles), 0, "; ".join(" ".join(c)
                                                                                for c in house.folder_circles)),
            ("lines of the largest header", headers[largest], None, largest),
            ("files that include that one", users[largest], None, ""),
            ("files that include the commonest header of a stage", users[common], None, common),
            ("functions over %d lines" % LONG_FUNCTION, len(lengths), 0,
             ", ".join(name for _, name in sorted(lengths, reverse=True))), ("lines outside tests", lines, None, ""),
            ("loops over getopt_long", len(loops), 1, " ".join(loops)),
            ("pairs of places with the same %d lines" % SAME_LINES, len(same), None,
             ", ".join(sorted({f"{a[0]} ~ {b[0]}" for a, b in same})))]


def show(rows, out):
    held = all(bar is None or figure <= bar for _, figure, bar, _ in rows)
    for name, figure, bar, detail in rows:
        print("%-52s %7d  %s%s" %
              (name, figure, "" if bar is None else f"(at most {bar})", "  " + detail[:300] if detail else ""))
    if out:
        table = [{
            "what": name, "figure": figure, "bar": bar, "peer": None, "passed": None if bar is None else figure <= bar
        } for name, figure, bar, _ in rows]
        pathlib.Path(out).parent.mkdir(parents=True, exist_ok=True)
        pathlib.Path(out).write_text(
            json.dumps({"name": "house", "command": "make show-house", "rows": table}, indent=1))
    return 0 if held else 1


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    for what in ("dot", "text", "count"):
        parser.add_argument("--" + what, action="store_true")
    parser.add_argument("--json")
    args = parser.parse_args()
    house = House(args.root, args.build)
    if args.dot or args.text:
        print(house.dot() if args.dot else house.text())
        return 0
    if args.count:
        return show(counts(house), args.json)
    faults = house.faults((args.root / DRAWING).read_text(encoding="utf-8"))
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
