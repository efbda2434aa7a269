#!/usr/bin/python3
# limit: 900 s
"""relume ci on glxgears, on a program of the corpus and on a viewer written for this test: new, approved, unchanged and
changed pictures; any change causes a recording."""
import os
import re
import random
import shutil
import sys
import xml.etree.ElementTree

from helpers import RELUME, ROOT, SCRATCH, check, corpus, finish, must, on_display, relume, run
from servers import annotations, junit_faults

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import ci_touched  # noqa: E402

KEPT, APPROVED = SCRATCH / "ci", SCRATCH / "approved"
NOTHING = "recorded nothing"


def ci(name, *words, frames=3):
    return on_display(RELUME, "ci", "--when-changed", "-n", name, "-f", frames, "-k", KEPT, "-b", APPROVED, *words,
                      timeout=300, cwd=SCRATCH)


def said(done):
    return f"exit code {done.returncode}\n{done.stdout}{done.stderr}"


def kept(name):
    cases = list(xml.etree.ElementTree.parse(KEPT / name / "junit.xml").getroot().iter("testcase"))
    return (KEPT / name / "report/index.html").exists(), len(cases), sum(c.find("failure") is not None for c in cases)


def approve(name):
    must(relume("approve", "--reason", "right", KEPT / name / "frames", APPROVED / name))


def test_programs():
    """Life of a program: not approved; approved; unchanged; another picture; removed."""
    for name, program in (("glxgears", ["glxgears"]), ("box", [corpus("cornell"), "--frames", "3"])):
        done = ci(name, "--", *program)
        check(done.returncode == 4, f"{name}: unapproved frames: {said(done)}")
        check(kept(name)[:2] == (True, 3), f"{name}: page and results are kept: {kept(name)}")
        approve(name)
        before = {f: f.stat().st_mtime_ns for f in (KEPT / name).rglob("*.exr")}
        done = ci(name, "--", *program)
        check(done.returncode == 0, f"{name}: approved: {said(done)}")
        check(NOTHING in done.stdout, f"{name}: nothing is recorded without a change")
        check(len(before) == 3 and before == {f: f.stat().st_mtime_ns for f in (KEPT / name).rglob("*.exr")},
              f"{name}: nothing is rendered without a change")
    done = ci("box", "--", corpus("cornell"), "--frames", "3", "--mirror")
    check(done.returncode == 1, f"a changed picture fails: {said(done)}")
    page, cases, failures = kept("box")
    check(page and cases == 3 and failures == 3, f"page and results show the failure: {page}, {failures} of {cases}")
    done = ci("box", "--", "no-such-program")
    check(done.returncode == 5 and "program not found: 'no-such-program'" in done.stderr, f"no such program: {said(done)}")
    error = xml.etree.ElementTree.parse(KEPT / "box/junit.xml").getroot().find(".//error")
    check(not (KEPT / "box/report").exists() and error is not None,
          "the page of an earlier run is gone; the results name the error")
    done = ci("box", "--", "false")
    check(done.returncode == 5 and "ended with exit code 1" in done.stderr, f"a program that fails: {said(done)}")
    done = ci("box", "--", "true")
    check(done.returncode == 5 and "nothing was recorded" in done.stderr, f"a program without pictures: {said(done)}")


# --- Any change causes a recording ----------------------------------------------------------------------------------

def build_shape(facing):
    must(
        run("cc", "-shared", "-fPIC", f"-DFACING={facing}", "-o", SCRATCH / "libshape.so",
            ROOT / "tests/real/ci_shape.c"))


def build_viewer(shine):
    must(
        run("cc", f"-DSHINE={shine}", "-o", SCRATCH / "viewer", ROOT / "tests/real/ci_viewer.c", f"-L{SCRATCH}",
            "-lshape", f"-Wl,-rpath,{SCRATCH}", "-lglut", "-lGL", "-lm"))


def write(name, text):
    (SCRATCH / name).write_text(text)


