#include "tracer/frame/light/photons.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/frame/light/sample.h"
#include "kernels/gl/light.h"
#include "tracer/frame/light/buffers.h"
#include "tracer/frame/light/secondary.h"

#define PHOTONS_OF_PASS (1u << 17)
#define RADIUS_FIRST 0.08f    /* first radius, relative to that of the smallest object that photons are sent to */
#define RADIUS_SHRINKS 0.667f /* alpha of the paper, sec. 4 */
#define FLATNESS 0.3f         /* photons off a pixel's plane by more than this times the radius are ignored */

/* Photons from one light to one instance that reflects or refracts, within a ball around it. */
struct beam {
	const struct scene_light *light;
	uint32_t instance;
	struct vec3 centre;
	float radius;
};

/* The share of the light that a photon carries: its beam, and the solid angle (steradians) or area that it
 * represents. */
struct sent {
	uint32_t beam;
	float share;
};

struct photons {
	const struct frame *frame;
	const struct accel_space *space;
	struct beam *beams;
	uint32_t n_beams;
	float far; /* distance from the viewer, beyond all surfaces */
	float smallest;

	/* buffers of one pass */
	struct ray *rays;
	struct path *paths;
	struct sent *sent;
	struct photon *found; /* weight: the light it carries; number: the next photon in its cell of the grid */
	uint32_t n_found, room;
	uint32_t *cells; /* [CELLS] first photon of each cell; SCENE_NONE: none */
	int lacks_memory;
};
#define CELLS (1u << 18)

/* --- Beams ------------------------------------------------------------------------------------------------------- */

static struct vec3 eye_position(const struct instance *instance, const float o[4])
{
	const float *m = instance->eye_from_obj;
	float out[3];

	for (int i = 0; i < 3; i++)
		out[i] = (m[4 * i] * o[0] + m[4 * i + 1] * o[1] + m[4 * i + 2] * o[2]) / o[3] + m[4 * i + 3];
	return v3_load(out);
}

static float length_of(struct vec3 v)
{
	return sqrtf(v3_dot(v, v));
}

/* Compute the ball around an instance's vertices, centred on their box. radius: receives 0 if there is none */
static struct vec3 ball_about(const struct scene_mesh *mesh, const struct instance *instance, float *radius)
{
	struct vec3 lo = v3(FLT_MAX, FLT_MAX, FLT_MAX), hi = v3_scale(lo, -1), centre;
	float most = 0;

	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		const struct vec3 at = eye_position(instance, mesh->position + 4 * (size_t)v);

		lo = v3(fminf(lo.x, at.x), fminf(lo.y, at.y), fminf(lo.z, at.z));
		hi = v3(fmaxf(hi.x, at.x), fmaxf(hi.y, at.y), fmaxf(hi.z, at.z));
	}
	centre = v3_scale(v3_add(lo, hi), 0.5f);
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		most = fmaxf(most, length_of(v3_sub(eye_position(instance, mesh->position + 4 * (size_t)v), centre)));
	*radius = isfinite(most) ? most : 0;
	return centre;
}

static int is_same_light(const struct scene_light *a, const struct scene_light *b)
{
	return memcmp(a, b, sizeof(*a)) == 0;
}

/* 1 if a light shines and does not repeat an earlier one in the list. */
static int is_asked(const struct scene *scene, uint32_t light)
{
	const struct scene_light *l = &scene->lights[light];

	for (uint32_t i = 0; i < light; i++)
		if (is_same_light(l, &scene->lights[i]))
			return 0;
	return l->diffuse[0] > 0 || l->diffuse[1] > 0 || l->diffuse[2] > 0;
}

/* 1 if photons are sent to an instance: it reflects or refracts light, in this space. */
static int is_sent_to(const struct photons *p, const struct instance *instance)
{
	const struct scene_surface *s = &p->frame->scene->materials[instance->material].surface;

	return instance->flags & INSTANCE_SECONDARY &&
	       p->frame->prepared.scene_views[instance->view].space == p->space->space &&
	       (s->reflect > 0 || s->transmit > 0) && !(s->hidden & SCENE_NEAR_MIRROR);
}

