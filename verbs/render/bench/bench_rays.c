#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/progress.h"
#include "kernels/camera/camera.h"
#include "tracer/accel/bvh.h"
#include "tracer/frame/common/traverse.h"
#include "verbs/render/bench/bench.h"

#define NEAR 0.1f
#define FAR 100.0f
#define HALF_HEIGHT 0.4f /* tangent of half the angle of view, upright */
/* The point light, in eye space; rays keep this share of their length away from both ends. */
static const float light_eye[3] = { 3.0f, 5.0f, -2.0f };
#define KEEP_AWAY 1e-3f
#define AMBIENT_LENGTH 1.5f

struct bench_state {
	struct accel *accel;
	struct scene scene; /* one mesh, one instance, one view */
	struct scene_mesh mesh;
	const struct scene_mesh *mesh_list[1];
	struct scene_instance scene_instance;
	struct scene_view scene_view;
	struct instance instance;
	const struct accel_space *spaces;
	uint32_t n_spaces;
	uint64_t uploaded; /* generation of the pools on the device */

	float (*clip)[4];
	struct window_vertex *window;
	struct fragment *fragments; /* [pixel], of the picture that the other rays start from */

	struct traverse_trees trees;
	union buffer_view views;
	union buffer_window_vertex window_buffer;
	union buffer_float clip_buffer;
	union buffer_fragment fragment_buffer;
	union buffer_uint count_buffer;
	union buffer_ray rays[N_BENCH_RAY_KINDS];
	struct device_buffer *results; /* hits, or whether there is one */
};

static int out_of_memory(void)
{
	return err_report(ERR_SYSTEM, NULL, "out of memory");
}

static void set_view(struct bench *b)
{
	struct view *v = &b->view;
	const float half_width = HALF_HEIGHT * (float)b->width / (float)b->height;
	const float z_scale = (NEAR + FAR) / (NEAR - FAR), z_shift = 2 * NEAR * FAR / (NEAR - FAR);

	v->projection[0] = 1 / half_width;
	v->projection[5] = 1 / HALF_HEIGHT;
	v->projection[10] = z_scale;
	v->projection[11] = -1;
	v->projection[14] = z_shift;
	v->inverse[0] = half_width;
	v->inverse[5] = HALF_HEIGHT;
	v->inverse[11] = 1 / z_shift;
	v->inverse[14] = -1;
	v->inverse[15] = z_scale / z_shift;
	v->viewport[2] = (float)b->width;
	v->viewport[3] = (float)b->height;
	v->depth_range[1] = 1;
	v->scissor[2] = (int32_t)b->width;
	v->scissor[3] = (int32_t)b->height;
}

static void set_scene(struct bench *b)
{
	struct bench_state *s = b->state;

	s->mesh = (struct scene_mesh){ .hash = { 1, 1 }, .kind = SCENE_TRIANGLES, .vertex_count = b->mesh.n_vertices,
		                       .primitive_count = b->mesh.n_triangles, .position = b->mesh.position[0],
		                       .index = b->mesh.index[0] };
	s->mesh_list[0] = &s->mesh;
	s->scene.meshes = s->mesh_list;
	s->scene.instances = &s->scene_instance;
	s->scene.views = &s->scene_view;
	s->scene.n_meshes = s->scene.n_instances = s->scene.n_views = 1;
	s->instance.flags = INSTANCE_OPAQUE | INSTANCE_SECONDARY;
	/* 1/256 pixel at the far end of the floor. */
	s->instance.pad = 12 * 2 * HALF_HEIGHT / (float)b->height / 256;
	for (int i = 0; i < 3; i++)
		s->instance.eye_from_obj[5 * i] = s->instance.obj_from_eye[5 * i] = 1;
}

