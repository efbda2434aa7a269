#include "tracer/frame/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/camera/camera.h"
#include "kernels/frame/sample.h"
#include "kernels/gl/pixel.h"
#include "tracer/frame/compose.h"
#include "tracer/frame/frame.h"

/* The trees that a family of kernels walks beside the binary ones. */
static const unsigned wide_trees[N_DEVICE_FAMILIES] = { [FAMILY_PACKETS] = ACCEL_ROWS, [FAMILY_COMPRESSED] = ACCEL_COMPRESSED };

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
	tr->accel->wide = wide_trees[device_family(dev)];
	*out = tr;
	return 0;
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
#define RELEASE(element, name) device_release(tr->dev, &tr->buffers.name.buffer);
	FRAME_BUFFERS(RELEASE)
	device_release(tr->dev, &tr->buffers.frame.buffer);
	for (int i = 0; i < SCENE_SAMPLES; i++)
		device_release(tr->dev, &tr->buffers.samples[i].buffer);
	traverse_release(tr->dev, &tr->trees);
	free(tr->counts);
	free(tr->first);
	free(tr);
	*tracer = NULL;
}

struct tables_launch frame_tables(const struct tracer *tr)
{
	const struct frame_buffers *b = &tr->buffers;

	return *LAUNCH(tables, .geometries = b->geometries, .materials = b->materials, .lights = b->lights, .units = b->units,
	               .currents = b->currents, .attributes = tr->attributes.floats, .indices = tr->indices.words,
	               .vertices = b->vertices, .texcoords = b->texcoords, .textures = b->textures, .texels = tr->texels.words,
	               .stipples = b->stipples);
}

void tracer_share(struct tracer *tracer, struct blas_cache *cache)
{
	tracer->accel->shared = cache;
}

int tracer_check_aov(const char *aov)
{
	const char *at = aov;

	while (at && *at) {
		size_t n = strcspn(at, ","), known = 0;

		for (int i = 0; compose_groups[i]; i++)
			known |= strlen(compose_groups[i]) == n && strncmp(compose_groups[i], at, n) == 0;
		if (!known)
			return err_report(ERR_USAGE, NULL, "there is no channel group '%.*s'; there are gl, shadow, relight, "
			                  "reflect, refract, Z, N, P, albedo, id and layers", (int)n, at);
		at += n + (at[n] == ',');
	}
	return 0;
}

const struct tracer_undrawn *tracer_undrawn(const struct tracer *tracer)
{
	return &tracer->undrawn;
}

/* --- Segments ------------------------------------------------------------------------------------------------------ */

static struct camera_rectangle view_rectangle(const struct job *job, const struct view *view)
{
	return camera_rectangle(view->scissor[0], view->scissor[1], view->scissor[2], view->scissor[3], job->width,
	                        job->height);
}

static uint32_t rectangle_area(struct camera_rectangle r)
{
	return (uint32_t)(r.x1 - r.x0) * (uint32_t)(r.y1 - r.y0);
}

static union buffer_frame_pixel *sample_buffer(const struct job *job, uint32_t sample)
{
	return job->n_samples == 1 ? &job->tr->buffers.frame : &job->tr->buffers.samples[sample];
}

/* Draw to one of the pixels' samples from now on. note: what the kernels are told of it (pixel_sample, PIXEL_FOLLOWS) */
static void draw_to(struct job *job, uint32_t sample, uint32_t note)
{
	job->frame = sample_buffer(job, sample);
	job->bits = (job->bits & 0xffffffu) | note;
}

static int clear_sample(struct job *job, const struct scene_clear *clear)
{
	struct camera_rectangle r = camera_rectangle(clear->scissor[0], clear->scissor[1], clear->scissor[2],
	                                             clear->scissor[3], job->width, job->height);
	uint32_t n = rectangle_area(r);

	return launch_clear(job->tr->dev, n, LAUNCH(clear, .clear = *clear, .rectangle = r, .width = job->width, .bits = job->bits,
	                                            .n = n, .frame = *job->frame));
}

