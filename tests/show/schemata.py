"""All mutants of one program in one build (mutant schemata, after Untch, Offutt and Harrold, 1993). Each mutated place
(sites.py) holds the original and the replacement, and RELUME_MUTANT=number selects the mutant that runs. With
RELUME_MUTANTS=FILE none runs; instead, the file's byte for each mutant is set once the mutant could be distinguished: 1
if its place is reached, 3 if its value would differ (or cannot be compared).

libclang finds the expression around a place. A place without an expression evaluated at run time (tables, sizes, cases)
gets no switch.
"""
import pathlib
import re
import subprocess

from clang import cindex

HOUSE, HEADER = pathlib.Path(__file__).resolve().parent.parent.parent, "tests/show/mutant.h"
IMPURE = re.compile(r"\+\+|--|(?<![=!<>])=(?!=)|\b(?!sizeof\b|return\b|if\b|defined\b)[A-Za-z_]\w*\s*\(")
NUMBERS = {
    kind for kind in cindex.TypeKind.__dict__.values() if isinstance(kind, cindex.TypeKind) and 3 <= kind.value <= 23
}
CONSTANT = {cindex.CursorKind.ENUM_DECL, cindex.CursorKind.FIELD_DECL, cindex.CursorKind.CXX_UNARY_EXPR}


class Parser:
    def __init__(self, root, build):
        self.root, self.index = root, cindex.Index.create()
        resources = subprocess.run(["clang", "-print-resource-dir"], capture_output=True, text=True,
                                   check=True).stdout.strip()
        self.flags = [
            "-std=c11", "-resource-dir", resources, f"-I{root}", f"-I{HOUSE}", f"-I{build}/gen",
            f"-I{build}/recorder/gen", "-isystem", "/usr/include/OpenEXR", "-isystem", "/usr/include/Imath",
            "-D_GNU_SOURCE", "-DCL_TARGET_OPENCL_VERSION=120", "-DGL_GLEXT_PROTOTYPES", "-w", "-ferror-limit=0"
        ]

    def parse(self, path, text):
        """The translation unit of a source; a header is parsed alone in one."""
        whole, unsaved = str(self.root / path), [(str(self.root / path), text)]
        if path.endswith(".h"):
            whole = str(self.root / "of-a-header.c")
            unsaved.append((whole, f'#include "{path}"\n'))
        return self.index.parse(whole, args=self.flags, unsaved_files=unsaved)

    def broken(self, path, text):
        """Offsets of compile errors in the file."""
        return [
            d.location.offset
            for d in self.parse(path, text).diagnostics
            if d.severity >= cindex.Diagnostic.Error and d.location.file and d.location.file.name == str(self.root /
                                                                                                         path)
        ]


def around(cursor, name, begin, end, found=None):
    """The innermost expression of the file `name` that contains [begin, end); None if constant or missing."""
    for i, child in enumerate(cursor.get_children()):
        extent = child.extent
        if not extent.start.file or extent.start.file.name != name or extent.start.offset > begin or extent.end.offset < end:
            continue
        is_label = i == 0 and cursor.kind == cindex.CursorKind.CASE_STMT
        if is_label or child.kind in CONSTANT or child.kind == cindex.CursorKind.VAR_DECL and child.storage_class == cindex.StorageClass.STATIC:
            return None
        return around(child, name, begin, end,
                      child if child.kind.is_expression() and child.kind != cindex.CursorKind.INIT_LIST_EXPR else found)
    return found


class Change:
    """A mutant in its source's text."""

    def __init__(self, number, site, text, unit, name):
        self.number, self.site, self.begin, self.end, self.macro = number, site, site.begin, site.end, None
        functions = [
            c for c in unit.cursor.get_children() if c.kind == cindex.CursorKind.FUNCTION_DECL and c.is_definition()
            and c.location.file.name == name and c.extent.start.offset <= site.begin < c.extent.end.offset
        ]
        inside = functions and around(functions[0], name, site.begin, site.end)
        if site.kind == "branch":
            self.macro = functions and "MUTANT_BRANCH"
            return
        if not inside:
            return
        self.begin, self.end = inside.extent.start.offset, inside.extent.end.offset
        was, kind = text[self.begin:self.end], inside.type.get_canonical().kind
        in_bits = inside.referenced and inside.referenced.kind == cindex.CursorKind.FIELD_DECL and inside.referenced.is_bitfield(
        )
        pure = (kind in NUMBERS and not in_bits and (inside.kind == cindex.CursorKind.BINARY_OPERATOR
                                                     or site.kind != "operator" and site.kind != "comparison")
                and not IMPURE.search(was) and site.was not in ("&&", "||")
                and inside.kind != cindex.CursorKind.CALL_EXPR
                and (site.instead != "/" or kind in (cindex.TypeKind.FLOAT, cindex.TypeKind.DOUBLE)))
        self.macro = "MUTANT_VALUE" if pure else "MUTANT"
        self.instead = text[self.begin:site.begin] + site.instead + text[site.end:self.end]


def render(text, changes, begin=0, end=None, spans=None, at=0):
    """Text with its nested changes applied; spans receives (begin, end, number) as positions in the new text."""
    end, out = len(text) if end is None else end, []
    todo = sorted((c for c in changes if begin <= c.begin and c.end <= end), key=lambda c: (c.begin, -c.end, c.number))
    while todo:
        change = todo[0]
        inner = [c for c in todo[1:] if c.end <= change.end]
        todo = [c for c in todo[1:] if c.begin >= change.end]
        out.append(text[begin:change.begin])
        start = at + sum(map(len, out))
        head = f"{change.macro}({change.number}, ("
        tail = "))" if change.macro == "MUTANT_BRANCH" else f"), ({change.instead}))"
        out.append(head + render(text, inner, change.begin, change.end, spans, start + len(head)) + tail)
        if spans is not None:
            spans.append((start, start + len(out[-1]), change.number))
        begin = change.end
    return "".join(out) + text[begin:end]


def plant(parser, path, sites, number):
    """(text with switches at as many sites as possible, {number: site}), numbered from `number`."""
    text = (parser.root / path).read_text()
    if not text.isascii():  # libclang's offsets count bytes
        return text, {}
    unit, name = parser.parse(path, text), str(parser.root / path)
    changes = [c for c in (Change(number + i, site, text, unit, name) for i, site in enumerate(sites)) if c.macro]
    while changes:
        spans = []
        planted = f'#include "{HEADER}"\n'
        planted += render(text, changes, spans=spans, at=len(planted))
        wrong = parser.broken(path, planted)
        if not wrong:
            return planted, {c.number: c.site for c in changes}
        bad = {
            min((e - b, n)
                for b, e, n in spans
                if b <= at < e)[1] if any(b <= at < e
                                          for b, e, _ in spans) else changes[0].number
            for at in wrong
        }
        changes = [c for c in changes if c.number not in bad]
    return text, {}