/* GL's vertex stage for positions alone: clip coordinates, and the window in 1/256 pixel. */
static void transform_vertices(const struct bench *b)
{
	const float *m = b->view.projection, w = 128 * (float)b->width, h = 128 * (float)b->height;

	for (uint32_t i = 0; i < b->mesh.n_vertices; i++) {
		const float *p = b->mesh.position[i];
		float *c = b->state->clip[i];
		struct window_vertex *v = &b->state->window[i];

		c[0] = m[0] * p[0];
		c[1] = m[5] * p[1];
		c[2] = m[10] * p[2] + m[14];
		c[3] = -p[2];
		if (!(c[2] >= -c[3] && c[2] <= c[3] && fabsf(c[0]) < 16 * c[3] && fabsf(c[1]) < 16 * c[3])) {
			v->w_inv = 0;
			continue;
		}
		v->w_inv = 1 / c[3];
		v->x = (int32_t)lrintf(c[0] * v->w_inv * w + w);
		v->y = (int32_t)lrintf(c[1] * v->w_inv * h + h);
		v->z = 0.5f * c[2] * v->w_inv + 0.5f;
	}
}

/* The cost of a new camera before its rays: vertices and top level, on the device. */
static int prepare_frame(struct bench *b)
{
	struct bench_state *s = b->state;
	struct accel *a = s->accel;
	int err = accel_build_frame(a, &s->scene, NULL, NULL, &s->instance, 1, &b->view, &s->spaces, &s->n_spaces);

	if (err)
		return err;
	transform_vertices(b);
	if ((err = launch_upload(b->dev, s->views, &b->view, 1)) ||
	    (err = traverse_upload_tlases(b->dev, a, &s->instance, 1, &s->trees)) ||
	    (err = launch_upload(b->dev, s->window_buffer, s->window, b->mesh.n_vertices)) ||
	    (err = launch_upload(b->dev, s->clip_buffer, s->clip[0], 4 * (size_t)b->mesh.n_vertices)))
		return err;
	if (a->generation == s->uploaded)
		return 0;
	s->uploaded = a->generation;
	return traverse_upload_pools(b->dev, a, &s->trees);
}

int bench_camera(struct bench *b, enum kernel kernel, double *seconds)
{
	struct bench_state *s = b->state;
	const struct camera_rectangle r = camera_rectangle(0, 0, (int32_t)b->width, (int32_t)b->height, b->width, b->height);
	const double start = progress_clock_s();
	int err = prepare_frame(b);

	if (!err)
		err = traverse_camera(b->dev, kernel, &s->trees, r,
		                      LAUNCH(camera_pass, .view_index = 0, .views = s->views, .width = b->width, .height = b->height,
		                             .rectangle = r, .first_pixel = 0, .mode = CAMERA_NEAREST_LESS,
		                             .window = s->window_buffer, .clip = s->clip_buffer,
		                             .after = s->count_buffer, .fragments = s->fragment_buffer, .counts = s->count_buffer));
	if (!err)
		err = device_finish(b->dev);
	*seconds = progress_clock_s() - start;
	return err;
}

int bench_rays(struct bench *b, enum kernel kernel, enum bench_ray_kind kind, double *seconds)
{
	struct bench_state *s = b->state;
	const struct traverse_rays rays = { .space = &s->spaces[0], .n = b->n_rays[kind], .rays = s->rays[kind],
		                            .occluded = { s->results }, .hits = { s->results } };
	const double start = progress_clock_s();
	int err = traverse_rays(b->dev, kernel, &s->trees, &rays);

	if (!err)
		err = device_finish(b->dev);
	*seconds = progress_clock_s() - start;
	return err;
}

int bench_count_camera_hits(struct bench *b, uint32_t *n)
{
	const size_t pixels = (size_t)b->width * b->height;
	uint32_t *counts = malloc(pixels * sizeof(*counts));
	int err = counts ? device_read(b->dev, b->state->count_buffer.buffer, 0, counts, pixels * sizeof(*counts)) :
	                   out_of_memory();

	*n = 0;
	for (size_t i = 0; i < pixels && !err; i++)
		*n += counts[i] != 0;
	free(counts);
	return err;
}