static int add_beams(struct photons *p, uint32_t number, struct vec3 centre, float radius)
{
	const struct scene *scene = p->frame->scene;

	for (uint32_t i = 0; i < scene->n_lights; i++) {
		struct beam *grown;

		if (!is_asked(scene, i))
			continue;
		grown = realloc(p->beams, (p->n_beams + 1) * sizeof(*p->beams));
		if (!grown)
			return err_report(ERR_SYSTEM, NULL, "out of memory");
		p->beams = grown;
		p->beams[p->n_beams++] = (struct beam){ &scene->lights[i], number, centre, radius };
	}
	return 0;
}

static int find_beams(struct photons *p)
{
	const struct prepared *prepared = &p->frame->prepared;
	int err = 0;

	p->smallest = FLT_MAX;
	for (uint32_t i = 0; i < prepared->n_instances && !err; i++) {
		const struct instance *instance = &prepared->instances[i];
		const struct scene_mesh *mesh =
			p->frame->scene->meshes[p->frame->scene->instances[instance->scene_instance].mesh];
		struct vec3 centre;
		float radius;

		if (!(instance->flags & INSTANCE_SECONDARY))
			continue;
		centre = ball_about(mesh, instance, &radius);
		p->far = fmaxf(p->far, length_of(centre) + radius);
		if (!is_sent_to(p, instance) || !(radius > 0))
			continue;
		p->smallest = fminf(p->smallest, radius);
		err = add_beams(p, i, centre, radius);
	}
	return err;
}

/* --- Sending ----------------------------------------------------------------------------------------------------- */

/* Send parallel light from beyond all surfaces, evenly over the ball's disk. @return area shared by all photons of the
 * beam */
static float send_parallel(const struct photons *p, const struct beam *b, const float at[2], struct ray *ray)
{
	const struct vec3 d = v3_scale(v3_normalize(v3_load(b->light->position_eye)), -1);
	const struct vec3 on_disk = v3_add(b->centre, v3_scale(sample_disk(d, at[0], at[1]), b->radius));

	v3_store(ray->d, d);
	v3_store(ray->o, v3_sub(on_disk, v3_scale(d, 2 * p->far + b->radius)));
	return (float)M_PI * b->radius * b->radius;
}

/* Send light from a point, or from a disk with the light's radius, evenly over the cone around the ball. @return solid
 * angle of the cone, times the spotlight's attenuation */
static float send_from_place(const struct beam *b, const float at[2][2], struct ray *ray)
{
	const struct scene_light *l = b->light;
	const struct vec3 middle = v3_scale(v3_load(l->position_eye), 1 / l->position_eye[3]);
	const struct vec3 disk = sample_disk(v3_normalize(v3_sub(b->centre, middle)), at[1][0], at[1][1]);
	const struct vec3 from = v3_add(middle, v3_scale(disk, fmaxf(l->radius, 0))), to = v3_sub(b->centre, from),
			  axis = v3_normalize(to);
	const float share = b->radius / fmaxf(length_of(to), FLT_MIN),
		    least = share < 1 ? sqrtf(1 - share * share) : -1; /* inside the ball: all directions */
	const float cosine = 1 - at[0][0] * (1 - least), sine = sqrtf(fmaxf(1 - cosine * cosine, 0)),
		    turn = 2 * (float)M_PI * at[0][1];
	struct vec3 u, v, d;

	sample_basis(axis, &u, &v);
	d = v3_add(v3_scale(axis, cosine), v3_add(v3_scale(u, sine * cosf(turn)), v3_scale(v, sine * sinf(turn))));
	v3_store(ray->o, from);
	v3_store(ray->d, d);
	return 2 * (float)M_PI * (1 - least) * light_spot(l, v3_scale(d, -1));
}

/* Make the photons of a pass, the same number for each beam. */
static uint32_t make_photons(struct photons *p, uint32_t pass)
{
	const uint32_t each = PHOTONS_OF_PASS / p->n_beams ? PHOTONS_OF_PASS / p->n_beams : 1;
	uint32_t n = 0;

	for (uint32_t b = 0; b < p->n_beams && n < PHOTONS_OF_PASS; b++)
		for (uint32_t i = 0; i < each; i++, n++) {
			const struct beam *beam = &p->beams[b];
			struct ray *ray = &p->rays[n];
			float at[2][2];

			sample_sobol(sample_hash(2 * b), pass * each + i, &at[0][0], &at[0][1]);
			sample_sobol(sample_hash(2 * b + 1), pass * each + i, &at[1][0], &at[1][1]);
			*ray = (struct ray){ .t_max = 1e30f };
			p->sent[n].beam = b;
			p->sent[n].share = (beam->light->position_eye[3] != 0 ?
			                            send_from_place(beam, (const float(*)[2])at, ray) :
			                            send_parallel(p, beam, at[0], ray)) /
			                   (float)each;
			p->paths[n] = (struct path){
				.weight = { 1, 1, 1 }, .target = n, .kind = beam->instance, .medium = SCENE_NONE
			};
		}
	return n;
}