static int run_clear(struct job *job, const struct scene_clear *clear)
{
	int err = 0;

	if (clear->target != 0)
		return 0;
	if (clear->buffers & 1)
		memcpy(job->background, clear->color, sizeof(job->background));
	for (uint32_t i = 0; i < job->n_samples && !err; i++) {
		draw_to(job, i, 0);
		err = clear_sample(job, clear);
	}
	return err;
}

static int run_camera(struct job *job, const struct segment *segment, struct camera_rectangle r)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;

	return traverse_camera(tr->dev, traverse_kernels[device_family(tr->dev)].camera, &tr->trees, r,
	                       LAUNCH(camera_pass, .view_index = segment->view, .views = b->views, .width = job->width,
	                              .height = job->height, .mode = segment->mode, .window = b->windows, .clip = b->clips,
	                              .after = b->after, .fragments = b->sparse, .counts = b->counts));
}

/* Pixels across of the blocks that the list goes by: what one work item takes of their rays (RAYS_PER_ITEM) should stay together. */
#define LIST_BLOCK 8

/* Up to `limit`, a step of blocks from `at` on; the first ends at a multiple. */
static int32_t block_end(int32_t at, int32_t limit)
{
	const int32_t end = at - at % LIST_BLOCK + LIST_BLOCK;

	return end < limit ? end : limit;
}

/*
 * Where each pixel's fragments go in the dense list, in buffers.first: block by block of pixels.
 * @param n_list  receives how many there are
 * @param more    receives 1 where a pixel's slots were all filled: its column may go on
 */
static int place_fragments(struct job *job, struct camera_rectangle r, uint32_t slots, uint32_t *n_list, int *more)
{
	struct tracer *tr = job->tr;
	uint32_t next = 0;
	int err = device_read(tr->dev, tr->buffers.counts.buffer, 0, tr->counts, job->n_pixels * sizeof(*tr->counts));

	*more = 0;
	for (int32_t y0 = r.y0; y0 < r.y1 && !err; y0 = block_end(y0, r.y1))
		for (int32_t x0 = r.x0; x0 < r.x1; x0 = block_end(x0, r.x1))
			for (int32_t y = y0; y < block_end(y0, r.y1); y++)
				for (int32_t x = x0; x < block_end(x0, r.x1); x++) {
					size_t pixel = (size_t)y * job->width + (size_t)x;

					if (job->pass && sample_turn((uint32_t)pixel) != job->turn)
						tr->counts[pixel] = 0;
					tr->first[pixel] = next;
					next += tr->counts[pixel];
					*more |= slots > 1 && tr->counts[pixel] == slots;
				}
	*n_list = next;
	if (!err && job->pass)
		err = frame_upload(tr, counts, tr->counts, job->n_pixels);
	return err ? err : frame_upload(tr, first, tr->first, job->n_pixels);
}

static int run_gather(struct job *job, struct camera_rectangle r, uint32_t slots, uint32_t n_list)
{
	struct tracer *tr = job->tr;
	uint32_t n = rectangle_area(r);
	const struct frame_buffers *b = &tr->buffers;
	int err = frame_reserve(tr, fragments, n_list);

	if (!err)
		err = frame_reserve(tr, pixels, n_list);
	if (!err)
		err = frame_reserve(tr, shaded, n_list);
	if (err)
		return err;
	return launch_gather(tr->dev, n, LAUNCH(gather, .sparse = b->sparse, .counts = b->counts, .slots = slots, .first = b->first,
	                                        .list = b->fragments, .pixels = b->pixels, .after = b->after, .rectangle = r,
	                                        .width = job->width, .n = n));
}

static int run_shade(struct job *job, uint32_t slots, uint32_t n)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;
	const struct shade_launch *a =
		LAUNCH(shade, .tables = frame_tables(tr), .views = b->views, .windows = b->windows, .fragments = b->fragments,
		       .pixels = b->pixels, .width = job->width, .height = job->height, .bits = job->bits, .visibility = b->visibility,
		       .n_slots = slots, .transport = transport_of(job->options), .n = n, .shaded = b->shaded);

	if (device_family(tr->dev) == FAMILY_PACKETS)
		return launch_shade_packet(tr->dev, (n + SHADE_PACKET - 1) / SHADE_PACKET, a);
	return launch_shade(tr->dev, n, a);
}

