#!/usr/bin/python3
"""Count habits that make comments and messages read as translated; no folder may gain any.

usage: words.py [--root DIR]            fail where a count exceeds that in tests/words.txt, and list the new places
       words.py --update                write the present counts to tests/words.txt
       words.py --list [FOLDER ...]     list every place, in these folders or in all
"""
import argparse
import bisect
import collections
import os
import pathlib
import re
import subprocess
import sys

BARS = "tests/words.txt"
SUFFIXES = (".c", ".h", ".cl", ".py", ".md")
# Kept inputs, and two files that quote the habits.
SKIPPED = ("build/", "tests/fuzz/kept/", "tests/words.py", "tests/unit/test_words.py")
PREPOSITIONS = "after|at|before|by|for|from|on|over|through|to|under|upon|with|within|without"

# (habit, expression, reason, better form). "^" is the start of a comment, message or paragraph.
HABITS = [(name, re.compile(text.replace(" ", r"\s+"), re.I), reason, better) for name, text, reason, better in (
    ("begins-what", r"^What(ever)?\b", "a clause instead of the thing", "name the thing: 'Files that ...'"),
    ("begins-of", r"^Of\b", "the subject comes last", "put the subject first: 'The largest of ...'"),
    ("begins-where", r"^Where(ver)?\b", "the condition comes before the fact", "'Offset of ...', or 'If ...'"),
    ("whence", r"\b(whence|whither|wherein|whereof|thereof|therein|thereupon)\b", "archaic", "where, from, of it"),
    ("such-that", r"\bsuch that\b", "a mathematician's so", "so that, or 'that' alone"),
    ("of-which", r"\bof which\b", "a relative clause too many", "whose, or a sentence of its own"),
    ("in-which", r"\bin which\b", "a relative clause too many", "where, when, or 'that'"),
    ("prep-which", rf"\b({PREPOSITIONS}) which\b", "a relative clause too many", "'that it starts at'"),
    ("stands", r"\b(stands?|stood)\b(?! (alone|for|in for|still)\b|-in)", "nothing stands in a program",
     "is, appears, precedes"),
    ("told", r"\b(un)?told\b", "programs report", "reported, printed, passed"),
    ("do-without", r"\b(do|does|did|done|doing) without\b", "vague", "omit, does not need"),
    ("goes-by", r"\b(go|goes|going|went|gone) by\b", "vague", "depends on, is ordered by"),
    ("so-many", r"\b(so|that) (many|much)\b(?! (as|that)\b)", "the number is elsewhere", "name it: 'n bytes'"),
    ("by-itself", r"\bby (itself|themselves)\b", "alone, or automatic?", "alone, separately, automatically"),
    ("is-of", r"\b(is|are|was|were|be|been) of (?!no\b|little\b|use\b)", "turned round", "has, belongs to, 'is 4 x 4'"),
    ("anew", r"\banew\b", "archaic", "again, or rebuild, reread, restart"),
    ("otherwise", r"\b(made|rendered|done|drawn|built|set|is|are|was|were) otherwise\b", "than what?", "differs"),
    ("parts", r"\b(frames?|recordings?|runs?|traces?|pixels|images|calls|two|both|they|who) (part|parted)\b",
     "a literary verb", "diverge, differ"),
    ("so-do", r"\bso (do|does|did) (?!not\b)", "inverted", "repeat the verb, or 'and'"),
    ("latter", r"\bthe (latter|former)\b", "makes the reader look back", "repeat the noun"),
)]

STRING = r'"(?:\\.|[^"\\\n])*"'
STRINGS = rf"{STRING}(?:\s*{STRING})*"
C_PROSE = re.compile(rf"/\*.*?\*/|(?<!:)//[^\n]*(?:\n[ \t]*//[^\n]*)*|{STRINGS}|'(?:\\.|[^'\\\n])+'", re.S)
PY_PROSE = re.compile(rf'"""(?:\\.|.)*?"""|{STRINGS}|'
                      r"'(?:\\.|[^'\\\n])*'|#[^\n]*(?:\n[ \t]*#[^\n]*)*", re.S)
MD_PROSE = re.compile(r"^```.*?^```|^(?:(?!```)[^\n]+\n?(?![-*#|`]|\d+\.))+", re.S | re.M)
MARKS = re.compile(r'\A(?:/\*+|//+|#+|"+|[-*>|]+)|"\s*"|(?<=\n)[ \t]*(?:\*+(?!/)|//+|#+|>)|`[^`\n]*`')


def blank(match):
    return re.sub(r"[^\n]", " ", match[0])


