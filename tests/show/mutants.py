#!/usr/bin/python3
"""tests/show/mutants.py BUILD [COUNT]: damaged recordings: no crash, no hang, bounded memory, exit code 0 or 3.

COUNT mutants (10,000) are shared out among recordings made here of programs of ours, glxgears and two screen savers; what
breaks is kept in BUILD/show/mutants/.
"""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEAD = 300_000  # bytes of the unpacked stream: two frames or more of each

PROGRAMS = {
    "two_triangles": ["corpus/two_triangles", "--frames", "6"],
    "cornell": ["corpus/cornell", "--frames", "3", "--vbo"],
    "glxgears": ["timeout", "2", "glxgears"],
    "queens": ["timeout", "3", "/usr/libexec/xscreensaver/queens", "-geometry", "200x200"],
    "molecule": ["timeout", "3", "/usr/libexec/xscreensaver/molecule", "-geometry", "200x200"],
}


def main(build, count):
    os.environ["RELUME"] = str(build / "relume")
    sys.path[:0] = [str(ROOT / "tests/fuzz"), str(ROOT / "tests/real")]
    sys.dont_write_bytecode = True
    import mutate
    folder = build / "show" / "mutants"
    folder.mkdir(parents=True, exist_ok=True)
    rows, broken = [], 0
    for seed, (name, command) in enumerate(PROGRAMS.items()):
        trace = folder / f"{name}.trace"
        program = [str(build / command[0]) if "/" in command[0] and command[0][0] != "/" else command[0], *command[1:]]
        # A program that `timeout` ends has recorded what it could; whether it did, unpacking tells.
        subprocess.run([ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--", *program], check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        share = count // len(PROGRAMS)
        print(f"{name}: {share} mutants", flush=True)
        wrong = mutate.main(trace, share, seed, HEAD)
        broken += wrong
        rows.append({"what": f"{name}: {share} mutants, info and scene of each", "figure": f"{wrong} break a run", "bar": "0",
                     "peer": None, "passed": wrong == 0})
    (build / "show" / "mutants.json").write_text(json.dumps({"name": "mutants", "command": "make show-mutants", "rows": rows}, indent=1))
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 10_000))
