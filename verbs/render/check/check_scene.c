#include "verbs/render/check/check_scene.h"

#include <string.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "scene/program.h"

const char *const check_scene_names[N_CHECK_SCENES] = {
#define CHECK_SCENE_NAME(name, word, mode) #word,
	CHECK_SCENES(CHECK_SCENE_NAME)
};

static const enum tracer_mode modes[N_CHECK_SCENES] = {
#define CHECK_SCENE_MODE(name, word, mode) mode,
	CHECK_SCENES(CHECK_SCENE_MODE)
};

static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 }, back[3] = { 0, 0, -1 };

/* A chequered texture with all its levels, laid over surfaces by their own coordinates. */
static void make_texture(struct check_world *w)
{
	uint8_t *texel = w->texels;

	for (uint32_t size = 8; size; size /= 2)
		for (uint32_t i = 0; i < size * size; i++, texel += 4) {
			const int odd = (i % size ^ i / size) & 1;

			texel[0] = odd ? 250 : 90;
			texel[1] = odd ? 200 : 120;
			texel[2] = odd ? 120 : (uint8_t)(60 + 20 * size);
			texel[3] = odd ? 255 : 40;
		}
	w->texture = (struct scene_texture){ .hash = { 7, 7 },
		                             .target = GL_TEXTURE_2D,
		                             .base_format = GL_RGBA,
		                             .width = 8,
		                             .height = 8,
		                             .depth = 1,
		                             .n_levels = 4,
		                             .texels = w->texels,
		                             .n_bytes = sizeof(w->texels) };
	w->textures[0] = &w->texture;
	w->unit = (struct scene_unit){ .wrap_s = GL_REPEAT, .wrap_t = GL_MIRRORED_REPEAT, .wrap_r = GL_REPEAT,
		                       .min_filter = GL_LINEAR_MIPMAP_LINEAR, .mag_filter = GL_LINEAR, .min_lod = -1000,
		                       .max_lod = 1000, .max_anisotropy = 1, .env_mode = GL_MODULATE, .scale_rgb = 1,
		                       .scale_alpha = 1,
		                       .gen_mode = { GL_OBJECT_LINEAR, GL_OBJECT_LINEAR } };
	w->unit.gen_object_plane[0][0] = w->unit.gen_object_plane[1][1] = 0.4f;
	w->unit.gen_object_plane[1][2] = 0.3f;
	for (int k = 0; k < 4; k++)
		w->unit.matrix[5 * k] = 1;
	w->made.scene.units = &w->unit;
	w->made.scene.n_units = 1;
	w->made.scene.textures = w->textures;
	w->made.scene.n_textures = 1;
}

/* A material with this colour and a highlight. */
static struct scene_material *add_paint(struct made *m, uint32_t *number, float red, float green, float blue)
{
	struct scene_material *paint;

	*number = made_add_material(m, 1);
	paint = &m->materials[*number];
	paint->front = (struct scene_face){ .ambient = { red / 4, green / 4, blue / 4, 1 }, .diffuse = { red, green, blue, 1 },
		                            .specular = { 0.5f, 0.5f, 0.4f, 1 }, .shininess = 20 };
	paint->back = paint->front;
	return paint;
}

static void blend(struct scene_material *m, uint32_t source, uint32_t destination)
{
	m->blend = 1;
	m->blend_src_rgb = m->blend_src_alpha = source;
	m->blend_dst_rgb = m->blend_dst_alpha = destination;
}

