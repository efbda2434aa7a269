/*
 * Runs inside the traced program. Overrides dlsym as well, so that a program that looks up GL finds the recorder's
 * entry points. Lookups of the next definition (RTLD_NEXT) are unchanged: libraries that wrap GL themselves make them,
 * and we are loaded before all of these.
 */
#include <dlfcn.h>
#include <string.h>

#include "capture/gl/resolve.h"
#include "thunks.h"

/* Written out, because a sanitizer replaces functions of the C library. */
__attribute__((RESOLVE_BEFORE_ALL)) static int begins_with(const char *name, const char *prefix)
{
	while (*prefix && *name == *prefix) {
		name++;
		prefix++;
	}
	return !*prefix;
}

__attribute__((RESOLVE_BEFORE_ALL)) static int is_gl_name(const char *name)
{
	return begins_with(name, "gl") || begins_with(name, "egl") || begins_with(name, "OSMesa");
}

/* 1 if an address is in a GL library, 2 if it is in ours. */
static int whose(const void *address)
{
	static const char *const names[] = { "libGL.so", "libGLX", "libOpenGL.so", "libEGL", "libGLES", "libOSMesa",
		                             "libGLdispatch" };
	Dl_info info, own;
	const char *base;

	if (!dladdr(address, &info) || !info.dli_fname)
		return 0;
	if (dladdr((const void *)whose, &own) && own.dli_fbase == info.dli_fbase)
		return 2;
	base = strrchr(info.dli_fname, '/');
	base = base ? base + 1 : info.dli_fname;
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (strncmp(base, names[i], strlen(names[i])) == 0)
			return 1;
	return 0;
}

/* dlsym's result for a GL name on any handle but RTLD_NEXT. */
static void *look_up_gl(void *handle, const char *name)
{
	void *found = resolve_real_dlsym(handle, name);
	unsigned command;

	if (!found)
		return NULL;
	switch (whose(found)) {
	case 1:
		return resolve_substitute(entry_points, name, found);
	case 2: /* one of ours: returned only if the real GL has the function as well */
		command = resolve_number(name);
		return command == N_COMMANDS || resolve_exists(command) ? found : NULL;
	default:
		return found;
	}
}

/*
 * The real dlsym is called by a jump, so that it sees our caller instead of us: with RTLD_NEXT the result depends on
 * the caller. The optimizer makes such jumps from -O2 on, which is requested here whatever the other flags are.
 */
#ifndef __clang__ /* which makes such jumps without being asked, except at -O0 */
__attribute__((optimize("O2")))
#endif
__attribute__((visibility("default"), RESOLVE_BEFORE_ALL)) void *dlsym(void *restrict handle, const char *restrict name)
{
	if (!resolve_real_dlsym)
		resolve_dlsym();
	if (handle != RTLD_NEXT && is_gl_name(name))
		return look_up_gl(handle, name);
	return resolve_real_dlsym(handle, name);
}
