#include "verbs/render/picture.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "look/apply/tell.h"
#include "look/camera/camera.h"
#include "look/camera/lens.h"
#include "verbs/render/cryptomatte.h"
#include "verbs/render/preview.h"
#include "verbs/render/programs.h"
#include "verbs/render/seen.h"
#include "verbs/render/vectors.h"

/* Note facts about a frame for gate N (diff/score/harm.c). changed: the scene with the rules applied */
static int tell_harm(const struct spare *found, const struct scene *scene, const struct scene *changed,
                     struct image *img)
{
	char *lights = spare_tell_lights(found), *cards = spare_tell_cards(found, scene),
	     *left_out = spare_tell_left_out(changed);
	int err = lights && cards && left_out ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err && *lights)
		err = image_set_attribute(img, "relume:lights", "%s", lights);
	if (!err && *cards)
		err = image_set_attribute(img, "relume:cards", "%s", cards);
	if (!err && *left_out)
		err = image_set_attribute(img, "relume:left-out", "%s", left_out);
	if (!err && scene->untraced_draw)
		err = image_set_attribute(img, "relume:targets", "%u", scene->untraced_draw);
	free(lights);
	free(cards);
	free(left_out);
	return err;
}

/* Facts for the report's page of roles and lights (diff/report/roles.h), an attribute each. */
struct telling {
	struct image *img;
	unsigned n;
};

static int tell_role(void *user, const char *text)
{
	struct telling *t = user;
	char name[32];

	snprintf(name, sizeof(name), "relume:rule.%u", t->n++);
	return image_set_attribute(t->img, name, "%s", text);
}

static void tell_unscaled(const char *trace, const struct scaled *scaled)
{
	static atomic_uint told;
	const unsigned kept = (scaled->stipples ? 1u : 0) | (scaled->programs ? 2u : 0) | (scaled->starts ? 4u : 0) |
	                      (scaled->narrow ? 8u : 0),
		       before = atomic_fetch_or(&told, kept), now = kept & ~before;

	if (now & 1)
		err_warn(trace, "stipples of polygons keep their pixels, from frame %llu on",
		         (unsigned long long)scaled->scene.frame);
	if (now & 2)
		err_warn(trace, "programs of frame %llu look at pixels of the window, or set sizes of points; "
		         "they know the recorded one", (unsigned long long)scaled->scene.frame);
	if (now & 8)
		err_warn(trace, "--size: programs place what frame %llu shows; it is seen no farther than recorded",
		         (unsigned long long)scaled->scene.frame);
	if (now & 4)
		err_warn(trace, "frame %llu begins with what earlier frames drew; its pixels are enlarged",
		         (unsigned long long)scaled->scene.frame);
}

/* Another camera and size, and draws that could not be seen from there. */
static int tell_seen(const struct settings *settings, const struct seen *seen, struct image *img)
{
	int err = 0;

	if (settings->camera)
		err = image_set_attribute(img, "relume:camera", "%s", seen->elsewhere.told);
	if (!err && settings->camera && settings->camera->keys->kind)
		err = image_set_attribute(img, "relume:projection", "%s", settings->camera->keys->kind);
	if (!err && settings->camera && lens_eyes(settings->camera))
		err = image_set_attribute(img, "relume:eyes", "%s", lens_eyes(settings->camera));
	if (!err && settings->camera && seen->elsewhere.without)
		err_warn(settings->camera->path,
		         "frame %llu: %u draws are left out: programs place their vertices, and nothing says where "
		         "that is from elsewhere",
		         (unsigned long long)seen->recorded->frame, seen->elsewhere.without);
	if (!err && settings_resize(settings))
		err = image_set_attribute(img, "relume:recorded-size", "%ux%u", seen->recorded->width, seen->recorded->height);
	return err;
}

/* When the program showed the frame, or would have shown the picture, as relume film wants to know. */
static int tell_time(const struct settings *settings, const struct shot *shot, const struct scene *scene,
                     struct image *img)
{
	const uint64_t time = settings->fps > 0 ? moments_time(&settings->moments, shot->number) : scene->time_ns;

	return time && !camera_pictures(settings->camera) ?
	               image_set_attribute(img, "relume:time", "%llu", (unsigned long long)time) :
	               0;
}

