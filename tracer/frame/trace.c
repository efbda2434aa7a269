#include "tracer/frame/trace.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/progress.h"
#include "kernels/camera/camera.h"
#include "kernels/frame/light/sample.h"
#include "scene/before.h"
#include "tracer/frame/bands/ways.h"
#include "tracer/frame/hook/hook_objects.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/emitters.h"
#include "tracer/frame/light/photons.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/compose.h"
#include "tracer/frame/picture/ended.h"
#include "tracer/frame/picture/noise.h"
#include "tracer/frame/place/geometry.h"
#include "tracer/frame/place/upload.h"
#include "tracer/frame/prepare/expand.h"

int tracer_create(struct tracer **out, struct device *dev)
{
	struct tracer *tr = calloc(1, sizeof(*tr));

	if (!tr)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	tr->dev = dev;
	if (accel_create(&tr->accel) != 0) {
		free(tr);
		return ERR_SYSTEM;
	}
	tr->accel->wide = traverse_families[device_family(dev)].wide;
	*out = tr;
	return 0;
}

#define RELEASE(element, name) device_release(tr->dev, &tr->buffers.name.buffer);

static void release_band(struct tracer *tr)
{
	FRAME_BAND_BUFFERS(RELEASE)
	device_release(tr->dev, &tr->buffers.frame.buffer);
	for (int i = 0; i < SCENE_SAMPLES; i++)
		device_release(tr->dev, &tr->buffers.samples[i].buffer);
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
	FRAME_WHOLE_BUFFERS(RELEASE)
	release_band(tr);
	traverse_release(tr->dev, &tr->trees);
	picture_kept_free(&tr->drawn);
	free(tr->counts);
	free(tr->first);
	free(tr);
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
			                  "there is no channel group '%.*s'; there are gl, shadow, relight, reflect, refract, Z, N, P, "
			                  "albedo, id, layers, cryptomatte, motion and caustics",
			                  (int)n, at);
		at += n + (at[n] == ',');
	}
	return 0;
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static void count_undrawn(struct job *job)
{
	const struct scene *scene = job->scene;

	for (uint32_t i = 0; i < scene->n_instances; i++)
		job->tr->undrawn.targets += scene->views[scene->instances[i].view].target != 0;
}

/* Draw all bands. If the device has too little memory for a band, halve the rows of bands from then on. */
static int trace_bands(struct job *job)
{
	const struct way *way = way_of(job);
	uint32_t end = job->height;
	int err = 0;

	while (end > 0 && !err) {
		const uint32_t rows = way_rows(way, job);

		job->row_first = (end - 1) / rows * rows;
		job->n_rows = end - job->row_first;
		job->n_pixels = job->n_rows * job->width;
		err = way->draw(job);
		if (!err) {
			end = job->row_first;
		} else if (err == ERR_MEMORY && job->n_rows > CAMERA_TILE) {
			job->tr->most_rows = job->n_rows / 2;
			release_band(job->tr);
			err = 0;
		}
	}
	return err;
}

static void forget_frame(struct job *job)
{
	for (uint32_t i = 0; i < job->prepared.n_instances && job->expanded; i++)
		expanded_free(&job->expanded[i]);
	free(job->expanded);
	free(job->extra);
	free(job->emissions);
	hook_objects_forget(job);
	job->expanded = NULL;
	job->extra = NULL;
	job->emissions = NULL;
	prepared_free(&job->prepared);
	job->is_placed = 0;
}

/* Upload what all bands need: state, vertices, trees. A frame that is already on the device is only moved, if that
 * suffices. */
static int place_frame(struct job *job, const float shift[2])
{
	int err;

	if (job->is_placed && geometry_can_move(job)) {
		prepare_shift(&job->prepared, shift);
		return geometry_move(job);
	}
	forget_frame(job);
	err = prepare_frame(job->scene, shift, &job->prepared);
	if (err)
		return err;
	job->expanded = calloc(job->prepared.n_instances + (size_t)1, sizeof(*job->expanded));
	job->extra = calloc(job->prepared.n_instances + (size_t)1, sizeof(*job->extra));
	if (!job->expanded || !job->extra)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = upload_state(job);
	if (!err)
		err = hooks_place(job);
	if (!err)
		err = hook_objects_find(job);
	if (!err)
		err = geometry_place(job);
	if (!err)
		err = emitters_place(job, secondary_transport(job->options));
	job->is_placed = !err;
	return err;
}

/* Trace one pass over the frame, band by band, top rows first. The frame stays on the device for the next pass until
 * forget_frame. */
static int trace_pass(struct job *job)
{
	float shift[2] = { 0, 0 };
	int err;

	if (job->pass > 0)
		sample_shift(job->turn, job->pass, shift);
	/* With several passes, each samples one position in a pixel. The pass that makes GL's picture has GL's
	 * samples. */
	job->n_samples = job->scene->samples > 1 && job->pass == 0 ? SCENE_SAMPLES : 1;
	err = place_frame(job, shift);
	if (err == ERR_MEMORY) {
		/* Bands of the previous frame may have taken the memory. */
		forget_frame(job);
		release_band(job->tr);
		err = place_frame(job, shift);
	}
	return err ? err : trace_bands(job);
}

