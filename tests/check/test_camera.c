/* The camera kernels against their C twins, and the twins against a loop over all triangles. */
#include "tests/check/random_scene.h"

#include "kernels/camera/camera.h"
#include "tests/case.h"
#include "tests/driver.h"
#include "tracer/frame/common/traverse.h"

#define WIDTH 75 /* not a multiple of a tile */
#define HEIGHT 53
#define PIXELS (WIDTH * HEIGHT)
#define GUARD 64
#define GUARD_WORD 0xa5a5a5a5u

struct result {
	struct fragment fragments[PIXELS * CAMERA_COLUMN_MAX + GUARD];
	uint32_t counts[PIXELS + GUARD];
};

struct frame {
	struct random_scene *s;
	float (*clip)[4];
	struct window_vertex *window;
	uint32_t *after;
};

static void set_view(struct view *v, int orthographic)
{
	const float near = 0.5f, far = 20, a = orthographic ? -2 / (far - near) : (near + far) / (near - far);
	const float b = orthographic ? (near + far) / (near - far) : 2 * near * far / (near - far);

	memset(v->projection, 0, sizeof(v->projection));
	memset(v->inverse, 0, sizeof(v->inverse));
	v->projection[0] = orthographic ? 0.3f : 1.0f;
	v->projection[5] = orthographic ? 0.4f : 1.3f;
	v->projection[10] = a;
	v->projection[14] = b;
	v->projection[orthographic ? 15 : 11] = orthographic ? 1 : -1;
	v->inverse[0] = 1 / v->projection[0];
	v->inverse[5] = 1 / v->projection[5];
	if (orthographic) {
		v->inverse[10] = 1 / a;
		v->inverse[14] = -b / a;
		v->inverse[15] = 1;
	} else {
		v->inverse[14] = -1;
		v->inverse[11] = 1 / b;
		v->inverse[15] = a / b;
	}
	v->viewport[0] = 3;
	v->viewport[1] = 2;
	v->viewport[2] = WIDTH - 5;
	v->viewport[3] = HEIGHT - 4;
	v->depth_range[0] = 0.1f;
	v->depth_range[1] = 0.9f;
	v->scissor[0] = 1;
	v->scissor[1] = 1;
	v->scissor[2] = WIDTH + 9; /* beyond the drawable */
	v->scissor[3] = HEIGHT - 2;
}

static void transform(struct frame *f)
{
	const struct view *v = &f->s->view;

	for (uint32_t k = 0; k < INSTANCES; k++) {
		const struct scene_mesh *mesh = f->s->mesh_list[f->s->scene_instances[k].mesh];
		const float *m = f->s->instances[k].eye_from_obj;

		for (uint32_t i = 0; i < mesh->vertex_count; i++) {
			const float *p = mesh->position + 4 * (size_t)i, *P = v->projection;
			float eye[4] = { 0, 0, 0, 1 }, *c = f->clip[f->s->instances[k].vertex_first + i];
			struct window_vertex *w = &f->window[f->s->instances[k].vertex_first + i];

			for (int row = 0; row < 3; row++)
				eye[row] = m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3];
			for (int row = 0; row < 4; row++)
				c[row] = P[row] * eye[0] + P[4 + row] * eye[1] + P[8 + row] * eye[2] + P[12 + row] * eye[3];
			memset(w, 0, sizeof(*w));
			if (!(c[2] >= -c[3] && c[2] <= c[3]))
				continue;
			w->w_inv = 1 / c[3];
			w->x = (int32_t)lrintf(256 * (v->viewport[0] + 0.5f * v->viewport[2] * (c[0] * w->w_inv + 1)));
			w->y = (int32_t)lrintf(256 * (v->viewport[1] + 0.5f * v->viewport[3] * (c[1] * w->w_inv + 1)));
			w->z = v->depth_range[0] + (v->depth_range[1] - v->depth_range[0]) * (0.5f * c[2] * w->w_inv + 0.5f);
		}
	}
}

/*
 * Columns start at some order number, those of every seventh pixel at a later one; when they continue, some have ended.
 */
