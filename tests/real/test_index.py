#!/usr/bin/python3
"""The index: checkpoints restore the state that the calls produce; frames have the same bytes however they are reached;
and an index that is stale, damaged or cannot be written is noticed.

limit: 200 s
"""
import json
import os
import shutil

from helpers import ROOT, SCRATCH, check, corpus, finish, must, record, relume

TRACES = ROOT.parent / "shared" / "traces"


def facts(trace, *options, env=None):
    done = must(relume("index", trace, "--json", *options, env=env))
    return json.loads(done.stdout), done.stderr


def index_of(trace):
    return trace.with_name(trace.name + ".index")


# Programs with lists, textures, arrays and stacks of all kinds: every checkpoint is compared with the calls' state,
# byte by byte.
live, second = SCRATCH / "live.trace", SCRATCH / "second.trace"
record(live, corpus("viewer"), "--frames", "400", options=())
record(second, corpus("viewer"), "--frames", "300", options=())
traces = [live, second]
for name in ("glxgears", "iv-SceneViewer", "neverball", "rss-lattice", "xss-queens", "xss-noof", "billard-gl"):
    if (TRACES / f"{name}.trace").exists():
        traces.append(SCRATCH / f"{name}.trace")
        shutil.copy(TRACES / f"{name}.trace", traces[-1])
for trace in traces:
    found, _ = facts(trace, "--check")  # exit code 1 if a state differs
    check(found["frames"] > 0 and index_of(trace).exists(), f"{trace.name}: the index is beside it: {found}")
    check(found["checkpoints"] > 0, f"{trace.name}: has checkpoints: {found}")
    check(found["bytes"] < found["trace_bytes"] + (512 << 10),
          f"{trace.name}: the index does not outgrow the trace: {found}")

    check(index_of(trace).stat().st_size == found["bytes"], f"{trace.name}: the file ends with the index: {found}")

# A state that would take longer to restore than to replay is not stored.
if (TRACES / "xss-lament.trace").exists():
    large = SCRATCH / "xss-lament.trace"
    shutil.copy(TRACES / large.name, large)
    found, _ = facts(large, "--check")
    check(found["checkpoints"] == 0, f"textures of 9 MiB, set by 11 MiB of calls: {found}")

# A frame is the same whether all earlier ones were executed or a checkpoint was restored.
trace = traces[-1]
last = facts(trace)[0]["frames"] - 1
near = max(last - 28, 0)
must(relume("render", trace, "-f", f"{near}-{last}x7", "-o", SCRATCH / "near.#.exr"))
index_of(trace).unlink()
calls = json.loads(must(relume("scene", "-f", str(last), "--json", trace)).stdout)
must(relume("render", trace, "-f", str(last), "-o", SCRATCH / "jump.#.exr"))
check(calls["frame"] == last, "relume scene shows the requested frame")
chain = sorted(SCRATCH.glob("near.*.exr"))
check(len(chain) == len(range(near, last + 1, 7)), f"all frames exist: {chain}")
if (last - near) % 7 == 0:
    check((SCRATCH / f"near.{last}.exr").read_bytes() == (SCRATCH / f"jump.{last}.exr").read_bytes(),
          "the same bytes by seeking and step by step")

# Another trace under the same name, damage, and a file that is not an index: noticed, and the index is rebuilt.
good = index_of(live).read_bytes()
for what, data in (("its middle", good[:len(good) // 2] + b"\0" * 64 + good[len(good) // 2 + 64:]),
                   ("its end", good[:-40]), ("its head", b"RELIDX3\n" + bytes(200) + good[208:]),
                   ("all of it", b"no index"), ("everything", b"")):
    index_of(live).write_bytes(data)
    done = must(relume("render", live, "-f", "399", "-o", SCRATCH / "x.#.exr"))
    check("rebuilding it" in done.stderr or "damaged" in done.stderr or index_of(live).read_bytes() == data,
          f"damage of {what} is said: {done.stderr}")
    found, said = facts(live, "--check")
    check(found["frames"] == 400, f"damage of {what}: the index is rebuilt: {found} {said}")
shutil.copy(trace, live)
found, said = facts(live)
check("out of date; rebuilding it" in said and found["frames"] == last + 1, f"another trace under the same name: {said}")
os.utime(live)
found, said = facts(live)
check(not said and found["build_us"] == 0, f"a copy with another time counts as the same trace: {said}")

# If no file can be written beside the trace, the index goes to the cache folder; if that cannot be written either, the
# run continues without an index.
index_of(live).unlink()
index_of(live).mkdir()
env = dict(os.environ, XDG_CACHE_HOME=str(SCRATCH / "cache"))
found, _ = facts(live, env=env)
check(found["index"].startswith(str(SCRATCH / "cache")), f"the index is in the cache folder: {found}")
found, _ = facts(live, env=env)
check(found["build_us"] == 0, "the index is found in the cache folder")
done = must(
    relume("render", live, "-f", str(last), "-o", SCRATCH / "y.#.exr", env=dict(os.environ,
                                                                                XDG_CACHE_HOME="/dev/null")))
check("cannot be written" in done.stderr, f"an index that cannot be written is reported: {done.stderr}")
check((SCRATCH / f"y.{last}.exr").read_bytes() == (SCRATCH / f"jump.{last}.exr").read_bytes(),
      "the frame is the same without an index")
finish()
