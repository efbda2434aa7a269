#include "tracer/frame/prepare/prepare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "gl_tokens.h"
#include "kernels/camera/camera.h"
#include "scene/backdrop.h"
#include "scene/depths.h"
#include "scene/program.h"
#include "scene/skies.h"

/* --- Matrices ---------------------------------------------------------------------------------------------------- */

/* Compute the rows of the inverse transpose of the upper 3 x 3, rescaled for RESCALE_NORMAL (sec. 2.11.3). */
static void normal_matrix(const float m[16], int rescale, float out[12])
{
	double a[3][3], cofactor[3][3], det, scale = 1, length = 0;

	for (int row = 0; row < 3; row++)
		for (int col = 0; col < 3; col++)
			a[row][col] = m[col * 4 + row];
	for (int row = 0; row < 3; row++)
		for (int col = 0; col < 3; col++) {
			int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (col + 1) % 3, c2 = (col + 2) % 3;

			cofactor[row][col] = a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1];
		}
	det = a[0][0] * cofactor[0][0] + a[0][1] * cofactor[0][1] + a[0][2] * cofactor[0][2];
	if (det != 0)
		scale = 1 / det;
	if (rescale) {
		/* the bottom row of the inverse is the last row of the transposed cofactors: their third column */
		for (int row = 0; row < 3; row++)
			length += cofactor[row][2] * scale * cofactor[row][2] * scale;
		if (length > 0)
			scale /= sqrt(length);
	}
	for (int row = 0; row < 3; row++) {
		for (int col = 0; col < 3; col++)
			out[row * 4 + col] = (float)(cofactor[row][col] * scale);
		out[row * 4 + 3] = 0;
	}
}

static void rows_from_columns(const float m[16], float rows[12])
{
	for (int row = 0; row < 3; row++)
		for (int col = 0; col < 4; col++)
			rows[row * 4 + col] = m[col * 4 + row];
}

static void identity_rows(float rows[12])
{
	memset(rows, 0, 12 * sizeof(*rows));
	rows[0] = rows[5] = rows[10] = 1;
}

/* Compute the affine inverse in rows. @return 0 if the matrix is projective, or has no inverse within the range of
 * floats */
static int invert_affine(const float m[16], float rows[12])
{
	float inverse[16], finite = 0;

	if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1 || !mat4_invert(inverse, m))
		return 0;
	for (int i = 0; i < 16; i++)
		finite += 0 * inverse[i];
	rows_from_columns(inverse, rows);
	/* Almost flat: rays in object space would be too inaccurate. */
	for (int row = 0; row < 3; row++)
		for (int col = 0; col < 3; col++)
			if (fabsf(rows[row * 4 + col]) > 1e12f)
				return 0;
	return finite == 0;
}

/* --- Meshes ------------------------------------------------------------------------------------------------------ */

#define FACE_WORDS (2 * sizeof(struct scene_face) / 4) /* front and back */

void prepare_layout(const struct scene_mesh *mesh, uint32_t base, struct geometry *g)
{
	uint32_t n = mesh->vertex_count, at = base;

	g->position = at;
	at += 4 * n;
	g->normal = at;
	at += mesh->normal ? 3 * n : 0;
	g->color = at;
	at += mesh->color ? 4 * n : 0;
	g->secondary = at;
	at += mesh->secondary ? 4 * n : 0;
	g->fog_coord = at;
	at += mesh->fog_coord ? n : 0;
	for (int unit = 0; unit < SCENE_MAX_UNITS; unit++) {
		g->texcoord[unit] = at;
		at += mesh->texcoord[unit] ? 4 * n : 0;
	}
	g->face = at;
	at += mesh->face ? (uint32_t)FACE_WORDS * n : 0;
	g->generics = at;
	for (int i = 0; i < SCENE_MAX_GENERICS; i++)
		at += mesh->generics[i] ? 4 * n : 0;
	g->crease = mesh->crease ? at : SCENE_NONE;
}

