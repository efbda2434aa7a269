"""Record one real program with reference frames, and keep the recording, so that changes to replay do not need a new
one.
"""
import dataclasses
import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PATIENCE_S = 15  # for a program to exit after SIGTERM
FRAMES = 55  # without keys: references at frames 0, 5, ... 50
LONGEST_S = 120  # limit for that number of frames
PEER_S = 10  # apitrace cannot stop after a number of frames
REF_HEADER = struct.Struct("<IIIQQ")


@dataclasses.dataclass
class Recording:
    trace: pathlib.Path
    references: list  # numbers of frames with a colour picture, ascending
    depth: bool  # they also have a depth picture
    code: int  # exit code of `relume record`
    said: str = ""  # last lines of its output

    @property
    def reference(self):
        return self.trace.with_suffix(".ref")


def list_references(path):
    """Numbers of the frames in a .ref file (capture/format/ref.h), and whether they have depth."""
    frames, depth = [], False
    if not path.exists():
        return frames, depth
    with open(path, "rb") as file:
        size = path.stat().st_size
        file.seek(8)
        while len(header := file.read(REF_HEADER.size)) == REF_HEADER.size:
            kind, _, _, frame, packed = REF_HEADER.unpack(header)
            if file.tell() + packed > size:
                break
            kind &= 0xff  # the upper bits describe pixel packing
            if kind == 1:
                frames.append(frame)
            depth = depth or kind == 2
            file.seek(packed, os.SEEK_CUR)
    return frames, depth


def drag(x, y, to_x, to_y, n=20):
    """Press the left button at one place, move the pointer in n steps, and release it at another place two seconds
    later.
    """
    subprocess.run(["xdotool", "mousemove", str(x), str(y), "mousedown", "1"], check=False)
    for i in range(1, n + 1):
        subprocess.run(
            ["xdotool", "mousemove",
             str(x + (to_x - x) * i // n),
             str(y + (to_y - y) * i // n), "sleep",
             str(2 / n)], check=False)
    subprocess.run(["xdotool", "mouseup", "1"], check=False)


def send(steps):
    """Send a person's input; tests/show/programs.py lists the steps."""
    subprocess.run(["xdotool", "mousemove", "400", "300"], check=False)
    for step in steps:
        what, _, value = step.partition(" ")
        if what == "wait":
            time.sleep(float(value))
        elif what == "key":
            subprocess.run(["xdotool", "key", "--delay", "120", value], check=False)
        elif what in ("keydown", "keyup"):
            subprocess.run(["xdotool", what, value], check=False)
        elif what == "click":
            subprocess.run(["xdotool", "mousemove", *value.split(), "click", "1"], check=False)
        elif what == "drag":
            drag(*map(int, value.split()))
        elif what == "type":
            subprocess.run(["xdotool", "type", value], check=False)
        else:
            raise ValueError(f"no such step: {step}")


def end(process):
    """End a process that we started and its children, which form a separate process group."""
    process.terminate()
    try:
        process.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        pass
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    return process.wait()


def run_program(program, command, home, log):
    """Run a program under a recorder's command line; returns the exit code."""
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir(parents=True)
    for name, text in program.files:
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        (home / name).write_text(text)
    environment = dict(os.environ, HOME=str(home), **dict(program.environment))
    with open(log, "w") as out:
        process = subprocess.Popen(command, cwd=home, env=environment, stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        begin = time.monotonic()
        try:
            send(program.keys)
            process.wait(max(1, (program.seconds or LONGEST_S) - (time.monotonic() - begin)))
        except subprocess.TimeoutExpired:
            pass
        return end(process)


def find(folder):
    """The recording in a folder; if several processes were recorded, the one that drew most."""
    traces = sorted(folder.glob("live*.trace"), key=lambda p: (p.with_suffix(".ref").exists(), p.stat().st_size))
    return traces[-1] if traces else None


def record(relume, program, folder, again=False):
    """Record a program into a folder, or return the recording already there."""
    done = folder / "recording.json"
    if again or not done.exists():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        how_long = [] if program.seconds else ["--quit-after", str(FRAMES)]
        code = run_program(program, [
            str(relume), "record", "-o",
            str(folder / "live.trace"), "--ref", "color,depth", "--ref-every",
            str(program.ref_every), *how_long, "--", *program.command
        ], folder / "home", folder / "record.log")
        done.write_text(json.dumps({"code": code}))
    trace = find(folder)
    said = (folder / "record.log").read_text(errors="replace").splitlines()
    references, depth = list_references(trace.with_suffix(".ref")) if trace else ([], False)
    return Recording(trace, references, depth, json.loads(done.read_text())["code"], said[-1] if said else "")


def record_by_apitrace(program, folder):
    """The same program recorded by apitrace, or None if that fails."""
    peer = folder / "apitrace.trace"
    if not peer.exists():
        api = "egl" if program.package.startswith("xscreensaver") else "gl"
        bounded = dataclasses.replace(program, seconds=program.seconds or PEER_S)
        run_program(bounded, ["apitrace", "trace", "-a", api, "-o",
                              str(peer), *program.command], folder / "home", folder / "apitrace.log")
    return peer if peer.exists() else None