int bench_count_ray_hits(struct bench *b, enum kernel kernel, enum bench_ray_kind kind, uint32_t *n)
{
	const int occlude = kernel == KERNEL_occlude_packet || kernel == KERNEL_occlude_wide ||
	                    kernel == KERNEL_occlude_binary || kernel == KERNEL_occlude_compressed;
	const size_t bytes = b->n_rays[kind] * (occlude ? sizeof(uint32_t) : sizeof(struct hit));
	void *results = malloc(bytes + 1);
	int err = results ? device_read(b->dev, b->state->results, 0, results, bytes) : out_of_memory();

	*n = 0;
	for (uint32_t i = 0; i < b->n_rays[kind] && !err; i++)
		*n += occlude ? ((uint32_t *)results)[i] : ((struct hit *)results)[i].instance != SCENE_NONE;
	free(results);
	return err;
}

/* --- the rays that start where the picture was hit --------------------------------------------------------------- */

/* The point of a fragment, moved off the surface towards the viewer, and the surface's normal. */
static void hit_point(const struct bench *b, const struct fragment *f, float point[3], float normal[3])
{
	const uint32_t *index = b->mesh.index[FRAGMENT_PRIMITIVE(*f)];
	const float *p[3];
	float weight[3], e1[3], e2[3], length, facing = 0;

	fragment_weights(*f, b->state->window[index[0]].w_inv, b->state->window[index[1]].w_inv,
	                 b->state->window[index[2]].w_inv, weight);
	for (int i = 0; i < 3; i++)
		p[i] = b->mesh.position[index[i]];
	for (int a = 0; a < 3; a++) {
		point[a] = weight[0] * p[0][a] + weight[1] * p[1][a] + weight[2] * p[2][a];
		e1[a] = p[1][a] - p[0][a];
		e2[a] = p[2][a] - p[0][a];
	}
	normal[0] = e1[1] * e2[2] - e1[2] * e2[1];
	normal[1] = e1[2] * e2[0] - e1[0] * e2[2];
	normal[2] = e1[0] * e2[1] - e1[1] * e2[0];
	length = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
	for (int a = 0; a < 3; a++)
		facing -= normal[a] * point[a];
	for (int a = 0; a < 3 && length > 0; a++) {
		normal[a] /= facing < 0 ? -length : length;
		point[a] += KEEP_AWAY * normal[a];
	}
}

static struct ray shadow_ray(const float point[3])
{
	struct ray ray = { .t_min = KEEP_AWAY, .t_max = 1 - KEEP_AWAY };

	for (int a = 0; a < 3; a++) {
		ray.o[a] = point[a];
		ray.d[a] = light_eye[a] - point[a];
	}
	return ray;
}

/* The next number in [0,1) of a linear congruential sequence (Numerical Recipes' constants). */
static float next_random(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (float)(*state >> 8) / 16777216.0f;
}

/* A short ray into a random direction about the normal, denser where it is upright. */
static struct ray ambient_ray(const float point[3], const float normal[3], uint32_t *random)
{
	const float z = 2 * next_random(random) - 1, a = 6.2831853f * next_random(random), r = sqrtf(1 - z * z);
	const float d[3] = { normal[0] + r * cosf(a), normal[1] + r * sinf(a), normal[2] + z };
	const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) + 1e-6f;
	struct ray ray = { .t_min = KEEP_AWAY, .t_max = AMBIENT_LENGTH };

	for (int i = 0; i < 3; i++) {
		ray.o[i] = point[i];
		ray.d[i] = d[i] / length;
	}
	return ray;
}

/* Every other bit of a number: x of a place on a Morton curve, y with the number shifted. */
static uint32_t even_bits(uint32_t n)
{
	uint32_t out = 0;

	for (uint32_t bit = 0; bit < 16; bit++)
		out |= (n >> bit & 1) << (bit / 2) & (bit % 2 ? 0 : ~0u);
	return out;
}

