#include "verbs/render/supply.h"

int supply_picture(void *user, const struct scene *scene, struct scene_picture *picture)
{
	struct supply *supply = user;
	int err = 0;

	if (!supply->dev)
		err = device_share(supply->parent, &supply->dev);
	if (!err && !supply->tracer)
		err = tracer_create(&supply->tracer, supply->dev);
	if (!err && supply->number)
		device_set_frame(supply->dev, *supply->number);
	if (!err)
		tracer_share(supply->tracer, supply->cache);
	return err ? err : tracer_render_picture(supply->tracer, scene, picture);
}

void supply_free(struct supply *supply)
{
	tracer_destroy(&supply->tracer);
	if (supply->dev)
		device_close(&supply->dev);
}
