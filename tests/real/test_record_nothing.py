#!/usr/bin/python3
"""A program that makes no recording: one line gives the reason and advice, and the exit code is the program's own
failure or 5."""
import os
import pathlib
import shutil
import struct
import sys

from helpers import BUILD, RELUME, SCRATCH, check, finish, on_display, relume, run

PROGRAM = BUILD / "tests/trace/frames"  # ten frames
BARE = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}


def require_line(what, code, words, *program, start=run, env=None, options=()):
    """Require one line from us with the given words, and the exit code."""
    trace = SCRATCH / "x.trace"
    done = start(RELUME, "record", "-o", trace, *options, "--", *program, env=env)
    ours = [line for line in done.stderr.splitlines() if line.startswith("relume: ")]
    check(done.returncode == code and len(ours) == 1 and all(part in ours[0] for part in words),
          f"{what}: exit code {done.returncode}: {done.stderr}")
    check(not trace.exists(), f"{what}: no file")
    return done


def built(name, text, *options):
    """A small program, or None if this machine cannot build it."""
    source = SCRATCH / f"{name}.c"
    source.write_text(text)
    done = run("cc", *options, "-o", SCRATCH / name, source)
    return None if done.returncode else SCRATCH / name


# No display; one that does not answer; no OpenGL at all.
require_line("no display", 1, [
    "frames: nothing was recorded: the program loaded OpenGL and ended without calling it",
    "there is no display (DISPLAY and WAYLAND_DISPLAY are not set): 'xvfb-run -a relume record ...' makes one"
], PROGRAM, env=BARE)
require_line("a display that is gone", 1, ["no X server answers at DISPLAY=:7171"], PROGRAM,
             env=dict(BARE, DISPLAY=":7171"))
require_line("no OpenGL", 5, ["true: nothing was recorded: the program loaded no OpenGL (libGL, libEGL or libOSMesa)"],
             "true", start=on_display)
require_line("no OpenGL, and a failure of its own", 7, ["loaded no OpenGL"], "sh", "-c", "exit 7", start=on_display)

# Vulkan is recognised by the library's name.
vulkan = built("libvulkan.so.1", "int nothing;\n", "-shared", "-fPIC")
require_line("Vulkan", 5, ["the program draws with Vulkan, but Relume records OpenGL", "OpenGL renderer"],
             sys.executable, "-c", f"import ctypes; ctypes.CDLL('{vulkan}')", start=on_display)

# Programs that the recorder cannot be loaded into.
static = built("static", "int usleep(unsigned);\nint main(void)\n{\n\treturn usleep(700000);\n}\n", "-static")
if static:
    require_line("a static program", 5,
                 ["static: nothing was recorded: the program is linked statically", "link it dynamically"], static)
    require_line("one that a shell starts", 5, ["sh: nothing was recorded: process 'static' is linked statically"],
                 "sh", "-c", f"{static}; :")
# 32 bits: the file's header suffices, since it is not started.
head = b"\x7fELF\x01\x01\x01" + bytes(9) + struct.pack("<HHIIIIIHHHHHH", 2, 3, 1, 0, 52, 0, 0, 52, 32, 1, 0, 0, 0)
(SCRATCH / "old").write_bytes(head + struct.pack("<IIIIIIII", 3, 84, 84, 84, 0, 0, 4, 1))
(SCRATCH / "old").chmod(0o755)
if not pathlib.Path(RELUME).with_name("lib").joinpath("i386-linux-gnu/librelume.so").exists():
    done = require_line("a program of 32 bits", 5, ["old: is a 32-bit program", "'make i386' builds the other one"],
                        SCRATCH / "old")
    check("ld.so" not in done.stderr, f"without the loader's message: {done.stderr}")
