#include "tracer/frame/picture/compose.h"

#include <math.h>
#include <string.h>

#include "base/err.h"
#include "kernels/frame/dome/dome.h"
#include "kernels/frame/stages/compose.h"
#include "tracer/frame/light/dome.h"
#include "tracer/frame/light/secondary.h"
#include "tracer/frame/picture/added.h"
#include "tracer/frame/picture/buffers.h"

const char *const compose_groups[] = { "gl", "shadow", "relight", "reflect", "refract", "Z", "N", "P", "albedo", "id",
	                               "layers", NULL };

/* All channels, with their group, the plane that the kernel writes them to, and whether it has floats. */
static const struct channel {
	const char *group, *name;
	int full;
	uint32_t plane;
} channels[] = {
	{ "", "R", 0, COMPOSE_BEAUTY },
	{ "", "G", 0, COMPOSE_BEAUTY + 1 },
	{ "", "B", 0, COMPOSE_BEAUTY + 2 },
	{ "", "A", 0, COMPOSE_BEAUTY + 3 },
	{ "gl", "gl.R", 0, COMPOSE_GL },
	{ "gl", "gl.G", 0, COMPOSE_GL + 1 },
	{ "gl", "gl.B", 0, COMPOSE_GL + 2 },
	{ "gl", "gl.A", 0, COMPOSE_GL + 3 },
	{ "gl", "gl.depth", 1, COMPOSE_DEPTH },
	{ "shadow", "shadow.R", 0, COMPOSE_SHADOW },
	{ "shadow", "shadow.G", 0, COMPOSE_SHADOW + 1 },
	{ "shadow", "shadow.B", 0, COMPOSE_SHADOW + 2 },
	{ "relight", "relight.R", 0, COMPOSE_RELIGHT },
	{ "relight", "relight.G", 0, COMPOSE_RELIGHT + 1 },
	{ "relight", "relight.B", 0, COMPOSE_RELIGHT + 2 },
	{ "reflect", "reflect.R", 0, COMPOSE_REFLECT },
	{ "reflect", "reflect.G", 0, COMPOSE_REFLECT + 1 },
	{ "reflect", "reflect.B", 0, COMPOSE_REFLECT + 2 },
	{ "refract", "refract.R", 0, COMPOSE_REFRACT },
	{ "refract", "refract.G", 0, COMPOSE_REFRACT + 1 },
	{ "refract", "refract.B", 0, COMPOSE_REFRACT + 2 },
	{ "Z", "Z", 1, COMPOSE_Z },
	{ "N", "N.X", 0, COMPOSE_NORMAL },
	{ "N", "N.Y", 0, COMPOSE_NORMAL + 1 },
	{ "N", "N.Z", 0, COMPOSE_NORMAL + 2 },
	{ "P", "P.X", 1, COMPOSE_POSITION },
	{ "P", "P.Y", 1, COMPOSE_POSITION + 1 },
	{ "P", "P.Z", 1, COMPOSE_POSITION + 2 },
	{ "albedo", "albedo.R", 0, COMPOSE_ALBEDO },
	{ "albedo", "albedo.G", 0, COMPOSE_ALBEDO + 1 },
	{ "albedo", "albedo.B", 0, COMPOSE_ALBEDO + 2 },
	{ "id", "id", 1, COMPOSE_ID },
	{ "layers", "layers", 1, COMPOSE_LAYERS },
};
#define N_CHANNELS (sizeof(channels) / sizeof(channels[0]))

static int has_group(const char *aov, const char *group)
{
	size_t n = strlen(group);

	if (!aov || n == 0)
		return 1;
	for (const char *at = aov; at; at = strchr(at, ',')) {
		at += *at == ',';
		if (strncmp(at, group, n) == 0 && (at[n] == ',' || at[n] == '\0'))
			return 1;
	}
	return 0;
}

int compose_asks(const struct tracer_options *options, const char *group)
{
	return has_group(options->mode == TRACER_NORMALS ? "Z,N,P,albedo,id" : options->aov, group);
}

/* Request the planes that are wanted, one after the other; none for a picture (pass.picture). */
static struct compose_request request_of(const struct band *band)
{
	const struct tracer_options *options = band->frame->options;
	struct compose_request r = { .width = band->frame->width, .height = band->n_rows, .n_passes = band->pass->count,
		                     .display = (uint32_t)options->display, .normals = options->mode == TRACER_NORMALS,
		                     .radiant = secondary_transport(options) == TRANSPORT_LINEAR };

	memset(r.half_plane, 0xff, sizeof(r.half_plane));
	memset(r.float_plane, 0xff, sizeof(r.float_plane));
	for (size_t i = 0; i < N_CHANNELS; i++) {
		if (!band->pass->image ||
		    !(compose_asks(options, channels[i].group) || added_needs(band->pass, channels[i].group)))
			continue;
		if (channels[i].full)
			r.float_plane[channels[i].plane] = r.n_floats++ * band->n_pixels;
		else
			r.half_plane[channels[i].plane] = r.n_halves++ * band->n_pixels;
	}
	return r;
}

