/* Writes a scene as JSON or as text. */
#include "scene/json.h"

#include <inttypes.h>

#include "base/hash.h"
#include "base/json.h"
#include "base/plural.h"
#include "scene/tokens.h"

static const char *kind_name(enum scene_primitive kind)
{
	return kind == SCENE_POINTS ? "points" : kind == SCENE_LINES ? "lines" : "triangles";
}

/* ---- text ---- */

static void write_clears(FILE *out, const struct scene *s, uint32_t *next, uint32_t before)
{
	for (; *next < s->n_clears && s->clears[*next].before_instance <= before; (*next)++) {
		const struct scene_clear *c = &s->clears[*next];
		fprintf(out, "draw %u: clear%s%s%s, scissor %d %d %dx%d\n", c->draw, c->buffers & 1 ? " colour" : "",
		        c->buffers & 2 ? " depth" : "", c->buffers & 4 ? " stencil" : "", c->scissor[0], c->scissor[1],
		        c->scissor[2], c->scissor[3]);
	}
}

/* The first digits of a hash, which name a mesh or texture in rules. */
static unsigned start_of(const uint64_t hash[2])
{
	return (unsigned)(hash[1] >> 32);
}

static void write_textures(FILE *out, const struct scene *s, const struct scene_material *m)
{
	char format[TOKEN_NAME_BYTES], mode[TOKEN_NAME_BYTES];

	for (uint32_t i = 0; i < m->unit_count; i++) {
		const struct scene_unit *u = &s->units[m->unit_first + i];
		const struct scene_texture *t = s->textures[u->texture];

		fprintf(out, ", unit %u: texture %08x %ux%u %s %s", u->unit, start_of(t->hash), t->width, t->height,
		        token_name(t->base_format, format), token_name(u->env_mode, mode));
	}
}

static void write_blending(FILE *out, const struct scene_material *m)
{
	char from[TOKEN_NAME_BYTES], to[TOKEN_NAME_BYTES];

	if (m->blend)
		fprintf(out, ", blended %s %s", token_factor_name(m->blend_src_rgb, from), token_factor_name(m->blend_dst_rgb, to));
}

static void write_instance_text(FILE *out, const struct scene *s, const struct scene_instance *in)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_material *m = &s->materials[in->material];

	fprintf(out, "draw %u: %u %s of mesh %08x, %s at call %" PRIu64 ", view %u%s", in->draw, mesh->primitive_count,
	        kind_name(mesh->kind), start_of(mesh->hash), s->draws[in->draw].call, s->draws[in->draw].call_number,
	        in->view, m->lighting ? ", lit" : "");
	write_textures(out, s, m);
	write_blending(out, m);
	fprintf(out, "%s%s\n", m->alpha_test ? ", alpha test" : "", m->depth_test ? "" : ", no depth test");
}

void scene_write_text(FILE *out, const struct scene *s)
{
	uint32_t clear = 0;

	fprintf(out,
	        "frame %" PRIu64
	        ": %ux%u, %u instance%s, %u primitive%s, %u mesh%s, %u material%s, %u view%s, %u texture%s%s\n",
	        s->frame, s->width, s->height, s->n_instances, plural(s->n_instances), s->n_primitives,
	        plural(s->n_primitives), s->n_meshes, s->n_meshes == 1 ? "" : "es", s->n_materials,
	        plural(s->n_materials), s->n_views, plural(s->n_views), s->n_textures, plural(s->n_textures),
	        s->needs_previous ? ", shows pixels of an earlier frame" : "");
	for (uint32_t i = 0; i < s->n_instances; i++) {
		write_clears(out, s, &clear, i);
		write_instance_text(out, s, &s->instances[i]);
	}
	write_clears(out, s, &clear, s->n_instances);
}

/* ---- JSON: a row for each field, by its name ---- */

/* FACTORS: tokens whose values 0 and 1 are GL_ZERO and GL_ONE. */
enum kind { UINTS, TOKENS, FACTORS, INTS, FLOATS, FACE, STENCIL, SURFACE };

struct field {
	const char *name;
	enum kind kind;
	int is_array;
	size_t offset, bytes;
};

/* A row's kind and form follow from the field's type, so that they cannot disagree. */
#define MEMBER(type, member) (((type *)0)->member)
#define KIND_OF(value) \
	_Generic((value), uint32_t: UINTS, uint64_t: UINTS, uint32_t *: UINTS, int32_t *: INTS, float: FLOATS, \
	float *: FLOATS, \
		float(*)[4]: FLOATS, struct scene_face: FACE, struct scene_stencil: STENCIL, struct scene_surface: SURFACE)
