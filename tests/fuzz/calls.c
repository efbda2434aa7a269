#include "tests/fuzz/calls.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bytes.h"
#include "base/err.h"
#include "capture/format/call.h"
#include "gl_tokens.h"
#include "replay/build/mesh.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/surface/frames.h"
#include "replay/gl/texture/image.h"
#include "replay/index/snapshot.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"
#include "replay/trace/reader.h"
#include "scene/release.h"

#define MAX_FRAMES 8
#define MAX_ITEMS 256
#define MAX_BLOB 16384

static const int64_t EXTREME_INTS[] = { -1,      INT32_MAX,  INT32_MIN, 0x7FFF, 0x8000, 0xFFFF,
	                                0x10000, UINT32_MAX, 0x1000000, 4096,   2048,   1024,
	                                100,     INT64_MAX,  INT64_MIN, -100 };
static const float EXTREME_FLOATS[] = { NAN, INFINITY, -INFINITY, 3.4e38f, -3.4e38f, 1e-40f, -0.0f, 16777217.0f };
static const uint32_t BLOB_SIZES[] = { 0, 1, 3, 16, 64, 256, 1024, MAX_BLOB };

static const char *const LIKELY[] = { "glBegin",      "glVertex2f", "glVertex3f",   "glVertex3f",    "glVertex4f",
	                              "glEnd",        "glRectf",    "glDrawArrays", "glDrawPixels",  "glBitmap",
	                              "glCopyPixels", "glEnable",   "glTexImage2D", "glColor4f",     "glTexCoord2f",
	                              "glNormal3f",   "glCallList", "glClear",      "glXSwapBuffers" };

unsigned calls_draw(unsigned *state, unsigned n)
{
	*state = *state * 1664525u + 1013904223u;
	return n ? (*state >> 8) % n : 0;
}

static const struct calls_command *command_at(const uint8_t *slot)
{
	unsigned number = slot[0] | (unsigned)slot[1] << 8, low = 0, high = n_calls_commands;

	while (low < high) {
		unsigned middle = (low + high) / 2;
		if (calls_commands[middle].number < number)
			low = middle + 1;
		else
			high = middle;
	}
	return &calls_commands[low % n_calls_commands];
}

static void set_command(uint8_t *slot, const struct calls_command *command)
{
	slot[0] = (uint8_t)command->number;
	slot[1] = (uint8_t)(command->number >> 8);
}

void calls_settle(uint8_t *slot)
{
	set_command(slot, command_at(slot));
}

size_t calls_used(const uint8_t *slot)
{
	return 2 + 2 * strlen(command_at(slot)->letters);
}

void calls_invent(unsigned *state, uint8_t *slot, const uint8_t *near)
{
	const char *likely = LIKELY[calls_draw(state, sizeof(LIKELY) / sizeof(LIKELY[0]))];
	unsigned i = 0;

	for (size_t k = 0; k < CALLS_SLOT; k++)
		slot[k] = (uint8_t)calls_draw(state, 256);
	switch (calls_draw(state, 4)) {
	case 0:
		calls_settle(slot);
		return;
	case 1:
		i = calls_draw(state, n_calls_commands);
		while (near && calls_commands[i].chapter != command_at(near)->chapter)
			i = (i + 1) % n_calls_commands;
		break;
	default:
		while (i + 1 < n_calls_commands && strcmp(calls_commands[i].name, likely) != 0)
			i++;
	}
	set_command(slot, &calls_commands[i]);
}

/* The data that the calls' values point to, and the receiver of the calls. */
struct calls {
	int (*take)(void *user, const struct call *call); /* returns nonzero to stop */
	void *user;
	struct trace_value args[CALLS_MAX_PARAMS], items[CALLS_MAX_PARAMS][MAX_ITEMS];
	uint8_t blob[CALLS_MAX_PARAMS][MAX_BLOB];
	struct call_sig sig;
	struct call call; /* as from a reader, valid until the next one */
};

static const struct trace_values_sig NAMELESS = { 0 }; /* for enums and bitmasks */

