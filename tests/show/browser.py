"""The report's page in Chromium without a network: opened, photographed, and operated by operate.js."""
import json
import pathlib
import re
import subprocess
import threading

HERE = pathlib.Path(__file__).resolve().parent
NAME = "chromium"
SAID = re.compile(r"FOUND(\{.*\})DNUOF")


def command(work, page, *options):
    """Command line that opens a page; `work` holds the browser's profile."""
    return [
        NAME, "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run",
        f"--user-data-dir={work / 'profile'}", "--host-resolver-rules=MAP * ~NOTFOUND", "--window-size=1600,1300",
        *options, f"file://{page}"
    ]


def said(work, page):
    """Text that the page's script prints by console.log("FOUND{...}DNUOF"), or None after a minute without any. Unlike
    --dump-dom, this waits for the script."""
    child = subprocess.Popen(command(work, page,
                                     "--enable-logging=stderr"), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True)
    watchdog = threading.Timer(60, child.kill)
    watchdog.start()
    found = next((m for m in (SAID.search(line) for line in child.stderr) if m), None)
    watchdog.cancel()
    child.kill()
    child.communicate()
    return json.loads(found[1]) if found else None


def operate(work, report, at=""):
    """The result of operate.js in a report's page, opened at a frame ("#7")."""
    page = report / "operated.html"
    text = (report / "index.html").read_text()
    text = text.replace(
        "<body>", "<body><script>window.wrong = []; addEventListener('error', e => wrong.push(e.message));</script>", 1)
    page.write_text(text.replace("</body>", f"<script>{(HERE / 'operate.js').read_text()}</script></body>"))
    return said(work, f"{page}{at}")


def accessible(work, report, scheme="light"):
    """Accessibility faults that accessible.js finds in a report's page under a colour scheme."""
    page = report / "accessible.html"
    text = (report / "index.html").read_text()
    if scheme == "dark":  # as if the system preferred dark
        text = text.replace("@media (prefers-color-scheme: dark)", "@media screen", 1)
    page.write_text(text.replace("</body>", f"<script>{(HERE / 'accessible.js').read_text()}</script></body>"))
    return said(work, page)


def printed(work, report):
    """The names of the parts that the page's print style keeps, and whether a picture or table is wider than the paper."""
    page = report / "printed.html"
    script = """<script>
addEventListener("load", () => setTimeout(() => {
	const shown = [...document.querySelectorAll("#side, #tools, #pixel, #keys, h1, h2, #chart, #views img, #verdicts, table")].filter(node => node.checkVisibility());
	console.log("FOUND" + JSON.stringify({ shown: [...new Set(shown.map(node => node.id || node.tagName))].sort(), wide: document.documentElement.scrollWidth > document.documentElement.clientWidth,
		back: getComputedStyle(document.body).backgroundColor }) + "DNUOF");
}, 300));
</script></body>"""
    page.write_text((report / "index.html").read_text().replace("@media (prefers-color-scheme: dark)", "@media screen",
                                                                1).replace("@media print", "@media screen",
                                                                           1).replace("</body>", script))
    return said(work, page)


def narrow(work, report, width):
    """Width of a report's page on a screen of `width` pixels, in each of its views. An iframe is used because no
    browser window can be that narrow."""
    page, around = report / "narrow.html", report / "around.html"
    script = """<script>
addEventListener("load", () => setTimeout(() => {
	const found = {};
	for (const mode of ["side", "blink", "swipe", "all"]) {
		state.mode = mode;
		show_frame();
		const gates = document.querySelector(".gates");
		found[mode] = [innerWidth, Math.max(document.documentElement.scrollWidth, innerWidth + gates.scrollWidth - gates.clientWidth)];
	}
	console.log("FOUND" + JSON.stringify(found) + "DNUOF");
}, 300));
</script></body>"""
    page.write_text((report / "index.html").read_text().replace("</body>", script))
    around.write_text(f'<iframe src="narrow.html" style="width: {width}px; height: 800px; border: 0"></iframe>')
    return said(work, around)
