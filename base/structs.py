"""The members of structs in C, for scripts that check lists of them."""
import re


def structs_of(text):
    """{name: [(member, type, is a pointer, type in C)]} of all structs that are defined in preprocessed C."""
    structs = {}
    for match in re.finditer(r"\bstruct (\w+)\s*\{", text):
        depth, end = 1, match.end()
        while depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        structs[match[1]] = members_of(text[match.end():end - 1])
    return structs


def members_of(body):
    members = []
    body = re.sub(r"\bunion\s*\{([^{}]*)\}\s*;", r"\1", body)  # members of an anonymous union belong to the struct
    body = re.sub(r"\(\s*\*\s*(\w+)\)\s*\([^()]*\)", r"*\1", body)  # a function pointer
    for declaration in body.split(";"):
        match = re.match(r"\s*((?:const |struct |enum |union )*\w+(?: int| long| char)*)\b(.*)", declaration, re.S)
        if not match:
            continue
        for declarator in re.sub(r"\[[^\]]*\]", "", match[2]).split(","):
            name = re.search(r"(\w+)\W*$", declarator)
            if name:
                members.append((name[1], match[1].split()[-1], "*" in declarator, match[1].replace("const ", "")))
    return members
