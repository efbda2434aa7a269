/* The occlude and intersect kernels against their C twins, and the twins against a loop over all triangles. */
#include "tests/check/random_scene.h"

#include "kernels/rays/opacity.h"
#include "kernels/rays/rays.h"
#include "tests/case.h"
#include "tests/driver.h"
#include "tracer/frame/common/traverse.h"

#define N_RAYS 4099 /* not a multiple of a packet */
#define GUARD 64
#define GUARD_WORD 0xa5a5a5a5u

struct result {
	uint32_t occluded[N_RAYS + GUARD], to_lights[N_RAYS + GUARD]; /* the same for shadow rays */
	struct hit hits[N_RAYS + GUARD];
};

static struct ray *make_rays(struct random_scene *s)
{
	struct ray *rays = calloc(N_RAYS, sizeof(*rays));

	for (uint32_t i = 0; i < N_RAYS; i++) {
		struct ray *r = &rays[i];

		/* Coherent in the first half, then in all directions; then special cases. */
		for (int a = 0; a < 3; a++) {
			r->o[a] = i < N_RAYS / 2 ? 0 : between(s, -4, 4);
			r->d[a] = i < N_RAYS / 2 ? (a == 2 ? -1 : ((float)(a ? i / 64 % 64 : i % 64) - 32) / 40) : between(s, -1, 1);
		}
		r->t_min = i % 5 ? 0 : between(s, 0, 3);
		r->t_max = i % 3 ? INFINITY : between(s, 0, 9);
		switch (i % 97) {
		case 11: /* along an axis */
			r->d[0] = r->d[1] = 0;
			break;
		case 12:
			r->d[1] = r->d[2] = -0.0f;
			break;
		case 23: /* no direction */
			r->d[0] = r->d[1] = r->d[2] = 0;
			break;
		case 31:
			r->o[i % 3] = NAN;
			break;
		case 37:
			r->d[i % 3] = i % 2 ? NAN : INFINITY;
			break;
		case 41: /* empty interval */
			r->t_min = 2;
			r->t_max = 1;
			break;
		case 43:
			r->t_max = NAN;
			break;
		case 47: /* from far away */
			for (int a = 0; a < 3; a++) {
				r->o[a] -= 1e6f * r->d[a];
			}
			break;
		case 61: /* from beyond the range of object space */
			r->o[i % 3] = i % 2 ? 3e38f : -3e38f;
			break;
		case 53: /* a tiny direction, and a huge one */
			for (int a = 0; a < 3; a++)
				r->d[a] *= i % 2 ? 1e-12f : 1e12f;
			break;
		case 59: /* at a vertex that triangles share */
			for (int a = 0; a < 3; a++)
				r->d[a] = s->instances[0].eye_from_obj[4 * a + 3] - r->o[a];
			break;
		}
	}
	return rays;
}

/* The ways to trace rays: kernels for any hit and for the nearest. */
enum way { PACKET, WIDE, BINARY, COMPRESSED, N_WAYS };

static const struct {
	const char *name;
	enum kernel kernels[2];
} ways[N_WAYS] = {
	[PACKET] = { "packet", { KERNEL_occlude_packet, KERNEL_intersect_packet } },
	[WIDE] = { "wide", { KERNEL_occlude_wide, KERNEL_intersect_wide } },
	[BINARY] = { "binary", { KERNEL_occlude_binary, KERNEL_intersect_binary } },
	[COMPRESSED] = { "compressed", { KERNEL_occlude_compressed, KERNEL_intersect_compressed } },
};

