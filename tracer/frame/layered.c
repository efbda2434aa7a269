#include "tracer/frame/layered.h"

#include <string.h>

#include "kernels/camera/camera.h"
#include "kernels/frame/plain.h"
#include "kernels/gl/pixel.h"
#include "tracer/frame/compose.h"
#include "tracer/frame/dome.h"
#include "tracer/frame/plain.h"
#include "tracer/frame/secondary.h"
#include "tracer/frame/segment.h"

/* The looks at a band: plain_launch.n_looks, columns and asking, and the space that rays to lights go through. */
struct looks {
	uint32_t n, columns, asking;
	const struct accel_space *space;
};

/* Whether kernels know all that a material asks of the frame buffer. */
static int is_known(const struct job *job, const struct scene_material *m)
{
	return !(m->stencil_test && pixel_stencil_bits(job->bits)) && !m->logic_op && !m->floats && !m->samples_off && !m->alpha_to_coverage &&
	       !m->alpha_to_one && !(m->surface.transmit > 0 && m->blend);
}

static const struct accel_space *space_of(const struct job *job, const struct segment *segment)
{
	return job->options->mode == TRACER_GL ? NULL : secondary_space(job, segment->view, 0);
}

/* Whether rays to lights all go through the same space. */
static int has_one_space(const struct job *job)
{
	const struct accel_space *space = NULL;

	for (uint32_t i = 0; i < job->prepared.n_segments; i++) {
		const struct segment *segment = &job->prepared.segments[i];
		const struct accel_space *own = segment->view == SCENE_NONE ? NULL : space_of(job, segment);

		if (own && space && own != space)
			return 0;
		space = own ? own : space;
	}
	return 1;
}

int layered_suits(const struct job *job)
{
	const struct prepared *p = &job->prepared;

	if (!plain_is_simple(job) || dome_is_there(job) || p->has_mirrors || p->has_fragment_programs || p->has_vertex_programs ||
	    !has_one_space(job))
		return 0;
	for (uint32_t i = 0; i < p->n_instances; i++)
		if (!is_known(job, &job->scene->materials[p->instances[i].material]))
			return 0;
	return 1;
}

int layered_has_columns(const struct job *job)
{
	int columns = 0;

	for (uint32_t i = 0; i < job->prepared.n_segments; i++)
		columns |= job->prepared.segments[i].mode == CAMERA_COLUMN;
	return columns && layered_suits(job);
}

/* --- Looks --------------------------------------------------------------------------------------------------------- */

/* Room for one look more, and nothing in it. */
static int reserve_look(struct job *job, const struct looks *looks)
{
	struct tracer *tr = job->tr;
	const uint32_t first = plain_look_first(looks->columns, looks->n, job->n_pixels);
	const size_t bytes = job->n_pixels * sizeof(*tr->counts);

	memset(tr->counts, 0, bytes);
	return device_write(tr->dev, tr->buffers.counts.buffer, first * sizeof(*tr->counts), tr->counts, bytes);
}

/* Room for all that there may be. */
static int reserve(struct job *job)
{
	struct tracer *tr = job->tr;
	const size_t n = (size_t)PLAIN_LOOKS * job->n_pixels;
	int err = frame_reserve(tr, counts, n * CAMERA_COLUMN_MAX);

	if (!err)
		err = frame_reserve(tr, after, n);
	return err ? err : frame_reserve(tr, sparse, n * CAMERA_COLUMN_MAX);
}

/* Add a look's counts, in tracer.counts, to the layers of blocks, in tracer.first. @return 1 where a pixel has `full` */
static int add_layers(struct job *job, uint32_t full)
{
	const uint32_t columns = plain_columns(job->width);
	int is_full = 0;

	for (uint32_t y0 = 0; y0 < job->n_rows; y0 += PLAIN_ROWS)
		for (uint32_t x0 = 0; x0 < job->width; x0 += PLAIN_WIDTH) {
			uint32_t most = 0;

			for (uint32_t y = y0; y < y0 + PLAIN_ROWS && y < job->n_rows; y++)
				for (uint32_t x = x0; x < x0 + PLAIN_WIDTH && x < job->width; x++)
					most = job->tr->counts[y * job->width + x] > most ? job->tr->counts[y * job->width + x] : most;
			job->tr->first[y0 / PLAIN_ROWS * columns + x0 / PLAIN_WIDTH] += most;
			is_full |= most == full;
		}
	return is_full;
}

/* Where columns go on that the last look filled; tracer.counts has its counts. */
static int go_on(struct job *job, const struct looks *looks)
{
	struct tracer *tr = job->tr;
	const uint32_t from = plain_look_first(looks->columns, looks->n - 1, job->n_pixels);
	const struct fragment *sparse;
	const void *mapped;
	int err = device_map(tr->dev, tr->buffers.sparse.buffer, ((size_t)from + job->n_pixels) * CAMERA_COLUMN_MAX * sizeof(*sparse), &mapped);

	if (err)
		return err;
	sparse = mapped;
	for (uint32_t i = 0; i < job->n_pixels; i++)
		tr->counts[i] = tr->counts[i] == CAMERA_COLUMN_MAX ? sparse[((size_t)from + i) * CAMERA_COLUMN_MAX + CAMERA_COLUMN_MAX - 1].order + 1 : SCENE_NONE;
	return device_unmap(tr->dev, tr->buffers.sparse.buffer, mapped);
}

