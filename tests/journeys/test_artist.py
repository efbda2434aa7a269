#!/usr/bin/python3
# limit: 300 s
"""An artist: finds the draw of an object, makes it a mirror under a soft light, walks around it, and exports it to a
modeller."""
import re

from journey import PLACE, begin, check, end, seen, share, typed

begin("still_life", 3)
typed("relume record -o game.trace -- ./game")
scene = typed("relume scene -f 1 game.trace")
sphere = re.search(r"^draw (\d+): .*, glCallList at call \d+", scene, re.M)[1]
(PLACE / "my.yaml").write_text(f"""surfaces:
  - {{ match: {{ draws: "{sphere}" }}, reflect: 0.9 }}
lights:
  - {{ light: 0, radius: 0.3 }}
""")
typed("relume render game.trace -f 1 -o plain.png")
typed("relume render game.trace -f 1 --look my.yaml --samples 4 --denoise -o mine.png", says="1 draw")
(PLACE / "turn.yaml").write_text("turntable: { frames: 3 }\n")
typed("relume render game.trace -f 1 --look my.yaml --camera turn.yaml -o turn.####.png", says="3 frames")
typed("relume export -f 1 -o game.glb game.trace")

changed = share(abs(seen("mine.png") - seen("plain.png")).max(axis=-1) > 20)
check(1 < changed < 60,
      f"the mirror and the soft shadow show, and the rest is unchanged: {changed:.1f} % of the pixels differ")
turns = [seen(f"turn.{i:04}.png") for i in range(3)]
check(all(abs(turns[i] - turns[i - 1]).mean() > 5 for i in range(3)), "three views")
model = (PLACE / "game.glb").read_bytes()
check(model[:4] == b"glTF" and len(model) == int.from_bytes(model[8:12], "little"), "a whole glTF file")
end()
