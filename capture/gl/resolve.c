/* Runs inside the traced program. */
#include "capture/gl/resolve.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "capture/write/report.h"
#include "capture/write/tables.h"
#include "capture/write/writer.h"

void *resolve_found[N_COMMANDS];
void *(*resolve_real_dlsym)(void *handle, const char *name);

static int osmesa_first;

static long absent(void)
{
	return 0;
}

/* The libraries to search for a family's commands, in this order. */
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

__attribute__((RESOLVE_BEFORE_ALL)) void resolve_dlsym(void)
{
	static const char *const versions[] = { "GLIBC_2.34", "GLIBC_2.2.5", "GLIBC_2.17", "GLIBC_2.27" };

	for (size_t i = 0; !resolve_real_dlsym && i < sizeof(versions) / sizeof(versions[0]); i++)
		resolve_real_dlsym = (void *(*)(void *, const char *))dlvsym(RTLD_NEXT, "dlsym", versions[i]);
	if (!resolve_real_dlsym)
		abort(); /* an unknown libc: nothing in this process would work */
}

void *resolve_in(void *library, const char *name)
{
	if (!resolve_real_dlsym)
		resolve_dlsym();
	return resolve_real_dlsym(library, name);
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
	found = resolve_real_dlsym(handle, name);
	if (!found && library->get_proc_address) {
		get = (void *(*)(const char *))resolve_real_dlsym(handle, library->get_proc_address);
		found = get ? get(name) : NULL;
	}
	return found; /* the handle stays: the library must not go away under us */
}

static void *find(const char *name)
{
	void *found = NULL;

	if (!resolve_real_dlsym)
		resolve_dlsym();
	for (size_t i = 0; !found && osmesa_first && i < N_LIBRARIES; i++)
		if (strncmp(libraries[i].name, "libOSMesa", 9) == 0)
			found = find_in(&libraries[i], name, RTLD_NOLOAD);
	if (!found)
		found = resolve_real_dlsym(RTLD_NEXT, name);
	/* Libraries that the program has loaded come before those that we load for it. */
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

	writer_nest(); /* calls that a library makes while it loads are not the program's */
	found = find(commands[command].name);
	writer_unnest();
	if (!found)
		report_say("the GL here has no %s; the program calls it all the same", commands[command].name);
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

unsigned resolve_number(const char *name)
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

void *resolve_substitute(void *const entry_points[], const char *name, void *real)
{
	unsigned command = name && real ? resolve_number(name) : N_COMMANDS;

	if (command == N_COMMANDS || real == entry_points[command])
		return real;
	if (!resolve_found[command])
		resolve_found[command] = real;
	return entry_points[command];
}
