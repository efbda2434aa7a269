/* glslang, loaded when the first program of GLSL is linked: no other recording waits for it. The bridge itself is bridge.cpp, in relume-glsl.so. */
#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>

#include "base/beside.h"
#include "base/err.h"
#include "base/limits.h"
#include "replay/glsl/tree.h"

#define MOST_SECONDS 30 /* for a shader: large ones take some milliseconds, and macros may call for endless work */

static struct {
	pthread_once_t once;
	__typeof__(glsl_parse) *parse; /* NULL: the reason was reported */
} bridge = { .once = PTHREAD_ONCE_INIT };

static void load(void)
{
	char path[PATH_MAX];
	void *library;

	if (beside_find("relume-glsl.so", path, sizeof(path)))
		return;
	library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	if (!library) {
		err_report(ERR_SYSTEM, path, "cannot be loaded: %s", dlerror());
		return;
	}
	*(void **)&bridge.parse = dlsym(library, "glsl_parse");
	if (!bridge.parse)
		err_report(ERR_SYSTEM, path, "is of another version of Relume");
}

int glsl_parse(const char *const *texts, uint32_t n, enum glsl_stage stage, struct glsl_tree *tree, const char **why)
{
	int err;

	pthread_once(&bridge.once, load);
	limits_read("the text of a shader", MOST_SECONDS);
	err = bridge.parse ? bridge.parse(texts, n, stage, tree, why) : ERR_SYSTEM;
	limits_read(NULL, 0);
	return err;
}