static void begin_columns(struct frame *f, uint32_t least)
{
	for (uint32_t i = 0; i < PIXELS; i++)
		f->after[i] = i % 7 == 0 ? least + 100 : least && i % 31 == 0 ? SCENE_NONE : least;
}

static struct frame make_frame(uint32_t seed, int orthographic)
{
	struct frame f = { random_scene_create(seed), NULL, NULL, NULL };
	struct random_scene *s = f.s;

	/*
	 * Some instances near the viewer, so that triangles extend behind it; some with culling; one in window
	 * coordinates.
	 */
	set_view(&s->view, orthographic);
	s->instances[1].eye_from_obj[11] += 2;
	s->instances[3].flags |= INSTANCE_CULL_BACK;
	s->instances[4].flags |= INSTANCE_CULL_BACK | INSTANCE_FRONT_CW;
	for (int k = 0; k < INSTANCES; k++) {
		struct instance *i = &s->instances[k];

		for (int row = 0; row < 3; row++)
			i->obj_from_eye[4 * row + 3] = -(i->obj_from_eye[4 * row] * i->eye_from_obj[3] +
			                                 i->obj_from_eye[4 * row + 1] * i->eye_from_obj[7] +
			                                 i->obj_from_eye[4 * row + 2] * i->eye_from_obj[11]);
	}
	ck_assert_int_eq(accel_build_frame(s->accel, &s->scene, NULL, NULL, s->instances, INSTANCES, &s->view, &s->spaces,
	                                   &s->n_spaces), 0);
	f.clip = calloc(s->n_vertices, sizeof(*f.clip));
	f.window = calloc(s->n_vertices, sizeof(*f.window));
	f.after = calloc(PIXELS, sizeof(*f.after));
	begin_columns(&f, 0);
	transform(&f);
	return f;
}

/* Sample at an offset instead of pixel centres. */
static void look_aside(struct frame *f, int aside)
{
	f->s->view.sample[0] = aside ? -96 : 0;
	f->s->view.sample[1] = aside ? 32 : 0;
}

static void free_frame(struct frame *f)
{
	free(f->clip);
	free(f->window);
	free(f->after);
	random_scene_free(f->s);
}

static void run(const struct frame *f, struct device *dev, enum kernel kernel, uint32_t mode, struct result *out)
{
	const struct random_scene *s = f->s;
	const int32_t *sc = s->view.scissor;
	const struct camera_rectangle r = camera_rectangle(sc[0], sc[1], sc[2], sc[3], WIDTH, HEIGHT);
	struct device_buffer *b[] = {
		make_buffer(dev, &s->view, sizeof(s->view)), make_buffer(dev, f->window, s->n_vertices * sizeof(*f->window)),
		make_buffer(dev, f->clip, s->n_vertices * sizeof(*f->clip)), make_buffer(dev, f->after, PIXELS * sizeof(*f->after)),
		NULL, NULL,
	};
	struct traverse_trees trees = { 0 };

	memset(out, 0xa5, sizeof(*out));
	b[4] = make_buffer(dev, out->fragments, sizeof(out->fragments));
	b[5] = make_buffer(dev, out->counts, sizeof(out->counts));
	ck_assert_int_eq(traverse_upload_pools(dev, s->accel, &trees), 0);
	ck_assert_int_eq(traverse_upload_tlases(dev, s->accel, s->instances, INSTANCES, &trees), 0);
	ck_assert_int_eq(traverse_camera(dev, kernel, &trees, r,
	                                 LAUNCH(camera_pass, .view_index = 0, .views = { b[0] }, .width = WIDTH,
	                                        .height = HEIGHT, .rectangle = r, .first_pixel = 0, .mode = mode,
	                                        .window = { b[1] }, .clip = { b[2] }, .after = { b[3] },
	                                        .fragments = { b[4] }, .counts = { b[5] })),
	                 0);
	ck_assert_int_eq(device_read(dev, b[4], 0, out->fragments, sizeof(out->fragments)), 0);
	ck_assert_int_eq(device_read(dev, b[5], 0, out->counts, sizeof(out->counts)), 0);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
	traverse_release(dev, &trees);
	for (uint32_t i = 0; i < GUARD; i++)
		ck_assert_msg(
			out->counts[PIXELS + i] == GUARD_WORD &&
				out->fragments[(mode == CAMERA_COLUMN ? CAMERA_COLUMN_MAX : 1) * PIXELS + i].order ==
					GUARD_WORD,
			"camera writes past its end");
	for (uint32_t i = 0; i < PIXELS; i++) {
		const int32_t x = i % WIDTH, y = i / WIDTH;

		if (x < r.x0 || x >= r.x1 || y < r.y0 || y >= r.y1)
			ck_assert_msg(out->counts[i] == GUARD_WORD, "camera touches pixel %d %d, outside of its rectangle", x, y);
	}
}

