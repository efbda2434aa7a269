"""Formats that CI servers read, as documented.

GitHub, "Workflow commands for GitHub Actions": a line `::NAME KEY=VALUE,KEY=VALUE::MESSAGE`; in the message %, CR and
LF are escaped (%25 %0D %0A), in values also : and , (%3A %2C). error, warning and notice take file, line, endLine, col,
endColumn and title.

GitLab, "Unit test reports": JUnit XML; it reads testsuite, testcase (classname, name, file, time), failure, error,
system-out and skipped. A case is identified by its classname and name: if a job has several with the same key, only the
first counts. The elements and attributes are those of JUnit's schema as Jenkins publishes it (xunit-plugin,
junit-10.xsd).
"""
import re
import xml.etree.ElementTree

MARKS = {"error", "warning", "notice"}
MARK_KEYS = {"file", "line", "endLine", "col", "endColumn", "title"}
ESCAPED = r"(?:[^%\r\n]|%25|%0D|%0A)*"
ESCAPED_VALUE = r"(?:[^%\r\n:,]|%25|%0D|%0A|%3A|%2C)+"
COMMAND = re.compile(rf"::(\w+)(?: (\w+={ESCAPED_VALUE}(?:,\w+={ESCAPED_VALUE})*))?::({ESCAPED})")

COUNT, SECONDS, TEXT = r"\d+", r"\d+(\.\d+)?", r"(?s:.+)"
# element: (its attributes, required ones with *), and its child elements
JUNIT = {
    "testsuites": ({
        "name": TEXT, "time": SECONDS, "tests": COUNT, "failures": COUNT, "errors": COUNT, "disabled": COUNT
    }, {"testsuite"}),
    "testsuite": ({
        "name*": TEXT, "tests*": COUNT, "failures": COUNT, "errors": COUNT, "skipped": COUNT, "disabled": COUNT,
        "time": SECONDS, "timestamp": TEXT, "hostname": TEXT, "id": TEXT, "package": TEXT
    }, {"properties", "testcase", "system-out", "system-err"}),
    "properties": ({}, {"property"}),
    "property": ({"name*": TEXT, "value*": TEXT}, set()),
    "testcase": ({
        "name*": TEXT, "classname*": TEXT, "file": TEXT, "time": SECONDS, "assertions": COUNT, "status": TEXT
    }, {"skipped", "error", "failure", "system-out", "system-err"}),
    "failure": ({"message": TEXT, "type": TEXT}, set()),
    "error": ({"message": TEXT, "type": TEXT}, set()),
    "skipped": ({"message": TEXT}, set()),
    "system-out": ({}, set()),
    "system-err": ({}, set()),
}


def annotations(text):
    """(kind, {key: value}, message) of each annotation; ValueError if a line that begins with "::" is malformed."""
    found = []
    for line in text.splitlines():
        if not line.startswith("::"):
            continue
        match = COMMAND.fullmatch(line)
        values = dict(pair.split("=", 1) for pair in (match[2] or "").split(",") if pair) if match else {}
        if not match or match[1] not in MARKS or not values.keys() <= MARK_KEYS or not match[3]:
            raise ValueError(f"not an annotation command: {line!r}")
        found.append((match[1], values, match[3]))
    return found


def _wrong(element):
    attributes, inner = JUNIT.get(element.tag, (None, None))
    if attributes is None:
        return [f"no element '{element.tag}'"]
    known = {name.rstrip("*"): form for name, form in attributes.items()}
    wrong = [
        f"{element.tag} lacks {name[:-1]}" for name in attributes
        if name.endswith("*") and name[:-1] not in element.attrib
    ]
    wrong += [
        f"{element.tag}: {name}={value!r}" for name, value in element.attrib.items()
        if not re.fullmatch(known.get(name, r"(?!)"), value)
    ]
    for child in element:
        wrong += _wrong(child) if child.tag in inner else [f"{child.tag} in {element.tag}"]
    return wrong


def junit_faults(*paths):
    """Faults in the reports of one job; [] if there are none."""
    wrong, keys = [], set()
    for path in paths:
        root = xml.etree.ElementTree.parse(path).getroot()
        wrong += [f"{path}: {fault}" for fault in _wrong(root)] + (
            [] if path.suffix == ".xml" and root.tag in ("testsuites", "testsuite") else [f"{path}: no report"])
        for suite in root.iter("testsuite"):
            cases = suite.findall("testcase")
            for name, kind in (("tests", None), ("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
                counted = sum(kind is None or case.find(kind) is not None for case in cases)
                if int(suite.get(name, counted)) != counted:
                    wrong.append(f"{path}: {name}={suite.get(name)}, but counted {counted}")
        for case in root.iter("testcase"):
            key = (case.get("classname"), case.get("name"))
            wrong += [f"{path}: GitLab drops a second {key}"] if key in keys else []
            keys.add(key)
    return wrong
