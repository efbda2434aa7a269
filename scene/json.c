/* relume scene: the scene of a frame, as text or JSON. */
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/verbs.h"
#include "base/json.h"
#include "replay/replay.h"

static void print_help(void)
{
	puts("usage: relume scene [OPTIONS] TRACE\n"
	     "\n"
	     "Print what one frame draws: views, clears, instances with their meshes and materials, textures.\n"
	     "\n"
	     "  -f, --frame N   which frame, from 0 (default 0)\n"
	     "  -j, --json      everything, as JSON; otherwise one line per instance\n"
	     "  -v, --vertices  with --json: the meshes' arrays too\n"
	     "  -h, --help      this text");
}

static const char *kind_name(enum scene_primitive kind)
{
	return kind == SCENE_POINTS ? "points" : kind == SCENE_LINES ? "lines" : "triangles";
}

static void hash_text(const uint64_t hash[2], char out[33])
{
	snprintf(out, 33, "%016" PRIx64 "%016" PRIx64, hash[1], hash[0]);
}

/* ---- text ---- */

static void print_clears(const struct scene *s, uint32_t *next, uint32_t before)
{
	for (; *next < s->n_clears && s->clears[*next].before_instance <= before; (*next)++) {
		const struct scene_clear *c = &s->clears[*next];
		printf("draw %u: clear%s%s%s, scissor %d %d %dx%d\n", c->draw, c->buffers & 1 ? " colour" : "",
		       c->buffers & 2 ? " depth" : "", c->buffers & 4 ? " stencil" : "", c->scissor[0], c->scissor[1],
		       c->scissor[2], c->scissor[3]);
	}
}

static void print_text(const struct scene *s)
{
	uint32_t clear = 0;

	printf("frame %" PRIu64 ": %ux%u, %u instances, %u primitives, %u meshes, %u materials, %u views, %u textures%s\n",
	       s->frame, s->width, s->height, s->n_instances, s->n_primitives, s->n_meshes, s->n_materials, s->n_views,
	       s->n_textures, s->needs_previous ? ", shows pixels of an earlier frame" : "");
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_mesh *m = s->meshes[in->mesh];
		const struct scene_material *mat = &s->materials[in->material];
		print_clears(s, &clear, i);
		printf("draw %u: %u %s of mesh %u, material %u (%s%u textures%s%s%s), view %u, %s at call %" PRIu64 "\n", in->draw,
		       m->primitive_count, kind_name(m->kind), in->mesh, in->material, mat->lighting ? "lit, " : "",
		       mat->unit_count, mat->blend ? ", blended" : "", mat->alpha_test ? ", alpha test" : "",
		       mat->depth_test ? "" : ", no depth test", in->view, s->draws[in->draw].call, s->draws[in->draw].call_number);
	}
	print_clears(s, &clear, s->n_instances);
}

/* ---- JSON: names are those of scene.h ---- */

#define UINT(object, field) json_key_uint(j, #field, (object)->field)
#define FLOAT(object, field) json_key_float(j, #field, (double)(object)->field)
#define FLOATS(object, field) json_key_floats(j, #field, (const float *)(object)->field, sizeof((object)->field) / sizeof(float))

static void write_face(struct json *j, const char *name, const struct scene_face *f)
{
	json_key(j, name);
	json_begin(j, '{');
	FLOATS(f, ambient);
	FLOATS(f, diffuse);
	FLOATS(f, specular);
	FLOATS(f, emission);
	FLOAT(f, shininess);
	json_end(j, '}');
}

static void write_stencil(struct json *j, const char *name, const struct scene_stencil *s)
{
	json_key(j, name);
	json_begin(j, '{');
	UINT(s, func);
	UINT(s, ref);
	UINT(s, compare_mask);
	UINT(s, write_mask);
	UINT(s, fail);
	UINT(s, zfail);
	UINT(s, zpass);
	json_end(j, '}');
}