static int check_size(const struct scene *scene)
{
	if (scene->width && scene->height && scene->width <= 16384 && scene->height <= 16384)
		return 0;
	return err_report(ERR_SYSTEM, NULL, "frame %llu: %u x %u pixels cannot be rendered",
	                  (unsigned long long)scene->frame, scene->width, scene->height);
}

/* Draw a scene's picture, from scene->start on. */
static int draw_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture)
{
	const struct tracer_options options = { .mode = TRACER_GL };
	struct job job = { .tr = tracer, .scene = scene, .options = &options, .width = scene->width, .height = scene->height,
		           .n_passes = 1, .picture = picture };
	int err = check_size(scene);

	if (err)
		return err;
	job.bits = scene->depth_bits | scene->stencil_bits << 8 | scene->alpha_bits << 16;
	err = trace_pass(&job);
	if (!err)
		err = ended_count(&job, NULL);
	forget_frame(&job);
	count_undrawn(&job);
	picture->unknown = (uint32_t)job.unknown;
	return err == ERR_MEMORY ? device_report_lack(tracer->dev) : err;
}

/* --- Start pictures ---------------------------------------------------------------------------------------------- */

/* A scene, and the start made for it here. */
struct begun {
	struct scene scene;
	struct scene_picture *start;
};

/* Make a scene start from the picture of the one before it. begun->start: freed by the caller, also after an error */
static int begin_with_before(struct tracer *tracer, const struct scene *scene, struct begun *begun)
{
	const struct scene *before = scene_before_use(scene->before);
	int err = 0;

	*begun = (struct begun){ .scene = *scene, .start = before ? picture_blank(before) : NULL };
	begun->scene.start = begun->start;
	begun->scene.before = NULL;
	if (before)
		err = begun->start ? tracer_render_picture(tracer, before, begun->start) :
		                     err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", before->width, before->height);
	scene_before_done(scene->before);
	return err;
}

int tracer_render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture)
{
	struct begun begun;
	struct scene rest;
	int err;

	/* The next frame often starts from the last one rendered. */
	if (picture_recall(&tracer->drawn, scene, picture))
		return 0;
	if (!scene->before && picture_rest(&tracer->drawn, scene, &rest)) {
		err = draw_picture(tracer, &rest, picture);
		free(rest.clears);
	} else {
		err = draw_picture(tracer, scene, picture);
	}
	if (!err && scene->before) {
		scene_before_settle(scene->before, picture->unknown != 0);
		if (picture->unknown) {
			err = begin_with_before(tracer, scene, &begun);
			if (!err)
				err = draw_picture(tracer, &begun.scene, picture);
			picture_free(begun.start);
		}
	}
	if (!err)
		picture_keep(&tracer->drawn, scene, picture);
	return err;
}

/* --- Samples ----------------------------------------------------------------------------------------------------- */

/* Progress of a frame's samples: times and noise. */
struct sampling {
	double start_s, last_s; /* start of the first sample; end of the last one */
	uint32_t next; /* number of samples before noise is measured and the preview shown; then increased by half */
	struct noise noise;
};

static int show_all(struct job *job, struct image *img)
{
	int err = compose_start(job, img);

	job->pass = 0;
	job->image = img;
	return err ? err : trace_pass(job);
}

/* Show the picture of the samples so far, without affecting later ones. */
static int show_preview(struct job *job, uint32_t passes)
{
	struct image img = { .width = 0 };
	struct job so_far;
	int err;

	forget_frame(job);
	so_far = *job;
	so_far.n_passes = passes + 1;
	err = show_all(&so_far, &img);
	forget_frame(&so_far);
	if (!err)
		err = job->options->preview(job->options->preview_user, &img);
	image_free(&img);
	return err;
}

/* After a pass, decide whether it was the last one needed. passes: number summed so far; one more always follows */
static int is_enough(struct job *job, struct sampling *s, uint32_t passes, int *enough)
{
	const struct tracer_options *o = job->options;
	const double now = progress_clock_s() - s->start_s, taken = now - s->last_s;
	int err = 0;

	s->last_s = now;
	*enough = o->seconds > 0 && now + (passes > 1 ? taken : 0) >= o->seconds; /* the first loads kernels, too */
	if (passes < s->next || *enough)
		return 0;
	s->next += (s->next + 1) / 2;
	if (o->noise > 0) {
		float noise;

		err = noise_measure(job, &s->noise, passes, &noise);
		*enough = noise <= o->noise;
	}
	if (!err && !*enough && o->preview)
		err = show_preview(job, passes);
	s->last_s = progress_clock_s() - s->start_s;
	return err;
}

