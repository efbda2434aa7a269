#include "verbs/render/write.h"

#include "base/err.h"
#include "base/folder.h"

static int write_display(struct pipeline_state *state, const struct image *img, const char *path)
{
	uint64_t bright = 0;
	int err = display_write(state->p->display, img, path, &bright);

	pthread_mutex_lock(&state->lock);
	state->p->carried->pixels += (uint64_t)img->width * img->height;
	state->p->carried->bright += bright;
	pthread_mutex_unlock(&state->lock);
	return err;
}

static int write_picture(struct pipeline_state *state, struct picture *picture)
{
	char path[PIPELINE_PATH_BYTES];
	int err = stamp_image(&state->p->stamp, &picture->img);

	/* how relume film shows it */
	if (!err && !state->p->display && state->p->settings->display.white > 1)
		err = image_set_attribute(&picture->img, "relume:white", "%g", (double)state->p->settings->display.white);
	/* says which channels were left out on purpose */
	if (!err && state->p->settings->tracer.aov && !state->p->display)
		err = image_set_attribute(&picture->img, "relume:aov", "%s", state->p->settings->tracer.aov);

	if (!err)
		err = frame_pattern_expand(state->p->settings->output, picture->frame, path, sizeof(path));
	if (!err)
		err = folder_make_for(path);
	if (err)
		return err;
	return state->p->display ? write_display(state, &picture->img, path) : image_write_exr(&picture->img, path);
}

void *pipeline_write(void *arg)
{
	struct pipeline_state *state = arg;
	struct picture *picture;

	err_share(&state->writer_said);
	while ((picture = queue_take(&state->pictures))) {
		/* After a signal, write what is traced. After a failure it would only fail again. */
		int err = state->err ? state->err : write_picture(state, picture);

		if (!err)
			pipeline_note(state, picture->frame, "done", picture->seconds);
		else if (!state->err)
			pipeline_fail(state, err);
		pipeline_drop_picture(&picture);
		pipeline_land(state);
	}
	return NULL;
}