static void write_material(struct json *j, const struct scene_material *m)
{
	json_begin(j, '{');
	UINT(m, lighting);
	UINT(m, light_first);
	UINT(m, light_count);
	FLOATS(m, light_model_ambient);
	UINT(m, local_viewer);
	UINT(m, two_side);
	UINT(m, separate_specular);
	write_face(j, "front", &m->front);
	write_face(j, "back", &m->back);
	UINT(m, color_material);
	UINT(m, color_material_mode);
	UINT(m, normalize);
	UINT(m, rescale_normal);
	UINT(m, shade_model);
	UINT(m, first_provokes);
	UINT(m, unit_first);
	UINT(m, unit_count);
	UINT(m, color_sum);
	UINT(m, fog);
	UINT(m, fog_mode);
	UINT(m, fog_coord_source);
	FLOAT(m, fog_density);
	FLOAT(m, fog_start);
	FLOAT(m, fog_end);
	FLOATS(m, fog_color);
	UINT(m, cull_face);
	UINT(m, front_face);
	UINT(m, polygon_mode_front);
	UINT(m, polygon_mode_back);
	UINT(m, polygon_offset);
	FLOAT(m, polygon_offset_factor);
	FLOAT(m, polygon_offset_units);
	UINT(m, polygon_stipple);
	UINT(m, line_stipple);
	FLOAT(m, line_width);
	FLOAT(m, point_size);
	UINT(m, line_smooth);
	UINT(m, point_smooth);
	UINT(m, polygon_smooth);
	UINT(m, point_sprite);
	FLOATS(m, point_attenuation);
	FLOAT(m, point_size_min);
	FLOAT(m, point_size_max);
	FLOAT(m, point_fade_threshold);
	UINT(m, multisample);
	UINT(m, samples_off);
	UINT(m, alpha_to_coverage);
	UINT(m, alpha_to_one);
	UINT(m, clip_plane_mask);
	FLOATS(m, clip_plane_eye);
	UINT(m, alpha_test);
	UINT(m, alpha_func);
	FLOAT(m, alpha_ref);
	UINT(m, stencil_test);
	write_stencil(j, "stencil_front", &m->stencil_front);
	write_stencil(j, "stencil_back", &m->stencil_back);
	UINT(m, depth_test);
	UINT(m, depth_func);
	UINT(m, depth_write);
	UINT(m, blend);
	UINT(m, blend_equation_rgb);
	UINT(m, blend_equation_alpha);
	UINT(m, blend_src_rgb);
	UINT(m, blend_dst_rgb);
	UINT(m, blend_src_alpha);
	UINT(m, blend_dst_alpha);
	FLOATS(m, blend_color);
	UINT(m, logic_op);
	UINT(m, color_mask);
	json_key(j, "surface");
	json_begin(j, '{');
	FLOAT(&m->surface, reflect);
	FLOAT(&m->surface, transmit);
	FLOAT(&m->surface, ior);
	FLOATS(&m->surface, absorb);
	FLOAT(&m->surface, roughness);
	UINT(&m->surface, hidden);
	FLOATS(&m->surface, emission);
	json_end(j, '}');
	UINT(m, program);
	json_end(j, '}');
}

