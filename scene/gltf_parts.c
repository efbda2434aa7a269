/* Collects a glTF file's meshes, nodes, cameras and lights from a scene. */
#include "scene/gltf_parts.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "scene/gltf_looks.h"

/* ---- numbers ---- */

static float determinant(const float m[16])
{
	return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) + m[8] * (m[1] * m[6] - m[5] * m[2]);
}

/* 1 if a matrix is a translation, rotation and scale: columns at right angles, none zero, last row 0 0 0 1. */
static int is_trs(const float m[16])
{
	if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
		return 0;
	for (int i = 0; i < 3; i++) {
		const float *a = m + 4 * i, *b = m + 4 * ((i + 1) % 3);
		float aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
		float ab = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
		if (!(aa > 0) || !isfinite(aa) || ab * ab > 1e-8f * aa * bb)
			return 0;
	}
	return isfinite(m[12]) && isfinite(m[13]) && isfinite(m[14]);
}

/* 1 if all vertices have w = 1, so that a node's matrix can move them. */
static int is_affine(const struct scene_mesh *m)
{
	for (uint32_t v = 0; v < m->vertex_count; v++)
		if (m->position[4 * v + 3] != 1)
			return 0;
	return 1;
}

/* ---- vertices ---- */

static uint32_t put_accessor(struct gltf *g, uint32_t piece, uint32_t component, uint32_t count, const char *type)
{
	return GLTF_PUSH(
		g, accessors,
		((struct gltf_accessor){ .piece = piece, .component = component, .count = count, .type = type }));
}

/* Write positions in object space, or baked into eye space. A vertex at or beyond infinity becomes NaN; put_indices
 * then drops its primitives. */
static uint32_t put_positions(struct gltf *g, const struct scene_mesh *m, const float *baked)
{
	uint32_t piece, number;
	float *out = gltf_put_piece(g, (size_t)m->vertex_count * 12, GLTF_VERTICES, &piece);
	struct gltf_accessor *a;

	if (!out)
		return SCENE_NONE;
	for (uint32_t v = 0; v < m->vertex_count; v++) {
		float p[4];
		memcpy(p, m->position + 4 * (size_t)v, sizeof(p));
		if (baked)
			mat4_transform(p, baked, m->position + 4 * (size_t)v);
		for (int i = 0; i < 3; i++)
			out[3 * (size_t)v + i] = p[3] > 0 && isfinite(p[i] / p[3]) ? p[i] / p[3] : NAN;
	}
	number = put_accessor(g, piece, GL_FLOAT, m->vertex_count, "VEC3");
	if (number == SCENE_NONE)
		return SCENE_NONE;
	a = &g->accessors[number];
	a->has_bounds = 1;
	for (int i = 0; i < 3; i++)
		a->min[i] = INFINITY, a->max[i] = -INFINITY;
	out = (float *)(void *)(g->bytes + g->pieces[piece].offset);
	for (uint32_t v = 0; v < m->vertex_count; v++)
		for (int i = 0; i < 3; i++) {
			a->min[i] = fminf(a->min[i], out[3 * (size_t)v + i]);
			a->max[i] = fmaxf(a->max[i], out[3 * (size_t)v + i]);
		}
	return number;
}

static uint32_t put_normals(struct gltf *g, const struct scene_mesh *m, const float current[4], const float *baked)
{
	uint32_t piece;
	float *out = gltf_put_piece(g, (size_t)m->vertex_count * 12, GLTF_VERTICES, &piece), inverse[16];

	if (!out)
		return SCENE_NONE;
	if (baked)
		mat4_invert(inverse, baked);
	for (uint32_t v = 0; v < m->vertex_count; v++) {
		const float *n = m->normal ? m->normal + 3 * (size_t)v : current;
		float object[4] = { n[0], n[1], n[2], 0 }, eye[4];
		if (baked)
			mat4_transform_plane(eye, object, inverse); /* GL 2.1 sec. 2.11.3 */
		memcpy(out + 3 * (size_t)v, baked ? eye : object, 12);
		gltf_normalise(out + 3 * (size_t)v);
	}
	return put_accessor(g, piece, GL_FLOAT, m->vertex_count, "VEC3");
}

static uint32_t put_colors(struct gltf *g, const struct scene_mesh *m)
{
	uint32_t piece;
	float *out = gltf_put_piece(g, (size_t)m->vertex_count * 16, GLTF_VERTICES, &piece);

	if (!out)
		return SCENE_NONE;
	for (size_t i = 0; i < 4 * (size_t)m->vertex_count; i++) {
		float c = fminf(fmaxf(m->color[i], 0), 1);
		out[i] = i % 4 == 3 ? c : gltf_linear(c);
	}
	return put_accessor(g, piece, GL_FLOAT, m->vertex_count, "VEC4");
}