static void run(struct random_scene *s, struct device *dev, const struct ray *rays, enum way way, struct result *out)
{
	struct device_buffer *b[] = { make_buffer(dev, rays, N_RAYS * sizeof(*rays)), NULL, NULL, NULL };
	struct traverse_trees trees = { 0 };
	struct traverse_rays r = { .space = &s->spaces[0], .n = N_RAYS };

	memset(out, 0xa5, sizeof(*out));
	b[1] = make_buffer(dev, out->occluded, sizeof(out->occluded));
	b[2] = make_buffer(dev, out->hits, sizeof(out->hits));
	b[3] = make_buffer(dev, out->to_lights, sizeof(out->to_lights));
	for (uint32_t k = 1; k < INSTANCES; k++) /* the first one lets nothing pass */
		s->instances[k].flags |= k % 2 ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE;
	r.rays.buffer = b[0];
	r.occluded.buffer = b[1];
	r.hits.buffer = b[2];
	ck_assert_int_eq(traverse_upload_pools(dev, s->accel, &trees), 0);
	ck_assert_int_eq(traverse_upload_tlases(dev, s->accel, s->instances,
	                                        sizeof(s->instances) / sizeof(s->instances[0]), &trees),
	                 0);
	for (int kind = 0; kind < 2; kind++)
		ck_assert_int_eq(traverse_rays(dev, ways[way].kernels[kind], &trees, &r), 0);
	r.occluded.buffer = b[3];
	r.to_lights = 1;
	ck_assert_int_eq(traverse_rays(dev, ways[way].kernels[0], &trees, &r), 0);
	ck_assert_int_eq(device_read(dev, b[1], 0, out->occluded, sizeof(out->occluded)), 0);
	ck_assert_int_eq(device_read(dev, b[3], 0, out->to_lights, sizeof(out->to_lights)), 0);
	ck_assert_int_eq(device_read(dev, b[2], 0, out->hits, sizeof(out->hits)), 0);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
	traverse_release(dev, &trees);
	for (uint32_t i = 0; i < GUARD; i++) {
		ck_assert_msg(out->occluded[N_RAYS + i] == GUARD_WORD && out->to_lights[N_RAYS + i] == GUARD_WORD,
		              "occlude writes past its end");
		ck_assert_msg(out->hits[N_RAYS + i].primitive == GUARD_WORD, "intersect writes past its end");
	}
}

/* The place where a ray meets a triangle's plane, in double precision. */
struct meeting {
	double t, b1, b2, det, edge; /* edge: distance to the triangle's edge, negative outside, in weights */
};

static struct meeting meet(const struct random_scene *s, const struct ray *ray, uint32_t instance, uint32_t primitive)
{
	const struct scene_mesh *mesh = s->mesh_list[s->scene_instances[instance].mesh];
	const float *m = s->instances[instance].obj_from_eye;
	double o[3], d[3], e1[3], e2[3], v[3], p[3], q[3];
	struct meeting got;

	for (int row = 0; row < 3; row++, m += 4) {
		o[row] = (double)m[0] * ray->o[0] + (double)m[1] * ray->o[1] + (double)m[2] * ray->o[2] + m[3];
		d[row] = (double)m[0] * ray->d[0] + (double)m[1] * ray->d[1] + (double)m[2] * ray->d[2];
	}
	for (int a = 0; a < 3; a++) {
		const float *p0 = mesh->position + 4 * (size_t)mesh->index[3 * primitive];

		e1[a] = (double)mesh->position[4 * (size_t)mesh->index[3 * primitive + 1] + (size_t)a] - p0[a];
		e2[a] = (double)mesh->position[4 * (size_t)mesh->index[3 * primitive + 2] + (size_t)a] - p0[a];
		v[a] = o[a] - p0[a];
	}
	for (int a = 0; a < 3; a++)
		p[a] = d[(a + 1) % 3] * e2[(a + 2) % 3] - d[(a + 2) % 3] * e2[(a + 1) % 3];
	got.det = e1[0] * p[0] + e1[1] * p[1] + e1[2] * p[2];
	got.b1 = (v[0] * p[0] + v[1] * p[1] + v[2] * p[2]) / got.det;
	for (int a = 0; a < 3; a++)
		q[a] = v[(a + 1) % 3] * e1[(a + 2) % 3] - v[(a + 2) % 3] * e1[(a + 1) % 3];
	got.b2 = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / got.det;
	got.t = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) / got.det;
	got.edge = fmin(fmin(got.b1, got.b2), 1 - got.b1 - got.b2);
	return got;
}

/* The effect of a triangle on a ray that hits it (kernels/rays/opacity.h): OPACITY_STOPS, _PASSES or _ASK. margin:
 * becomes at most the distance to another cell */
