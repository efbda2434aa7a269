/*
 * Everything loaded by hand: OSMesa by dlopen and dlsym, its gl* by OSMesaGetProcAddress, and a name that does not
 * exist in any GL.
 */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

enum { RGBA = 0x1908, UNSIGNED_BYTE = 0x1401, COLOR_BUFFER_BIT = 0x4000, SIDE = 8 };

static void *look_up(void *handle, const char *name)
{
	void *found = dlsym(handle, name);

	if (!found) {
		fprintf(stderr, "no %s\n", name);
		exit(1);
	}
	return found;
}

int main(void)
{
	void *library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
	void *(*create)(unsigned, void *);
	unsigned char (*make_current)(void *, void *, unsigned, int, int);
	void *(*get)(const char *);
	void (*clear_color)(float, float, float, float);
	void (*clear)(unsigned);
	void (*finish)(void);
	static unsigned char pixels[SIDE * SIDE * 4];
	void *context;

	if (!library)
		return 77;
	create = (void *(*)(unsigned, void *))look_up(library, "OSMesaCreateContext");
	make_current = (unsigned char (*)(void *, void *, unsigned, int, int))look_up(library, "OSMesaMakeCurrent");
	get = (void *(*)(const char *))look_up(library, "OSMesaGetProcAddress");
	context = create(RGBA, NULL);
	if (!context || !make_current(context, pixels, UNSIGNED_BYTE, SIDE, SIDE))
		return 1;
	clear_color = (void (*)(float, float, float, float))get("glClearColor");
	clear = (void (*)(unsigned))get("glClear");
	finish = (void (*)(void))get("glFinish");
	clear_color(0, 1, 0, 1);
	clear(COLOR_BUFFER_BIT);
	finish();
	if (dlsym(library, "glNoSuchThing") || dlsym(RTLD_DEFAULT, "OSMesaNoSuchThing"))
		return 1;
	return pixels[0] == 0 && pixels[1] == 255 ? 0 : 1;
}
