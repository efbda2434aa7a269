#include "tracer/frame/trace.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/progress.h"
#include "kernels/camera/camera.h"
#include "kernels/frame/light/sample.h"
#include "scene/before.h"
#include "tracer/frame/bands/buffers.h"
#include "tracer/frame/bands/ways.h"
#include "tracer/frame/hook/hook_objects.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/buffers.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/light/emitters.h"
#include "tracer/frame/light/photons.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/buffers.h"
#include "tracer/frame/picture/compose.h"
#include "tracer/frame/picture/ended.h"
#include "tracer/frame/picture/noise.h"
#include "tracer/frame/place/geometry.h"
#include "tracer/frame/place/upload.h"
#include "tracer/frame/prepare/expand.h"

/* A tracer with its rooms' buffers. */
struct tracer_rooms {
	struct tracer tracer;
	struct hook_buffers hook;
	struct light_buffers light;
	struct dome_buffers dome;
	struct picture_buffers picture;
	struct band_buffers band;
};

int tracer_create(struct tracer **out, struct device *dev)
{
	struct tracer_rooms *rooms = calloc(1, sizeof(*rooms));
	struct tracer *tr = &rooms->tracer;

	if (!rooms)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	tr->dev = dev;
	tr->hook = &rooms->hook;
	tr->light = &rooms->light;
	tr->dome = &rooms->dome;
	tr->picture = &rooms->picture;
	tr->band = &rooms->band;
	if (accel_create(&tr->accel) != 0) {
		free(rooms);
		return ERR_SYSTEM;
	}
	tr->accel->wide = traverse_families[device_family(dev)].wide;
	*out = tr;
	return 0;
}

#define RELEASE(room) device_release(tr->dev, &(room).buffer);
#define RELEASE_PLACED(element, name) RELEASE(tr->placed.name)
#define RELEASE_LIGHT(element, name) RELEASE(tr->light->name)
#define RELEASE_DOME(element, name) RELEASE(tr->dome->name)
#define RELEASE_PICTURE(element, name) RELEASE(tr->picture->name)
#define RELEASE_BAND(element, name) RELEASE(tr->band->name)

/* Release what a frame does not keep from band to band. */
static void release_band(struct tracer *tr)
{
	LIGHT_BUFFERS(RELEASE_LIGHT)
	DOME_BUFFERS(RELEASE_DOME)
	PICTURE_BUFFERS(RELEASE_PICTURE)
	BAND_BUFFERS(RELEASE_BAND)
	RELEASE(tr->hook->answers)
	RELEASE(tr->pixels.frame)
	for (int i = 0; i < SCENE_SAMPLES; i++)
		RELEASE(tr->pixels.samples[i])
}

void tracer_destroy(struct tracer **tracer)
{
	struct tracer *tr = *tracer;

	if (!tr)
		return;
	accel_destroy(&tr->accel);
	pool_free(&tr->attributes, tr->dev);
	pool_free(&tr->indices, tr->dev);
	pool_free(&tr->texels, tr->dev);
	pool_free(&tr->opacity, tr->dev);
	free(tr->opacity_met.names);
	PLACED_BUFFERS(RELEASE_PLACED)
	RELEASE(tr->hook->parameters)
	RELEASE(tr->hook->objects)
	RELEASE(tr->light->emitters)
	RELEASE(tr->picture->sums)
	release_band(tr);
	traverse_release(tr->dev, &tr->trees);
	picture_kept_free(&tr->drawn);
	free(tr->band->host_counts);
	free(tr->band->host_first);
	free(tr); /* the first member of its rooms */
	*tracer = NULL;
}

void tracer_share(struct tracer *tracer, struct blas_cache *cache)
{
	tracer->accel->shared = cache;
}

const struct tracer_undrawn *tracer_undrawn(const struct tracer *tracer)
{
	return &tracer->undrawn;
}

const struct tracer_added *tracer_added(const struct tracer *tracer)
{
	return &tracer->added;
}

void tracer_added_add(struct tracer_added *sum, const struct tracer_added *now, const struct tracer_added *before)
{
	sum->pixels += now->pixels - before->pixels;
	sum->changed += now->changed - before->changed;
	for (int i = 0; i < N_TRACER_PARTS; i++)
		sum->parts[i] += now->parts[i] - before->parts[i];
}

