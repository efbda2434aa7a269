#!/usr/bin/python3
"""relume denoise on frames with known light: reduction of noise, sharpness, motion, and refused input."""
import os
import random
import struct
import subprocess

from exr import Image
from helpers import SCRATCH, check, finish, must, relume

WIDTH, HEIGHT, FRAMES, SPEED = 64, 48, 5, 3
MOTION = ("motion.X", "motion.Y", "motion.A")


def write(path, planes):
    """Stored as floats, uncompressed."""
    names = sorted(planes)
    channels = b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<4i", 0, 0, WIDTH - 1, HEIGHT - 1)
    header = {
        "channels": ("chlist", channels), "compression": ("compression", b"\0"), "dataWindow": ("box2i", window),
        "displayWindow": ("box2i", window), "lineOrder": ("lineOrder", b"\0"),
        "pixelAspectRatio": ("float", struct.pack("<f", 1)), "screenWindowCenter": ("v2f", bytes(8)),
        "screenWindowWidth": ("float", struct.pack("<f", 1)), "relume:time": ("string", b"7")
    }
    out = struct.pack("<II", 20000630, 2) + b"".join(
        n.encode() + b"\0" + k.encode() + b"\0" + struct.pack("<i", len(v)) + v for n, (k, v) in header.items()) + b"\0"
    size = 8 + WIDTH * 4 * len(names)
    first = len(out) + 8 * HEIGHT
    out += struct.pack(f"<{HEIGHT}Q", *(first + y * size for y in range(HEIGHT)))
    for y in range(HEIGHT):
        out += struct.pack("<ii", y, size - 8) + b"".join(struct.pack(f"<{WIDTH}f", *planes[n][y]) for n in names)
    path.write_bytes(out)


def light_at(x, y, frame):
    """A wall whose shadow edge (in the upper half) and pattern move by SPEED pixels per frame; a floor below."""
    return 0.2 if y < HEIGHT // 2 and x - SPEED * frame < WIDTH // 2 else 1.0


def albedo_at(x, frame):
    return 0.8 if (x - SPEED * frame) // 2 % 2 else 0.3


