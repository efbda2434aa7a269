#!/usr/bin/python3
"""The runner must notice every way that a test can fail. Each case is a tree with one test, and the expected outcome.
Like its cases, this file states its own limit in its first lines.

limit: 120 s
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ["RELUME_BUILD"])
FAILS = f'exec "{BUILD}/tests/harness/fails"'
SANITIZED = b"__asan_init" in (BUILD / "tests/harness/fails").read_bytes()

# name: the test as shell text, last line of the runner, text that its report must contain
CASES = {
    "a check passes": (f"{FAILS} pass", "1 passed, 0 failed, 0 skipped", ""),
    "a check fails": (f"{FAILS} fail", "0 passed, 1 failed, 0 skipped", "'1 == 2' failed"),
    "a check crashes": (f"{FAILS} crash", "0 passed, 1 failed, 0 skipped", "test_crash"),
    "a check exits early": (f"{FAILS} exit", "0 passed, 1 failed, 0 skipped", "Early exit"),
    "a check hangs": (f"{FAILS} hang", "0 passed, 1 failed, 0 skipped", "Test timeout expired"),
    "no check is there": (f"{FAILS} nothing-of-that-name", "0 passed, 1 failed, 0 skipped", "no check ran"),
    "a failure counted, but exit code 0": ("echo '50%: Checks: 2, Failures: 1, Errors: 0'",
                                           "1 passed, 1 failed, 0 skipped", "50%"),
    "all counted as passed, but exit code 3": ("echo '100%: Checks: 2, Failures: 0, Errors: 0'; exit 3",
                                               "2 passed, 1 failed, 0 skipped", "exit code 3"),
    "a script fails": ("echo the reason; exit 1", "0 passed, 1 failed, 0 skipped", "the reason"),
    "a script is killed": ("kill -SEGV $$", "0 passed, 1 failed, 0 skipped", "SIGSEGV"),
    "a script hangs": ("# limit: 1 s\nsleep 1000", "0 passed, 1 failed, 0 skipped", "not done after 1 s"),
    "a limit is parted by the end of a line": ("# text, limit:\n# 1 s\nsleep 1000", "0 passed, 1 failed, 0 skipped",
                                               "not done after 1 s"),
    "a script is skipped": ("echo first; echo no such thing here; exit 77", "0 passed, 0 failed, 1 skipped",
                            "skipped case/test_it: no such thing here"),
    "a script passes": ("exit 0", "1 passed, 0 failed, 0 skipped", ""),
}
if SANITIZED:
    CASES["a check leaks"] = (f"{FAILS} leak", "0 passed, 1 failed, 0 skipped", "LeakSanitizer")


def run_tree(tree, *parts):
    done = subprocess.run([ROOT / "tests/run.py", BUILD, *parts],
                          env=dict(os.environ, RELUME_TESTS=tree, TESTS_SLOWER="1"), text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def write_test(tree, text):
    script = pathlib.Path(tree, "case", "test_it.sh")
    script.parent.mkdir()
    script.write_text(f"#!/bin/sh\n{text}\n")
    script.chmod(0o755)


def check_case(name, text, last_line, report):
    with tempfile.TemporaryDirectory() as tree:
        write_test(tree, text)
        code, output = run_tree(tree)
    expected_code = 0 if ", 0 failed," in last_line else 1
    if code == expected_code and output.splitlines()[-1] == last_line and report in output:
        return True
    print(f"{name}: exit code {code}, expected {expected_code}, '{last_line}' and '{report}' in:\n{output}")
    return False


def check_nothing_ran():
    with tempfile.TemporaryDirectory() as tree:
        code, output = run_tree(tree)
    return code == 1 and output == "0 passed, 0 failed, 0 skipped\n"


def check_unknown_name():
    """A part that no test has in its name is named, and the others do not run."""
    with tempfile.TemporaryDirectory() as tree:
        write_test(tree, "exit 0")
        code, output = run_tree(tree, "test_it", "nothing_matches")
    return code == 1 and output.startswith("no test has 'nothing_matches' in its name; ") and output.count("\n") == 1


def check_not_built():
    """A test whose program is missing has not passed."""
    with tempfile.TemporaryDirectory() as tree:
        pathlib.Path(tree, "case").mkdir()
        pathlib.Path(tree, "case", "test_never_built.c").write_text("int main(void) { return 0; }\n")
        code, output = run_tree(tree)
    return code == 1 and "does not start" in output


def check_stragglers():
    """Processes left by a test are gone when the runner ends, even from another process group."""
    with tempfile.TemporaryDirectory() as tree:
        pid_file = pathlib.Path(tree, "pid")
        write_test(tree, "python3 -c \"import os, time; os.setpgid(0, 0); "
                         f"open('{pid_file}', 'w').write(str(os.getpid())); time.sleep(1000)\" &\nsleep 1")
        code, _ = run_tree(tree)
        pid = int(pid_file.read_text())
    time.sleep(0.1)
    return code == 0 and not is_running(pid)


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


results = {name: check_case(name, *case) for name, case in CASES.items()}
results["nothing ran"] = check_nothing_ran()
results["unknown name"] = check_unknown_name()
results["not built"] = check_not_built()
results["stragglers"] = check_stragglers()
failed = [name for name, good in results.items() if not good]
print(*(f"wrong: {name}" for name in failed), sep="\n")
print(
    f"{100 * (len(results) - len(failed)) // len(results)}%: Checks: {len(results)}, Failures: {len(failed)}, Errors: 0"
)
sys.exit(bool(failed))