/* Parts of all scenes: two lights, a textured floor in fog, a wall. */
static void add_room(struct check_world *w, uint32_t *floor)
{
	struct made *m = &w->made;
	uint32_t wall;

	made_add_light(m, 2, 3, -3, 1);
	m->lights[0].specular[0] = m->lights[0].specular[1] = 1;
	m->lights[0].attenuation[1] = 0.05f;
	made_add_light(m, -1, 1.5f, 1, 0);
	m->lights[1].diffuse[2] = 0.25f;
	m->lights[1].ambient[0] = 0.1f;
	m->materials[made_add_material(m, 0.7f)].unit_count = 1;
	*floor = m->scene.n_materials - 1;
	m->materials[*floor].fog = 1;
	m->materials[*floor].fog_mode = GL_EXP2;
	m->materials[*floor].fog_density = 0.04f;
	m->materials[*floor].fog_color[2] = 0.4f;
	add_paint(m, &wall, 0.5f, 0.6f, 0.7f);
	made_add_square(m, *floor, (float[3]){ 0, -2, -9 }, right, back, 6, 6);
	made_add_square(m, wall, (float[3]){ 0, 2, -13 }, right, up, 6, 3);
}

static void add_things(struct made *m, uint32_t rings)
{
	uint32_t ball, flat, wire;

	add_paint(m, &ball, 0.8f, 0.3f, 0.2f)->local_viewer = 1;
	add_paint(m, &flat, 0.2f, 0.6f, 0.3f)->shade_model = GL_FLAT;
	add_paint(m, &wire, 0.9f, 0.9f, 0.2f)->polygon_mode_front = GL_LINE;
	m->materials[wire].polygon_mode_back = GL_POINT;
	m->materials[wire].line_width = 2;
	made_add_ball(m, ball, (float[3]){ -1.3f, -0.7f, -7 }, 1.2f, rings, 0);
	made_add_ball(m, flat, (float[3]){ 1.6f, -1, -8 }, 1, rings, 0);
	made_add_square(m, wire, (float[3]){ 0.3f, 0.6f, -5 }, right, (float[3]){ 0, 0.8f, 0.6f }, 0.7f, 3);
	made_add_square(m, wire, (float[3]){ 1.9f, 1, -5.5f }, (float[3]){ -1, 0, 0 }, up, 0.4f, 3);
}