static uint32_t does_of(const struct instance *instance, uint32_t primitive, const struct meeting *m, int to_lights,
                        const uint32_t *words, double *margin)
{
	const uint32_t word = opacity_word(words, instance->opacity, primitive);
	const double n = 1 << (word >> OPACITY_LEVEL & 7);

	if (opacity_sides(word, (uint32_t)to_lights) & (m->det > 0 ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE))
		return OPACITY_PASSES;
	if ((word & 3) == OPACITY_MAP)
		*margin = fmin(*margin, fmin(fabs(m->b1 * n - round(m->b1 * n)), fabs(m->b2 * n - round(m->b2 * n))));
	return opacity_at(words, instance->opacity, word, (float)m->b1, (float)m->b2);
}

/* How close a meeting is to an edge, or to an end of the ray: too close to decide. */
static double margin_of(const struct meeting *m, const struct ray *ray)
{
	if (!(m->edge > -1e-3 && m->t > -1e9 && m->t < 1e9))
		return 1;
	return fmin(fabs(m->edge), fmin(fabs(m->t - ray->t_min), fabs(m->t - ray->t_max)) / (1 + fabs(m->t)));
}

/* The nearest of all triangles of all instances. words: of the instances' opacity: only what stops the ray; NULL: no
 * ray knows it. asks: receives 1 if the ray meets surfaces that have to be sampled. margin: how close to the next
 * decision: too close below 1e-4 */
static struct hit hit_all(const struct random_scene *s, const struct ray *ray, int to_lights, const uint32_t *words,
                          int *asks, double *margin)
{
	struct hit best = { ray->t_max, 0, 0, SCENE_NONE, SCENE_NONE };

	*margin = 1;
	*asks = 0;
	for (uint32_t k = 0; k < INSTANCES; k++)
		for (uint32_t i = 0; i < s->mesh_list[s->scene_instances[k].mesh]->primitive_count; i++) {
			const struct meeting m = meet(s, ray, k, i);
			uint32_t does = OPACITY_STOPS;

			*margin = fmin(*margin, margin_of(&m, ray));
			if (to_lights && s->instances[k].flags & (m.det > 0 ? INSTANCE_PASS_COUNTER : INSTANCE_PASS_CLOCKWISE))
				continue;
			if (m.edge > -1e-3 && words)
				does = does_of(&s->instances[k], i, &m, to_lights, words, margin);
			if (!(m.edge >= 0 && m.t >= ray->t_min && m.t <= ray->t_max))
				continue;
			*asks |= does == OPACITY_ASK;
			if (does == OPACITY_STOPS) {
				if (best.instance != SCENE_NONE)
					*margin = fmin(*margin, fabs(m.t - best.t) / (1 + fabs(m.t)));
				if (m.t < best.t || best.instance == SCENE_NONE)
					best = (struct hit){ (float)m.t, (float)m.b1, (float)m.b2, k, i };
			}
		}
	return best;
}

static int is_usable(const struct ray *r)
{
	for (int a = 0; a < 3; a++)
		if (!isfinite(r->o[a]) || !isfinite(r->d[a]))
			return 0;
	return r->t_min <= r->t_max;
}

START_TEST(twins_find_what_all_triangles_give)
{
	struct random_scene *s = random_scene_create(seed_of_run);
	struct ray *rays = make_rays(s);
	struct result *got = malloc(sizeof(*got));
	struct device *dev;
	uint32_t compared = 0, passed = 0;

	if (_i != ACCEL_BVH)
		random_scene_rebuild(s, (enum accel_kind)_i);
	ck_assert_int_eq(device_open("reference", 1, &dev), 0);
	for (enum way way = 0; way < N_WAYS; way++) {
		run(s, dev, rays, way, got);
		for (uint32_t i = 0; i < N_RAYS; i++) {
			double margin = 1;
			int asks;
			struct hit want = { 0, 0, 0, SCENE_NONE, SCENE_NONE }, blocks = want;

			if (is_usable(&rays[i])) {
				blocks = hit_all(s, &rays[i], 1, NULL, &asks, &margin);
				want = hit_all(s, &rays[i], 0, NULL, &asks, &margin);
			}
			if (margin < 1e-4 || i % 97 == 47)
				continue;
			compared++;
			ck_assert_msg(got->hits[i].instance == want.instance && got->hits[i].primitive == want.primitive,
			              "ray %u (%s): instance %d primitive %d t %g, all triangles give %d %d %g", i, ways[way].name,
			              (int)got->hits[i].instance, (int)got->hits[i].primitive, got->hits[i].t, (int)want.instance,
			              (int)want.primitive, want.t);
			ck_assert_msg(got->occluded[i] == (want.instance != SCENE_NONE), "ray %u (%s): occluded %u", i, ways[way].name,
			              got->occluded[i]);
			ck_assert_msg(got->to_lights[i] == (blocks.instance != SCENE_NONE), "ray %u (%s) to a light: occluded %u", i,
			              ways[way].name, got->to_lights[i]);
			passed += got->occluded[i] && !got->to_lights[i];
		}
	}
	ck_assert_uint_gt(compared, N_RAYS);
	ck_assert_uint_gt(passed, 0);
	device_close(&dev);
	free(rays);
	free(got);
	random_scene_free(s);
}
END_TEST