size_t prepare_attribute_words(const struct scene_mesh *mesh)
{
	size_t each = 4 + (mesh->normal ? 3 : 0) + (mesh->color ? 4 : 0) + (mesh->secondary ? 4 : 0) +
	              (mesh->fog_coord ? 1 : 0) + (mesh->face ? FACE_WORDS : 0);

	for (int unit = 0; unit < SCENE_MAX_UNITS; unit++)
		each += mesh->texcoord[unit] ? 4 : 0;
	for (int i = 0; i < SCENE_MAX_GENERICS; i++)
		each += mesh->generics[i] ? 4 : 0;
	return each * mesh->vertex_count + (mesh->crease ? 9 * (size_t)mesh->primitive_count : 0);
}

static uint32_t *append(uint32_t *words, const float *values, size_t n)
{
	if (!values)
		return words;
	memcpy(words, values, n * sizeof(*words));
	return words + n;
}

void prepare_fill_attributes(const void *object, uint32_t *words)
{
	const struct scene_mesh *mesh = object;
	size_t n = mesh->vertex_count;

	words = append(words, mesh->position, 4 * n);
	words = append(words, mesh->normal, 3 * n);
	words = append(words, mesh->color, 4 * n);
	words = append(words, mesh->secondary, 4 * n);
	words = append(words, mesh->fog_coord, n);
	for (int unit = 0; unit < SCENE_MAX_UNITS; unit++)
		words = append(words, mesh->texcoord[unit], 4 * n);
	words = append(words, (const float *)mesh->face, FACE_WORDS * n);
	for (int i = 0; i < SCENE_MAX_GENERICS; i++)
		words = append(words, mesh->generics[i], 4 * n);
	append(words, mesh->crease, 9 * (size_t)mesh->primitive_count);
}

size_t prepare_index_words(const struct scene_mesh *mesh)
{
	return (size_t)mesh->primitive_count * ((size_t)mesh->kind + (mesh->primitive_draw ? 1 : 0));
}

void prepare_fill_indices(const void *object, uint32_t *words)
{
	const struct scene_mesh *mesh = object;
	size_t n = (size_t)mesh->primitive_count * (size_t)mesh->kind;

	memcpy(words, mesh->index, n * sizeof(*words));
	if (mesh->primitive_draw)
		memcpy(words + n, mesh->primitive_draw, mesh->primitive_count * sizeof(*words));
}

/* --- Instances --------------------------------------------------------------------------------------------------- */

/*
 * Padding of an instance's boxes. Snapping moves vertices by up to 1/512 pixel on each axis, and camera rays must find
 * every triangle that then covers a pixel centre. The padding is the size of that step at the farthest corner of the
 * mesh's box, in object units, plus a little for the rounding of large coordinates.
 */
static float box_pad(const float (*positions)[4], uint32_t n, const float clip_from_box[16],
                     const struct instance *instance, const struct view *view)
{
	float lo[4] = { INFINITY, INFINITY, INFINITY, INFINITY },
	      hi[4] = { -INFINITY, -INFINITY, -INFINITY, -INFINITY };
	float farthest = 0, size = 0, eye = 0, shrink = 0;

	for (uint32_t v = 0; v < n; v++)
		for (int a = 0; a < 4; a++) { /* each compiles to one instruction, while fminf is a call */
			lo[a] = positions[v][a] < lo[a] ? positions[v][a] : lo[a];
			hi[a] = positions[v][a] > hi[a] ? positions[v][a] : hi[a];
		}
	for (int corner = 0; corner < 8; corner++) {
		float at[3], w = clip_from_box[15];

		for (int a = 0; a < 3; a++) {
			at[a] = corner >> a & 1 ? hi[a] : lo[a];
			w += clip_from_box[4 * a + 3] * at[a];
			size = fmaxf(size, fabsf(at[a]));
		}
		farthest = fmaxf(farthest, fabsf(w));
	}
	for (int a = 0; a < 3; a++) {
		float x = view->inverse[a] / view->viewport[2], y = view->inverse[4 + a] / view->viewport[3];

		eye += x * x + y * y;
	}
	for (int row = 0; row < 3; row++)
		for (int col = 0; col < 3; col++)
			shrink += instance->obj_from_eye[row * 4 + col] * instance->obj_from_eye[row * 4 + col];
	return 2 * farthest * sqrtf(eye) / 256 * sqrtf(shrink) + 4e-6f * size;
}

