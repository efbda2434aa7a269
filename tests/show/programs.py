"""The real programs that are recorded and scored: their packages, command lines and input.

All are packages of Debian 12. One line per program; `keys` are steps for tests/show/recording.py: "wait SECONDS", "key
NAME", "click X Y", "type TEXT", with the pointer in the middle of the screen (no window manager: the keyboard's focus
follows it). A program with keys, or with a value for `seconds`, is recorded for that time and its last frames are
scored; the others are recorded for a number of frames, and frames spread over these are scored.
"""
import dataclasses
import math
import pathlib
import subprocess

import more_programs

# Models that Inventor's demos are given, and input that makes them draw again.
MODELS = "/usr/share/inventor/data/models"
DEMO_MODELS = {
    "gview": (f"{MODELS}/bird.iv", ),
    "qmorf": (f"{MODELS}/CyberHeads/josie.iv", f"{MODELS}/CyberHeads/paul.iv")
}
WINDMILL = "/usr/share/doc/inventor-demo/src/apps/examples/Mentor/01.1.Windmill.iv"


@dataclasses.dataclass(frozen=True)
class Program:
    name: str
    package: str
    command: tuple
    keys: tuple = ()
    seconds: float = 0  # record for this time instead of a number of frames
    ref_every: int = 5  # frames per reference frame
    files: tuple = ()  # (name below the home folder, text) of files needed before the start
    group: str = ""  # its group in the sweep's counts
    environment: tuple = ()


def xscreensaver(name, package="xscreensaver-gl", group="xscreensaver, fixed function"):
    return Program(name, package, (name, "-geometry", "640x480"), group=group)


def rss_glx(name):
    # Without --vsync 0 these programs exit on their own.
    return Program(name, "rss-glx", (name, "--vsync", "0", "--geometry", "640x480"), group="rss-glx")


PLAYER = "fullscreen 0\nwidth 640\nheight 480\nplayer Player\n"

OPEN = (
    Program("glxgears", "mesa-utils", ("glxgears", )),
    Program("SceneViewer", "inventor-clients", ("SceneViewer", WINDMILL), seconds=15, ref_every=1),
    Program("billard-gl", "billard-gl", ("billard-gl", ), seconds=15),
    Program("gltron", "gltron", ("gltron", "-s", "-2"), seconds=30,
            keys=("wait 4", "key Return", "wait 1", "key Return", "wait 1", "key Return")),
    Program(
        "neverball", "neverball", ("neverball", ), seconds=60, files=((".neverball/neverballrc", PLAYER), ),
        keys=("wait 8", "key Return", "wait 3", "key Return", "wait 3", "key Return", "wait 4", "key Return", "wait 3",
              "key Return")),
    Program("openarena", "openarena", ("openarena", "+set", "r_fullscreen", "0", "+set", "cl_renderer", "opengl1",
                                       "+set", "r_mode", "3", "+set", "sv_pure", "0", "+devmap", "oa_dm1"), seconds=50),
    # The mouse is the stick: release it in the middle of the window, and launch the glider again before it lands. The
    # program asks before it quits.
    Program("crrcsim", "crrcsim", ("crrcsim", ), seconds=40,
            keys=("wait 6", "click 320 240", *(8 * ("key r", "wait 2")), "key q", "wait 1", "click 359 264")),
    rss_glx("lattice"),
    xscreensaver("queens"),
    xscreensaver("lament", "xscreensaver-gl-extra"),
    xscreensaver("atlantis", "xscreensaver-gl-extra"),
    xscreensaver("superquadrics"),
    xscreensaver("molecule"),
    xscreensaver("noof", "xscreensaver-gl-extra"),
)

# Hacks with GLSL shaders of their own, counted separately.
WITH_SHADERS = {"etruscanvenus", "hypertorus", "klein", "projectiveplane", "romanboy", "sphereeversion"}
# Installed with the hacks, but not hacks: a helper, and two that need the network.
NO_HACKS = {"xscreensaver-gl-visual", "mapscroller", "mapscroller.pl"}


def installed(package, folder, leave_out=()):
    """Names of the files that a package installed in a folder."""
    listed = subprocess.run(["dpkg", "-L", package], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                            text=True).stdout.split()
    return sorted(
        pathlib.Path(p).name
        for p in listed
        if str(pathlib.Path(p).parent) == folder and pathlib.Path(p).name not in leave_out)