/* --- Finding ----------------------------------------------------------------------------------------------------- */

static int is_lit_by(const struct scene *scene, const struct scene_material *m, const struct scene_light *light)
{
	for (uint32_t i = 0; i < m->light_count; i++)
		if (is_same_light(&scene->lights[m->light_first + i], light))
			return 1;
	return 0;
}

/* The light that a photon brings to a white surface, concentrated in one point. */
static void brightness(const struct photons *p, const struct photon *photon, float out[3])
{
	const struct sent *sent = &p->sent[photon->number];
	const struct scene_light *l = p->beams[sent->beam].light;
	const float d = photon->length, is_placed = l->position_eye[3] != 0;
	const float weakened = is_placed ? 1 / (l->attenuation[0] + d * (l->attenuation[1] + d * l->attenuation[2])) :
	                                   1;

	for (int c = 0; c < 3; c++) {
		const float shown = l->diffuse[c] * weakened,
			    light = p->frame->options->display ? shown : image_linear_from_display(shown);

		out[c] = photon->weight[c] * light * sent->share * (is_placed ? d * d : 1);
	}
}

static void take(void *user, const struct photon *photons, uint32_t n)
{
	struct photons *p = user;
	const struct scene *scene = p->frame->scene;

	for (uint32_t i = 0; i < n && !p->lacks_memory; i++) {
		struct photon *found;

		if (photons[i].number == SCENE_NONE || !is_lit_by(scene, &scene->materials[photons[i].material],
		                                                  p->beams[p->sent[photons[i].number].beam].light))
			continue;
		if (p->n_found == p->room) {
			found = realloc(p->found, 2 * ((size_t)p->room + 1024) * sizeof(*found));
			p->lacks_memory = !found;
			if (!found)
				break;
			p->found = found;
			p->room = 2 * (p->room + 1024);
		}
		found = &p->found[p->n_found++];
		*found = photons[i];
		brightness(p, &photons[i], found->weight);
	}
}

static uint32_t cell_of(int32_t x, int32_t y, int32_t z)
{
	return sample_hash((uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^ (uint32_t)z * 83492791u) % CELLS;
}

static int32_t cell_along(float x, float size)
{
	return (int32_t)fmaxf(fminf(floorf(x / size), 1e9f), -1e9f);
}

/* Make lists of the photons in each cell; a cell's side is twice the radius. */
static void sort_into_cells(struct photons *p, float radius)
{
	memset(p->cells, 0xff, CELLS * sizeof(*p->cells));
	for (uint32_t i = 0; i < p->n_found; i++) {
		const float *at = p->found[i].position;
		uint32_t *first = &p->cells[cell_of(cell_along(at[0], 2 * radius), cell_along(at[1], 2 * radius),
		                                    cell_along(at[2], 2 * radius))];

		p->found[i].number = *first;
		*first = i;
	}
}

/* List the cells within a radius of a point: two along each axis. Cells with the same hash are listed once. */
static uint32_t cells_about(const float at[3], float radius, uint32_t out[8])
{
	int32_t base[3];
	uint32_t n = 0;

	for (int i = 0; i < 3; i++)
		base[i] = cell_along(at[i] - radius, 2 * radius);
	for (int k = 0; k < 8; k++) {
		const uint32_t cell = cell_of(base[0] + (k & 1), base[1] + (k >> 1 & 1), base[2] + (k >> 2));
		int is_new = 1;

		for (uint32_t i = 0; i < n; i++)
			is_new &= out[i] != cell;
		if (is_new)
			out[n++] = cell;
	}
	return n;
}

/* Add a photon's light if it landed on a point's surface within the radius. */
static void gather_photon(const struct photon *photon, const float at[3], const float normal[3], float radius,
                          float sum[3])
{
	float square = 0, height = 0, cosine = 0;

	for (int i = 0; i < 3; i++) {
		const float off = photon->position[i] - at[i];

		square += off * off;
		height += off * normal[i];
		cosine -= photon->direction[i] * normal[i];
	}
	if (square > radius * radius || fabsf(height) > FLATNESS * radius || cosine <= 0)
		return;
	for (int i = 0; i < 3; i++)
		sum[i] += photon->weight[i];
}

static void gather(const struct photons *p, const float *const planes[9], float radius, float share,
                   float *const out[3])
{
	const float scale = share / ((float)M_PI * radius * radius);

	for (size_t i = 0; i < (size_t)p->frame->width * p->frame->height; i++) {
		const float normal[3] = { planes[0][i], planes[1][i], planes[2][i] },
			    at[3] = { planes[3][i], planes[4][i], planes[5][i] };
		uint32_t cells[8], n;
		float sum[3] = { 0, 0, 0 };

		if (!(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] > 0.25f))
			continue;
		n = cells_about(at, radius, cells);
		for (uint32_t k = 0; k < n; k++)
			for (uint32_t photon = p->cells[cells[k]]; photon != SCENE_NONE;
			     photon = p->found[photon].number)
				gather_photon(&p->found[photon], at, normal, radius, sum);
		for (int c = 0; c < 3; c++)
			out[c][i] += sum[c] * scale * planes[6 + c][i];
	}
}

