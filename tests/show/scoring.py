"""From a recording to a line of figures: is the trace whole, does it replay to the same picture, does `gl` equal it?"""
import dataclasses
import json
import shutil
import subprocess
import time

GATES = ("V", "R1", "R1b", "R2", "R3", "R4", "R5", "E1", "E2", "P")
N_FRAMES = 10
SLOW_FRAME_S = 20  # a program whose frame takes longer is scored on fewer frames
N_SLOW_FRAMES = 2
LIMIT_S = 600  # for one command


@dataclasses.dataclass
class Line:
    """What is said about one program."""
    name: str
    group: str = ""
    frames: int = 0  # scored
    passed: int = 0  # of these
    fidelity: float = 0  # per cent, of the worst frame
    missed: str = ""  # gates that failed, and on how many frames
    not_measured: str = ""
    unhandled: str = ""  # commands that are not executed, and how often
    dump: str = ""  # apitrace dump: whole, or what it says
    replay: str = ""  # glretrace's picture of the last frame against the program's own
    blame: str = ""  # the draws that hold most failing pixels
    frame_s: float = 0  # rendering one frame
    note: str = ""

    @property
    def good(self):
        return self.frames > 0 and self.passed == self.frames


class Scorer:
    """Runs the commands for one recording; all that they say goes to the log."""

    def __init__(self, relume, work, log):
        self.relume, self.work, self.log = relume, work, log

    def run(self, *command, limit=LIMIT_S):
        """Exit code and output; code 124 where it ran past its limit."""
        command = list(map(str, command))
        try:
            done = subprocess.run(command, cwd=self.work, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, timeout=limit, text=True, errors="replace")
            code, out, err = done.returncode, done.stdout, done.stderr
        except subprocess.TimeoutExpired:
            code, out, err = 124, "", f"stopped after {limit} s"
        with open(self.log, "a") as log:
            log.write(f"$ {' '.join(command)}\n{err}(exit code {code})\n")
        return code, out, err

    def json(self, *command):
        try:
            return json.loads(self.run(*command)[1])
        except ValueError:
            return None

    def info(self, trace):
        return self.json(self.relume, "info", "--json", trace)

    def check_dump(self, trace):
        """apitrace dump must read the trace to its end."""
        code, _, err = self.run("sh", "-c", 'exec apitrace dump "$0" >/dev/null', trace)
        said = [line for line in err.splitlines() if line.startswith(("error", "warning")) or "error" in line]
        return "whole" if code == 0 and not said else (said[-1] if said else f"exit code {code}")

    def check_replay(self, recording):
        """glretrace's picture of the last frame that has a reference must be the program's own, bit for bit."""
        # a program that was killed may have left the reference of a frame that it did not come to swap
        whole = (self.info(recording.trace) or {"frames": 0})["frames"]
        frames = [f for f in recording.references if 0 < f < whole]
        if not frames:
            return "no frame to compare"
        pictures = self.work / "raster"
        shutil.rmtree(pictures, ignore_errors=True)
        code, _, err = self.run(self.relume, "raster", recording.trace, "-f", frames[-1], "-o", pictures / "x.####.png")
        if code != 0:
            return (err.splitlines() or ["failed"])[-1][:100]
        scored = self.json(self.relume, "diff", recording.reference, pictures, "-f", frames[-1], "--json", "-")
        if not scored or not scored["frames"]:
            return "not compared"
        frame = scored["frames"][0]
        if frame["worst_code"] == 0 and frame["gates"]["V"]["state"] == "passed":
            return "same"
        return f"differs: {100 - 100 * frame['fidelity']:.3f} % of frame {frames[-1]}, worst {frame['worst_code']}/255"

    def render(self, trace, frames, mode):
        """Render frames, fewer where that is slow. Returns (frames rendered, seconds a frame, what went wrong)."""
        pictures = self.work / "frames"
        shutil.rmtree(pictures, ignore_errors=True)
        done, last_s = [], 0
        for batch in (frames[:1], frames[:1], frames[1:]):
            if not batch or (batch == done and last_s <= SLOW_FRAME_S):
                continue # the first frame again where it was slow: kernels may have been compiled for it
            if batch != frames[:1] and last_s > SLOW_FRAME_S:
                batch = batch[-(N_SLOW_FRAMES - 1):]
            begin = time.monotonic()
            code, _, err = self.run(self.relume, "render", trace, "--allow-incomplete", "-f", ",".join(map(str, batch)),
                                    "--mode", mode, "-o", pictures / "x.####.exr")
            # What rendering one frame takes, the replay of those before it left out.
            said = [line for line in err.splitlines() if line.startswith("rendered frame")]
            last_s = float(said[-1].split()[-2]) if said else time.monotonic() - begin
            done += [frame for frame in batch[:len(said)] if frame not in done]
            if code != 0:
                return done, last_s, f"render: exit code {code}, {(err.splitlines() or [''])[-1][:100]}"
        return done, last_s, ""

    def diff(self, reference, frames, report):
        page = ["--report", self.work / "report"] if report else []
        return self.json(self.relume, "diff", reference, self.work / "frames", "-f", ",".join(map(str, frames)),
                         "--json", "-", *page)


