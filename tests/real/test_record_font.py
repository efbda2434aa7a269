#!/usr/bin/python3
# limit: 200 s
"""Text by glXUseXFont, whose font is missing when a trace is replayed: glretrace's pictures and ours must equal the
program's."""
import re

from helpers import BUILD, SCRATCH, check, diff, finish, must, on_display, record, relume, render, run

FRAMES = 5
program = BUILD / "tests/trace/font"
must(on_display("env", f"TMPDIR={SCRATCH}", "tests/real/record_and_replay.sh", str(FRAMES), program))

trace = SCRATCH / "font.trace"
record(trace, program)
files = render(trace, SCRATCH / "frames", "--mode", "gl", "--encoding", "display")
check(len(files) == FRAMES, f"{len(files)} frames of {FRAMES}")
_, score = diff(trace, SCRATCH / "frames")
for frame in score["frames"]:
    check(frame["failing_pixels"] == 0, f"frame {frame['frame']}: {frame['failing_pixels']} pixels fail")
info = must(relume("info", trace)).stdout
check("every call is executed" in info, f"no call is unhandled: {info}")
dump = run("apitrace", "dump", "--color=never", trace).stdout
check(re.search(r"glXUseXFont\(font = \d+, first = 0, count = 256, list = 1000\)", dump),
      "the call itself, as the program made it")
check(dump.count("glBitmap(") == 512, f"{dump.count('glBitmap(')} bitmaps of 512 characters")

# A character taller than 4096 pixels is recorded without a bitmap but with its advance; the font's other characters are
# unaffected.
fonts, tall = SCRATCH / "fonts", SCRATCH / "tall.trace"
fonts.mkdir()
(fonts / "fonts.dir").write_text("1\ntall.bdf tall\n")
glyphs = ("A", 65, 8, 5000), ("B", 66, 8, 8)
(fonts / "tall.bdf").write_text(
    "STARTFONT 2.1\nFONT tall\nSIZE 8 75 75\nFONTBOUNDINGBOX 8 5000 0 0\nSTARTPROPERTIES 2\nFONT_ASCENT "
    "8\nFONT_DESCENT 0\nENDPROPERTIES\n"
    f"CHARS {len(glyphs)}\n" +
    "".join(f"STARTCHAR {name}\nENCODING {code}\nSWIDTH 500 0\nDWIDTH {w} 0\nBBX {w} {h} 0 0\nBITMAP\n" + "FF\n" * h +
            "ENDCHAR\n" for name, code, w, h in glyphs) + "ENDFONT\n")
record(tall, program, fonts)
render(tall, SCRATCH / "tall", "--mode", "gl", "--encoding", "display")
_, score = diff(tall, SCRATCH / "tall")
for frame in score["frames"]:
    check(frame["failing_pixels"] == 0,
          f"a tall character, frame {frame['frame']}: {frame['failing_pixels']} pixels fail")
dump = run("apitrace", "dump", "--color=never", tall).stdout
found = [(int(w), int(h), float(move))
         for w, h, move in re.findall(r"glBitmap\(width = (\d+), height = (\d+), .*?xmove = ([^,]+),", dump)][512:]
check(found == [(1, 1, 8.0), (8, 8, 8.0)], f"bitmaps of A and B: {found}")
finish()
