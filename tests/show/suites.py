#!/usr/bin/python3
"""tests/show/suites.py BUILD [--only SUITE] (as `make show-suites SUITE=...`): README's two commands on the releases that we support.

For each suite debootstrap makes a chroot of its minimal variant with only `make` added (BUILD/suites/SUITE.bare, kept between runs). In a
copy of it (BUILD/suites/SUITE, left for a look) `make demo` runs twice and `make check` once, as root, in a clone of what is committed.
The second demo must install and compile nothing.

Needs root, debootstrap, 10 GB below BUILD, and most of an hour for each suite. SUITES_MIRROR names another mirror of Debian.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

from table import Shown

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DEMO_FRAMES = 60
# The share of tests that must pass; 1: none may fail. Testing is a canary: it changes every day.
SUITES = {"bookworm": 1.0, "trixie": 1.0, "testing": 0.95}
VERSIONS = {"GCC": "gcc", "PoCL": "libpocl2-common|libpocl2t64|libpocl2|pocl-opencl-icd", "Mesa": "libgl1-mesa-dri", "OpenEXR": "libopenexr-dev",
            "OpenImageIO": "libopenimageio-dev", "Embree": "libembree-dev", "Python": "python3", "apitrace": "apitrace", "clang": "clang"}

# Mounts and processes end with their namespaces, whatever becomes of this script.
INSIDE = """
mount --rbind --make-rslave /dev "$0/dev" && mount --rbind --make-rslave /sys "$0/sys" && mount -t proc proc "$0/proc" &&
exec chroot "$0" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /root && $1"
"""


class Suite:
    def __init__(self, folder, name):
        self.name, self.root, self.logs = name, folder / name, folder / f"{name}.logs"
        self.bare = folder / f"{name}.bare"

    def run(self, log, command):
        """Run a shell command in the chroot; return (exit code, seconds, what it printed)."""
        begin = time.monotonic()
        with open(self.logs / f"{log}.log", "w+", encoding="utf-8", errors="replace") as out:
            code = subprocess.run(["unshare", "--mount", "--pid", "--fork", "--kill-child", "sh", "-c", INSIDE, str(self.root), command],
                                  stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, check=False).returncode
            out.seek(0)
            return code, time.monotonic() - begin, out.read()

    def make_bare(self):
        if self.bare.exists():
            return
        partial = self.bare.with_suffix(".partial")
        shutil.rmtree(partial, ignore_errors=True)
        mirror = [os.environ["SUITES_MIRROR"]] if "SUITES_MIRROR" in os.environ else []
        with open(self.logs / "debootstrap.log", "w", encoding="utf-8") as out:
            subprocess.run(["debootstrap", "--variant=minbase", "--include=make", self.name, partial, *mirror], stdout=out, stderr=out, check=True)
        # A mirror of a suite that changes every day may be behind.
        (partial / "etc/apt/apt.conf.d/90-behind").write_text('Acquire::Check-Valid-Until "false";\n')
        partial.rename(self.bare)

    def begin(self):
        shutil.rmtree(self.logs, ignore_errors=True)
        self.logs.mkdir(parents=True)
        self.make_bare()
        subprocess.run(["rm", "-rf", "--one-file-system", self.root], check=True)
        subprocess.run(["cp", "-a", "--reflink=auto", self.bare, self.root], check=True)
        shutil.copy("/etc/resolv.conf", self.root / "etc")
        subprocess.run(["git", "clone", "-q", ROOT, self.root / "root/relume"], check=True)
        shared = ROOT.parent / "shared"
        if shared.is_dir():
            shutil.copytree(shared, self.root / "root/shared")

    def packages(self):
        return int(self.run("packages", "dpkg-query -W -f '${Package}\\n' | wc -l")[2])

    def versions(self):
        found = []
        for what, names in VERSIONS.items():
            out = self.run("versions", f"dpkg-query -W -f '${{db:Status-Status}} ${{Version}}\\n' {names.replace('|', ' ')} 2>/dev/null")[2]
            version = re.search(r"^installed (?:\d+:)?([0-9.]*[0-9])", out, re.M)
            found.append(f"{what} {version[1] if version else '-'}")
        return ", ".join(found)


def seconds_of(stage, printed):
    found = re.search(rf"^{stage} +([0-9.]+) s", printed, re.M)
    return float(found[1]) if found else None


def show_demo(suite, shown):
    before = suite.packages()
    code, seconds, printed = suite.run("demo", "cd relume && make demo")
    passed = re.search(r"(\d+) of (\d+)", printed[printed.rfind("\nscore"):])
    frames = f"{passed[1]} of {passed[2]} frames" if passed else "no frames scored"
    shown.row(f"{suite.name}: make demo", f"{frames}, exit code {code}, {seconds:.0f} s, of which {seconds_of('install', printed)} s install "
              f"{suite.packages() - before} packages", f"{DEMO_FRAMES} of {DEMO_FRAMES}, exit code 0",
              code == 0 and frames == f"{DEMO_FRAMES} of {DEMO_FRAMES} frames")
    first = printed.split("\n", 1)[0]
    shown.row(f"{suite.name}: its first line", first, "one of ours", first.startswith("install"))
    code, seconds, printed = suite.run("demo-again", "cd relume && make demo")
    compiled = re.search(r"^build .* (\d+) files compiled$", printed, re.M)
    shown.row(f"{suite.name}: make demo again", f"exit code {code}, {compiled[1] if compiled else '?'} files compiled",
              "exit code 0, installs nothing, compiles 0 files",
              code == 0 and "nothing, all is there" in printed and bool(compiled) and compiled[1] == "0")


def show_check(suite, least, shown):
    code, seconds, printed = suite.run("check", "cd relume && make check")
    counted = re.findall(r"^(\d+) passed, (\d+) failed, (\d+) skipped$", printed, re.M)
    passed, failed, skipped = map(int, counted[-1]) if counted else (0, 1, 0)
    good = (code == 0 and failed == 0) if least == 1 else passed >= least * (passed + failed)
    shown.row(f"{suite.name}: make check", f"{passed} passed, {failed} failed, {skipped} skipped, {seconds / 60:.0f} min",
              "0 failed" if least == 1 else f"{least:.0%} pass", good and passed > 0, suite.versions())
    for reason in re.findall(r"^skipped (.*)$", printed, re.M):
        print("    skipped", reason)
    for name in re.findall(r"^FAILED (.*)$", printed, re.M):
        print("    failed ", name)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", choices=SUITES)
    args = parser.parse_args()
    build = args.build.resolve()
    shown = Shown(build, "suites")
    for name, least in SUITES.items():
        if args.only in (None, name):
            suite = Suite(build / "suites", name)
            suite.begin()
            show_demo(suite, shown)
            show_check(suite, least, shown)
    sys.exit(shown.finish())


if __name__ == "__main__":
    main()
