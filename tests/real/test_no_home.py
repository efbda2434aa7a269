#!/usr/bin/python3
"""A user whose home cannot be written, as for a service: one line, caches elsewhere, and the work is done."""
import os
import stat

from helpers import RELUME, SCRATCH, check, corpus, finish, must, record, run

trace = SCRATCH / "x.trace"
record(trace, corpus("two_triangles"), "--frames", "1", "--size", "64x64", options=())
blocked = SCRATCH / "home"
blocked.write_text("")  # a file: not even root can create a folder below it
tmp = SCRATCH / "tmp"
tmp.mkdir()
env = {k: v for k, v in os.environ.items() if k != "XDG_CACHE_HOME"}
env.update(HOME=str(blocked), TMPDIR=str(tmp))
caches = tmp / f"relume-caches-{os.geteuid()}"


def said(done):
    return [line for line in done.stderr.splitlines() if "cannot be written" in line]


done = must(run(RELUME, "render", trace, "-f", "0", "-o", SCRATCH / "x.png", env=env, timeout=300))
check((SCRATCH / "x.png").exists(), "the frame is written")
check(
    len(said(done)) == 1 and str(caches) in said(done)[0] and "XDG_CACHE_HOME" in said(done)[0],
    f"one line says where caches are: {done.stderr}")
check(stat.S_IMODE(caches.stat().st_mode) == 0o700, "the cache folder is private to this user")

# PoCL itself offers no device without its cache.
bare = {k: v for k, v in env.items() if k != "POCL_CACHE_DIR"}
done = must(run(RELUME, "devices", env=bare))
check(len(done.stdout.splitlines()) >= 1 and len(said(done)) == 1, f"devices are listed: {done.stdout}{done.stderr}")
done = must(run(RELUME, "devices", env={k: v for k, v in bare.items() if k != "HOME"}))
check(
    len(done.stdout.splitlines()) >= 1 and len(said(done)) == 1 and str(caches) in said(done)[0],
    f"no home at all: {done.stdout}{done.stderr}")
# A name that somebody else owns, or could write to, is not used.
os.chmod(caches, 0o777)
done = must(run(RELUME, "devices", env=bare))
check(f"{caches}-" in said(done)[0], f"another folder: {done.stderr}")
# With a writable home there is no message, and no file is left in the home.
blocked.unlink()
blocked.mkdir()
done = must(run(RELUME, "devices", env={**bare, "XDG_CACHE_HOME": str(SCRATCH / "caches")}))
check(not done.stderr and not (SCRATCH / "caches/relume").exists(), f"a good home: {done.stderr}")
finish()