void prepare_pad(struct prepared *p, uint32_t i, const float (*positions)[4], uint32_t n)
{
	struct instance *instance = &p->instances[i];
	const struct geometry *g = &p->geometries[i];
	const float *clip = instance->flags & INSTANCE_BAKED ? p->views[g->view].projection : g->clip_from_obj;

	instance->pad = box_pad(positions, n, clip, instance, &p->views[g->view]);
}

/* is_depth: the instance writes only depth, and is solid */
static uint32_t instance_flags(const struct scene_material *m, enum prepared_shape shape, int is_depth)
{
	uint32_t flags = 0;
	int draws_color = (m->color_mask & 7) != 0;

	if (!m->blend && !m->alpha_test && !m->alpha_to_coverage && !m->logic_op && draws_color)
		flags |= INSTANCE_OPAQUE;
	if (m->depth_test && (draws_color || is_depth) && !scene_is_never_drawn(m) && shape == PREPARED_FILLED &&
	    (~m->surface.hidden & (SCENE_HIDDEN_FROM_LIGHTS | SCENE_HIDDEN_FROM_MIRRORS)))
		flags |= INSTANCE_SECONDARY;
	if (m->cull_face == GL_FRONT || m->cull_face == GL_FRONT_AND_BACK)
		flags |= INSTANCE_CULL_FRONT;
	if (m->cull_face == GL_BACK || m->cull_face == GL_FRONT_AND_BACK)
		flags |= INSTANCE_CULL_BACK;
	if (m->front_face == GL_CW)
		flags |= INSTANCE_FRONT_CW;
	return flags;
}

/* Sides, by winding, that rays to lights pass through; 0: none, or each hit has to be tested. */
static uint32_t passes_of(const struct scene_material *m)
{
	if (!(m->surface.hidden & SCENE_ONE_SIDED) || m->surface.transmit > 0)
		return 0;
	return m->surface.hidden & SCENE_SHOWN_COUNTER ? INSTANCE_PASS_COUNTER :
	       m->surface.hidden & SCENE_SHOWN_CLOCKWISE ? INSTANCE_PASS_CLOCKWISE : 0;
}

static enum prepared_shape shape_of_mode(uint32_t mode)
{
	return mode == GL_LINE ? PREPARED_LINES : mode == GL_POINT ? PREPARED_POINTS : PREPARED_FILLED;
}

/* Bake an instance: its tree is in eye space. */
static void bake(struct instance *instance)
{
	instance->flags |= INSTANCE_BAKED;
	identity_rows(instance->eye_from_obj);
	identity_rows(instance->obj_from_eye);
}

void prepare_place(struct prepared *p, const struct scene *scene, uint32_t i)
{
	struct instance *instance = &p->instances[i];
	const struct scene_instance *from = &scene->instances[instance->scene_instance];

	if (!invert_affine(from->modelview, instance->obj_from_eye)) {
		bake(instance);
		return;
	}
	rows_from_columns(from->modelview, instance->eye_from_obj);
	instance->flags &= ~INSTANCE_BAKED;
}

int prepare_is_displaced(const struct scene *scene, const struct scene_instance *instance)
{
	const uint32_t program = scene->materials[instance->material].vertex_program;

	return program &&
	       ((const struct scene_program *)(scene->programs + (program - 1)))->outputs >> SCENE_RESULT_POSITION & 1;
}

/* Largest eye-space coordinate of the object-space origin; 0 if that is at infinity. */
static float distance_of_origin(const float modelview[16])
{
	const float largest = fmaxf(fmaxf(fabsf(modelview[12]), fabsf(modelview[13])), fabsf(modelview[14]));
	const float distance = largest / fabsf(modelview[15]);

	return isfinite(distance) ? distance : 0;
}

