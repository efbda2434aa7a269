#!/usr/bin/python3
# limit: 300 s
"""Programs whose traced picture was once worse than OpenGL's (corpus): gate N must fail for each old picture, and for
no present one."""
from exr import Image
from helpers import SCRATCH, check, check_gates, corpus, diff, finish, record, render

OFF = SCRATCH / "off.yaml"
OFF.write_text("spare: no\n")

PROGRAMS = {
    "closed_hall": ["closed_hall"], "arena": ["arena"], "blocks": ["blocks"], "tree_cards": ["tree_cards"],
    "board_quad": ["board_fbo"], "board_blit": ["board_fbo", "--by", "blit"],
    "board_shader": ["board_fbo", "--by", "shader"],
}

for name, (program, *options) in PROGRAMS.items():
    trace = SCRATCH / f"{name}.trace"
    record(trace, corpus(program), "--frames", 1, *options)
    render(trace, SCRATCH / name)
    code, score = diff(trace, SCRATCH / name)
    check(code == 0, f"{name}: relume diff exits with {code}")
    check_gates(score, 1, name)
    check(score["frames"][0]["gates"]["N"]["state"] == "passed", f"{name}: {score['frames'][0]['gates']['N']}")
    before = SCRATCH / f"{name}_before"
    render(trace, before, "--look", OFF)
    code, score = diff(trace, before)
    check(code == 1, f"{name}, not spared: relume diff exits with {code}")
    failed = [gate for gate, found in score["frames"][0]["gates"].items() if found["state"] == "failed"]
    check(failed == ["N"], f"{name}, not spared: fails {failed}")

# A framebuffer object's picture that covers the window is traced: pieces cast shadows on the board.
board = {
    shown: Image(SCRATCH / shown / f"{shown}.0000.exr", {"shadow.G"}).planes["shadow.G"]
    for shown in ("board_quad", "board_blit", "board_shader")
}
dark = sum(share < 0.9 for row in board["board_quad"] for share in row)
check(5000 < dark < 50000, f"{dark} pixels of the board are in shadow")
for way in ("board_blit", "board_shader"):
    check(board["board_quad"] == board[way], f"by a quad and by {way[6:]} the board is the same")
finish()
