"""Pictures as codes of 8 bits, read by oiiotool. It writes them as OpenEXR: its PPM stands on its head in some
versions."""
import numpy

from exr import Image
from helpers import SCRATCH, must, run


def codes(picture, *steps):
    """Codes with their fractions, [channel][row][column], after more steps of oiiotool's."""
    raw = SCRATCH / "codes.exr"
    must(run("oiiotool", picture, "--ch", "R,G,B", *steps, "-d", "float", "--compression", "none", "-o", raw))
    picture = Image(raw)
    return 255 * numpy.array([picture.planes[c] for c in "RGB"])


def whole_codes(picture):
    """Codes as bytes, [row][column][channel]."""
    return numpy.rint(codes(picture)).astype(numpy.uint8).transpose(1, 2, 0)