static void compare(const struct result *want, const struct result *got, const char *what)
{
	for (uint32_t i = 0; i < N_RAYS; i++) {
		const struct hit *a = &want->hits[i], *b = &got->hits[i];

		ck_assert_msg(want->occluded[i] == got->occluded[i] && want->to_lights[i] == got->to_lights[i],
		              "%s: ray %u: occluded %u and %u, the twin has %u and %u", what, i, got->occluded[i], got->to_lights[i],
		              want->occluded[i], want->to_lights[i]);
		ck_assert_msg(a->instance == b->instance && a->primitive == b->primitive,
		              "%s: ray %u: instance %d primitive %d t %g, the twin has %d %d %g", what, i, (int)b->instance,
		              (int)b->primitive, b->t, (int)a->instance, (int)a->primitive, a->t);
		ck_assert_msg(a->instance == SCENE_NONE ||
		                      (fabsf(a->t - b->t) <= 1e-5f * fabsf(a->t) && fabsf(a->b1 - b->b1) <= 1e-5f &&
		                       fabsf(a->b2 - b->b2) <= 1e-5f),
		              "%s: ray %u: t %.9g b %.9g %.9g, the twin has %.9g %.9g %.9g", what, i, b->t, b->b1, b->b2, a->t,
		              a->b1, a->b2);
	}
}

/* Besides the run's own seed, one with rays from far away that the kernel once decided differently. */
static const uint32_t hard_seeds[] = { 1036 };

START_TEST(kernels_agree_with_twins)
{
	struct random_scene *s = random_scene_create(_i / 2 ? hard_seeds[_i / 2 - 1] : seed_of_run);
	struct ray *rays = make_rays(s);
	struct result *want = malloc(sizeof(*want)), *got = malloc(sizeof(*got)), *again = malloc(sizeof(*again));
	struct device_description *list = NULL;
	struct device *reference, *dev;
	size_t n_devices;
	char number[32], what[256];

	if (_i % 2)
		random_scene_rebuild(s, ACCEL_SBVH);
	ck_assert_int_eq(device_open("reference", 1, &reference), 0);
	ck_assert_int_eq(device_list(&list, &n_devices), 0);
	for (size_t k = 0; k < n_devices; k++) {
		snprintf(number, sizeof(number), "%zu", k);
		ck_assert_int_eq(device_open(number, 0, &dev), 0);
		for (enum way way = 0; way < N_WAYS; way++) {
			snprintf(what, sizeof(what), "%s, %s", list[k].name, ways[way].name);
			run(s, reference, rays, way, want);
			run(s, dev, rays, way, got);
			compare(want, got, what);
			run(s, dev, rays, way, again);
			ck_assert_msg(memcmp(got, again, sizeof(*got)) == 0, "%s: two runs differ", what);
		}
		device_close(&dev);
	}
	device_close(&reference);
	free(list);
	free(rays);
	free(want);
	free(got);
	free(again);
	random_scene_free(s);
}
END_TEST

/*
 * Give the instances opacity (kernels/rays/opacity.h): one lets all light pass, one may stop it everywhere, the others
 * have random words. @return [n_words]
 */