static int run_resolve(struct job *job, struct camera_rectangle r)
{
	struct tracer *tr = job->tr;
	const struct frame_buffers *b = &tr->buffers;
	uint32_t n = rectangle_area(r);

	return launch_resolve(tr->dev, n, LAUNCH(resolve, .tables = frame_tables(tr), .fragments = b->fragments, .shaded = b->shaded,
	                                         .first = b->first, .counts = b->counts, .rectangle = r, .width = job->width,
	                                         .bits = job->bits, .n = n, .frame = *job->frame));
}

/* The fragments of the list: GL's colours, then what rays from them find. */
static int shade_list(struct job *job, uint32_t view, uint32_t n)
{
	const struct accel_space *space = space_of_view(job, view, 0);
	enum tracer_mode mode = job->options->mode;
	int err = run_shade(job, 0, n);

	if (err || !space || mode == TRACER_GL || mode == TRACER_NORMALS)
		return err;
	if (mode == TRACER_AO || mode == TRACER_AO_PHONG)
		return trace_openness(job, space, n);
	if (job->prepared.n_light_slots) {
		err = trace_shadows(job, space, n);
		if (!err)
			err = run_shade(job, job->prepared.n_light_slots, n);
	}
	if (!err && job->options->depth && (job->prepared.has_mirrors || transport_of(job->options) >= TRANSPORT_DIFFUSE))
		err = trace_paths(job, space, space_of_view(job, view, 1), n);
	return err;
}

/* What the segment's draws leave on the sample that is drawn; of draws that cover pixels, on all of them. */
static int run_draws(struct job *job, const struct segment *segment)
{
	struct tracer *tr = job->tr;
	struct camera_rectangle r = view_rectangle(job, &job->prepared.views[segment->view]);
	uint32_t slots = segment->mode == CAMERA_COLUMN ? CAMERA_COLUMN_MAX : 1, n_list;
	int more = 1, err;

	memset(tr->counts, 0, job->n_pixels * sizeof(*tr->counts));
	err = frame_upload(tr, after, tr->counts, job->n_pixels);
	if (!err)
		err = frame_reserve(tr, sparse, (size_t)slots * job->n_pixels);
	while (more && !err) {
		err = run_camera(job, segment, r);
		if (!err)
			err = place_fragments(job, r, slots, &n_list, &more);
		if (err || n_list == 0)
			break;
		err = run_gather(job, r, slots, n_list);
		if (!err)
			err = shade_list(job, segment->view, n_list);
		for (uint32_t i = 0; i < (segment->multisample ? 1 : job->n_samples) && !err; i++) {
			if (!segment->multisample)
				draw_to(job, i, i ? PIXEL_FOLLOWS : 0);
			err = run_resolve(job, r);
		}
	}
	return err;
}

/*
 * Where llvmpipe (Mesa 22.3.6, lp_sample_pos_4x) and Direct3D have four samples: 1/256 pixel right of and below a pixel's centre. Rows
 * count from the top of windows and from the bottom of framebuffer objects.
 */
static const int32_t sample_places[SCENE_SAMPLES][2] = { { -32, -96 }, { 96, -32 }, { -96, 32 }, { 32, 96 } };

/*
 * Under multisampling llvmpipe (22.3.6, lp_setup_add_scissor_planes) lets samples in the second half of the pixels before a scissor
 * rectangle pass, where they lie in the same tile. Columns and rows counted from where it counts.
 */
static int32_t leaks(int32_t first, int32_t place)
{
	return first > 0 && first % 64 != 0 && place > 0;
}