static void write_unit(struct json *j, const struct scene_unit *u)
{
	json_begin(j, '{');
	UINT(u, unit);
	UINT(u, texture);
	UINT(u, wrap_s);
	UINT(u, wrap_t);
	UINT(u, wrap_r);
	UINT(u, min_filter);
	UINT(u, mag_filter);
	FLOATS(u, border_color);
	FLOAT(u, lod_bias);
	FLOAT(u, min_lod);
	FLOAT(u, max_lod);
	FLOAT(u, max_anisotropy);
	UINT(u, compare_mode);
	UINT(u, compare_func);
	UINT(u, depth_mode);
	UINT(u, env_mode);
	FLOATS(u, env_color);
	UINT(u, combine_rgb);
	UINT(u, combine_alpha);
	json_key_uints(j, "source_rgb", u->source_rgb, 4);
	json_key_uints(j, "source_alpha", u->source_alpha, 4);
	json_key_uints(j, "operand_rgb", u->operand_rgb, 4);
	json_key_uints(j, "operand_alpha", u->operand_alpha, 4);
	FLOAT(u, scale_rgb);
	FLOAT(u, scale_alpha);
	json_key_uints(j, "gen_mode", u->gen_mode, 4);
	FLOATS(u, gen_object_plane);
	FLOATS(u, gen_eye_plane);
	FLOATS(u, matrix);
	UINT(u, coord_replace);
	json_end(j, '}');
}

static void write_light(struct json *j, const struct scene_light *l)
{
	json_begin(j, '{');
	UINT(l, index);
	FLOATS(l, ambient);
	FLOATS(l, diffuse);
	FLOATS(l, specular);
	FLOATS(l, position_eye);
	FLOATS(l, spot_direction_eye);
	FLOAT(l, spot_exponent);
	FLOAT(l, spot_cutoff_deg);
	FLOATS(l, attenuation);
	FLOAT(l, radius);
	json_end(j, '}');
}

static void write_current(struct json *j, const struct scene_current *c)
{
	json_begin(j, '{');
	FLOATS(c, color);
	FLOATS(c, secondary);
	FLOATS(c, normal);
	FLOATS(c, texcoord);
	FLOAT(c, fog_coord);
	json_end(j, '}');
}

static void write_view(struct json *j, const struct scene_view *v)
{
	json_begin(j, '{');
	FLOATS(v, projection);
	FLOATS(v, viewport);
	FLOATS(v, depth_range);
	json_key_ints(j, "scissor", v->scissor, 4);
	UINT(v, target);
	UINT(v, space);
	json_end(j, '}');
}

static void write_instance(struct json *j, const struct scene *s, const struct scene_instance *in)
{
	json_begin(j, '{');
	UINT(in, mesh);
	UINT(in, material);
	UINT(in, view);
	UINT(in, current);
	UINT(in, draw);
	UINT(in, first_primitive);
	FLOATS(in, modelview);
	json_key_string(j, "call", s->draws[in->draw].call);
	json_key_uint(j, "call_number", s->draws[in->draw].call_number);
	json_key_uint(j, "list", s->draws[in->draw].list);
	json_end(j, '}');
}

static void write_clear(struct json *j, const struct scene_clear *c)
{
	json_begin(j, '{');
	UINT(c, before_instance);
	UINT(c, draw);
	UINT(c, target);
	UINT(c, buffers);
	json_key_ints(j, "scissor", c->scissor, 4);
	FLOATS(c, color);
	FLOAT(c, depth);
	UINT(c, stencil);
	UINT(c, color_mask);
	UINT(c, stencil_mask);
	json_end(j, '}');
}

static void write_mesh(struct json *j, const struct scene_mesh *m, int vertices)
{
	char hash[33], name[16];
	size_t n = m->vertex_count;

	hash_text(m->hash, hash);
	json_begin(j, '{');
	json_key_string(j, "hash", hash);
	json_key_string(j, "kind", kind_name(m->kind));
	UINT(m, vertex_count);
	UINT(m, primitive_count);
	UINT(m, attributes);
	if (vertices) {
		json_key_floats(j, "position", m->position, 4 * n);
		if (m->normal)
			json_key_floats(j, "normal", m->normal, 3 * n);
		if (m->color)
			json_key_floats(j, "color", m->color, 4 * n);
		if (m->secondary)
			json_key_floats(j, "secondary", m->secondary, 4 * n);
		if (m->fog_coord)
			json_key_floats(j, "fog_coord", m->fog_coord, n);
		for (unsigned u = 0; u < SCENE_MAX_UNITS; u++) {
			snprintf(name, sizeof(name), "texcoord%u", u);
			if (m->texcoord[u])
				json_key_floats(j, name, m->texcoord[u], 4 * n);
		}
		if (m->face) {
			json_key(j, "face");
			json_begin(j, '[');
			for (size_t v = 0; v < n; v++) {
				json_begin(j, '{');
				write_face(j, "front", &m->face[v][0]);
				write_face(j, "back", &m->face[v][1]);
				json_end(j, '}');
			}
			json_end(j, ']');
		}
		json_key_uints(j, "index", m->index, (size_t)m->primitive_count * m->kind);
		if (m->primitive_draw)
			json_key_uints(j, "primitive_draw", m->primitive_draw, m->primitive_count);
	}
	json_end(j, '}');
}