static void compare_fragment(const struct fragment *a, const struct fragment *b, uint32_t pixel, const char *what)
{
	ck_assert_msg(a->order == b->order && a->instance == b->instance && a->primitive == b->primitive,
	              "%s: pixel %u %u: order %d instance %d primitive %d depth %.9g, the twin has %d %d %d %.9g", what,
	              pixel % WIDTH, pixel / WIDTH, (int)b->order, (int)b->instance, (int)b->primitive, b->depth,
	              (int)a->order, (int)a->instance, (int)a->primitive, a->depth);
	ck_assert_msg(fabsf(a->b1 - b->b1) <= 1e-6f && fabsf(a->b2 - b->b2) <= 1e-6f && fabsf(a->depth - b->depth) <= 1e-6f,
	              "%s: pixel %u %u: b %.9g %.9g depth %.9g, the twin has %.9g %.9g %.9g", what, pixel % WIDTH,
	              pixel / WIDTH, b->b1, b->b2, b->depth, a->b1, a->b2, a->depth);
}

/* Whether this is a fragment of a triangle seen edge-on, nearer than any of its vertices (camera.h). */
static int stands_out(const struct frame *f, const struct fragment *n)
{
	const struct instance *instance = &f->s->instances[n->instance];
	const uint32_t *v = f->s->mesh_list[f->s->scene_instances[n->instance].mesh]->index + 3 * (size_t)n->primitive;
	float nearest = 1;

	for (int i = 0; i < 3; i++) {
		const struct window_vertex *w = &f->window[instance->vertex_first + v[i]];

		if (!(w->w_inv > 0))
			return 0;
		nearest = fminf(nearest, w->z);
	}
	return n->depth < nearest - 1e-5f;
}

static void compare(const struct frame *f, const struct result *want, const struct result *got, uint32_t mode,
                    const char *what)
{
	const uint32_t stride = mode == CAMERA_COLUMN ? CAMERA_COLUMN_MAX : 1;
	uint32_t n_standing_out = 0;

	for (uint32_t i = 0; i < PIXELS; i++) {
		ck_assert_msg(want->counts[i] == got->counts[i],
		              "%s: pixel %u %u: %u fragments, the twin has %u (first order %d, depth %g)", what,
		              i % WIDTH, i / WIDTH, got->counts[i], want->counts[i],
		              (int)want->fragments[i * stride].order, want->fragments[i * stride].depth);
		if (want->counts[i] == GUARD_WORD)
			continue;
		if (mode != CAMERA_COLUMN && want->counts[i] && want->fragments[i].order != got->fragments[i].order &&
		    stands_out(f, want->fragments[i].depth < got->fragments[i].depth ? &want->fragments[i] : &got->fragments[i])) {
			n_standing_out++;
			continue;
		}
		for (uint32_t k = 0; k < (mode == CAMERA_COLUMN ? want->counts[i] : 1); k++)
			compare_fragment(&want->fragments[i * stride + k], &got->fragments[i * stride + k], i, what);
	}
	ck_assert_msg(n_standing_out <= 2, "%s: %u pixels differ because of triangles seen edge-on", what,
	              n_standing_out);
}