static void add_instance(const struct scene *scene, struct prepared *p, struct segment *segment, uint32_t index,
                         enum prepared_shape shape, uint32_t cull)
{
	const struct scene_instance *from = &scene->instances[index];
	const struct scene_material *m = &scene->materials[from->material];
	const struct scene_mesh *mesh = scene->meshes[from->mesh];
	struct instance *instance = &p->instances[p->n_instances];
	struct geometry *g = &p->geometries[p->n_instances];
	uint32_t asked = m->surface.hidden &
	                 ~(SCENE_CARD | SCENE_FACETED | SCENE_DOME_LIT | SCENE_NEAR_MIRROR | SCENE_UNSHADED |
	                   SCENE_NO_NORMALS | SCENE_SHOWN_COUNTER | SCENE_SHOWN_CLOCKWISE);

	p->shapes[p->n_instances] = shape;
	mat4_sums[scene->views[from->view].x87].mul(g->clip_from_obj, scene->views[from->view].projection,
	                                            from->modelview);
	memcpy(g->eye_from_obj, from->modelview, sizeof(g->eye_from_obj));
	g->away = distance_of_origin(from->modelview);
	normal_matrix(from->modelview, m->rescale_normal && !m->normalize, g->normal_matrix);
	prepare_layout(mesh, 0, g);
	g->attributes = mesh->attributes | from->given * GEOMETRY_GIVEN;
	g->material = from->material;
	g->view = segment->view;
	g->current = from->current;
	g->draw = from->draw;
	g->primitive_draw = SCENE_NONE;
	g->vertex_first = p->n_vertices;
	g->vertex_count = mesh->vertex_count;
	g->texcoord_first = p->n_texcoords;
	p->n_vertices += mesh->vertex_count;
	p->n_texcoords += mesh->vertex_count * m->unit_count;

	instance->flags = instance_flags(m, shape, p->depths[index]) | cull;
	if (p->skies[index] && shape == PREPARED_FILLED)
		instance->flags = (instance->flags & ~INSTANCE_SECONDARY) | INSTANCE_SKY;
	instance->vertex_first = g->vertex_first;
	instance->material = from->material;
	instance->view = segment->view;
	instance->draw = from->draw;
	instance->scene_instance = index;
	if (shape != PREPARED_FILLED) {
		p->culls[p->n_instances] = instance->flags & (INSTANCE_CULL_FRONT | INSTANCE_CULL_BACK);
		instance->flags = INSTANCE_SCREEN;
		identity_rows(instance->eye_from_obj);
		identity_rows(instance->obj_from_eye);
		segment->screen_count++;
	} else if (prepare_is_displaced(scene, from)) {
		bake(instance);
	} else {
		prepare_place(p, scene, p->n_instances);
	}
	if (shape == PREPARED_FILLED)
		prepare_pad(p, p->n_instances, (const float (*)[4])mesh->position, mesh->vertex_count);
	else
		instance->pad = 1.0f / 128; /* pixels */
	p->n_instances++;
	segment->instance_count++;
	if ((m->lighting || m->vertex_program) && m->light_count > p->n_light_slots)
		p->n_light_slots = m->light_count;
	if (m->surface.relit && m->surface.light_count > p->n_light_slots)
		p->n_light_slots = m->surface.light_count;
	p->has_vertex_programs |= m->vertex_program != 0;
	p->has_fragment_programs |= m->fragment_program != 0;
	p->has_mirrors |= m->surface.reflect > 0 || m->surface.transmit > 0;
	if (!(instance->flags & (INSTANCE_BAKED | INSTANCE_SCREEN)))
		instance->flags |= passes_of(m);
	if (instance->flags & (INSTANCE_PASS_COUNTER | INSTANCE_PASS_CLOCKWISE))
		asked &= ~SCENE_ONE_SIDED;
	if (instance->flags & INSTANCE_SECONDARY)
		p->has_transparency |= m->blend || m->alpha_test || m->alpha_to_coverage || m->clip_plane_mask ||
		                       m->surface.transmit > 0 || m->polygon_stipple != SCENE_NONE || asked;
}

