/*
 * Scenes of nonsensical calls exported as glTF, JSON and text. The first four bytes select numbers of the scene to
 * spoil first, because a damaged recording may leave any value in any float. The rest is calls (calls.h).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "replay/replay.h"
#include "scene/gltf.h"
#include "scene/json.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/target.h"

static unsigned seed;
static FILE *nowhere;

static void spoil(float *numbers, size_t n)
{
	static const float bad[] = { NAN, INFINITY, -INFINITY, 0, -0.0f, 3e38f, -3e38f, 1e-45f, 1, -1 };

	for (unsigned k = calls_draw(&seed, 4); n && k > 0; k--)
		numbers[calls_draw(&seed, (unsigned)n)] = bad[calls_draw(&seed, sizeof(bad) / sizeof(bad[0]))];
}

static void paint(void *user, const struct scene *given)
{
	struct scene *scene = (struct scene *)(uintptr_t)given;
	struct gltf_losses losses;

	(void)user;
	for (uint32_t i = 0; i < scene->n_instances && seed; i++)
		spoil(scene->instances[i].modelview, 16);
	for (uint32_t i = 0; i < scene->n_views && seed; i++)
		spoil(scene->views[i].projection, 16);
	for (uint32_t i = 0; i < scene->n_currents && seed; i++)
		spoil(scene->currents[i].color, 4);
	for (uint32_t i = 0; i < scene->n_units && seed; i++)
		spoil(scene->units[i].matrix, 16);
	gltf_write(nowhere, "fuzz", scene, &losses);
	scene_write_json(nowhere, scene, 1);
	scene_write_text(nowhere, scene);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	struct calls_painter painter = calls_grey;

	nowhere = nowhere ? nowhere : fopen("/dev/null", "w");
	if (!target_take(&data, &size, &seed, sizeof(seed)))
		return 0;
	painter.paint = paint;
	calls_run(data, size, &painter);
	return 0;
}
