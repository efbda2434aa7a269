/*
 * EXT_direct_state_access: commands that name the object they change, instead of using the bound or selected one. Each
 * selects the object, runs the command that it is named after, and restores the selection. Mapping of buffers by name
 * is not supported, because the recorder does not track it.
 */
#include <stdio.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"

#define MAX_ARGS 16u

/* The command that a command is named after: the first matching prefix is replaced, the rest is kept without EXT. */
static int32_t namesake_of(const char *name)
{
	static const char *const beginnings[][2] = {
		{ "glMatrixLoadIdentity", "glLoadIdentity" },
		{ "glMatrixLoadTranspose", "glLoadTransposeMatrix" },
		{ "glMatrixMultTranspose", "glMultTransposeMatrix" }, { "glMatrixLoad", "glLoadMatrix" },
		{ "glMatrixMult", "glMultMatrix" }, { "glMatrixPush", "glPushMatrix" }, { "glMatrixPop", "glPopMatrix" },
		{ "glMatrix", "gl" }, { "glBindMultiTexture", "glBindTexture" }, { "glGenerateTexture", "glGenerate" },
		{ "glGenerateMultiTex", "glGenerate" }, { "glCopyMultiTex", "glCopyTex" }, { "glCopyTexture", "glCopyTex" },
		{ "glCompressedMultiTex", "glCompressedTex" }, { "glCompressedTexture", "glCompressedTex" },
		{ "glMultiTex", "glTex" }, { "glTexture", "glTex" }, { "glProgramUniform", "glUniform" }, { "glNamed", "gl" },
	};
	const size_t n = strlen(name), rest = n > 3 && strcmp(name + n - 3, "EXT") == 0 ? n - 3 : n;
	char text[64];

	for (size_t i = 0; i < sizeof(beginnings) / sizeof(beginnings[0]); i++) {
		const size_t length = strlen(beginnings[i][0]);

		if (strncmp(name, beginnings[i][0], length) != 0)
			continue;
		snprintf(text, sizeof(text), "%s%.*s%s", beginnings[i][1], (int)(rest - length), name + length,
		         strncmp(name, "glNamedProgram", 14) == 0 ? "ARB" : "");
		return gls_command_find(text);
	}
	return -1;
}

static void run(struct gls_exec *x, const struct call *c, const char *name, const struct trace_value *args, uint32_t n)
{
	const int32_t command = name ? gls_command_find(name) : namesake_of(gls_commands[x->command].name);
	const uint32_t own = x->command;
	struct call inner = *c;

	inner.args = args;
	inner.n_args = n;
	x->dispatch(x, &inner, (uint32_t)command, x->unpack);
	x->command = own;
}

static void run_with(struct gls_exec *x, const struct call *c, const char *name, uint32_t a, uint32_t b)
{
	const struct trace_value args[2] = { { .type = TRACE_UINT, .u = a }, { .type = TRACE_UINT, .u = b } };

	run(x, c, name, args, 2);
}

/* Run without the first argument, which named the object. */
static void run_rest(struct gls_exec *x, const struct call *c)
{
	run(x, c, NULL, c->args + 1, c->n_args - 1);
}

/* Run with a target in place of the name. */
static void run_on(struct gls_exec *x, const struct call *c, uint32_t target)
{
	struct trace_value args[MAX_ARGS];
	const uint32_t n = c->n_args < MAX_ARGS ? c->n_args : MAX_ARGS;

	memcpy(args, c->args, n * sizeof(*args));
	args[0] = (struct trace_value){ .type = TRACE_ENUM, .u = target };
	run(x, c, NULL, args, n);
}

/* ---- matrices: a mode, or the matrix of a texture unit ---- */

static void on_matrix(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	const uint32_t mode = st->a.transform.matrix_mode, active = st->a.texturing.active, unit = arg_u(c, 0) - GL_TEXTURE0;

	if (unit < GLS_MAX_UNITS)
		st->a.texturing.active = unit;
	run_with(x, c, "glMatrixMode", unit < GLS_MAX_UNITS ? GL_TEXTURE : arg_u(c, 0), 0);
	run_rest(x, c);
	st->a.transform.matrix_mode = mode;
	st->a.texturing.active = active;
}

