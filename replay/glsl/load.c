/* glslang, loaded when the first program of GLSL is linked: no other recording waits for it. The bridge itself is bridge.cpp, in relume-glsl.so. */
#include <dlfcn.h>
#include <limits.h>
#include <pthread.h>

#include "base/beside.h"
#include "base/err.h"
#include "replay/glsl/tree.h"

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
	pthread_once(&bridge.once, load);
	return bridge.parse ? bridge.parse(texts, n, stage, tree, why) : ERR_SYSTEM;
}
