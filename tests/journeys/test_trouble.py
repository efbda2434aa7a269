#!/usr/bin/python3
# limit: 300 s
"""A user in trouble: a truncated recording, a typing error, a home that cannot be written, a build that draws
differently."""
from journey import PLACE, begin, check, end, seen, typed

begin("cornell", 6)
typed("relume record -o whole.trace -- ./game")
whole = (PLACE / "whole.trace").read_bytes()
(PLACE / "cut.trace").write_bytes(whole[:len(whole) * 3 // 4])
typed("relume render cut.trace -f 0-5 -o lost.####.png", code=2, says="relume repair")
said = typed("relume repair -o saved.trace cut.trace", says="kept")
check("0 frames" not in said, f"frames are saved: {said}")
typed("relume rendr saved.trace -o x.png", code=2, says="did you mean 'render'")
typed("relume render saved.trace -f 1 -o saved.####.png")
(PLACE / "nohome").write_text("")
typed("env -u XDG_CACHE_HOME HOME=$PWD/nohome TMPDIR=$PWD relume render saved.trace -f 1 -o homeless.png",
      says="caches are in")
check((PLACE / "saved.0001.png").read_bytes() == (PLACE / "homeless.png").read_bytes(),
      "the same picture without a home")
typed("relume record -o bad.trace -- ./game --animate light")
said = typed("relume bisect --report parts whole.trace bad.trace", code=1, says="first picture that differs")
check("glLightfv" in said, f"the call that differs is named: {said[:1000]}")
typed("relume diff --baseline nowhere saved.0001.png", code=4, says="no such folder")
seen("saved.0001.png")
check((PLACE / "parts/index.html").stat().st_size > 1000, "a page shows the difference")
end()
