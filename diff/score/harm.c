/*
 * Gate N: is a frame darker than its shadows explain? Two figures; for the third see burnt.h.
 *
 * Dark without an edge. A shadow cast by something ends somewhere: beside it the same surface is lit. If a light was
 * blocked entirely by mistake, the dark ends at outlines, or where OpenGL itself shows no light. Pixels are dark if
 * they lose at least DARK_CODES and 30 % of their light; adjacent ones form a patch. A pixel's neighbour is an edge if
 * it is not dark, lies on the same surface (the same draw, or normals within 37 degrees, and in its plane as far as
 * depth tells) and shows a quarter more light per unit of its own colour than the dark pixel, either at once or, as in
 * the penumbra of a wide light, within PENUMBRA pixels. If a film is blended over either pixel, the colour is not known
 * (the albedo is the film's, as black as a drawn shadow's), and the light itself is compared. Light is gl x shadow +
 * relight: where a drawn shadow is replaced by a traced one, gl x shadow still has both. A patch is explained if its
 * edges are at least a quarter as long as the side of a square of its area; patches below LEAST_PATCH pixels are
 * ignored. Bar: 2 % of the frame. A correct room in the shade of its own walls took 1.1 % (rooms lit by OpenGL),
 * seventeen other frames up to 0.03 %; a closed hall 82 %, a lit figure between unlit walls 3.4 %.
 *
 * Known faults. Pixels that lost light to something other than a shadow: flat faces that block light which their smooth
 * normals face (the shadow terminator: the normal faces a light, the plane of the pixels does not, and light from all
 * around, dimmed by nearby things, does not explain it); dark pixels of crossed cards that shade each other (attribute
 * relume:cards); and lit pictures of framebuffer objects that no ray saw (relume:targets). Bar: 0.3 % of the frame,
 * because genuine shadows may fall on such places: up to 0.08 % (the hall). Low-poly blocks took 0.7 %, trees of
 * crossed cards 2 % and more.
 *
 * The renderer stores in attributes what a picture cannot show. relume:lights: places in eye space. relume:dimmed: the
 * least share of display codes that light from all around leaves. relume:cards and relume:targets: draw numbers, if
 * rules kept these from being spared. relume:left-out: draws of faked effects that traced light replaces; the surface
 * is what lies below them. Frames without attributes are judged by their contents.
 */
#include "diff/score/measures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/vec3.h"
#include "diff/score/burnt.h"
#include "diff/score/picture.h"

#define DARK_CODES 16    /* a clearly visible step */
#define DARK_SHARE 0.7f  /* share of the light that remains */
#define LEAST_PATCH 64u
#define PENUMBRA 32 /* pixels */
#define EDGE_PER_SIDE 0.25
enum { MOST_LIGHTS = 16 };

struct harm {
	const struct gate_frame *f;
	uint32_t width, height;
	const float *gl[3], *shadow[3], *albedo[3], *id;
	const float *normal[3], *place[3]; /* eye space: channels N and P */
	const float *relight[3];     /* [0] NULL: nothing is relit */
	const float *layers;         /* NULL: the frame has no such channel */
	struct frame_list left_out;  /* draws of faked effects, which are not surfaces */
	float lights[MOST_LIGHTS][4]; /* eye space; w 0: a direction */
	int n_lights;
	int is_display;  /* 1: colours are display-referred, 0: linear light */
	float dimmed;    /* relume:dimmed; 1: there is no light from all around */
	float *light;    /* [n]: luminance of gl x shadow + relight */
	uint8_t *dark;   /* [n]: 1: dark; 2: dark, and in a patch already collected */
	uint32_t *patch; /* [n]: the pixels of one patch */
};

static int find_planes(const struct image *img, const char *layer, const char *letters, const float *planes[3])
{
	for (int c = 0; c < 3; c++) {
		char name[16];

		snprintf(name, sizeof(name), "%s.%c", layer, letters[c]);
		planes[c] = image_channel(img, name);
		if (!planes[c])
			return 0;
	}
	return 1;
}

static int find_all_planes(const struct image *img, struct harm *h)
{
	h->id = image_channel(img, "id");
	h->layers = image_channel(img, "layers");
	if (!find_planes(img, "relight", "RGB", h->relight))
		h->relight[0] = NULL;
	return h->id && find_planes(img, "gl", "RGB", h->gl) && find_planes(img, "shadow", "RGB", h->shadow) &&
	       find_planes(img, "albedo", "RGB", h->albedo) && find_planes(img, "N", "XYZ", h->normal) &&
	       find_planes(img, "P", "XYZ", h->place);
}

static float luminance(float red, float green, float blue)
{
	return 0.2126f * red + 0.7152f * green + 0.0722f * blue;
}

static float gl_light(const struct harm *h, size_t i)
{
	return luminance(h->gl[0][i], h->gl[1][i], h->gl[2][i]);
}

/* Light per unit of a surface's albedo. */
static float shade(const struct harm *h, size_t i)
{
	return h->light[i] / fmaxf(luminance(h->albedo[0][i], h->albedo[1][i], h->albedo[2][i]), 1e-4f);
}