/* Let a segment's view look at a sample's places. */
static int look_at_sample(struct job *job, const struct segment *segment, uint32_t sample)
{
	struct view *view = &job->prepared.views[segment->view];
	const int32_t *place = sample_places[sample], *scissor = job->prepared.scene_views[segment->view].scissor;
	int32_t from_below = job->scene->samples_from_below != 0, left = leaks(scissor[0], place[0]);
	int32_t row = leaks(from_below ? scissor[1] : (int32_t)job->height - scissor[1] - scissor[3], place[1]);

	view->sample[0] = place[0];
	view->sample[1] = from_below ? place[1] : -place[1];
	view->scissor[0] = scissor[0] - left;
	view->scissor[1] = scissor[1] - (from_below ? row : 0);
	view->scissor[2] = scissor[2] + left;
	view->scissor[3] = scissor[3] + row;
	return device_write(job->tr->dev, job->tr->buffers.views.buffer, segment->view * sizeof(*view), view, sizeof(*view));
}

/* n_cleared: how many of its clears are done */
static int run_segment(struct job *job, const struct segment *segment, uint32_t n_cleared)
{
	int err = 0;

	for (uint32_t i = n_cleared; i < segment->clear_count && !err; i++)
		err = run_clear(job, &job->scene->clears[segment->clear_first + i]);
	if (err || segment->view == SCENE_NONE || segment->instance_count == 0)
		return err;
	if (rectangle_area(view_rectangle(job, &job->prepared.views[segment->view])) == 0)
		return 0;
	draw_to(job, 0, segment->multisample && job->pass ? (job->pass % SCENE_SAMPLES + 1) << 24 : 0);
	if (!segment->multisample || job->n_samples == 1)
		return run_draws(job, segment);
	for (uint32_t i = 0; i < job->n_samples && !err; i++) {
		draw_to(job, i, (i + 1) << 24);
		err = look_at_sample(job, segment, i);
		if (!err)
			err = run_draws(job, segment);
	}
	return err;
}

/* --- Frames -------------------------------------------------------------------------------------------------------- */

static int reserve_pixels(struct job *job)
{
	struct tracer *tr = job->tr;
	int err = 0;

	if (job->n_pixels > tr->n_counted) {
		free(tr->counts);
		free(tr->first);
		tr->n_counted = 0;
		tr->counts = malloc(job->n_pixels * sizeof(*tr->counts));
		tr->first = malloc(job->n_pixels * sizeof(*tr->first));
		if (!tr->counts || !tr->first)
			return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", job->width, job->height);
		tr->n_counted = job->n_pixels;
	}
	err = frame_reserve(tr, counts, job->n_pixels);
	if (!err)
		err = frame_reserve(tr, frame, job->n_pixels);
	for (uint32_t i = 0; i < job->n_samples && !err; i++)
		err = launch_reserve(tr->dev, *sample_buffer(job, i), job->n_pixels);
	if (!err && job->n_passes > 1)
		err = frame_reserve(tr, sums, (size_t)job->n_pixels * PASS_PARTS);
	if (!err)
		err = frame_reserve(tr, visibility, 3);
	return err;
}

/* Whether of the buffers that it clears nothing is left. */
static int clears_whole(const struct job *job, const struct scene_clear *clear)
{
	const int32_t *s = clear->scissor;
	const uint32_t stencil = pixel_bits_mask(pixel_stencil_bits(job->bits));

	return clear->target == 0 && s[0] <= 0 && s[1] <= 0 && s[0] + s[2] >= (int32_t)job->width &&
	       s[1] + s[3] >= (int32_t)job->height && (!(clear->buffers & 1) || (clear->color_mask & 15) == 15) &&
	       (!(clear->buffers & 4) || (clear->stencil_mask & stencil) == stencil);
}

/*
 * What nobody cleared is black, far and nothing. Where the first segment begins with clears of the whole picture, as most frames do,
 * theirs is done at once.
 * @param n_done  receives how many of its clears that are
 */
static int clear_all(struct job *job, uint32_t *n_done)
{
	const struct segment *segment = job->prepared.segments;
	struct scene_clear clear = { .buffers = 7, .scissor = { 0, 0, (int32_t)job->width, (int32_t)job->height },
		                     .depth = 1, .color_mask = 15, .stencil_mask = 0xffffffffu, .floats = job->scene->floats };

	for (*n_done = 0; job->prepared.n_segments && *n_done < segment->clear_count; ++*n_done) {
		const struct scene_clear *next = &job->scene->clears[segment->clear_first + *n_done];

		if (!clears_whole(job, next))
			break;
		if (next->buffers & 1)
			memcpy(clear.color, next->color, sizeof(clear.color));
		if (next->buffers & 2)
			clear.depth = next->depth;
		if (next->buffers & 4)
			clear.stencil = next->stencil;
	}
	return run_clear(job, &clear);
}

