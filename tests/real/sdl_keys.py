"""sdl_keys.py FRAMES: like tests/trace/keys.c, in an SDL 2 window; also polls keys. Exits with 77 if there is no SDL
display."""
import ctypes
import sys

try:
    sdl, gl = ctypes.CDLL("libSDL2-2.0.so.0"), ctypes.CDLL("libGL.so.1")
except OSError as error:
    print(f"skipped: {error}", file=sys.stderr)
    sys.exit(77)
for name in ("SDL_CreateWindow", "SDL_GL_CreateContext", "SDL_GetKeyboardState", "SDL_GetKeyName"):
    getattr(sdl, name).restype = ctypes.c_void_p
OPENGL, VIDEO, DOWN, UP = 2, 0x20, 0x300, 0x301
if sdl.SDL_Init(VIDEO):
    sys.exit("no SDL display")
window = ctypes.c_void_p(sdl.SDL_CreateWindow(b"keys", 0, 0, 64, 48, OPENGL))
context = ctypes.c_void_p(sdl.SDL_GL_CreateContext(window))
event, held = ctypes.create_string_buffer(128), ctypes.cast(sdl.SDL_GetKeyboardState(None),
                                                            ctypes.POINTER(ctypes.c_uint8))
for frame in range(int(sys.argv[1])):
    while sdl.SDL_PollEvent(event):
        kind, scancode = int.from_bytes(event[0:4], "little"), int.from_bytes(event[16:20], "little")
        if kind in (DOWN, UP):
            name = ctypes.string_at(sdl.SDL_GetKeyName(int.from_bytes(event[20:24], "little"))).decode().lower()
            print(frame, "press" if kind == DOWN else "release", name, held[scancode], flush=True)
    gl.glClear(0x4000)
    sdl.SDL_GL_SwapWindow(window)