/* With --fps: the frame before a picture, how far behind it the picture is, and how their scenes were interpolated. */
static int tell_moment(const struct settings *settings, const struct shot *shot, const struct between *between,
                       struct image *img)
{
	uint64_t frame;
	double at;
	int err = 0;

	if (settings->moments.shutter > 0)
		err = image_set_attribute(img, "relume:shutter", "%g", settings->moments.shutter);
	if (err || !(settings->fps > 0))
		return err;
	moments_at(&settings->moments, shot->number, 0, &frame, &at);
	err = image_set_attribute(img, "relume:moment", "%llu + %.6f", (unsigned long long)frame, at);
	if (!err && shot_is_at_cut(shot, &settings->moments))
		err = image_set_attribute(img, "relume:between", "cut");
	else if (!err && at > 0)
		err = image_set_attribute(img, "relume:between", "%u draws followed, %u not", between->n_matched,
		                          between->n_alone);
	return err;
}

/* Motion since the picture before. */
static int add_vectors(const struct settings *settings, const struct shot *shot, const struct scene *scene,
                       struct image *img)
{
	struct between room = { .n_owned = 0 };
	struct vectors_frame *before = NULL;
	const struct scene *was = NULL;
	int err = 0;

	if (shot->number > 0 && !shot_is_behind_cut(shot, &settings->moments))
		err = shot_scene(shot, &settings->moments, -1, &room, &was);
	if (!err && was) {
		before = vectors_note(was);
		err = before ? 0 : ERR_SYSTEM;
	}
	if (!err)
		err = vectors_add(scene, before, img);
	vectors_free(&before);
	between_release(&room);
	return err;
}

/* A picture while the shutter is open. */
struct exposure {
	const struct settings *settings;
	const struct shot *shot;
	struct seen seen; /* for the last sample */
};

static int expose(void *user, double away, const struct scene **scene)
{
	struct exposure *e = user;
	const struct moments *m = &e->settings->moments;
	int err;

	seen_release(&e->seen);
	err = shot_scene(e->shot, m, away * m->shutter, &e->seen.between, &e->seen.recorded);
	if (!err)
		err = seen_make(e->settings, e->shot->number, &e->seen);
	*scene = e->seen.scene;
	return err;
}

/* The report's attributes of a frame under rules. */
static int tell_rules(const struct settings *settings, const struct seen *seen, struct image *img)
{
	int err = tell_harm(&seen->found, seen->recorded, &seen->changed, img);

	return !err && settings->look ?
	               look_tell(settings->look, seen->recorded, tell_role, &(struct telling){ img, 0 }) :
	               err;
}

int picture_render(const struct settings *settings, struct tracer *tracer, const struct shot *shot,
                   const struct picture_listener *listener, struct image *img)
{
	struct preview preview = { settings, shot->number };
	struct exposure exposure = { settings, shot, { .scene = NULL } };
	struct tracer_options options = settings->tracer;
	struct seen seen = { .scene = NULL };
	int err;

	options.preview = settings->preview ? preview_show : NULL;
	options.preview_user = &preview;
	options.sampled = listener->sampled;
	options.sampled_user = listener->user;
	options.expose = settings->moments.shutter > 0 ? expose : NULL;
	options.expose_user = &exposure;
	err = shot_scene(shot, &settings->moments, 0, &seen.between, &seen.recorded);
	if (!err)
		err = seen_make(settings, shot->number, &seen);
	if (!err && settings_resize(settings))
		tell_unscaled(settings->trace, &seen.scaled);
	if (!err)
		err = tracer_render(tracer, seen.scene, &options, img);
	if (!err)
		err = tell_seen(settings, &seen, img);
	if (!err)
		err = settings_denoise(settings, img);
	if (!err && settings->tracer.mode != TRACER_GL)
		err = tell_rules(settings, &seen, img);
	if (!err)
		err = tell_time(settings, shot, seen.recorded, img);
	if (!err)
		err = tell_moment(settings, shot, &seen.between, img);
	if (!err)
		err = programs_tell(seen.recorded, img);
	if (!err && settings->motion)
		err = add_vectors(settings, shot, seen.recorded, img);
	if (!err && settings->cryptomatte)
		err = cryptomatte_add(seen.recorded, img);
	seen_release(&exposure.seen);
	seen_release(&seen);
	return err;
}
