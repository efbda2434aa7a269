#!/usr/bin/python3
"""Writes the sources that come from Khronos' registries.

usage: gen.py OUT tokens
           every GL enum as a #define (gl_tokens.h)
       gen.py OUT commands OVERLAY CAPTURE_OVERLAY HANDLER_SOURCE...
           the table of commands (machine/commands.h)
       gen.py OUT handlers OVERLAY CAPTURE_OVERLAY HANDLER_SOURCE...
           their handlers, in the same order (gl/dispatch.h)

A handler is a line GLS_HANDLER(glName, KIND) or GLS_HANDLER(glName, KIND, ROLE) in a source of replay/.
GLS_FAMILY(glName, ...) handles all commands whose names are glName and a suffix (GL 2.1 sec. 2.3);
GLS_FAMILY(glNameEXT, ...) those with the suffix before EXT. For a command without a handler, the first of these applies:
the handler of the command that the registry calls its alias, or of the one that does the same under another suffix
(glFrustumfOES, glFrustumx: glFrustum); the excuse that overlay.txt gives; it is only a query; it is counted when called.
In capture/gen/overlay.txt, the lines "draws" and "ends" list commands that only draw, or end a frame; the lines "arg" say
which arguments are pixels.
"""
import re
import sys

sys.path.insert(0, "capture/gen")
import registry  # noqa: E402


def write(path, lines):
    with open(path, "w") as out:
        out.write("\n".join(lines) + "\n")


def tokens(out):
    _, enums = registry.read("gl.xml")
    lines = ["/* Made by replay/gen.py from Khronos' gl.xml. Included by C and OpenCL C: #defines only. */",
             "#pragma once"]
    # Values beyond 32 bits are limits of later GL, and never stored as tokens.
    lines += [f"#define {name} 0x{value:X}" for name, value in enums.items() if 0 <= value <= 0xFFFFFFFF]
    write(out, lines)


def expand(pattern):
    """The names that a pattern such as glUniform{1,2}{f,i}{,v} expands to."""
    braces = re.search(r"{([^}]*)}", pattern)
    if not braces:
        return [pattern]
    return [
        name for part in braces[1].split(",")
        for name in expand(pattern[:braces.start()] + part + pattern[braces.end():])
    ]


def read_overlay(path):
    """{command: why it needs no handler}"""
    excuses, reason = {}, None
    with open(path) as source:
        for number, line in enumerate(source, 1):
            words = line.split("#")[0].split()
            if words and not line[0].isspace():
                reason = " ".join(words)
            elif words and not reason:
                sys.exit(f"{path}:{number}: commands without a reason above them")
            else:
                excuses.update((name, reason) for word in words for name in expand(word))
    return excuses


HANDLER = re.compile(r"^GLS_(HANDLER|FAMILY)\s*\(\s*(\w+)\s*,\s*(\w+)\s*(?:,\s*(\w+)\s*)?\)", re.M)
SUFFIX = re.compile(r"([1-4]?)(N?)(ub|us|ui|[bsifd]|D)(v?)")
NO_SUFFIX = "{ 0, GLS_SUFFIX_NONE, 0, 0 }"


def read_handlers(paths):
    """[(GLS_HANDLER or GLS_FAMILY, name, kind, role)]"""
    handlers = []
    for path in paths:
        with open(path) as source:
            text = source.read()
        found = {text.count("\n", 0, match.start()) + 1: match for match in HANDLER.finditer(text)}
        for number, line in enumerate(text.split("\n"), 1):
            if re.match(r"\s*GLS_(HANDLER|FAMILY)\b", line) and number not in found:
                sys.exit(f"{path}:{number}: not of the form GLS_HANDLER(name, KIND) or GLS_HANDLER(name, KIND, ROLE)")
        for number, match in found.items():
            if match[2] in (name for _, name, _, _ in handlers):
                sys.exit(f"{path}:{number}: a second handler of {match[2]}")
            handlers.append((match[1], match[2], match[3], match[4] or "NONE"))
    return handlers


def handled(handlers, names):
    """{command: (function, kind, role, its struct gls_suffix)}"""
    found = {}
    for what, stem, kind, role in sorted(handlers):
        if what == "HANDLER":
            found[stem] = stem, kind, role, NO_SUFFIX
            continue
        for name in names:
            start, end = re.fullmatch("(.*?)(EXT|)", stem).groups()
            fits = name.startswith(start) and name.endswith(end)
            suffix = SUFFIX.fullmatch(name.removeprefix(start).removesuffix(end).removesuffix("OES")) if fits else None
            if suffix:
                count, normalized, letters, array = suffix.groups()
                kind_of_number = "NONE" if letters == "D" else letters.upper()
                found[
                    name] = stem, kind, role, f"{{ {count or 1}, GLS_SUFFIX_{kind_of_number}, {len(normalized)}, {len(array)} }}"
    return found


def fixed_mask(command):
    """Bits of the parameters that are 16.16 fixed point."""
    return sum(1 << i for i, p in enumerate(command.params) if re.search(r"\bGL(fixed|clampx)\b", p.type))


def types_of(command):
    return [(p.type, p.pointer) for p in command.params]