GLS_FAMILY(glMatrixLoadEXT, STATE) { on_matrix(x, st, c); }
GLS_FAMILY(glMatrixMultEXT, STATE) { on_matrix(x, st, c); }
GLS_FAMILY(glMatrixLoadTransposeEXT, STATE) { on_matrix(x, st, c); }
GLS_FAMILY(glMatrixMultTransposeEXT, STATE) { on_matrix(x, st, c); }
GLS_FAMILY(glMatrixRotateEXT, STATE) { on_matrix(x, st, c); }
GLS_FAMILY(glMatrixScaleEXT, STATE) { on_matrix(x, st, c); }
GLS_FAMILY(glMatrixTranslateEXT, STATE) { on_matrix(x, st, c); }
GLS_HANDLER(glMatrixLoadIdentityEXT, STATE) { on_matrix(x, st, c); }
GLS_HANDLER(glMatrixFrustumEXT, STATE) { on_matrix(x, st, c); }
GLS_HANDLER(glMatrixOrthoEXT, STATE) { on_matrix(x, st, c); }
GLS_HANDLER(glMatrixPushEXT, STATE) { on_matrix(x, st, c); }
GLS_HANDLER(glMatrixPopEXT, STATE) { on_matrix(x, st, c); }

/* ---- textures, by name and target ---- */

static void on_texture(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	unsigned face;
	const int target = gls_texture_target_of(arg_u(c, 1), &face);
	struct gls_unit *unit = &st->a.texturing.units[st->a.texturing.active];
	const uint32_t bound = target < 0 ? 0 : unit->bound[target];

	if (target >= 0)
		run_with(x, c, "glBindTexture", gls_texture_token((uint32_t)target), arg_u(c, 0));
	/* otherwise the texture has another target, and the error has been raised */
	if (target < 0 || unit->bound[target] == arg_u(c, 0))
		run_rest(x, c);
	if (target >= 0)
		unit->bound[target] = bound;
	st->dirty |= GLS_DIRTY_ALL;
}

GLS_FAMILY(glTextureParameterEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glTextureImageEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glTextureSubImageEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glTextureStorageEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glCopyTextureImageEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glCopyTextureSubImageEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glCompressedTextureImageEXT, STATE) { on_texture(x, st, c); }
GLS_FAMILY(glCompressedTextureSubImageEXT, STATE) { on_texture(x, st, c); }
GLS_HANDLER(glGenerateTextureMipmapEXT, STATE) { on_texture(x, st, c); }

/* ---- texture units ---- */

static void on_unit(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	const uint32_t active = st->a.texturing.active, unit = arg_u(c, 0) - GL_TEXTURE0;

	run_with(x, c, "glActiveTexture", arg_u(c, 0), 0);
	if (st->a.texturing.active == unit)
		run_rest(x, c);
	st->a.texturing.active = active;
	st->dirty |= GLS_DIRTY_ALL;
}

GLS_HANDLER(glBindMultiTextureEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glMultiTexEnvEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glMultiTexGenEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glMultiTexParameterEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glMultiTexImageEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glMultiTexSubImageEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glCopyMultiTexImageEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glCopyMultiTexSubImageEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glCompressedMultiTexImageEXT, STATE) { on_unit(x, st, c); }
GLS_FAMILY(glCompressedMultiTexSubImageEXT, STATE) { on_unit(x, st, c); }
GLS_HANDLER(glGenerateMultiTexMipmapEXT, STATE) { on_unit(x, st, c); }

