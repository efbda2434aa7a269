/* Pixels that calls read back (GL 2.1 sec. 3.8.2, 4.2, 4.3): which pixels are requested, and how they are used. */
#include "tests/gl/gl.h"
#include "replay/gl/surface/frames.h"
#include "scene/before.h"

/* A supplier that fills every picture with one colour, and records the requests. */
struct painter {
	uint8_t color[4];
	uint32_t unknown, asked, n_instances, had_start;
};

static int paint(void *user, const struct scene *scene, struct scene_picture *picture)
{
	struct painter *p = user;

	p->asked++;
	p->n_instances = scene->n_instances;
	p->had_start = scene->start != NULL;
	for (size_t i = 0; i < (size_t)scene->width * scene->height; i++) {
		memcpy(picture->rgba + 4 * i, p->color, 4);
		picture->depth[i] = 1 << 23;
		picture->stencil[i] = 7;
	}
	picture->unknown = scene->start ? 0 : p->unknown;
	return 0;
}

static struct gl open_with(struct painter *p)
{
	struct gl gl = gl_open();

	gl.x->feedback.supply = paint;
	gl.x->feedback.supply_user = p;
	return gl;
}

static void triangle(struct gl *gl)
{
	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 0.0, 1.0);
	gl_call(gl, "glEnd", "");
}

static void textured_triangle(struct gl *gl)
{
	gl_call(gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(gl, "glEnable", "e", GL_TEXTURE_2D);
	triangle(gl);
	gl_call(gl, "glDisable", "e", GL_TEXTURE_2D);
}

/* CopyTexImage2D (sec. 3.8.2): the screen as drawn so far, in the texture's own base format. */
START_TEST(test_copy_tex_image)
{
	struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
	struct gl gl = open_with(&p);
	struct scene *s;

	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	triangle(&gl);
	gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_LUMINANCE, 0, 0, 16, 8, 0);
	ck_assert_uint_eq(p.asked, 1);
	ck_assert_uint_eq(p.n_instances, 1);
	textured_triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_uint_eq(s->textures[0]->width, 16);
	ck_assert_uint_eq(s->textures[0]->height, 8);
	ck_assert_mem_eq(s->textures[0]->texels, ((uint8_t[4]){ 10, 10, 10, 255 }), 4);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/*
 * CopyTexSubImage2D of depth, partly outside the screen: only the part inside changes; equal screens are rendered once.
 */
START_TEST(test_copy_tex_sub_image)
{
	struct painter p = { { 1, 2, 3, 4 }, 0, 0, 0, 0 };
	struct gl gl = open_with(&p);
	float zeros[64] = { 0 }, first, last;
	struct scene *s;

	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 8, 8, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
	        sizeof(zeros), zeros);
	gl_call(&gl, "glCopyTexSubImage2D", "eiiiiiii", GL_TEXTURE_2D, 0, 0, 0, 60, 60, 8, 8);
	gl_call(&gl, "glCopyTexSubImage2D", "eiiiiiii", GL_TEXTURE_2D, 0, 0, 0, 60, 60, 8, 8);
	ck_assert_uint_eq(p.asked, 1);
	textured_triangle(&gl);
	s = gl_swap(&gl);
	memcpy(&first, s->textures[0]->texels, 4);
	memcpy(&last, s->textures[0]->texels + 4 * 63, 4);
	ck_assert_float_eq_tol(first, 8388608.0f / 16777215.0f, 1e-7f);
	ck_assert_float_eq(last, 0);
	gl_call(&gl, "glCopyTexSubImage2D", "eiiiiiii", GL_TEXTURE_2D, 0, 4, 4, 0, 0, 5, 1);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A frame without a clear shows the previous one; a frame that covers everything does not, nor does a cleared one. */
START_TEST(test_previous_frame)
{
	struct painter p = { { 9, 9, 9, 9 }, 5, 0, 0, 0 };
	struct gl gl = open_with(&p);
	struct scene *s;

	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_ptr_null(s->start);
	ck_assert_uint_eq(p.asked, 0);
	scene_release(&s);
	triangle(&gl); /* pixels of the last frame show through */
	s = gl_swap(&gl);
	ck_assert_ptr_nonnull(s->start);
	ck_assert_mem_eq(s->start->rgba, p.color, 4);
	ck_assert_uint_eq(s->start->stencil[0], 7);
	scene_release(&s);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	p.asked = 0;
	s = gl_swap(&gl);
	ck_assert_ptr_null(s->start);
	ck_assert_uint_eq(p.asked, 0);
	scene_release(&s);
	gl_close(&gl);

	p.unknown = 0; /* now everything is covered: no pixel of the last frame is requested */
	gl = open_with(&p);
	for (int i = 0; i < 2; i++) {
		triangle(&gl);
		s = gl_swap(&gl);
		ck_assert_ptr_null(s->start);
		scene_release(&s);
	}
	gl_close(&gl);
}
END_TEST

/* Skipped frames: their drawing is requested only if it shows; then the replay must start again. */
START_TEST(test_skipped_frames)
{
	struct painter p = { { 9, 9, 9, 9 }, 0, 0, 0, 0 };
	struct gl gl = open_with(&p);
	struct scene *s;

	gl.x->want = 0;
	gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 8, 8, 0);
	gl_call(&gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
	gls_frame_skip(gl.x);
	gl.x->want = 1;
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_int_eq(gl.x->feedback.rewind, 0); /* covered */
	scene_release(&s);
	textured_triangle(&gl);
	ck_assert_int_eq(gl.x->feedback.rewind, 1);
	gl_close(&gl);
	p.unknown = 1;
	gl = open_with(&p);
	gls_frame_skip(gl.x);
	triangle(&gl);
	gl_call(&gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
	ck_assert_ptr_null(gls_frame_finish(gl.x));
	ck_assert_int_eq(gl.x->feedback.rewind, 1);
	gl_close(&gl);
}
END_TEST

/* Events of drawables are separate: a swap ends the frame of the swapped drawable. */
START_TEST(test_drawables)
{
	struct gl gl = gl_open();
	struct scene *s;

	triangle(&gl);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 8u, (uint64_t)0x10);
	gl_call(&gl, "glViewport", "iiii", 0, 0, 32, 16);
	triangle(&gl);
	triangle(&gl);
	gl_call(&gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, (uint64_t)0x10);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_draws, 1);
	ck_assert_uint_eq(s->width, 64);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Without a renderer the copy is counted, and the texture is unchanged. */
START_TEST(test_no_supplier)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 8, 8, 0);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	gl_close(&gl);
}
END_TEST