/* Add one scene instance in the shapes of its polygon modes: filled ones in the first pass, others in the second. */
static void add_shapes(const struct scene *scene, struct prepared *p, struct segment *segment, uint32_t index,
                       int screen)
{
	const struct scene_instance *from = &scene->instances[index];
	const struct scene_material *m = &scene->materials[from->material];
	enum scene_primitive kind = scene->meshes[from->mesh]->kind;
	enum prepared_shape front = shape_of_mode(m->polygon_mode_front), back = shape_of_mode(m->polygon_mode_back);

	if (kind != SCENE_TRIANGLES) {
		if (screen)
			add_instance(scene, p, segment, index, kind == SCENE_LINES ? PREPARED_LINES : PREPARED_POINTS,
			             0);
		return;
	}
	if (front == back) {
		if ((front != PREPARED_FILLED) == screen)
			add_instance(scene, p, segment, index, front, 0);
		return;
	}
	if ((front != PREPARED_FILLED) == screen)
		add_instance(scene, p, segment, index, front, INSTANCE_CULL_BACK);
	if ((back != PREPARED_FILLED) == screen)
		add_instance(scene, p, segment, index, back, INSTANCE_CULL_FRONT);
}

/* --- Segments ---------------------------------------------------------------------------------------------------- */

/* 1 if a program discards fragments or changes their depth. */
static int program_moves(const struct scene *scene, const struct scene_material *m)
{
	const struct scene_program *program = scene_program_of(scene, m->fragment_program);

	return program && (program->kills || program->sets_depth);
}

/* The camera mode that suits a single draw. */
static uint32_t draw_mode(const struct scene *scene, const struct scene_instance *instance)
{
	const struct scene_material *m = &scene->materials[instance->material];

	if (scene->meshes[instance->mesh]->kind != SCENE_TRIANGLES || m->polygon_mode_front != GL_FILL ||
	    m->polygon_mode_back != GL_FILL)
		return CAMERA_COLUMN;
	if (!m->depth_test || !m->depth_write || m->blend || m->alpha_test || m->stencil_test || m->logic_op ||
	    m->srgb || (m->color_mask & 7) != 7 || m->clip_plane_mask || m->polygon_stipple != SCENE_NONE ||
	    m->samples_off || m->alpha_to_coverage || m->surface.hidden & SCENE_LEFT_OUT || (m->polygon_offset & 4) ||
	    program_moves(scene, m) || scene->depth_bits < 24) /* with more bits, 24 are used (pixel_depth_steps) */
		return CAMERA_COLUMN;
	if (m->depth_func == GL_LESS)
		return CAMERA_NEAREST_LESS;
	return m->depth_func == GL_LEQUAL ? CAMERA_NEAREST_LEQUAL : CAMERA_COLUMN;
}

static uint32_t multisampled(const struct scene *scene, uint32_t instance)
{
	return scene->materials[scene->instances[instance].material].multisample;
}

/* Range of scene instances for one camera pass, before prepared instances are made. */
struct cut {
	uint32_t first, end, mode;
	uint32_t clear_first, clear_count;
};

/* Most passes over one view between clears. If draws alternate more often, a single pass with columns draws the
 * rest. */
#define MAX_PASSES 4

