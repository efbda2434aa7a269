#!/usr/bin/python3
"""tests/show/suites.py BUILD [--only SUITE] (as `make show-suites SUITE=...`): README's commands on the releases that
we support.

For each suite debootstrap makes a chroot of its minimal variant plus `make` (BUILD/suites/SUITE.bare, kept between
runs). In a copy of it (BUILD/suites/SUITE, left for inspection) `make demo` runs twice and `make check` once, as root,
in a clone of the last commit. The second demo must install and compile nothing.

The suite `arm64` cross-compiles for 64-bit ARM on bookworm, runs tests of unit/, gl/ and check/ under qemu-user, and
renders recordings that were made on x86 with the reference device of both: all channels must have the same bytes. Two
checks of test_foreign and test_reserve are disabled there, because they limit memory, which would include the
emulator's.

The suite `container` builds packaging/Containerfile with buildah, using the bare chroot of bookworm as base image, and
renders in the container.

Needs root, debootstrap, 10 GB below BUILD, and nearly an hour for each suite. SUITES_MIRROR selects another Debian
mirror.
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
# Share of tests that must pass; 1: none may fail. Testing is a canary: it changes every day.
SUITES = {"bookworm": 1.0, "trixie": 1.0, "testing": 0.95}
VERSIONS = {
    "GCC": "gcc",
    "PoCL": "pocl-opencl-icd",
    "Mesa": "libgl1-mesa-dri",
    "OpenEXR": "libopenexr-dev",
    "OpenImageIO": "libopenimageio-dev",
    "Embree": "libembree-dev",
    "Python": "python3",
    "apitrace": "apitrace",
    "clang": "clang",
}

CROSS = "CC=aarch64-linux-gnu-gcc CXX=aarch64-linux-gnu-g++ AR=aarch64-linux-gnu-ar BUILD=build/arm64"
CROSS_PACKAGES = (
    "gcc-aarch64-linux-gnu g++-aarch64-linux-gnu qemu-user-static git python3-jsonschema python3-numpy"
    " python3-yaml openimageio-tools:arm64 python3-clang clang"
)
# Libraries are arm64; compilers and tools are native.
INSTALL_CROSS = f"""
dpkg --add-architecture arm64 && apt-get -q update &&
cd relume && libraries=$(packaging/deps.sh list build -- check | grep -E '^lib|-dev$|^check$' | grep -vE '^libc6-dev$' |
                         sed 's/$/:arm64/') &&
apt-get -q -y --no-install-recommends install gcc g++ python3 khronos-api opencl-headers libc6-dev \\
    {CROSS_PACKAGES} $libraries
"""
# The kernel starts arm64 programs through qemu. The entry disappears with the mount namespace, or is removed by hand.
BINFMT = """
mount -t binfmt_misc binfmt_misc /proc/sys/fs/binfmt_misc
[ -e /proc/sys/fs/binfmt_misc/qemu-aarch64 ] ||
	cat /usr/lib/binfmt.d/qemu-aarch64.conf >/proc/sys/fs/binfmt_misc/register
