"""The open programs: raster | beauty without rules | relit side by side, with the verdicts of people who inspected them
(tests/show/sheet.yaml).

A recording of ../shared/traces is used if there is one; others are made once, in BUILD/show/relit/recordings. The
verdict on a shared recording counts only while the relit picture has about the same brightness as when it was
inspected.
"""
import json
import subprocess

import numpy
import yaml

import exr_numpy
import programs
import recording

SHARED = recording.ROOT.parent / "shared/traces"
NAMES = {
    "SceneViewer": "iv-SceneViewer", "lattice": "rss-lattice", "queens": "xss-queens", "lament": "xss-lament",
    "noof": "xss-noof"
}
SEEN = recording.ROOT / "tests/show/sheet.yaml"
LATE = 0.75  # position among a recording's reference frames; by then a game has begun
BETTER = 10  # minimum number of programs of the open set
SAME_BRIGHTNESS = 0.02
# Not in the open set: it was once better without rules, and must not become so again.
RACE = programs.Program("extremetuxracer", "extremetuxracer", ("etr",), seconds=60, ref_every=20,
                        keys=("wait 8", *(4 * ("key Return", "wait 3"))))


def all_programs():
    return (*programs.OPEN, RACE)


def find(build, program):
    """A recording, a representative frame, and whether it is a shared one; or (None, reason, False)"""
    name = NAMES.get(program.name, program.name)
    if (SHARED / f"{name}.trace").exists():
        frames = dict(
            line.split("\t")[:2]
            for line in (SHARED / "frames.tsv").read_text().splitlines()
            if not line.startswith("#"))
        return SHARED / f"{name}.trace", int(frames[name]), True
    done = recording.record(build / "relume", program, build / "show/relit/recordings" / program.name)
    if done.trace is None or not done.references:
        return None, f"no recording: {done.said[:120]}", False
    return done.trace, late(done), False


def late(done):
    """The frame to inspect in a recording with references."""
    return done.references[int(LATE * (len(done.references) - 1))]


def luminance(image, prefix=""):
    """Mean of the picture in linear light."""
    return float(
        sum(share * image.planes[f"{prefix}{c}"].astype("f8").mean()
            for c, share in zip("RGB", (0.2126, 0.7152, 0.0722))))


def display(image, prefix=""):
    linear = numpy.clip(numpy.stack([image.planes[f"{prefix}{c}"].astype("f4") for c in "RGB"], axis=-1), 0, 1)
    return numpy.rint(255 *
                      numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear**(1 / 2.4) - 0.055)).astype("u1")


def run(*command, good=(0,)):
    done = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False)
    if done.returncode not in good:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def render(build, trace, frame, out, *look):
    run(build / "relume", "render", trace, "-f", frame, "-o", out, *look)
    return exr_numpy.Image(out)


def side_by_side(path, beauty, other):
    """Write a sheet: raster | beauty | other, from two renderings of one frame."""
    gap = numpy.zeros((beauty.planes["R"].shape[0], 4, 3), "u1")
    exr_numpy.write_png(path,
                        numpy.concatenate((display(beauty, "gl."), gap, display(beauty), gap, display(other)), axis=1))


def harm(build, picture, frame):
    """Gate N of a relit frame. The gate needs no reference, but diff does: OpenGL's own picture of the frame serves as
    one.
    """
    reference = picture.with_name(f"gl.{frame:04d}.png")
    exr_numpy.write_png(reference, display(exr_numpy.Image(picture), "gl."))
    return json.loads(run(build / "relume", "diff", reference, picture, "--json", "-",
                          good=(0, 1, 4)))["frames"][0]["gates"]["N"]["state"]


def show(build, program, work):
    """A program's sheet with its figures: mean luminance of raster, beauty and relit, and gate N."""
    trace, frame, is_shared = find(build, program)
    if trace is None:
        return {"error": frame}
    rules, relit = work / "x.look.yaml", work / f"relit.{frame:04d}.exr"
    run(build / "relume", "look", trace, "-o", rules)
    pictures = (render(build, trace, frame, work / "beauty.exr"), render(build, trace, frame, relit, "--look", rules))
    out = build / "show/relit" / f"{program.name}.png"
    side_by_side(out, *pictures)
    return {
        "frame": frame, "shared": is_shared, "sheet": str(out), "N": harm(build, relit, frame), "luminance": [
            round(luminance(pictures[0], "gl."), 5),
            round(luminance(pictures[0]), 5),
            round(luminance(pictures[1]), 5)
        ]
    }


def is_stale(line, seen):
    """Whether a picture has changed since it was inspected."""
    return line["shared"] and abs(line["luminance"][2] - seen["relit"]) > SAME_BRIGHTNESS * max(seen["relit"], 1e-3)


def row(build, program, work):
    """A row of the claim, with the verdict: better, equal, worse, or None if nobody has inspected this picture."""
    seen, line = yaml.safe_load(SEEN.read_text())[program.name], show(build, program, work)
    if "error" in line:
        verdict, text = None, line["error"]
    else:
        stale = is_stale(line, seen)
        verdict = None if stale else seen["seen"]
        text = (
            f"{'look again: ' + line['sheet'] if stale else seen['seen']}: {seen['why']}; mean luminance of raster, "
            f"beauty, relit: "
            f"{', '.join(map(str, line['luminance']))}; gate N {line['N']}")
    print(f"{program.name}: {text}", flush=True)
    return {
        "what": f"{program.name}: relit beside its raster frame", "figure": text, "bar": "not worse; gate N passed",
        "peer": None, "passed": verdict in ("better", "equal") and line["N"] == "passed"
    }, verdict