#define IS_ARRAY(value) _Generic((value), uint32_t *: 1, int32_t *: 1, float *: 1, float(*)[4]: 1, default: 0)
#define ROW(type, member) \
	{ #member, KIND_OF(MEMBER(type, member)), IS_ARRAY(MEMBER(type, member)), offsetof(type, member), \
	sizeof(MEMBER(type, member)) }
#define FIELD(owner, member) ROW(struct scene_##owner, member)
#define SCENE_FIELD(member) ROW(struct scene, member)
/* Rows of GL tokens; their type does not distinguish them from plain numbers. */
#define TOKEN_ROW(owner, member, kind) \
	{ #member, kind, IS_ARRAY(MEMBER(struct scene_##owner, member)), offsetof(struct scene_##owner, member), \
	sizeof(MEMBER(struct scene_##owner, member)) }
#define TOKEN(owner, member) TOKEN_ROW(owner, member, TOKENS)
#define FACTOR(owner, member) TOKEN_ROW(owner, member, FACTORS)

static const struct field face_fields[] = {
	FIELD(face, ambient), FIELD(face, diffuse), FIELD(face, specular), FIELD(face, emission), FIELD(face, shininess),
	{ 0 },
};

static const struct field stencil_fields[] = {
	TOKEN(stencil, func), FIELD(stencil, ref), FIELD(stencil, compare_mask), FIELD(stencil, write_mask),
	FACTOR(stencil, fail), FACTOR(stencil, zfail), FACTOR(stencil, zpass),
	{ 0 },
};

static const struct field surface_fields[] = {
	FIELD(surface, reflect), FIELD(surface, transmit), FIELD(surface, ior), FIELD(surface, absorb),
	FIELD(surface, roughness), FIELD(surface, hidden), FIELD(surface, emission),
	{ 0 },
};

static const struct field material_fields[] = {
	FIELD(material, lighting), FIELD(material, light_first), FIELD(material, light_count),
	FIELD(material, light_model_ambient), FIELD(material, local_viewer), FIELD(material, two_side),
	FIELD(material, separate_specular), FIELD(material, front), FIELD(material, back), TOKEN(material, color_material),
	TOKEN(material, color_material_mode), FIELD(material, normalize), FIELD(material, rescale_normal),
	TOKEN(material, shade_model), FIELD(material, first_provokes), FIELD(material, unit_first),
	FIELD(material, unit_count), FIELD(material, color_sum), FIELD(material, fog), TOKEN(material, fog_mode),
	TOKEN(material, fog_coord_source), FIELD(material, fog_density), FIELD(material, fog_start),
	FIELD(material, fog_end), FIELD(material, fog_color), TOKEN(material, cull_face), TOKEN(material, front_face),
	TOKEN(material, polygon_mode_front), TOKEN(material, polygon_mode_back), FIELD(material, polygon_offset),
	FIELD(material, polygon_offset_factor), FIELD(material, polygon_offset_units), FIELD(material, polygon_stipple),
	FIELD(material, line_stipple), FIELD(material, line_width), FIELD(material, point_size),
	FIELD(material, line_smooth), FIELD(material, point_smooth), FIELD(material, polygon_smooth),
	FIELD(material, point_sprite), FIELD(material, point_attenuation), FIELD(material, point_size_min),
	FIELD(material, point_size_max), FIELD(material, point_fade_threshold), FIELD(material, multisample),
	FIELD(material, samples_off), FIELD(material, alpha_to_coverage), FIELD(material, alpha_to_one),
	FIELD(material, clip_plane_mask), FIELD(material, clip_plane_eye), FIELD(material, clip_by_program),
	FIELD(material, alpha_test), TOKEN(material, alpha_func), FIELD(material, alpha_ref), FIELD(material, stencil_test),
	FIELD(material, stencil_front), FIELD(material, stencil_back), FIELD(material, depth_test),
	TOKEN(material, depth_func), FIELD(material, depth_write), FIELD(material, blend),
	TOKEN(material, blend_equation_rgb), TOKEN(material, blend_equation_alpha), FACTOR(material, blend_src_rgb),
	FACTOR(material, blend_dst_rgb), FACTOR(material, blend_src_alpha), FACTOR(material, blend_dst_alpha),
	FIELD(material, blend_color), TOKEN(material, logic_op), FIELD(material, color_mask), FIELD(material, srgb),
	FIELD(material, surface), FIELD(material, program), FIELD(material, fragment_program),
	FIELD(material, vertex_program), { 0 },
};

static const struct field unit_fields[] = {
	FIELD(unit, unit), FIELD(unit, texture), TOKEN(unit, wrap_s), TOKEN(unit, wrap_t), TOKEN(unit, wrap_r),
	TOKEN(unit, min_filter), TOKEN(unit, mag_filter), FIELD(unit, border_color), FIELD(unit, lod_bias),
	FIELD(unit, min_lod), FIELD(unit, max_lod), FIELD(unit, max_anisotropy), TOKEN(unit, compare_mode),
	TOKEN(unit, compare_func), TOKEN(unit, depth_mode), TOKEN(unit, env_mode), FIELD(unit, env_color),
	TOKEN(unit, combine_rgb), TOKEN(unit, combine_alpha), FACTOR(unit, source_rgb), FACTOR(unit, source_alpha),
	TOKEN(unit, operand_rgb), TOKEN(unit, operand_alpha), FIELD(unit, scale_rgb), FIELD(unit, scale_alpha),
	TOKEN(unit, gen_mode), FIELD(unit, gen_object_plane), FIELD(unit, gen_eye_plane), FIELD(unit, matrix),
	FIELD(unit, coord_replace),
	{ 0 },
};

static const struct field light_fields[] = {
	FIELD(light, index), FIELD(light, ambient), FIELD(light, diffuse), FIELD(light, specular),
	FIELD(light, position_eye), FIELD(light, spot_direction_eye), FIELD(light, spot_exponent),
	FIELD(light, spot_cutoff_deg), FIELD(light, attenuation), FIELD(light, radius),
	{ 0 },
};

static const struct field current_fields[] = {
	FIELD(current, color), FIELD(current, secondary), FIELD(current, normal), FIELD(current, texcoord),
	FIELD(current, fog_coord),
	{ 0 },
};

static const struct field view_fields[] = {
	FIELD(view, projection), FIELD(view, viewport), FIELD(view, depth_range), FIELD(view, scissor),
	FIELD(view, target), FIELD(view, space),
	{ 0 },
};

static const struct field instance_fields[] = {
	FIELD(instance, mesh), FIELD(instance, material), FIELD(instance, view), FIELD(instance, current),
	FIELD(instance, draw), FIELD(instance, first_primitive), FIELD(instance, given),
	FIELD(instance, modelview),
	{ 0 },
};

static const struct field clear_fields[] = {
	FIELD(clear, before_instance), FIELD(clear, draw), FIELD(clear, target), FIELD(clear, buffers),
	FIELD(clear, scissor), FIELD(clear, color), FIELD(clear, depth), FIELD(clear, stencil), FIELD(clear, color_mask),
	FIELD(clear, stencil_mask),
	{ 0 },
};

static const struct field texture_fields[] = {
	TOKEN(texture, target), TOKEN(texture, base_format), FIELD(texture, width), FIELD(texture, height),
	FIELD(texture, depth), FIELD(texture, n_levels), FIELD(texture, border), FIELD(texture, n_bytes),
	{ 0 },
};

static const struct field scene_fields[] = {
	SCENE_FIELD(frame), SCENE_FIELD(width), SCENE_FIELD(height), SCENE_FIELD(depth_bits),
	SCENE_FIELD(stencil_bits), SCENE_FIELD(alpha_bits), SCENE_FIELD(samples), SCENE_FIELD(floats),
	SCENE_FIELD(kd_tree), SCENE_FIELD(n_primitives), SCENE_FIELD(n_draws), SCENE_FIELD(needs_previous),
	{ 0 },
};

static void write_object(struct json *j, const struct field *fields, const void *object);

static void write_tokens(struct json *j, const struct field *f, const uint32_t *tokens)
{
	char text[TOKEN_NAME_BYTES];

	if (f->is_array)
		json_key_begin(j, f->name, '[');
	else
		json_key(j, f->name);
	for (size_t i = 0; i < f->bytes / sizeof(*tokens); i++)
		json_string(j, f->kind == FACTORS ? token_factor_name(tokens[i], text) : token_name(tokens[i], text));
	if (f->is_array)
		json_end(j, ']');
}

static void write_field(struct json *j, const struct field *f, const void *at)
{
	static const struct field *const inner[] = {
		[FACE] = face_fields, [STENCIL] = stencil_fields, [SURFACE] = surface_fields
	};
	size_t n = f->bytes / 4;

	if (f->kind >= FACE) {
		json_key(j, f->name);
		write_object(j, inner[f->kind], at);
	} else if (f->kind == FLOATS) {
		f->is_array ? json_key_floats(j, f->name, at, n) : json_key_float(j, f->name, (double)*(const float *)at);
	} else if (f->kind == TOKENS || f->kind == FACTORS) {
		write_tokens(j, f, at);
	} else if (f->kind == INTS) {
		json_key_ints(j, f->name, at, n);
	} else if (f->is_array) {
		json_key_uints(j, f->name, at, n);
	} else {
		json_key_uint(j, f->name, f->bytes == 8 ? *(const uint64_t *)at : *(const uint32_t *)at);
	}
}

static void write_fields(struct json *j, const struct field *fields, const void *object)
{
	for (; fields->name; fields++)
		write_field(j, fields, (const char *)object + fields->offset);
}

static void write_object(struct json *j, const struct field *fields, const void *object)
{
	json_begin(j, '{');
	write_fields(j, fields, object);
	json_end(j, '}');
}

static void write_instance(struct json *j, const struct scene *s, const struct scene_instance *in)
{
	const struct scene_draw *draw = &s->draws[in->draw];

	json_begin(j, '{');
	write_fields(j, instance_fields, in);
	json_key_string(j, "call", draw->call);
	json_key_uint(j, "call_number", draw->call_number);
	json_key_uint(j, "list", draw->list);
	json_end(j, '}');
}

static void write_hash(struct json *j, const uint64_t hash[2])
{
	char text[33];

	hash_text(hash, text);
	json_key_string(j, "hash", text);
}

static void write_texture(struct json *j, const struct scene_texture *t)
{
	json_begin(j, '{');
	write_hash(j, t->hash);
	write_fields(j, texture_fields, t);
	json_end(j, '}');
}

static void write_floats(struct json *j, const char *name, const float *values, size_t n)
{
	if (values)
		json_key_floats(j, name, values, n);
}

static void write_faces(struct json *j, const struct scene_mesh *m)
{
	json_key_begin(j, "face", '[');
	for (size_t v = 0; v < m->vertex_count; v++) {
		json_begin(j, '{');
		json_key(j, "front");
		write_object(j, face_fields, &m->face[v][0]);
		json_key(j, "back");
		write_object(j, face_fields, &m->face[v][1]);
		json_end(j, '}');
	}
	json_end(j, ']');
}

static void write_arrays(struct json *j, const struct scene_mesh *m)
{
	char name[16];
	size_t n = m->vertex_count;

	write_floats(j, "position", m->position, 4 * n);
	write_floats(j, "normal", m->normal, 3 * n);
	write_floats(j, "color", m->color, 4 * n);
	write_floats(j, "secondary", m->secondary, 4 * n);
	write_floats(j, "fog_coord", m->fog_coord, n);
	for (unsigned u = 0; u < SCENE_MAX_UNITS; u++) {
		snprintf(name, sizeof(name), "texcoord%u", u);
		write_floats(j, name, m->texcoord[u], 4 * n);
	}
	if (m->face)
		write_faces(j, m);
	json_key_uints(j, "index", m->index, (size_t)m->primitive_count * m->kind);
	if (m->primitive_draw)
		json_key_uints(j, "primitive_draw", m->primitive_draw, m->primitive_count);
}

static void write_mesh(struct json *j, const struct scene_mesh *m, int vertices)
{
	json_begin(j, '{');
	write_hash(j, m->hash);
	json_key_string(j, "kind", kind_name(m->kind));
	json_key_uint(j, "vertex_count", m->vertex_count);
	json_key_uint(j, "primitive_count", m->primitive_count);
	json_key_uint(j, "attributes", m->attributes);
	if (vertices)
		write_arrays(j, m);
	json_end(j, '}');
}

#define LIST(name, write) \
	do { \
		json_key_begin(j, #name, '['); \
		for (uint32_t i = 0; i < s->n_##name; i++) \
			write; \
		json_end(j, ']'); \
	} while (0)

void scene_write_json(FILE *out, const struct scene *s, int vertices)
{
	struct json json = { .out = out }, *j = &json;

	json_begin(j, '{');
	write_fields(j, scene_fields, s);
	LIST(views, write_object(j, view_fields, &s->views[i]));
	LIST(clears, write_object(j, clear_fields, &s->clears[i]));
	LIST(instances, write_instance(j, s, &s->instances[i]));
	LIST(materials, write_object(j, material_fields, &s->materials[i]));
	LIST(lights, write_object(j, light_fields, &s->lights[i]));
	LIST(units, write_object(j, unit_fields, &s->units[i]));
	LIST(currents, write_object(j, current_fields, &s->currents[i]));
	LIST(meshes, write_mesh(j, s->meshes[i], vertices));
	LIST(textures, write_texture(j, s->textures[i]));
	json_end(j, '}');
	putc('\n', out);
}
