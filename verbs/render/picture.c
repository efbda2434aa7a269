#include "verbs/render/picture.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/plural.h"
#include "look/apply/tell.h"
#include "look/camera/camera.h"
#include "look/camera/lens.h"
#include "verbs/render/cryptomatte.h"
#include "verbs/render/preview.h"
#include "verbs/render/programs.h"
#include "verbs/render/seen.h"
#include "verbs/render/vectors.h"

/*
 * Attributes that gate N of `relume diff` reads (diff/score/harm.c).
 * @param scene    without the rules
 * @param changed  the same scene with the rules applied
 */
static int note_for_gate(const struct spare *found, const struct scene *scene, const struct scene *changed,
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

/* The picture that note_rule adds attributes to. */
struct rule_notes {
	struct image *img;
	unsigned n; /* attributes so far */
};

/* Store a line of look_tell as an attribute, for the report's page of roles and lights (diff/report/roles.h). */
static int note_rule(void *user, const char *text)
{
	struct rule_notes *notes = user;
	char name[32];

	snprintf(name, sizeof(name), "relume:rule.%u", notes->n++);
	return image_set_attribute(notes->img, name, "%s", text);
}

/* Warn about parts of a scene that could not be scaled; about each kind only once in a run. */
static void warn_unscaled(const char *trace, const struct scaled *scaled)
{
	enum { STIPPLES = 1, PROGRAMS = 2, STARTS = 4, NARROW = 8 };
	static atomic_uint warned;
	const unsigned found = (scaled->stipples ? STIPPLES : 0u) | (scaled->programs ? PROGRAMS : 0u) |
	                       (scaled->starts ? STARTS : 0u) | (scaled->narrow ? NARROW : 0u),
		       unreported = found & ~atomic_fetch_or(&warned, found);
	const unsigned long long frame = scaled->scene.frame;

	if (unreported & STIPPLES)
		err_warn(trace, "from frame %llu on: polygon stipples are not scaled", frame);
	if (unreported & PROGRAMS)
		err_warn(trace, "frame %llu: programs that read gl_FragCoord or write gl_PointSize still assume the recorded "
		         "size", frame);
	if (unreported & NARROW)
		err_warn(trace, "frame %llu: programs place the vertices, so --size shows nothing beyond the recorded window",
		         frame);
	if (unreported & STARTS)
		err_warn(trace, "frame %llu is drawn over an earlier frame's picture, whose pixels are enlarged", frame);
}

/* Note another camera or size in the picture, and warn about draws that the other camera cannot show. */
static int note_camera(const struct settings *settings, const struct seen *seen, struct image *img)
{
	int err = 0;

	if (settings->camera)
		err = image_set_attribute(img, "relume:camera", "%s", seen->elsewhere.placement);
	if (!err && settings->camera && settings->camera->keys->kind)
		err = image_set_attribute(img, "relume:projection", "%s", settings->camera->keys->kind);
	if (!err && settings->camera && lens_eyes(settings->camera))
		err = image_set_attribute(img, "relume:eyes", "%s", lens_eyes(settings->camera));
	if (!err && settings->camera && seen->elsewhere.without)
		err_warn(settings->camera->path,
		         "frame %llu: %u draw%s left out, as programs place the vertices and other cameras cannot tell where",
		         (unsigned long long)seen->recorded->frame, seen->elsewhere.without,
		         plural(seen->elsewhere.without));
	if (!err && settings_resize(settings))
		err = image_set_attribute(img, "relume:recorded-size", "%ux%u", seen->recorded->width, seen->recorded->height);
	return err;
}

/* Note when the program showed the frame; with --fps, when it would have shown the picture. `relume film` reads it. */
static int note_time(const struct settings *settings, const struct shot *shot, const struct scene *scene,
                     struct image *img)
{
	const uint64_t time = settings->fps > 0 ? moments_time(&settings->moments, shot->number) : scene->time_ns;

	return time && !camera_pictures(settings->camera) ?
	               image_set_attribute(img, "relume:time", "%llu", (unsigned long long)time) :
	               0;
}

/*
 * Note how long the shutter is open. With --fps, also the last frame before the picture's moment, how far after it the
 * moment is, as a share of the time to the next frame, and how the scene between them was made.
 */
static int note_moment(const struct settings *settings, const struct shot *shot, const struct between *between,
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

/* Add motion vectors from the previous picture. After a cut there are none. */
static int add_vectors(const struct settings *settings, const struct shot *shot, const struct scene *scene,
                       struct image *img)
{
	struct between between = { .n_owned = 0 };
	struct vectors_frame *before = NULL;
	const struct scene *previous = NULL;
	int err = 0;

	if (shot->number > 0 && !shot_is_behind_cut(shot, &settings->moments))
		err = shot_scene(shot, &settings->moments, -1, &between, &previous);
	if (!err && previous) {
		before = vectors_note(previous);
		err = before ? 0 : ERR_SYSTEM;
	}
	if (!err)
		err = vectors_add(scene, before, img);
	vectors_free(&before);
	between_release(&between);
	return err;
}

/* The picture of a shot whose samples show different moments. */
struct exposure {
	const struct settings *settings;
	const struct shot *shot;
	struct seen seen; /* the scene of the last sample */
};

/* tracer_options.expose: make the scene of a sample. */
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

/* Note the effect of rules, for gates and reports. */
static int note_rules(const struct settings *settings, const struct seen *seen, struct image *img)
{
	int err = note_for_gate(&seen->found, seen->recorded, &seen->changed, img);

	return !err && settings->look ?
	               look_tell(settings->look, seen->recorded, note_rule, &(struct rule_notes){ img, 0 }) :
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
		warn_unscaled(settings->trace, &seen.scaled);
	if (!err)
		err = tracer_render(tracer, seen.scene, &options, img);
	if (!err)
		err = note_camera(settings, &seen, img);
	if (!err)
		err = settings_denoise(settings, img);
	if (!err && settings->tracer.mode != TRACER_GL)
		err = note_rules(settings, &seen, img);
	if (!err)
		err = note_time(settings, shot, seen.recorded, img);
	if (!err)
		err = note_moment(settings, shot, &seen.between, img);
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