int tracer_check_aov(const char *aov)
{
	const char *at = aov;

	while (at && *at) {
		size_t n = strcspn(at, ","), known = 0;

		for (int i = 0; compose_groups[i]; i++)
			known |= strlen(compose_groups[i]) == n && strncmp(compose_groups[i], at, n) == 0;
		if (!known)
			return err_report(ERR_USAGE, NULL,
			                  "there is no channel group '%.*s'; there are gl, shadow, relight, reflect, "
			                  "refract, Z, N, P, "
			                  "albedo, id, layers, cryptomatte, motion and caustics",
			                  (int)n, at);
		at += n + (at[n] == ',');
	}
	return 0;
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

/* A frame that is not placed yet. */
static struct frame frame_of(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options)
{
	return (struct frame){ .tr = tracer,
		               .scene = scene,
		               .options = options,
		               .width = scene->width,
		               .height = scene->height,
		               .bits = scene->depth_bits | scene->stencil_bits << 8 | scene->alpha_bits << 16 };
}

static int check_size(const struct scene *scene)
{
	if (scene->width && scene->height && scene->width <= 16384 && scene->height <= 16384)
		return 0;
	return err_report(ERR_SYSTEM, NULL, "frame %llu: %u x %u pixels cannot be rendered",
	                  (unsigned long long)scene->frame, scene->width, scene->height);
}

/* Draw all bands. If the device has too little memory for a band, halve the rows of bands from then on. */
static int trace_bands(const struct pass *pass)
{
	const struct frame *frame = pass->frame;
	const struct way *way = way_of(pass);
	uint32_t end = frame->height;
	int err = 0;

	while (end > 0 && !err) {
		const uint32_t rows = way_rows(way, frame), first = (end - 1) / rows * rows;
		struct band band = { .frame = frame, .pass = pass, .row_first = first, .n_rows = end - first,
			             .n_pixels = (end - first) * frame->width };

		err = way->draw(&band);
		if (!err) {
			end = first;
		} else if (err == ERR_MEMORY && band.n_rows > CAMERA_TILE) {
			frame->tr->most_rows = band.n_rows / 2;
			release_band(frame->tr);
			err = 0;
		}
	}
	return err;
}

static void forget_frame(struct frame *frame)
{
	for (uint32_t i = 0; i < frame->prepared.n_instances && frame->expanded; i++)
		expanded_free(&frame->expanded[i]);
	free(frame->expanded);
	free(frame->extra);
	free(frame->emissions);
	hook_objects_forget(frame);
	frame->expanded = NULL;
	frame->extra = NULL;
	frame->emissions = NULL;
	prepared_free(&frame->prepared);
	frame->is_placed = 0;
}

/* Upload what all bands need: state, vertices, trees. A frame that is already on the device is only moved, if that
 * suffices. */
static int place_frame(struct frame *frame, const float shift[2])
{
	int err;

	if (frame->is_placed && geometry_can_move(frame)) {
		prepare_shift(&frame->prepared, shift);
		return geometry_move(frame);
	}
	forget_frame(frame);
	err = prepare_frame(frame->scene, shift, &frame->prepared);
	if (err)
		return err;
	frame->expanded = calloc(frame->prepared.n_instances + (size_t)1, sizeof(*frame->expanded));
	frame->extra = calloc(frame->prepared.n_instances + (size_t)1, sizeof(*frame->extra));
	if (!frame->expanded || !frame->extra)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = upload_state(frame);
	if (!err)
		err = hooks_place(frame);
	if (!err)
		err = hook_objects_find(frame);
	if (!err)
		err = geometry_place(frame);
	if (!err)
		err = emitters_place(frame, secondary_transport(frame->options));
	frame->is_placed = !err;
	return err;
}

/* Trace one pass over the frame, band by band, top rows first. The frame stays on the device for the next pass until
 * forget_frame. */
static int trace_pass(struct frame *frame, struct pass pass)
{
	float shift[2] = { 0, 0 };
	int err;

	if (pass.number > 0)
		sample_shift(pass.turn, pass.number, shift);
	/* With several passes, each samples one position in a pixel. The pass that makes GL's picture has GL's
	 * samples. */
	pass.n_samples = frame->scene->samples > 1 && pass.number == 0 ? SCENE_SAMPLES : 1;
	pass.frame = frame;
	err = place_frame(frame, shift);
	if (err == ERR_MEMORY) {
		/* Bands of the previous frame may have taken the memory. */
		forget_frame(frame);
		release_band(frame->tr);
		err = place_frame(frame, shift);
	}
	return err ? err : trace_bands(&pass);
}

static uint64_t count_targets(const struct scene *scene)
{
	uint64_t n = 0;

	for (uint32_t i = 0; i < scene->n_instances; i++)
		n += scene->views[scene->instances[i].view].target != 0;
	return n;
}

/* Draw a scene's picture, from scene->start on. drawn: counts are added to it */
static int draw_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture,
                        struct drawn *drawn)
{
	const struct tracer_options options = { .mode = TRACER_GL };
	struct frame frame = frame_of(tracer, scene, &options);
	int err = check_size(scene);

