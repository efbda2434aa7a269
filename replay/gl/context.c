/* Contexts, their state with the initial values of GL 2.1 chapter 6, and the objects they share. */
#include "replay/gl/context.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/mat4.h"
#include "capture/format/call.h"
#include "replay/gl/geometry/eval.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/geometry/vertexarray.h"
#include "replay/gl/state/config.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/buffer.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/glsl/object.h"
#include "replay/programs/program.h"

#define MAX_CONTEXTS 4096

/* ---- initial values ---- */

static void init_lighting(struct gls_lighting *l)
{
	static const struct scene_face face = {
		.ambient = { 0.2f, 0.2f, 0.2f, 1 }, .diffuse = { 0.8f, 0.8f, 0.8f, 1 }, .specular = { 0, 0, 0, 1 },
		.emission = { 0, 0, 0, 1 }, .shininess = 0,
	};

	l->color_material_face = GL_FRONT_AND_BACK;
	l->color_material_mode = GL_AMBIENT_AND_DIFFUSE;
	l->face[0] = l->face[1] = face;
	for (unsigned i = 0; i < 4; i++)
		l->model_ambient[i] = i < 3 ? 0.2f : 1;
	l->shade_model = GL_SMOOTH;
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++) {
		struct scene_light *light = &l->lights[i].value;
		light->index = i;
		light->ambient[3] = light->diffuse[3] = light->specular[3] = 1;
		for (unsigned k = 0; k < 3 && i == 0; k++)
			light->diffuse[k] = light->specular[k] = 1;
		light->position_eye[2] = 1;
		light->spot_direction_eye[2] = -1;
		light->spot_cutoff_deg = 180;
		light->attenuation[0] = 1;
	}
}

static void init_unit(struct gls_unit *unit, uint32_t index)
{
	struct scene_unit *v = &unit->value;

	v->unit = index;
	v->env_mode = GL_MODULATE;
	v->combine_rgb = v->combine_alpha = GL_MODULATE;
	for (unsigned i = 0; i < 4; i++) {
		/* the fourth as in Mesa */
		static const uint32_t sources[] = { GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT, GL_CONSTANT };
		v->source_rgb[i] = v->source_alpha[i] = sources[i];
		v->operand_rgb[i] = i < 2 ? GL_SRC_COLOR : GL_SRC_ALPHA;
		v->operand_alpha[i] = GL_SRC_ALPHA;
	}
	v->scale_rgb = v->scale_alpha = 1;
	for (unsigned i = 0; i < 4; i++)
		v->gen_mode[i] = GL_EYE_LINEAR;
	for (unsigned i = 0; i < 2; i++)
		v->gen_object_plane[i][i] = v->gen_eye_plane[i][i] = 1;
	memcpy(v->matrix, mat4_identity, 64);
}

static void init_attribs(struct gls_attribs *a)
{
	for (unsigned i = 0; i < 4; i++)
		a->current.attribute[GLS_ATTR_COLOR][i] = 1;
	a->lighting.clamp = GL_TRUE;
	a->color.clamp = GL_FIXED_ONLY;
	a->current.attribute[GLS_ATTR_NORMAL][2] = 1;
	a->current.attribute[GLS_ATTR_NORMAL][3] = 1;
	a->current.attribute[GLS_ATTR_SECONDARY][3] = 1;
	a->current.attribute[GLS_ATTR_FOG_COORD][3] = 1;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++) {
		a->current.attribute[GLS_ATTR_TEXCOORD + u][3] = 1;
		a->current.raster_texcoord[u][3] = 1;
		init_unit(&a->texturing.units[u], u);
	}
	for (unsigned i = 0; i < SCENE_MAX_GENERICS; i++)
		a->current.attribute[GLS_ATTR_GENERIC + i][3] = 1;
	a->current.generic0[3] = 1;
	a->current.edge_flag = 1;
	a->current.index = 1;
	a->current.raster_position[3] = 1;
	for (unsigned i = 0; i < 4; i++)
		a->current.raster_color[i] = 1;
	a->current.raster_valid = 1;
	a->transform.matrix_mode = GL_MODELVIEW;
	a->viewport.depth_range[1] = 1;
	init_lighting(&a->lighting);
	a->fog = (struct gls_fog){ .mode = GL_EXP,
		                   .coord_source = GL_FRAGMENT_DEPTH,
		                   .distance_mode = GL_EYE_PLANE_ABSOLUTE_NV,
		                   .density = 1,
		                   .end = 1 };
	a->point = (struct gls_point){ .size = 1, .size_max = 255, .fade_threshold = 1, .attenuation = { 1 },
	                               .sprite_origin = GL_UPPER_LEFT };
	a->line = (struct gls_line){ .width = 1, .stipple_pattern = 0xffff, .stipple_factor = 1 };
	a->polygon.cull_face = GL_BACK;
	a->polygon.front_face = GL_CCW;
	a->polygon.mode[0] = a->polygon.mode[1] = GL_FILL;
	memset(a->polygon_stipple, 0xff, sizeof(a->polygon_stipple));
	a->multisample = (struct gls_multisample){ .enabled = 1, .coverage_value = 1 };
	for (unsigned side = 0; side < 2; side++)
		a->stencil.side[side] = (struct scene_stencil){ .func = GL_ALWAYS, .compare_mask = ~0u, .write_mask = ~0u,
		                                                .fail = GL_KEEP, .zfail = GL_KEEP, .zpass = GL_KEEP };
	a->stencil.active_face = GL_FRONT;
	a->depth = (struct gls_depth){ .func = GL_LESS, .write = 1, .clear = 1 };
	a->color = (struct gls_color_buffer){ .alpha_func = GL_ALWAYS, .equation_rgb = GL_FUNC_ADD,
	                                      .equation_alpha = GL_FUNC_ADD, .src_rgb = GL_ONE, .dst_rgb = GL_ZERO,
	                                      .src_alpha = GL_ONE, .dst_alpha = GL_ZERO, .logic_op = GL_COPY, .dither = 1,
	                                      .mask = 15, .draw_buffer = GL_BACK };
	for (unsigned i = 0; i < 4; i++)
		a->pixel.scale[i] = 1;
	a->pixel.depth_scale = 1;
	a->pixel.zoom[0] = a->pixel.zoom[1] = 1;
	a->pixel.read_buffer = GL_BACK;
	a->evaluator.grid1[1] = a->evaluator.grid2[1] = a->evaluator.grid2[3] = 1;
	a->evaluator.grid1_segments = a->evaluator.grid2_segments[0] = a->evaluator.grid2_segments[1] = 1;
	a->hint = (struct gls_hint){ GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE };
}