/* glEnableIndexedEXT and glDisableIndexedEXT of a unit's capability: the second argument is the unit. */
static void switch_unit(struct gls_exec *x, struct gls_state *st, const struct call *c, const char *name)
{
	const uint32_t active = st->a.texturing.active, unit = arg_u(c, 1);

	if (unit < GLS_MAX_UNITS)
		st->a.texturing.active = unit;
	else
		gls_unsupported(x, "texture units beyond the eighth");
	if (unit < GLS_MAX_UNITS)
		run(x, c, name, c->args, 1);
	st->a.texturing.active = active;
}

GLS_HANDLER(glEnableIndexedEXT, STATE) { switch_unit(x, st, c, "glEnable"); }
GLS_HANDLER(glDisableIndexedEXT, STATE) { switch_unit(x, st, c, "glDisable"); }

/* ---- buffers, renderbuffers, framebuffer objects: through a target that draws do not use ---- */

static void on_bound(struct gls_exec *x, const struct call *c, const char *bind, uint32_t target, uint32_t bound)
{
	run_with(x, c, bind, target, arg_u(c, 0));
	run_on(x, c, target);
	run_with(x, c, bind, target, bound);
}

static void on_buffer(struct gls_exec *x, const struct gls_state *st, const struct call *c)
{
	on_bound(x, c, "glBindBuffer", GL_COPY_WRITE_BUFFER, st->client.copy_write_buffer);
}

GLS_HANDLER(glNamedBufferDataEXT, CLIENT) { on_buffer(x, st, c); }
GLS_HANDLER(glNamedBufferSubDataEXT, CLIENT) { on_buffer(x, st, c); }
GLS_HANDLER(glNamedBufferStorageEXT, CLIENT) { on_buffer(x, st, c); }

/* ---- programs ---- */

static void on_program(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	const uint32_t target = arg_u(c, 1), bound = target == GL_VERTEX_PROGRAM_ARB ? st->arb_vertex : st->arb_fragment;

	run_with(x, c, "glBindProgramARB", target, arg_u(c, 0));
	run_rest(x, c);
	run_with(x, c, "glBindProgramARB", target, bound);
}

GLS_HANDLER(glNamedProgramStringEXT, OBJECT) { on_program(x, st, c); }
GLS_FAMILY(glNamedProgramLocalParameterEXT, STATE) { on_program(x, st, c); }

static void on_uniform(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	const uint32_t used = st->program;

	st->program = arg_u(c, 0);
	run_rest(x, c);
	st->program = used;
	st->dirty |= GLS_DIRTY_ALL;
}

GLS_FAMILY(glProgramUniform, STATE) { on_uniform(x, st, c); }
GLS_FAMILY(glProgramUniformEXT, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix2fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix3fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix4fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix2x3fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix3x2fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix2x4fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix4x2fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix3x4fv, STATE) { on_uniform(x, st, c); }
GLS_HANDLER(glProgramUniformMatrix4x3fv, STATE) { on_uniform(x, st, c); }

static void on_renderbuffer(struct gls_exec *x, const struct gls_state *st, const struct call *c)
{
	on_bound(x, c, "glBindRenderbuffer", GL_RENDERBUFFER, st->renderbuffer);
}

GLS_HANDLER(glNamedRenderbufferStorageEXT, OBJECT) { on_renderbuffer(x, st, c); }
GLS_HANDLER(glNamedRenderbufferStorageMultisampleEXT, OBJECT) { on_renderbuffer(x, st, c); }

static void on_framebuffer(struct gls_exec *x, const struct gls_state *st, const struct call *c)
{
	on_bound(x, c, "glBindFramebuffer", GL_READ_FRAMEBUFFER, st->read_framebuffer);
}

GLS_HANDLER(glNamedFramebufferTexture1DEXT, OBJECT) { on_framebuffer(x, st, c); }
GLS_HANDLER(glNamedFramebufferTexture2DEXT, OBJECT) { on_framebuffer(x, st, c); }
GLS_HANDLER(glNamedFramebufferTexture3DEXT, OBJECT) { on_framebuffer(x, st, c); }
GLS_HANDLER(glNamedFramebufferRenderbufferEXT, OBJECT) { on_framebuffer(x, st, c); }