START_TEST(kernels_agree_with_twins)
{
	static struct result want, got, again;
	const uint32_t seed = seed_of_run;
	struct device_description *list = NULL;
	struct device *reference, *dev;
	size_t n_devices;
	char number[32], what[256];

	ck_assert_int_eq(device_open("reference", 2, &reference), 0);
	ck_assert_int_eq(device_list(&list, &n_devices), 0);
	for (size_t k = 0; k < n_devices; k++) {
		snprintf(number, sizeof(number), "%zu", k);
		ck_assert_int_eq(device_open(number, 0, &dev), 0);
		for (int i = 0; i < 4; i++) {
			struct frame f = make_frame(seed + (uint32_t)i, i & 1);

			look_aside(&f, i & 2);
			for (uint32_t pass = CAMERA_NEAREST_LESS; pass <= CAMERA_COLUMN + 1; pass++)
				for (enum kernel kernel = KERNEL_camera_packet; kernel <= KERNEL_camera_compressed; kernel++) {
					const uint32_t mode = pass < CAMERA_COLUMN ? pass : CAMERA_COLUMN;

					begin_columns(&f, pass > CAMERA_COLUMN ? 20 : 0);
					snprintf(what, sizeof(what), "%s, %s, %s, at %s, mode %u", list[k].name,
					         device_kernel_name(kernel), i & 1 ? "orthographic" : "perspective",
					         i & 2 ? "a sample" : "centres", mode);
					run(&f, reference, kernel, mode, &want);
					run(&f, dev, kernel, mode, &got);
					compare(&f, &want, &got, mode, what);
					run(&f, dev, kernel, mode, &again);
					ck_assert_msg(memcmp(&got, &again, sizeof(got)) == 0, "%s: two runs differ", what);
				}
			free_frame(&f);
		}
		device_close(&dev);
	}
	device_close(&reference);
	free(list);
}
END_TEST

/* The twins must find the same in the trees as in a single leaf around everything: boxes lose nothing. */
START_TEST(boxes_lose_nothing)
{
	static struct result want, got;
	struct device *dev;
	const uint32_t seed = seed_of_run;

	ck_assert_int_eq(device_open("reference", 2, &dev), 0);
	for (int i = 0; i < 4; i++) {
		struct frame f = make_frame(seed + (uint32_t)i, i & 1);

		look_aside(&f, i & 2);
		for (uint32_t mode = CAMERA_NEAREST_LESS; mode <= CAMERA_COLUMN; mode++) {
			struct accel *a = f.s->accel;
			struct node2 *nodes = malloc(a->n_nodes2 * sizeof(*nodes)), *top = malloc(a->n_top2 * sizeof(*top));

			run(&f, dev, KERNEL_camera_wide, mode, &got);
			memcpy(nodes, a->nodes2, a->n_nodes2 * sizeof(*nodes));
			memcpy(top, a->top2, a->n_top2 * sizeof(*top));
			for (size_t k = 0; k < a->n_nodes2 + a->n_top2; k++) {
				struct node2 *node = k < a->n_nodes2 ? &a->nodes2[k] : &a->top2[k - a->n_nodes2];

				for (int side = 0; side < 2; side++)
					for (int axis = 0; axis < 3 && (node->count[side] || node->child[side]); axis++) {
						node->lo[side][axis] = -1e6f;
						node->hi[side][axis] = 1e6f;
					}
			}
			run(&f, dev, KERNEL_camera_wide, mode, &want);
			compare(&f, &want, &got, mode, "boxes");
			run(&f, dev, KERNEL_camera_compressed, mode, &got);
			compare(&f, &want, &got, mode, "compressed boxes");
			run(&f, dev, KERNEL_camera_packet, mode, &got);
			compare(&f, &want, &got, mode, "boxes in rows");
			memcpy(a->nodes2, nodes, a->n_nodes2 * sizeof(*nodes));
			memcpy(a->top2, top, a->n_top2 * sizeof(*top));
			free(nodes);
			free(top);
		}
		free_frame(&f);
	}
	device_close(&dev);
}
END_TEST