/* 1 if a pixel shows a quarter more light than another. */
static int is_lighter(const struct harm *h, size_t i, size_t than)
{
	if (h->layers && (h->layers[i] > 0 || h->layers[than] > 0))
		return h->light[i] > 1.25f * h->light[than];
	return shade(h, i) > 1.25f * shade(h, than);
}

/* Fill `light` and `dark`. */
static void find_dark(const struct harm *h, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		float gl = gl_light(h, i), left;
		int lost;

		left = luminance(h->gl[0][i] * h->shadow[0][i], h->gl[1][i] * h->shadow[1][i], h->gl[2][i] * h->shadow[2][i]);
		if (h->relight[0])
			left += luminance(h->relight[0][i], h->relight[1][i], h->relight[2][i]);
		lost = h->is_display ? (int)(255 * (gl - left)) : score_code_from_linear(gl) - score_code_from_linear(left);
		h->light[i] = left;
		h->dark[i] = !score_ignores(h->f->ref, i) && lost >= DARK_CODES && left < DARK_SHARE * gl;
	}
}

/* The vector from pixel b's place to pixel a's. */
static void subtract(const struct harm *h, size_t a, size_t b, float out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = h->place[k][a] - h->place[k][b];
}

static void normal_at(const struct harm *h, size_t i, float out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = h->normal[k][i];
}

/* 1 if a pixel's place and normal belong to a faked effect, and so are not those of the surface below. */
static int is_left_out(const struct harm *h, size_t i)
{
	return h->left_out.n_ranges && h->id[i] >= 1 && frame_list_contains(&h->left_out, (uint64_t)h->id[i]);
}

/* 1 if two adjacent pixels show one surface. */
static int is_same_surface(const struct harm *h, size_t i, size_t other)
{
	float apart[3], normal[3], normal_there[3];

	if (is_left_out(h, i) || is_left_out(h, other))
		return 1;
	subtract(h, other, i, apart);
	normal_at(h, i, normal);
	normal_at(h, other, normal_there);
	return (h->id[i] == h->id[other] || vec3f_dot(normal, normal_there) > 0.8f) &&
	       fabsf(vec3f_dot(apart, normal)) < 0.3f * sqrtf(vec3f_dot(apart, apart));
}

/* 1 if a shadow ends beside a dark pixel, at once or over a penumbra: towards x + dx, y + dy the surface continues with
 * more light. */
static int is_edge(const struct harm *h, uint32_t dark, int dx, int dy)
{
	uint32_t x = dark % h->width, y = dark / h->width, i = dark;

	for (int step = 0; step < PENUMBRA; step++) {
		const uint32_t next = (y + (uint32_t)dy) * h->width + x + (uint32_t)dx;

		x += (uint32_t)dx;
		y += (uint32_t)dy;
		if (x >= h->width || y >= h->height || h->dark[next] || !is_same_surface(h, i, next))
			return 0;
		if (is_lighter(h, next, dark))
			return 1;
		i = next;
	}
	return 0;
}

/* Collect the patch of a dark pixel in h->patch; *edge: the length of its edges. @return its size */
static uint32_t collect_patch(const struct harm *h, uint32_t start, uint64_t *edge)
{
	uint32_t n = 0;

	*edge = 0;
	h->dark[start] = 2;
	h->patch[n++] = start;
	for (uint32_t next = 0; next < n; next++) {
		const uint32_t i = h->patch[next], x = i % h->width, y = i / h->width;
		const uint32_t around[4] = { x ? i - 1 : i, x + 1 < h->width ? i + 1 : i, y ? i - h->width : i,
			                     y + 1 < h->height ? i + h->width : i };
		static const int steps[4][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };

		for (int k = 0; k < 4; k++) {
			*edge += (uint64_t)is_edge(h, i, steps[k][0], steps[k][1]);
			if (h->dark[around[k]] == 1) {
				h->dark[around[k]] = 2;
				h->patch[n++] = around[k];
			}
		}
	}
	return n;
}

/* Count and blame the pixels of patches that no edge explains. */
static uint64_t count_unbounded(const struct harm *h, uint32_t n)
{
	uint64_t unbounded = 0;

	for (uint32_t start = 0; start < n; start++) {
		uint64_t edge;
		uint32_t size;

		if (h->dark[start] != 1)
			continue;
		size = collect_patch(h, start, &edge);
		if (size < LEAST_PATCH || (double)edge >= EDGE_PER_SIDE * sqrt(size))
			continue;
		unbounded += size;
		for (uint32_t k = 0; k < size; k++)
			h->f->blamed[h->patch[k]] = 1;
	}
	return unbounded;
}

/* --- Known faults ------------------------------------------------------------------------------------------------ */

static void read_lights(struct harm *h)
{
	const char *at = image_attribute(h->f->img, "relume:lights");
	float *l = h->lights[0];
	int length;

	for (;
	     at && h->n_lights < MOST_LIGHTS && sscanf(at, " %f %f %f %f%n", &l[0], &l[1], &l[2], &l[3], &length) == 4;
	     l += 4) {
		h->n_lights++;
		at += length + (at[length] == ',');
	}
}

