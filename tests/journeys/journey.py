"""Shared by the journeys: a user's folder, typed command lines, and checks of pictures."""
import os
import pathlib
import resource
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "real"))
from codes import codes  # noqa: E402
from helpers import BUILD, RELUME, SCRATCH, check, corpus, finish, on_display  # noqa: E402

PLACE = SCRATCH / "place"
SIZE = "160x120"


def begin(program="spheres", frames=10, *options):
    """An empty folder with a program, ./game, in it, and `relume` in PATH."""
    (PLACE / "bin").mkdir(parents=True)
    (PLACE / "bin/relume").symlink_to(RELUME)
    game = PLACE / "game"
    game.write_text(f'#!/bin/sh\nexec "{corpus(program)}" --frames {frames} --size {SIZE} {" ".join(options)} "$@"\n')
    game.chmod(0o755)


def typed(line, code=0, says=None, **variables):
    """Run a typed line; check the exit code and a word of the output. Returns the output."""
    env = {**os.environ, "PATH": f"{PLACE / 'bin'}:{os.environ['PATH']}", **variables}
    done = on_display("sh", "-c", line, cwd=PLACE, env=env, timeout=300)
    said = done.stdout + done.stderr
    check(done.returncode == code, f"{line}: exit code {done.returncode}, expected {code}: {said[-1500:]}")
    check(says is None or says in said, f"{line} says {says!r}: {said[-1500:]}")
    return said


def seen(name):
    """A picture, 0 to 255, that is not blank: more than one colour, neither black nor white throughout."""
    found = codes(PLACE / name).transpose(1, 2, 0)  # [row][column][channel]
    check(found.std() > 10 and 10 < found.mean() < 245,
          f"{name} is not blank: mean {found.mean():.1f}, deviation {found.std():.1f}")
    return found


def share(these):
    """The percentage of pixels."""
    return 100 * these.mean()


def end():
    used = sum(getattr(resource.getrusage(who), field) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
               for field in ("ru_utime", "ru_stime"))
    print(f"{used:.1f} s of processor time")
    finish()


__all__ = ["BUILD", "PLACE", "RELUME", "SCRATCH", "begin", "check", "codes", "end", "seen", "share", "typed"]