/* Pixels as a picture has them; NULL: not known. */
static void start_pixels(const struct job *job, const struct scene_picture *start, struct frame_pixel *pixels)
{
	uint32_t depth_bits = pixel_depth_bits(job->bits), far = pixel_bits_mask(depth_bits);

	memset(pixels, 0, job->n_pixels * sizeof(*pixels));
	for (uint32_t i = 0; i < job->n_pixels; i++) {
		struct frame_pixel *p = &pixels[i];

		p->surface.order = SCENE_NONE;
		p->unknown = start ? PIXEL_BEFORE : PIXEL_UNKNOWN_COLOR | PIXEL_UNKNOWN_DEPTH | PIXEL_UNKNOWN_STENCIL;
		for (int c = 0; c < 4 && start; c++)
			p->gl[c] = start->colors ? start->colors[4 * (size_t)i + (size_t)c] : (float)start->rgba[4 * (size_t)i + (size_t)c] / 255.0f;
		memcpy(p->shadowed, p->gl, sizeof(p->shadowed));
		memcpy(p->direct, p->gl, sizeof(p->direct));
		memcpy(p->mirrored, p->gl, sizeof(p->mirrored));
		memcpy(p->beauty, p->gl, sizeof(p->beauty));
		p->depth = !start ? far : depth_bits > 24 ? start->depth[i] << 8 | start->depth[i] >> 16 : start->depth[i];
		p->depth_exact = far ? (float)p->depth / (float)far : 1;
		p->stencil = start ? start->stencil[i] : 0;
	}
}

/* Put the pixels on the device that were there before the scene, or say that they are not known. */
static int upload_start(struct job *job)
{
	const struct scene_picture *start = job->scene->start;
	struct frame_pixel *pixels = malloc(job->n_pixels * sizeof(*pixels));
	int err = 0;

	if (!pixels)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", job->width, job->height);
	for (uint32_t i = 0; i < job->n_samples && !err; i++) {
		if (i == 0 || (start && start->samples))
			start_pixels(job, start && start->samples && job->n_samples > 1 ? &start->samples[i] : start, pixels);
		err = device_write(job->tr->dev, sample_buffer(job, i)->buffer, 0, pixels, job->n_pixels * sizeof(*pixels));
	}
	free(pixels);
	return err;
}

/* The samples of all pixels into the frame. */
static int run_merge_samples(struct job *job)
{
	const struct frame_buffers *b = &job->tr->buffers;

	return launch_merge_samples(job->tr->dev, job->n_pixels,
	                            LAUNCH(merge_samples, .first = b->samples[0], .second = b->samples[1], .third = b->samples[2],
	                                   .fourth = b->samples[3], .n = job->n_pixels, .frame = b->frame));
}

/* The pixels of this pass to those of the passes before. */
static int run_add_pass(struct job *job, uint32_t first)
{
	const struct frame_buffers *b = &job->tr->buffers;

	return launch_add_pass(job->tr->dev, job->n_pixels, LAUNCH(add_pass, .frame = b->frame, .turn = job->turn, .first = first,
	                                                           .n = job->n_pixels, .sums = b->sums));
}

/* --- The picture from the device ----------------------------------------------------------------------------------- */

/*
 * Eye space stands for the world: OpenEXR's worldToCamera is left-handed (+z forward), its worldToNDC has x and y in
 * [0,1] with y down; both for row vectors, whose rows are our columns.
 */