	if (err)
		return err;
	drawn->unknown = 0;
	err = trace_pass(&frame, (struct pass){ .count = 1, .picture = picture, .drawn = drawn });
	if (!err)
		err = ended_count(&frame, NULL, &drawn->undrawn.ended);
	forget_frame(&frame);
	drawn->undrawn.targets += count_targets(scene);
	picture->unknown = (uint32_t)drawn->unknown;
	return err == ERR_MEMORY ? device_report_lack(tracer->dev) : err;
}

/* --- Start pictures ---------------------------------------------------------------------------------------------- */

/* A scene, and the start made for it here. */
struct begun {
	struct scene scene;
	struct scene_picture *start;
};

static int render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture,
                          struct drawn *drawn);

/* Make a scene start from the picture of the one before it. begun->start: freed by the caller, also after an error */
static int begin_with_before(struct tracer *tracer, const struct scene *scene, struct begun *begun, struct drawn *drawn)
{
	const struct scene *before = scene_before_use(scene->before);
	int err = 0;

	*begun = (struct begun){ .scene = *scene, .start = before ? picture_blank(before) : NULL };
	begun->scene.start = begun->start;
	begun->scene.before = NULL;
	if (before)
		err = begun->start ? render_picture(tracer, before, begun->start, drawn) :
		                     err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", before->width,
		                                before->height);
	scene_before_done(scene->before);
	return err;
}

/* As tracer_render_picture. drawn: counts are added to it */
static int render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture,
                          struct drawn *drawn)
{
	struct begun begun;
	struct scene rest;
	int err;

	/* The next frame often starts from the last one rendered. */
	if (picture_recall(&tracer->drawn, scene, picture))
		return 0;
	if (!scene->before && picture_rest(&tracer->drawn, scene, &rest)) {
		err = draw_picture(tracer, &rest, picture, drawn);
		free(rest.clears);
	} else {
		err = draw_picture(tracer, scene, picture, drawn);
	}
	if (!err && scene->before) {
		scene_before_settle(scene->before, picture->unknown != 0);
		if (picture->unknown) {
			err = begin_with_before(tracer, scene, &begun, drawn);
			if (!err)
				err = draw_picture(tracer, &begun.scene, picture, drawn);
			picture_free(begun.start);
		}
	}
	if (!err)
		picture_keep(&tracer->drawn, scene, picture);
	return err;
}

/* Add what a call found to the tracer's counts. */
static void count(struct tracer *tracer, const struct drawn *drawn)
{
	tracer->undrawn.targets += drawn->undrawn.targets;
	tracer->undrawn.ended += drawn->undrawn.ended;
	tracer_added_add(&tracer->added, &drawn->added, &(struct tracer_added){ 0 });
}

int tracer_render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture)
{
	struct drawn drawn = { 0 };
	int err = render_picture(tracer, scene, picture, &drawn);

	count(tracer, &drawn);
	return err;
}

/* --- Samples ----------------------------------------------------------------------------------------------------- */

/* Progress of a frame's samples: times and noise. */
struct sampling {
	double start_s, last_s; /* start of the first sample; end of the last one */
	uint32_t next; /* number of samples before noise is measured and the preview shown; then increased by half */
	struct noise noise;
};

/* Make the picture of `passes` passes. The last one is traced now. */
static int show_all(struct frame *frame, uint32_t passes, struct image *img, struct drawn *drawn)
{
	int err = compose_start(frame, img);

	return err ? err : trace_pass(frame, (struct pass){ .count = passes, .image = img, .drawn = drawn });
}

/* Show the picture of the samples so far, without affecting later ones. */
static int show_preview(struct frame *frame, uint32_t passes)
{
	struct image img = { .width = 0 };
	struct drawn drawn = { 0 };
	int err;

	forget_frame(frame);
	err = show_all(frame, passes + 1, &img, &drawn);
	forget_frame(frame);
	if (!err)
		err = frame->options->preview(frame->options->preview_user, &img);
	image_free(&img);
	return err;
}

/* After a pass, decide whether it was the last one needed. passes: number summed so far; one more always follows */
static int is_enough(struct frame *frame, struct sampling *s, uint32_t passes, int *enough)
{
	const struct tracer_options *o = frame->options;
	const double now = progress_clock_s() - s->start_s, taken = now - s->last_s;
	int err = 0;

	s->last_s = now;
	*enough = o->seconds > 0 && now + (passes > 1 ? taken : 0) >= o->seconds; /* the first loads kernels, too */
	if (passes < s->next || *enough)
		return 0;
	s->next += (s->next + 1) / 2;
	if (o->noise > 0) {
		float noise;

		err = noise_measure(frame, &s->noise, passes, &noise);
		*enough = noise <= o->noise;
	}
	if (!err && !*enough && o->preview)
		err = show_preview(frame, passes);
	s->last_s = progress_clock_s() - s->start_s;
	return err;
}

