/*
 * Runs inside the traced program. Overrides dlsym as well, so that a program that looks up GL finds the recorder's
 * entry points. Lookups with RTLD_NEXT are passed on unchanged: they come from libraries that wrap GL themselves and
 * ask for the definition after their own. The recorder is loaded before them, so it is never that definition.
 */
#include <dlfcn.h>
#include <string.h>

#include "capture/gl/resolve.h"
#include "thunks.h"

/* Not strncmp: sanitizers intercept it, and they call dlsym before they are ready. */
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

enum owner { OWNER_OTHER, OWNER_GL, OWNER_RECORDER };

/* The library that contains an address. */
static enum owner owner_of(const void *address)
{
	static const char *const names[] = { "libGL.so", "libGLX", "libOpenGL.so", "libEGL", "libGLES", "libOSMesa",
		                             "libGLdispatch" };
	Dl_info info, own;
	const char *base;

	if (!dladdr(address, &info) || !info.dli_fname)
		return OWNER_OTHER;
	if (dladdr((const void *)owner_of, &own) && own.dli_fbase == info.dli_fbase)
		return OWNER_RECORDER;
	base = strrchr(info.dli_fname, '/');
	base = base ? base + 1 : info.dli_fname;
	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (strncmp(base, names[i], strlen(names[i])) == 0)
			return OWNER_GL;
	return OWNER_OTHER;
}

/*
 * dlsym's result for a name that begins like GL's, on any handle but RTLD_NEXT. Any library may have such names, so
 * only functions of GL libraries are replaced.
 */
static void *look_up_gl(void *handle, const char *name)
{
	void *found = resolve_real_dlsym(handle, name);
	unsigned command;

	if (!found)
		return NULL;
	switch (owner_of(found)) {
	case OWNER_GL:
		return resolve_substitute(entry_points, name, found);
	case OWNER_RECORDER: /* a thunk of ours: only for commands that the real GL has; other functions always */
		command = resolve_number(name);
		return command == N_COMMANDS || resolve_exists(command) ? found : NULL;
	default:
		return found;
	}
}

/*
 * The last call of the real dlsym must be a tail call, so that dlsym sees our caller instead of us: with RTLD_NEXT the
 * result depends on the caller. GCC makes tail calls from -O2 on, so this function requests that level.
 */
#ifndef __clang__ /* makes tail calls at every level but -O0 */
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