VIEWER = ("--", "./viewer", "model.obj", "3")
MODEL, OTHER = "-1 -1 1 -1 0 1\n", "-1 -1 1 -1 0 0.5\n"
# Thing to change, how to change it and back; options needed for both.
CHANGES = {
    "the file that its argument names": (lambda: write("model.obj", OTHER), lambda: write("model.obj", MODEL), ()),
    "a library that it links": (lambda: build_shape(-1), lambda: build_shape(1), ()),
    "the program": (lambda: build_viewer(0.9), lambda: build_viewer(0), ()),
    "a file that --data names": (lambda: write("hidden.dat", "0.5\n"), lambda: write("hidden.dat", "1\n"),
                                 ("--data", "hidden.dat")),
    "a folder that --data names": (lambda: write("data/new", "1\n"), lambda:
                                   (SCRATCH / "data/new").unlink(), ("--data", "data")),
}


def test_changes():
    """Each watched thing is changed, one at a time: the program is recorded again and its pictures differ. Changed
    back: the approved pictures. Without a change, nothing is recorded."""
    (SCRATCH / "data/deep").mkdir(parents=True)
    write("data/deep/file", "1\n")
    for _, back, _ in CHANGES.values():
        if back is not CHANGES["a folder that --data names"][1]:
            back()
    ci("viewer", *VIEWER)
    approve("viewer")
    for what, (change, back, options) in CHANGES.items():
        ci("viewer", *options, *VIEWER)
        done = ci("viewer", *options, *VIEWER)
        check(done.returncode == 0 and NOTHING in done.stdout, f"{what}: nothing touched: {said(done)}")
        change()
        done = ci("viewer", *options, *VIEWER)
        changes_picture = "folder" not in what
        check(NOTHING not in done.stdout and done.returncode == changes_picture, f"{what} has changed: {said(done)}")
        back()
        done = ci("viewer", *options, *VIEWER)
        check(NOTHING not in done.stdout and done.returncode == 0, f"{what}: back again: {said(done)}")
    done = ci("viewer", "--env", "VIEWER_GREEN=0.9", *VIEWER)
    check(NOTHING not in done.stdout and done.returncode == 1, f"a variable: {said(done)}")
    done = ci("viewer", "--env", "VIEWER_GREEN=0.8", *VIEWER)
    check("environment: " in done.stdout and done.returncode == 1, f"its value: {said(done)}")
    write("copy.obj", MODEL)
    done = ci("viewer", "--", "./viewer", "copy.obj", "3")
    check(NOTHING not in done.stdout and done.returncode == 0, f"another argument: {said(done)}")
    done = on_display(RELUME, "ci", "-n", "viewer", "-f", "3", "-k", KEPT, "-b", APPROVED, "--", "./viewer", "copy.obj",
                      "3", timeout=300, cwd=SCRATCH)
    check("record 3 frames" in done.stdout and done.returncode == 0, f"by default it always records: {said(done)}")
    (KEPT / "viewer/viewer.trace").unlink()
    done = ci("viewer", "--", "./viewer", "copy.obj", "3")
    check(NOTHING not in done.stdout and done.returncode == 0, f"the recording is gone: {said(done)}")
    done = ci("viewer", "--data", "no-such.dat", *VIEWER)
    check(done.returncode == 3 and "no-such.dat: is neither a file nor a folder" in done.stderr,
          f"--data of nothing: {said(done)}")


