/*
 * make_seeds index TRACE FILE: input of fuzz_index.c, an index of the trace with a checkpoint at each frame. make_seeds
 * snapshot FOLDER: inputs of fuzz_snapshot.c, states reached by some of the kept sequences of calls. make_seeds traces
 * FOLDER: the kept sequences of calls as recordings. make_seeds programs FOLDER: recordings that show a drawn texture
 * through each kept shader and assembly program. make_seeds tree FILE: input of fuzz_tree.c, a tree of 64 triangles.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "gl_tokens.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/surface/frames.h"
#include "replay/glsl/translate.h"
#include "replay/index/index_file.h"
#include "replay/index/snapshot.h"
#include "replay/trace/trace_out.h"
#include "tests/fuzz/calls.h"
#include "tests/fuzz/snapshot.h"
#include "tracer/accel/tree.h"

#define KEPT "tests/fuzz/kept_"
#define LIKE "tests/golden/two_triangles.trace" /* traces take its properties */
#define LARGEST 65536
#define EVERY 24 /* uses one kept sequence in this many */
#define MOST_CHECKPOINTS 3
#define MOST_SIGS 2048

static void must(int good, const char *what)
{
	if (good)
		return;
	perror(what);
	exit(1);
}

static void write_file(const char *path, const struct bytes *b)
{
	FILE *out = fopen(path, "wb");

	must(out && !b->failed && fwrite(b->data, 1, b->n, out) == b->n && fclose(out) == 0, path);
}

/* --- An index ---------------------------------------------------------------------------------------------------- */

struct made {
	struct bytes blobs, list; /* list: of struct index_blob */
	uint64_t n;
};

static int put_blob(void *user, const uint64_t name[2], const void *data, size_t n)
{
	struct made *made = user;
	struct index_blob blob = { { name[0], name[1] }, sizeof(struct index_header) + made->blobs.n, n };

	for (uint64_t i = 0; i < made->n; i++)
		if (memcmp(((struct index_blob *)(void *)made->list.data)[i].name, name, 16) == 0)
			return 0;
	bytes_put(&made->blobs, data, n);
	bytes_put(&made->list, &blob, sizeof(blob));
	made->n++;
	return 0;
}

static void add_checkpoint(struct gls_exec *x, const struct trace_place *place, struct made *made,
                           struct bytes *checkpoints)
{
	const struct snapshot_blobs blobs = { .put = put_blob, .user = made };
	struct index_checkpoint c = { .frame = x->frame, .place = *place };
	struct bytes state = { 0 };

	must(!snapshot_save(x, &blobs, &state), "a snapshot");
	hash_bytes(state.data, state.n, c.name);
	c.bytes = state.n;
	put_blob(made, c.name, state.data, state.n);
	bytes_put(checkpoints, &c, sizeof(c));
	free(state.data);
}

static void put_array(struct bytes *out, const struct bytes *from, size_t size)
{
	bytes_put_u64(out, from->n / size);
	bytes_put(out, from->data, from->n);
}

static void make_index(const char *path, const char *to)
{
	struct made made = { .n = 0 };
	struct bytes frames = { 0 }, checkpoints = { 0 }, toc = { 0 }, all = { 0 };
	const struct index_lack lack = { .name = "glFoo", .why = "a part", .last = 2, .stays = 1 };
	struct trace_reader *r = NULL;
	struct gls_exec *x = NULL;
	const struct call *call;
	struct trace_place place;
	uint8_t *signatures;
	size_t n;
	uint32_t size;

	must(!trace_reader_open(&r, path, gls_command_find) && !gls_exec_create(&x, path), path);
	while (trace_reader_next(r, &call) == 1 && !gls_exec_call(x, call))
		if (x->frame_ended) {
			gls_frame_skip(x);
			x->frame++;
			x->frame_ended = 0;
			must(trace_reader_place(r, &place), "a place");
			bytes_put(&frames, (uint64_t[]){ x->n_calls, place.offset }, 16);
			if (x->frame <= MOST_CHECKPOINTS)
				add_checkpoint(x, &place, &made, &checkpoints);
		}
	must(!trace_reader_signatures(r, &signatures, &n), "signatures");
	bytes_put_u64(&toc, x->n_calls);
	bytes_put_u64(&toc, 0);
	put_array(&toc, &frames, 16);
	put_array(&toc, &checkpoints, sizeof(struct index_checkpoint));
	bytes_put_u64(&toc, 1);
	bytes_put(&toc, &lack, sizeof(lack));
	put_array(&toc, &made.list, sizeof(struct index_blob));
	bytes_put_u64(&toc, n);
	bytes_put(&toc, signatures, n);
	size = (uint32_t)toc.n;
	bytes_put(&all, &size, sizeof(size));
	bytes_put(&all, toc.data, toc.n);
	bytes_put(&all, made.blobs.data, made.blobs.n);
	write_file(to, &all);
}