/*
 * Pixels in tiles of 64 x 64, there in blocks of 4 x 2 along a Morton curve of 4 x 4 blocks first: eight, sixteen,
 * thirty-two or sixty-four consecutive rays belong to a compact patch, which packets of any kind like.
 */
static void make_rays(struct bench *b)
{
	const uint32_t tiles_x = (b->width + 63) / 64, tiles_y = (b->height + 63) / 64;
	uint32_t random = 1;

	for (uint32_t i = 0; i < tiles_x * tiles_y * 4096; i++) {
		const uint32_t tile = i / 4096, block = i % 4096 / 8, lane = i % 8;
		const uint32_t pair = block / 2, bx = even_bits(pair), by = 2 * even_bits(pair >> 1) + block % 2;
		const uint32_t x = tile % tiles_x * 64 + 4 * bx + lane % 4, y = tile / tiles_x * 64 + 2 * by + lane / 4;
		const struct fragment *f;
		float point[3], normal[3];

		if (x >= b->width || y >= b->height)
			continue;
		f = &b->state->fragments[(size_t)y * b->width + x];
		if (f->order == SCENE_NONE)
			continue;
		hit_point(b, f, point, normal);
		b->rays[BENCH_SHADOW][b->n_rays[BENCH_SHADOW]++] = shadow_ray(point);
		b->rays[BENCH_AMBIENT][b->n_rays[BENCH_AMBIENT]++] = ambient_ray(point, normal, &random);
	}
}

static int derive_rays(struct bench *b)
{
	const size_t pixels = (size_t)b->width * b->height;
	struct bench_state *s = b->state;
	int err = device_read(b->dev, s->fragment_buffer.buffer, 0, s->fragments, pixels * sizeof(*s->fragments));

	if (err)
		return err;
	for (int kind = 0; kind < N_BENCH_RAY_KINDS; kind++) {
		b->rays[kind] = malloc(pixels * sizeof(**b->rays));
		if (!b->rays[kind])
			return out_of_memory();
	}
	make_rays(b);
	for (int kind = 0; kind < N_BENCH_RAY_KINDS && !err; kind++)
		err = launch_upload(b->dev, s->rays[kind], b->rays[kind], b->n_rays[kind]);
	return err ? err : device_reserve(b->dev, &s->results, pixels * sizeof(struct hit));
}

int bench_create(struct device *dev, const char *models, uint32_t width, uint32_t height, struct bench **out)
{
	struct bench_mesh mesh;
	int err = bench_mesh_create(models, &mesh);

	return err ? err : bench_create_of(dev, &mesh, width, height, out);
}

int bench_create_of(struct device *dev, struct bench_mesh *mesh, uint32_t width, uint32_t height, struct bench **out)
{
	const size_t pixels = (size_t)width * height;
	struct bench *b = calloc(1, sizeof(*b));
	struct bench_state *s = b ? b->state = calloc(1, sizeof(*b->state)) : NULL;
	double seconds;
	int err;

	if (!s) {
		free(b);
		bench_mesh_free(mesh);
		return out_of_memory();
	}
	b->mesh = *mesh;
	*mesh = (struct bench_mesh){ 0 };
	b->dev = dev;
	b->width = width;
	b->height = height;
	s->clip = calloc(b->mesh.n_vertices, sizeof(*s->clip));
	s->window = calloc(b->mesh.n_vertices, sizeof(*s->window));
	s->fragments = malloc(pixels * sizeof(*s->fragments));
	if (!s->clip || !s->window || !s->fragments) {
		err = out_of_memory();
		goto fail;
	}
	set_view(b);
	set_scene(b);
	if ((err = accel_create(&s->accel)) ||
	    (err = launch_reserve(dev, s->fragment_buffer, pixels)) ||
	    (err = launch_reserve(dev, s->count_buffer, pixels)))
		goto fail;
	s->accel->wide = ACCEL_ROWS | ACCEL_COMPRESSED;
	b->build_s = progress_clock_s();
	err = accel_build_frame(s->accel, &s->scene, NULL, NULL, &s->instance, 1, &b->view, &s->spaces, &s->n_spaces);
	b->build_s = progress_clock_s() - b->build_s;
	if (!err)
		err = bench_camera(b, device_family(dev) == FAMILY_PACKETS ? KERNEL_camera_packet : KERNEL_camera_wide, &seconds);
	if (!err)
		err = derive_rays(b);
	if (err)
		goto fail;
	*out = b;
	return 0;
fail:
	bench_destroy(&b);
	return err;
}

