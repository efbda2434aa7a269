#!/usr/bin/python3
"""layout.py TXT OUT <PREPROCESSED: the members of the structs that a snapshot keeps, as a list for the C compiler.

TXT (layout.txt) says how every member is treated. OUT defines SNAPSHOT_MEMBERS(PLACED, SINGLE), a list of
PLACED(struct, member, type of its elements) for structs that are saved as they are in memory, and of
SINGLE(struct, member) for members that are saved individually: snapshot_layout.c hashes their names, offsets and sizes.
Comments and prototypes have no effect.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "base"))
from structs import structs_of  # noqa: E402


def main():
    structs = structs_of(sys.stdin.read())
    path, rules, errors = sys.argv[1], {"pointers": {}, "kept": {}, "left": {}}, []
    for line in open(path):
        words = line.split("#")[0].split()
        if words:
            rules[words[0]].setdefault(words[1], []).extend(words[2:])

    def points(name):
        return any(pointer or (kind in structs and points(kind)) for _, kind, pointer, _ in structs[name])

    def check(name, named, found, what):
        errors.extend(f"struct {name}: {m} {what}" for m in found if m not in named)
        errors.extend(f"struct {name}: it has no such member: {m}" for m in named if m not in found)

    rows, todo, seen = [], list(rules["pointers"]), set()
    for name in [*rules["pointers"], *rules["kept"], *rules["left"]]:
        if name not in structs:
            sys.exit(f"{path}: there is no struct {name}")
    for name, named in rules["pointers"].items():
        check(name, named,
              [m for m, kind, pointer, _ in structs[name] if pointer or (kind in structs and points(kind))],
              "is or holds a pointer: say what becomes of it where the struct is saved, and name it here")
    for name in {**rules["kept"], **rules["left"]}:
        kept = rules["kept"].get(name, [])
        check(name, kept + rules["left"].get(name, []), [m for m, *_ in structs[name]],
              "is new: say whether snapshots keep it, and name it here")
        rows += [("SINGLE", name, m, None) for m in kept]
        todo += [kind for m, kind, pointer, _ in structs[name] if m in kept and kind in structs and not pointer]
    while todo:
        name = todo.pop(0)
        if name in seen or name in rules["kept"] or name in rules["left"]:
            continue
        seen.add(name)
        rows += [("PLACED", name, m, "void *" if pointer else kind) for m, _, pointer, kind in structs[name]]
        todo += [kind for _, kind, pointer, _ in structs[name] if kind in structs and not pointer]
    if errors:
        sys.exit("\n".join(f"{path}: {error}" for error in errors))
    with open(sys.argv[2], "w") as out:
        out.write("/* Made by replay/index/layout.py from layout.txt. */\n#define SNAPSHOT_MEMBERS(PLACED, SINGLE)")
        out.writelines(
            f" \\\n\t{how}({name}, {member}{', ' + kind if kind else ''})" for how, name, member, kind in rows)
        out.write("\n")


main()