def sweep():
    """All installed programs of the sweep, in a fixed order."""
    programs = []
    for package in ("xscreensaver-gl", "xscreensaver-gl-extra"):
        for name in installed(package, "/usr/libexec/xscreensaver", NO_HACKS):
            programs.append(
                xscreensaver(name, package,
                             "xscreensaver, GLSL" if name in WITH_SHADERS else "xscreensaver, fixed function"))
    for name in installed("rss-glx", "/usr/libexec/xscreensaver"):
        if name != "drempels":  # exits on its own, even without the recorder
            programs.append(rss_glx(name))
    for name in installed("inventor-demo", "/usr/lib/inventor"):
        if "." not in name:
            programs.append(
                Program(f"iv-{name}", "inventor-demo", (f"/usr/lib/inventor/{name}", *DEMO_MODELS.get(name, ())),
                        keys=more_programs.TURN, ref_every=1, group="Inventor"))
    programs.append(Program("iv-ivview", "inventor-clients", ("ivview", WINDMILL), seconds=10,
                            ref_every=1, group="Inventor"))
    for name in OSG_EXAMPLES:
        programs.append(Program(name, "openscenegraph", (name,), seconds=8, ref_every=5, group="OpenSceneGraph",
                                environment=(("OSG_WINDOW", "100 100 640 480"), ("OSG_SCREEN", "0"))))
    programs += VIEWERS + GAMES
    programs.append(Program("geomview", "geomview", ("geomview", "-wpos", "640,480@100,100", DODECAHEDRON),
                            seconds=15, ref_every=1, group="others"))
    programs.append(Program("g3dviewer", "g3dviewer", ("g3dviewer",), seconds=15, ref_every=1, group="others"))
    programs += more_programs.more(Program)
    return sorted(programs, key=lambda p: GROUPS.index(p.group))


def knot(along=96, around=16):
    """Text of an OBJ file with a trefoil knot."""
    lines = []
    for i in range(along):
        t = 2 * math.pi * i / along
        r, x, y = 2 + math.cos(3 * t), math.cos(2 * t), math.sin(2 * t)
        for j in range(around):
            u = 2 * math.pi * j / around
            wide = r + 0.4 * math.cos(u)
            lines.append(f"v {wide * x:.6f} {wide * y:.6f} {math.sin(3 * t) + 0.4 * math.sin(u):.6f}")
    for i in range(along):
        for j in range(around):
            a, b = (1 + k % along * around + j for k in (i, i + 1))
            c, d = (1 + k % along * around + (j + 1) % around for k in (i, i + 1))
            lines += [f"f {a} {b} {c}", f"f {c} {b} {d}"]
    return "\n".join(lines) + "\n"


DODECAHEDRON = "/usr/share/geomview/geom/dodec.off"
METHANE = "5\nmethane\nC 0 0 0\nH .63 .63 .63\nH -.63 -.63 .63\nH -.63 .63 -.63\nH .63 -.63 -.63\n"
WORLD = "gameid = minetest\nbackend = sqlite3\nplayer_backend = sqlite3\nauth_backend = sqlite3\n"
MINETEST = "screen_w = 640\nscreen_h = 480\nenable_sound = false\nenable_shaders = true\nfixed_map_seed = 7\nfps_max = 10\nviewing_range = 40\n"

# Qt 5 composes their windows with a shader program; Avogadro and PyMOL also draw with programs of their own.
VIEWERS = [
    Program("openscad", "openscad", ("openscad", "--viewall", "/usr/share/openscad/examples/Basics/CSG.scad"),
            seconds=12, ref_every=1, group="Qt 5 viewers"),
    Program("mm3d", "mm3d", ("mm3d", "knot.obj"), seconds=10, ref_every=1, files=(("knot.obj", knot()), ),
            group="Qt 5 viewers"),
    Program("meshlab", "meshlab", ("meshlab", DODECAHEDRON), seconds=12, ref_every=1, group="Qt 5 viewers"),
    Program("avogadro2", "avogadro", ("avogadro2", "methane.xyz"), seconds=12, ref_every=1,
            files=(("methane.xyz", METHANE), ), group="Qt 5 viewers"),
    Program("pymol", "pymol", ("pymol", "-d", "fragment ala; show spheres; rock"), seconds=12, ref_every=1,
            group="Qt 5 viewers",
            environment=(("PATH", "/usr/bin:/bin"), )),  # needs the python3 that Debian's modules belong to
]
GAMES = [
    Program("minetest", "minetest", ("minetest", "--go", "--name", "player", "--worldname", "world"), seconds=45,
            ref_every=5, files=((".minetest/worlds/world/world.mt", WORLD), (".minetest/minetest.conf", MINETEST)),
            group="games, GLSL"),
    Program("openarena-opengl2", "openarena",
            ("openarena", "+set", "r_fullscreen", "0", "+set", "cl_renderer", "opengl2", "+set", "r_mode", "3", "+set",
             "sv_pure", "0", "+devmap", "oa_dm1"), seconds=50, group="games, GLSL"),
]
GROUPS = [
    "xscreensaver, fixed function", "xscreensaver, GLSL", "rss-glx", "Inventor", "OpenSceneGraph", "Qt 5 viewers",
    "games, GLSL", "others", *more_programs.GROUPS
]
# Examples with shaders that need no model files.
OSG_EXAMPLES = ("osgforest", "osgparametric", "osgparticleshader", "osgshaders", "osgshaderterrain", "osgshadow",
                "osgsimpleshaders", "osgvertexprogram", "osgwidgetshader")
