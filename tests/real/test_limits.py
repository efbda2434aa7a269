#!/usr/bin/python3
"""A recording that requests more memory than its size justifies: one line, exit code 5, no files left. --no-sandbox
lifts the limit."""
from helpers import BUILD, SCRATCH, check, finish, record, relume

trace = SCRATCH / "greedy.trace"
record(trace, BUILD / "tests/real/greedy", options=())
size = trace.stat().st_size
limit = 2048 + (256 * size >> 20)
check(limit < 2500, f"the recording has {size} bytes")
out = SCRATCH / "made/x.glb"
for args in (("info",), ("scene", "-f", "0"), ("export", "-o", out), ("look", "-o", SCRATCH / "rules/x.yaml")):
    done = relume(*args, trace)
    said = done.stderr.strip().splitlines()
    check(done.returncode == 5, f"{args[0]}: exit code {done.returncode}: {done.stderr}")
    check(
        len(said) == 1 and said[0].startswith(f"relume: {trace}: asks for more than {limit} MiB")
        and "--no-sandbox lifts it" in said[0], f"{args[0]} says: {said}")
    check(not done.stdout or args[0] != "info", f"{args[0]} prints: {done.stdout[:200]}")
for folder in (out.parent, SCRATCH / "rules"):
    check(not folder.exists(), f"{folder.name} was created in vain, and is left")
done = relume("info", "--no-sandbox", trace)
check(done.returncode == 0, f"without limits: exit code {done.returncode}: {done.stderr}")
finish()
