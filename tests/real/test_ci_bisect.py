#!/usr/bin/python3
# limit: 400 s
"""The short form of `make show-ci`: git bisect finds a program's fault and a renderer's fault at their commits; a
harmless change passes."""
import sys

from helpers import BUILD, ROOT, SCRATCH, check, finish, on_display

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import ci  # noqa: E402
import faults  # noqa: E402

if len(sys.argv) == 1:  # needs a display, like `make show-ci`
    done = on_display(sys.executable, __file__, "here", timeout=390)
    print(done.stdout, done.stderr, sep="")
    sys.exit(done.returncode)
(SCRATCH / "show").mkdir()
for name in ("relume", "tests"):
    (SCRATCH / name).symlink_to(BUILD / name)
names = {fault[0] for fault in faults.FAULTS}
check(ci.CHANGES.keys() <= names, f"source changes without a fault: {ci.CHANGES.keys() - names}")
repository = ci.Repository(SCRATCH)
for name in ("a light of another colour", "one NaN in a normal"):
    found = ci.fault(repository, name)
    check(found == "changed", f"{name}: git bisect finds commit '{found}'")
code = ci.harmless(repository, "other compression")
check(code == 0, f"other compression: exit code {code}")
finish()
