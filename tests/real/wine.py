"""Programs of Windows that are corpus programs (`make windows`), with their options, and the environment that Wine runs them in."""
PROGRAMS = {"two_triangles": ("--animate", "camera"), "spheres": ("--animate", "camera"), "tricks": ("zfail",)}


def environment(prefix):
    """prefix: the folder of Wine's settings"""
    return {"WINEPREFIX": str(prefix), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree=;mshtml=", "WINEARCH": "win64"}
