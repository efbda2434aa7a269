#!/usr/bin/python3
# limit: 300 s
"""Programs whose traced picture was worse than OpenGL's (corpus): gate N says so of each as it was, and of none as it is now."""
from helpers import SCRATCH, check, check_gates, corpus, diff, finish, record, render

OFF = SCRATCH / "off.yaml"
OFF.write_text("spare: no\n")

for name in ("closed_hall", "arena", "blocks", "tree_cards"):
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(name), "--frames", 1)
    render(trace, SCRATCH / name)
    code, score = diff(trace, SCRATCH / name)
    check(code == 0, f"{name}: relume diff exits with {code}")
    check_gates(score, 1, name)
    check(score["frames"][0]["gates"]["N"]["state"] == "passed", f"{name}: {score['frames'][0]['gates']['N']}")
    before = SCRATCH / f"{name}_before"
    render(trace, before, "--look", OFF)
    code, score = diff(trace, before)
    check(code == 1, f"{name}, not spared: relume diff exits with {code}")
    failed = [gate for gate, found in score["frames"][0]["gates"].items() if found["state"] == "failed"]
    check(failed == ["N"], f"{name}, not spared: fails {failed}")
finish()