static int64_t int_of(uint32_t v)
{
	uint32_t how = v >> 8;

	if (how < 128)
		return v & 7;
	if (how < 208)
		return v & 255;
	/* Include some sizes of pictures that are not so large that all time goes into filling them. */
	return how < 232 ? EXTREME_INTS[v % (sizeof(EXTREME_INTS) / sizeof(EXTREME_INTS[0]))] : (int16_t)(v << 4) / 8;
}

static float float_of(uint32_t v)
{
	uint32_t how = v >> 8;

	if (how < 224)
		return (float)(int8_t)v * (how < 96 ? 0.25f : how < 192 ? 1.0f / 64.0f : 16.0f);
	return how < 240 ? EXTREME_FLOATS[v % (sizeof(EXTREME_FLOATS) / sizeof(EXTREME_FLOATS[0]))] : (float)(int16_t)(v << 4);
}

static uint32_t token_of(uint32_t v, const struct calls_group *group)
{
	return v < 0xF800 ? group->values[v % group->n] : calls_groups[0].values[v % calls_groups[0].n];
}

/* For a parameter that may be a token, some numbers are tokens. */
static int is_token(char letter, uint32_t v, const struct calls_group *group)
{
	return letter != 'e' && letter != 'm' && group != calls_groups && v >> 8 >= 192 && v >> 8 < 224;
}

static struct trace_value scalar_of(char letter, uint32_t v, const struct calls_group *group)
{
	int64_t i;

	if (is_token(letter, v, group))
		return letter == 'f' || letter == 'd' ?
		               (struct trace_value){ .type = TRACE_FLOAT, .f = (float)token_of(v, group) } :
		               (struct trace_value){ .type = TRACE_ENUM, .sig = &NAMELESS, .i = token_of(v, group) };
	switch (letter) {
	case 'e':
		return (struct trace_value){ .type = TRACE_ENUM, .sig = &NAMELESS, .i = token_of(v, group) };
	case 'm':
		return (struct trace_value){ .type = TRACE_BITMASK,
			                     .sig = &NAMELESS,
			                     .u = token_of(v, group) | (v & 1 ? token_of(v >> 1, group) : 0) };
	case 'f':
		return (struct trace_value){ .type = TRACE_FLOAT, .f = float_of(v) };
	case 'd':
		return (struct trace_value){ .type = TRACE_DOUBLE, .d = float_of(v) };
	case 'u':
		return (struct trace_value){ .type = TRACE_UINT, .u = (uint32_t)int_of(v) };
	default:
		i = int_of(v);
		return i < 0 ? (struct trace_value){ .type = TRACE_SINT, .i = i } :
		               (struct trace_value){ .type = TRACE_UINT, .u = (uint64_t)i };
	}
}

static struct trace_value array_of(struct calls *c, unsigned i, char letter, uint32_t v,
                                   const struct calls_group *group)
{
	uint32_t random = v, n = v >> 8 < 224 ? 1 + (v >> 8) % 16 : v % MAX_ITEMS;

	for (uint32_t k = 0; k < n; k++)
		c->items[i][k] = scalar_of(letter, k ? calls_draw(&random, 65536) : is_token(letter, v, group) ? v : v & 255, group);
	return (struct trace_value){ .type = TRACE_ARRAY, .count = n, .items = c->items[i] };
}

static struct trace_value blob_of(struct calls *c, unsigned i, uint32_t v)
{
	uint32_t random = v, n = BLOB_SIZES[v % 8], how = v >> 8;

	if (how < 64)
		return (struct trace_value){ .type = how < 32 ? TRACE_NULL : TRACE_OPAQUE, .u = how < 32 ? 0 : v & 255 };
	for (uint32_t k = 0; k < n; k++)
		c->blob[i][k] = how < 96 ? (uint8_t)how : (uint8_t)calls_draw(&random, 65536);
	return (struct trace_value){ .type = TRACE_BLOB, .count = n, .blob = c->blob[i] };
}

