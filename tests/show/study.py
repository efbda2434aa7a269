"""Cost of a study: 1,000 frames in at most the processor time of rendering 20 of them without rules."""
import resource
import subprocess

import recording
import sheet

FRAMES, RENDERED = 1000, 20
# Programs recorded here, and shared recordings that are long enough.
PROGRAMS = {
    "courtyard": ("courtyard", "--animate", "camera"),
    "rooms": ("rooms", "--seed", 5, "--lights", 6, "--lighting", "multitexture", "--walk")
}
LONG = ("glxgears", "iv-SceneViewer")


def run(*command):
    subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, capture_output=True, check=True)


def seconds(*command):
    """Processor time of a command, summed over its threads."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run(*command)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def recordings(build, work):
    for name, program in PROGRAMS.items():
        trace = work / f"{name}.trace"
        run(recording.ROOT / "tests/xvfb.sh", build / "relume", "record", "-o", trace, "--",
            build / "corpus" / program[0], *program[1:], "--frames", FRAMES)
        yield name, trace
    for name in LONG:
        if (sheet.SHARED / f"{name}.trace").exists():
            yield name, sheet.SHARED / f"{name}.trace"


def rows(build, work):
    """A row for each recording. The index is made beforehand, because every command that seeks needs it once."""
    for name, trace in recordings(build, work):
        middle = FRAMES // 2
        run(build / "relume", "render", trace, "-f", middle, "-o", work / "first.exr")
        study = seconds(build / "relume", "look", trace, "-f", f"0-{FRAMES - 1}", "-o", work / "study.look.yaml")
        render = seconds(build / "relume", "render", trace, "-f", f"{middle}-{middle + RENDERED - 1}", "-o",
                         work / "study.####.exr")
        text = f"{study:.2f} s; {RENDERED} frames are rendered in {render:.2f} s"
        print(f"{name}: a study of {FRAMES} frames takes {text}", flush=True)
        yield {
            "what": f"{name}: processor time of a study of {FRAMES} frames over that of rendering {RENDERED}",
            "figure": round(study / render, 3), "bar": 1, "peer": None, "passed": study <= render
        }
