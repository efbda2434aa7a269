#!/usr/bin/python3
"""More of Debian 12's programs, recorded in use: a game in play, a model loaded and rotated. Run as a command, prints
their packages.

One line each: group, name, packages, command, and further arguments of programs.Program. Excluded are programs that
need OpenGL 3 or newer, a joystick, sound, a network or data that Debian lacks; those that draw to a single buffer and
never end a frame; and those that cannot leave their menus without a person.
"""
import os
import shutil

GAMES, SCIENCE, CAD, TEACHING, DESKTOP = GROUPS = "more games", "more science", "more CAD", "more teaching", "more of the desktop"


def hold(*names):
    """Hold each key long enough for a program that polls once per frame, and wait a second after it."""
    return tuple(step for name in names for step in (f"keydown {name}", "wait 0.2", f"keyup {name}", "wait 1"))


SHOOT = "wait 4", "key z", "wait 1", "key z", "wait 1", "keydown z", "key Left", "key Right", "key Up"
TURN = "wait 4", "drag 250 250 350 300", "drag 350 300 280 380"
SMALL = "-nosound", "-window", "-res", "640", "480"
C60 = "/usr/share/doc/xmakemol-gl/examples/C60.xyz"
CUBE = """vertices
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
edges
1 1 2
2 2 3
3 3 4
4 4 1
5 5 6
6 6 7
7 7 8
8 8 5
9 1 5
10 2 6
11 3 7
12 4 8
faces
1 1 10 -5 -9
2 2 11 -6 -10
3 3 12 -7 -11
4 4 9 -8 -12
5 5 6 7 8
6 -4 -3 -2 -1
bodies
1 1 2 3 4 5 6 volume 1
read
s
q
r
g 2000
"""
BRICK = """solid brick
""" + "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {20 * a} {20 * b} {20 * c}\n"
                                                           for a, b, c in corners) + "endloop\nendfacet\n"
              for corners in (((0, 0, 0), (1, 1, 0), (1, 0, 0)), ((0, 0, 0), (0, 1, 0), (1, 1, 0)),
                              ((0, 0, 1), (1, 0, 1), (1, 1, 1)), ((0, 0, 1), (1, 1, 1), (0, 1, 1)),
                              ((0, 0, 0), (1, 0, 0), (1, 0, 1)), ((0, 0, 0), (1, 0, 1), (0, 0, 1)),
                              ((0, 1, 0), (1, 1, 1), (1, 1, 0)), ((0, 1, 0), (0, 1, 1), (1, 1, 1)),
                              ((0, 0, 0), (0, 0, 1), (0, 1, 1)), ((0, 0, 0), (0, 1, 1), (0, 1, 0)),
                              ((1, 0, 0), (1, 1, 1), (1, 0, 1)), ((1, 0, 0), (1, 1, 0),
                                                                  (1, 1, 1)))) + "endsolid brick\n"
LEGO = "0 wall\n" + "".join(f"1 {row + 1} {40 * column + 20 * (row % 2)} {-24 * row} 0 1 0 0 0 1 0 0 0 1 3003.dat\n"
                            for row in range(4)
                            for column in range(5))
GEO = """SetFactory("Built-in");
Point(1) = {0, 0, 0, .2}; Point(2) = {1, 0, 0, .2}; Point(3) = {1, 1, 0, .2}; Point(4) = {0, 1, 0, .2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Extrude {0, 0, 1} { Surface{1}; }
Mesh 3; Mesh.SurfaceFaces = 1; General.RotationX = 30; General.RotationY = 40;
"""
FBD = """pnt p0 0 0 0
swep all new tra 2 0 0 12
swep all new tra 0 1 0 8
swep all new tra 0 0 1 8
elty all he8
mesh all
rot 1 0 0
plot fv all
view fill
view elem
"""
SOLIDS = "#VRML V2.0 utf8\n" + "".join(
    f"Transform "
    f"{{ translation {3 * i} 0 0 children Shape {{ geometry {solid} {{ }} appearance Appearance {{ material Material {{ diffuseColor {color} }} }} }} }}\n"
    for i, (solid, color) in enumerate((("Box", "1 0 0"), ("Sphere", "0 1 0"), ("Cone", "0 0 1"),
                                        ("Cylinder", "1 1 0"))))
HITS = "".join(
    f"1700000{i // 20:03d}|10.0.{i % 7}.{i % 23}|/pictures/{i % 11}.png|200|{500 + i % 900}\n" for i in range(600))
