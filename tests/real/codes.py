"""Pictures as 8-bit codes, read by oiiotool. It writes OpenEXR, because some versions turn PPM upside down."""
import numpy

from exr import Image
from helpers import SCRATCH, must, run


def codes(picture, *steps):
    """Codes with fractions, [channel][row][column], after further oiiotool steps."""
    raw = SCRATCH / "codes.exr"
    must(run("oiiotool", picture, "--ch", "R,G,B", *steps, "-d", "float", "--compression", "none", "-o", raw))
    picture = Image(raw)
    return 255 * numpy.array([picture.planes[c] for c in "RGB"])


def whole_codes(picture):
    """Codes as bytes, [row][column][channel]."""
    return numpy.rint(codes(picture)).astype(numpy.uint8).transpose(1, 2, 0)