static int run_compose(const struct band *band, const struct compose_planes *to, union buffer_frame_pixel cleared,
                       union buffer_uint drawn)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	const struct compose_launch *a =
		LAUNCH(compose, .tables = frame_tables(tr), .windows = tr->placed.windows, .frame = tr->pixels.frame,
	               .cleared = cleared, .drawn = drawn, .sums = tr->picture->sums,
	               .first_pixel = frame_first_pixel(band), .request = to->request, .n = band->n_pixels,
	               .halves = to->halves, .floats = to->floats);

	if (frame_in_packets(frame) && !to->request.radiant)
		return launch_compose_packet(tr->dev, compose_items(frame->width, band->n_rows), a);
	return launch_compose(tr->dev, band->n_pixels, a);
}

/*
 * Eye space is used as world space. OpenEXR's worldToCamera is left-handed (+z forward); its worldToNDC has x and y in
 * [0,1] with y down. Both are for row vectors: their rows are our columns.
 */
static int describe_camera(const struct frame *frame, struct image *img)
{
	const float *p;
	float ndc[16];

	if (frame->scene->n_views == 0)
		return 0;
	p = frame->scene->views[0].projection;
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

static int describe_image(const struct frame *frame, struct image *img)
{
	int err = image_set_attribute(img, "relume:frame", "%llu", (unsigned long long)frame->scene->frame);

	if (!err)
		err = image_set_attribute(img, "relume:device", "%s", device_name(frame->tr->dev));
	if (!err)
		err = image_set_attribute(img, "relume:encoding", "%s", frame->options->display ? "display" : "linear");
	/* needed by gate R5 (diff/score/depth.c) */
	if (!err && frame->scene->keeps_depth && !frame->scene->needs_previous)
		err = image_set_attribute(img, "relume:unknown", "depth");
	if (!err && dome_is_there(frame)) /* needed by gate N (diff/score/harm.c) */
		err = image_set_attribute(
			img, "relume:dimmed", "%.3g",
			(double)(sqrtf(DOME_LEFT) * frame->scene->dome.lit + 1 - frame->scene->dome.lit));
	return err ? err : describe_camera(frame, img);
}

int compose_start(const struct frame *frame, struct image *img)
{
	int err = 0;

	img->width = frame->width;
	img->height = frame->height;
	for (size_t i = 0; i < N_CHANNELS && !err; i++) {
		const struct channel *c = &channels[i];

		if (!compose_asks(frame->options, c->group))
			continue;
		if (!(c->full ? (void *)image_add_channel(img, c->name, 1) : (void *)image_add_halves(img, c->name)))
			err = ERR_SYSTEM;
	}
	return err ? err : describe_image(frame, img);
}

int compose_reserve(const struct band *band, struct compose_planes *out)
{
	struct device *dev = band->frame->tr->dev;
	struct picture_buffers *b = band->frame->tr->picture;
	int err;

	out->request = request_of(band);
	err = launch_reserve(dev, b->halves, (size_t)out->request.n_halves * band->n_pixels);
	if (!err)
		err = launch_reserve(dev, b->floats, (size_t)out->request.n_floats * band->n_pixels);
	out->halves = b->halves;
	out->floats = b->floats;
	return err;
}

int compose_fetch(const struct band *band, const struct compose_planes *from)
{
	const struct frame *frame = band->frame;
	const struct compose_request *request = &from->request;
	const void *halves, *floats, *planes[N_CHANNELS];
	size_t n = 0;
	int err, unmapped;

	/* the next map waits for both */
	err = device_map(frame->tr->dev, from->floats.buffer, band->n_pixels * request->n_floats * sizeof(float), 0,
	                 &floats);
	if (err)
		return err;
	err = device_map(frame->tr->dev, from->halves.buffer, band->n_pixels * request->n_halves * sizeof(uint16_t), 1,
	                 &halves);
	if (!err) {
		for (size_t i = 0; i < N_CHANNELS; i++) {
			const struct channel *c = &channels[i];

			if (compose_asks(frame->options, c->group))
				planes[n++] = c->full ? (const void *)((const float *)floats +
				                                       request->float_plane[c->plane]) :
				                        (const void *)((const uint16_t *)halves +
				                                       request->half_plane[c->plane]);
		}
		added_take(band, request, halves);
		err = image_take_rows(band->pass->image, planes, band->n_rows);
		unmapped = device_unmap(frame->tr->dev, from->halves.buffer, halves);
		err = err ? err : unmapped;
	}
	unmapped = device_unmap(frame->tr->dev, from->floats.buffer, floats);
	return err ? err : unmapped;
}

int compose_band(const struct band *band, union buffer_frame_pixel cleared, union buffer_uint drawn)
{
	struct tracer *tr = band->frame->tr;
	struct compose_planes planes;
	int err = compose_reserve(band, &planes);

	if (!err)
		err = launch_reserve(tr->dev, tr->picture->sums, 1); /* with a single pass, it does not exist yet */
	if (!err)
		err = run_compose(band, &planes, cleared, drawn);
	return err ? err : compose_fetch(band, &planes);
}

int compose_reserve_sums(const struct frame *frame)
{
	return launch_reserve(frame->tr->dev, frame->tr->picture->sums,
	                      (size_t)frame->width * frame->height * PASS_PARTS);
}

int compose_add_pass(const struct band *band)
{
	const struct frame *frame = band->frame;

	return launch_add_pass(frame->tr->dev, band->n_pixels,
	                       LAUNCH(add_pass, .frame = frame->tr->pixels.frame, .turn = band->pass->turn,
	                              .first = band->pass->is_first, .first_pixel = frame_first_pixel(band),
	                              .radiant = secondary_transport(frame->options) == TRANSPORT_LINEAR,
	                              .n = band->n_pixels, .sums = frame->tr->picture->sums));
}