static void init_stack(struct gls_matrix_stack *stack, unsigned max)
{
	memcpy(stack->matrices[0], mat4_identity, 64);
	stack->max = max;
}

/* ---- share groups ---- */

struct gls_share *gls_share_create(void)
{
	struct gls_share *share = calloc(1, sizeof(*share));

	if (share)
		share->refs = 1;
	return share;
}

/* Drop the reference of one context. */
static void release_share(struct gls_share *share)
{
	if (--share->refs)
		return;
	TABLE_DROP(&share->lists, gls_list_free);
	TABLE_DROP(&share->textures, gls_texture_free);
	TABLE_DROP(&share->buffers, gls_buffer_free);
	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS; i++)
		gls_texture_free(share->defaults[i]);
	TABLE_DROP(&share->framebuffers, gls_framebuffer_free);
	TABLE_DROP(&share->renderbuffers, gls_renderbuffer_free);
	TABLE_DROP(&share->programs, gls_program_free);
	TABLE_DROP(&share->shaders, gls_shader_free);
	free(share);
}

/* ---- state ---- */

int gls_state_init(struct gls_state *st)
{
	memset(st, 0, sizeof(*st));
	st->attrib_stack = calloc(GLS_MAX_ATTRIB_DEPTH, sizeof(*st->attrib_stack));
	st->client_stack = calloc(GLS_MAX_ATTRIB_DEPTH, sizeof(*st->client_stack));
	if (!st->attrib_stack || !st->client_stack) {
		gls_state_free(st);
		return err_report(ERR_SYSTEM, NULL, "out of memory for a context");
	}
	init_attribs(&st->a);
	init_stack(&st->modelview, GLS_MAX_MATRICES);
	init_stack(&st->projection, GLS_MAX_MATRICES);
	init_stack(&st->color_matrix, 4);
	for (unsigned i = 0; i < GLS_MAX_PROGRAM_MATRICES; i++)
		init_stack(&st->program_matrix[i], 4);
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		init_stack(&st->texture[u], GLS_MAX_TEXTURE_MATRICES);
	gls_arrays_init(st->client.arrays);
	st->client.pack.alignment = st->client.unpack.alignment = 4;
	st->render_mode = GL_RENDER;
	st->dirty = GLS_DIRTY_ALL;
	st->depth_bits = 24;
	st->stencil_bits = 8;
	st->double_buffered = 1;
	return 0;
}

void gls_state_free(struct gls_state *st)
{
	gls_maps_free(st->maps);
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++)
		free(st->client.arrays[i].client);
	TABLE_DROP(&st->vertex_arrays, gls_vertex_array_free);
	if (st->list)
		gls_list_free(st->list);
	free(st->attrib_stack);
	free(st->client_stack);
	if (st->share)
		release_share(st->share);
	memset(st, 0, sizeof(*st));
}

/* ---- contexts ---- */

struct gls_context *gls_context_find(struct gls_exec *x, uint64_t handle)
{
	for (size_t i = x->n_contexts; handle && i-- > 0;)
		if (x->contexts[i]->handle == handle && !x->contexts[i]->destroyed)
			return x->contexts[i];
	return NULL;
}

struct gls_context *gls_context_create(struct gls_exec *x, uint64_t handle, uint64_t share,
                                       const struct trace_value *config, const char *api)
{
	struct gls_context *ctx, *other = gls_context_find(x, share), **grown;

	if (!handle)
		return NULL;
	if (x->n_contexts == MAX_CONTEXTS) {
		gls_unsupported(x, "more than 4096 contexts");
		return NULL;
	}
	ctx = calloc(1, sizeof(*ctx));
	grown = realloc(x->contexts, (x->n_contexts + 1) * sizeof(*grown));
	if (grown)
		x->contexts = grown;
	if (!ctx || !grown || gls_state_init(&ctx->state)) {
		free(ctx);
		gls_out_of_memory(x, sizeof(*ctx));
		return NULL;
	}
	ctx->handle = ctx->state.handle = handle;
	ctx->share_handle = share;
	ctx->api = api;
	if (config)
		gls_config_apply(x, &ctx->state, config);
	if (other) {
		ctx->state.share = other->state.share;
		ctx->state.share->refs++;
		ctx->shares = other->shares = 1;
	} else {
		ctx->state.share = gls_share_create();
		if (!ctx->state.share) {
			gls_out_of_memory(x, sizeof(struct gls_share));
			gls_state_free(&ctx->state);
			free(ctx);
			return NULL;
		}
	}
	x->contexts[x->n_contexts++] = ctx;
	return ctx;
}