/* A context whose drawable has depth and stencil bits. */
static struct gl open_deep(struct painter *p)
{
	struct gl gl = open_with(p);

	gl_state(&gl)->depth_bits = 24;
	gl_state(&gl)->stencil_bits = 8;
	return gl;
}

#define ALL (GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)

/* Clear (sec. 4.2.3) of all buffers: earlier draws leave the scene, but keep their draw numbers. */
START_TEST(test_clear_drops_what_it_covers)
{
	struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *s;

	gl_call(&gl, "glClear", "m", ALL); /* draw 1 */
	triangle(&gl);                     /* 2 */
	gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
	triangle(&gl);             /* 3 */
	gl_call(&gl, "glClear", "m", ALL); /* 4 */
	gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
	triangle(&gl); /* 5 */
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->n_meshes, 1);
	ck_assert_uint_eq(s->n_primitives, 1);
	ck_assert_uint_eq(s->instances[0].draw, 5);
	ck_assert_uint_eq(s->instances[0].first_primitive, 0);
	ck_assert_float_eq(s->instances[0].modelview[12], 2);
	ck_assert_uint_eq(s->n_draws, 5);
	ck_assert_str_eq(s->draws[2].call, "glBegin");
	ck_assert_str_eq(s->draws[4].call, "glClear");
	ck_assert_uint_eq(s->clears[s->n_clears - 1].before_instance, 0);
	ck_assert_uint_eq(s->clears[s->n_clears - 1].draw, 4);
	ck_assert_uint_eq(s->needs_previous, 0);
	scene_release(&s);

	/* The clear need not come first: the draws that showed the previous frame leave the scene, too. */
	triangle(&gl);
	gl_call(&gl, "glClear", "m", ALL);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 0);
	ck_assert_uint_eq(s->needs_previous, 0);
	ck_assert_ptr_null(s->start);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Set a scissor, clear it, and draw in it. */
static void view(struct gl *gl, int x, int width)
{
	gl_call(gl, "glEnable", "e", GL_SCISSOR_TEST);
	gl_call(gl, "glScissor", "iiii", x, 0, width, 64);
	gl_call(gl, "glClear", "m", ALL);
	triangle(gl);
}

/* Clears of parts that together cover everything: the drawing of skipped frames is not requested. With one column
 * less, it is. */
