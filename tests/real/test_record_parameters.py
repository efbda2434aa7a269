#!/usr/bin/python3
"""Draws whose parameters or arrays are partly in buffers, and primitive restart: the trace contains the drawing of
tests/real/parameters.c."""
from helpers import BUILD, check_replayed, check_same_pictures, finish, on_display, skip

FRAMES = ("instances", "NV_primitive_restart", "glDrawArraysIndirect from memory", "glDrawArraysIndirect from a buffer",
          "glDrawElementsIndirect from memory", "glDrawElementsIndirect from a buffer",
          "glArrayElement with colours in a buffer", "glArrayElement with positions in a buffer")

if on_display(BUILD / "tests/real/parameters").returncode == 77:
    skip("this GL lacks an extension")
trace, _ = check_same_pictures("parameters", FRAMES)
check_replayed(trace, 0)
finish()