static struct trace_value value_of(struct calls *c, unsigned i, char letter, uint32_t v,
                                   const struct calls_group *group)
{
	if (v >> 8 == 255) /* values that a recorder would not write */
		return (struct trace_value){ .type = v & 1 ? TRACE_NULL : TRACE_NONE };
	switch (letter) {
	case 'b':
		return blob_of(c, i, v);
	case 's':
		return (struct trace_value){ .type = TRACE_STRING, .count = 1, .str = "x" };
	case 'p':
		return (struct trace_value){ .type = v & 3 ? TRACE_OPAQUE : TRACE_NULL, .u = (v & 3) << 4 };
	case 'E':
	case 'I':
	case 'F':
	case 'D':
		return array_of(c, i, (char)(letter + 'a' - 'A'), v, group);
	default:
		return scalar_of(letter, v, group);
	}
}

/* Assembly programs, valid and broken. Random bytes would hardly ever be one. */
static struct trace_value program_of(uint32_t v)
{
	static const char *const texts[] = {
		"!!ARBvp1.0 PARAM p[] = { program.env[0..255] }; ADDRESS A; ARL A.x, vertex.attrib[1].x; MOV "
		"result.color, p[A.x + 4095]; MOV result.position, p[A.x - 4096]; END",
		"!!ARBvp1.0 OPTION ARB_position_invariant; MOV result.color, vertex.attrib[15]; MOV "
		"result.pointsize.x, state.point.size; END",
		"!!ARBvp1.0 PARAM m[4] = { state.matrix.program[7].invtrans }; MAD result.position, m[0], "
		"vertex.texcoord[7], state.lightprod[7].back.specular; END",
		"!!ARBvp1.0 PARAM p[] = { }; END",
		"!!ARBvp1.0",
		"!!ARBvp1.0 TEMP a; ADDRESS A; MOV a, p[A.x]; END",
		"!!ARBfp1.0 OPTION ARB_fog_exp2; TEX result.color, fragment.texcoord[7], texture[7], SHADOWRECT; KIL "
		"fragment.position; END",
		"!!ARBfp1.0 MUL result.color, state.light[7].diffuse, state.texenv[7].color; MOV result.depth, "
		"program.local[255]; END",
	};
	const char *text = texts[v % (sizeof(texts) / sizeof(texts[0]))];

	return (struct trace_value){ .type = TRACE_STRING, .count = strlen(text), .str = text };
}

static int play(struct calls *c, uint64_t number, const uint8_t *slot)
{
	const struct calls_command *command = command_at(slot);
	uint32_t n = 0;

	for (; command->letters[n]; n++)
		c->args[n] = value_of(c, n, command->letters[n], (uint32_t)(slot[2 + 2 * n] | slot[3 + 2 * n] << 8),
		                      &calls_groups[command->group[n]]);
	if (strcmp(command->name, "glProgramStringARB") == 0)
		c->args[3] = program_of((uint32_t)(slot[8] | slot[9] << 8));
	c->sig = (struct call_sig){ .name = command->name, .command = gls_command_find(command->name), .n_args = n };
	c->call = (struct call){ .number = number, .sig = &c->sig, .args = c->args, .n_args = n,
		                 .ret = { .type = TRACE_OPAQUE, .u = (uint64_t)(slot[CALLS_SLOT - 1] & 3) << 4 } };
	return c->take(c->user, &c->call);
}

static int call(struct calls *c, const char *name, struct trace_value ret, uint32_t n, const struct trace_value *args)
{
	memcpy(c->args, args, n * sizeof(*args));
	c->sig = (struct call_sig){ .name = name, .command = gls_command_find(name), .n_args = n };
	c->call = (struct call){ .sig = &c->sig, .args = c->args, .n_args = n, .ret = ret };
	return c->take(c->user, &c->call);
}

static const struct trace_value NONE = { .type = TRACE_NONE }, ZERO = { .type = TRACE_NULL },
                                CONTEXT = { .type = TRACE_OPAQUE, .u = 0x10 }, WINDOW = { .type = TRACE_UINT, .u = 7 },
                                SIZE = { .type = TRACE_UINT, .u = 64 };