GROWTH = "".join(
    f"{1700000000 + 8000 * i}|Person {i % 5}|A|/src/part{i % 9}/file{i}.{'chpy'[i % 4]}\n" for i in range(300))
POINTS = "".join(f"{i % 10} {i // 10 % 10} {i // 100} {i % 97}\n" for i in range(1000))
DOS = "[sdl]\noutput=opengl\n[autoexec]\ndir z:\nmem\n"
FREEDOOM = "/usr/share/games/doom/freedoom1.wad"
DOOM = "-vidmode", "gl", "-window", "-width", "640", "-height", "480", "-nosound"
SPIN = "library(rgl); open3d(); shade3d(icosahedron3d(), col = 'gold'); spheres3d(2, 0, 0, 0.5, col = 'red'); axes3d(); play3d(spin3d(), duration = 30)"

TABLE = (
    (GAMES, "chromium-bsu", "chromium-bsu", ("chromium-bsu", "-w", "-na"), {"keys": ("wait 4", "key Return")}),
    (GAMES, "crack-attack", "crack-attack", ("crack-attack", "--solo"), {"keys": ("wait 5", *hold("Return", "Return"))
                                                                         }),
    (GAMES, "torus-trooper", "torus-trooper", ("torus-trooper", *SMALL), {"keys": SHOOT}),
    (GAMES, "rrootage", "rrootage", ("rrootage", "-nosound", "-window"), {"keys": SHOOT}),
    (GAMES, "parsec47", "parsec47", ("parsec47", "-nosound", "-window"),
     {"keys": ("wait 7", "key z", "wait 2", "key z", "wait 1", "keydown z", "key Left"), "seconds": 16}),
    (GAMES, "tumiki-fighters", "tumiki-fighters", ("tumiki-fighters", "-nosound", "-window"), {"keys": SHOOT}),
    (GAMES, "titanion", "titanion", ("titanion", *SMALL), {"keys": SHOOT}),
    (GAMES, "gunroar", "gunroar", ("gunroar", *SMALL),
     {"keys": ("wait 8", "key z", "wait 2", "key z", "wait 1", "keydown z", "key Left"), "seconds": 18}),
    (GAMES, "mu-cade", "mu-cade", ("mu-cade", *SMALL), {"keys": SHOOT, "seconds": 9}),
    (GAMES, "a7xpg", "a7xpg", ("a7xpg", "-nosound", "-window"), {"keys": SHOOT}),
    (GAMES, "ii-esu", "ii-esu", ("ii-esu", "-nosound", "-window"), {"keys": SHOOT}),
    (GAMES, "val-and-rick", "val-and-rick", ("val-and-rick", "-nosound", "-window"), {"keys": SHOOT}),
    (GAMES, "tatan", "tatan", ("tatan", "-nosound", "-window"),
     {"keys": ("wait 4", *hold("Return", "Return"), "click 320 200", "keydown space")}),
    (GAMES, "projectl", "projectl", ("projectl", "-nosound", "-window"),
     {"keys": ("wait 8", "key z", "wait 2", "key z", "wait 2", "key z", "keydown z"), "seconds": 18}),
    (GAMES, "enemylines3", "enemylines3", ("enemylines3", "-noaudio", "-width", "640", "-height", "480"),
     {"keys": ("wait 4", *hold("Return", "Return", "Return"))}),
    (GAMES, "enemylines7", "enemylines7", ("enemylines7", "-noaudio", "-width", "640", "-height", "480"),
     {"keys": ("wait 4", *hold("Return", "Return", "Return"))}),
    (GAMES, "blockout2", "blockout2", ("blockout2", ),
     {"keys": ("wait 5", *hold("Return", "Return", "Return", "Left", "space")), "ref_every": 5, "seconds": 11}),
    (GAMES, "brutalchess", "brutalchess", ("brutalchess", ),
     {"ref_every": 5, "keys": ("wait 8", "drag 300 400 350 400")}),
    (GAMES, "briquolo", "briquolo", ("briquolo", "-w"),
     {"keys": ("wait 5", *hold("Return", "Down", "Down", "Return"), "click 400 300")}),
    (GAMES, "dreamchess", "dreamchess", ("dreamchess", "-W640", "-H480"),
     {"keys": ("wait 5", *hold("Return", "Return", "Return"))}),
    (GAMES, "xracer", "xracer", ("xracer", "-s", "640x480"),
     {"keys": ("wait 4", *hold("Return", "Return"), "keydown Up")}),
    (SCIENCE, "openuniverse", "openuniverse", ("openuniverse", ), {"keys": ("wait 8", )}),
    (GAMES, "pathogen", "pathogen", ("pathogen", ), {"keys": ("wait 5", *hold("Return", "Return", "Return"))}),
    (GAMES, "pong2", "pong2", ("pong2", "-w", "640", "-h", "480"),
     {"keys": ("wait 5", *hold("Return"), "click 320 240")}),
    (GAMES, "sdl-ball", "sdl-ball", ("sdl-ball", ), {
        "keys": ("wait 8", *hold("Return", "Return"), "click 400 300", "wait 1", "click 400 300"), "seconds": 20,
        "ref_every": 5
    }),
    (DESKTOP, "tdfsb", "tdfsb", ("tdfsb", ), {"keys": ("wait 5", "keydown Up")}),
    (GAMES, "armagetronad", "armagetronad", ("armagetronad", "-window"),
     {"keys": ("wait 5", *hold("Return", "Return", "Return"))}),
    (GAMES, "cultivation", "cultivation", ("cultivation", ), {"keys": ("wait 5", )}),
    (SCIENCE, "critterding", "critterding", ("critterding", ), {}),
    (GAMES, "primrose", "primrose", ("primrose", ), {"keys": ("wait 5", *hold("Return", "Return", "Return"))}),
    (GAMES, "transcend", "transcend", ("transcend", ),
     {"keys": ("wait 5", *hold("Return", "Return"), "keydown Up"), "seconds": 10}),
    (SCIENCE, "gravit", "gravit", ("gravit", ), {"ref_every": 2}),
    (DESKTOP, "logstalgia", "logstalgia", ("logstalgia", "-640x480", "hits.log"), {"files": (("hits.log", HITS), )}),
    (GAMES, "freetennis", "freetennis", ("freetennis", "-newbie"),
     {"keys": ("wait 6", "click 400 300", "wait 1", "click 400 300")}),
    (GAMES, "extremetuxracer", "extremetuxracer", ("etr", ),
     {"keys": ("wait 6", *hold("Return", "Return", "Return", "Return", "Return"), "keydown Up"), "seconds": 24}),
    (SCIENCE, "achilles", "achilles", ("achilles", ), {"ref_every": 300}),
    (SCIENCE, "antennavis", "antennavis", ("antennavis", ), {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "drawxtl", "drawxtl", ("sh", "-c",
                                     "cp /usr/share/doc/drawxtl/examples/bucky.str . && exec drawxtl bucky.str"),
     {"ref_every": 1, "keys": ("wait 3", *TURN), "seconds": 18}),
    (SCIENCE, "gdis", "gdis xmakemol-gl", ("gdis", C60), {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "v-sim", "v-sim xmakemol-gl", ("v_sim", C60), {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "evolver", "evolver-ogl", ("evolver-ogl-d", "cube.fe"), {"ref_every": 1, "files": (("cube.fe", CUBE), )}),
    (DESKTOP, "gliv", "gliv tulip", ("gliv", "/usr/share/tulip/bitmaps/samplePictures/1221.png"),
     {"ref_every": 1, "keys": TURN}),
    (GAMES, "neverputt", "neverputt", ("neverputt", ),
     {"keys": ("wait 6", *hold("Return", "Return", "Return"), "click 400 300"), "ref_every": 2, "seconds": 18}),
    (GAMES, "miceamaze", "miceamaze", ("miceamaze", ),
     {"keys": ("wait 5", "click 512 335", "wait 2", "click 512 300", "wait 2", *hold("Return")), "seconds": 16}),
    (GAMES, "teeworlds", "teeworlds teeworlds-server",
     ("sh", "-c",
      "teeworlds-server & exec teeworlds 'gfx_fullscreen 0' 'gfx_screen_width 640' 'gfx_screen_height 480' 'connect "
      "127.0.0.1'"
      ), {"keys": ("wait 8", "keydown d")}),
    (DESKTOP, "dosbox", "dosbox", ("dosbox", "-conf", "dos.conf"), {
        "files": (("dos.conf", DOS), ), "keys": ("wait 5", "type ver", "key Return", "type dir", "key Return"),
        "ref_every": 8
    }),
    (GAMES, "supertux", "supertux", ("supertux2", "--window", "-g", "640x480",
                                     "/usr/share/games/supertux2/levels/world1/above_arctic_skies.stl"),
     {"keys": ("wait 8", *hold("Return"), "keydown Right"), "seconds": 18}),
    (GAMES, "torcs", "torcs", ("torcs", ),
     {"keys": ("wait 9", *(6 * (*hold("Return"), "wait 2")), "keydown Up"), "seconds": 45, "ref_every": 2}),
    (GAMES, "opencity", "opencity", ("opencity", ), {"keys": ("wait 6", "click 300 300"), "seconds": 16}),
    (TEACHING, "kubrick", "kubrick", ("kubrick", ), {"ref_every": 1, "keys": TURN}),
    (TEACHING, "golly", "golly", ("golly", "/usr/share/golly/Patterns/Life/Breeders/breeder.lif"),
     {"ref_every": 1, "keys": ("wait 5", *hold("Return"))}),
    (CAD, "leocad", "leocad", ("leocad", "wall.ldr"),
     {"ref_every": 1, "files": (("wall.ldr", LEGO), ), "keys": ("wait 4", "click 507 278", *TURN), "seconds": 18}),
    (CAD, "gmsh", "gmsh", ("gmsh", "box.geo"),
     {"ref_every": 1, "files": (("box.geo", GEO), ), "keys": ("wait 4", "drag 600 300 520 400")}),
    (CAD, "cgx", "calculix-cgx", ("cgx", "-b", "beam.fbd"),
     {"ref_every": 1, "files": (("beam.fbd", FBD), ), "keys": TURN}),
    (CAD, "repsnapper", "repsnapper", ("repsnapper", "brick.stl"),
     {"ref_every": 1, "files": (("brick.stl", BRICK), ), "keys": TURN}),
    (CAD, "view3dscene", "view3dscene", ("view3dscene", "solids.wrl"),
     {"ref_every": 10, "files": (("solids.wrl", SOLIDS), ), "keys": TURN}),
    (CAD, "goxel", "goxel", ("goxel", ), {"ref_every": 3, "keys": TURN}),
    (SCIENCE, "xcrysden", "xcrysden", ("xcrysden", "--xsf", "/usr/share/doc/xcrysden/examples/XSF_Files/bucky.xsf"),
     {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "ghemical", "ghemical", ("ghemical", "-f", "/usr/share/doc/ghemical/examples/2-chlorobutane.gpr"),
     {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "aven", "survex-aven therion", ("aven", "/usr/share/doc/therion/examples/samples/survex/cave.3d"),
     {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "loch", "therion-viewer therion", ("loch", "/usr/share/doc/therion/examples/samples/survex/cave.3d"),
     {"ref_every": 1, "keys": TURN}),
    (SCIENCE, "rgl", "r-cran-rgl", ("Rscript", "-e", SPIN), {}),
    (DESKTOP, "mplayer", "mplayer tulip", ("mplayer", "-vo", "gl:yuv=0", "-mf", "fps=10", "-loop", "0",
                                           "mf:///usr/share/tulip/bitmaps/samplePictures/*.png"), {"ref_every": 5}),
    (DESKTOP, "projectM", "projectm-sdl", ("projectMSDL", ), {"ref_every": 5}),
    (GAMES, "pipewalker", "pipewalker", ("pipewalker", ),
     {"ref_every": 1, "keys": ("wait 4", "click 150 200", "wait 1", "click 250 300", "wait 1", "click 300 200")}),
    (GAMES, "dsda-doom", "dsda-doom freedoom", ("dsda-doom", "-iwad", FREEDOOM, "-warp", "1", "1", *DOOM),
     {"keys": ("wait 6", "keydown Up", "wait 2", "keydown Left")}),
    (DESKTOP, "glxheads", "mesa-utils", ("glxheads", ), {"ref_every": 500, "seconds": 8}),
)


def packages():
    """All packages that TABLE names."""
    return sorted({one for _, _, package, *_ in TABLE for one in package.split()})


def more(program):
    """The installed programs of this table; program is programs.Program."""
    there = []
    for group, name, package, command, besides in TABLE:
        if shutil.which(command[0], path=os.environ["PATH"] + ":/usr/games"):
            there.append(program(name, package, command, **{"seconds": 14, "ref_every": 20, "group": group, **besides}))
    return there


if __name__ == "__main__":
    print(*packages())
