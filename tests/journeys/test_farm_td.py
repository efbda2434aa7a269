#!/usr/bin/python3
# limit: 300 s
"""A farm's technical director: renders in tasks, loses frames, finds and renders them again, and makes the film."""
import re

from journey import PLACE, begin, check, end, seen, typed

begin(frames=8)
typed("relume record -o game.trace --ref color,depth -- ./game")
script = typed(
    "relume farm script --for slurm game.trace -f 0-7 --chunk 3 -o far/game.####.exr --gres gpu:1 "
    "--sbatch=--partition=night"
)
check(re.search(r"sbatch .*--partition=night.*--gres 'gpu:1' --array", script), "the script requests GPUs from Slurm")
typed("relume farm submit game.trace -f 0-7 --chunk 3 -o out/game.####.exr --local -- --samples 2")
typed("relume farm status out/game.farm", says="8")
(PLACE / "out/game.0003.exr").unlink()
whole = (PLACE / "out/game.0005.exr").read_bytes()
(PLACE / "out/game.0005.exr").write_bytes(whole[:len(whole) // 2])
said = typed("relume farm status out/game.farm", code=1, says="missing: frame 3")
check("damaged: frame 5" in said, f"the damaged frame is named: {said}")
typed("relume farm retry out/game.farm")
typed("relume farm status out/game.farm")
check((PLACE / "out/game.0005.exr").read_bytes() == whole, "the same bytes as before")
typed("relume film out -o game.webm", says="8 frames")
seen("game.jpg")
end()
