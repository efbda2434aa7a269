"""Programs of Windows that are corpus programs (`make windows`), with their options, and the Wine that runs them."""
PROGRAMS = {"two_triangles": ("--animate", "camera"), "spheres": ("--animate", "camera"), "tricks": ("zfail",)}


def loader(build):
    """Wine for programs of 32 and 64 bits, where it was built, with a recorder of each; otherwise that of the system,
    for 64 alone."""
    both = build / "wine32/usr/lib/wine/wine"
    return both if both.exists() and (build / "lib/i386-linux-gnu/librelume.so").exists() else "wine"


def environment(prefix):
    """prefix: the folder of Wine's settings"""
    return {"WINEPREFIX": str(prefix), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree=;mshtml=", "WINEARCH": "win64"}