static int describe_camera(const struct job *job, struct image *img)
{
	const float *p;
	float ndc[16];

	if (job->scene->n_views == 0)
		return 0;
	p = job->scene->views[0].projection;
	for (int col = 0; col < 4; col++) {
		float w = p[4 * col + 3];

		ndc[4 * col] = 0.5f * (p[4 * col] + w);
		ndc[4 * col + 1] = 0.5f * (w - p[4 * col + 1]);
		ndc[4 * col + 2] = p[4 * col + 2];
		ndc[4 * col + 3] = w;
	}
	if (image_set_attribute(img, "worldToCamera", "1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1"))
		return ERR_SYSTEM;
	return image_set_attribute(img, "worldToNDC", "%g %g %g %g %g %g %g %g %g %g %g %g %g %g %g %g", (double)ndc[0],
	                           (double)ndc[1], (double)ndc[2], (double)ndc[3], (double)ndc[4], (double)ndc[5],
	                           (double)ndc[6], (double)ndc[7], (double)ndc[8], (double)ndc[9], (double)ndc[10],
	                           (double)ndc[11], (double)ndc[12], (double)ndc[13], (double)ndc[14], (double)ndc[15]);
}

static int describe_image(const struct job *job, struct image *img)
{
	int err = image_set_attribute(img, "relume:frame", "%llu", (unsigned long long)job->scene->frame);

	if (!err)
		err = image_set_attribute(img, "relume:device", "%s", device_name(job->tr->dev));
	if (!err)
		err = image_set_attribute(img, "relume:encoding", "%s", job->options->display ? "display" : "linear");
	return err ? err : describe_camera(job, img);
}

static void count_undrawn(struct job *job)
{
	const struct scene *scene = job->scene;

	for (uint32_t i = 0; i < scene->n_instances; i++)
		job->tr->undrawn.targets += scene->views[scene->instances[i].view].target != 0;
}

/* Changes whenever a scene shows something else. */
static uint64_t events_of(const struct scene *scene)
{
	return 2 * ((uint64_t)scene->n_instances + scene->n_clears) + (scene->start != NULL);
}

/* Pixels of the frame on the device, or of one of their samples, rounded as GL's frame buffer is. */
static int read_pixels(struct tracer *tr, union buffer_frame_pixel from, const struct scene *scene, struct frame_pixel *pixels,
                       struct scene_picture *picture)
{
	size_t n = (size_t)scene->width * scene->height;
	int err = device_read(tr->dev, from.buffer, 0, pixels, n * sizeof(*pixels));

	picture->unknown = 0;
	for (size_t i = 0; i < n && !err; i++) {
		for (int c = 0; c < 4; c++)
			picture->rgba[4 * i + (size_t)c] = (uint8_t)rintf(clamp01(pixels[i].gl[c]) * 255.0f);
		if (picture->colors)
			memcpy(picture->colors + 4 * i, pixels[i].gl, sizeof(pixels[i].gl));
		if (!scene->alpha_bits)
			picture->rgba[4 * i + 3] = 255;
		if (!scene->alpha_bits && picture->colors)
			picture->colors[4 * i + 3] = 1;
		picture->depth[i] = scene->depth_bits > 24 ? pixels[i].depth >> 8 : pixels[i].depth; /* pictures have 24 at most */
		picture->stencil[i] = (uint8_t)pixels[i].stencil;
		picture->unknown += (pixels[i].unknown & (PIXEL_UNKNOWN_COLOR | PIXEL_UNKNOWN_TEST)) != 0;
	}
	return err;
}

static int read_picture(struct tracer *tr, const struct scene *scene, struct scene_picture *picture)
{
	struct frame_pixel *pixels = malloc((size_t)scene->width * scene->height * sizeof(*pixels));
	int err;

	if (!pixels)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", scene->width, scene->height);
	err = read_pixels(tr, tr->buffers.frame, scene, pixels, picture);
	for (uint32_t i = 0; i < SCENE_SAMPLES && picture->samples && scene->samples > 1 && !err; i++)
		err = read_pixels(tr, tr->buffers.samples[i], scene, pixels, &picture->samples[i]);
	free(pixels);
	return err;
}

