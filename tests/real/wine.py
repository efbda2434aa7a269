"""Corpus programs as Windows programs (`make windows`), with their options, and the Wine that runs them."""
PROGRAMS = {"two_triangles": ("--animate", "camera"), "spheres": ("--animate", "camera"), "tricks": ("zfail",)}


def loader(build):
    """Wine for 32- and 64-bit programs, if it was built with a recorder for each; otherwise the system's, for 64 bits
    only."""
    both = build / "wine32/usr/lib/wine/wine"
    return both if both.exists() and (build / "lib/i386-linux-gnu/librelume.so").exists() else "wine"


def environment(build, prefix):
    """prefix: the folder with Wine's settings"""
    return {
        "WINEPREFIX": str(prefix), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree=;mshtml=", "WINEARCH": "win64",
        "LD_LIBRARY_PATH": str(build / "wine32/usr/lib/i386-linux-gnu")
    }