/* --- Sequences of calls ------------------------------------------------------------------------------------------ */

/* The next kept input. @return its bytes and a zero, valid until the next one; NULL: none */
static const uint8_t *next_kept(FILE *file, uint32_t *size)
{
	static uint8_t input[LARGEST + 1];

	if (fread(size, sizeof(*size), 1, file) != 1)
		return NULL;
	must(*size <= LARGEST && fread(input, 1, *size, file) == *size, KEPT);
	input[*size] = 0;
	return input;
}

static FILE *open_kept(const char *target)
{
	char path[64];
	FILE *file;

	snprintf(path, sizeof(path), KEPT "%s", target);
	file = fopen(path, "rb");
	must(file != NULL, path);
	return file;
}

/* The output, and the signatures of its calls, which trace_out.h identifies by address. */
struct written {
	struct trace_out *out;
	struct call_sig sigs[MOST_SIGS];
	size_t n_sigs;
};

static int write_call(void *user, const struct call *call)
{
	static const char *const names[CALLS_MAX_PARAMS] = { "a", "b", "c", "d", "e", "f", "g", "h",
		                                             "i", "j", "k", "l", "m", "n", "o" };
	struct written *written = user;
	struct call again = *call;
	size_t i = 0;

	while (i < written->n_sigs && strcmp(written->sigs[i].name, call->sig->name) != 0)
		i++;
	if (i == written->n_sigs) {
		must(i < MOST_SIGS, "signatures");
		written->sigs[written->n_sigs++] = (struct call_sig){ .name = call->sig->name,
			                                              .n_args = call->sig->n_args,
			                                              .arg_names = (const char **)(uintptr_t)names };
	}
	again.sig = &written->sigs[i];
	return trace_out_call(written->out, &again);
}

/* A recording of the calls that `say` passes to write_call. */
static void make_trace(const char *folder, const char *target, int number, const uint8_t *input, uint32_t size,
                       int (*say)(struct written *written, const uint8_t *input, uint32_t size))
{
	struct written written = { .n_sigs = 0 };
	struct trace_reader *from = NULL;
	char path[4096];

	snprintf(path, sizeof(path), "%s/%s.%d.trace", folder, target, number);
	must(!trace_reader_open(&from, LIKE, gls_command_find) && !trace_out_open(&written.out, path, LIKE, from) &&
	             !say(&written, input, size) && !trace_out_finish(&written.out, NULL),
	     path);
	trace_reader_close(&from);
}

static void make_traces(const char *folder, const char *target,
                        int (*say)(struct written *written, const uint8_t *input, uint32_t size))
{
	FILE *file = open_kept(target);
	const uint8_t *input;
	uint32_t size;

	for (int i = 0; (input = next_kept(file, &size)); i++)
		make_trace(folder, target, i, input, size, say);
	fclose(file);
}

static int say_calls(struct written *written, const uint8_t *input, uint32_t size)
{
	return calls_each(input, size, write_call, written);
}

/* --- Programs ---------------------------------------------------------------------------------------------------- */

#define U(v) { .type = TRACE_UINT, .u = (uint64_t)(v) }
#define F(v) { .type = TRACE_FLOAT, .f = (v) }
#define P(v) { .type = TRACE_OPAQUE, .u = (v) }
#define NOTHING { .type = TRACE_NULL }
#define SIDE 64

struct said {
	const char *name;
	uint32_t n_args;
	struct trace_value args[9], ret;
};

static int say(struct written *written, const struct said *said, size_t n)
{
	int rc = 0;

	for (size_t i = 0; i < n && !rc; i++) {
		const struct call_sig sig = { .name = said[i].name, .n_args = said[i].n_args };

		rc = write_call(
			written,
			&(struct call){ .sig = &sig, .n_args = sig.n_args, .args = said[i].args, .ret = said[i].ret });
	}
	return rc;
}

#define SAY(written, said) say(written, said, sizeof(said) / sizeof((said)[0]))