static uint32_t *know_surfaces(struct random_scene *s, size_t *n_words)
{
	uint32_t *words = calloc(5 * INSTANCES * MAX_TRIANGLES, sizeof(*words)), n = 0;

	for (uint32_t k = 0; k < INSTANCES; k++) {
		const uint32_t triangles = s->mesh_list[s->scene_instances[k].mesh]->primitive_count;

		s->instances[k].opacity = k == 0 ? OPACITY_PASSES : k == 1 ? OPACITY_STOPS : OPACITY_WORDS + n;
		for (uint32_t i = 0; i < triangles && k > 1; i++) {
			words[n + i] = (uint32_t)between(s, 0, 4) | (uint32_t)between(s, 0, 4) << 2 | 3u << OPACITY_LEVEL |
			               (triangles + 4 * i) << OPACITY_PLACE;
			for (uint32_t cell = 0; cell < 64; cell++)
				words[n + triangles + 4 * i + cell / 16] |= (uint32_t)between(s, 0, 3) << 2 * (cell % 16);
		}
		n += k > 1 ? 5 * triangles : 0;
	}
	*n_words = n;
	return words;
}

/* Rays that know the surfaces, and the rays that they are. */
struct known {
	struct random_scene *s;
	struct ray *rays;
	uint32_t *words;
	size_t n_words;
};

static void check_knowing(struct device *dev, void *user)
{
	const struct known *known = user;
	struct random_scene *s = known->s;
	struct device_buffer *b[] = { make_buffer(dev, known->rays, N_RAYS * sizeof(*known->rays)),
		                      make_buffer(dev, known->words, known->n_words * sizeof(*known->words)), NULL };
	static uint32_t occluded[N_RAYS];
	struct traverse_trees trees = { .opacity.buffer = b[1] };
	struct traverse_rays r = { .space = &s->spaces[0], .n = N_RAYS, .rays.buffer = b[0] };
	uint32_t compared = 0, stopped = 0, asked = 0, passed = 0;

	r.occluded.buffer = b[2] = make_buffer(dev, occluded, sizeof(occluded));
	ck_assert_int_eq(traverse_upload_pools(dev, s->accel, &trees), 0);
	ck_assert_int_eq(traverse_upload_tlases(dev, s->accel, s->instances, INSTANCES, &trees), 0);
	for (int kind = 0; kind < 4; kind++) {
		const enum way way = kind / 2 ? WIDE : PACKET;

		r.to_lights = (uint32_t)kind % 2;
		ck_assert_int_eq(traverse_rays(dev, ways[way].kernels[0], &trees, &r), 0);
		ck_assert_int_eq(device_read(dev, b[2], 0, occluded, sizeof(occluded)), 0);
		for (uint32_t i = 0; i < N_RAYS; i++) {
			double margin = 1, all_margin = 1;
			struct hit stops, any;
			int asks, all_asks;
			uint32_t want;

			if (!is_usable(&known->rays[i]) || i % 97 == 47)
				continue;
			stops = hit_all(s, &known->rays[i], kind % 2, known->words, &asks, &margin);
			any = hit_all(s, &known->rays[i], kind % 2, NULL, &all_asks, &all_margin);
			if (margin < 1e-4)
				continue;
			want = stops.instance != SCENE_NONE ? 1 : asks ? 2 : 0;
			ck_assert_msg(occluded[i] == want, "ray %u (%s, to lights: %u): occluded %u, all triangles give %u", i,
			              ways[way].name, r.to_lights, occluded[i], want);
			compared++;
			stopped += want == 1;
			asked += want == 2;
			passed += any.instance != SCENE_NONE && !occluded[i];
		}
	}
	ck_assert_uint_gt(compared, N_RAYS);
	ck_assert_uint_gt(stopped, N_RAYS / 50);
	ck_assert_uint_gt(asked, N_RAYS / 50);
	ck_assert_uint_gt(passed, N_RAYS / 50);
	traverse_release(dev, &trees);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
}

START_TEST(rays_ignore_what_passes)
{
	struct random_scene *s = random_scene_create(seed_of_run);
	struct known known = { s, make_rays(s), NULL, 0 };

	known.words = know_surfaces(s, &known.n_words);
	on_each_device(check_knowing, &known);
	free(known.words);
	free(known.rays);
	random_scene_free(s);
}
END_TEST

