#!/usr/bin/python3
"""Run the tests: tests/run.py BUILD [PART-OF-A-NAME...]

A test is a compiled tests/*/test_*.c (under BUILD) or an executable tests/*/test_*.sh or .py. Exit code 0 means passed,
77 skipped (the last line of output gives the reason); anything else, or a timeout, is a failure. Processes that a test
leaves running are killed. Each test gets an empty TMPDIR, and finds the command through RELUME and RELUME_BUILD.

A test that reports its checks as libcheck does ("100%: Checks: 5, Failures: 0, Errors: 0") counts as that number of
tests. A comment near the top of its source may say "serial" on a line of its own (run alone, because it measures time)
or "limit: 300 s" (default: 120 s). TESTS_SLOWER=10 multiplies all limits by ten, as needed on emulated processors.

The last line is "N passed, N failed, N skipped". The exit code is 1 if a test failed or none ran, or if no test has a
part in its name; nothing is run then.
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

DEFAULT_LIMIT_S = 120
SLOWER = int(os.environ.get("TESTS_SLOWER", "1"))
SKIPPED = 77
ROOT = pathlib.Path(__file__).resolve().parent.parent
TESTS = pathlib.Path(os.environ.get("RELUME_TESTS", ROOT / "tests"))
CHECKS = re.compile(r"^\d+%: Checks: (\d+), Failures: (\d+), Errors: (\d+)", re.M)


class Test:
    def __init__(self, source, build):
        self.name = f"{source.parent.name}/{source.stem}"
        self.command = build / "tests" / self.name if source.suffix == ".c" else source
        head = source.read_text(errors="replace")[:4000]
        self.serial = re.search(r"^[#/* \t]*serial[ */]*$", head, re.M) is not None
        limit = re.search(r"\blimit:[\s#/*]+(\d+) s\b", head)
        self.limit_s = SLOWER * (int(limit.group(1)) if limit else DEFAULT_LIMIT_S)


def find_tests(build, parts):
    sources = [s for suffix in ("c", "sh", "py") for s in TESTS.glob(f"*/test_*.{suffix}")]
    tests = [Test(s, build) for s in sorted(sources)]
    for part in parts:
        if not any(part in t.name for t in tests):
            sys.exit(f"no test has '{part}' in its name; names are those of files below {TESTS}, as in unit/test_house")
    return [t for t in tests if not parts or any(p in t.name for p in parts)]


def kill_session(leader):
    """Kill every process of a session, including those that moved to another process group."""
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text(errors="replace").rpartition(")")[2].split()
            if int(fields[3]) == leader:
                os.kill(int(stat.parent.name), signal.SIGKILL)
        except (OSError, IndexError, ValueError):
            pass  # it has already ended


def vendor_files():
    """The .icd files that name the OpenCL implementations installed here."""
    place = pathlib.Path(
        os.environ.get("OCL_ICD_VENDORS") or os.environ.get("OPENCL_VENDOR_PATH") or "/etc/OpenCL/vendors")
    return sorted(place.glob("*.icd")) if place.is_dir() else []


def environment(build, tmp):
    # Check's own limit of 4 s per test assumes an idle machine.
    env = dict(os.environ, RELUME=str(build / "relume"), RELUME_BUILD=str(build), TMPDIR=tmp, CK_DEFAULT_TIMEOUT="30",
               CK_TIMEOUT_MULTIPLIER=str(SLOWER))
    # If several OpenCL implementations are installed, tests use PoCL unless they choose one of RELUME_VENDORS.
    files = vendor_files()
    env["RELUME_VENDORS"] = ":".join(map(str, files))
    pocl = [f for f in files if "pocl" in f.read_text()]
    if len(files) > 1 and pocl:
        # OCL_ICD_VENDORS must be a folder: not every loader accepts a file name.
        alone = build / "tests" / "vendors"
        alone.mkdir(parents=True, exist_ok=True)
        (alone / "pocl.icd").write_text(pocl[0].read_text())
        env["OCL_ICD_VENDORS"] = str(alone)
    # Compile kernels once for all tests, even though many tests have a temporary home.
    env.setdefault("POCL_CACHE_DIR", str(build / "tests" / "pocl-cache"))
    # Cache trees and indices below the build folder, where they outlive a run and cannot affect the user's cache.
    env["XDG_CACHE_HOME"] = str(build / "tests" / "cache")
    # Leaks in Mesa, PoCL and other libraries are not ours to fix.
    env.setdefault("LSAN_OPTIONS", f"suppressions={build / 'lsan.supp'}:print_suppressions=0")
    # Some tests preload libraries before the sanitizer's.
    env.setdefault("ASAN_OPTIONS", "verify_asan_link_order=0")
    # OpenImageIO pulls in OpenBLAS, whose threads confuse the leak check of forked tests.
    env.setdefault("OPENBLAS_NUM_THREADS", "1")
    env.setdefault("UBSAN_OPTIONS", "print_stacktrace=1")
    return env


def run(test, build):
    """Run one test; return (passed, failed, skipped, output or reason)."""
    with tempfile.TemporaryDirectory(prefix="relume-", ignore_cleanup_errors=True) as tmp, \
            tempfile.TemporaryFile() as log:
        try:
            child = subprocess.Popen([test.command], cwd=ROOT, env=environment(build, tmp), stdin=subprocess.DEVNULL,
                                     stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        except OSError as error:
            return 0, 1, 0, f"does not start: {error}\n"
        try:
            code = child.wait(test.limit_s)
        except subprocess.TimeoutExpired:
            code = None
        kill_session(child.pid)
        child.wait()
        log.seek(0)
        output = log.read().decode(errors="replace")
    return judge(code, output, test.limit_s)


def judge(code, output, limit_s):
    if code == SKIPPED:
        lines = output.strip().splitlines()
        return 0, 0, 1, lines[-1] if lines else "no reason given"
    counts = [tuple(map(int, m)) for m in CHECKS.findall(output)]
    bad = sum(failures + errors for _, failures, errors in counts)
    good = sum(checks for checks, _, _ in counts) - bad
    if counts and good + bad == 0:
        return 0, 1, 0, output + "no check ran\n"
    if code == 0:
        return (good, bad, 0, output) if counts else (1, 0, 0, output)
    why = f"not done after {limit_s} s" if code is None else \
        f"killed by {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
    return good, max(bad, 1), 0, f"{output}{why}\n"


def main(argv):
    if len(argv) < 2:
        sys.exit(__doc__)
    build = pathlib.Path(argv[1]).resolve()
    tests = find_tests(build, argv[2:])
    shutil.copy(ROOT / "tests" / "lsan.supp", build)  # a sandboxed command can read it here
    passed = failed = skipped = 0
    reasons = []

    def take(test, result):
        nonlocal passed, failed, skipped
        good, bad, skips, output = result
        passed, failed, skipped = passed + good, failed + bad, skipped + skips
        if bad:
            print(f"FAILED {test.name}\n" + "".join(f"    {line}\n" for line in output.splitlines()), end="",
                  flush=True)
        if skips:
            reasons.append(f"skipped {test.name}: {output}")

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        together = {pool.submit(run, t, build): t for t in tests if not t.serial}
        for future in concurrent.futures.as_completed(together):
            take(together[future], future.result())
    for test in tests:
        if test.serial:
            take(test, run(test, build))

    print(*sorted(reasons), sep="\n", end="\n" if reasons else "")
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or passed + skipped == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