/* Write texture coordinates after the texture matrix. Rectangle textures count texels (ARB_texture_rectangle). */
static uint32_t put_texcoords(struct gltf *g, const struct scene_mesh *m, const struct scene_unit *u,
                              const float current[4])
{
	const struct scene_texture *t = g->s->textures[u->texture];
	float size[2] = { 1, 1 };
	uint32_t piece;
	float *out = gltf_put_piece(g, (size_t)m->vertex_count * 8, GLTF_VERTICES, &piece);

	if (!out)
		return SCENE_NONE;
	if (t->target == GL_TEXTURE_RECTANGLE) {
		size[0] = (float)t->width;
		size[1] = (float)t->height;
	}
	for (uint32_t v = 0; v < m->vertex_count; v++) {
		float p[4];
		mat4_transform(p, u->matrix, m->texcoord[u->unit] ? m->texcoord[u->unit] + 4 * (size_t)v : current);
		for (int i = 0; i < 2; i++)
			out[2 * (size_t)v + i] = isfinite(p[i] / p[3]) ? p[i] / p[3] / size[i] : 0;
	}
	return put_accessor(g, piece, GL_FLOAT, m->vertex_count, "VEC2");
}

/*
 * Write indices. Primitives with an infinite vertex are counted and dropped. Triangles with one corner twice are
 * dropped as well: they cover nothing. `flipped` reverses the winding.
 */
static uint32_t put_indices(struct gltf *g, const struct scene_mesh *m, uint32_t position, int flipped)
{
	uint32_t piece, n = 0, k = (uint32_t)m->kind;
	uint32_t *out = gltf_put_piece(g, (size_t)m->primitive_count * k * 4, GLTF_INDICES, &piece);
	const float *p;

	if (!out)
		return SCENE_NONE;
	p = (const float *)(const void *)(g->bytes + g->pieces[g->accessors[position].piece].offset);
	for (uint32_t i = 0; i < m->primitive_count; i++) {
		const uint32_t *v = m->index + (size_t)i * k;
		int finite = 1;
		for (uint32_t c = 0; c < k; c++)
			for (int axis = 0; axis < 3; axis++)
				finite &= isfinite(p[3 * (size_t)v[c] + axis]) != 0;
		if (!finite) {
			g->losses->infinite += k;
			continue;
		}
		if (k == 3 && (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]))
			continue;
		for (uint32_t c = 0; c < k; c++)
			out[n++] = v[flipped && c ? k - c : c];
	}
	gltf_shrink_piece(g, piece, (size_t)n * 4);
	return n ? put_accessor(g, piece, GL_UNSIGNED_INT, n, "SCALAR") : SCENE_NONE;
}

/* Replace NaN by numbers: glTF requires them even for vertices that no primitive uses. */
static void mend_positions(struct gltf *g, uint32_t position)
{
	const struct gltf_accessor *a = &g->accessors[position];
	float *p = (float *)(void *)(g->bytes + g->pieces[a->piece].offset);

	for (size_t i = 0; i < 3 * (size_t)a->count; i++)
		if (!isfinite(p[i]))
			p[i] = a->min[i % 3];
}

/* ---- parts ---- */

static int writes_color(const struct scene_material *m)
{
	return (m->color_mask & 7) && m->cull_face != GL_FRONT_AND_BACK;
}

/* The glTF mesh of an instance; an earlier mesh is reused if all its inputs are the same. */
static uint32_t put_part(struct gltf *g, uint32_t number)
{
	const struct scene_instance *in = &g->s->instances[number];
	const struct scene_mesh *m = g->s->meshes[in->mesh];
	const struct scene_material *mat = &g->s->materials[in->material];
	const struct scene_current *cur = &g->s->currents[in->current];
	int as_node = is_trs(in->modelview) && is_affine(m);
	const float *baked = as_node ? NULL : in->modelview;
	struct gltf_part p = {
		.mesh = in->mesh, .material = in->material, .current = in->current, .baked = as_node ? SCENE_NONE : number,
		.normal = SCENE_NONE, .color = SCENE_NONE, .texcoord = SCENE_NONE
	};
	const struct scene_unit *unit;
	int vertex_colors;

	/* In glTF a mirroring node matrix turns front faces over (sec. 3.7.4). In GL it does not: GL looks at the
	 * window. */
	p.flipped = (mat->front_face == GL_CW) != (as_node && determinant(in->modelview) < 0);
	for (uint32_t i = 0; i < g->n_parts; i++)
		if (memcmp(&g->parts[i], &p, offsetof(struct gltf_part, position)) == 0)
			return i;
	unit = gltf_shown_unit(g, mat, m);
	p.position = put_positions(g, m, baked);
	if (p.position == SCENE_NONE)
		return SCENE_NONE;
	p.index = put_indices(g, m, p.position, m->kind == SCENE_TRIANGLES && p.flipped);
	if (p.index == SCENE_NONE)
		return SCENE_NONE;
	mend_positions(g, p.position);
	if (mat->lighting)
		p.normal = put_normals(g, m, cur->normal, baked);
	vertex_colors = m->color && (!mat->lighting || mat->color_material);
	if (vertex_colors)
		p.color = put_colors(g, m);
	if (unit)
		p.texcoord = put_texcoords(g, m, unit, cur->texcoord[unit->unit]);
	p.look = gltf_put_look(g, mat, unit, cur->color, vertex_colors);
	return GLTF_PUSH(g, parts, p);
}

