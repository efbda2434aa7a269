#!/usr/bin/python3
# limit: 300 s
"""A curious developer: records a program, looks at a first picture, at a nicer one, and at a page that compares it with
the program's picture."""
from journey import PLACE, begin, check, end, seen, share, typed

begin()
typed("relume record -o game.trace --ref color,depth -- ./game", says="10 frames")
typed("relume info game.trace", says="every call is executed")
typed("relume render game.trace -f 3 -o first.png", says="rendered 1 frame")
typed("relume render game.trace -f 3 --look auto --samples 4 --denoise -o nice.png")
typed("relume render game.trace -f 3 --mode gl -o gl.png")
typed("relume render game.trace -f 0-2 -o out/game.####.exr")
typed("relume diff game.trace out --report report", says="3 passed")

gl, first, nice = seen("gl.png"), seen("first.png"), seen("nice.png")
darker = share((gl - first).min(axis=-1) > 20)
other = share(abs(gl - first).max(axis=-1) > 20)
check(darker > 0.5, f"shadows: {darker:.1f} % of the pixels are darker than OpenGL's")
check(other > 5, f"mirror and glass: {other:.1f} % of the pixels differ from OpenGL's")
check(abs(nice - first).mean() < 40, "the nicer picture shows the same frame")
check((PLACE / "report/index.html").stat().st_size > 10000, "the page contains its pictures")
seen("report/sheet.png")
end()
