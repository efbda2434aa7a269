#!/usr/bin/python3
"""tests/show/photons.py BUILD (as `make show-photons`): light from mirrors and glass (channels caustics) against closed
forms, and a glass ball's caustic against a path tracer with 65,536 paths per pixel (tests/truth/test_caustics.c), on
the reference device and on the first OpenCL device.

The bar is for energy: the light that reaches the wall must be right within 1 %. The error per pixel is printed for
information, for the same number of photons and for eight times as many.
"""
import os
import pathlib
import re
import subprocess
import sys

from table import Shown

PATHS = 65536


def main(build):
    shown = Shown(build, "photons")
    for device, name in (("reference", "reference"), ("0", "first OpenCL device")):
        done = subprocess.run(
            [build / "tests/truth/test_caustics"], capture_output=True, text=True, check=False, env=os.environ
            | {"RELUME_TEST_DEVICE": device, "RELUME_CAUSTICS_SAMPLES": str(PATHS), "CK_DEFAULT_TIMEOUT": "1000"})
        forms = re.search(r"Checks: (\d+), Failures: (\d+), Errors: (\d+)", done.stdout)
        shown.row(f"{name}: plate, mirror, ball", f"{forms[1]} tests, {forms[2]} fail" if forms else "no tests",
                  "0 fail", done.returncode == 0)
        for photons, energy, pixels, blocks in re.findall(
                r"(\d+) photons.*energy ([-+.\d]+) %.*pixels ([.\d]+) %.* ([.\d]+) %", done.stdout):
            shown.row(f"{name}: a glass ball's caustic, {photons} photons", f"energy {energy} %", "1 %",
                      abs(float(energy)) < 1)
            shown.row(f"{name}: mean error of pixels; of blocks of 4 x 4", f"{pixels} %, {blocks} %", None,
                      None)
    return shown.finish()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
