"""The real programs that are recorded and scored: which package they come from, how they are started and what they are told.

All are Debian 12's, written by other people. A line per program; `keys` are steps for tests/show/recording.py:
"wait SECONDS", "key NAME", "click X Y", "type TEXT", with the pointer in the middle of the screen (no window manager: the
keyboard's focus follows it). A program with keys, or one that is said to take `seconds`, is recorded for so long and
its last frames are scored; the others are recorded for a number of frames, and frames spread over these are scored.
"""
import dataclasses
import pathlib
import subprocess

WINDMILL = "/usr/share/doc/inventor-demo/src/apps/examples/Mentor/01.1.Windmill.iv"


@dataclasses.dataclass(frozen=True)
class Program:
    name: str
    package: str
    command: tuple
    keys: tuple = ()
    seconds: float = 0  # record for so long instead of a number of frames
    ref_every: int = 5  # a reference frame of so many
    files: tuple = ()  # (name below the home folder, text) that must be there before the start
    group: str = ""  # what the sweep counts it under
    environment: tuple = ()


def xscreensaver(name, package="xscreensaver-gl", group="xscreensaver, fixed function"):
    return Program(name, package, (name, "-geometry", "640x480"), group=group)


def rss_glx(name):
    # Without --vsync 0 these programs end by themselves.
    return Program(name, "rss-glx", (name, "--vsync", "0", "--geometry", "640x480"), group="rss-glx")


PLAYER = "fullscreen 0\nwidth 640\nheight 480\nplayer Player\n"

OPEN = (
    Program("glxgears", "mesa-utils", ("glxgears",)),
    Program("SceneViewer", "inventor-clients", ("SceneViewer", WINDMILL), seconds=15,
            ref_every=1),
    Program("billard-gl", "billard-gl", ("billard-gl",), seconds=15),
    Program("gltron", "gltron", ("gltron", "-s", "-2"), seconds=30,
            keys=("wait 4", "key Return", "wait 1", "key Return", "wait 1", "key Return")),
    Program("neverball", "neverball", ("neverball",), seconds=60, files=((".neverball/neverballrc", PLAYER),),
            keys=("wait 8", "key Return", "wait 3", "key Return", "wait 3", "key Return", "wait 4", "key Return", "wait 3", "key Return")),
    Program("openarena", "openarena", ("openarena", "+set", "r_fullscreen", "0", "+set", "cl_renderer", "opengl1", "+set", "r_mode",
                                       "3", "+set", "sv_pure", "0", "+devmap", "oa_dm1"), seconds=50),
    # The mouse is the stick: let go, in the middle of the window, and the glider thrown again before it lands. It asks before it ends.
    Program("crrcsim", "crrcsim", ("crrcsim",), seconds=40,
            keys=("wait 6", "click 320 240", *(8 * ("key r", "wait 2")), "key q", "wait 1", "click 359 264")),
    rss_glx("lattice"),
    xscreensaver("queens"),
    xscreensaver("lament", "xscreensaver-gl-extra"),
    xscreensaver("atlantis", "xscreensaver-gl-extra"),
    xscreensaver("superquadrics"),
    xscreensaver("molecule"),
    xscreensaver("noof", "xscreensaver-gl-extra"),
)

# Hacks that bring shaders of their own (GLSL): told apart in the count.
WITH_SHADERS = {"etruscanvenus", "hypertorus", "klein", "projectiveplane", "romanboy", "sphereeversion"}
# Installed beside the hacks and no hacks: a helper, and two that need the network.
NO_HACKS = {"xscreensaver-gl-visual", "mapscroller", "mapscroller.pl"}


def installed(package, folder, leave_out=()):
    """The names of what a package put into a folder."""
    listed = subprocess.run(["dpkg", "-L", package], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.split()
    return sorted(pathlib.Path(p).name for p in listed if str(pathlib.Path(p).parent) == folder and pathlib.Path(p).name not in leave_out)


def sweep():
    """Every program of the sweep that is installed, in a fixed order."""
    programs = []
    for package in ("xscreensaver-gl", "xscreensaver-gl-extra"):
        for name in installed(package, "/usr/libexec/xscreensaver", NO_HACKS):
            programs.append(xscreensaver(name, package, "xscreensaver, GLSL" if name in WITH_SHADERS else "xscreensaver, fixed function"))
    for name in installed("rss-glx", "/usr/libexec/xscreensaver"):
        if name != "drempels":  # ends by itself, recorded or not
            programs.append(rss_glx(name))
    for name in installed("inventor-demo", "/usr/lib/inventor"):
        if "." not in name:
            programs.append(Program(f"iv-{name}", "inventor-demo", (f"/usr/lib/inventor/{name}",), seconds=10, ref_every=1,
                                    group="Inventor"))
    programs.append(Program("iv-ivview", "inventor-clients", ("ivview", WINDMILL), seconds=10,
                            ref_every=1, group="Inventor"))
    for name in OSG_EXAMPLES:
        programs.append(Program(name, "openscenegraph", (name,), seconds=15, ref_every=5, group="OpenSceneGraph",
                                environment=(("OSG_WINDOW", "100 100 640 480"), ("OSG_SCREEN", "0"))))
    programs.append(Program("geomview", "geomview", ("geomview", "-wpos", "640,480@100,100", "/usr/share/geomview/geom/dodec.off"),
                            seconds=15, ref_every=1, group="others"))
    programs.append(Program("g3dviewer", "g3dviewer", ("g3dviewer",), seconds=15, ref_every=1, group="others"))
    return sorted(programs, key=lambda p: GROUPS.index(p.group))


GROUPS = ["xscreensaver, fixed function", "xscreensaver, GLSL", "rss-glx", "Inventor", "OpenSceneGraph", "others"]
OSG_EXAMPLES = ()