/* A window, and a texture of its size as the draw target. */
static int say_target(struct written *written)
{
	static const struct said said[] = {
		{ "glXCreateContext", 4, { P(16), NOTHING, NOTHING, U(1) }, P(16) },
		{ "glXMakeCurrent", 3, { P(16), U(7), P(16) }, U(1) },
		{ "glViewport", 4, { U(0), U(0), U(SIDE), U(SIDE) }, { 0 } },
		{ "glBindTexture", 2, { U(GL_TEXTURE_2D), U(1) }, { 0 } },
		{ "glTexParameteri", 3, { U(GL_TEXTURE_2D), U(GL_TEXTURE_MIN_FILTER), U(GL_NEAREST) }, { 0 } },
		{ "glTexImage2D",
		  9,
		  { U(GL_TEXTURE_2D), U(0), U(GL_RGBA), U(SIDE), U(SIDE), U(0), U(GL_RGBA), U(GL_UNSIGNED_BYTE),
		    NOTHING },
		  { 0 } },
		{ "glBindFramebuffer", 2, { U(GL_FRAMEBUFFER), U(1) }, { 0 } },
		{ "glFramebufferTexture2D",
		  5,
		  { U(GL_FRAMEBUFFER), U(GL_COLOR_ATTACHMENT0), U(GL_TEXTURE_2D), U(1), U(0) },
		  { 0 } },
		{ "glClear", 1, { U(GL_COLOR_BUFFER_BIT) }, { 0 } },
		{ "glRectf", 4, { F(-0.5f), F(-0.5f), F(0.5f), F(0.5f) }, { 0 } },
		{ "glBindFramebuffer", 2, { U(GL_FRAMEBUFFER), U(0) }, { 0 } },
		{ "glEnable", 1, { U(GL_TEXTURE_2D) }, { 0 } },
	};

	return SAY(written, said);
}

/* Draw the texture over the whole window, twice. */
static int say_shown(struct written *written)
{
	static const struct said said[] = {
		{ "glBegin", 1, { U(GL_QUADS) }, { 0 } },
		{ "glTexCoord2f", 2, { F(0), F(0) }, { 0 } }, { "glVertex2f", 2, { F(-1), F(-1) }, { 0 } },
		{ "glTexCoord2f", 2, { F(1), F(0) }, { 0 } }, { "glVertex2f", 2, { F(1), F(-1) }, { 0 } },
		{ "glTexCoord2f", 2, { F(1), F(1) }, { 0 } }, { "glVertex2f", 2, { F(1), F(1) }, { 0 } },
		{ "glTexCoord2f", 2, { F(0), F(1) }, { 0 } }, { "glVertex2f", 2, { F(-1), F(1) }, { 0 } },
		{ "glEnd", 0, { { 0 } }, { 0 } },
		{ "glXSwapBuffers", 2, { P(16), U(7) }, { 0 } },
	};

	return SAY(written, said) || SAY(written, said);
}

/* in the format of fuzz_glsl.c */
static int say_shader(struct written *written, const uint8_t *input, uint32_t size)
{
	const char *text = size ? (const char *)input + 1 : "";
	const struct trace_value string = { .type = TRACE_STRING, .count = strlen(text), .str = text };
	const struct trace_value texts = { .type = TRACE_ARRAY, .count = 1, .items = &string };
	const int is_vertex = size && (input[0] & 1) == GLSL_VERTEX_STAGE;
	const struct said said[] = {
		{ "glCreateShader", 1, { U(is_vertex ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER) }, U(1) },
		{ "glShaderSource", 4, { U(1), U(1), texts, NOTHING }, { 0 } },
		{ "glCompileShader", 1, { U(1) }, { 0 } },
		{ "glCreateProgram", 0, { { 0 } }, U(2) },
		{ "glAttachShader", 2, { U(2), U(1) }, { 0 } },
		{ "glLinkProgram", 1, { U(2) }, { 0 } },
		{ "glUseProgram", 1, { U(2) }, { 0 } },
	};

	return say_target(written) || SAY(written, said) || say_shown(written);
}