# A cleared environment: by `env -i`, as with sudo and sandboxes.
sleeper = built("sleeper", "int usleep(unsigned);\nint main(void)\n{\n\treturn usleep(700000);\n}\n")
require_line("env -i", 5, [
    "nothing was recorded: process 'sleeper' ran without the recorder: its environment was cleared (env -i, sudo)",
    "put 'relume record -- ' behind that"
], "env", "-i", sleeper)
# A script that starts a set-group-ID program, as old games are for their score files.
if os.geteuid() == 0 and sleeper:
    granted = SCRATCH / "granted"
    shutil.copy(sleeper, granted)
    os.chown(granted, 0, 60)
    granted.chmod(0o2755)
    require_line("a set-group-ID program", 5, [
        "nothing was recorded: process 'granted' has the rights of its file's owner or group",
        "'relume record -- ' before that file itself"
    ], "sh", "-c", f"{granted}; :")
    done = run(RELUME, "record", "-o", SCRATCH / "granted.trace", "--", granted)
    check("runs without the rights of its file's owner or group" in done.stderr,
          f"the directly recorded program runs without these rights: {done.stderr}")

# A PID namespace hides the command's process, but not the figures.
if run("unshare", "-r", "true").returncode == 0:
    trace = SCRATCH / "unshared.trace"
    done = on_display(RELUME, "record", "--quit-after", "5", "-o", trace, "--", "unshare", "-r", PROGRAM)
    check(done.returncode == 0 and "unshared.trace: 5 frames, " in done.stderr and "nothing" not in done.stderr,
          f"unshare -r: exit code {done.returncode}: {done.stderr}")
    # If the descriptor is closed as well, the recording is still made.
    closes = f"import os; os.closerange(3, 1000); os.execvp('unshare', ['unshare', '-r', '{PROGRAM}'])"
    trace = SCRATCH / "closed.trace"
    done = on_display(RELUME, "record", "--quit-after", "5", "-o", trace, "--", sys.executable, "-c", closes)
    check(
        done.returncode == 0 and
        "closed.trace: was recorded, but a sandbox kept the figures; 'relume info' shows what it holds" in done.stderr,
        f"unshare -r without descriptors: exit code {done.returncode}: {done.stderr}")
    check("\nframes      5\n" in relume("info", trace).stdout, "the recording is complete")
else:
    print("no user namespaces here: not tested")

# No context is created; one is created but never draws.
if shutil.which("glxinfo"):
    trace = SCRATCH / "info.trace"
    done = on_display(RELUME, "record", "-o", trace, "--", "glxinfo", "-B")
    check("the program uses a core profile of OpenGL 3 or later" in done.stderr,
          f"a core profile is named: {done.stderr}")
without = built(
    "without",
    "#include <GL/glx.h>\nint main(void)\n{\n\tDisplay *d = XOpenDisplay(NULL);\n\tint a, b;\n\treturn !d || "
    "!glXQueryVersion(d, &a, &b);\n}\n",
    "-Wl,--no-as-needed", "-lGL", "-lX11")
if without:
    done = on_display(RELUME, "record", "-o", SCRATCH / "without.trace", "--", without)
    check("without.trace: the program asked for OpenGL but made no context, so it drew nothing" in done.stderr,
          f"no context: {done.stderr}")

# An earlier recording of that name stays until there is a new one, and a file that is none is not replaced.
old = SCRATCH / "old.trace"
files = [old, old.with_suffix(".ref"), SCRATCH / "old.1.trace"]
for file in files:
    file.write_bytes(b"at of " + file.name.encode())
for what, program in (("a program that does not exist", "/no/program"), ("one without OpenGL", "true")):
    done = on_display(RELUME, "record", "-o", old, "--", program)
    check(done.returncode != 0 and all(file.read_bytes() == b"at of " + file.name.encode() for file in files) and
          not list(SCRATCH.glob("old*.earlier")), f"{what}: the earlier recording is kept: {done.stderr}")
done = on_display(RELUME, "record", "--quit-after", "3", "-o", old, "--", PROGRAM)
check(done.returncode == 0 and "\nframes      3\n" in relume("info", old).stdout and
      sorted(path.name for path in SCRATCH.glob("old.*")) == ["old.trace"],
      f"the new recording replaces it: {done.stderr}")
copy = SCRATCH / "program"
shutil.copy(PROGRAM, copy)
done = on_display(RELUME, "record", "-o", copy, "--", copy)
check(done.returncode == 2 and "program: exists and is no recording; give the new recording another name" in done.stderr
      and copy.read_bytes() == PROGRAM.read_bytes(),
      f"a program as the output: exit code {done.returncode}: {done.stderr}")
finish()
