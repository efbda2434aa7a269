#include "look/study/studio.h"

#include <math.h>
#include <string.h>

#include "look/drawn.h"
#include "look/solid.h"
#include "look/study/box.h"
#include "look/matrix.h"

/* OpenGL lights at least this share of what is solid. */
#define LEAST_LIT 0.9
/* A light is the viewer's own within 20 degrees of the view, or this share of the way to what it lights. */
#define HEAD_COSINE 0.94
#define HEAD_SHARE 0.25
/* A lamp that was at infinity stands this many diagonals of the scene's box away. */
#define LAMP_DISTANCE 1.6
/* What of a lamp's light falls off by the square of the distance. */
#define FALLS_OFF 0.5
/* What the viewer's own light keeps, and what the lamp beside it has. They meet on the side that faces the lamp, which
 * burns out first: there, where a ball in the box ends, the lamp has its strength. A ball shows 2 / 3 of its light to
 * whence light comes, and to 51 degrees from there, where the lamp is, (sin 51 + cos 51 * (180 - 51) * pi / 180) * 2 /
 * 3 / pi = 0.47, of which 0.87 is left as the lamp falls off: both together leave a ball as bright as it was. */
#define FILL 0.6
#define KEY 0.66
#define NEAR_SIDE 0.29
/* A window that is cleared to more light than this is no dark. */
#define DARK 0.3f
/* What is moved farther is another place, as a share of how far off it is. */
#define MOVED 1e-3

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static int is_other_light(const struct studio_light *known, const struct scene_light *l)
{
	return memcmp(known->diffuse, l->diffuse, sizeof(known->diffuse)) != 0 ||
	       memcmp(known->specular, l->specular, sizeof(known->specular)) != 0;
}

static int has_moved(const float a[4], const float b[4])
{
	double off = 0, far = 0;

	for (int k = 0; k < 4; k++) {
		off += (double)((a[k] - b[k]) * (a[k] - b[k]));
		far += (double)(a[k] * a[k]);
	}
	return off > MOVED * MOVED * far;
}

/* Where a light stands, with w 1; w 0: a direction towards it. */
static void place_of(const struct scene_light *l, float out[4])
{
	const float w = l->position_eye[3];

	for (int k = 0; k < 4; k++)
		out[k] = w != 0 ? l->position_eye[k] / w : l->position_eye[k];
}

/* A light of one draw. now: of the frame's draws so far, by number */
static void note_light(struct studio *s, const struct scene_light *l, const struct scene_light *now[SCENE_MAX_LIGHTS])
{
	struct studio_light *known = &s->lights[l->index];
	float place[4];
	const int is_plain = l->attenuation[0] == 1 && l->attenuation[1] == 0 && l->attenuation[2] == 0 &&
	                     l->spot_cutoff_deg == 180;

	place_of(l, place);
	known->differs |= !is_plain;
	if (now[l->index]) {
		known->differs |= has_moved(known->position, place) || is_other_light(known, l);
		return;
	}
	now[l->index] = l;
	if (known->frames) {
		known->differs |= is_other_light(known, l);
		known->moves |= has_moved(known->position, place);
	}
	memcpy(known->position, place, sizeof(known->position));
	memcpy(known->diffuse, l->diffuse, sizeof(known->diffuse));
	memcpy(known->specular, l->specular, sizeof(known->specular));
	known->frames++;
}

static double distance_to(const float position[4], const double middle[3])
{
	double square = 0;

	for (int k = 0; k < 3; k++)
		square += (position[k] - middle[k]) * (position[k] - middle[k]);
	return sqrt(square);
}

/* 1 where a clear leaves light in the window. */
static int is_bright(const struct scene *scene)
{
	for (uint32_t i = 0; i < scene->n_clears; i++)
		if (scene->clears[i].target == 0 && scene->clears[i].buffers & 1 && scene->clears[i].color_mask & 7 &&
		    fmaxf(scene->clears[i].color[0], fmaxf(scene->clears[i].color[1], scene->clears[i].color[2])) > DARK)
			return 1;
	return 0;
}

