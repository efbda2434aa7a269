"""A display for the figures that need one."""
import os
import pathlib
import sys

XVFB = pathlib.Path(__file__).resolve().parent.parent / "xvfb.sh"


def need_display():
    """Start the running script again on a display of its own, unless it has one; returns only where it has."""
    if "DISPLAY_IS_OURS" not in os.environ:
        os.execve(XVFB, [str(XVFB), sys.executable, "-B", *sys.argv], dict(os.environ, DISPLAY_IS_OURS="1"))
