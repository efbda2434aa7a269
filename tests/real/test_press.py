#!/usr/bin/python3
"""Keys sent by relume record --press arrive at the exact frame, at the drawing window regardless of focus, in every
run."""
import sys

from helpers import BUILD, RELUME, ROOT, SCRATCH, check, finish, on_display

KEYS = BUILD / "tests/trace/keys"
TRACE = SCRATCH / "keys.trace"


def press(*words, program=(KEYS, "14", "poll"), quit_after=14, env=()):
    limit = ("--quit-after", quit_after) if quit_after else ()
    return on_display(RELUME, "record", "-o", TRACE, *limit, *(w for k in words for w in ("--press", k)),
                      *(w for e in env for w in ("--env", e)), "--", *program)


def said(done):
    return f"exit code {done.returncode}\n{done.stdout}{done.stderr}"


def test_frames():
    wanted = [
        "3 press space 0", "3 release space 0", "5 press Left 0", "8 release Left 0", "9 press a 1", "9 release a 1",
        "10 press a 1", "10 release a 1", "11 press s 4", "11 release s 4", "12 press b 13", "12 release b 13",
        "12 press c 0", "12 release c 0"
    ]
    for turn in range(3):
        done = press("Left@5-7", "space@3", "Shift+a@9", "A@10", "Control+s@11", "Shift+Control+Alt+b@12", "c@12")
        check(done.returncode == 0 and done.stdout.splitlines() == wanted,
              f"each at its frame, run {turn}: {said(done)}")
    done = press("space@1", program=(KEYS, "14", "child"))
    check(done.stdout == "1 press space 0\n1 release space 0\n",
          f"the parent of the drawing window receives the key: {said(done)}")


def test_waiting():
    """A program that draws nothing until a key arrives: without --press it would wait forever."""
    done = press("space@1", "a@2", program=(KEYS, "3", "wait"), quit_after=3)
    check(done.returncode == 0 and done.stdout.startswith("1 press space 0\n1 release space 0\n2 press a 0\n"),
          f"waiting: {said(done)}")


def test_together():
    """Two programs on one display with overlapping windows: each gets its own keys."""
    words = [
        " ".join(
            map(str, (RELUME, "record", "-o", SCRATCH / f"{key}.trace", "--quit-after", 300, "--press", f"{key}@7",
                      "--press", f"{key}@290-295", "--", KEYS, 300, "poll", ">", SCRATCH / key))) for key in "ab"
    ]
    done = on_display("sh", "-c", f"{words[0]} & {words[1]} && wait $!")
    for key in "ab":
        check((SCRATCH / key).read_text() == "".join(
            f"{at} {what} {key} 0\n" for at, what in ((7, "press"), (7, "release"), (290, "press"), (296, "release"))),
              f"both draw, {key}: {(SCRATCH / key).read_text()}{said(done)}")


def test_toolkits():
    """Delivery to GLUT, SDL and an EGL program."""
    for what, env in (("by GLX", ()), ("by EGL", ("SDL_VIDEO_X11_FORCE_EGL=1",))):
        done = press("space@4", "Left@6-8", program=(sys.executable, ROOT / "tests/real/sdl_keys.py", 12),
                     quit_after=12, env=(*env, "SDL_VIDEODRIVER=x11"))
        if done.returncode == 77:
            print("no SDL 2 here: its keys were not tested")
            return
        check(
            done.returncode == 0 and done.stdout.splitlines()
            == ["4 press space 0", "4 release space 0", "6 press left 1", "9 release left 0"],
            f"SDL {what}: {said(done)}")


def test_lost():
    """A run whose keys were not delivered is not a success."""
    done = press("space@3", program=(KEYS, "14", "deaf"))
    check(done.returncode == 5 and "--press: 1 of 1 keys were lost" in done.stderr,
          f"a window that accepts no keys: {said(done)}")
    done = press("space@3", "a@9", program=(KEYS, "5", "poll"), quit_after=None)
    check(done.returncode == 5 and "--press: 1 of 2 keys were pressed" in done.stderr,
          f"a program that ends before its key: {said(done)}")
    for wrong, why in (("space", "takes a key and the frame"), ("@3", "takes a key"), ("space@0", "from 1 on"),
                       ("space@5-4", "takes a key"), ("space@x", "takes a key"), ("spac@3", "has no key"),
                       ("space@14", "ends after 14 frames")):
        done = press(wrong)
        check(done.returncode == 2 and why in done.stderr and done.stderr.count("\n") == 1,
              f"--press {wrong}: {said(done)}")


test_frames()
test_waiting()
test_together()
test_toolkits()
test_lost()
finish()
