/* Rules about materials and lights, applied to a frame. */
#include <stdlib.h>

#include "look/apply/apply.h"
#include "look/apply/tell.h"
#include "look/rules/rules.h"
#include "replay/replay.h"
#include "scene/release.h"
#include "tests/fuzz/target.h"

#define TRACE "tests/golden/cornell.trace"

static struct replay *rp;
static struct scene *scene;

static int tell(void *user, const char *text)
{
	(void)user;
	(void)text;
	return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct look *look = NULL;
	struct scene changed;

	if (!scene && (replay_open(&rp, TRACE) || replay_next_frame(rp, 1, &scene) != 1))
		abort();
	if (!rules_parse("fuzz", (const char *)data, size, &look)) {
		if (!look_apply(look, scene, &changed, NULL))
			look_release(&changed);
		look_tell(look, scene, tell, NULL);
		look_spares(look);
	}
	rules_free(&look);
	return 0;
}