/* Plane of a pixel and its neighbours in the same draw, on its normal's side. @return 0: none */
static int plane_at(const struct harm *h, uint32_t i, const float normal[3], float out[3])
{
	const uint32_t x = i % h->width, y = i / h->width;
	const uint32_t u = x + 1 < h->width && h->id[i + 1] == h->id[i] ? i + 1 : x ? i - 1 : i;
	const uint32_t v = y + 1 < h->height && h->id[i + h->width] == h->id[i] ? i + h->width : y ? i - h->width : i;
	float a[3], b[3], length, side;

	if (u == i || v == i || h->id[u] != h->id[i] || h->id[v] != h->id[i])
		return 0;
	subtract(h, u, i, a);
	subtract(h, v, i, b);
	vec3f_cross(a, b, out);
	length = sqrtf(vec3f_dot(out, out));
	side = vec3f_dot(out, normal) < 0 ? -1.0f : 1.0f;
	for (int k = 0; k < 3; k++)
		out[k] *= side / length;
	return length > 0 && vec3f_dot(out, normal) > 0.5f; /* else the neighbours lie on another face */
}

/* 1 if a pixel is darker than light from all around leaves it, however close occluders are. */
static int is_darker_than_dimmed(const struct harm *h, uint32_t i)
{
	if (h->is_display)
		return h->light[i] < h->dimmed * gl_light(h, i);
	return score_code_from_linear(h->light[i]) < h->dimmed * score_code_from_linear(gl_light(h, i));
}

/* 1 if a dark pixel's normal faces a light that its own plane faces away from. */
static int is_terminator(const struct harm *h, uint32_t i)
{
	float normal[3], plane[3];

	normal_at(h, i, normal);
	if (!h->dark[i] || !is_darker_than_dimmed(h, i) || !plane_at(h, i, normal, plane))
		return 0;
	for (int l = 0; l < h->n_lights; l++) {
		const float *light = h->lights[l];
		float to[3], length;

		for (int k = 0; k < 3; k++)
			to[k] = light[3] != 0 ? light[k] / light[3] - h->place[k][i] : light[k];
		length = sqrtf(vec3f_dot(to, to));
		if (vec3f_dot(normal, to) > 0.05f * length && vec3f_dot(plane, to) < -0.02f * length)
			return 1;
	}
	return 0;
}

/* Count and blame the pixels of draws that an attribute lists. dark: 1: only dark ones */
static uint64_t count_named(const struct harm *h, const char *attribute, uint32_t n, int dark)
{
	const char *text = image_attribute(h->f->img, attribute);
	struct frame_list draws = { 0 };
	uint64_t count = 0;

	if (!text || !*text || frame_list_parse(text, &draws) != 0)
		return 0;
	for (uint32_t i = 0; i < n; i++)
		if ((!dark || h->dark[i]) && h->id[i] >= 1 && frame_list_contains(&draws, (uint64_t)h->id[i])) {
			h->f->blamed[i] = 1;
			count++;
		}
	frame_list_free(&draws);
	return count;
}

/* Count and blame pixels with a known fault. */
static uint64_t count_faults(const struct harm *h, uint32_t n)
{
	uint64_t faults = count_named(h, "relume:cards", n, 1) + count_named(h, "relume:targets", n, 0);

	for (uint32_t i = 0; i < n; i++)
		if (is_terminator(h, i)) {
			h->f->blamed[i] = 1;
			faults++;
		}
	return faults;
}

int gate_harm(struct gate_frame *f)
{
	const uint32_t n = f->img->width * f->img->height;
	const char *encoding = image_attribute(f->img, "relume:encoding"), *dimmed = image_attribute(f->img, "relume:dimmed");
	const char *left_out = image_attribute(f->img, "relume:left-out");
	struct harm h = { .f = f,
		          .width = f->img->width,
		          .height = f->img->height,
		          .is_display = encoding && strcmp(encoding, "display") == 0,
		          .dimmed = dimmed ? strtof(dimmed, NULL) : 1 };
	int err = 0;

	if (!find_all_planes(f->img, &h)) {
		gate_note(f, GATE_N, "the frame has no gl, shadow, albedo, N, P and id channels");
		return 0;
	}
	if (left_out && *left_out)
		frame_list_parse(left_out, &h.left_out);
	h.light = malloc((n + (size_t)1) * sizeof(*h.light));
	h.dark = malloc(n + (size_t)1);
	h.patch = malloc((n + (size_t)1) * sizeof(*h.patch));
	if (h.light && h.dark && h.patch) {
		read_lights(&h);
		find_dark(&h, n);
		gate_measure(f, GATE_N, 0, 100 * (double)count_unbounded(&h, n) / n);
		gate_measure(f, GATE_N, 1, 100 * (double)count_faults(&h, n) / n);
		gate_measure(f, GATE_N, 2, 100 * burnt_share(f));
	} else {
		err = err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", h.width, h.height);
	}
	frame_list_free(&h.left_out);
	free(h.light);
	free(h.dark);
	free(h.patch);
	return err;
}