/* Look at a segment, as often as its columns ask for. drawn: receives 0 where there are too many */
static int look_at(struct job *job, const struct segment *segment, struct looks *looks, int *drawn)
{
	struct tracer *tr = job->tr;
	const struct camera_rectangle r = segment_rectangle(job, job->prepared.views[segment->view].scissor);
	const struct accel_space *space = space_of(job, segment);
	const uint32_t is_column = segment->mode == CAMERA_COLUMN;
	const size_t bytes = job->n_pixels * sizeof(*tr->counts);
	int err = 0, more = r.x0 < r.x1;

	memset(tr->counts, 0, bytes); /* columns begin with the first fragment */
	while (more && !err) {
		uint32_t first;

		*drawn = looks->n < PLAIN_LOOKS;
		if (!*drawn)
			return 0;
		looks->columns |= is_column << looks->n;
		looks->asking |= (space != NULL) << looks->n;
		looks->space = space ? space : looks->space;
		first = plain_look_first(looks->columns, looks->n, job->n_pixels);
		if (is_column)
			err = device_write(tr->dev, tr->buffers.after.buffer, first * sizeof(*tr->counts), tr->counts, bytes);
		if (!err)
			err = reserve_look(job, looks);
		if (!err)
			err = segment_trace_camera(job, segment, r, first);
		if (!err)
			err = device_read(tr->dev, tr->buffers.counts.buffer, first * sizeof(*tr->counts), tr->counts, bytes);
		looks->n++;
		more = !err && add_layers(job, CAMERA_COLUMN_MAX) && is_column;
		if (more)
			err = go_on(job, looks);
	}
	return err;
}

/* All looks; the layers of blocks in tracer.first. */
static int look_around(struct job *job, struct looks *looks, int *drawn)
{
	int err = frame_reserve_counts(job);

	if (!err)
		err = reserve(job);
	if (!err)
		memset(job->tr->first, 0, plain_blocks(job->width, job->n_rows) * sizeof(*job->tr->first));
	*drawn = 1;
	for (uint32_t i = 0; i < job->prepared.n_segments && !err && *drawn; i++) {
		const struct segment *segment = &job->prepared.segments[i];

		if (segment->view != SCENE_NONE && segment->instance_count)
			err = look_at(job, segment, looks, drawn);
	}
	return err;
}

/* Give blocks with fragments their places, one a layer. n: receives the pixels of all of them. @return 0: a block has too many layers */
static int place_blocks(struct job *job, uint32_t *n)
{
	const uint32_t blocks = plain_blocks(job->width, job->n_rows);
	uint32_t next = 0;

	for (uint32_t i = 0; i < blocks; i++) {
		const uint32_t layers = job->tr->first[i];

		if (layers > PLAIN_LAYERS)
			return 0;
		job->tr->first[i] = layers ? next : SCENE_NONE;
		next += layers;
	}
	*n = (next ? next : 1) * PLAIN_WIDTH * PLAIN_ROWS;
	return 1;
}

/* --- Drawing ------------------------------------------------------------------------------------------------------- */

/* All planes without shadows, and rays to lights; then what shadows change. */
static int draw(struct job *job, const struct looks *looks, uint32_t n, struct compose_request *request)
{
	static const struct camera_rectangle nowhere;
	const uint32_t blocks = plain_blocks(job->width, job->n_rows), n_slots = looks->space ? job->prepared.n_light_slots : 0;
	struct plain_launch a;
	int err = plain_reserve(job, n, n_slots);

	if (err)
		return err;
	a = plain_launch_of(job, nowhere, n, n_slots, request);
	a.n_looks = looks->n;
	a.columns = looks->columns;
	a.asking = looks->asking;
	err = launch_layered(job->tr->dev, blocks, &a);
	if (err || !n_slots)
		return err;
	err = secondary_ask(job, looks->space, 1, a.rays, n * n_slots);
	if (err)
		return err;
	a.request = plain_shadow_request(a.request);
	return launch_layered_shadow(job->tr->dev, blocks, &a);
}

int layered_band(struct job *job, int *drawn)
{
	struct looks looks = { .n = 0 };
	struct compose_request request;
	uint32_t n;
	int err;

	*drawn = job->n_pixels <= 0xffffffffu / (PLAIN_LOOKS * CAMERA_COLUMN_MAX);
	if (!*drawn)
		return 0;
	/* As in plain_band. */
	err = job->row_first + job->n_rows < job->height && job->tr->buffers.cleared.buffer ? 0 : segment_clear_one(job);

	if (!err)
		err = look_around(job, &looks, drawn);
	*drawn = *drawn && (err || place_blocks(job, &n));
	if (err || !*drawn)
		return err;
	err = frame_upload(job->tr, blocks, job->tr->first, plain_blocks(job->width, job->n_rows));
	if (!err)
		err = compose_reserve(job, &request);
	if (!err)
		err = draw(job, &looks, n, &request);
	return err ? err : compose_fetch(job, &request, job->image);
}