static int make_current(struct calls *c)
{
	return call(c, "glXCreateContext", CONTEXT, 4, (struct trace_value[]){ CONTEXT, ZERO, ZERO, WINDOW }) ||
	       call(c, "glXMakeCurrent", NONE, 3, (struct trace_value[]){ CONTEXT, WINDOW, CONTEXT }) ||
	       call(c, "glViewport", NONE, 4, (struct trace_value[]){ ZERO, ZERO, SIZE, SIZE }) ||
	       call(c, "glScissor", NONE, 4, (struct trace_value[]){ ZERO, ZERO, SIZE, SIZE });
}

static int swap(struct calls *c)
{
	return call(c, "glXSwapBuffers", NONE, 2, (struct trace_value[]){ CONTEXT, WINDOW });
}

/* Blobs of a snapshot, in order. A blob of zeros, such as a texture that nobody filled, takes no memory. */
struct blob {
	struct blob *next;
	uint64_t name[2];
	size_t n;
	int zeros;
	uint8_t data[];
};

static int put(void *user, const uint64_t name[2], const void *data, size_t n)
{
	const uint8_t *bytes = data;
	int zeros = n > 0 && bytes[0] == 0 && memcmp(bytes, bytes + 1, n - 1) == 0;
	struct blob **first = user, *blob = malloc(sizeof(*blob) + (zeros ? 0 : n));

	if (!blob)
		return ERR_SYSTEM;
	*blob = (struct blob){ .next = *first, .name = { name[0], name[1] }, .n = n, .zeros = zeros };
	if (!zeros)
		memcpy(blob->data, data, n);
	*first = blob;
	return 0;
}

static uint8_t *get(void *user, const uint64_t name[2], size_t n)
{
	for (struct blob *blob = *(struct blob **)user; blob; blob = blob->next)
		if (blob->name[0] == name[0] && blob->name[1] == name[1] && blob->n == n) {
			uint8_t *copy = calloc(n ? n : 1, 1);
			return copy && !blob->zeros ? memcpy(copy, blob->data, n) : copy;
		}
	return NULL;
}

/* Save, load and save again. @return 0: the same bytes, or a state that cannot be saved; 1: different bytes, which
 * is reported */
static int check_saved(struct gls_exec *x,
                       int (*save)(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out))
{
	struct blob *kept = NULL;
	struct snapshot_blobs blobs = { .put = put, .get = get, .user = &kept };
	struct bytes saved = { 0 }, again = { 0 };
	struct gls_exec *other = NULL;
	int differ = 0;

	if (!save(x, &blobs, &saved)) {
		differ = gls_exec_create(&other, "calls") || snapshot_load(other, &blobs, saved.data, saved.n) ||
		         save(other, &blobs, &again) || again.n != saved.n || memcmp(again.data, saved.data, saved.n) != 0;
		for (size_t at = 0; differ && at < saved.n && at < again.n; at++)
			if (saved.data[at] != again.data[at]) {
				fprintf(stderr, "a snapshot that was loaded differs from what was saved: %s\n", snapshot_place(x, at));
				break;
			}
	}
	gls_exec_destroy(&other);
	free(saved.data);
	free(again.data);
	while (kept) {
		struct blob *next = kept->next;
		free(kept);
		kept = next;
	}
	return differ;
}

int calls_check_snapshot(struct gls_exec *x)
{
	return check_saved(x, snapshot_save) || (gls_frame_settle(x) && check_saved(x, snapshot_save_pixels));
}

/* Start a frame as replay.c does. */
static void begin_frame(struct gls_exec *x, size_t size, const struct calls_painter *painter)
{
	x->frame_ended = 0;
	x->want = !painter || !painter->skips || size / CALLS_SLOT % 4 || x->frame % 2;
	if (x->want)
		gls_frame_end_deferred(x);
}

/* End a frame likewise. */
static int end_frame(struct gls_exec *x, const struct calls_painter *painter)
{
	struct scene *scene = NULL;

	if (x->want)
		scene = gls_frame_finish(x);
	else
		gls_frame_skip(x);
	if (scene && painter && !x->feedback.rewind)
		painter->paint(painter->user, scene);
	if (scene)
		scene_release(&scene);
	x->frame++;
	gls_mesh_cache_trim(x);
	gls_image_cache_trim(x);
	return x->failed || x->feedback.rewind ? 0 : calls_check_snapshot(x);
}