def test_opened():
    """Every file that the program opens, as listed by strace, is watched, or reported as not watched."""
    if not shutil.which("strace"):
        print("no strace here: opened files are not listed")
        return
    must(
        on_display("strace", "-f", "-e", "trace=open,openat,execve", "-o", SCRATCH / "opened", "./viewer", "model.obj",
                   "3", cwd=SCRATCH))
    succeeded = re.findall(r'(?:openat\(AT_FDCWD, |open\(|execve\()"([^"]+)".* = \d+$',
                           (SCRATCH / "opened").read_text(), re.M)
    opened = {os.path.realpath(SCRATCH / path) for path in succeeded}
    opened = {path for path in opened if os.path.isfile(path) and not path.startswith(("/proc", "/sys", "/dev"))}
    done = ci("viewer", *VIEWER)
    lines = (KEPT / "viewer/inputs").read_text()
    watched = {os.path.realpath(SCRATCH / path) for path in re.findall(r'^file \w+ "(.*)"$', lines, re.M)}
    ours = {os.path.realpath(SCRATCH / name) for name in ("viewer", "libshape.so", "model.obj")}
    check(ours <= opened & watched, f"files opened and watched: {ours - opened}, {ours - watched}")
    check(os.path.realpath(SCRATCH / "hidden.dat") in opened - watched, "strace lists the file that nothing names")
    check(
        f"watched: {len(watched)} files" in done.stdout
        and "other files that the program opens are not watched: name them with --data" in done.stdout,
        f"the other {len(opened - watched)} files are said not to be watched: {said(done)}")
    unnamed = {path for path in opened - watched if path.startswith(str(SCRATCH))}
    done = ci("viewer", *(word for path in sorted(unnamed) for word in ("--data", path)), *VIEWER)
    check(f"watched: {len(watched) + len(unnamed)} files" in done.stdout and NOTHING not in done.stdout,
          f"named, they are watched: {said(done)}")
    done = ci("viewer", "--", "./viewer", "model.obj", "3", "data")
    check("folders named by its arguments (data)" in done.stdout,
          f"a folder among the arguments is named: {said(done)}")
    done = ci("viewer", "--", "env", "VIEWER_GREEN=0.9", "./viewer", "model.obj", "3")
    check("libshape.so" in (KEPT / "viewer/inputs").read_text(),
          f"libraries of a program among the arguments are watched: {said(done)}")


def test_touched():
    """The short form of show-ci: some of the files that a program opens are touched, one at a time; only watched ones
    cause a recording."""
    if not shutil.which("strace"):
        print("no strace here: opened files are not touched")
        return
    folder = SCRATCH / "touched"
    folder.mkdir()
    for name in ("viewer", "libshape.so", "model.obj", "hidden.dat"):
        shutil.copy(SCRATCH / name, folder)
    (folder / "start").write_text('#!/bin/sh\nLD_LIBRARY_PATH="$PWD" exec ./viewer model.obj 1\n')
    (folder / "start").chmod(0o755)
    for command in (("./viewer", "model.obj", "1"), ("./start", ), ("env", "VIEWER_GREEN=0.5", "./viewer", "model.obj",
                                                                    "1")):
        program = ci_touched.Touched(RELUME, folder, *command)
        files = re.findall(r'^file \w+ "(.*)"$', program.inputs, re.M)
        check(
            len(files) == len({os.path.realpath(folder / path) for path in files}),
            f"{command}: each file once: {files}")
        paths = [path for path in ci_touched.opened(command, folder) if program.can_touch(path)]
        ours = [str(folder / name) for name in ("viewer", "model.obj", "hidden.dat")]
        check(set(ours) <= set(paths), f"{command}: strace lists {paths}")
        more = [path for path in paths if path not in ours]
        for path in (None, *ours, *random.Random(1).sample(more, min(3, len(more)))):
            wrong = program.verdict(path)
            check(not wrong, f"{command}: {path} touched: {wrong}")
        shutil.rmtree(program.kept)


def test_press():
    """Keys arrive at their frames in every run, and count as a watched input."""
    pressed = ("--press", "s@1", "--press", "s@2")
    check(ci("keys", *pressed, *VIEWER).returncode == 4, "a program with keys")
    approve("keys")
    for _ in range(2):
        done = ci("keys", *pressed, *VIEWER)
        check(done.returncode == 0 and NOTHING in done.stdout, f"the same keys: {said(done)}")
    (KEPT / "keys/keys.trace").unlink()
    done = ci("keys", *pressed, *VIEWER)
    check(done.returncode == 0 and "record 3 frames: its recording is gone" in done.stdout,
          f"recorded again, the same pictures: {said(done)}")
    for other, n_wrong in ((("--press", "s@1"), 1), (("--press", "s@2"), 2), ((), 2)):
        done = ci("keys", *other, *VIEWER)
        check(done.returncode == 1 and 'press: "s@' in done.stdout and kept("keys")[1:] == (3, n_wrong),
              f"{other}: {kept('keys')}, {said(done)}")
    done = ci("keys", "--press", "s@3", *VIEWER)
    check(done.returncode == 5 and "the program ends after 3 frames" in done.stderr,
          f"a key after the last frame: {said(done)}")


