#!/usr/bin/python3
"""relume look --sheet: the page knows the surface at each pixel and the same rules as relume pick; in a browser,
pointing and clicking select a surface."""
import base64
import json
import re
import shutil
import sys
import zlib

from exr import Image
from helpers import ROOT, SCRATCH, check, corpus, finish, must, record, relume

sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/show"))
import browser  # noqa: E402

trace, page = SCRATCH / "courtyard.trace", SCRATCH / "new/surfaces.html"
record(trace, corpus("courtyard"), "--frames", "3", "--size", "160x120", options=())
must(relume("look", trace, "--sheet", page))
text = page.read_text()
data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])
scene = json.loads(must(relume("scene", trace, "--json", "-f", 1)).stdout)
must(relume("render", trace, "-f", 1, "-o", SCRATCH / "f.####.exr", "--aov", "gl,id", "--mode", "gl"))
image = Image(SCRATCH / "f.0001.exr")
check((data["frame"], data["width"], data["height"]) == (1, 160, 120),
      f"the middle frame: {data['frame']}, {data['width']} x {data['height']}")
check(not re.search(r"(src|href)=[\"']?(http|//|\w+\.)|@import|url\(", text), "the page is self-contained")

# The surface at each pixel, as in channel id.
owners = [number for number, count in zip(data["runs"][::2], data["runs"][1::2]) for _ in range(count)]
ids = [int(value) for row in image.planes["id"] for value in row]
names = {0: 0, **{i + 1: int(re.match(r"draw (\d+):", s["name"])[1]) for i, s in enumerate(data["surfaces"])}}
firsts = [0, *(i["draw"] for i in scene["instances"])]
check([names[o] for o in owners] == [max(f for f in firsts if f <= i) for i in ids], "draws of all pixels")
check(sorted(t["hash"] for t in data["textures"]) == sorted(t["hash"] for t in scene["textures"]), "all textures")
check(sorted(m["hash"] for m in data["meshes"]) == sorted(m["hash"] for m in scene["meshes"]), "all meshes")
for number in sorted(set(owners) - {0}):
    pixel, surface = owners.index(number), data["surfaces"][number - 1]
    picked = must(relume("pick", trace, "-f", 1, f"{pixel % 160},{pixel // 160}")).stdout
    check(f"match: {surface['keys']}\n" in picked,
          f"{surface['name']}: the rule of relume pick: {surface['keys']}, {picked}")
    check(all("# " + line in picked or line.startswith("without ") for line in surface["facts"].splitlines()),
          f"{surface['name']}: the same facts: {surface['facts']}")


def png_rows(url):
    """Size and unpacked bytes of an 8-bit PNG."""
    png = base64.b64decode(url.removeprefix("data:image/png;base64,"))
    width, height = (int.from_bytes(png[at:at + 4]) for at in (16, 20))
    at, packed = 8, b""
    while at < len(png):
        n = int.from_bytes(png[at:at + 4])
        packed += png[at + 8:at + 8 + n] if png[at + 4:at + 8] == b"IDAT" else b""
        at += n + 12
    return width, height, zlib.decompress(packed)


width, height, rows = png_rows(data["picture"])
check((width, height, len(rows)) == (160, 120, 120 * (1 + 3 * 160)),
      f"the frame's picture: {width} x {height}, {len(rows)} bytes")
for texture, shown in zip(scene["textures"], data["textures"]):
    check(png_rows(shown["picture"])[:2] == (texture["width"], texture["height"]), f"texture {shown['hash']} is shown")

# With -o both files are written; with neither option there is nothing to do; invalid requests are refused and leave no
# file.
must(relume("look", trace, "-f", "0-1", "-o", SCRATCH / "rules.yaml", "--sheet", SCRATCH / "both.html"))
check((SCRATCH / "rules.yaml").exists() and "frame\": 0" in (SCRATCH / "both.html").read_text(),
      "both, and the first requested frame")
check(relume("look", trace).returncode == 2, "neither")
check(
    relume("look", trace, "-f", 9, "--sheet", SCRATCH / "no.html").returncode == 2
    and not list(SCRATCH.glob("no.html*")), "a missing frame")

# In the browser: pointing shows a surface, a click keeps it, a tile selects one.
if shutil.which(browser.NAME):
    pixels = [i for i, owner in enumerate(owners) if owner == 1]
    pixel = pixels[len(pixels) // 2] # its neighbours belong to the same surface, because browsers round click positions
    script = """<script>
addEventListener("load", () => setTimeout(() => {
	const box = at("frame").getBoundingClientRect(), found = {};
	const point = (kind, x, y) => at("picture").dispatchEvent(new PointerEvent(kind, { bubbles: true, clientX: box.left + (x + .5) * box.width / width, clientY: box.top + (y + .5) * box.height / height }));
	const dark = () => { const d = at("shade").getContext("2d").getImageData(0, 0, width, height).data; let n = 0; for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n; };
	found.first = [at("rule").hidden, dark()];
	point("pointermove", X, Y);
	found.shown = [at("rule").textContent, at("facts").textContent, dark()];
	point("pointerleave", X, Y);
	found.left = at("rule").hidden;
	point("click", X, Y);
	point("pointerleave", X, Y);
	found.kept = at("rule").textContent;
	point("click", X, Y);
	found.dropped = at("rule").hidden;
	document.querySelector("#textures button").click();
	found.texture = [at("rule").textContent, document.querySelectorAll("button[aria-pressed=true]").length];
	console.log("FOUND" + JSON.stringify(found) + "DNUOF");
}, 300));
</script></body>"""
    operated = SCRATCH / "operated.html"
    operated.write_text(text.replace("</body>", script.replace("X, Y", f"{pixel % 160}, {pixel // 160}")))
    found = browser.said(SCRATCH, operated) or {}
    rule = f"surfaces:\n  - match: {data['surfaces'][0]['keys']}\n    reflect: 0.3\n"
    check(found.get("first") == [True, 0], f"at first: {found}")
    check(
        found.get("shown") == [rule, data["surfaces"][0]["facts"], 160 * 120 - owners.count(1)], f"pointed at: {found}")
    check((found.get("left"), found.get("kept"), found.get("dropped")) == (True, rule, True), f"clicked: {found}")
    check(
        found.get(
            "texture",
            [""])[0] == f"surfaces:\n  - match: {{ texture: \"{data['textures'][0]['hash']}\" }}\n    reflect: 0.3\n",
        f"a texture: {found}")
else:
    print(f"no {browser.NAME} here: the page was not tested")

finish()