/* Get the scene of a sample while the shutter is open. It starts from the same picture as the frame. */
static int expose(struct job *job, const struct scene *frame, struct scene *exposed)
{
	const struct tracer_options *o = job->options;
	const struct scene *scene;
	int err;

	forget_frame(job);
	err = o->expose(o->expose_user, (double)sample_time(job->turn, job->pass), &scene);
	if (err)
		return err;
	*exposed = *scene;
	exposed->start = frame->start;
	exposed->before = frame->before;
	job->scene = exposed;
	return 0;
}

/* Trace one sample of all pixels. */
static int sum_pass(struct job *job)
{
	const uint32_t is_path = job->options->mode == TRACER_PATH;
	const struct scene *frame = job->scene;
	struct scene exposed;
	int err = 0;

	for (job->turn = is_path ? SAMPLE_TURNS : 0; job->turn < SAMPLE_TURNS + is_path && !err; job->turn++) {
		if (job->options->expose)
			err = expose(job, frame, &exposed);
		if (!err)
			err = trace_pass(job);
	}
	if (job->options->expose)
		forget_frame(job);
	job->scene = frame;
	return err;
}

/* Trace all passes except the one through pixel centres. If sampling may end early, they are in order: any first
 * samples are spread evenly. */
static int sum_passes(struct job *job)
{
	const struct tracer_options *o = job->options;
	const uint32_t n = job->n_passes;
	const int in_order = o->mode == TRACER_PATH || o->seconds > 0 || o->noise > 0 || o->preview;
	struct sampling s = { .start_s = progress_clock_s(), .next = 1 };
	int err = 0, enough = 0;
	uint32_t i = 1;

	for (; i < n && !err && !enough; i++) {
		job->pass = in_order ? i : n - i;
		job->is_first = i == 1;
		err = sum_pass(job);
		if (!err && o->sampled)
			o->sampled(o->sampled_user, i, o->seconds > 0 || o->noise > 0 ? 0 : n);
		if (!err)
			err = is_enough(job, &s, i, &enough);
	}
	job->n_passes = i;
	noise_free(&s.noise);
	return err;
}

/* Render a scene to an image, from scene->start on. unknown: receives the number of pixels that show unknown contents
 * from before */
static int draw_image(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                      struct image *img, uint64_t *unknown)
{
	struct tracer_options known = *options;
	struct job job = { .tr = tracer, .scene = scene, .options = &known, .width = scene->width, .height = scene->height,
		           .n_passes = options->samples ? options->samples : 1 };
	int err = 0;

	if (check_size(scene) != 0)
		return ERR_SYSTEM;
	if (known.rays == 0)
		known.rays = 16;
	job.bits = scene->depth_bits | scene->stencil_bits << 8 | scene->alpha_bits << 16;
	/* The pass through pixel centres comes last: values that are not averaged come from it. */
	err = sum_passes(&job);
	if (!err)
		err = show_all(&job, img);
	if (!err)
		err = ended_count(&job, img);
	if (!err && known.photons)
		err = photons_add(&job, img);
	forget_frame(&job);
	if (!err && job.n_passes < options->samples)
		err = image_set_attribute(img, "relume:samples", "%u", job.n_passes);
	count_undrawn(&job);
	*unknown = job.unknown;
	if (!err)
		tracer_added_add(&tracer->added, &job.added, &(struct tracer_added){ 0 });
	else
		image_free(img);
	return err == ERR_MEMORY ? device_report_lack(tracer->dev) : err;
}

/* Count the pixels that show contents from before the scene, from a frame that is not made yet. */
static int count_unknown(struct tracer *tracer, const struct scene *scene, uint64_t *unknown)
{
	struct scene_picture *picture = picture_blank(scene);
	int err = picture ?
	                  draw_picture(tracer, scene, picture) :
	                  err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", scene->width, scene->height);

	if (!err)
		*unknown = picture->unknown;
	picture_free(picture);
	return err;
}

int tracer_render(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                  struct image *img)
{
	const struct tracer_undrawn undrawn = tracer->undrawn;
	const struct tracer_added added = tracer->added;
	const int is_quick = options->samples <= 1 && !options->photons; /* not worth a look beforehand */
	uint64_t unknown = 0;
	struct begun begun;
	int err = 0;

	if (scene->before && !is_quick)
		err = count_unknown(tracer, scene, &unknown);
	if (!err && !unknown)
		err = draw_image(tracer, scene, options, img, &unknown);
	if (err || !scene->before)
		return err;
	scene_before_settle(scene->before, unknown != 0);
	if (!unknown)
		return 0;
	if (is_quick)
		image_free(img);
	err = begin_with_before(tracer, scene, &begun);
	tracer->undrawn = undrawn;
	tracer->added = added;
	if (!err)
		err = draw_image(tracer, &begun.scene, options, img, &unknown);
	picture_free(begun.start);
	return err;
}