/* Trace a pass over the scene of its moment while the shutter is open. It starts from the same picture as the frame. */
static int trace_moment(struct frame *frame, struct pass pass)
{
	const struct tracer_options *o = frame->options;
	const struct scene *scene;
	struct scene exposed;
	struct frame moment;
	int err = o->expose(o->expose_user, (double)sample_time(pass.turn, pass.number), &scene);

	if (err)
		return err;
	exposed = *scene;
	exposed.start = frame->scene->start;
	exposed.before = frame->scene->before;
	moment = frame_of(frame->tr, &exposed, o);
	err = trace_pass(&moment, pass);
	forget_frame(&moment);
	return err;
}

/* Trace one sample of all pixels. */
static int sum_pass(struct frame *frame, struct pass pass)
{
	const uint32_t is_path = frame->options->mode == TRACER_PATH;
	int err = 0;

	for (pass.turn = is_path ? SAMPLE_TURNS : 0; pass.turn < SAMPLE_TURNS + is_path && !err; pass.turn++)
		err = frame->options->expose ? trace_moment(frame, pass) : trace_pass(frame, pass);
	return err;
}

/* Trace all passes except the one through pixel centres. If sampling may end early, they are in order: any first
 * samples are spread evenly. n: number of passes; receives that of those needed */
static int sum_passes(struct frame *frame, uint32_t *n, struct drawn *drawn)
{
	const struct tracer_options *o = frame->options;
	const int in_order = o->mode == TRACER_PATH || o->seconds > 0 || o->noise > 0 || o->preview;
	struct sampling s = { .start_s = progress_clock_s(), .next = 1 };
	int err = 0, enough = 0;
	uint32_t i = 1;

	for (; i < *n && !err && !enough; i++) {
		err = sum_pass(frame, (struct pass){ .number = in_order ? i : *n - i, .count = *n, .is_first = i == 1,
		                                     .drawn = drawn });
		if (!err && o->sampled)
			o->sampled(o->sampled_user, i, o->seconds > 0 || o->noise > 0 ? 0 : *n);
		if (!err)
			err = is_enough(frame, &s, i, &enough);
	}
	*n = i;
	noise_free(&s.noise);
	return err;
}

/* Render a scene to an image, from scene->start on. drawn: counts are added to it; those of unknown pixels are set */
static int draw_image(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                      struct image *img, struct drawn *drawn)
{
	struct tracer_options known = *options;
	struct frame frame = frame_of(tracer, scene, &known);
	uint32_t passes = options->samples ? options->samples : 1;
	int err = 0;

	if (check_size(scene) != 0)
		return ERR_SYSTEM;
	if (known.rays == 0)
		known.rays = 16;
	drawn->unknown = 0;
	/* The pass through pixel centres comes last: values that are not averaged come from it. */
	err = sum_passes(&frame, &passes, drawn);
	if (!err)
		err = show_all(&frame, passes, img, drawn);
	if (!err)
		err = ended_count(&frame, img, &drawn->undrawn.ended);
	if (!err && known.photons)
		err = photons_add(&frame, img);
	forget_frame(&frame);
	if (!err && passes < options->samples)
		err = image_set_attribute(img, "relume:samples", "%u", passes);
	drawn->undrawn.targets += count_targets(scene);
	if (err) {
		drawn->added = (struct tracer_added){ 0 };
		image_free(img);
	}
	return err == ERR_MEMORY ? device_report_lack(tracer->dev) : err;
}

/* Count the pixels that show contents from before the scene, from a frame that is not made yet. */
static int count_unknown(struct tracer *tracer, const struct scene *scene, struct drawn *drawn)
{
	struct scene_picture *picture = picture_blank(scene);
	int err = picture ?
	                  draw_picture(tracer, scene, picture, drawn) :
	                  err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", scene->width, scene->height);

	picture_free(picture);
	return err;
}

/* Render a scene whose first picture shows contents from before it. */
static int draw_from_before(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                            struct image *img, struct drawn *drawn)
{
	struct drawn before = { 0 };
	struct begun begun;
	int err = begin_with_before(tracer, scene, &begun, &before);

	*drawn = (struct drawn){ 0 };
	if (!err)
		err = draw_image(tracer, &begun.scene, options, img, drawn);
	picture_free(begun.start);
	return err;
}

int tracer_render(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                  struct image *img)
{
	const int is_quick = options->samples <= 1 && !options->photons; /* not worth a look beforehand */
	struct drawn drawn = { 0 };
	int err = 0;

	if (scene->before && !is_quick)
		err = count_unknown(tracer, scene, &drawn);
	if (!err && !drawn.unknown)
		err = draw_image(tracer, scene, options, img, &drawn);
	if (!err && scene->before) {
		scene_before_settle(scene->before, drawn.unknown != 0);
		if (drawn.unknown && is_quick)
			image_free(img);
		if (drawn.unknown)
			err = draw_from_before(tracer, scene, options, img, &drawn);
	}
	count(tracer, &drawn);
	return err;
}
