/*
 * Effects of display lists in skipped frames (replay/gl/geometry/effect.c): state and errors must be the same, to the
 * last bit, as when the list is executed in frames that are built.
 */
#include <math.h>

#include "replay/index/snapshot.h"
#include "tests/gl/gl.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/surface/frames.h"
#include "base/bytes.h"

#define N_LISTS 6
#define N_TEXTURES 4

static int drop(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data, (void)n;
	return 0;
}

/* Two machines that receive the same calls: one builds its frames, the other skips them. */
struct pair {
	struct gl gl[2];
};

static struct pair pair_open(void)
{
	struct pair pair = { { gl_open(), gl_open() } };

	pair.gl[1].x->want = 0;
	return pair;
}

static void both(struct pair *pair, const char *name, const char *letters, ...)
{
	for (unsigned i = 0; i < 2; i++) {
		va_list args;

		va_start(args, letters);
		gl_call_ret(&pair->gl[i], (struct trace_value){ .type = TRACE_NONE }, name, letters, &args);
		va_end(args);
	}
}

static void swap(struct pair *pair)
{
	for (unsigned i = 0; i < 2; i++) {
		struct gl *gl = &pair->gl[i];

		if (gl_state(gl)->begin_mode)
			gl_call(gl, "glEnd", "");
		gl_call(gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
		gl->x->frame_ended = 0;
		if (gl->x->want) {
			struct scene *scene = gls_frame_finish(gl->x);
			scene_release(&scene);
		} else {
			gls_frame_skip(gl->x);
		}
		gl->x->frame++;
	}
}

static void compare(struct pair *pair, const char *what, unsigned number)
{
	const struct snapshot_blobs blobs = { .put = drop };
	struct bytes state[2] = { { .n = 0 }, { .n = 0 } };
	size_t at = 0;

	for (unsigned i = 0; i < 2; i++)
		ck_assert_int_eq(snapshot_save(pair->gl[i].x, &blobs, &state[i]), 0);
	while (at < state[0].n && at < state[1].n && state[0].data[at] == state[1].data[at])
		at++;
	ck_assert_msg(at == state[0].n && at == state[1].n, "%s %u: states differ in %s", what, number,
	              snapshot_place(pair->gl[0].x, at));
	for (unsigned i = 0; i < n_gls_commands; i++) {
		const struct gls_exec *a = pair->gl[0].x, *b = pair->gl[1].x;

		if (a->counts.errors[i] != b->counts.errors[i] || a->counts.unsupported[i] != b->counts.unsupported[i])
			ck_abort_msg("%s %u: %s: %llu and %llu errors, %llu and %llu not done: %s %s", what, number,
			             gls_commands[i].name, (unsigned long long)a->counts.errors[i],
			             (unsigned long long)b->counts.errors[i],
			             (unsigned long long)a->counts.unsupported[i],
			             (unsigned long long)b->counts.unsupported[i], a->counts.why[i], b->counts.why[i]);
	}
	free(state[0].data);
	free(state[1].data);
}

static void pair_close(struct pair *pair)
{
	gl_close(&pair->gl[0]);
	gl_close(&pair->gl[1]);
}

static void letter(struct pair *pair, unsigned texture, double s)
{
	both(pair, "glBindTexture", "eu", GL_TEXTURE_2D, texture);
	both(pair, "glBegin", "e", GL_QUADS);
	for (unsigned i = 0; i < 4; i++) {
		both(pair, "glTexCoord2f", "ff", s, (double)i);
		both(pair, "glVertex2f", "ff", (double)(i & 1), (double)(i >> 1));
	}
	both(pair, "glEnd", "");
}

/* A word of letters, each a list: from the third frame on, only the last texture and texture coordinates remain, and
 * no matrices. */
START_TEST(test_text)
{
	struct pair pair = pair_open();
	const struct gls_list *word;

	for (unsigned i = 1; i <= 3; i++) {
		both(&pair, "glBindTexture", "eu", GL_TEXTURE_2D, i);
		both(&pair, "glNewList", "ue", i, GL_COMPILE);
		letter(&pair, i, 0.1 * i);
		both(&pair, "glEndList", "");
	}
	both(&pair, "glNewList", "ue", 9u, GL_COMPILE);
	both(&pair, "glPushMatrix", "");
	for (unsigned i = 0; i < 30; i++) {
		both(&pair, "glTranslatef", "fff", 0.3, 0.0, 0.0);
		both(&pair, "glCallList", "u", 1 + i % 3);
	}
	both(&pair, "glPopMatrix", "");
	both(&pair, "glEndList", "");
	for (unsigned frame = 0; frame < 3; frame++) {
		both(&pair, "glColor3f", "fff", 0.1 * frame, 0.0, 1.0);
		both(&pair, "glCallList", "u", 9u);
		swap(&pair);
		compare(&pair, "text, frame", frame);
	}
	word = table_find(&gl_state(&pair.gl[1])->share->lists, 9);
	ck_assert_uint_eq(word->effect.none, 0);
	ck_assert_uint_eq(word->effect.n, 2);
	word = table_find(&gl_state(&pair.gl[0])->share->lists, 9);
	ck_assert_ptr_null(word->effect.ops);

	/* recompile a letter and delete one; then replace a texture by another object */
	both(&pair, "glNewList", "ue", 3u, GL_COMPILE);
	both(&pair, "glColor3f", "fff", 0.5, 0.5, 0.5);
	both(&pair, "glEndList", "");
	both(&pair, "glCallList", "u", 9u);
	swap(&pair);
	compare(&pair, "a recompiled letter", 0);
	ck_assert_floats(3, gl_state(&pair.gl[1])->a.current.attribute[GLS_ATTR_COLOR], 0.5, 0.5, 0.5);
	both(&pair, "glDeleteLists", "ui", 3u, 1);
	both(&pair, "glDeleteTextures", "iU", 1, 1, ((const uint32_t[]){ 1 }));
	both(&pair, "glColor3f", "fff", 1.0, 0.0, 0.0);
	both(&pair, "glCallList", "u", 9u);
	swap(&pair);
	compare(&pair, "a texture deleted", 0);
	ck_assert_ptr_nonnull(table_find(&gl_state(&pair.gl[1])->share->textures, 1));
	ck_assert_floats(3, gl_state(&pair.gl[1])->a.current.attribute[GLS_ATTR_COLOR], 1, 0, 0);
	pair_close(&pair);
}
END_TEST

/* A nearly full stack: PushMatrix in the list is an error there, and PopMatrix pops an outer level. */
START_TEST(test_full_stack)
{
	struct pair pair = pair_open();

	both(&pair, "glNewList", "ue", 1u, GL_COMPILE);
	for (unsigned i = 0; i < 2; i++) {
		both(&pair, "glPushMatrix", "");
		both(&pair, "glTranslatef", "fff", 1.0, 0.0, 0.0);
	}
	for (unsigned i = 0; i < 2; i++)
		both(&pair, "glPopMatrix", "");
	both(&pair, "glEndList", "");
	for (unsigned depth = 0; depth < GLS_MAX_MATRICES; depth++) {
		both(&pair, "glCallList", "u", 1u);
		both(&pair, "glPushMatrix", "");
		swap(&pair);
		compare(&pair, "depth", depth);
	}
	ck_assert_uint_eq(gl_error(&pair.gl[1]), GL_STACK_OVERFLOW);
	pair_close(&pair);
}
END_TEST

/* ---- random lists ---- */

static unsigned draw(unsigned *state, unsigned n)
{
	*state = *state * 1664525u + 1013904223u;
	return (*state >> 16) % n;
}

/* Lists call only those with higher numbers: if two called each other, the calls would double at each of 64 levels. */
static void random_call(struct pair *pair, unsigned *state, unsigned list)
{
	const float light[4] = { 1, (float)draw(state, 4), 3, 1 }, red[4] = { 1, 0, (float)draw(state, 3) * 0.5f, 1 };
	const unsigned called = list + 1 + draw(state, N_LISTS);
	const uint8_t names[2] = { (uint8_t)called, (uint8_t)(called + 1) };

	switch (draw(state, 40)) {
	case 0: case 1: case 2: case 3:
		both(pair, "glTranslatef", "fff", 0.25 * draw(state, 9), 1.0, 0.0);
		break;
	case 4: case 5:
		both(pair, "glRotatef", "ffff", 10.0 * draw(state, 9), 1.0, 2.0, 0.5);
		break;
	case 6:
		both(pair, "glScalef", "fff", 0.5, 1.0 + draw(state, 2), 1.0);
		break;
	case 7:
		both(pair, "glLoadIdentity", "");
		break;
	case 8: case 9: case 10: case 11:
		both(pair, "glPushMatrix", "");
		break;
	case 12: case 13: case 14: case 15:
		both(pair, "glPopMatrix", "");
		break;
	case 16: case 17: case 18: case 19:
		letter(pair, draw(state, N_TEXTURES + 2), 0.1 * draw(state, 9));
		break;
	case 20: case 21:
		both(pair, "glBindTexture", "eu", draw(state, 3) ? GL_TEXTURE_2D : GL_TEXTURE_1D, draw(state, N_TEXTURES + 2));
		break;
	case 22: case 23: case 24: case 25:
		both(pair, "glCallList", "u", called);
		break;
	case 26:
		both(pair, "glCallLists", "ieb", 2, GL_UNSIGNED_BYTE, sizeof(names), (const void *)names);
		break;
	case 27:
		both(pair, draw(state, 2) ? "glEnable" : "glDisable", "e", draw(state, 2) ? GL_COLOR_MATERIAL : GL_LIGHTING);
		break;
	case 28:
		both(pair, "glLightfv", "eeF", GL_LIGHT0, GL_POSITION, 4, light);
		break;
	case 29:
		both(pair, "glMaterialfv", "eeF", GL_FRONT, GL_DIFFUSE, 4, red);
		break;
	case 30: case 31:
		both(pair, "glColor3f", "fff", 0.1 * draw(state, 9), 0.0, 1.0);
		break;
	case 32:
		both(pair, "glPushAttrib", "m", draw(state, 2) ? GL_ALL_ATTRIB_BITS : GL_CURRENT_BIT);
		break;
	case 33:
		both(pair, "glPopAttrib", "");
		break;
	case 34:
		both(pair, "glMatrixMode", "e", draw(state, 3) ? GL_MODELVIEW : GL_TEXTURE);
		break;
	case 35:
		both(pair, "glRasterPos2f", "ff", 0.1 * draw(state, 4), 0.0);
		break;
	case 36:
		both(pair, "glActiveTexture", "e", GL_TEXTURE0 + draw(state, 2));
		break;
	case 37:
		both(pair, "glNormal3f", "fff", 0.0, 0.0, (double)draw(state, 3));
		break;
	case 38:
		if (draw(state, 4) == 0)
			both(pair, draw(state, 2) ? "glBegin" : "glEdgeFlag", "u", draw(state, 2));
		break;
	default:
		if (draw(state, 3) == 0)
			both(pair, "glEnd", "");
	}
}

/* Reset matrix stacks, edge flags and primitives left open by lists, which would impede all later calls. */
static void tidy(struct pair *pair, unsigned *state)
{
	const uint32_t texture = 1 + draw(state, N_TEXTURES);

	if (gl_state(&pair->gl[0])->begin_mode)
		both(pair, "glEnd", "");
	both(pair, "glMatrixMode", "e", GL_MODELVIEW);
	while (gl_state(&pair->gl[0])->modelview.depth > 20)
		both(pair, "glPopMatrix", "");
	if (draw(state, 2))
		both(pair, "glEdgeFlag", "i", 1);
	if (draw(state, 4) == 0)
		both(pair, "glDeleteTextures", "iU", 1, 1, &texture);
	if (draw(state, 4) == 0)
		both(pair, "glDeleteLists", "ui", 1 + draw(state, N_LISTS), 1);
}

START_TEST(test_random)
{
	unsigned state = 77u, made = 0;

	for (unsigned run = 0; run < 40; run++) {
		struct pair pair = pair_open();

		for (unsigned frame = 0; frame < 20; frame++) {
			for (unsigned i = draw(&state, 4); i > 0; i--) {
				const unsigned list = 1 + draw(&state, N_LISTS);

				both(&pair, "glNewList", "ue", list, draw(&state, 4) ? GL_COMPILE : GL_COMPILE_AND_EXECUTE);
				for (unsigned k = draw(&state, 20); k > 0; k--)
					random_call(&pair, &state, list);
				if (gl_state(&pair.gl[0])->begin_mode)
					both(&pair, "glEnd", "");
				both(&pair, "glEndList", "");
				tidy(&pair, &state);
			}
			for (unsigned i = 0; i < 6; i++)
				both(&pair, "glCallList", "u", 1 + draw(&state, N_LISTS));
			tidy(&pair, &state);
			swap(&pair);
			compare(&pair, "random lists, run", run);
		}
		for (uint64_t name = 1; name <= N_LISTS; name++) {
			const struct gls_list *list = table_find(&gl_state(&pair.gl[1])->share->lists, name);
			made += list && list->effect.ops && list->effect.n < list->n;
		}
		pair_close(&pair);
	}
	ck_assert_uint_gt(made, 10);
}
END_TEST

/* Lists that call lists a hundred times each, nine deep, with almost no contents: their effect is soon given up. */
START_TEST(test_lists_without_end)
{
	struct pair pair = pair_open();

	for (unsigned list = 1; list < 10; list++) {
		both(&pair, "glNewList", "ue", list, GL_COMPILE);
		for (unsigned i = 0; i < 100 && list > 1; i++)
			both(&pair, "glCallList", "u", list - 1);
		both(&pair, "glEndList", "");
	}
	for (unsigned i = 0; i < 3; i++)
		gl_call(&pair.gl[1], "glCallList", "u", 9u);
	gl_close(&pair.gl[0]);
	gl_close(&pair.gl[1]);
}
END_TEST

GL_TESTS("effect", test_lists_without_end, test_text, test_full_stack, test_random)
