#include "verbs/render/single.h"

#include "base/folder.h"
#include "scene/release.h"
#include "tracer/device/outcome.h"

int single_open(const char *trace, const char *device, struct single *single)
{
	char folder[4096];
	int err = replay_open(&single->replay, trace);

	if (!err)
		err = device_open(device, 0, &single->dev);
	if (!err)
		err = outcome_choose_known(single->dev);
	if (!err && folder_cached("kernels", folder, sizeof(folder)))
		device_keep_programs(single->dev, folder, 0);
	if (!err)
		err = tracer_create(&single->tracer, single->dev);
	if (!err) {
		single->supply.parent = single->dev;
		replay_set_supplier(single->replay, supply_picture, &single->supply);
	}
	return err;
}

int single_render(struct single *single, const char *aov)
{
	const struct tracer_options options = { .mode = TRACER_GL, .samples = 1, .aov = aov };

	return tracer_render(single->tracer, single->scene, &options, &single->image);
}

uint32_t single_draw_at(const struct single *single, size_t pixel)
{
	const float *ids = image_channel(&single->image, "id");

	return ids && ids[pixel] >= 1 && ids[pixel] <= (float)single->scene->n_draws ? (uint32_t)ids[pixel] : 0;
}

void single_free(struct single *single)
{
	image_free(&single->image);
	scene_release(&single->scene);
	supply_free(&single->supply);
	tracer_destroy(&single->tracer);
	if (single->dev)
		device_close(&single->dev);
	replay_close(&single->replay);
}