/* One look at the frame, into buffers.frame. */
static int trace_pass(struct job *job)
{
	float shift[2] = { 0, 0 };
	uint32_t n_cleared = 0;
	int err;

	if (job->pass > 0)
		sample_shift(job->turn, job->pass, shift);
	/* Of several passes each looks at one place in a pixel; the one that makes GL's picture has GL's samples. */
	job->n_samples = job->scene->samples > 1 && job->pass == 0 ? SCENE_SAMPLES : 1;
	err = prepare_frame(job->scene, shift, &job->prepared);
	if (err)
		return err;
	if (job->pass == 0)
		count_undrawn(job);
	job->expanded = calloc(job->prepared.n_instances + (size_t)1, sizeof(*job->expanded));
	job->extra = calloc(job->prepared.n_instances + (size_t)1, sizeof(*job->extra));
	if (!job->expanded || !job->extra)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = upload_state(job);
	if (!err)
		err = place_geometry(job);
	if (!err)
		err = reserve_pixels(job);
	if (!err)
		err = job->scene->start || job->scene->needs_previous ? upload_start(job) : clear_all(job, &n_cleared);
	for (uint32_t i = 0; i < job->prepared.n_segments && !err; i++)
		err = run_segment(job, &job->prepared.segments[i], i == 0 ? n_cleared : 0);
	draw_to(job, 0, 0);
	if (!err && job->n_samples > 1)
		err = run_merge_samples(job);
	for (uint32_t i = 0; i < job->prepared.n_instances && job->expanded; i++)
		expanded_free(&job->expanded[i]);
	free(job->expanded);
	free(job->extra);
	prepared_free(&job->prepared);
	return err;
}

static int check_size(const struct scene *scene)
{
	if (scene->width && scene->height && scene->width <= 16384 && scene->height <= 16384)
		return 0;
	return err_report(ERR_SYSTEM, NULL, "frame %llu: %u x %u pixels cannot be rendered",
	                  (unsigned long long)scene->frame, scene->width, scene->height);
}

int tracer_render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture)
{
	const struct tracer_options options = { .mode = TRACER_GL };
	struct job job = { .tr = tracer, .scene = scene, .options = &options, .width = scene->width,
		           .height = scene->height, .n_pixels = scene->width * scene->height, .n_passes = 1 };
	int err = check_size(scene);

	/* The frame that was rendered last is often the one that the next begins with. */
	if (err || (scene->serial && tracer->drawn_serial == scene->serial && tracer->drawn_events == events_of(scene)))
		return err ? err : read_picture(tracer, scene, picture);
	tracer->drawn_serial = 0;
	job.bits = scene->depth_bits | scene->stencil_bits << 8 | scene->alpha_bits << 16;
	err = trace_pass(&job);
	if (!err) {
		tracer->drawn_serial = scene->serial;
		tracer->drawn_events = events_of(scene);
	}
	return err ? err : read_picture(tracer, scene, picture);
}

int tracer_render(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                  struct image *img)
{
	struct tracer_options known = *options;
	struct scene changed = { .instances = NULL };
	struct job job = { .tr = tracer, .scene = scene, .options = &known, .width = scene->width,
		           .height = scene->height, .n_passes = options->samples ? options->samples : 1 };
	int err = 0;

	if (check_size(scene) != 0)
		return ERR_SYSTEM;
	tracer->drawn_serial = 0;
	if (known.rays == 0)
		known.rays = 16;
	job.n_pixels = scene->width * scene->height;
	job.bits = scene->depth_bits | scene->stencil_bits << 8 | scene->alpha_bits << 16;
	img->width = job.width;
	img->height = job.height;
	if (options->look) {
		err = look_apply(options->look, scene, &changed);
		job.scene = &changed;
	}
	/* The pass through pixel centres comes last: what is no mean is its own. */
	for (job.pass = job.n_passes - 1; job.pass > 0 && !err; job.pass--)
		for (job.turn = 0; job.turn < SAMPLE_TURNS && !err; job.turn++) {
			err = trace_pass(&job);
			if (!err)
				err = run_add_pass(&job, job.pass == job.n_passes - 1);
		}
	if (!err)
		err = trace_pass(&job);
	if (!err)
		err = compose_image(&job, img);
	if (!err)
		err = describe_image(&job, img);
	if (options->look && changed.instances)
		look_release(&changed);
	if (err)
		image_free(img);
	return err;
}