/* Number of hits of a ray with all triangles. */
static uint32_t count_all(const struct random_scene *s, const struct ray *ray, double *margin)
{
	uint32_t n = 0;

	*margin = 1;
	for (uint32_t k = 0; k < INSTANCES; k++)
		for (uint32_t i = 0; i < s->mesh_list[s->scene_instances[k].mesh]->primitive_count; i++) {
			const struct meeting m = meet(s, ray, k, i);

			*margin = fmin(*margin, margin_of(&m, ray));
			n += m.edge >= 0 && m.t >= ray->t_min && m.t <= ray->t_max;
		}
	return n;
}

/* 1 if a hit comes after another, as rays that continue behind that one find them (kernels/rays/rays.h). */
static int comes_after(const struct hit *hit, const struct hit *last)
{
	if (hit->t != last->t)
		return hit->t > last->t;
	return hit->instance > last->instance || (hit->instance == last->instance && hit->primitive > last->primitive);
}

#define MOST_HITS 64

/* Follow rays from hit to hit to their ends. counts: [N_RAYS] how many hits. @return number of hits at the t of the one
 * before, of another instance */
static uint32_t follow(struct random_scene *s, struct device *dev, const struct ray *from, enum way way,
                       uint32_t *counts)
{
	struct traverse_trees trees = { 0 };
	struct ray *rays = malloc(N_RAYS * sizeof(*rays));
	struct hit *hits = calloc(N_RAYS, sizeof(*hits)), *last = calloc(N_RAYS, sizeof(*last));
	struct device_buffer *b[] = { make_buffer(dev, from, N_RAYS * sizeof(*rays)),
		                      make_buffer(dev, hits, N_RAYS * sizeof(*hits)),
		                      make_buffer(dev, last, N_RAYS * sizeof(*last)) };
	struct traverse_rays r = { .space = &s->spaces[0], .n = N_RAYS, .rays.buffer = b[0], .hits.buffer = b[1] };
	uint32_t left = N_RAYS, together = 0, round;

	memcpy(rays, from, N_RAYS * sizeof(*rays));
	memset(counts, 0, N_RAYS * sizeof(*counts));
	ck_assert_int_eq(traverse_upload_pools(dev, s->accel, &trees), 0);
	ck_assert_int_eq(traverse_upload_tlases(dev, s->accel, s->instances, INSTANCES, &trees), 0);
	for (round = 0; left && round < MOST_HITS; round++) {
		ck_assert_int_eq(traverse_rays(dev, ways[way].kernels[1], &trees, &r), 0);
		ck_assert_int_eq(device_read(dev, b[1], 0, hits, N_RAYS * sizeof(*hits)), 0);
		left = 0;
		for (uint32_t i = 0; i < N_RAYS; i++) {
			if (hits[i].instance == SCENE_NONE) {
				rays[i].t_min = 1, rays[i].t_max = 0; /* nothing more */
				continue;
			}
			ck_assert_msg(!round || comes_after(&hits[i], &last[i]),
			              "%s: ray %u: hit %u is t %.9g of %u %u, the one before %.9g of %u %u", ways[way].name, i,
			              round, hits[i].t, hits[i].instance, hits[i].primitive, last[i].t, last[i].instance,
			              last[i].primitive);
			together += round && hits[i].t == last[i].t && hits[i].instance != last[i].instance;
			rays[i].t_min = hits[i].t;
			counts[i]++;
			left++;
		}
		memcpy(last, hits, N_RAYS * sizeof(*hits));
		r.last.buffer = b[2];
		ck_assert_int_eq(device_write(dev, b[0], 0, rays, N_RAYS * sizeof(*rays)), 0);
		ck_assert_int_eq(device_write(dev, b[2], 0, last, N_RAYS * sizeof(*last)), 0);
	}
	ck_assert_msg(!left, "%s: %u rays without an end", ways[way].name, left);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
	traverse_release(dev, &trees);
	free(rays);
	free(hits);
	free(last);
	return together;
}

static void check_following(struct device *dev, void *user)
{
	const struct known *known = user;
	static uint32_t counts[N_RAYS];

	for (enum way way = 0; way < N_WAYS; way++) {
		const uint32_t together = follow(known->s, dev, known->rays, way, counts);
		uint32_t compared = 0, several = 0;

		for (uint32_t i = 0; i < N_RAYS; i++) {
			double margin = 1;
			const uint32_t want = is_usable(&known->rays[i]) ? count_all(known->s, &known->rays[i], &margin) : 0;

			if (margin < 1e-4 || i % 97 == 47)
				continue;
			ck_assert_msg(counts[i] == want, "ray %u (%s): %u hits one after the other, all triangles give %u", i,
			              ways[way].name, counts[i], want);
			compared++;
			several += want > 1;
		}
		ck_assert_uint_gt(compared, N_RAYS / 2);
		ck_assert_uint_gt(several, N_RAYS / 50);
		ck_assert_uint_gt(together, N_RAYS / 100);
	}
}