def test_frames():
    """If fewer frames are requested, old ones are neither offered for approval nor missing; if the program ends early,
    they are missing."""
    check(ci("viewer", "--", "./viewer", "model.obj", "12", frames=12).returncode == 4, "12 frames: 9 are new")
    approve("viewer")
    done = ci("viewer", "--", "./viewer", "model.obj", "12", frames=8)
    left = sorted(path.name for path in (KEPT / "viewer/frames").glob("*.exr"))
    check(done.returncode == 0 and left == [f"viewer.{i:04}.exr" for i in range(8)], f"8 of 12: {left}: {said(done)}")
    done = ci("viewer", "--", "./viewer", "model.obj", "5", frames=8)
    check(done.returncode == 1 and done.stdout.count(" missing") >= 1 and kept("viewer")[1:] == (8, 3),
          f"it ends after 5 of 8: {said(done)}")


TIMED = """programs:
- {name: a, command: [./timed, a, model.obj, "3"], frames: 2, press: [s@1]}
- {name: b, command: [./timed, b, model.obj, "3"], frames: 2, environment: [VIEWER_GREEN=0.7]}
- {name: c, command: [./timed, c, no-such.obj, "3"], frames: 2}
- {name: d, command: ["false"], frames: 2}
"""


def in_turn(all_of_file):
    """Lines of a program stay together, regardless of how many run in parallel."""
    done = all_of_file("--jobs", "4")
    names = [line.split(":")[0] for line in done.stdout.splitlines() if line.startswith(("one:", "two:"))]
    check(names == sorted(names[:-2]) + ["one", "two"], f"in turn: {said(done)}")


def test_jobs():
    """Several programs at once: on a shared display one after the other, each with its own keys; and the reports for CI
    servers.
    """
    write("hidden.dat", "1\n")
    write("relume-ci.yaml", TIMED)
    write(
        "timed",
        '#!/bin/sh\necho "begin $1" >>times\nname=$1; shift; ./viewer "$@"; code=$?\nsleep 0.5; echo "end $name" '
        '>>times; exit $code\n'
    )
    (SCRATCH / "timed").chmod(0o755)
    def server(*words, start=ROOT / "tests/xvfb.sh"):
        for name in ("times", "step-summary"):
            (SCRATCH / name).unlink(missing_ok=True)
        return run(
            *((start, ) if start else ()), RELUME, "ci", "-b", "approved3", *words, timeout=300, cwd=SCRATCH, env={
                **os.environ, "GITHUB_ACTIONS": "true", "GITHUB_STEP_SUMMARY": str(SCRATCH / "step-summary"),
                "DISPLAY": ":none"
            })
    done = server("-j", "4")
    times = (SCRATCH / "times").read_text().splitlines()
    check(done.returncode == 5 and len(times) == 6 and all(times[i][5:] == times[i + 1][3:] for i in (0, 2, 4)),
          f"one at a time on a display: {times}")
    check("a: not approved yet\nb: not approved yet\nc: not approved yet\nd: could not be compared\n" in done.stdout,
          f"all of them: {said(done)}")
    summaries = re.findall(r"^### .*", (SCRATCH / "step-summary").read_text(), re.M)
    check(
        len(summaries) == 4
        and [n for n in "abcd" if n in summaries["abcd".index(n)].split("relume")[1]] == list("abcd"),
        f"summaries in order: {summaries}")
    marks = annotations(done.stdout)
    check(("error", {"title": "relume ci d"}, "record failed with exit code 5; the log says why") in marks
          and len(marks) == 7, f"marks: {marks}")
    reports = [KEPT / name / "junit.xml" for name in "abcd"]
    check(not junit_faults(*reports), f"reports of one job: {junit_faults(*reports)}")
    for name in "abc":
        must(relume("approve", KEPT / name / "frames", SCRATCH / "approved3" / name))
    write("relume-ci.yaml", TIMED.replace("s@1", "s@2").replace("frames: 2", "frames: 3", 1))
    done = server("-j", "4", "-n", "a")
    check(
        done.returncode == 1 and {kind for kind, *_ in annotations(done.stdout)} == {"error"}
        and not junit_faults(KEPT / "a/junit.xml"), f"pictures have changed: {said(done)}")
    write("relume-ci.yaml", TIMED[:TIMED.index("- {name: d")])
    if not shutil.which("xvfb-run"):
        print("no xvfb-run here: separate displays were not tested")
        return
    done = server("-j", "3", "--xvfb", start=None)
    check(done.returncode == 0 and "a: passed\nb: passed\nc: passed\n" in done.stdout and not annotations(done.stdout),
          f"each on its display: {said(done)}")
    done = run(RELUME, "ci", "--xvfb", "-n", "a", "-b", "approved3", cwd=SCRATCH,
               env={**os.environ, "PATH": "/nowhere"})
    check(done.returncode == 5 and "--xvfb needs the program 'xvfb-run'" in done.stderr, f"no xvfb-run: {said(done)}")


