"""A display for scripts that need one."""
import os
import pathlib
import sys

XVFB = pathlib.Path(__file__).resolve().parent.parent / "xvfb.sh"


def need_display():
    """Restart the running script under Xvfb unless it has a display; returns only if there is one."""
    if "DISPLAY_IS_OURS" not in os.environ:
        os.execve(XVFB, [str(XVFB), sys.executable, "-B", *sys.argv], dict(os.environ, DISPLAY_IS_OURS="1"))