void studio_add(struct studio *s, const struct scene *scene, const uint8_t *layers)
{
	const struct scene_light *now[SCENE_MAX_LIGHTS] = { NULL };
	struct box box = box_empty;
	double middle[3], size;
	int has_sky = is_bright(scene), is_around = 0;

	for (uint32_t i = 0; i < scene->n_instances; i++) {
		const struct scene_instance *in = &scene->instances[i];
		const struct scene_material *m = &scene->materials[in->material];
		struct box one;
		double eye[16];

		has_sky |= layers[i] != 0;
		if (!solid_is(scene, in) || drawn_in_parallel(&scene->views[in->view]))
			continue;
		matrix_from_floats(eye, in->modelview);
		one = box_of(scene->meshes[in->mesh], eye);
		is_around |= one.high[2] > 0;
		s->solid++;
		if (!m->lighting)
			continue;
		s->lit++;
		box_widen(&box, one.low);
		box_widen(&box, one.high);
		for (uint32_t k = 0; k < m->light_count; k++)
			note_light(s, &scene->lights[m->light_first + k], now);
	}
	s->skies += (unsigned)has_sky;
	size = box_measure(&box, middle);
	if (!(size > 0))
		return;
	s->frames++;
	s->around += (unsigned)is_around;
	s->size += size;
	for (int k = 0; k < 3; k++)
		s->middle[k] += middle[k];
	for (int i = 0; i < SCENE_MAX_LIGHTS; i++)
		if (now[i])
			s->lights[i].distance += distance_to(s->lights[i].position, middle);
}

/* --- Rules ------------------------------------------------------------------------------------------------------- */

static int is_head_light(const struct studio_light *l, const double middle[3])
{
	const double length = sqrt((double)(l->position[0] * l->position[0] + l->position[1] * l->position[1] +
	                                    l->position[2] * l->position[2]));

	if (l->position[3] == 0)
		return (double)l->position[2] > HEAD_COSINE * length;
	return length < HEAD_SHARE * sqrt(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]);
}

static void write_color(const char *key, const float color[3], double share, FILE *out)
{
	fprintf(out, "    %s: [%.4g, %.4g, %.4g]\n", key, share * (double)color[0], share * (double)color[1],
	        share * (double)color[2]);
}

/* As strong as OpenGL has it at a distance, stronger before, weaker behind. */
static void write_falling(double distance, FILE *out)
{
	fprintf(out, "    attenuation: [%g, 0, %.5g]\n", 1 - FALLS_OFF, FALLS_OFF / (distance * distance));
}

/* A lamp at a distance from the middle, in a direction. */
static void write_place(const double middle[3], const double towards[3], double distance, FILE *out)
{
	const double length = sqrt(matrix_dot3(towards, towards));

	fprintf(out, "    position: [%.5g, %.5g, %.5g, 1]\n", middle[0] + distance * towards[0] / length,
	        middle[1] + distance * towards[1] / length, middle[2] + distance * towards[2] / length);
}

static void write_head(const struct studio_light *l, unsigned number, const double middle[3], double size, FILE *out)
{
	static const double aside[3] = { -0.6, 0.7, 0.75 };

	fprintf(out,
	        "  - role: light of the viewer\n    confidence: 0.8\n    why: \"it comes from where the viewer is, and "
	        "shows no shadow\"\n    light: %u\n",
	        number);
	write_color("diffuse", l->diffuse, FILL, out);
	write_color("specular", l->specular, FILL, out);
	fprintf(out, "    shadows: no\n  - role: lamp of a studio\n    confidence: 0.5\n    why: \"what the light of "
	             "the viewer lacks comes from aside\"\n");
	write_place(middle, aside, LAMP_DISTANCE * size, out);
	write_falling((LAMP_DISTANCE - NEAR_SIDE) * size, out);
	write_color("diffuse", l->diffuse, KEY, out);
	write_color("specular", l->specular, FILL, out);
}

/* A light from where the viewer does not look: from infinity it comes near, and falls off. */
static void write_one(const struct studio_light *l, unsigned number, const double middle[3], double size, FILE *out)
{
	const double towards[3] = { (double)l->position[0], (double)l->position[1], (double)l->position[2] };

	fprintf(out,
	        "  - role: lamp of a studio\n    confidence: 0.6\n    why: \"it lights things before an empty window, "
	        "and is as strong far off as near\"\n    light: %u\n",
	        number);
	if (l->position[3] == 0)
		write_place(middle, towards, LAMP_DISTANCE * size, out);
	write_falling(l->position[3] == 0 ? LAMP_DISTANCE * size : l->distance / l->frames, out);
}

unsigned studio_write(const struct studio *s, FILE *out)
{
	const double size = s->size / s->frames,
		     middle[3] = { s->middle[0] / s->frames, s->middle[1] / s->frames, s->middle[2] / s->frames };
	unsigned n = 0;

	if (!s->frames || s->skies || !(s->lit >= LEAST_LIT * s->solid))
		return 0;
	for (unsigned i = 0; i < SCENE_MAX_LIGHTS; i++) {
		const struct studio_light *l = &s->lights[i];

		/* A light at infinity that moves is a sun of the world, and one of a world around the viewer comes from
		 * outside of it. */
		if (!l->frames || l->differs || ((l->moves || s->around) && l->position[3] == 0))
			continue;
		n++;
		if (out && !l->moves && is_head_light(l, middle))
			write_head(l, i, middle, size, out);
		else if (out)
			write_one(l, i, middle, size, out);
	}
	return n;
}
