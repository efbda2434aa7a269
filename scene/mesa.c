#include "scene/mesa.h"

#include <stdio.h>
#include <string.h>

uint32_t scene_mesa_of(const char *gl)
{
	static const struct {
		unsigned major, minor;
		enum scene_mesa difference;
	} since[] = {
		{ 23, 2, SCENE_MESA_LINE_ENDS },
		{ 25, 0, SCENE_MESA_ROUNDS_TO_EVEN },
		{ 25, 0, SCENE_MESA_SPRITES },
		{ 25, 0, SCENE_MESA_SMOOTH_LINES },
		{ 25, 0, SCENE_MESA_BITMAPS },
		{ 25, 0, SCENE_MESA_FLAT_PROGRAMS },
		{ 25, 0, SCENE_MESA_BACK_COLORS },
	};
	const char *mesa = strstr(gl, "Mesa ");
	unsigned major, minor;
	uint32_t differences = 0;

	if (!mesa || !strstr(gl, "llvmpipe") || sscanf(mesa, "Mesa %u.%u", &major, &minor) != 2)
		return 0;
	for (size_t i = 0; i < sizeof(since) / sizeof(since[0]); i++)
		if (major > since[i].major || (major == since[i].major && minor >= since[i].minor))
			differences |= since[i].difference;
	return differences;
}
