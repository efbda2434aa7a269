#include "tracer/render/supply.h"

int feed_supply(void *user, const struct scene *scene, struct scene_picture *picture)
{
	struct feed *feed = user;
	int err = 0;

	if (!feed->dev)
		err = device_share(feed->parent, &feed->dev);
	if (!err && !feed->tracer)
		err = tracer_create(&feed->tracer, feed->dev);
	if (!err)
		tracer_share(feed->tracer, feed->grove);
	return err ? err : tracer_render_picture(feed->tracer, scene, picture);
}

void feed_free(struct feed *feed)
{
	tracer_destroy(&feed->tracer);
	if (feed->dev)
		device_close(&feed->dev);
}