/* --- A frame ----------------------------------------------------------------------------------------------------- */

static int run_pass(struct photons *p, uint32_t pass)
{
	struct tracer *tr = p->frame->tr;
	const uint32_t n = make_photons(p, pass);
	int err = launch_upload(tr->dev, tr->light->path_rays, p->rays, n);

	p->n_found = 0;
	if (!err)
		err = launch_upload(tr->dev, tr->light->paths, p->paths, n);
	if (!err)
		err = secondary_photons(p->frame, p->space, pass, n, take, p);
	return err || !p->lacks_memory ? err : err_report(ERR_SYSTEM, NULL, "out of memory");
}

static int run(struct photons *p, const float *const planes[9], float *const out[3])
{
	const uint32_t passes = (p->frame->options->photons + PHOTONS_OF_PASS - 1) / PHOTONS_OF_PASS;
	float radius = RADIUS_FIRST * p->smallest * sqrtf((float)(p->n_beams < 16 ? p->n_beams : 16));
	int err = 0;

	p->rays = malloc(PHOTONS_OF_PASS * sizeof(*p->rays));
	p->paths = malloc(PHOTONS_OF_PASS * sizeof(*p->paths));
	p->sent = malloc(PHOTONS_OF_PASS * sizeof(*p->sent));
	p->cells = malloc(CELLS * sizeof(*p->cells));
	if (!p->rays || !p->paths || !p->sent || !p->cells)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t pass = 0; pass < passes && !err; pass++) {
		err = run_pass(p, pass);
		if (err)
			break;
		sort_into_cells(p, radius);
		gather(p, planes, radius, 1 / (float)passes, out);
		radius *= sqrtf(((float)pass + 1 + RADIUS_SHRINKS) / ((float)pass + 2));
	}
	free(p->rays);
	free(p->paths);
	free(p->sent);
	free(p->cells);
	free(p->found);
	return err;
}

int photons_add(const struct frame *frame, struct image *img)
{
	static const char *const needed[9] = { "N.X", "N.Y",      "N.Z",      "P.X",     "P.Y",
		                               "P.Z", "albedo.R", "albedo.G", "albedo.B" };
	static const char *const added[3] = { "caustics.R", "caustics.G", "caustics.B" };
	const struct segment *main = prepare_main_segment(&frame->prepared);
	struct photons p = { .frame = frame, .space = main ? secondary_space(frame, main->view, 0) : NULL };
	const float *planes[9];
	float *out[3];
	int err = 0;

	for (int c = 0; c < 3; c++) {
		out[c] = image_add_channel(img, added[c], 0);
		if (!out[c])
			return ERR_SYSTEM;
	}
	for (int i = 0; i < 9; i++) {
		planes[i] = image_channel(img, needed[i]);
		if (!planes[i])
			return ERR_SYSTEM;
	}
	err = p.space ? find_beams(&p) : 0;
	if (!err && p.n_beams)
		err = run(&p, planes, out);
	free(p.beams);
	return err;
}