def test_bisect():
    """Exit codes for git bisect run: 125 if a commit cannot be judged."""
    (SCRATCH / "relume-ci.yaml").unlink(missing_ok=True)
    done = run(RELUME, "ci", cwd=SCRATCH)
    check(done.returncode == 3 and done.stderr.count("\n") == 1 and "relume ci -- " in done.stderr
          and "relume help ci-file" in done.stderr, f"neither a list nor a program: {said(done)}")
    check(ci("bisected", "--bisect", *VIEWER).returncode == 125, "--bisect, not approved")
    approve("bisected")
    for program, code in ((("--", "false"), 125), (("--", "no-such-program"), 125), (VIEWER, 0),
                          (("--env", "VIEWER_GREEN=0.9", *VIEWER), 1)):
        done = ci("bisected", "--bisect", *program)
        check(done.returncode == code, f"--bisect {program}: {said(done)}")


def test_file():
    """All programs of relume-ci.yaml in one run; one of them by name; errors in the file name the line."""
    write("relume-ci.yaml", f"""baseline: approved2
programs:
- name: one
  command: [./viewer, model.obj, "3"]
  frames: 2
- name: two
  command: [./viewer, model.obj, "3"]
  frames: 2
  environment: [VIEWER_GREEN=0.7]
  data: [hidden.dat]
""")
    def all_of_file(*words):
        return on_display(RELUME, "ci", "--when-changed", *words, timeout=300, cwd=SCRATCH)
    done = all_of_file()
    check(done.returncode == 4 and "one: not approved yet\ntwo: not approved yet\n" in done.stdout,
          f"a file of two: {said(done)}")
    for name in ("one", "two"):
        must(relume("approve", KEPT / name / "frames", SCRATCH / "approved2" / name))
    done = all_of_file()
    check(done.returncode == 0 and done.stdout.count(NOTHING) == 2 and "one: passed\ntwo: passed\n" in done.stdout,
          f"approved: {said(done)}")
    in_turn(all_of_file)
    write("hidden.dat", "0.7\n")
    done = all_of_file()
    check(done.returncode == 1 and done.stdout.count(NOTHING) == 1 and "one: passed\ntwo: failed" in done.stdout,
          f"data of the second: {said(done)}")
    write("relume-ci.yaml", (SCRATCH / "relume-ci.yaml").read_text().replace("0.7", "0.6"))
    done = all_of_file("-n", "two")
    check(done.returncode == 1 and "environment: " in done.stdout and "one:" not in done.stdout,
          f"only the second, its variable: {said(done)}")
    check(all_of_file("-n", "three").returncode == 2, "a name that the file lacks")
    check(all_of_file("--data", "x").returncode == 2, "options of a program without one")
    for text, said_of_it in (("programs:\n- name: a\n  comand: [x]\n",
                              "line 3"), ("programs:\n- {name: a/b, command: [x]}\n", "'a/b' cannot be the name"),
                             ("programs:\n- {command: [x]}\n- {command: [y/x]}\n", "two programs are called 'x'"),
                             ("programs:\n- {command: [x], environment: [A]}\n", "not NAME=VALUE")):
        write("relume-ci.yaml", text)
        done = all_of_file()
        check(done.returncode == 3 and said_of_it in done.stderr and done.stderr.count("\n") == 1,
              f"{text!r}: {said(done)}")
    (SCRATCH / "relume-ci.yaml").unlink()
    check(all_of_file().returncode == 3, "no file")


test_programs()
test_changes()
test_opened()
test_touched()
test_frames()
test_press()
test_file()
test_jobs()
test_bisect()
finish()