def same_by_suffix(name, commands):
    """Commands that may do the same: without OES, or without EXT and ARB where parameters are the same
    (glGenTexturesEXT has another GLX protocol, and so is no alias); with floats for fixed-point numbers; without the f
    that OpenGL ES 1 puts there.
    """
    base, core = name.removesuffix("OES"), re.sub("(EXT|ARB)$", "", name)
    names = [base]
    if core != name and core in commands and name in commands and types_of(commands[core]) == types_of(commands[name]):
        names.append(core)
    if name in commands and fixed_mask(commands[name]):
        stem, v = (base[:-2], "v") if base.endswith("xv") else (base[:-1], "")
        names += [stem + "f" + v, stem + v]
    elif base.endswith("f"):
        names.append(base[:-1])
    shape = [p.pointer for p in commands[name].params] if name in commands else None
    names += [n + "OES" for n in names[1:]]
    return [n for n in names if n != name and (n not in commands or [p.pointer for p in commands[n].params] == shape)]


QUERY = re.compile(r"glX?(Get|Getn(?=Map|Uniform)|Is|Are|Query|Test)[A-Z]\w*")
NAMES_FOR_LATER = re.compile(r"\w*(Location|Index|Handle|Id|Counter)([A-Z0-9]\w*)?")


def only_asks(command):
    """By its name, and by what it writes: `void *` may be a place in a buffer. Answers that later calls name things by
    are not enough."""
    writes_bytes = any(p.pointer == 1 and re.match(r"(GL)?void\b", p.type) for p in command.params)
    return bool(QUERY.fullmatch(command.name)) and not NAMES_FOR_LATER.fullmatch(command.name) and not writes_bytes


def read_drawing(path):
    """[(pattern of commands, what they do)]"""
    with open(path) as source:
        words = [line.split(None, 1) for line in source]
    return [(re.compile(line[1].strip()), "GLS_" + line[0].upper())
            for line in words
            if line and line[0] in ("draws", "ends")]


def read_pixels(path):
    """[(pattern of commands, pattern of a parameter, what says how many bytes it points to)]"""
    with open(path) as source:
        rows = [re.match(r"arg\s+(\S+)\s+(\S+)\s+(image|unpack)\s+(.*)", line.split("#")[0]) for line in source]
    return [(re.compile(row[1]), re.compile(row[2]), row[3], row[4].split()) for row in rows if row]


def pixel_args(command, rows):
    """struct gls_pixel_args of a command."""
    places = {p.name: i for i, p in enumerate(command.params)} if command else {}
    for names, params, kind, fields in reversed(rows):
        at = next((i for name, i in places.items() if params.fullmatch(name)), None)
        if at is None or not names.fullmatch(command.name):
            continue
        said = [places.get(field, -1) for field in fields]
        numbers = [at, int(fields[0]), *said[1:]
                   ] if kind == "image" else [at, 0, -1, -1, said[1] if fields[0] == "blob" else -1, -1, -1]
        return "{ " + ", ".join(map(str, numbers)) + " }"
    return "{ -1, 0, -1, -1, -1, -1, -1 }"


def table(out, what, overlay, capture_overlay, sources):
    commands = {}
    for file_name in ("gl.xml", "glx.xml"):
        commands.update(registry.read(file_name)[0])
    excuses = read_overlay(overlay)
    functions = read_handlers(sources)
    handlers = handled(functions, commands)
    drawing, pixels = read_drawing(capture_overlay), read_pixels(capture_overlay)
    both = sorted(excuses.keys() & handlers.keys())
    if both:
        sys.exit(f"{overlay}: {both[0]} is excused and handled")

    def resolve(name, known):
        """The command whose entry counts for this one: itself, else along its aliases, else one that is an alias of
        it."""
        seen = set()
        while name and name not in seen:
            if name in known:
                return name
            seen.add(name)
            others = same_by_suffix(name, commands)
            name = commands[name].alias if name in commands and commands[name].alias else next(
                (n for n in others if n in known), "")
        return ""

    names = sorted(commands.keys() | excuses.keys() | handlers.keys())
    lines = ["/* Made by replay/gen.py from Khronos' registries, overlay.txt and the handlers of replay/. */"]
    if what == "handlers":
        lines += [
            '#include "replay/gl/dispatch.h"', "", *(f"gls_handler gls_{name};" for _, name, _, _ in functions), "",
            "gls_handler *const gls_handlers[] = {"
        ]
    else:
        lines += ['#include "replay/machine/commands.h"', "", "const struct gls_command gls_commands[] = {"]
    for name in names:
        handler = resolve(name, handlers)
        function, kind, role, suffix = handlers[handler] if handler else ("", "NONE", "NONE", NO_SUFFIX)
        reason = "" if handler else excuses.get(resolve(name, excuses), "")
        if not handler and not reason and name in commands and only_asks(commands[name]):
            reason = "a query"
        core = name in commands and any(re.fullmatch(r"GL_VERSION_(1_\d|2_[01])", v) for v in commands[name].versions)
        fields = [
            f'"{name}"', '"' + reason.replace('"', '\\"') + '"' if reason else "0", f"GLS_KIND_{kind}",
            f"GLS_ROLE_{role}",
            str(int(core)),
            next((does for pattern, does in drawing if pattern.fullmatch(name)), "0"), suffix,
            str(fixed_mask(commands[name]) if handler and name in commands else 0),
            pixel_args(commands.get(name), pixels)
        ]
        lines.append(f"\t{f'gls_{function}' if handler else '0'}," if what == "handlers" else "\t{ " +
                     ", ".join(fields) + " },")
    lines.append("};")
    if what == "commands":
        lines += ["", "const unsigned n_gls_commands = sizeof(gls_commands) / sizeof(gls_commands[0]);"]
    write(out, lines)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[2] == "tokens":
        tokens(sys.argv[1])
    elif len(sys.argv) > 5 and sys.argv[2] in ("commands", "handlers"):
        table(*sys.argv[1:5], sys.argv[5:])
    else:
        sys.exit(__doc__)