/* ---- nodes ---- */

/* 1 for a perspective, 2 for a parallel projection along -z, as Frustum and Ortho make them; 0 for any other. */
int gltf_camera_kind(const float p[16])
{
	if (p[11] == -1 && p[15] == 0 && p[0] > 0 && p[5] > 0 && p[10] < -1)
		return 1;
	return p[11] == 0 && p[15] == 1 && p[0] > 0 && p[5] > 0 && p[10] < 0 ? 2 : 0;
}

static void put_instances(struct gltf *g, struct gltf_space *space)
{
	double middle[3] = { 0 }, weight = 0;

	for (uint32_t i = 0; i < g->s->n_instances && !g->failed; i++) {
		const struct scene_instance *in = &g->s->instances[i];
		const struct gltf_accessor *a;
		uint32_t part;
		if (g->s->views[in->view].space != space->space)
			continue;
		if (!writes_color(&g->s->materials[in->material])) {
			g->losses->no_color++;
			continue;
		}
		part = put_part(g, i);
		if (part == SCENE_NONE || GLTF_PUSH(g, nodes, ((struct gltf_node){ GLTF_INSTANCE, i, part })) == SCENE_NONE)
			continue;
		space->n_primitives += g->s->meshes[in->mesh]->primitive_count;
		a = &g->accessors[g->parts[part].position];
		weight += a->count;
		for (int k = 0; k < 3; k++) {
			float box[4] = { (a->min[0] + a->max[0]) / 2, (a->min[1] + a->max[1]) / 2, (a->min[2] + a->max[2]) / 2, 1 }, eye[4];
			mat4_transform(eye, g->parts[part].baked == SCENE_NONE ? in->modelview : mat4_identity, box);
			middle[k] += (double)eye[k] * a->count;
		}
	}
	for (int k = 0; k < 3; k++)
		space->middle[k] = weight > 0 ? (float)(middle[k] / weight) : 0;
}

/* Add one camera for each projection of a space. */
static void put_cameras(struct gltf *g, const struct gltf_space *space)
{
	for (uint32_t v = 0; v < g->s->n_views; v++) {
		const struct scene_view *view = &g->s->views[v];
		int seen = 0;
		for (uint32_t i = space->node_first; i < g->n_nodes; i++)
			seen |= g->nodes[i].kind == GLTF_CAMERA &&
			        memcmp(g->s->views[g->nodes[i].index].projection, view->projection, sizeof(view->projection)) == 0;
		if (view->space == space->space && !seen && gltf_camera_kind(view->projection))
			GLTF_PUSH(g, nodes, ((struct gltf_node){ GLTF_CAMERA, v, SCENE_NONE }));
	}
}

/* Add each light that lights something in the space, once. */
static void put_lights(struct gltf *g, const struct gltf_space *space)
{
	uint32_t first = g->n_nodes;

	for (uint32_t i = 0; i < g->s->n_instances; i++) {
		const struct scene_instance *in = &g->s->instances[i];
		const struct scene_material *m = &g->s->materials[in->material];
		if (g->s->views[in->view].space != space->space || !m->lighting)
			continue;
		for (uint32_t l = m->light_first; l < m->light_first + m->light_count; l++) {
			int seen = 0;
			for (uint32_t k = first; k < g->n_nodes; k++)
				seen |= memcmp(&g->s->lights[g->nodes[k].index], &g->s->lights[l], sizeof(g->s->lights[l])) == 0;
			if (!seen)
				GLTF_PUSH(g, nodes, ((struct gltf_node){ GLTF_LIGHT, l, SCENE_NONE }));
		}
	}
}

void gltf_gather(struct gltf *g, const struct scene *s, struct gltf_losses *losses)
{
	*g = (struct gltf){ .s = s, .losses = losses };
	*losses = (struct gltf_losses){ 0 };
	for (uint32_t v = 0; v < s->n_views && !g->failed; v++) {
		struct gltf_space space = { .space = s->views[v].space, .node_first = g->n_nodes };
		int seen = 0;
		for (uint32_t i = 0; i < v; i++)
			seen |= s->views[i].space == space.space;
		if (seen)
			continue;
		put_instances(g, &space);
		if (!space.n_primitives)
			continue;
		put_cameras(g, &space);
		put_lights(g, &space);
		space.node_count = g->n_nodes - space.node_first;
		GLTF_PUSH(g, spaces, space);
	}
}