"""
SLOWER = 8  # emulated processors
# Checks that need neither Embree nor kernels compiled by clang.
CHECKS = "ls tests/check/test_*.c | sed 's|tests/||; s|[.]c$||'"
GOLDEN = ("cornell", "two_triangles")

# Mounts and processes end with their namespaces, even if this script is killed.
INSIDE = """
mount --rbind --make-rslave /dev "$0/dev" && mount --rbind --make-rslave /sys "$0/sys" &&
mount -t proc proc "$0/proc" &&
exec chroot "$0" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /root && $1"
"""


class Suite:
    def __init__(self, folder, name):
        self.name, self.root, self.logs = name, folder / name, folder / f"{name}.logs"
        self.release = name if name in SUITES else "bookworm"
        self.bare = folder / f"{self.release}.bare"

    def run(self, log, command):
        """Run a shell command in the chroot; returns (exit code, seconds, output)."""
        begin = time.monotonic()
        with open(self.logs / f"{log}.log", "w+", encoding="utf-8", errors="replace") as out:
            code = subprocess.run(
                [
                    "unshare",
                    "--mount",
                    "--pid",
                    "--fork",
                    "--kill-child",
                    "sh",
                    "-c",
                    INSIDE,
                    str(self.root),
                    command,
                ],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                check=False,
            ).returncode
            out.seek(0)
            return code, time.monotonic() - begin, out.read()

    def make_bare(self):
        if self.bare.exists():
            return
        partial = self.bare.with_suffix(".partial")
        shutil.rmtree(partial, ignore_errors=True)
        mirror = [os.environ["SUITES_MIRROR"]] if "SUITES_MIRROR" in os.environ else []
        with open(self.logs / "debootstrap.log", "w", encoding="utf-8") as out:
            subprocess.run(
                ["debootstrap", "--variant=minbase", "--include=make", self.release, partial, *mirror],
                stdout=out,
                stderr=out,
                check=True,
            )
        # A mirror of a suite that changes daily may lag behind.
        (partial / "etc/apt/apt.conf.d/90-behind").write_text('Acquire::Check-Valid-Until "false";\n')
        partial.rename(self.bare)

    def clear(self):
        shutil.rmtree(self.logs, ignore_errors=True)
        self.logs.mkdir(parents=True)
        self.make_bare()
        subprocess.run(["rm", "-rf", "--one-file-system", self.root], check=True)

    def begin(self):
        self.clear()
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
            out = self.run(
                "versions", f"dpkg-query -W -f '${{db:Status-Status}} ${{Version}}\\n' {names} 2>/dev/null"
            )[2]
            version = re.search(r"^installed (?:\d+:)?([0-9.]*[0-9])", out, re.M)
            found.append(f"{what} {version[1] if version else '-'}")
        return ", ".join(found)


def seconds_of(stage, printed):
    found = re.search(rf"^{stage} +([0-9.]+) s", printed, re.M)
    return float(found[1]) if found else None


def show_demo(suite, shown):
    before = suite.packages()
    code, seconds, printed = suite.run("demo", "cd relume && make demo")
    scored = re.search(r"^score .* (\d+) frames: (\d+) passed", printed, re.M)
    frames = f"{scored[2]} of {scored[1]} frames" if scored else "no frames scored"
    shown.row(
        f"{suite.name}: make demo",
        f"{frames}, exit code {code}, {seconds:.0f} s, {seconds_of('install', printed)} s to install "
        f"{suite.packages() - before} packages",
        f"{DEMO_FRAMES} of {DEMO_FRAMES}, exit code 0",
        code == 0 and frames == f"{DEMO_FRAMES} of {DEMO_FRAMES} frames",
    )
    first = printed.split("\n", 1)[0]
    shown.row(f"{suite.name}: first line of make demo", first, "one of ours", first.startswith("install"))
    code, seconds, printed = suite.run("demo-again", "cd relume && make demo")
    compiled = re.search(r"^build .* (\d+) files compiled$", printed, re.M)
    shown.row(
        f"{suite.name}: make demo again",
        f"exit code {code}, {compiled[1] if compiled else '?'} files compiled",
        "exit code 0, installs nothing, compiles 0 files",
        code == 0 and "nothing: everything is installed" in printed and bool(compiled) and compiled[1] == "0",
    )


def say_tests(printed):
    for reason in re.findall(r"^skipped (.*)$", printed, re.M):
        print("    skipped", reason)
    for name in re.findall(r"^FAILED (.*)$", printed, re.M):
        print("    failed ", name)


def show_check(suite, least, shown):
    code, seconds, printed = suite.run("check", "cd relume && make check")
    counted = re.findall(r"^(\d+) passed, (\d+) failed, (\d+) skipped$", printed, re.M)
    passed, failed, skipped = map(int, counted[-1]) if counted else (0, 1, 0)
    good = (code == 0 and failed == 0) if least == 1 else passed >= least * (passed + failed)
    shown.row(
        f"{suite.name}: make check",
        f"{passed} passed, {failed} failed, {skipped} skipped, {seconds / 60:.0f} min",
        "0 failed" if least == 1 else f"{least:.0%} pass",
        good and passed > 0,
        suite.versions(),
    )
    say_tests(printed)


def pixels(path):
    """Digest of all channels' pixels. The files differ, because ISA-L finds other matches on arm64."""
    printed = subprocess.run(
        ["oiiotool", "--hash", "--info", "-v", path], capture_output=True, text=True, check=False
    ).stdout
    found = re.search(r"SHA-1: (\w+)", printed)
    return found[1] if found else None


def same_pixels(suite, build, name):
    """Whether the reference devices of this build and of the chroot's build render a frame to the same bytes in all
    channels."""
    ours, theirs = suite.logs / f"{name}.exr", suite.root / f"root/{name}.exr"
    options = "-f 1 --device reference"
    subprocess.run(
        [build / "relume", "render", ROOT / f"tests/golden/{name}.trace", *options.split(), "-o", ours], check=True
    )
    suite.run(
        f"render-{name}",
        BINFMT + f"cd relume && build/arm64/relume render tests/golden/{name}.trace {options} -o /root/{name}.exr",
    )
    return theirs.exists() and pixels(ours) is not None and pixels(ours) == pixels(theirs)


