/* Describes a surface: its draw, mesh, textures and material. */
#include "scene/describe.h"

#include <inttypes.h>

#include "base/hash.h"
#include "base/plural.h"
#include "gl_tokens.h"
#include "scene/tokens.h"

static void write_draw(FILE *out, const struct scene_draw *draw, uint32_t number)
{
	fprintf(out, "draw %u: %s, call %" PRIu64, number, draw->call, draw->call_number);
	if (draw->list)
		fprintf(out, ", display list %u", draw->list);
	for (int i = 0; i < SCENE_DRAW_PROGRAMS; i++)
		if (draw->programs[i].kind)
			fprintf(out, ", %s %u", draw->programs[i].kind, draw->programs[i].name);
	fputc('\n', out);
}

static void write_mesh(FILE *out, const struct scene_mesh *m)
{
	static const char *const kinds[] = { "", "point", "line", "triangle" };
	char hash[33];

	hash_text(m->hash, hash);
	fprintf(out, "mesh %s: %u %s%s%s%s\n", hash, m->primitive_count, kinds[m->kind], plural(m->primitive_count),
	        m->normal ? ", with normals" : "", m->color ? ", with colours" : "");
}

static void write_texture(FILE *out, const struct scene *s, const struct scene_unit *u)
{
	const struct scene_texture *t = s->textures[u->texture];
	char target[TOKEN_NAME_BYTES], format[TOKEN_NAME_BYTES], mode[TOKEN_NAME_BYTES], gen_mode[TOKEN_NAME_BYTES];
	char hash[33];

	hash_text(t->hash, hash);
	fprintf(out, "texture %s: unit %u, %u x %u, %s %s, %s", hash, u->unit, t->width, t->height,
	        token_name(t->target, target), token_name(t->base_format, format), token_name(u->env_mode, mode));
	if (u->gen_mode[0])
		fprintf(out, ", coordinates by %s", token_name(u->gen_mode[0], gen_mode));
	fputc('\n', out);
}

static void write_color(FILE *out, const char *name, const float c[4])
{
	fprintf(out, ", %s %.3g %.3g %.3g", name, (double)c[0], (double)c[1], (double)c[2]);
}

/* A colour of a lit material's front, unless glColorMaterial takes it from the vertices (GL 2.1 sec. 2.14.3). */
static void write_part(FILE *out, const struct scene_material *m, const char *name, uint32_t mode, const float c[4])
{
	const int both = m->color_material_mode == GL_AMBIENT_AND_DIFFUSE && mode != GL_SPECULAR;

	if (m->color_material && m->color_material != GL_BACK && (both || m->color_material_mode == mode))
		fprintf(out, ", %s from the vertices", name);
	else
		write_color(out, name, c);
}

static void write_lighting(FILE *out, const struct scene_material *m)
{
	if (!m->lighting) {
		fprintf(out, "material: not lit");
		return;
	}
	fprintf(out, "material: lit by %u light%s", m->light_count, plural(m->light_count));
	write_part(out, m, "diffuse", GL_DIFFUSE, m->front.diffuse);
	write_part(out, m, "specular", GL_SPECULAR, m->front.specular);
	fprintf(out, ", shininess %.3g", (double)m->front.shininess);
}

/* Write how much light a surface reflects and lets through. */
static void write_surface(FILE *out, const struct scene_surface *s)
{
	if (s->reflect > 0)
		fprintf(out, ", mirrors %.3g", (double)s->reflect);
	if (s->transmit > 0)
		fprintf(out, ", lets %.3g of the light through", (double)s->transmit);
}

static void write_state(FILE *out, const struct scene_material *m)
{
	char a[TOKEN_NAME_BYTES], b[TOKEN_NAME_BYTES];

	if (m->blend)
		fprintf(out, ", blended %s %s", token_factor_name(m->blend_src_rgb, a), token_factor_name(m->blend_dst_rgb, b));
	if (m->alpha_test)
		fprintf(out, ", alpha test %s %.3g", token_name(m->alpha_func, a), (double)m->alpha_ref);
	if (m->stencil_test)
		fprintf(out, ", stencil test %s", token_name(m->stencil_front.func, a));
	fprintf(out, "%s%s\n", m->depth_test ? "" : ", no depth test", m->fog ? ", in fog" : "");
}

void scene_describe(FILE *out, const struct scene *s, uint32_t instance, const char *prefix)
{
	const struct scene_instance *in = &s->instances[instance];
	const struct scene_material *m = &s->materials[in->material];

	fputs(prefix, out);
	write_draw(out, &s->draws[in->draw], in->draw);
	fputs(prefix, out);
	write_mesh(out, s->meshes[in->mesh]);
	for (uint32_t i = 0; i < m->unit_count; i++) {
		fputs(prefix, out);
		write_texture(out, s, &s->units[m->unit_first + i]);
	}
	fputs(prefix, out);
	write_lighting(out, m);
	write_surface(out, &m->surface);
	write_state(out, m);
}