START_TEST(test_clears_of_parts)
{
	for (int gap = 0; gap < 2; gap++) {
		struct painter p = { { 9, 9, 9, 9 }, 1, 0, 0, 0 };
		struct gl gl = open_deep(&p);

		gls_frame_skip(gl.x);
		gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
		view(&gl, 0, 32);
		view(&gl, 32 + gap, 32 - gap);
		gl_call(&gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
		if (!gap) {
			struct scene *s = gls_frame_finish(gl.x);

			ck_assert_uint_eq(s->needs_previous, 0);
			ck_assert_uint_eq(p.asked, 0);
			scene_release(&s);
		} else {
			ck_assert_ptr_null(gls_frame_finish(gl.x));
		}
		ck_assert_int_eq(gl.x->feedback.rewind, gap);
		gl_close(&gl);
	}
}
END_TEST

/* The scene of a frame without a colour clear, released here. asked: receives the number of pictures rendered for it */
static struct scene *uncleared(struct gl *gl, struct painter *p, uint32_t asked)
{
	struct scene *s;

	p->asked = 0;
	gl_call(gl, "glClear", "m", GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	triangle(gl);
	s = gl_swap(gl);
	ck_assert_uint_eq(p->asked, asked);
	return s;
}

/*
 * The initial contents of frames are left to the renderer, which finds out whether they show; if so, they are rendered
 * for it.
 */
START_TEST(test_starts_are_left)
{
	struct painter p = { { 9, 9, 9, 9 }, 1, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *frames[4];

	gl.x->feedback.leaves_starts = 1;
	gl_call(&gl, "glClear", "m", ALL);
	frames[0] = gl_swap(&gl);
	for (int i = 1; i < 4; i++) {
		frames[i] = uncleared(&gl, &p, 0);
		ck_assert_ptr_null(frames[i]->start);
		ck_assert_ptr_eq(scene_before_use(frames[i]->before), frames[i - 1]);
		scene_before_done(frames[i]->before);
		ck_assert_uint_eq(scene_before_held(frames[i]->before), (unsigned)i);
	}
	scene_before_settle(frames[2]->before, 0);
	ck_assert_ptr_null(scene_before_use(frames[2]->before));
	ck_assert_uint_eq(scene_before_held(frames[3]->before), 1);
	scene_before_settle(frames[3]->before, 1);
	for (int i = 0; i < 4; i++)
		scene_release(&frames[i]);
	frames[0] = uncleared(&gl, &p, 1);
	ck_assert_ptr_null(frames[0]->before);
	ck_assert_ptr_nonnull(frames[0]->start);
	scene_release(&frames[0]);
	gl_close(&gl);
}
END_TEST

/* Scenes of two state machines are distinguished: a replay that goes back creates another machine with the same
 * supplier. */
START_TEST(test_serials)
{
	struct gl a = gl_open(), b = gl_open();
	struct scene *of_a, *of_b;

	gl_call(&a, "glClear", "m", GL_COLOR_BUFFER_BIT);
	of_a = gl_swap(&a);
	gl_call(&b, "glClear", "m", GL_COLOR_BUFFER_BIT);
	of_b = gl_swap(&b);
	ck_assert_uint_ne(of_a->serial, of_b->serial);
	scene_release(&of_a);
	scene_release(&of_b);
	gl_close(&a);
	gl_close(&b);
}
END_TEST

/* Without a renderer, only a few are kept. */
START_TEST(test_few_are_held)
{
	struct painter p = { { 9, 9, 9, 9 }, 0, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	unsigned most = 0, n_left = 0;

	gl.x->feedback.leaves_starts = 1;
	gl_call(&gl, "glClear", "m", ALL);
	for (int i = 0; i < 100; i++) {
		struct scene *s = gl_swap(&gl);
		const unsigned held = scene_before_held(s->before);

		most = held > most ? held : most;
		n_left += held > 0;
		scene_release(&s);
		gl_call(&gl, "glClear", "m", GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
		triangle(&gl);
	}
	ck_assert_uint_gt(n_left, 80);
	ck_assert_uint_le(most, 32);
	gl_close(&gl);
}
END_TEST

/* Earlier depths that tests used may be unknown: such frames start from a picture. */
START_TEST(test_looked_at_is_not_left)
{
	struct painter p = { { 9, 9, 9, 9 }, 1, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *s;

	gl.x->feedback.leaves_starts = 1;
	gl_call(&gl, "glClear", "m", ALL);
	s = gl_swap(&gl);
	scene_release(&s);
	gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_ptr_null(s->before);
	ck_assert_ptr_nonnull(s->start);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Reading a part that was cleared needs nothing else. Reading beside it does; depth that tests used does, too. */
START_TEST(test_parts_are_read)
{
	static const struct {
		int width, depth_test, rewinds;
	} cases[] = { { 16, 0, 0 }, { 32, 0, 0 }, { 33, 0, 1 }, { 16, 1, 1 } };

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct painter p = { { 10, 20, 30, 255 }, 1, 0, 0, 0 };
		struct gl gl = open_deep(&p);

		gls_frame_skip(gl.x);
		view(&gl, 0, 32);
		gl_call(&gl, "glDisable", "e", GL_SCISSOR_TEST);
		if (cases[i].depth_test)
			gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
		triangle(&gl);
		gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGB, 0, 0, cases[i].width, 8, 0);
		ck_assert_msg(gl.x->feedback.rewind == cases[i].rewinds, "case %zu", i);
		if (!cases[i].rewinds) { /* the picture does not serve a reader of all of it */
			gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 64, 64, 0);
			ck_assert_int_eq(gl.x->feedback.rewind, 1);
		}
		gl_close(&gl);
	}
}
END_TEST

/* A skipped frame copied to part of a texture: a copy that covers this part makes the texture complete again, no
 * other does. */
START_TEST(test_part_of_texture)
{
	static const struct { int x, width, rewinds; } cases[] = { { 0, 16, 0 }, { 0, 32, 0 }, { 0, 15, 1 }, { 1, 16, 1 } };

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct painter p = { { 9, 9, 9, 9 }, 0, 0, 0, 0 };
		struct gl gl = open_with(&p);
		uint8_t texels[64 * 64 * 3] = { 0 };

		gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGB, 64, 64, 0, GL_RGB, GL_UNSIGNED_BYTE,
		        sizeof(texels), texels);
		gl.x->want = 0;
		gl_call(&gl, "glCopyTexSubImage2D", "eiiiiiii", GL_TEXTURE_2D, 0, 8, 0, 0, 0, 8, 8);
		gl_call(&gl, "glCopyTexSubImage2D", "eiiiiiii", GL_TEXTURE_2D, 0, 0, 0, 0, 0, 8, 8);
		gls_frame_skip(gl.x);
		gl.x->want = 1;
		gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
		gl_call(&gl, "glCopyTexSubImage2D", "eiiiiiii", GL_TEXTURE_2D, 0, cases[i].x, 0, 0, 0, cases[i].width, 8);
		textured_triangle(&gl);
		ck_assert_msg(gl.x->feedback.rewind == cases[i].rewinds, "case %zu", i);
		gl_close(&gl);
	}
}
END_TEST

/* Depth left by skipped frames, kept by a frame that does not use it, is still unknown in the next frame. */
START_TEST(test_skipped_depth)
{
	for (int cleared = 0; cleared < 2; cleared++) {
		struct painter p = { { 9, 9, 9, 9 }, 0, 0, 0, 0 };
		struct gl gl = open_deep(&p);
		struct scene *s;

		gl.x->want = 0;
		gl_call(&gl, "glClear", "m", ALL);
		gls_frame_skip(gl.x);
		gl.x->want = 1;
		gl_call(&gl, "glClear", "m", cleared ? ALL : GL_COLOR_BUFFER_BIT);
		triangle(&gl);
		s = gl_swap(&gl);
		scene_release(&s);
		gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
		gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
		p.unknown = 1;
		triangle(&gl);
		gl_call(&gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
		s = gls_frame_finish(gl.x);
		ck_assert_int_eq(gl.x->feedback.rewind, !cleared);
		ck_assert_int_eq(s != NULL, cleared);
		if (s)
			scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

/* A clear that leaves some drawn pixels keeps all draws in the scene. */
START_TEST(test_clear_that_leaves_something)
{
	static const struct { const char *name, *letters; unsigned value, buffers; } cases[] = {
		{ "glEnable", "e", GL_SCISSOR_TEST, ALL },     { "glDepthMask", "e", 0, ALL },
		{ "glDrawBuffer", "e", GL_NONE, ALL },         { NULL, NULL, 0, GL_COLOR_BUFFER_BIT },
		{ NULL, NULL, 0, GL_DEPTH_BUFFER_BIT },        { "glStencilMask", "u", 1, ALL },
		{ NULL, NULL, 0, ALL & ~GL_STENCIL_BUFFER_BIT }
	};

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
		struct gl gl = open_deep(&p);
		struct scene *s;

		gl_call(&gl, "glScissor", "iiii", 1, 0, 63, 64);
		gl_call(&gl, "glClear", "m", ALL);
		gl_call(&gl, "glEnable", "e", GL_STENCIL_TEST);
		triangle(&gl);
		gl_call(&gl, "glDisable", "e", GL_STENCIL_TEST);
		if (cases[i].name)
			gl_call(&gl, cases[i].name, cases[i].letters, cases[i].value);
		gl_call(&gl, "glClear", "m", cases[i].buffers);
		s = gl_swap(&gl);
		ck_assert_msg(s->n_instances == 1, "case %zu: %u instances", i, s->n_instances);
		ck_assert_uint_eq(s->clears[1].before_instance, 1);
		scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

/* The stencil buffer is unchanged if no draw modified it, and the clear that set it is kept although other clears
 * preceded it. */
START_TEST(test_clear_keeps_stencil)
{
	struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *s;

	for (int i = 0; i <= 3; i++) {
		gl_call(&gl, "glClearStencil", "i", i);
		gl_call(&gl, "glClear", "m", GL_STENCIL_BUFFER_BIT);
		triangle(&gl);
		gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 0);
	ck_assert_uint_eq(s->n_clears, 2);
	ck_assert_uint_eq(s->clears[0].buffers, 4);
	ck_assert_uint_eq(s->clears[0].stencil, 3);
	ck_assert_uint_eq(s->clears[1].buffers, 3);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Clears that keep stencil values keep the draws that wrote them, and no others. */
START_TEST(test_clear_keeps_draws_of_stencil)
{
	struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *s;

	gl_call(&gl, "glClear", "m", ALL);
	for (int i = 0; i < 3; i++) {
		gl_call(&gl, i == 1 ? "glEnable" : "glDisable", "e", GL_STENCIL_TEST);
		triangle(&gl);
	}
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->n_primitives, 2);
	for (uint32_t i = 0; i < 2; i++) {
		ck_assert_uint_eq(s->instances[i].first_primitive, i);
		ck_assert_uint_eq(s->instances[i].draw, i ? 6 : 3);
		ck_assert_uint_eq(s->clears[i].before_instance, i);
		ck_assert_uint_eq(s->materials[s->instances[i].material].stencil_test, !i);
	}
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Pixels read before the clear include earlier draws; pixels read after it do not. */
START_TEST(test_clear_after_reading)
{
	struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *s;

	gl_call(&gl, "glClear", "m", ALL);
	triangle(&gl);
	gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 16, 8, 0);
	ck_assert_uint_eq(p.n_instances, 1);
	gl_call(&gl, "glClear", "m", ALL);
	triangle(&gl);
	triangle(&gl);
	textured_triangle(&gl);
	gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 16, 8, 0);
	ck_assert_uint_eq(p.asked, 2);
	s = gl_swap(&gl);
	ck_assert_uint_eq(p.n_instances, s->n_instances);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_mem_eq(s->textures[0]->texels, p.color, 3);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* RASTERIZER_DISCARD (GL 3.0 sec. 3.1): nothing is drawn, cleared or counted; state changes as usual. */
START_TEST(test_rasterizer_discard)
{
	struct painter p = { { 10, 20, 30, 255 }, 0, 0, 0, 0 };
	struct gl gl = open_deep(&p);
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glTranslatef", "fff", 3.0, 0.0, 0.0);
	triangle(&gl);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glClear", "m", ALL);
	triangle(&gl);
	gl_call(&gl, "glEnable", "e", GL_RASTERIZER_DISCARD);
	gl_call(&gl, "glCallList", "u", 1u);
	gl_call(&gl, "glClear", "m", ALL);
	gl_call(&gl, "glDisable", "e", GL_RASTERIZER_DISCARD);
	ck_assert_uint_eq(gl_error(&gl), 0);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_draws, 3);
	ck_assert_uint_eq(s->n_clears, 1);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_float_eq(s->instances[1].modelview[12], 3);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

GL_TESTS("feedback", test_clear_drops_what_it_covers, test_clear_that_leaves_something, test_clear_keeps_stencil,
         test_clear_keeps_draws_of_stencil, test_clear_after_reading, test_rasterizer_discard, test_copy_tex_image,
         test_copy_tex_sub_image, test_previous_frame, test_skipped_frames, test_drawables, test_no_supplier,
         test_clears_of_parts, test_parts_are_read, test_part_of_texture, test_skipped_depth, test_serials,
         test_starts_are_left, test_few_are_held, test_looked_at_is_not_left)