static void fill_grey(const struct scene *scene, struct scene_picture *p)
{
	size_t n = (size_t)p->width * p->height;

	memset(p->rgba, (int)(scene->n_instances & 255), 4 * n);
	memset(p->stencil, (int)(scene->n_clears & 255), n);
	for (size_t i = 0; i < n; i++)
		p->depth[i] = (uint32_t)i & ((1u << p->depth_bits) - 1);
	for (int i = 0; i < SCENE_SAMPLES && p->samples; i++)
		fill_grey(scene, &p->samples[i]);
}

static int supply_grey(void *user, const struct scene *scene, struct scene_picture *picture)
{
	(void)user;
	fill_grey(scene, picture);
	picture->unknown = scene->needs_previous && !scene->start;
	return 0;
}

static void paint_nothing(void *user, const struct scene *scene)
{
	(void)user;
	(void)scene;
}

const struct calls_painter calls_grey = { .paint = paint_nothing, .supply = supply_grey, .skips = 1 };

/* @return as calls_run */
static int run(struct gls_exec *x, struct calls *c, const uint8_t *data, size_t size,
               const struct calls_painter *painter)
{
	const uint64_t first = x->frame;
	int wrong = 0;

	for (size_t at = 0; at + CALLS_SLOT <= size && x->frame - first < MAX_FRAMES && !wrong; at += CALLS_SLOT) {
		if (play(c, at / CALLS_SLOT, data + at) || x->failed || x->feedback.rewind)
			break;
		if (x->frame_ended) {
			wrong = end_frame(x, painter);
			begin_frame(x, size, painter);
		}
	}
	if (!x->failed && !x->feedback.rewind && !wrong && !swap(c))
		wrong = end_frame(x, painter);
	return wrong;
}

static void begin(struct gls_exec *x, size_t size, const struct calls_painter *painter)
{
	begin_frame(x, size, painter);
	x->feedback.supply = painter ? painter->supply : NULL;
	x->feedback.supply_user = painter ? painter->user : NULL;
}

static int execute(void *x, const struct call *call)
{
	return gls_exec_call(x, call);
}

/* @return NULL if out of memory; release with free() */
static struct calls *create(int (*take)(void *user, const struct call *call), void *user)
{
	struct calls *c = calloc(1, sizeof(*c));

	if (c) {
		c->take = take;
		c->user = user;
	}
	return c;
}

int calls_run(const uint8_t *data, size_t size, const struct calls_painter *painter)
{
	struct gls_exec *x = NULL;
	struct calls *c = gls_exec_create(&x, "calls") ? NULL : create(execute, x);
	int wrong = 0;

	if (c) {
		begin(x, size, painter);
		if (!make_current(c))
			wrong = run(x, c, data, size, painter);
	}
	gls_exec_destroy(&x);
	free(c);
	return wrong;
}

void calls_begin(struct gls_exec *x)
{
	struct calls *c = create(execute, x);

	if (c)
		make_current(c);
	x->call = NULL;
	free(c);
}

void calls_go_on(struct gls_exec *x, const uint8_t *data, size_t size, const struct calls_painter *painter)
{
	struct calls *c = create(execute, x);

	if (c) {
		begin(x, size, painter);
		run(x, c, data, size, painter);
	}
	x->call = NULL;
	free(c);
}

int calls_each(const uint8_t *data, size_t size, int (*take)(void *user, const struct call *call), void *user)
{
	struct calls *c = create(take, user);
	int rc = c ? make_current(c) : ERR_SYSTEM;

	for (size_t at = 0; at + CALLS_SLOT <= size && !rc; at += CALLS_SLOT)
		rc = play(c, at / CALLS_SLOT, data + at);
	if (!rc)
		rc = swap(c);
	if (!rc)
		rc = swap(c);
	free(c);
	return rc;
}