/* in the format of fuzz_arb.c */
static int say_assembly(struct written *written, const uint8_t *input, uint32_t size)
{
	const char *text = size ? (const char *)input + 1 : "";
	const struct trace_value string = { .type = TRACE_STRING, .count = strlen(text), .str = text };
	const unsigned target = size && input[0] & 1 ? GL_VERTEX_PROGRAM_ARB : GL_FRAGMENT_PROGRAM_ARB;
	const struct said said[] = {
		{ "glEnable", 1, { U(target) }, { 0 } },
		{ "glBindProgramARB", 2, { U(target), U(1) }, { 0 } },
		{ "glProgramStringARB", 4, { U(target), U(GL_PROGRAM_FORMAT_ASCII_ARB), U(strlen(text)), string }, { 0 } },
	};

	return say_target(written) || SAY(written, said) || say_shown(written);
}

/* --- Snapshots --------------------------------------------------------------------------------------------------- */

static void put_record(struct bytes *out, const uint64_t name[2], const void *data, size_t n)
{
	uint32_t size = (uint32_t)n;

	bytes_put(out, name, 16);
	bytes_put(out, &size, sizeof(size));
	bytes_put(out, data, n);
}

static int put_behind(void *user, const uint64_t name[2], const void *data, size_t n)
{
	put_record(user, name, data, n);
	return 0;
}

static void make_snapshots(const char *folder)
{
	static const uint64_t none[2] = { 0, 0 }, last[2] = { UINT64_MAX, UINT64_MAX };
	FILE *file = open_kept("calls");
	const uint8_t *calls;
	uint32_t size;

	for (int i = 0; (calls = next_kept(file, &size)); i++) {
		struct bytes state = { 0 }, blobs = { 0 }, all = { 0 };
		const struct snapshot_blobs put = { .put = put_behind, .user = &blobs };
		struct gls_exec *x = NULL;
		char path[4096];

		if (i % EVERY)
			continue;
		must(!gls_exec_create(&x, "seeds"), "a state machine");
		calls_begin(x);
		calls_go_on(x, calls, size / 2 / CALLS_SLOT * CALLS_SLOT, &calls_grey);
		if (!x->failed && !x->feedback.rewind && !snapshot_save(x, &put, &state)) {
			put_record(&all, none, state.data, state.n);
			put_record(&all, last, calls + size / 2 / CALLS_SLOT * CALLS_SLOT, size - size / 2 / CALLS_SLOT * CALLS_SLOT);
			bytes_put(&all, blobs.data, blobs.n);
			snprintf(path, sizeof(path), "%s/%04d", folder, i);
			write_file(path, &all);
		}
		gls_exec_destroy(&x);
		free(state.data);
		free(blobs.data);
		free(all.data);
	}
	fclose(file);
}

/* --- A tree ------------------------------------------------------------------------------------------------------ */

static uint32_t split(struct node2 *nodes, uint32_t *n, uint32_t first, uint32_t count)
{
	const uint32_t at = (*n)++;

	for (uint32_t side = 0; side < 2; side++) {
		uint32_t from = first + side * (count / 2), items = count / 2;

		for (int k = 0; k < 3; k++) {
			nodes[at].lo[side][k] = (float)from;
			nodes[at].hi[side][k] = (float)(from + items);
		}
		nodes[at].count[side] = items <= 2 ? items : 0;
		nodes[at].child[side] = items <= 2 ? from : split(nodes, n, from, items);
	}
	return at;
}

static void make_tree(const char *path)
{
	struct node2 nodes[64] = { 0 };
	uint32_t n = 0, order[64];
	struct bytes all = { 0 };

	split(nodes, &n, 0, 64);
	for (uint32_t i = 0; i < 64; i++)
		order[i] = 63 - i;
	bytes_put(&all, "", 1);
	bytes_put(&all, (uint32_t[]){ n, 64 }, 8);
	bytes_put(&all, nodes, n * sizeof(nodes[0]));
	bytes_put(&all, order, sizeof(order));
	write_file(path, &all);
}

int main(int argc, char **argv)
{
	if (argc == 4 && strcmp(argv[1], "index") == 0)
		make_index(argv[2], argv[3]);
	else if (argc == 3 && strcmp(argv[1], "snapshot") == 0)
		make_snapshots(argv[2]);
	else if (argc == 3 && strcmp(argv[1], "traces") == 0)
		make_traces(argv[2], "calls", say_calls);
	else if (argc == 3 && strcmp(argv[1], "programs") == 0) {
		make_traces(argv[2], "glsl", say_shader);
		make_traces(argv[2], "arb", say_assembly);
	} else if (argc == 3 && strcmp(argv[1], "tree") == 0)
		make_tree(argv[2]);
	else
		return 2;
	return 0;
}