def show_arm64(suite, build, shown):
    code = suite.run("install", INSTALL_CROSS)[0]
    shown.row("arm64: packages", f"exit code {code}", "exit code 0", code == 0)
    tests = "$(ls tests/unit/test_*.c tests/gl/test_*.c tests/check/test_*.c | sed 's|^|build/arm64/|; s|\\.c$||')"
    code, seconds, printed = suite.run(
        "build",
        f"cd relume && mkdir -p build/arm64 && touch build/arm64/have && "
        f"make -j$(nproc) {CROSS} all {tests}",
    )
    warnings = printed.count("warning:")
    shown.row(
        "arm64: make, with the tests",
        f"exit code {code}, {warnings} warnings, {seconds / 60:.0f} min",
        "exit code 0, no warnings",
        code == 0 and not warnings,
        suite.versions(),
    )
    printed = suite.run(
        "check", BINFMT +
        f"cd relume && TESTS_EMULATED=1 TESTS_SLOWER={SLOWER} python3 tests/run.py build/arm64 unit/test_ gl/test_ "
        f"$({CHECKS})"
    )[2]
    counted = re.findall(r"^(\d+) passed, (\d+) failed, (\d+) skipped$", printed, re.M)
    shown.row(
        "arm64: tests of unit, gl and check, by qemu-user",
        (
            ", ".join(" ".join(pair) for pair in zip(counted[-1], ("passed", "failed", "skipped")))
            if counted
            else "not run"
        ),
        "0 failed",
        bool(counted) and counted[-1][1] == "0",
    )
    say_tests(printed)
    same = [name for name in GOLDEN if same_pixels(suite, build, name)]
    shown.row(
        "arm64: recordings rendered by the reference device to the same channels as on x86, byte for byte",
        f"{len(same)} of {len(GOLDEN)}",
        f"{len(GOLDEN)}",
        len(same) == len(GOLDEN),
    )


def show_container(suite, shown):
    """buildah keeps its layers below suite.root; the bare chroot is the base image, so no registry is contacted."""
    if not shutil.which("buildah"):
        sys.exit("the suite container needs the Debian package buildah")
    clone = suite.root / "relume"
    subprocess.run(["git", "clone", "-q", ROOT, clone], check=True)
    store = ["buildah", "--root", suite.root / "layers", "--runroot", suite.root / "run"]
    image, golden = "localhost/relume", f"{GOLDEN[0]}.trace"

    def buildah(*command):
        with open(suite.logs / "container.log", "a+", encoding="utf-8", errors="replace") as out:
            begin = out.tell()
            code = subprocess.run([*store, *command], stdout=out, stderr=out, check=False).returncode
            out.seek(begin)
            return code, out.read()

    base = buildah("from", "scratch")[1].strip()
    buildah("add", "-q", base, suite.bare, "/")
    buildah("commit", "-q", "--rm", base, "localhost/bare")
    begin = time.monotonic()
    code, _ = buildah(
        *"bud --isolation chroot --pull-never --build-arg BASE=localhost/bare -t".split(),
        image,
        "-f",
        clone / "packaging/Containerfile",
        clone,
    )
    shown.row("container: build", f"exit code {code}, {time.monotonic() - begin:.0f} s", "exit code 0", code == 0)
    container = buildah("from", "--pull-never", image)[1].strip()
    buildah("copy", container, clone / "tests/golden" / golden, "/work/")
    code, printed = buildah("run", "--isolation", "chroot", container, "--",
                            *f"relume render {golden} -f 1 -o a.exr".split())
    shown.row("container: render", printed.strip().split("\n")[-1], "exit code 0", code == 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", choices=[*SUITES, "arm64", "container"])
    args = parser.parse_args()
    build = args.build.resolve()
    shown = Shown(build, "suites")
    for name, least in SUITES.items():
        if args.only in (None, name):
            suite = Suite(build / "suites", name)
            suite.begin()
            show_demo(suite, shown)
            show_check(suite, least, shown)
    if args.only in (None, "arm64"):
        suite = Suite(build / "suites", "arm64")
        suite.begin()
        show_arm64(suite, build, shown)
    if args.only in (None, "container"):
        suite = Suite(build / "suites", "container")
        suite.clear()
        show_container(suite, shown)
    sys.exit(shown.finish())


if __name__ == "__main__":
    main()