static void add_films(struct made *m)
{
	uint32_t glow, film, leaf;

	blend(add_paint(m, &film, 0.3f, 0.4f, 0.9f), GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	m->materials[film].front.diffuse[3] = m->materials[film].back.diffuse[3] = 0.4f;
	m->materials[film].depth_write = 0;
	blend(add_paint(m, &glow, 0.4f, 0.2f, 0.1f), GL_ONE, GL_ONE);
	m->materials[glow].lighting = 0;
	leaf = made_add_material(m, 0.9f);
	m->materials[leaf].unit_count = 1;
	m->materials[leaf].alpha_test = 1;
	m->materials[leaf].alpha_func = GL_GREATER;
	m->materials[leaf].alpha_ref = 0.5f;
	made_add_square(m, film, (float[3]){ -0.4f, 0, -5 }, right, up, 1, 2);
	made_add_square(m, leaf, (float[3]){ 0.8f, 0.3f, -5.5f }, right, (float[3]){ 0, 0.8f, 0.6f }, 1, 1);
	made_add_square(m, film, (float[3]){ 0.5f, -0.4f, -6 }, (float[3]){ 0.8f, 0, 0.6f }, up, 1.2f, 1);
	m->current.color[0] = 0.5f;
	m->current.color[1] = m->current.color[2] = 0.2f;
	made_add_square(m, glow, (float[3]){ 0, 0.4f, -4 }, right, up, 0.5f, 1);
	made_add_square(m, film, (float[3]){ -1, 0.8f, -4.5f }, right, up, 0.6f, 1);
}

static struct scene_stencil stencil_of(uint32_t func, uint32_t ref, uint32_t zfail, uint32_t zpass)
{
	return (struct scene_stencil){
		.func = func, .ref = ref, .compare_mask = 255, .write_mask = 255, .fail = GL_KEEP, .zfail = zfail,
		.zpass = zpass
	};
}

/* A ball behind a window; a volume, counted in the stencil where its faces are hidden; a quad that darkens there. */
static void add_stencils(struct made *m, uint32_t rings)
{
	uint32_t mask, seen, volume, dark;

	mask = made_add_material(m, 0);
	m->materials[mask].color_mask = m->materials[mask].depth_write = 0;
	m->materials[mask].stencil_test = 1;
	m->materials[mask].stencil_front = m->materials[mask].stencil_back = stencil_of(GL_ALWAYS, 128, GL_KEEP, GL_REPLACE);
	add_paint(m, &seen, 0.9f, 0.5f, 0.1f)->stencil_test = 1;
	m->materials[seen].stencil_front = m->materials[seen].stencil_back = stencil_of(GL_EQUAL, 128, GL_KEEP, GL_INVERT);
	volume = made_add_material(m, 0);
	m->materials[volume].color_mask = m->materials[volume].depth_write = 0;
	m->materials[volume].stencil_test = 1;
	m->materials[volume].stencil_front = stencil_of(GL_ALWAYS, 0, GL_DECR_WRAP, GL_KEEP);
	m->materials[volume].stencil_back = stencil_of(GL_ALWAYS, 0, GL_INCR_WRAP, GL_KEEP);
	dark = made_add_material(m, 0);
	blend(&m->materials[dark], GL_ZERO, GL_SRC_COLOR);
	m->materials[dark].lighting = m->materials[dark].depth_test = m->materials[dark].depth_write = 0;
	m->materials[dark].stencil_test = 1;
	m->materials[dark].stencil_front = m->materials[dark].stencil_back = stencil_of(GL_EQUAL, 1, GL_KEEP, GL_KEEP);
	made_add_square(m, mask, (float[3]){ -1, 0.5f, -5 }, right, up, 1.1f, 1);
	made_add_ball(m, seen, (float[3]){ -0.4f, 0.5f, -6 }, 1.1f, rings, 0);
	made_add_ball(m, volume, (float[3]){ 1.2f, -1.6f, -7.5f }, 1.3f, rings, 0);
	m->current.color[0] = 0.4f;
	m->current.color[1] = m->current.color[2] = 0.5f;
	made_add_square(m, dark, (float[3]){ 0, 0, -2 }, right, up, 4, 1);
}

static void add_glass(struct made *m, uint32_t rings)
{
	uint32_t ball, pane;

	ball = made_add_material(m, 0.3f);
	m->materials[ball].surface = (struct scene_surface){ .transmit = 0.9f, .ior = 1.5f, .absorb = { 0.1f, 0.3f, 0.2f } };
	pane = made_add_material(m, 0.6f);
	m->materials[pane].surface = (struct scene_surface){ .transmit = 0.7f, .reflect = 0.2f, .ior = 1 };
	made_add_ball(m, ball, (float[3]){ 0.1f, -0.4f, -5 }, 0.9f, rings, 0);
	made_add_square(m, pane, (float[3]){ 1.2f, 1.2f, -5.5f }, (float[3]){ 0.8f, 0, 0.6f }, up, 0.9f, 1);
}

/* A material that rules relight, by the second light alone. */
static void relight(struct scene_material *m)
{
	m->surface.relit = m->surface.light_first = m->surface.light_count = 1;
}

/* A square above that shines. */
static void add_lamp(struct made *m)
{
	uint32_t lamp;

	add_paint(m, &lamp, 0.2f, 0.2f, 0.2f);
	for (int i = 0; i < 3; i++)
		m->materials[lamp].surface.emission[i] = 1 + (float)i / 4;
	made_add_square(m, lamp, (float[3]){ -1, 2, -8 }, right, (float[3]){ 0, 0, 1 }, 1, 2);
}

/* Put a program behind those that are there. @return what a material calls it */
static uint32_t put_program(struct check_world *w, const struct scene_program *head,
                            const struct scene_instruction *instructions, const float *constants)
{
	struct scene *s = &w->made.scene;
	const uint32_t first = s->n_programs, n = (uint32_t)(sizeof(*head) + head->n_instructions * sizeof(*instructions)) / 4;

	if (first + n + head->n_constants > sizeof(w->programs) / 4) {
		w->made.err = err_report(ERR_SYSTEM, NULL, "no room for the programs of a scene");
		return 0;
	}
	memcpy(w->programs + first, head, sizeof(*head));
	memcpy(w->programs + first + sizeof(*head) / 4, instructions, head->n_instructions * sizeof(*instructions));
	memcpy(w->programs + first + n, constants, head->n_constants * sizeof(*constants));
	s->programs = w->programs;
	s->n_programs = first + n + head->n_constants;
	return first + 1;
}

/* A program moves the middle of this square towards the viewer, and colours it by its normals and a table. */
static void add_vertex_program(struct check_world *w)
{
	enum {
		OWN = SCENE_VERTEX_FIRST, PLACE = OWN + 4, CONSTANTS = SCENE_PROGRAM_CONSTANT, TABLE = CONSTANTS + 16,
		POSITION = SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_POSITION, COLOR = SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_COLOR,
		NORMAL = 4 * SCENE_VERTEX_NORMAL
	};
	static const struct scene_instruction instructions[] = {
		{ SCENE_OP_MOVE, 4, SCENE_STEP_A, PLACE, 4 * SCENE_VERTEX_POSITION, 0, 0 },
		{ SCENE_OP_SINE, 1, 0, OWN, PLACE, 0, 0 },
		{ SCENE_OP_ADD, 1, 0, PLACE + 2, PLACE + 2, OWN, 0 },
		{ SCENE_OP_MULTIPLY, 4, SCENE_STEP_B, POSITION, PLACE, CONSTANTS, 0 },
		{ SCENE_OP_MAD, 4, SCENE_STEP_B | SCENE_STEP_C, POSITION, PLACE + 1, CONSTANTS + 4, POSITION },
		{ SCENE_OP_MAD, 4, SCENE_STEP_B | SCENE_STEP_C, POSITION, PLACE + 2, CONSTANTS + 8, POSITION },
		{ SCENE_OP_MAD, 4, SCENE_STEP_B | SCENE_STEP_C, POSITION, PLACE + 3, CONSTANTS + 12, POSITION },
		{ SCENE_OP_MAD, 1, 0, OWN, PLACE, TABLE + 2, TABLE + 3 },
		{ SCENE_OP_FLOOR, 1, 0, OWN, OWN, 0, 0 },
		{ SCENE_OP_FETCH, 1, 0, OWN, TABLE, OWN, SCENE_ARRAY(4, 1) },
		{ SCENE_OP_MAD, 3, SCENE_STEP_A | SCENE_SATURATE, COLOR, NORMAL, TABLE + 1, OWN },
	};
	const uint32_t material = made_add_material(&w->made, 0.7f);
	const struct scene_program head = {
		sizeof(instructions) / sizeof(instructions[0]), 20, PLACE + 4,
		1u << SCENE_VERTEX_POSITION | 1u << SCENE_VERTEX_NORMAL, 0, 0,
		1u << SCENE_RESULT_POSITION | 1u << SCENE_RESULT_COLOR, 0, 0, 0, 0, 0
	};
	float constants[20] = { [16] = 0.2f, 0.5f, 3, 0.4f };

	memcpy(constants, w->made.view.projection, 64);
	w->made.materials[material].vertex_program = put_program(w, &head, instructions, constants);
	w->made.materials[material].program_normals = 1;
	w->made.materials[material].lighting = 0;
	made_add_square(&w->made, material, (float[3]){ 1.3f, -0.6f, -6.5f }, right, up, 1.4f, 9);
}

/* A program colours this square by a texture at its place in the window, and cuts out what is dark. */
static void add_fragment_program(struct check_world *w)
{
	enum { OWN = SCENE_PROGRAM_FIRST, SAMPLE = OWN + 4, CONSTANTS = SCENE_PROGRAM_CONSTANT };
	static const struct scene_instruction instructions[] = {
		{ SCENE_OP_MULTIPLY, 4, SCENE_STEP_A, OWN, 4 * SCENE_INPUT_POSITION, CONSTANTS, 0 },
		{ SCENE_OP_TEXTURE, 1, 0, SAMPLE, OWN, 0, 0 },
		{ SCENE_OP_ADD, 1, SCENE_NEGATE_B, OWN, SAMPLE, CONSTANTS + 1, 0 },
		{ SCENE_OP_KILL, 1, 0, 0, OWN, 0, 0 },
		{ SCENE_OP_FRACTION, 3, SCENE_STEP_A, OWN, 4 * SCENE_INPUT_POSITION, 0, 0 },
		{ SCENE_OP_MAD, 4, SCENE_STEP_A | SCENE_STEP_B | SCENE_STEP_C | SCENE_SATURATE, SCENE_PROGRAM_COLOR,
		  SAMPLE, 4 * SCENE_INPUT_COLOR, OWN },
		{ SCENE_OP_SELECT, 1, SCENE_NEGATE_A, SCENE_PROGRAM_DEPTH, OWN, 4 * SCENE_INPUT_POSITION + 2,
		  CONSTANTS + 1 },
	};
	static const float constants[2] = { 0.01f, 0.3f };
	const uint32_t n = sizeof(instructions) / sizeof(instructions[0]), material = made_add_material(&w->made, 0.7f);
	const struct scene_program head = { n, 2, SAMPLE + 4, 1u << SCENE_INPUT_POSITION | 1u << SCENE_INPUT_COLOR,
		                            1, 1, 0,          1,
		                            0, 0, 0,          0 };

	w->made.materials[material].unit_count = 1;
	w->made.materials[material].fragment_program = put_program(w, &head, instructions, constants);
	made_add_square(&w->made, material, (float[3]){ -1.5f, 0.9f, -4.5f }, right, up, 0.9f, 2);
}

int check_world_make(enum check_scene scene, uint32_t width, uint32_t height, uint32_t rings, struct check_world *w)
{
	struct made *m = &w->made;
	uint32_t floor;

	made_init(m, width, height, 0.7f);
	make_texture(w);
	w->options = (struct tracer_options){
		.mode = modes[scene], .display = 1, .depth = 4, .rays = 4, .reach = scene == CHECK_AO ? 5 : 0
	};
	add_room(w, &floor);
	if (scene == CHECK_MIRROR) {
		m->materials[floor].surface.reflect = 0.5f;
		m->materials[floor].surface.roughness = 0.02f;
	}
	if (scene == CHECK_PATH)
		m->lights[0].radius = 0.3f;
	add_things(m, rings);
	if (scene == CHECK_MIRROR)
		m->materials[floor + 2].surface.reflect = 0.7f; /* the first ball */
	if (scene == CHECK_OPAQUE || scene == CHECK_MIRROR)
		relight(&m->materials[floor + 3]); /* the second one */
	if (scene == CHECK_BLENDED) {
		add_films(m);
		add_fragment_program(w);
		add_vertex_program(w);
	}
	if (scene == CHECK_STENCIL)
		add_stencils(m, rings);
	if (scene == CHECK_GLASS || scene == CHECK_LINEAR)
		add_glass(m, rings);
	if (scene == CHECK_LINEAR) {
		w->options.display = 0;
		w->options.samples = 2;
		w->options.clamp = 10;
		m->materials[floor].surface.reflect = 0.3f;
		m->materials[floor].surface.roughness = 0.1f;
		add_lamp(m);
	}
	return m->err;
}

void check_world_free(struct check_world *w)
{
	made_free(&w->made);
}
