#!/usr/bin/python3
"""tests/show/sanitize.py BUILD (as `make show-sanitize`): the recorder under ThreadSanitizer and under
AddressSanitizer.

Two threads, each with a context of its own, draw concurrently by immediate mode and client arrays and read pixels back.
Program and recorder are built with the sanitizer (BUILD/sanitized); Mesa is not, so faults inside it go unnoticed.
Every run must exit with 0, record all frames, and report nothing. Leaks are not checked, since all reports would
concern Mesa.
"""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
RUNS = 3
OPTIONS = {"thread": "TSAN_OPTIONS=ignore_noninstrumented_modules=1:exitcode=66",
           "address": "ASAN_OPTIONS=verify_asan_link_order=0:detect_leaks=0:detect_stack_use_after_return=1"}
VARIANTS = {"": [], ", reference frames": ["--ref", "color,depth"], ", frames 5-15": ["--frames", "5-15"]}


def reports(build, name, variant):
    """The sanitizer's reports, and whether everything else succeeded."""
    folder = build / "sanitized" / name
    runtime = f"__{'t' if name == 'thread' else 'a'}san_"
    symbols = subprocess.run(["nm", "-D", folder / "librelume.so"], capture_output=True, text=True, check=True).stdout
    if runtime not in symbols:
        sys.exit(f"{folder}/librelume.so is not built with the sanitizer")
    run = subprocess.run([
        ROOT / "tests/xvfb.sh", folder / "relume", "record", "-o", folder / "x.trace", *variant, "--env", OPTIONS[name],
        "--", folder / "threads"
    ], cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    text = run.stdout + run.stderr
    n = len(re.findall(r"(?:WARNING|ERROR): (?:Thread|Address)Sanitizer", text))
    frames = re.search(r": (\d+) frames?,", text)
    wanted = 11 if "--frames" in variant else 40
    well = run.returncode == 0 and frames and int(frames.group(1)) == wanted
    if n or not well:
        print(text)
    return n, well


def main(build):
    build = pathlib.Path(build).resolve()
    rows = []
    for name in OPTIONS:
        for title, variant in VARIANTS.items():
            found, well = 0, True
            for _ in range(RUNS):
                n, ok = reports(build, name, variant)
                found += n
                well = well and ok
            rows.append({
                "what": f"{name} sanitizer, two threads and contexts{title}, {RUNS} runs", "peer": "GCC's runtime",
                "figure": f"{found} reports" + ("" if well else ", and a run failed"), "bar": "0 reports",
                "passed": well and not found
            })
            print(f"{'holds' if rows[-1]['passed'] else 'FAILS'}  {rows[-1]['what']}: {rows[-1]['figure']}", flush=True)
    (build / "show").mkdir(exist_ok=True)
    (build / "show" / "sanitize.json"
     ).write_text(json.dumps({"name": "sanitize", "command": "make show-sanitize", "rows": rows}, indent=1) + "\n")
    return 0 if all(row["passed"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