static void write_texture(struct json *j, const struct scene_texture *t)
{
	char hash[33];

	hash_text(t->hash, hash);
	json_begin(j, '{');
	json_key_string(j, "hash", hash);
	UINT(t, target);
	UINT(t, base_format);
	UINT(t, width);
	UINT(t, height);
	UINT(t, depth);
	UINT(t, n_levels);
	UINT(t, border);
	UINT(t, n_bytes);
	json_end(j, '}');
}

#define LIST(name, write) \
	do { \
		json_key(j, #name); \
		json_begin(j, '['); \
		for (uint32_t i = 0; i < s->n_##name; i++) \
			write; \
		json_end(j, ']'); \
	} while (0)

static void print_json(const struct scene *s, int vertices)
{
	struct json out = { .out = stdout }, *j = &out;

	json_begin(j, '{');
	UINT(s, frame);
	UINT(s, width);
	UINT(s, height);
	UINT(s, depth_bits);
	UINT(s, stencil_bits);
	UINT(s, alpha_bits);
	UINT(s, samples);
	UINT(s, floats);
	UINT(s, kd_tree);
	UINT(s, n_primitives);
	UINT(s, n_draws);
	UINT(s, needs_previous);
	LIST(views, write_view(j, &s->views[i]));
	LIST(clears, write_clear(j, &s->clears[i]));
	LIST(instances, write_instance(j, s, &s->instances[i]));
	LIST(materials, write_material(j, &s->materials[i]));
	LIST(lights, write_light(j, &s->lights[i]));
	LIST(units, write_unit(j, &s->units[i]));
	LIST(currents, write_current(j, &s->currents[i]));
	LIST(meshes, write_mesh(j, s->meshes[i], vertices));
	LIST(textures, write_texture(j, s->textures[i]));
	json_end(j, '}');
	putchar('\n');
}

int scene_main(int argc, char **argv)
{
	static const struct option options[] = {
		{ "frame", required_argument, NULL, 'f' }, { "json", no_argument, NULL, 'j' },
		{ "vertices", no_argument, NULL, 'v' },    { "help", no_argument, NULL, 'h' }, { 0 },
	};
	struct scene *scene = NULL;
	uint64_t frame = 0;
	int json = 0, vertices = 0, opt, rc;

	while ((opt = getopt_long(argc, argv, "f:jvh", options, NULL)) != -1) {
		switch (opt) {
		case 'f':
			if (frame_number_parse(optarg, &frame))
				return -ERR_USAGE;
			break;
		case 'j':
			json = 1;
			break;
		case 'v':
			vertices = 1;
			break;
		case 'h':
			print_help();
			return 0;
		default:
			return -ERR_USAGE;
		}
	}
	if (argc - optind != 1)
		return -err_report(ERR_USAGE, NULL, "scene takes one trace; 'relume help scene' says more");
	rc = replay_one_frame(argv[optind], frame, &scene);
	if (rc)
		return -rc;
	if (json)
		print_json(scene, vertices);
	else
		print_text(scene);
	scene_release(&scene);
	return 0;
}