/* Rays that continue behind each hit find every triangle once, also where two instances are at the same place. */
START_TEST(rays_meet_each_surface_once)
{
	struct random_scene *s = random_scene_create(seed_of_run);
	struct known known = { s, make_rays(s), NULL, 0 };

	memcpy(s->instances[MESHES].eye_from_obj, s->instances[0].eye_from_obj, sizeof(s->instances[0].eye_from_obj));
	memcpy(s->instances[MESHES].obj_from_eye, s->instances[0].obj_from_eye, sizeof(s->instances[0].obj_from_eye));
	random_scene_rebuild(s, ACCEL_BVH);
	on_each_device(check_following, &known);
	free(known.rays);
	random_scene_free(s);
}
END_TEST

/* The tree must not matter: the nearest hit is the same to the bit, including ties. */
START_TEST(hits_depend_on_no_tree)
{
	struct random_scene *s = random_scene_create(seed_of_run);
	struct ray *rays = make_rays(s);
	struct result *want = malloc(sizeof(*want)), *got = malloc(sizeof(*got));
	struct device *dev;
	char what[64];

	ck_assert_int_eq(device_open(_i ? "0" : "reference", 0, &dev), 0);
	run(s, dev, rays, WIDE, want);
	for (int kind = ACCEL_BVH; kind < N_ACCEL_KINDS; kind++) {
		random_scene_rebuild(s, (enum accel_kind)kind);
		for (enum way way = 0; way < N_WAYS; way++) {
			run(s, dev, rays, way, got);
			snprintf(what, sizeof(what), "kind %d, %s", kind, ways[way].name);
			compare(want, got, what);
			ck_assert_msg(memcmp(want->hits, got->hits, sizeof(got->hits)) == 0, "%s: other bits", what);
		}
	}
	device_close(&dev);
	free(rays);
	free(want);
	free(got);
	random_scene_free(s);
}
END_TEST

/* Rays along the axes through triangles without area: rounding must not produce a hit, for either query. */
START_TEST(any_hit_and_nearest_hit_decide_alike)
{
	struct random_scene *s = random_scene_create(seed_of_run);
	struct ray *rays = make_rays(s);
	struct result *got = malloc(sizeof(*got));
	struct device *dev;

	ck_assert_int_eq(device_open(_i ? "0" : "reference", 0, &dev), 0);
	for (int i = 0; i < 12; i++) /* the axes are the object's */
		s->instances[0].eye_from_obj[i] = s->instances[0].obj_from_eye[i] = i % 5 == 0;
	for (uint32_t i = 0; i < MAX_TRIANGLES; i += 3) /* without area */
		s->index[0][i][2] = s->index[0][i][1];
	accel_destroy(&s->accel);
	ck_assert_int_eq(accel_create(&s->accel), 0);
	s->accel->wide = ACCEL_ROWS | ACCEL_COMPRESSED;
	for (uint32_t i = 0; i < N_RAYS; i++) {
		const uint32_t *index = s->index[0][3 * (i / 4 % (MAX_TRIANGLES / 3))];
		const float share = i % 4 ? 0 : between(s, 0, 1);

		for (uint32_t a = 0; a < 3; a++) {
			const float *p = s->position[0][index[0]], *q = s->position[0][index[1]];

			rays[i].o[a] = p[a] + share * (q[a] - p[a]);
			rays[i].d[a] = a != i / 4 % 3 ? 0.0f : i % 2 ? 1.0f : -1.0f;
		}
		rays[i].o[i / 4 % 3] -= 4 * rays[i].d[i / 4 % 3];
		rays[i].t_min = 0;
		rays[i].t_max = between(s, 0, 5);
	}
	for (int kind = ACCEL_BVH; kind < N_ACCEL_KINDS; kind++) {
		random_scene_rebuild(s, (enum accel_kind)kind);
		for (enum way way = 0; way < N_WAYS; way++) {
			run(s, dev, rays, way, got);
			for (uint32_t i = 0; i < N_RAYS; i++) {
				const struct hit *hit = &got->hits[i];
				const int there = hit->instance != SCENE_NONE;

				ck_assert_msg(!there || s->scene_instances[hit->instance].mesh || hit->primitive % 3,
				              "kind %d, %s: ray %u hits a triangle without area", kind, ways[way].name, i);
				ck_assert_msg(got->occluded[i] == (uint32_t)there, "kind %d, %s: ray %u: occluded %u, nearest hit %d", kind,
				              ways[way].name, i, got->occluded[i], (int)hit->primitive);
			}
		}
	}
	device_close(&dev);
	free(rays);
	free(got);
	random_scene_free(s);
}
END_TEST

