/*
 * Runs inside the traced program. Finding the real GL, and being found instead of it.
 *
 * A program reaches GL by its linker (our names come first, we are preloaded), by dlsym on a handle, or by a GetProcAddress.
 * dlsym is ours too. Lookups that say "after me" (RTLD_NEXT) keep their meaning: they are asked by libraries that wrap GL
 * themselves, and we stand before all of them.
 */
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "capture/gl/wrap.h"

void *resolve_found[N_COMMANDS];

static void *(*real_dlsym)(void *handle, const char *name);
static int osmesa_first;

static long absent(void)
{
	return 0;
}

/* Libraries by the names that Debian and its kin give them; a family's commands are looked for in this order. */
static const struct library {
	const char *prefix, *name, *get_proc_address;
} libraries[] = {
	{ "glX", "libGL.so.1", "glXGetProcAddressARB" },
	{ "glX", "libGLX.so.0", "glXGetProcAddressARB" },
	{ "egl", "libEGL.so.1", "eglGetProcAddress" },
	{ "OSMesa", "libOSMesa.so.8", "OSMesaGetProcAddress" },
	{ "OSMesa", "libOSMesa.so.6", "OSMesaGetProcAddress" },
	{ "gl", "libGL.so.1", "glXGetProcAddressARB" },
	{ "gl", "libOpenGL.so.0", NULL },
	{ "gl", "libGLX.so.0", "glXGetProcAddressARB" },
	{ "gl", "libEGL.so.1", "eglGetProcAddress" },
	{ "gl", "libOSMesa.so.8", "OSMesaGetProcAddress" },
	{ "gl", "libOSMesa.so.6", "OSMesaGetProcAddress" },
	{ "gl", "libGLESv2.so.2", NULL },
	{ "gl", "libGLESv1_CM.so.1", NULL },
};
enum { N_LIBRARIES = sizeof(libraries) / sizeof(libraries[0]) };

/* A sanitizer looks up what it replaces by dlsym before it is ready itself: nothing of it may be needed here. */
#define BEFORE_ALL no_sanitize("thread", "address")

__attribute__((BEFORE_ALL)) static void find_dlsym(void)
{
	static const char *const versions[] = { "GLIBC_2.34", "GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.27" };

	for (size_t i = 0; !real_dlsym && i < sizeof(versions) / sizeof(versions[0]); i++)
		real_dlsym = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", versions[i]);
	if (!real_dlsym)
		abort(); /* no libc that we know: nothing in this process would work */
}

static int family(const struct library *library, const char *name)
{
	size_t n = strlen(library->prefix);

	/* "gl" is also how glX begins. */
	return strncmp(name, library->prefix, n) == 0 && (n > 2 || strncmp(name, "glX", 3) != 0);
}

static void *find_in(const struct library *library, const char *name, int flags)
{
	void *handle = dlopen(library->name, RTLD_LAZY | RTLD_LOCAL | flags);
	void *(*get)(const char *);
	void *found;

	if (!handle)
		return NULL;
	found = real_dlsym(handle, name);
	if (!found && library->get_proc_address) {
		get = (void *(*)(const char *))real_dlsym(handle, library->get_proc_address);
		found = get ? get(name) : NULL;
	}
	return found; /* the handle stays: the library must not go away under us */
}

static void *find(const char *name)
{
	void *found = NULL;

	if (!real_dlsym)
		find_dlsym();
	for (size_t i = 0; !found && osmesa_first && i < N_LIBRARIES; i++)
		if (strncmp(libraries[i].name, "libOSMesa", 9) == 0)
			found = find_in(&libraries[i], name, RTLD_NOLOAD);
	if (!found)
		found = real_dlsym(RTLD_NEXT, name);
	/* What the program has loaded itself goes before what we load for it. */
	for (size_t i = 0; !found && i < N_LIBRARIES; i++)
		if (family(&libraries[i], name))
			found = find_in(&libraries[i], name, RTLD_NOLOAD);
	for (size_t i = 0; !found && i < N_LIBRARIES; i++)
		if (family(&libraries[i], name))
			found = find_in(&libraries[i], name, 0);
	return found;
}

void *resolve_command(unsigned command)
{
	int saved = errno;
	void *found;

	writer_nest(); /* what a library does while it is loaded is not the program's */
	found = find(commands[command].name);
	writer_unnest();
	if (!found)
		writer_say("the GL here has no %s; the program calls it all the same", commands[command].name);
	if (!found)
		found = (void *)absent;
	__atomic_store_n(&resolve_found[command], found, __ATOMIC_RELAXED);
	errno = saved;
	return found;
}

int resolve_exists(unsigned command)
{
	int saved = errno;

	if (!resolve_found[command]) {
		writer_nest();
		resolve_found[command] = find(commands[command].name);
		writer_unnest();
	}
	errno = saved;
	return resolve_found[command] && resolve_found[command] != (void *)absent;
}

void resolve_prefer_osmesa(void)
{
	if (osmesa_first)
		return;
	osmesa_first = 1;
	memset(resolve_found, 0, sizeof(resolve_found));
}

/* The number of a command, or N_COMMANDS. */
static unsigned command_named(const char *name)
{
	unsigned low = 0, high = N_COMMANDS;

	while (low < high) {
		unsigned mid = low + (high - low) / 2;
		int order = strcmp(commands[mid].name, name);

		if (order == 0)
			return mid;
		if (order < 0)
			low = mid + 1;
		else
			high = mid;
	}
	return N_COMMANDS;
}

/* By hand: the C library's functions are among what a sanitizer replaces. */
__attribute__((BEFORE_ALL)) static int begins_with(const char *name, const char *prefix)
{
	while (*prefix && *name == *prefix) {
		name++;
		prefix++;
	}
	return !*prefix;
}

__attribute__((BEFORE_ALL)) static int is_gl_name(const char *name)
{
	return begins_with(name, "gl") || begins_with(name, "egl") || begins_with(name, "OSMesa");
}

void *resolve_substitute(const char *name, void *real)
{
	unsigned command = name && real ? command_named(name) : N_COMMANDS;

	if (command == N_COMMANDS || real == commands[command].thunk)
		return real;
	if (!resolve_found[command])
		resolve_found[command] = real;
	return commands[command].thunk;
}

/* 1 where an address lies in a library of GL, 2 where it lies in ours. */
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

/* What dlsym gives for a name of GL on any handle but "after me". */
static void *look_up_gl(void *handle, const char *name)
{
	void *found = real_dlsym(handle, name);
	unsigned command;

	if (!found)
		return NULL;
	switch (whose(found)) {
	case 1:
		return resolve_substitute(name, found);
	case 2: /* found us: only where the GL here has it as well */
		command = command_named(name);
		return command == N_COMMANDS || resolve_exists(command) ? found : NULL;
	default:
		return found;
	}
}

/*
 * The real dlsym is left by a jump, so that it sees its caller and not us: with RTLD_NEXT the answer depends on it. The
 * optimizer does so at any level from -O2 on, which is asked for here whatever the rest is built with.
 */
__attribute__((visibility("default"), optimize("O2"), BEFORE_ALL)) void *dlsym(void *restrict handle, const char *restrict name)
{
	if (!real_dlsym)
		find_dlsym();
	if (handle != RTLD_NEXT && is_gl_name(name))
		return look_up_gl(handle, name);
	return real_dlsym(handle, name);
}