/* For any tree: triangles in several leaves count once, and the boxes of their pieces lose nothing. */
START_TEST(trees_change_nothing)
{
	static struct result want, got;
	struct device *dev;
	char what[64];

	ck_assert_int_eq(device_open("reference", 2, &dev), 0);
	for (int i = 0; i < 2; i++) {
		struct frame f = make_frame(seed_of_run + (uint32_t)i, i);

		for (uint32_t mode = CAMERA_NEAREST_LESS; mode <= CAMERA_COLUMN; mode++)
			for (enum kernel kernel = KERNEL_camera_packet; kernel <= KERNEL_camera_compressed; kernel++) {
				f.s->accel->kind = ACCEL_BVH;
				ck_assert_int_eq(accel_build_frame(f.s->accel, &f.s->scene, NULL, NULL, f.s->instances, INSTANCES,
				                                   &f.s->view, &f.s->spaces, &f.s->n_spaces), 0);
				run(&f, dev, kernel, mode, &want);
				for (int kind = ACCEL_BVH + 1; kind < N_ACCEL_KINDS; kind++) {
					random_scene_rebuild(f.s, (enum accel_kind)kind);
					run(&f, dev, kernel, mode, &got);
					snprintf(what, sizeof(what), "tree of kind %d", kind);
					compare(&f, &want, &got, mode, what);
				}
			}
		free_frame(&f);
	}
	device_close(&dev);
}
END_TEST

/* Enlarge nonempty boxes, n numbers of their bounds, to contain everything. */
static void widen(float *lo, float *hi, int n)
{
	for (int i = 0; i < n; i++)
		if (lo[i] <= hi[i]) {
			lo[i] = -1e6f;
			hi[i] = 1e6f;
		}
}

/* A fan of triangles over the whole window, with centres on many edges: each pixel belongs to exactly one. */
START_TEST(shared_edges_belong_to_one)
{
	static struct result got;
	struct frame f = make_frame(seed_of_run, 1);
	struct random_scene *s = f.s;
	struct device *dev;
	const int32_t ring[9][2] = { { 0, 0 }, { 5120, 0 }, { 20480, 0 }, { 20480, 5248 }, { 20480, 15360 },
		                     { 9344, 15360 }, { 0, 15360 }, { 0, 8064 }, { 0, 0 } };

	/* Only mesh 1 is used, with eight of its triangles placed in the window; all others have no area. */
	for (uint32_t i = 0; i < s->n_vertices; i++)
		f.window[i] = (struct window_vertex){ 0, 0, 0.5f, 1 };
	for (uint32_t t = 0; t < 8; t++)
		for (uint32_t i = 0; i < 3; i++) {
			const uint32_t v = s->instances[1].vertex_first + s->index[1][8 + t][i];
			const int32_t *at = i == 0 ? (const int32_t[]){ 9600, 6528 } : ring[t + i - 1];

			f.window[v].x = at[0];
			f.window[v].y = at[1];
		}
	for (size_t k = 0; k < s->accel->n_top2; k++)
		widen(s->accel->top2[k].lo[0], s->accel->top2[k].hi[0], 6);
	for (size_t k = 0; k < s->accel->n_nodes8; k++)
		widen(s->accel->nodes8[k].lo[0], s->accel->nodes8[k].hi[0], 24);
	for (int k = 0; k < INSTANCES; k++)
		s->instances[k].radius = 1e6f;
	memset(f.after, 0, PIXELS * sizeof(*f.after));
	ck_assert_int_eq(device_open(NULL, 0, &dev), 0);
	run(&f, dev, KERNEL_camera_packet, CAMERA_COLUMN, &got);
	for (int32_t y = 2; y < HEIGHT - 2; y++)
		for (int32_t x = 3; x < WIDTH - 2; x++)
			ck_assert_msg(got.counts[y * WIDTH + x] == 1, "pixel %d %d is covered %u times", x, y,
			              got.counts[y * WIDTH + x]);
	device_close(&dev);
	free_frame(&f);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("camera"), *devices = tcase_create("devices"); /* test_host.py runs these alone */

	choose_seed();
	tcase_set_timeout(tests, 120);
	tcase_set_timeout(devices, 120);
	tcase_add_test(tests, boxes_lose_nothing);
	tcase_add_test(tests, trees_change_nothing);
	if (!lacks_driver()) {
		tcase_add_test(devices, kernels_agree_with_twins);
		tcase_add_test(devices, shared_edges_belong_to_one);
	}
	return run_cases(tests, devices, "camera");
}