/* A mesh whose vertices move keeps its tree, refitted; hits must equal those of a new tree. */
START_TEST(hits_depend_on_no_fitting)
{
	struct random_scene *s = random_scene_create(seed_of_run);
	struct ray *rays = make_rays(s);
	struct result *want = malloc(sizeof(*want)), *got = malloc(sizeof(*got));
	struct scene_mesh *mesh = &s->meshes[0];
	struct accel *moving = s->accel;
	struct device *dev;

	ck_assert_int_eq(device_open(_i ? "0" : "reference", 0, &dev), 0);
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int a = 0; a < 3; a++)
			if (!isfinite(s->position[0][v][a]))
				s->position[0][v][a] = 0;
	for (uint64_t frame = 0; frame < 8; frame++) {
		const uint64_t made = moving->n_made, fitted = moving->n_fitted;

		/* A wave moves through it, finally as high as the mesh; in frame 6 everything moves elsewhere. */
		for (uint32_t v = 0; v < mesh->vertex_count && frame; v++)
			for (int a = 0; a < 3; a++)
				s->position[0][v][a] += frame == 6 ? between(s, -2, 2) :
				                                     0.02f * (float)frame *
				                                             sinf((float)frame +
				                                                  3 * s->position[0][v][(a + 1) % 3]);
		mesh->hash[1] = 1000 + frame;
		s->accel = moving;
		random_scene_rebuild(s, ACCEL_BVH);
		ck_assert_msg(moving->n_fitted == fitted + (frame && frame != 6), "frame %d: fitted", (int)frame);
		ck_assert_msg(moving->n_made == made + !(frame && frame != 6), "frame %d: made", (int)frame);
		run(s, dev, rays, 1, got);
		ck_assert_int_eq(accel_create(&s->accel), 0);
		random_scene_rebuild(s, ACCEL_BVH);
		run(s, dev, rays, 1, want);
		ck_assert_msg(memcmp(want->hits, got->hits, sizeof(got->hits)) == 0, "frame %d: other hits", (int)frame);
		ck_assert_msg(memcmp(want->occluded, got->occluded, sizeof(got->occluded)) == 0, "frame %d: occluded", (int)frame);
		accel_destroy(&s->accel);
	}
	s->accel = moving;
	device_close(&dev);
	free(rays);
	free(want);
	free(got);
	random_scene_free(s);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("rays"), *devices = tcase_create("devices"); /* test_host.py runs these alone */
	const int n_kinds = lacks_driver() ? 1 : 2; /* twins, kernels */

	choose_seed();
	tcase_set_timeout(tests, 120);
	tcase_set_timeout(devices, 120);
	tcase_add_loop_test(tests, twins_find_what_all_triangles_give, ACCEL_BVH, N_ACCEL_KINDS);
	if (n_kinds == 2) {
		tcase_add_loop_test(devices, kernels_agree_with_twins, 0, 2 + 2 * (int)(sizeof(hard_seeds) / sizeof(hard_seeds[0])));
		tcase_add_test(devices, rays_ignore_what_passes);
		tcase_add_test(devices, rays_meet_each_surface_once);
	}
	tcase_add_loop_test(tests, hits_depend_on_no_tree, 0, n_kinds);
	tcase_add_loop_test(tests, any_hit_and_nearest_hit_decide_alike, 0, n_kinds);
	tcase_add_loop_test(tests, hits_depend_on_no_fitting, 0, n_kinds);
	return run_cases(tests, devices, "rays");
}
