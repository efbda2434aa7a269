#!/usr/bin/python3
"""packs.py TXT SCENE OUT: predicates that say what packs do not support, from packs.txt, which explains them.

TXT must name every member of the structs in SCENE (scene/scene.h). A condition is the text of an expression in C.
"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "base"))
from structs import structs_of  # noqa: E402

EXPANDED = {"surface": "scene_surface"}  # members of a material that are listed one by one


def read_rules(path):
    """Structs' members in order, {(kind, struct): [condition]}, {kind: [parameter]}"""
    members, conditions, parameters, struct = {}, {}, {}, None
    for number, line in enumerate(open(path), 1):
        words = line.split("#")[0].split(None, 1)
        if not words:
            continue
        name, rest = words[0], words[1].strip() if len(words) > 1 else ""
        if name == "struct":
            struct = rest
            members[struct] = []
        elif name == "kind":
            kind, names = re.fullmatch(r"(\w+)\(([\w, ]*)\)", rest).groups()
            parameters[kind] = names.split(", ")
        else:
            members[struct].append(name)
            for clause in filter(None, (part.strip() for part in rest.split(";"))):
                match = re.fullmatch(r"(\w+): (.+)", clause)
                if not match:
                    sys.exit(f"{path}:{number}: not KIND: CONDITION: {clause}")
                conditions.setdefault((match[1], struct), []).append(match[2].replace("$", f"s->{name}"))
    return members, conditions, parameters


def check(path, members, scene):
    """The list has all members, and no others."""
    text = re.sub(r"/\*.*?\*/", "", pathlib.Path(scene).read_text(), flags=re.DOTALL)
    structs = structs_of(re.sub(r"^\s*#.*", "", text, flags=re.MULTILINE))
    errors = []
    for struct, listed in members.items():
        found = []
        for name, *_ in structs[f"scene_{struct}"]:
            found += [f"{name}.{inner[0]}" for inner in structs[EXPANDED[name]]] if name in EXPANDED else [name]
        errors += [f"{path}: scene_{struct} has {name}: do packs support it?" for name in found if name not in listed]
        errors += [f"{path}: scene_{struct} has no {name}" for name in listed if name not in found]
    if errors:
        sys.exit("\n".join(errors))


def main():
    path, scene, out = sys.argv[1:4]
    members, conditions, parameters = read_rules(path)
    check(path, members, scene)
    text = [f"/* Made by kernels/packs.py from {path}. */", "#pragma once", "",
            *(f'#include "{header}"' for header in ("gl_tokens.h", "scene/scene.h", "kernels/shared.h"))]
    for (kind, struct), parts in sorted(conditions.items()):
        name = f"pack_refuses_{kind}" + ("" if struct == "material" else f"_{struct}")
        more = "".join(f", int {parameter}" for parameter in parameters.get(kind, []))
        tests = " ||\n\t       ".join(f"({part})" for part in parts)
        text.append(f"\nstatic inline int {name}(GLOBAL const struct scene_{struct} *s{more})\n"
                    f"{{\n\treturn {tests};\n}}")
    pathlib.Path(out).write_text("\n".join(text) + "\n")


main()
