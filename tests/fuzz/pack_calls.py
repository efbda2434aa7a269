#!/usr/bin/python3
"""pack_calls.py pack FILE FOLDER | unpack FILE FOLDER: kept sequences of calls are many and short, so they share one
file: for each, in the order of names, its length as 32 bits, low byte first, and its bytes."""
import hashlib
import pathlib
import sys

what, file, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
if what == "pack":
    parts = [path.read_bytes() for path in sorted(folder.iterdir())]
    file.write_bytes(b"".join(len(part).to_bytes(4, "little") + part for part in parts))
else:
    data, at = file.read_bytes(), 0
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "little")
        part = data[at + 4:at + 4 + size]
        (folder / hashlib.sha1(part).hexdigest()).write_bytes(part)
        at += 4 + size
