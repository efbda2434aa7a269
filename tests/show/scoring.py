"""From a recording to a line of figures: is the trace complete, is the replayed picture the same, does `gl` equal it?"""
import dataclasses
import json
import shutil
import subprocess
import time

GATES = ("V", "R1", "R1b", "R2", "R3", "R4", "R5", "E1", "E2", "P")
N_FRAMES = 10
SLOW_FRAME_S = 20  # a program with slower frames is scored on fewer frames
N_SLOW_FRAMES = 2
LIMIT_S = 600  # per command


@dataclasses.dataclass
class Line:
    """Results for one program."""
    name: str
    group: str = ""
    frames: int = 0  # frames scored
    passed: int = 0  # frames that pass
    fidelity: float = 0  # per cent, for the worst frame
    missed: str = ""  # failed gates, each with the number of frames
    not_measured: str = ""
    unhandled: str = ""  # commands that replay does not execute, each with its count
    dump: str = ""  # apitrace dump: complete, or its message
    replay: str = ""  # glretrace's picture of the last frame, compared with the program's own
    blame: str = ""  # the draws with most failing pixels
    frame_s: float = 0  # time to render one frame
    note: str = ""

    @property
    def good(self):
        return self.frames > 0 and self.passed == self.frames


class Scorer:
    """Runs the commands for one recording; all output goes to the log."""

    def __init__(self, relume, work, log):
        self.relume, self.work, self.log = relume, work, log

    def run(self, *command, limit=LIMIT_S):
        """Exit code and output; code 124 after a timeout."""
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
        """glretrace's picture of the last frame with a reference must equal the program's own, bit for bit."""
        # a killed program may have left a reference for a frame that it never swapped
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
        """Render frames, fewer if that is slow. Returns (frames rendered, seconds per frame, error)."""
        pictures = self.work / "frames"
        shutil.rmtree(pictures, ignore_errors=True)
        done, last_s = [], 0
        for batch in (frames[:1], frames[:1], frames[1:]):
            if not batch or (batch == done and last_s <= SLOW_FRAME_S):
                continue # repeat a slow first frame: it may have compiled kernels
            if batch != frames[:1] and last_s > SLOW_FRAME_S:
                batch = batch[-(N_SLOW_FRAMES - 1):]
            begin = time.monotonic()
            code, _, err = self.run(self.relume, "render", trace, "--allow-incomplete", "-f", ",".join(map(str, batch)),
                                    "--mode", mode, "-o", pictures / "x.####.exr")
            # Time to render one frame, without the replay of earlier frames.
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
    """Calls that rendering does not execute, except those that `relume info` lists as lacking pixels."""
    return ", ".join(f"{u['call']} {u['count']}" for u in info["unsupported"]
                     if "only a renderer" not in str(u.get("why", "")))


def missed_gates(frame, gates, must=()):
    """The gates that a frame does not pass, with the reason: "R3 failed", "R4 not measured".

    R1 and R1b share the interior pixels, plain and blended: a frame may lack one kind, but not both. Of the other
    gates, those in `must` have to be measured.
    """
    state = {g: frame["gates"][g]["state"] for g in gates}
    missed = [f"{g} failed" for g, s in state.items() if s == "failed"]
    if frame["outcome"] in ("missing", "unreadable"):
        missed.append(frame["outcome"])
    elif {state.get("R1"), state.get("R1b"), state.get("R2")} & {"passed", "failed"} == set():
        missed.append("no pixel measured")
    return missed + [f"{g} not measured" for g in must if g in state and state[g] == "not measured"]


def tell_blame(scored):
    """The draws with most of the failing pixels in the worst frame."""
    worst = min(scored["frames"], key=lambda f: f["fidelity"])
    return "; ".join(f"draw {b['draw']} {b.get('call', '')} {b['pixels']} px" for b in worst["blame"][:3])


def summarize(line, scored, gates, must=()):
    """Fill in a line's figures from diff's output."""
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
    """Result of a check that depends on the trace alone; cached beside the trace, which does not change."""
    kept = recording.trace.with_name(f"{what}.txt")
    if not kept.exists():
        kept.write_text(check())
    return kept.read_text()


def score_recording(scorer, line, recording, n_frames, mode, gates, must=(), report=False):
    """Score one recording completely, into one line; report: also write diff's page."""
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