def make(folder, left_out=(), other_border=1.0):
    """other_border: factor on the wall's last row in all frames but the third, whose samples may hit the floor."""
    folder.mkdir()
    for frame in range(FRAMES):
        noise = random.Random(frame)

        def plane(f):
            return [[f(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]

        noisy = plane(lambda x, y, i=frame, n=noise: light_at(x, y, i) * albedo_at(x, i) * n.choice(
            (0.4, 0.7, 1.0, 1.3, 1.6)) * (other_border if y == HEIGHT // 2 - 1 and i != 2 else 1))
        planes = {c: noisy for c in "RGB"}
        for c in "RGB":
            planes[f"albedo.{c}"] = plane(lambda x, _, i=frame: albedo_at(x, i))
            planes[f"reflect.{c}"] = planes[f"refract.{c}"] = planes[f"shadow.{c}"] = plane(lambda *_: 0)
        planes["Z"] = plane(lambda *_: 10)
        for c, turned in zip("XYZ", ((0, 0), (0, 1), (1, 0))):
            planes[f"N.{c}"] = plane(lambda _, y, t=turned: t[y >= HEIGHT // 2])
        for c, value in zip(MOTION, (SPEED, 0, 1)):
            planes[c] = plane(lambda *_, v=value: v if frame else 0)
        write(folder / f"{frame:04}.exr", {n: p for n, p in planes.items() if n not in left_out})


def error(path, frame, part=lambda x, y: True):
    """Mean squared error of the light, relative to its mean square."""
    red = Image(path).planes["R"]
    sums = [0, 0]
    for y in range(HEIGHT):
        for x in range(WIDTH):
            if part(x, y):
                truth = light_at(x, y, frame) * albedo_at(x, frame)
                sums[0] += (red[y][x] - truth) ** 2
                sums[1] += truth ** 2
    return sums[0] / sums[1]


make(SCRATCH / "noisy")
must(relume("denoise", SCRATCH / "noisy", "-o", SCRATCH / "time.####.exr"))
must(relume("denoise", SCRATCH / "noisy", "-o", SCRATCH / "space.####.exr", "--no-time"))
noisy, time, space = (error(path, 2)
                      for path in (SCRATCH / "noisy/0002.exr", SCRATCH / "time.0002.exr", SCRATCH / "space.0002.exr"))
check(time < noisy / 12, f"with neighbouring frames: {noisy:.4f} becomes {time:.4f}")
check(space < noisy / 8, f"without them: {noisy:.4f} becomes {space:.4f}")
check(time < space, f"neighbouring frames help: {time:.5f} and {space:.5f}")
edge = WIDTH // 2 + SPEED * 2
near = error(SCRATCH / "time.0002.exr", 2, lambda x, y: y < HEIGHT // 2 and abs(x - edge) < 4)
check(near < 0.03, f"the shadow's edge stays in place: {near:.4f}")

make(SCRATCH / "mixed", other_border=1.4)
must(relume("denoise", SCRATCH / "mixed", "-o", SCRATCH / "mixed.exr", "-f", "2"))
planes = [Image(SCRATCH / name).planes["R"][HEIGHT // 2 - 1] for name in ("mixed.exr", "space.0002.exr")]
check(
    sum(planes[0]) < 1.02 * sum(planes[1]),
    f"pixels at a surface's border are not mixed with others: {sum(planes[0]) / sum(planes[1]):.4f}")

image = Image(SCRATCH / "time.0002.exr")
check({"R", "G", "B", "albedo.R", "N.X", "Z", *MOTION} <= set(image.names), f"channels: {image.names}")
check(not [n for n in image.names if n.split(".")[0] in ("shadow", "reflect", "refract")],
      f"effect channels are removed: {image.names}")
check(image.attributes.get("relume:time") == b"7", "attributes stay")

must(relume("denoise", SCRATCH / "noisy", "-o", SCRATCH / "one.exr", "-f", "2"))
check((SCRATCH / "one.exr").read_bytes() == (SCRATCH / "time.0002.exr").read_bytes(),
      "a frame alone is the same as in a sequence")

make(SCRATCH / "still", MOTION)
must(relume("denoise", SCRATCH / "still", "-o", SCRATCH / "still.####.exr"))
check(abs(error(SCRATCH / "still.0002.exr", 2) - space) < 1e-6, "without motion vectors each frame is denoised alone")

make(SCRATCH / "poor", ("albedo.G",))
poor = relume("denoise", SCRATCH / "poor", "-o", SCRATCH / "poor.####.exr")
check(poor.returncode == 3 and "albedo.G" in poor.stderr and not list(SCRATCH.glob("poor.*.exr")),
      f"no albedo: {poor.returncode} {poor.stderr}")
check(relume("denoise", SCRATCH / "noisy", "-o", SCRATCH / "x.png").returncode == 2, "no PNG")
check(relume("denoise", SCRATCH / "noisy", "-o", SCRATCH / "x.exr").returncode == 2, "five frames need five names")
check(relume("denoise", SCRATCH / "none", "-o", SCRATCH / "x.####.exr").returncode == 3, "a missing folder")

# Open Image Denoise itself is compared by make show-denoise
with_oidn = relume("denoise", SCRATCH / "noisy", "-o", SCRATCH / "oidn.####.exr", "--oidn")
check(with_oidn.returncode == 0 or with_oidn.returncode == 5 and "not installed" in with_oidn.stderr,
      f"--oidn: {with_oidn.returncode} {with_oidn.stderr}")
(SCRATCH / "lib").mkdir()
(SCRATCH / "empty.c").write_text("int nothing;\n")
subprocess.run(["cc", "-shared", "-fPIC", "-o", SCRATCH / "lib/libOpenImageDenoise.so.2", SCRATCH / "empty.c"],
               check=True)
for words in (("denoise", SCRATCH / "noisy"), ("render", SCRATCH / "none.trace", "-f", "1-2", "--mode", "path")):
    other = relume(*words, "-o", SCRATCH / "other.####.exr", "--oidn",
                   env=os.environ | {"LD_LIBRARY_PATH": str(SCRATCH / "lib")})
    check(other.returncode == 5 and "has no oidnNewDevice" in other.stderr and not list(SCRATCH.glob("other.*")),
          f"{words[0]} with another library: {other.returncode} {other.stderr}")
finish()