static uint32_t cut_scene(const struct scene *scene, struct cut *cuts)
{
	uint32_t n = 0, clear = 0, group = 0;

	for (uint32_t i = 0; i < scene->n_instances; i++) {
		uint32_t mode = draw_mode(scene, &scene->instances[i]), clears = clear;
		int new_group;

		while (clears < scene->n_clears && scene->clears[clears].before_instance <= i)
			clears++;
		new_group = n == 0 || clears > clear || scene->instances[i].view != scene->instances[i - 1].view ||
		            multisampled(scene, i) != multisampled(scene, i - 1);
		if (new_group)
			group = n;
		if (!new_group && cuts[n - 1].mode == mode) {
			cuts[n - 1].end = i + 1;
			continue;
		}
		if (n - group >= MAX_PASSES) {
			cuts[group + 1].end = i + 1;
			cuts[group + 1].mode = CAMERA_COLUMN;
			n = group + 2;
			continue;
		}
		cuts[n++] = (struct cut){ i, i + 1, mode, clear, clears - clear };
		clear = clears;
	}
	if (clear < scene->n_clears)
		cuts[n++] = (struct cut){ scene->n_instances, scene->n_instances, CAMERA_COLUMN, clear,
			                  scene->n_clears - clear };
	return n;
}

static void shift_view(const struct scene_view *from, const float shift[2], struct view *view)
{
	view->viewport[0] = from->viewport[0] + shift[0];
	view->viewport[1] = from->viewport[1] + shift[1];
}

static void make_view(const struct scene_view *from, const float shift[2], struct view *view)
{
	float inverse[16], largest = 0;

	memcpy(view->projection, from->projection, sizeof(view->projection));
	memcpy(view->viewport, from->viewport, sizeof(view->viewport));
	shift_view(from, shift, view);
	memcpy(view->depth_range, from->depth_range, sizeof(view->depth_range));
	memcpy(view->scissor, from->scissor, sizeof(view->scissor));
	if (!mat4_invert(inverse, from->projection))
		return; /* keep an inverse of zeros: the view has no rays, only screen geometry */
	for (int i = 0; i < 16; i++)
		largest = fabsf(inverse[i]) <= largest ? largest : fabsf(inverse[i]);
	if (largest < 1e30f)
		memcpy(view->inverse, inverse, sizeof(view->inverse));
}

static int draws_to_window(const struct scene *scene, uint32_t instance)
{
	return scene->views[scene->instances[instance].view].target == 0;
}

/*
 * Draws before and after a clear of the window's depth are never compared, and may not be at their apparent distance:
 * for example a sky of small models around the viewer, or a hand in front of the world. They must not shadow each
 * other, so they are layers with separate eye spaces. A backdrop shares the eye space of the world, whose rays see it
 * if they miss.
 */
struct layers {
	uint32_t backdrop, n;
	int written; /* 1: a draw of the last layer wrote depth */
};

/* Number of the layer that follows the clears of a cut. */
static uint32_t layer_of(const struct scene *scene, const struct cut *cut, struct layers *layers)
{
	for (uint32_t i = cut->clear_first; i < cut->clear_first + cut->clear_count; i++) {
		const struct scene_clear *clear = &scene->clears[i];

		if (!(clear->buffers & 2) || !scene_clears_window(scene, clear) || !layers->written ||
		    clear->before_instance <= layers->backdrop)
			continue;
		layers->n++;
		layers->written = 0;
	}
	for (uint32_t i = cut->first; i < cut->end && !layers->written; i++) {
		const struct scene_material *m = &scene->materials[scene->instances[i].material];

		layers->written = m->depth_test && m->depth_write && draws_to_window(scene, i);
	}
	return layers->n;
}