def list_unhandled(info):
    """The calls that rendering does not execute: what `relume info` lacks pixels for is not among them."""
    return ", ".join(f"{u['call']} {u['count']}" for u in info["unsupported"]
                     if "only a renderer" not in str(u.get("why", "")))


def missed_gates(frame, gates, must=()):
    """The gates that a frame does not pass, each with what became of it: "R3 failed", "R4 not measured".

    R1 and R1b share the interior pixels, plain and blended: a frame may have one kind only, but not neither. Of the
    others, those in `must` have to be measured.
    """
    state = {g: frame["gates"][g]["state"] for g in gates}
    missed = [f"{g} failed" for g, s in state.items() if s == "failed"]
    if frame["outcome"] in ("missing", "unreadable"):
        missed.append(frame["outcome"])
    elif {state.get("R1"), state.get("R1b"), state.get("R2")} & {"passed", "failed"} == set():
        missed.append("no pixel measured")
    return missed + [f"{g} not measured" for g in must if g in state and state[g] == "not measured"]


def tell_blame(scored):
    """The draws that hold most of the failing pixels, of the worst frame."""
    worst = min(scored["frames"], key=lambda f: f["fidelity"])
    return "; ".join(f"draw {b['draw']} {b.get('call', '')} {b['pixels']} px" for b in worst["blame"][:3])


def summarize(line, scored, gates, must=()):
    """Fill a line's figures from what diff printed."""
    missed, unmeasured = {}, {}
    for frame in scored["frames"]:
        bad = missed_gates(frame, gates, must)
        line.passed += not bad
        for gate in bad:
            missed[gate] = missed.get(gate, 0) + 1
        for gate in gates:
            if frame["gates"][gate]["state"] == "not measured":
                unmeasured[gate] = unmeasured.get(gate, 0) + 1
    line.frames = len(scored["frames"])
    line.fidelity = 100 * min((f["fidelity"] for f in scored["frames"]), default=0)
    line.missed = ", ".join(f"{gate} on {n}" for gate, n in sorted(missed.items()))
    line.not_measured = ",".join(unmeasured)
    if missed:
        line.blame = tell_blame(scored)
    return line


def check_once(recording, what, check):
    """What a check of the trace alone says; kept beside the trace, which does not change."""
    kept = recording.trace.with_name(f"{what}.txt")
    if not kept.exists():
        kept.write_text(check())
    return kept.read_text()


def score_recording(scorer, line, recording, n_frames, mode, gates, must=(), report=False):
    """Everything about one recording, into one line; report: diff's page as well."""
    info = scorer.info(recording.trace)
    if info is None:
        line.note = "relume info cannot read the trace"
        return line
    line.unhandled = list_unhandled(info)
    frames = [f for f in recording.references if 0 < f < info["frames"]]
    if not frames:
        line.note = f"{info['frames']} frames, none with a reference; {recording.said[:100]}"
        return line
    line.dump = check_once(recording, "dump", lambda: scorer.check_dump(recording.trace))
    line.replay = check_once(recording, "replay", lambda: scorer.check_replay(recording))
    frames = frames[-n_frames:]
    rendered, line.frame_s, wrong = scorer.render(recording.trace, frames, mode)
    if wrong:
        line.note = wrong
    if len(rendered) < len(frames):
        line.note = line.note or f"{len(rendered)} frames only: one takes {line.frame_s:.0f} s"
    scored = scorer.diff(recording.reference, rendered, report) if rendered else None
    if scored is None:
        line.note = line.note or "not scored, see the log"
        return line
    return summarize(line, scored, gates, must)
