#!/usr/bin/python3
"""tests/show/oclgrind.py BUILD (as `make show-oclgrind`): every kernel checked while it runs.

tests/bench/tiny renders scenes of 7 x 7 pixels that exercise every shading kernel, once with each family of traversal
kernels. oclgrind interprets the kernels and reports out-of-bounds accesses and data races. valgrind runs the C twins,
whose shading is the same text, and reports branches on uninitialised values.

oclgrind's own check for uninitialised values is not used: for an unknown reason it reports values that the host wrote
into the middle of a buffer, although the pictures agree with the twins'. The build for oclgrind disables optimisation,
which emits calls that oclgrind does not know, and compiler built-ins.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

BUILD_OPTIONS = "-cl-opt-disable -D LANES_PORTABLE"
FAMILIES = ("packets", "binary", "compressed")
PICTURES = 5


def oclgrind(build, family):
    with tempfile.NamedTemporaryFile("r", suffix=".log") as log:
        run = subprocess.run(["oclgrind", "--data-races", "--max-errors", "1000", "--log", log.name, "--build-options",
                              BUILD_OPTIONS, build / "tests/bench/tiny", "0", family],
                             capture_output=True, text=True, check=False)
        said = log.read()
    pictures = len(re.findall(rf"^{family} \w+: ", run.stdout, re.MULTILINE))
    problems = len(re.findall(r"^(?:Invalid|Read-write|Write-write|Work-group divergence|OCLGRIND)", said,
                              re.MULTILINE))
    if said.strip() and not problems:
        problems = said.count("\n\n") + 1  # any message is a problem
    if problems or run.returncode:
        print(said[:3000], run.stdout[-500:], run.stderr[-500:], sep="\n")
    return pictures if run.returncode == 0 else 0, problems


def main(build):
    version = subprocess.run(["oclgrind", "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    rows = []
    for family in FAMILIES:
        pictures, problems = oclgrind(build, family)
        rows.append({"what": f"{family}: {PICTURES} pictures, out-of-bounds accesses and races",
                     "figure": f"{problems} in {pictures} pictures", "bar": f"0 in {PICTURES} pictures",
                     "peer": f"Oclgrind {version}", "passed": problems == 0 and pictures == PICTURES})
    for family in FAMILIES:
        run = subprocess.run(["valgrind", "-q", "--error-exitcode=9", build / "tests/bench/tiny", "reference", family],
                             capture_output=True, text=True, check=False)
        problems = len(re.findall(r"== (?:Conditional jump|Use of uninit|Invalid read|Invalid write)", run.stderr))
        rows.append({
            "what": f"{family}, C twins: uninitialised values, invalid accesses", "figure": f"{problems}", "bar": "0",
            "peer": "Valgrind", "passed": problems == 0 and run.returncode == 0
        })
    out = build / "show" / "oclgrind.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps({"name": "oclgrind", "command": "make show-oclgrind", "rows": rows}, indent=1) + "\n")
    for row in rows:
        print(f"{row['what']}: {row['figure']} (bar: {row['bar']}; {row['peer']})")
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
