#!/usr/bin/python3
"""Buffers that stay mapped while they are drawn from: data that tests/real/persistent.c stores between draws is in the
trace, once."""
from helpers import BUILD, check, check_replayed, check_same_pictures, finish, on_display, skip

FRAMES, BYTES = 24, 96000 + 16000 + 8000  # frames; bytes of the large buffers and of all changing ones

if on_display(BUILD / "tests/real/persistent").returncode == 77:
    skip("this GL has no GL_ARB_buffer_storage")
trace, _ = check_same_pictures("persistent", [f"frame {i}" for i in range(FRAMES)])
check_replayed(trace, 0)
check(trace.stat().st_size < 2 * BYTES, f"unchanged data is not written again: {trace.stat().st_size} bytes")
finish()