def passages(name, text):
    """(offset, prose) of each comment, string literal of several words, or paragraph; marks become spaces."""
    prose = {".py": PY_PROSE, ".md": MD_PROSE}.get(pathlib.PurePath(name).suffix, C_PROSE)
    for match in prose.finditer(text):
        raw = match[0]
        if raw.startswith("```") or raw[0] in "\"'" and raw.count(" ") < 2:
            continue
        clean = MARKS.sub(blank, raw)
        # A literal that begins with a space continues a sentence.
        start = 1 if raw[:2] in ('" ', "' ") else len(clean) - len(clean.lstrip())
        yield match.start() + start, clean[start:]


def folder_of(file):
    return file.partition("/")[0] if "/" in file else "."


def allowed(root):
    """{(habit, folder): the number of places that BARS allows}"""
    rows = [line.split() for line in (root / BARS).read_text().splitlines() if line[:1] != "#"]
    return {(habit, folder): int(count) for habit, folder, count in rows}


def places(root, files):
    """{(habit, folder): [(file, line)]}"""
    found = collections.defaultdict(list)
    for file in files:
        text = (root / file).read_text(encoding="utf-8", errors="replace")
        ends = [m.start() for m in re.finditer("\n", text)]
        for offset, prose in passages(file, text):
            for habit, expression, _, _ in HABITS:
                for match in expression.finditer(prose):
                    line = bisect.bisect_left(ends, offset + match.start()) + 1
                    found[habit, folder_of(file)].append((file, line))
    return found


def git(root, *words):
    run = subprocess.run(["git", "-C", root, *words], capture_output=True, text=True, errors="replace")
    return run.stdout if run.returncode == 0 else ""


def sources(root):
    """Files to read: those git knows or would add, or, in an unpacked release, all."""
    names = git(root, "ls-files", "-co", "--exclude-standard").split("\n") if (root / ".git").exists() else \
        [os.path.relpath(os.path.join(path, name), root) for path, _, names in os.walk(root) for name in names]
    return sorted(n for n in set(names) if n.endswith(SUFFIXES) and not n.startswith(SKIPPED) and (root / n).is_file())


def added_lines(root):
    """{(file, line)} added since the last commit of BARS; empty without git."""
    base = git(root, "log", "-1", "--format=%H", "--", BARS).strip()
    added, file = set(), None
    for line in git(root, "diff", "-U0", "--no-ext-diff", base).split("\n") if base else ():
        if line.startswith("+++ b/"):
            file = line[6:]
        elif hunk := re.match(r"@@ \S+ \+(\d+)(?:,(\d+))? @@", line):
            added |= {(file, int(hunk[1]) + i) for i in range(int(hunk[2] or 1))}
    new = [f for f in git(root, "ls-files", "-o", "--exclude-standard").split("\n") if f.endswith(SUFFIXES)]
    return added | {(f, n) for f in new for n in range(1, (root / f).read_bytes().count(b"\n") + 2)}


def faults(root):
    """(faults, notes), a line each."""
    bars, found, added, wrong = allowed(root), places(root, sources(root)), added_lines(root), []
    for habit, _, reason, better in HABITS:
        for (name, folder), where in sorted(found.items()):
            if name == habit and len(where) > (bar := bars.get((name, folder), 0)):
                wrong.append(f"{folder}: {habit} {len(where)} times, at most {bar} ({reason}; better: {better})")
                wrong += [f"  {file}:{line}" for file, line in [p for p in where if p in added] or where]
    low = [f"{folder}: {habit} {len(found[habit, folder])} times, {bar} in {BARS}"
           for (habit, folder), bar in sorted(bars.items()) if len(found[habit, folder]) < bar]
    return wrong, low + [f"lower them with {BARS[:-4]}.py --update"] if low else low


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--list", nargs="*", metavar="FOLDER")
    args = parser.parse_args()
    if args.list is None and not args.update:
        wrong, notes = faults(args.root)
        print("\n".join(wrong + notes))
        return 1 if wrong else 0
    found = sorted(places(args.root, sources(args.root)).items())
    if args.update:
        rows = [f"{habit} {folder} {len(where)}" for (habit, folder), where in found]
        text = "\n".join(["# habit folder count, written by tests/words.py --update", *rows])
        (args.root / BARS).write_text(text + "\n", encoding="utf-8")
    else:
        shown = [row for row in found if not args.list or row[0][1] in args.list]
        print("\n".join(f"{file}:{line}: {habit}" for (habit, _), where in shown for file, line in where))
    return 0


if __name__ == "__main__":
    sys.exit(main())
