#include "render/picture.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "look/apply/apply.h"
#include "look/apply/tell.h"
#include "look/camera/camera.h"
#include "look/camera/elsewhere.h"
#include "look/camera/scaled.h"
#include "look/unseen.h"
#include "render/preview.h"

/* What gate N (diff/score/harm.c) wants to know of a frame. changed: the scene under the rules */
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

/* What the report's page of roles and lights shows (diff/report/roles.h): an attribute each. */
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

/* A scene traced as its camera sees it, the recorded one or another. */
static int trace_from(const struct settings *settings, struct tracer *tracer, const struct scene *scene,
                      uint64_t number, const struct tracer_options *options, struct image *img)
{
	struct elsewhere elsewhere;
	int err;

	if (!settings->camera)
		return tracer_render(tracer, scene, options, img);
	err = elsewhere_make(settings->camera, settings->look, scene, (uint32_t)number, &elsewhere);
	if (err)
		return err;
	err = tracer_render(tracer, &elsewhere.scene, options, img);
	if (!err)
		err = image_set_attribute(img, "relume:camera", "%s", elsewhere.told);
	if (!err && elsewhere.without)
		err_warn(settings->camera->path,
		         "frame %llu: %u draws are left out: programs place their vertices, and nothing says where "
		         "that is from elsewhere",
		         (unsigned long long)scene->frame, elsewhere.without);
	elsewhere_release(&elsewhere);
	return err;
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

/* The same, in a window of the size that is asked for. */
static int trace_seen(const struct settings *settings, struct tracer *tracer, const struct scene *scene,
                      uint64_t number, const struct tracer_options *options, struct image *img)
{
	struct scaled scaled;
	int err;

	if (!settings_resize(settings))
		return trace_from(settings, tracer, scene, number, options, img);
	err = scaled_make(scene, settings->scale, settings->size, &scaled);
	if (err)
		return err;
	tell_unscaled(settings->trace, &scaled);
	err = trace_from(settings, tracer, &scaled.scene, number, options, img);
	if (!err)
		err = image_set_attribute(img, "relume:recorded-size", "%ux%u", scene->width, scene->height);
	scaled_release(&scaled);
	return err;
}

int picture_render(const struct settings *settings, struct tracer *tracer, const struct scene *scene, uint64_t number,
                   const struct picture_listener *listener, struct image *img)
{
	struct preview preview = { settings, number };
	struct tracer_options options = settings->tracer;
	struct scene whole = { .instances = NULL }, changed = { .instances = NULL };
	struct spare found = { .bits = NULL };
	int err;

	options.preview = settings->preview ? preview_show : NULL;
	options.preview_user = &preview;
	options.sampled = listener->sampled;
	options.sampled_user = listener->user;
	if (options.mode == TRACER_GL)
		return trace_seen(settings, tracer, scene, number, &options, img);
	err = unseen_add(settings->look, scene, &whole);
	if (!err)
		err = look_apply(settings->look, whole.instances ? &whole : scene, &changed, &found);
	if (!err)
		err = trace_seen(settings, tracer, &changed, number, &options, img);
	if (!err)
		err = settings_denoise(settings, img);
	if (!err)
		err = tell_harm(&found, scene, &changed, img);
	if (!err && settings->look)
		err = look_tell(settings->look, scene, tell_role, &(struct telling){ img, 0 });
	if (changed.instances)
		look_release(&changed);
	spare_free(&found);
	unseen_release(&whole);
	return err;
}
