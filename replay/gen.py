#!/usr/bin/python3
"""Writes build/gen/gl_tokens.h (every GL enum as a #define) and build/gen/dispatch.c (command name -> handler).

usage: gen.py OUT tokens                               the enums
       gen.py OUT dispatch OVERLAY CAPTURE_OVERLAY HANDLER_SOURCE...   the table

A handler is a line of the form GLS_HANDLER(glName, KIND) at the start of a line in replay/*.c. A command without one takes the
handler of the command that the registry calls its alias; else the excuse that overlay.txt gives; else it is counted when met.
Which commands do nothing but draw, or end a frame, is said by the lines "draws" and "ends" of capture/gen/overlay.txt.
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
             "#ifndef GEN_GL_TOKENS_H", "#define GEN_GL_TOKENS_H"]
    # Numbers beyond 32 bits are limits of later GL, and no token that a struct of ours holds.
    lines += [f"#define {name} 0x{value:X}" for name, value in enums.items() if 0 <= value <= 0xFFFFFFFF]
    write(out, lines + ["#endif"])


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


def read_handlers(paths):
    """{command: kind}"""
    handlers = {}
    for path in paths:
        with open(path) as source:
            for number, line in enumerate(source, 1):
                found = re.match(r"GLS_HANDLER\((\w+), (\w+)\)", line)
                if not found:
                    continue
                if found[1] in handlers:
                    sys.exit(f"{path}:{number}: a second handler of {found[1]}")
                handlers[found[1]] = found[2]
    return handlers


def read_drawing(path):
    """[(pattern of commands, what they do)]"""
    with open(path) as source:
        words = [line.split(None, 1) for line in source]
    return [(re.compile(line[1].strip()), "GLS_" + line[0].upper()) for line in words if line and line[0] in ("draws", "ends")]


def dispatch(out, overlay, capture_overlay, sources):
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
    lines = ["/* Made by replay/gen.py from Khronos' registries, overlay.txt and the handlers of replay/. */",
             '#include "replay/machine/commands.h"', ""]
    lines += [f"gls_handler gls_{name};" for name in sorted(handlers)]
    lines += ["", "const struct gls_command gls_commands[] = {"]
    for name in names:
        handler = resolve(name, handlers)
        excuse = "" if handler else resolve(name, excuses)
        core = name in commands and any(re.fullmatch(r"GL_VERSION_(1_\d|2_[01])", v) for v in commands[name].versions)
        fields = [f'"{name}"',
                  f"gls_{handler}" if handler else "0",
                  f"GLS_KIND_{handlers[handler]}" if handler else "0",
                  '"' + excuses[excuse].replace('"', '\\"') + '"' if excuse else "0",
                  str(int(core)),
                  next((what for pattern, what in drawing if pattern.fullmatch(name)), "0")]
        lines.append("\t{ " + ", ".join(fields) + " },")
    lines += ["};", "", "const unsigned n_gls_commands = sizeof(gls_commands) / sizeof(gls_commands[0]);"]
    write(out, lines)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[2] == "tokens":
        tokens(sys.argv[1])
    elif len(sys.argv) > 5 and sys.argv[2] == "dispatch":
        dispatch(sys.argv[1], sys.argv[3], sys.argv[4], sys.argv[5:])
    else:
        sys.exit(__doc__)
