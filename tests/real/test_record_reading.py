#!/usr/bin/python3
"""Frames are read back as displayed, whatever pixel state the program has set, and the program's state is preserved."""
from helpers import BUILD, SCRATCH, RELUME, check, finish, must, on_display, record, relume
from replayed import reference_depths, reference_frames

program = BUILD / "tests/trace/reading"
pictures = {}
for name, arguments in (("plain", ("plain",)), ("odd", ())):
    record(SCRATCH / f"{name}.trace", program, *arguments,
           options=("--ref", "color,depth"))  # the program exits with 1 if its state changed
    pictures[name] = reference_frames(SCRATCH / f"{name}.ref"), reference_depths(SCRATCH / f"{name}.ref")
colors, depths = pictures["plain"]
check(len(colors) == len(depths) == 11 and len({c[2] for c in colors.values()}) == 11, "11 frames that look different")
for what, was, now in (("colours", colors, pictures["odd"][0]), ("depths", depths, pictures["odd"][1])):
    check(now.keys() == was.keys() and not [i for i in was if now[i] != was[i]],
          f"{what} of frames {[i for i in was if now.get(i) != was[i]]} differ")

# Reference frames that cannot be written only cause a message with the reason.
(SCRATCH / "taken.ref").mkdir()
done = on_display(RELUME, "record", "-o", SCRATCH / "taken.trace", "--ref", "color", "--", program)
said = [line for line in done.stderr.splitlines() if "no more reference frames" in line]
check(done.returncode == 5 and len(said) == 1 and "Is a directory" in said[0],
      f"a folder in place of the references: {done.returncode}, {done.stderr}")
must(relume("info", SCRATCH / "taken.trace"))
finish()
