#!/usr/bin/python3
"""gen_commands.py OUT HANDLER_SOURCE...: the commands that tests/fuzz/calls.c makes calls of, as C: each command that
replay/ handles, with a letter for each parameter, its enumerants according to the registry, and its chapter, the source
that handles it.

A command's number is derived from its name, so that kept inputs stay valid when commands are added. Letters: e enum, m
bitmask, i and u integers, f and d floats, p address, b bytes or an offset, s string; E I F D arrays of these.
"""
import sys
import zlib

sys.path.insert(0, "replay")
import gen  # noqa: E402
import registry  # noqa: E402  (gen.py knows where)

SCALARS = {
    "GLenum": "e", "GLbitfield": "m", "GLfloat": "f", "GLclampf": "f", "GLdouble": "d", "GLclampd": "d",
    **dict.fromkeys(("GLint", "GLsizei", "GLshort", "GLbyte", "GLintptr", "GLsizeiptr", "GLintptrARB", "GLsizeiptrARB", "int", "int64_t", "Bool"), "i"),
    **dict.fromkeys(("GLuint", "GLushort", "GLubyte", "GLboolean", "GLXDrawable", "GLXPbuffer", "GLhandleARB", "Font", "unsigned long"), "u")
}
# Commands missing from the registries of GL and GLX.
OTHERS = {
    "memcpy": "pbi", "eglChooseConfig": "pIIiI", "eglGetConfigAttrib": "ppeI", "eglCreateContext": "pppI",
    "eglDestroyContext": "pp", "eglMakeCurrent": "pppp", "eglSwapBuffers": "pp", "eglSwapBuffersWithDamageEXT": "ppIi",
    "eglSwapBuffersWithDamageKHR": "ppIi", "OSMesaCreateContext": "ep", "OSMesaCreateContextExt": "eiiip",
    "OSMesaCreateContextAttribs": "Ip", "OSMesaDestroyContext": "p", "OSMesaMakeCurrent": "ppeii"
}
MOST_PARAMS = 15
# Numeric parameters that may be tokens, which the registry does not say; these groups contain most of their values.
VALUED = ("glTexParameter", "glSamplerParameter", "glTexEnv", "glTexGen", "glFog", "glLightModel", "glPointParameter")
VALUES = ("TextureMinFilter", "TextureMagFilter", "TextureWrapMode", "TextureEnvMode", "TextureGenMode", "FogMode",
          "LightModelColorControl", "DepthFunction", "BlendingFactor", "PixelFormat", "TextureUnit")


def letter(param):
    base = param.type.replace("const", "").replace("*", "").strip()
    if not param.pointer:
        return SCALARS.get(base, "p")
    if base in ("void", "GLvoid"):
        return "b"
    if base in ("GLchar", "char"):
        return "s"
    return {"e": "E", "f": "F", "d": "D", "i": "I", "u": "I", "m": "I"}.get(SCALARS.get(base), "p")


def group_of(command, param, values):
    if param.group in values:
        return param.group
    return "values" if command.startswith(VALUED) and param.name in ("param", "params") else ""


def main(out, sources):
    known, values = {}, {}
    for file_name in ("gl.xml", "glx.xml"):
        known.update(registry.read(file_name)[0])
        for enum in registry.read_enums(file_name):
            for group in enum.groups:
                values.setdefault(group, set()).add(enum.value & 0xFFFFFFFF)
            if not enum.bits:
                values.setdefault("", set()).add(enum.value & 0xFFFFFFFF)
    values["values"] = set().union(*(values[group] for group in VALUES))
    chapters = {
        name: number
        for number, source in enumerate(sources)
        for name in gen.handled(gen.read_handlers([source]), known)
    }
    commands = {}
    for name in sorted(known.keys() | chapters.keys()):
        if name in chapters and name in OTHERS:
            commands[name] = (OTHERS[name], [""] * len(OTHERS[name]), chapters[name])
        elif name in known and (name in chapters or known[name].alias in chapters):
            params = known[name].params[:MOST_PARAMS]
            commands[name] = ("".join(map(letter, params)), [group_of(name, p, values) for p in params],
                              chapters[name if name in chapters else known[name].alias])
    numbers = {}
    for name in commands:
        number = zlib.crc32(name.encode()) & 0xFFFF
        while number in numbers:
            number = (number + 1) & 0xFFFF
        numbers[number] = name
    groups = ["", *sorted({g for _, of, _ in commands.values() for g in of} - {""})]
    lines = ["/* Made by tests/fuzz/gen_commands.py from Khronos' registries and the handlers of replay/. */",
             '#include "tests/fuzz/calls.h"', ""]
    for number, group in enumerate(groups):
        lines.append(f"static const uint32_t group_{number}[] = {{ {', '.join(map(hex, sorted(values[group])))} }};")
    lines += [
        "", "const struct calls_group calls_groups[] = {",
        *(f"\t{{ group_{n}, {len(values[group])} }}," for n, group in enumerate(groups)), "};", "",
        "const struct calls_command calls_commands[] = {",
        *(f'\t{{ "{name}", {number}, {chapter}, "{letters}", {{ {", ".join(str(groups.index(g)) for g in of) or 0} }} }},'
          for number, name in sorted(numbers.items())
          for letters, of, chapter in [commands[name]]), "};", "",
        "const unsigned n_calls_commands = sizeof(calls_commands) / sizeof(calls_commands[0]);"
    ]
    gen.write(out, lines)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
