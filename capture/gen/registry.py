"""Khronos' XML registries (Debian package khronos-api) and headers as plain Python objects, for the generators of
capture/ and replay/.

Standard library only. Results have a fixed order, so that generated files are the same each time.
"""
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field

DIRECTORY = "/usr/share/khronos-api"


@dataclass
class Param:
    name: str
    type: str            # C type as declared: "const GLfloat *"
    group: str = ""      # enum group, if the registry names one
    length: str = ""     # the registry's len attribute: "4", "count*3", "COMPSIZE(pname)", ""

    @property
    def pointer(self):
        return self.type.count("*")


@dataclass
class Command:
    name: str
    result: str          # C type; "void" for none
    params: list
    alias: str = ""      # the command it is the same as
    versions: list = field(default_factory=list)    # features that require it: ["GL_VERSION_1_0"]
    extensions: list = field(default_factory=list)  # extensions that require it
    group: str = ""      # enum group of the result, if the registry names one


def _plain(text):
    """A C type with its spaces and stars written one way."""
    return re.sub(r"\s*\*\s*", " *", re.sub(r"\s+", " ", text)).replace("* *", "**").strip()


def _declaration(element):
    """The C type of a <proto> or <param>: all its text but the name."""
    text = element.text or ""
    for child in element:
        if child.tag != "name":
            text += child.text or ""
        text += child.tail or ""
    return _plain(text)


def read(file_name):
    """(commands, enums) of one registry: {name: Command} and {name: int}, both sorted by name."""
    root = ElementTree.parse(f"{DIRECTORY}/{file_name}").getroot()
    commands = {}
    for element in root.iterfind("commands/command"):
        proto = element.find("proto")
        alias = element.find("alias")
        params = [Param(p.find("name").text, _declaration(p), p.get("group", ""), p.get("len", ""))
                  for p in element.iterfind("param")]
        name = proto.find("name").text
        commands[name] = Command(name, _declaration(proto), params, alias.get("name") if alias is not None else "",
                                 group=proto.get("group", ""))
    for feature in root.iterfind("feature"):
        for required in feature.iterfind("require/command"):
            commands[required.get("name")].versions.append(feature.get("name"))
    for extension in root.iterfind("extensions/extension"):
        for required in extension.iterfind("require/command"):
            commands[required.get("name")].extensions.append(extension.get("name"))
    enums = {}
    for element in root.iterfind("enums/enum"):
        if element.get("api") in (None, "gl") and not element.get("value").startswith('"'):
            enums[element.get("name")] = int(element.get("value"), 0)
    return dict(sorted(commands.items())), dict(sorted(enums.items()))


def read_header(file_name):
    """{name: Command} of a header's prototypes: "EGLAPI EGLint EGLAPIENTRY eglGetError (void);"."""
    with open(f"/usr/include/{file_name}", encoding="utf-8") as stream:
        text = re.sub(r"/\*.*?\*/", " ", stream.read(), flags=re.S)
    return dict(
        map(_prototype, re.findall(r"\b(?:EGL|GL)API\s+([^;()]+?)\s*\b\w*APIENTRY\s+(\w+)\s*\(([^;]*?)\)\s*;", text)))


def read_prototype(text):
    """name, Command of one prototype: "void *OSMesaCreateContext(GLenum format, void *sharelist)". None: not a
    prototype."""
    match = re.fullmatch(r"(.+?)\s*\b(\w+)\((.*)\)", text)
    return match and _prototype(match.groups())


def _prototype(parts):
    result, name, params = parts
    declared = [re.fullmatch(r"\s*(.+?)(\w+)\s*", part, re.S) for part in params.split(",") if part.strip() != "void"]
    return name, Command(name, _plain(result), [Param(match[2], _plain(match[1])) for match in declared])


@dataclass
class Enum:
    name: str
    value: int
    groups: list         # ["PrimitiveType"]
    bits: bool           # one flag of a bit mask


def read_enums(file_name):
    """Every enumerant of one registry with its groups, in the registry's order. Values that are not numbers are left
    out."""
    found = []
    for block in ElementTree.parse(f"{DIRECTORY}/{file_name}").getroot().iterfind("enums"):
        for element in block.iterfind("enum"):
            if element.get("api") not in (None, "gl") or element.get("value").startswith('"'):
                continue
            groups = [g for g in element.get("group", block.get("group", "")).split(",") if g]
            found.append(Enum(element.get("name"), int(element.get("value"), 0), groups,
                              block.get("type") == "bitmask"))
    return found
