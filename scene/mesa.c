/* Maps a GL's version string to its differences from Mesa 22.3. */
#include "scene/mesa.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

uint32_t scene_mesa_of(const char *gl)
{
	static const struct {
		unsigned since, until; /* 100 * major + minor */
		enum scene_mesa difference;
	} table[] = {
		{ 2302, UINT_MAX, SCENE_MESA_LINE_ENDS },
		{ 2500, UINT_MAX, SCENE_MESA_ROUNDS_TO_EVEN },
		{ 2500, UINT_MAX, SCENE_MESA_SPRITES },
		{ 2500, UINT_MAX, SCENE_MESA_SMOOTH_LINES },
		{ 2500, 2600, SCENE_MESA_BITMAP_SUMS },
		{ 2500, UINT_MAX, SCENE_MESA_FLAT_PROGRAMS },
		{ 2500, UINT_MAX, SCENE_MESA_BACK_COLORS },
		{ 2500, UINT_MAX, SCENE_MESA_LATE_BITMAPS },
		{ 2500, UINT_MAX, SCENE_MESA_PRODUCTS_ONCE },
		{ 2500, UINT_MAX, SCENE_MESA_ROUNDS_SMALL_FLOATS },
		{ 2500, UINT_MAX, SCENE_MESA_LINEAR_MEANS },
		{ 2500, UINT_MAX, SCENE_MESA_LACKS_YCBCR },
		{ 2500, UINT_MAX, SCENE_MESA_TRACKS_COLORS },
		{ 2500, UINT_MAX, SCENE_MESA_KEEPS_BITMAPS },
	};
	const char *mesa = strstr(gl, "Mesa ");
	unsigned major, minor;
	uint32_t differences = 0;

	if (!mesa)
		return *gl ? SCENE_MESA_IS_OTHER : 0;
	if (!strstr(gl, "llvmpipe") || sscanf(mesa, "Mesa %u.%u", &major, &minor) != 2)
		return 0;
	if (major > 9999 || minor > 99)
		return 0;
	for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++)
		if (100 * major + minor >= table[i].since && 100 * major + minor < table[i].until)
			differences |= table[i].difference;
	return differences;
}
