#!/usr/bin/python3
# limit: 400 s
"""The recipe for continuous integration, on glxgears and on a program of the corpus: new, approved, unchanged, changed."""
import os
import xml.etree.ElementTree

from helpers import RELUME, ROOT, SCRATCH, check, corpus, finish, must, relume, run

KEPT, APPROVED = SCRATCH / "ci", SCRATCH / "approved"


def ci(name, *program):
    return run(ROOT / "tests/xvfb.sh", ROOT / "corpus/ci.sh", "-n", name, "-f", "3", "-k", KEPT, "-b", APPROVED, "--", *program,
               env=dict(os.environ, RELUME=RELUME), timeout=300)


def kept(name):
    cases = list(xml.etree.ElementTree.parse(KEPT / name / "junit.xml").getroot().iter("testcase"))
    return (KEPT / name / "report/index.html").exists(), len(cases), sum(c.find("failure") is not None for c in cases)


for name, program in (("glxgears", ["glxgears"]), ("box", [corpus("cornell"), "--frames", "3"])):
    done = ci(name, *program)
    check(done.returncode == 4, f"{name}: frames that nobody approved: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    check(kept(name)[:2] == (True, 3), f"{name}: page and results are kept: {kept(name)}")
    must(relume("approve", "--reason", "first", KEPT / name / "frames", APPROVED / name))
    before = {f: f.stat().st_mtime_ns for f in (KEPT / name).rglob("*.exr")}
    done = ci(name, *program)
    check(done.returncode == 0, f"{name}: approved: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    check("record   nothing" in done.stdout, f"{name}: nothing is recorded where nothing changed")
    check(len(before) == 3 and before == {f: f.stat().st_mtime_ns for f in (KEPT / name).rglob("*.exr")},
          f"{name}: nothing is rendered where nothing changed")

done = ci("box", corpus("cornell"), "--frames", "3", "--mirror")
check(done.returncode == 1, f"a changed picture fails: exit code {done.returncode}\n{done.stdout}{done.stderr}")
page, cases, failures = kept("box")
check(page and cases == 3 and failures == 3, f"and the page and results tell: {page}, {failures} of {cases}")
done = ci("box", "no-such-program")
check(done.returncode == 5 and "no program" in done.stderr, f"no such program: {done.returncode}, {done.stderr}")
finish()