int prepare_frame(const struct scene *scene, const float shift[2], struct prepared *out)
{
	struct layers layers = { .backdrop = scene_backdrop(scene) };
	size_t most = 2 * (size_t)scene->n_instances + 1;
	struct cut *cuts = malloc((scene->n_instances + (size_t)scene->n_clears + 1) * sizeof(*cuts));
	uint32_t n_cuts;

	out->segments = calloc(most + scene->n_clears, sizeof(*out->segments));
	out->instances = calloc(most, sizeof(*out->instances));
	out->geometries = calloc(most, sizeof(*out->geometries));
	out->shapes = calloc(most, sizeof(*out->shapes));
	out->culls = calloc(most, sizeof(*out->culls));
	out->views = calloc(most, sizeof(*out->views));
	out->scene_views = calloc(most, sizeof(*out->scene_views));
	out->skies = calloc(scene->n_instances + (size_t)1, sizeof(*out->skies));
	out->depths = calloc(scene->n_instances + (size_t)1, sizeof(*out->depths));
	if (!cuts || !out->segments || !out->instances || !out->geometries || !out->shapes || !out->culls ||
	    !out->views || !out->scene_views || !out->skies || !out->depths || scene_find_skies(scene, out->skies) != 0)
		goto fail;
	scene_find_depths(scene, out->depths);
	n_cuts = cut_scene(scene, cuts);
	for (uint32_t r = 0; r < n_cuts; r++) {
		struct segment *segment = &out->segments[out->n_segments++];
		const uint32_t layer = layer_of(scene, &cuts[r], &layers);

		*segment = (struct segment){ .clear_first = cuts[r].clear_first,
			                     .clear_count = cuts[r].clear_count,
			                     .view = SCENE_NONE,
			                     .mode = cuts[r].mode,
			                     .instance_first = out->n_instances };
		if (cuts[r].first == cuts[r].end || !draws_to_window(scene, cuts[r].first))
			continue;
		segment->multisample = multisampled(scene, cuts[r].first);
		segment->view = out->n_views;
		out->scene_views[out->n_views] = scene->views[scene->instances[cuts[r].first].view];
		out->scene_views[out->n_views].space += layer * scene->n_views;
		make_view(&out->scene_views[out->n_views], shift, &out->views[out->n_views]);
		out->n_views++;
		for (int screen = 0; screen < 2; screen++)
			for (uint32_t i = cuts[r].first; i < cuts[r].end; i++)
				add_shapes(scene, out, segment, i, screen);
		out->views[segment->view].screen_first =
			segment->instance_first + segment->instance_count - segment->screen_count;
		out->views[segment->view].screen_count = segment->screen_count;
	}
	out->owner = malloc((out->n_vertices + (size_t)1) * sizeof(*out->owner));
	if (!out->owner)
		goto fail;
	for (uint32_t i = 0; i < out->n_instances; i++)
		for (uint32_t v = 0; v < out->geometries[i].vertex_count; v++)
			out->owner[out->geometries[i].vertex_first + v] = i;
	free(cuts);
	return 0;
fail:
	free(cuts);
	prepared_free(out);
	return err_report(ERR_SYSTEM, NULL, "out of memory for a frame of %u instances", scene->n_instances);
}

void prepare_shift(struct prepared *p, const float shift[2])
{
	for (uint32_t i = 0; i < p->n_views; i++)
		shift_view(&p->scene_views[i], shift, &p->views[i]);
}

void prepared_free(struct prepared *p)
{
	free(p->segments);
	free(p->instances);
	free(p->geometries);
	free(p->shapes);
	free(p->culls);
	free(p->views);
	free(p->scene_views);
	free(p->owner);
	free(p->skies);
	free(p->depths);
	memset(p, 0, sizeof(*p));
}

/* Number of instances in segments of an eye space; 0: secondary rays hit none of them. */
static uint32_t instances_in(const struct prepared *p, uint32_t space)
{
	uint32_t n = 0, met = 0;

	for (uint32_t i = 0; i < p->n_instances; i++) {
		const int is_in = p->scene_views[p->instances[i].view].space == space;

		n += is_in;
		met |= is_in && p->instances[i].flags & INSTANCE_SECONDARY;
	}
	return met ? n : 0;
}

const struct segment *prepare_main_segment(const struct prepared *p)
{
	const struct segment *best = NULL;
	uint32_t most = 0;

	for (uint32_t i = 0; i < p->n_segments; i++) {
		const struct segment *s = &p->segments[i];
		const uint32_t n = s->view == SCENE_NONE ? 0 : instances_in(p, p->scene_views[s->view].space);

		if (n > most) {
			most = n;
			best = s;
		}
	}
	return best;
}
