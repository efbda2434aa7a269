#!/usr/bin/python3
"""packaging/manual.py OUT.c OUT.dep: the texts of `relume help NAME-file` and of all EXAMPLES, as C strings.

The text about a file format is the first comment of the header that reads it, or a Markdown page (FORMATS). The
examples of all verbs are in packaging/examples.txt. pages.py makes man pages from the same texts.

A text has headings (a line in capitals; "## Title"), paragraphs, and blocks indented by four: below KEYS, a key per line
with its meaning ("key: value  # text"), elsewhere lines to type. Markdown tables are lists of terms.
"""
import collections
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = "packaging/examples.txt"
PAGE_COLUMNS = 114  # as base/options.c

Format = collections.namedtuple("Format", "name source summary")
FORMATS = (
    Format("look", "look/rules/rules.h", "rules about surfaces and lights, for relume render --look"),
    Format("camera", "look/camera/camera.h", "a camera for recorded frames, for relume render --camera"),
    Format("diff", "diff/rules/rules.h", "how relume diff compares frames: relume-diff.yaml"),
    Format("ci", "ci/plan.h", "the programs that relume ci records: relume-ci.yaml"),
    Format("hook", "corpus/hooks/README.md", "your own functions in the ray tracer, for relume render --hook"),
)


def lines_of(source):
    """The lines of a text, headings in capitals."""
    text = (ROOT / source).read_text()
    if source.endswith(".md"):
        lines = text.split("\n")[1:]  # without the title
        return [line[3:].upper() if line.startswith("## ") else line for line in lines]
    comment = text[text.index("/*\n") + 3:text.index("\n */")]
    return [line[3:] for line in comment.split("\n")]


def is_heading(line):
    return line.isupper() and not line.startswith((" ", "|"))


def read(source):
    """The blocks of a text: ("heading", title), ("text", words), ("list", [(term, words)]), ("keys", lines), ("code",
    lines)."""
    blocks, heading = [], None
    for line in [*lines_of(source), ""]:
        kind = blocks[-1][0] if blocks else None
        if not line.strip():
            if kind in ("code", "keys"):
                blocks[-1][1].append("")
            elif kind:
                blocks.append((None, None))
        elif is_heading(line):
            heading = line
            blocks.append(("heading", line))
        elif line.startswith("    "):
            wanted = "keys" if heading == "KEYS" else "code"
            if kind != wanted:
                blocks.append((wanted, []))
            blocks[-1][1].append(line[4:])
        elif line.startswith("|"):
            cells = [cell.strip() for cell in line.strip("|").split(" | ")]
            if kind != "list":
                blocks.append(("list", None))  # the table's head
                blocks[-1] = ("list", [])
            elif not cells[0].startswith("-"):
                blocks[-1][1].append((cells[0].replace("`", ""), cells[1]))
        elif kind == "text":
            blocks[-1] = ("text", f"{blocks[-1][1]} {line}")
        else:
            blocks.append(("text", line))
    for kind, content in blocks:
        while kind in ("code", "keys") and not content[-1]:
            content.pop()
    return [block for block in blocks if block[0]]


def plain(blocks):
    """A text as `relume help` prints it."""
    out = []
    for kind, content in blocks:
        if kind == "heading":
            out += [content, ""]
        elif kind == "text":
            out += [*textwrap.wrap(content, PAGE_COLUMNS, break_long_words=False, break_on_hyphens=False), ""]
        elif kind == "list":
            for term, words in content:
                out += [
                    f"    {term}",
                    *textwrap.wrap(words, PAGE_COLUMNS, initial_indent=8 * " ", subsequent_indent=8 * " ")
                ]
            out.append("")
        else:
            out += [*(f"    {line}" if line else "" for line in content), ""]
    return "\n".join(out)


def examples():
    """The lines of each verb's examples; "# ..." describes the command below it."""
    found, lines = {}, None
    for line in (ROOT / EXAMPLES).read_text().split("\n"):
        if re.fullmatch(r"\[\w+\]", line):
            lines = found[line[1:-1]] = []
        elif line and lines is not None:
            lines.append(line)
    return found


def c_string(text):
    quoted = text.replace("\\", "\\\\").replace('"', '\\"').split("\n")
    return "\n".join(f'\t\t"{line}\\n"' for line in quoted[:-1])


def main(out, dep):
    c = [
        "/* Made by packaging/manual.py from headers, corpus/hooks/README.md and packaging/examples.txt. */",
        '#include "base/manual.h"', "", "#include <stddef.h>", ""
    ]
    c.append("const struct manual_text manual_formats[] = {")
    for form in FORMATS:
        c.append(f'\t{{ "{form.name}-file", "{form.summary}",\n{c_string(plain(read(form.source)))} }},')
    c += ["\t{ NULL, NULL, NULL },", "};", "", "const struct manual_text manual_examples[] = {"]
    for verb, lines in examples().items():
        c.append(f'\t{{ "{verb}", NULL,\n' + c_string("".join(f"    {line}\n" for line in lines)) + " },")
    c += ["\t{ NULL, NULL, NULL },", "};"]
    pathlib.Path(out).write_text("\n".join(c) + "\n")
    sources = [EXAMPLES, *(form.source for form in FORMATS)]
    pathlib.Path(dep).write_text(f"{out}: {' '.join(sources)}\n" + "".join(f"{source}:\n" for source in sources))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
