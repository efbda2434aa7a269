#!/usr/bin/python3
"""Writes the sources that come from Khronos' registries.

usage: gen.py OUT tokens                                                every GL enum as a #define (gl_tokens.h)
       gen.py OUT commands OVERLAY CAPTURE_OVERLAY HANDLER_SOURCE...    what is known of each command (machine/commands.h)
       gen.py OUT handlers OVERLAY CAPTURE_OVERLAY HANDLER_SOURCE...    their handlers, in the same order (gl/dispatch.h)

A handler is a line GLS_HANDLER(glName, KIND) or GLS_HANDLER(glName, KIND, ROLE) in a source of replay/. A command without one takes
the handler of the command that the registry calls its alias; else the excuse that overlay.txt gives; else it is counted when met.
The lines "draws" and "ends" of capture/gen/overlay.txt say which commands do nothing but draw, or end a frame.
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
    # Numbers beyond 32 bits are limits of later GL, and no token that a struct of ours holds.
    lines += [f"#define {name} 0x{value:X}" for name, value in enums.items() if 0 <= value <= 0xFFFFFFFF]
    write(out, lines)


def read_overlay(path):
    """{command: why it needs nothing done}"""
    excuses = {}
    with open(path) as source:
        for number, line in enumerate(source, 1):
            line = line.split("#")[0].strip()
            if not line:
                continue
            words = line.split(None, 2)
            if len(words) != 3 or words[0] != "excuse":
                sys.exit(f"{path}:{number}: not of the form 'excuse COMMAND REASON'")
            excuses[words[1]] = words[2]
    return excuses


HANDLER = re.compile(r"^GLS_HANDLER\s*\(\s*(\w+)\s*,\s*(\w+)\s*(?:,\s*(\w+)\s*)?\)", re.M)


def read_handlers(paths):
    """{command: (kind, role)}"""
    handlers = {}
    for path in paths:
        with open(path) as source:
            text = source.read()
        found = {text.count("\n", 0, match.start()) + 1: match for match in HANDLER.finditer(text)}
        for number, line in enumerate(text.split("\n"), 1):
            if re.match(r"\s*GLS_HANDLER\b", line) and number not in found:
                sys.exit(f"{path}:{number}: not of the form GLS_HANDLER(name, KIND) or GLS_HANDLER(name, KIND, ROLE)")
        for number, match in found.items():
            if match[1] in handlers:
                sys.exit(f"{path}:{number}: a second handler of {match[1]}")
            handlers[match[1]] = match[2], match[3] or "NONE"
    return handlers


def read_drawing(path):
    """[(pattern of commands, what they do)]"""
    with open(path) as source:
        words = [line.split(None, 1) for line in source]
    return [(re.compile(line[1].strip()), "GLS_" + line[0].upper()) for line in words if line and line[0] in ("draws", "ends")]


def table(out, what, overlay, capture_overlay, sources):
    commands = {}
    for file_name in ("gl.xml", "glx.xml"):
        commands.update(registry.read(file_name)[0])
    excuses = read_overlay(overlay)
    handlers = read_handlers(sources)
    drawing = read_drawing(capture_overlay)
    both = sorted(excuses.keys() & handlers.keys())
    if both:
        sys.exit(f"{overlay}: {both[0]} is excused and handled")

    def resolve(name, known):
        """The command whose entry counts for this one: itself, else along its aliases, else one that is an alias of it."""
        seen = set()
        while name and name not in seen:
            if name in known:
                return name
            seen.add(name)
            name = commands[name].alias if name in commands else ""
        return ""

    names = sorted(commands.keys() | excuses.keys() | handlers.keys())
    lines = ["/* Made by replay/gen.py from Khronos' registries, overlay.txt and the handlers of replay/. */"]
    if what == "handlers":
        lines += ['#include "replay/gl/dispatch.h"', "", *(f"gls_handler gls_{name};" for name in sorted(handlers)), "",
                  "gls_handler *const gls_handlers[] = {"]
    else:
        lines += ['#include "replay/machine/commands.h"', "", "const struct gls_command gls_commands[] = {"]
    for name in names:
        handler = resolve(name, handlers)
        kind, role = handlers[handler] if handler else ("NONE", "NONE")
        excuse = "" if handler else resolve(name, excuses)
        core = name in commands and any(re.fullmatch(r"GL_VERSION_(1_\d|2_[01])", v) for v in commands[name].versions)
        fields = [f'"{name}"', '"' + excuses[excuse].replace('"', '\\"') + '"' if excuse else "0", f"GLS_KIND_{kind}", f"GLS_ROLE_{role}",
                  str(int(core)), next((does for pattern, does in drawing if pattern.fullmatch(name)), "0")]
        lines.append(f"\t{f'gls_{handler}' if handler else '0'}," if what == "handlers" else "\t{ " + ", ".join(fields) + " },")
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
