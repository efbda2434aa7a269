#!/usr/bin/python3
"""tests/show/ci.py BUILD [--only PART...] (as `make show-ci`): does `relume ci` lead `git bisect run` to the commit
that broke the picture?

The faults and harmless variations are those of faults.py. Each gets a git repository with a history of three commits:
the approved program (corpus/still_life.c), the change, and an unrelated commit. Faults in OpenGL calls are changes to
the program's source; faults in frames come from a renderer that produces such frames (ci_step.py). A change that gate B
reports by design (different bytes on the approved device) is approved in the commit that makes it.

Then --when-changed is tested: each file that some programs open is touched, one at a time (ci_touched.py).
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
import ci_touched  # noqa: E402
import faults  # noqa: E402
from table import Shown  # noqa: E402

PLAN = """programs:
- name: s
  command: [sh, -c, "cc -std=c11 -O2 -o still_life still_life.c -lglut -lGLU -lGL -lm && exec ./still_life --frames 2 --animate camera"]
  frames: 2
"""
OFF = {
    "a light is off": "glEnable(GL_LIGHT1);", "no blending": "glEnable(GL_BLEND);",
    "no alpha test": "glEnable(GL_ALPHA_TEST);", "no depth test": "glEnable(GL_DEPTH_TEST);",
    "no fog": "glEnable(GL_FOG);"
}
# Faults of faults.py that concern calls, as source changes: lists of (old text, new text), all applied together.
CHANGES = {
    "a box is not drawn": [("glDrawElements(GL_TRIANGLES, 36,", "glDrawElements(GL_TRIANGLES, 0,")],
    "a list is not found": [("glCallList(sphere)", "glCallList(99)")],
    "wrong textures": [("	glBindTexture(GL_TEXTURE_2D, textures[0]);\n	glEnable",
                        "	glBindTexture(GL_TEXTURE_2D, textures[1]);\n	glEnable"),
                       ("	glBindTexture(GL_TEXTURE_2D, textures[1]);\n	glBegin",
                        "	glBindTexture(GL_TEXTURE_2D, textures[0]);\n	glBegin")],
    "texture off by one texel": [("glTexCoord2f(corners[i][0] / 4,", "glTexCoord2f(corners[i][0] / 4 + 1.0f / TEXELS,")
                                 ],
    "texture not filtered": [("GL_TEXTURE_MAG_FILTER, i ? GL_NEAREST : GL_LINEAR", "GL_TEXTURE_MAG_FILTER, GL_NEAREST")
                             ],
    "texture clamped, not repeated": [("GL_TEXTURE_WRAP_S, GL_REPEAT", "GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE")],
    "texture replaces, not modulates": [("GL_MODULATE", "GL_REPLACE")],
    "swapped winding": [("glFrontFace(GL_CCW)", "glFrontFace(GL_CW)")],
    "a light is elsewhere": [("{ -3, 6, 3, 1 }", "{ 3, 6, 3, 1 }")],
    "a light of another colour": [("{ 0.3f, 0.25f, 0.2f, 1 }", "{ 0.2f, 0.25f, 0.3f, 1 }")],
    "half a pixel off": [("glFrustum(-0.4, 0.4,", "glFrustum(-0.3995, 0.4005,")],
    "wrong blend function": [("GL_ONE_MINUS_SRC_ALPHA", "GL_ONE")],
    "fog ends elsewhere": [("glFogf(GL_FOG_END, 22)", "glFogf(GL_FOG_END, 28)")],
    "wrong material": [("{ 0.8f, 0.2f, 0.15f, 1 }", "{ 0.8f, 0.24f, 0.15f, 1 }")],
    "wrong highlight": [("GL_SHININESS, 40", "GL_SHININESS, 20")],
    "flat, not smooth": [("GL_SMOOTH", "GL_FLAT")],
    "an object is elsewhere": [("glTranslatef(0.5f, 0, -2)", "glTranslatef(0.5f, 0.06f, -2)")],
    "an object is turned": [("glRotatef(25,", "glRotatef(29,")],
    "some vertices moved": [("			normals[k][axis] = side ? 1 : -1;\n", "			normals[k][axis] = side ? 1 : -1;\n"
                             "			positions[k][0] += positions[k][2] > 0 ? 0.15f : 0;\n")],
    "wrong clear colour": [("glClearColor(0.25f,", "glClearColor(0.3f,")],
    "wrong depth range": [("glDepthRange(0, 1)", "glDepthRange(0, 0.9)")],
    **{name: [(call, "")] for name, call in OFF.items()},
}
# Harmless variations that are also source changes. They alter the frame's bytes, so they are approved.
HARMLESS = {"edges off by 1/1000 pixel": [("glFrustum(-0.4, 0.4,", "glFrustum(-0.399999, 0.400001,")],
            "edges off by 1/4000 pixel": [("glFrustum(-0.4, 0.4,", "glFrustum(-0.40000025, 0.39999975,")]}


class Repository:
    """A git repository whose single branch starts with the approved program, tagged "good"."""

    def __init__(self, build):
        self.relume, self.folder = (build / "relume").resolve(), build.resolve() / "show/ci"
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        nobody = {f"GIT_{who}_{what}": "show-ci" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        self.environment = dict(os.environ, GIT_CONFIG_GLOBAL=os.devnull, GIT_CONFIG_SYSTEM=os.devnull,
                                STEP=str(ROOT / "tests/show/ci_step.py"), **nobody,
                                LD_PRELOAD=str(build.resolve() / "tests/real/step_shim.so"))
        self.log = open(build / "show/ci.log", "w", encoding="utf-8")
        for name in ("still_life.c", "program.h"):
            shutil.copy(ROOT / "corpus" / name, self.folder)
        self.write("relume-ci.yaml", PLAN)
        self.write(".gitignore", "ci/\nstill_life\n")
        self.run("git", "init", "-q", "-b", "main")
        self.ci(4)
        self.approve()
        self.commit("approve the program", "good")

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def run(self, *command, codes=(0,)):
        command = [str(word) for word in command]
        done = subprocess.run(command, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.log.write(f"$ {' '.join(command)}\n{done.stdout}exit code {done.returncode}\n")
        self.log.flush()
        if codes and done.returncode not in codes:
            sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}")
        return done

    def ci(self, *codes):
        """Run without a cache, as on a fresh machine."""
        shutil.rmtree(self.folder / "ci", ignore_errors=True)
        return self.run(self.relume, "ci", codes=codes).returncode

    def approve(self):
        self.run(self.relume, "approve", "--reason", "seen", "ci/s/frames", "approved/s")

    def commit(self, subject, tag):
        self.run("git", "add", "-A")
        self.run("git", "commit", "-q", "-m", subject)
        self.run("git", "tag", "-f", tag)

    def begin(self):
        self.run("git", "checkout", "-q", "-f", "-B", "main", "good")

    def end(self):
        """Add the last commit, which is unrelated to the picture."""
        self.write("README", "a still life\n")
        self.commit("say what it is", "last")

    def change(self, name, pairs):
        source = self.folder / "still_life.c"
        text, changed = source.read_text(encoding="utf-8"), []
        for was, now in pairs:
            if text.count(was) != 1:
                sys.exit(f"{name}: corpus/still_life.c does not contain '{was}' exactly once")
            changed.append((text.index(was), was, now))
        for at, was, now in sorted(changed, reverse=True):
            text = text[:at] + now + text[at + len(was):]
        source.write_text(text, encoding="utf-8")

    def first_bad(self):
        """Tag of the commit that git bisect blames."""
        shutil.rmtree(self.folder / "ci", ignore_errors=True)
        self.run("git", "bisect", "start", "last", "good")
        self.run("git", "bisect", "run", self.relume, "ci", "--bisect", codes=())
        bad = self.run("git", "rev-parse", "refs/bisect/bad").stdout.strip()
        tags = self.run("git", "tag", "--points-at", bad).stdout.split()
        self.run("git", "bisect", "reset")
        return tags[0] if tags else bad


def fault(r, name):
    r.begin()
    if name in CHANGES:
        r.change(name, CHANGES[name])
    else:
        r.write("renderer", f"fault {name}\n")
    r.commit(name, "changed")
    r.end()
    return r.first_bad()


def harmless(r, name):
    """Exit code of `relume ci` at the commit with the harmless change."""
    r.begin()
    if name in HARMLESS:
        r.change(name, HARMLESS[name])
    else:
        r.write("renderer", f"harmless {name}\n")
    r.ci()
    wanted = {"more": [], "baseline": False} if name in HARMLESS else json.loads(
        (r.folder / "ci/s/varied.json").read_text(encoding="utf-8"))
    if wanted["more"]:
        option, config = wanted["more"]
        assert option == "--config"
        shutil.copy(config, r.folder / "diff.yaml")
        r.write("relume-ci.yaml", PLAN + "  config: diff.yaml\n")
    if not wanted["baseline"]:
        r.approve()
    r.commit(name, "changed")
    return r.ci()


def touched(build):
    """Wrong verdicts about files that programs open, and the number of verdicts."""
    folder, wrong, n, skipped = build.resolve() / "show/ci_touched", [], 0, 0
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "data").mkdir(parents=True)
    for words in (("-shared", "-fPIC", "-DFACING=1", "-o", "libshape.so", "ci_shape.c"),
                  ("-DSHINE=0", "-o", "viewer", "ci_viewer.c", "-L.", "-lshape", "-Wl,-rpath,$ORIGIN", "-lglut", "-lGL",
                   "-lm")):
        words = [str(ROOT / "tests/real" / word) if word.endswith(".c") else word for word in words]
        subprocess.run(["cc", *words], cwd=folder, check=True)
    (folder / "model.obj").write_text("-1 -1 1 -1 0 1\n", encoding="utf-8")
    (folder / "hidden.dat").write_text("1\n", encoding="utf-8")
    (folder / "start").write_text("#!/bin/sh\nexec ./viewer model.obj 1\n", encoding="utf-8")
    (folder / "start").chmod(0o755)
    for command in (("./viewer", "model.obj", "1"), ("./start", ), ("env", "VIEWER_GREEN=0.5", "./viewer", "model.obj",
                                                                    "1")):
        program = ci_touched.Touched((build / "relume").resolve(), folder, *command)
        for path in (None, *ci_touched.opened(command, folder)):
            if path and not program.can_touch(path):
                skipped += 1
                continue
            verdict = program.verdict(path)
            wrong += [path] if verdict else []
            n += 1
            print(f"{'WRONG' if verdict else 'ok   '} {' '.join(command)}: {path or 'nothing'} touched {verdict}",
                  flush=True)
        shutil.rmtree(program.kept)
    if skipped:
        print(f"{skipped} files were not touched: this system does not allow mounting")
    return wrong, n


def main(build, only):
    shown = Shown(build, "ci")
    if not only or "touched" in only:
        wrong, n = touched(build) if shutil.which("strace") else ([], 0)
        shown.row("touched files: wrong verdicts", f"{len(wrong)} of {n}" if n else "strace is not installed", "0",
                  not wrong if n else None)
        if only == ["touched"]:
            return shown.finish()
    r = Repository(build)
    names = [[name
              for name, *_ in kind
              if not only or any(part in name
                                 for part in only)]
             for kind in (faults.FAULTS, faults.HARMLESS)]
    found = {}
    for kind, judge, right in zip(names, (fault, harmless), ("changed", 0)):
        for name in kind:
            begin = time.monotonic()
            what = judge(r, name)
            found[judge, name] = what == right
            print(f"{'ok   ' if what == right else 'WRONG'} {name:40} {what}, {time.monotonic() - begin:.1f} s",
                  flush=True)
    for kind, judge, what, least in zip(names, (fault, harmless),
                                        ("faults that git bisect finds at their commit", "harmless changes that pass"),
                                        (40, 20)):
        if only and not kind:
            continue
        n = sum(found[judge, name] for name in kind)
        shown.row(what, f"{n} of {len(kind)}", f"all{'' if only else f', at least {least}'}", n == len(kind)
                  and (bool(only) or n >= least))
    return shown.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[])
    options = parser.parse_args()
    sys.exit(main(options.build, options.only))