/* How long the tree alone takes, and what it is like. */
static int measure_tree(struct bench *b, enum accel_kind kind, struct bench_tree *out)
{
	struct soup soup;
	struct tree tree = { NULL };
	int err = soup_make(&b->state->mesh, (const float (*)[4])b->mesh.position, &soup);

	out->build_s = progress_clock_s();
	out->build_cpu_s = progress_processor_s();
	if (!err)
		err = builders_make_tree(&soup, kind, b->state->mesh.hash, NULL, &tree);
	out->build_s = progress_clock_s() - out->build_s;
	out->build_cpu_s = progress_processor_s() - out->build_cpu_s;
	out->cost = err ? 0 : bvh_cost(tree.nodes, tree.n_nodes);
	out->n_items = tree.n_order;
	tree_free(&tree);
	soup_free(&soup);
	return err;
}

int bench_rebuild(struct bench *b, enum accel_kind kind, struct bench_tree *out)
{
	struct bench_state *s = b->state;
	const unsigned wide = s->accel->wide;
	const struct accel *a;
	int err = measure_tree(b, kind, out);

	accel_destroy(&s->accel);
	if (err || (err = accel_create(&s->accel)))
		return err;
	s->accel->wide = wide;
	s->accel->kind = kind;
	s->uploaded = 0;
	err = prepare_frame(b);
	a = s->accel;
	out->bytes = device_family(b->dev) == FAMILY_COMPRESSED
		? a->n_nodes8c * sizeof(*a->nodes8c) + a->n_triangles8c * sizeof(*a->triangles8c)
		: a->n_nodes2 * sizeof(*a->nodes2) + a->n_triangles * sizeof(*a->triangles);
	if (device_family(b->dev) == FAMILY_PACKETS)
		out->bytes += a->n_nodes8 * sizeof(*a->nodes8) + a->n_triangles8 * sizeof(*a->triangles8);
	return err;
}

static void release_buffers(struct device *dev, struct bench_state *s)
{
	struct device_buffer **buffers[] = {
		&s->views.buffer, &s->window_buffer.buffer, &s->clip_buffer.buffer, &s->fragment_buffer.buffer,
		&s->count_buffer.buffer, &s->rays[BENCH_SHADOW].buffer, &s->rays[BENCH_AMBIENT].buffer, &s->results,
	};

	for (size_t i = 0; i < sizeof(buffers) / sizeof(buffers[0]); i++)
		device_release(dev, buffers[i]);
	traverse_release(dev, &s->trees);
}

void bench_destroy(struct bench **bench)
{
	struct bench *b = *bench;

	*bench = NULL;
	if (!b)
		return;
	release_buffers(b->dev, b->state);
	for (int kind = 0; kind < N_BENCH_RAY_KINDS; kind++)
		free(b->rays[kind]);
	accel_destroy(&b->state->accel);
	bench_mesh_free(&b->mesh);
	free(b->state->clip);
	free(b->state->window);
	free(b->state->fragments);
	free(b->state);
	free(b);
}

static int compare_doubles(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;

	return (x > y) - (x < y);
}

double bench_median(double *values, size_t n)
{
	qsort(values, n, sizeof(*values), compare_doubles);
	return n == 0 ? 0 : n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}
