#!/usr/bin/python3
"""tests/show/film.py BUILD (as `make show-film`): films of a recorded program, encoded by ffmpeg and played in
Chromium.

glxgears is recorded live. Its frames are rendered in one run and as four tasks of a farm; films of both must hold the
same pictures. A report with the film is opened in Chromium, which must play it: video frames are drawn into a canvas
and examined. Screenshots are left in BUILD/show/film for inspection.
"""
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/show"))
import browser  # noqa: E402

LAYOUTS = ("side", "wipe", "alternate")

# Runs in the page as a second script: reports the video's properties, and how much its picture changes between one
# eighth and the middle.
PLAY = """<script>
addEventListener("load", async () => {
	const video = document.querySelector("video"), canvas = document.createElement("canvas"), found = {};
	const look = () => { canvas.width = 160; canvas.height = 60; const c = canvas.getContext("2d"); c.drawImage(video, 0, 0, 160, 60);
		return [...c.getImageData(0, 0, 160, 60).data]; };
	const seek = t => new Promise(done => { // until the picture of that time is shown: event seeked may come before, or be an earlier one's
		const look = (_, frame) => Math.abs(frame.mediaTime - t) < 0.1 ? done() : video.requestVideoFrameCallback(look);
		video.requestVideoFrameCallback(look); video.currentTime = t; });
	await new Promise(done => video.readyState >= 2 ? done() : video.addEventListener("loadeddata", done));
	await seek(video.duration / 8); const first = look();
	await seek(video.duration / 2); const middle = look();
	found.width = video.videoWidth; found.height = video.videoHeight; found.seconds = video.duration;
	found.bright = Math.max(...first.filter((v, i) => i % 4 < 3));
	found.moved = first.reduce((sum, v, i) => sum + Math.abs(v - middle[i]), 0) / first.length;
	console.log("FOUND" + JSON.stringify(found) + "DNUOF");
});
</script>"""


def run(*command):
    done = subprocess.run([str(c) for c in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=900)
    if done.returncode:
        sys.exit(f"{command}: exit code {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout


def hashes(film):
    """Hash of each picture of a film, as decoded by ffmpeg."""
    return re.findall(r", (\w{32})$", run("ffmpeg", "-loglevel", "error", "-i", film, "-f", "framemd5", "-"),
                      re.MULTILINE)


def main(build):
    relume, work = build / "relume", build / "show/film"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    trace = work / "gears.trace"
    run(ROOT / "tests/xvfb.sh", relume, "record", "-o", trace, "--ref", "color", "--quit-after", "24", "--", "glxgears")
    run(relume, "render", trace, "-o", work / "one/gears.####.exr")
    for i in range(1, 5):
        run(relume, "render", trace, "-o", work / "four/gears.####.exr", "--chunk", f"{i}/4")
    for folder in ("one", "four"):
        run(relume, "film", work / folder, "-o", work / f"{folder}.webm", "--fps", "12", "--caption", "glxgears")
    for layout in LAYOUTS:
        run(relume, "film", work / "one", "-o", work / f"{layout}.webm", "--fps", "12", "--layout", layout)
    one, four = hashes(work / "one.webm"), hashes(work / "four.webm")
    run(relume, "diff", trace, work / "one", "--report", work / "report", "--film", work / "one.webm")
    page = work / "report/index.html"
    run(*browser.command(work, page, f"--screenshot={work / 'page.png'}"))
    probed = work / "report/probe.html"
    probed.write_text(page.read_text() + PLAY)
    found = browser.said(work, probed) or {}
    lines = [
        ("pictures of the film", len(one), 24, len(one) == 24),
        ("pictures that differ when made by four tasks", sum(a != b for a, b in zip(one, four)) + abs(len(one) - len(four)), 0,
         one == four),
        ("the film's width in Chromium", found.get("width"), 604, found.get("width") == 604),
        ("its seconds", found.get("seconds"), 2, abs(found.get("seconds", 0) - 2) < 0.1),
        ("change from an eighth of it to the middle", found.get("moved"), "above 0.2", found.get("moved", 0) > 0.2),
        ("largest layout of the film, MB", max(
            (work / f"{name}.webm").stat().st_size for name in LAYOUTS) / 1e6, "below 2",
         max((work / f"{name}.webm").stat().st_size for name in LAYOUTS) < 2e6),
    ]
    print(f"{'':46}{'figure':>10}{'bar':>12}")
    for name, figure, bar, good in lines:
        print(
            f"{name:46}{figure if not isinstance(figure, float) else round(figure, 2)!s:>10}{bar:>12}  "
            f"{'holds' if good else 'FALLS SHORT'}"
        )
    peer = " ".join(run("ffmpeg", "-version").split()[:3])
    print(f"screenshot: {work / 'page.png'}; posters: {', '.join(p.name for p in sorted(work.glob('*.jpg')))}")
    (build / "show/film.json").write_text(json.dumps({
        "name": "film", "command": "make show-film",
        "rows": [{"what": n, "figure": f, "bar": b, "peer": peer, "passed": g} for n, f, b, g in lines]}, indent=1))
    sys.exit(not all(good for *_, good in lines))


main(pathlib.Path(sys.argv[1]).resolve())
