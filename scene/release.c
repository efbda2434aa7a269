/* Releases a scene through its maker's callback. */
#include "scene/release.h"

#include <stddef.h>

#include "scene/scene.h"

void scene_release(struct scene **scene)
{
	struct scene *s = *scene;

	*scene = NULL;
	if (s && s->release)
		s->release(s);
}
