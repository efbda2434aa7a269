/* Draw targets (GL 2.1 sec. 4, GLX 1.4 sec. 3.3.3, GL 3.0 sec. 4.4): bit depths, framebuffer objects. */
#include "tests/gl/gl.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/frames.h"

static void triangle(struct gl *gl)
{
	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 0.0, 1.0);
	gl_call(gl, "glEnd", "");
}

static void current_with(struct gl *gl, uint64_t handle, uint64_t visual)
{
	gl_call_address(gl, handle, "glXCreateContext", "pppi", (uint64_t)1, visual, (uint64_t)0, 1);
	gl_call(gl, "glXMakeCurrent", "pup", (uint64_t)1, 7u, handle);
}

/* Properties that the program queried or requested for a visual hold for its contexts. */
START_TEST(test_bits_of_visuals)
{
	const uint32_t with[] = { 4, 5, 11, 1, 12, 1, 0 }, without[] = { 4, 12, 11, 0 }; /* 11: a depth size, not the token */
	const uint32_t eight = 8, sixteen = 16, zero = 0;
	struct gl gl = gl_open();

	gl_call_address(&gl, 0x100, "glXChooseVisual", "piU", (uint64_t)1, 0, 7, with);
	gl_call_address(&gl, 0x200, "glXChooseVisual", "piU", (uint64_t)1, 0, 4, without);
	gl_call(&gl, "glXGetConfig", "ppiU", (uint64_t)1, (uint64_t)0x200, 12, 1, &sixteen);
	gl_call(&gl, "glXGetConfig", "ppiU", (uint64_t)1, (uint64_t)0x200, 13, 1, &zero);
	gl_call(&gl, "eglGetConfigAttrib", "ppiU", (uint64_t)1, (uint64_t)0x300, 0x3021, 1, &eight);
	current_with(&gl, 0x11, 0x100);
	ck_assert_uint_eq(gl_state(&gl)->alpha_bits, 8);
	ck_assert_uint_eq(gl_state(&gl)->depth_bits, 24);
	current_with(&gl, 0x12, 0x200);
	ck_assert_uint_eq(gl_state(&gl)->alpha_bits, 0);
	ck_assert_uint_eq(gl_state(&gl)->depth_bits, 16);
	ck_assert_uint_eq(gl_state(&gl)->stencil_bits, 0);
	gl_call_address(&gl, 0x13, "eglCreateContext", "pppp", (uint64_t)1, (uint64_t)0x300, (uint64_t)0, (uint64_t)0);
	gl_call(&gl, "eglMakeCurrent", "pppp", (uint64_t)1, (uint64_t)7, (uint64_t)7, (uint64_t)0x13);
	ck_assert_uint_eq(gl_state(&gl)->alpha_bits, 8);
	gl_close(&gl);
}
END_TEST

/* Our recorder's markers take precedence; without a depth or stencil buffer, its test is off (sec. 4.1.5, 4.1.6). */
START_TEST(test_bits_of_marker)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
	gl_call(&gl, "glEnable", "e", GL_STENCIL_TEST);
	triangle(&gl);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 0 0");
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->alpha_bits, 8);
	ck_assert_uint_eq(s->depth_bits, 0);
	ck_assert_uint_eq(s->stencil_bits, 0);
	ck_assert_uint_eq(s->materials[s->instances[0].material].depth_test, 1);
	ck_assert_uint_eq(s->materials[s->instances[1].material].depth_test, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].stencil_test, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Multisampling (sec. 3.2.1): queries, and smoothing, which it replaces. Four samples is the only supported number. */
START_TEST(test_samples)
{
	struct gl gl = gl_open();
	const struct scene_material *m;
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_SAMPLE_COVERAGE);
	gl_call(&gl, "glEnable", "e", GL_SAMPLE_ALPHA_TO_COVERAGE);
	gl_call(&gl, "glEnable", "e", GL_LINE_SMOOTH);
	gl_call(&gl, "glSampleCoverage", "fi", 0.5, 0);
	triangle(&gl);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 24 8 0 4");
	triangle(&gl);
	gl_call(&gl, "glSampleCoverage", "fi", 0.5, 1);
	triangle(&gl);
	gl_call(&gl, "glDisable", "e", GL_MULTISAMPLE);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 4);
	for (uint32_t i = 0; i < 4; i++) {
		m = &s->materials[s->instances[i].material];
		ck_assert_uint_eq(m->multisample, i == 1 || i == 2);
		ck_assert_uint_eq(m->line_smooth, !m->multisample);
		ck_assert_uint_eq(m->alpha_to_coverage, m->multisample);
		ck_assert_uint_eq(m->samples_off, i == 1 ? 12 : i == 2 ? 3 : 0);
	}
	scene_release(&s);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 24 8 0 8");
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	gl_close(&gl);
}
END_TEST

/* A supplier that fills every picture with one colour, and records the requests. */
struct painter {
	/* unknown: the buffers that pictures report as unknown */
	uint32_t asked, n_instances, width, height, depth_bits, alpha_bits, had_start, unknown;
	uint8_t start[4];
};

static int paint(void *user, const struct scene *s, struct scene_picture *picture)
{
	struct painter *p = user;

	p->asked++;
	p->n_instances = s->n_instances;
	p->width = s->width;
	p->height = s->height;
	p->depth_bits = s->depth_bits;
	p->alpha_bits = s->alpha_bits;
	p->had_start = s->start != NULL;
	if (s->start)
		memcpy(p->start, s->start->rgba, 4);
	for (size_t i = 0; i < (size_t)s->width * s->height; i++) {
		memcpy(picture->rgba + 4 * i, (uint8_t[4]){ 10, 20, 30, 40 }, 4);
		picture->depth[i] = (1u << picture->depth_bits) - 1;
		picture->stencil[i] = 3;
	}
	picture->unknown = p->unknown;
	return 0;
}

/* Texture 5, 16 x 8 with the given format, attached to object 3, which stays bound. */
static struct gl open_object(struct painter *p, uint32_t format)
{
	struct gl gl = gl_open();

	gl.x->feedback.supply = paint;
	gl.x->feedback.supply_user = p;
	gl_call(&gl, "glBindTexture", "ei", GL_TEXTURE_2D, 5);
	gl_call(&gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, format, 16, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	gl_call(&gl, "glBindFramebufferEXT", "ei", GL_FRAMEBUFFER, 3);
	gl_call(&gl, "glFramebufferTexture2D", "eeeii", GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 5, 0);
	return gl;
}

static void show(struct gl *gl)
{
	gl_call(gl, "glBindFramebuffer", "ei", GL_FRAMEBUFFER, 0);
	gl_call(gl, "glEnable", "e", GL_TEXTURE_2D);
	triangle(gl);
	gl_call(gl, "glDisable", "e", GL_TEXTURE_2D);
}

/* Draws to an object form a scene of its size; the texture contains them, in its base format, when it is used. */
START_TEST(test_render_to_texture)
{
	struct painter p = { 0 };
	struct gl gl = open_object(&p, GL_RGB);
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	triangle(&gl);
	triangle(&gl);
	ck_assert_uint_eq(p.asked, 0);
	show(&gl);
	ck_assert_uint_eq(p.asked, 1);
	ck_assert_uint_eq(p.width, 16);
	ck_assert_uint_eq(p.height, 8);
	ck_assert_uint_eq(p.depth_bits, 0);
	ck_assert_uint_eq(p.alpha_bits, 0);
	ck_assert_uint_ge(p.n_instances, 1);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->width, 64);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_mem_eq(s->textures[0]->texels, ((uint8_t[4]){ 10, 20, 30, 255 }), 4);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	show(&gl); /* unchanged: nothing is rendered */
	s = gl_swap(&gl);
	ck_assert_uint_eq(p.asked, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Drawing without a clear starts from the texture's contents, including those the program uploaded. */
START_TEST(test_object_keeps)
{
	const uint8_t texel[4] = { 1, 2, 3, 4 };
	struct painter p = { 0 };
	struct gl gl = open_object(&p, GL_RGBA);

	triangle(&gl);
	gl_call(&gl, "glTexSubImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE,
	        sizeof(texel), texel);
	ck_assert_uint_eq(p.asked, 1); /* before it changes */
	triangle(&gl);
	show(&gl);
	ck_assert_uint_eq(p.asked, 2);
	ck_assert_uint_eq(p.alpha_bits, 8);
	ck_assert_uint_eq(p.had_start, 1);
	ck_assert_mem_eq(p.start, texel, 4);
	gl_close(&gl);
}
END_TEST

/* Renderbuffers provide depth and stencil; an object without attachments is not drawn to; a deleted one is unbound. */
START_TEST(test_renderbuffers)
{
	struct painter p = { 0 };
	struct gl gl = open_object(&p, GL_RGBA);
	const uint32_t object = 3, texture = 5;
	struct scene *s;

	gl_call(&gl, "glRenderbufferStorage", "eeii", GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, 12, 20);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glBindRenderbufferEXT", "ei", GL_RENDERBUFFER, 9);
	gl_call(&gl, "glRenderbufferStorage", "eeii", GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, 12, 20);
	gl_call(&gl, "glFramebufferRenderbuffer", "eeei", GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, 9);
	triangle(&gl);
	show(&gl);
	ck_assert_uint_eq(p.depth_bits, 16);
	ck_assert_uint_eq(p.width, 12); /* the smaller size of each */
	ck_assert_uint_eq(p.height, 8);
	gl_call(&gl, "glBindFramebuffer", "ei", GL_FRAMEBUFFER, 3);
	gl_call(&gl, "glFramebufferRenderbuffer", "eeei", GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, 0);
	gl_call(&gl, "glDeleteTextures", "iU", 1, 1, &texture);
	p.asked = 0;
	triangle(&gl);
	gl_call(&gl, "glDeleteFramebuffers", "iU", 1, 1, &object);
	ck_assert_uint_eq(p.asked, 0);
	ck_assert_uint_eq(gl_state(&gl)->draw_framebuffer, 0);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* BlitFramebuffer: a pixel rectangle without tests and blending, in the draw object or the window. */
START_TEST(test_blit)
{
	struct painter p = { 0 };
	struct gl gl = open_object(&p, GL_RGBA);
	struct scene *s;

	triangle(&gl);
	gl_call(&gl, "glBindFramebuffer", "ei", GL_DRAW_FRAMEBUFFER, 0);
	gl_call(&gl, "glEnable", "e", GL_BLEND);
	gl_call(&gl, "glBlitFramebuffer", "iiiiiiiime", 0, 0, 4, 4, 20, 10, 12, 18, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	s = gl_swap(&gl);
	ck_assert_uint_eq(p.asked, 1);
	ck_assert_uint_eq(s->n_rectangles, 1);
	ck_assert_uint_eq(s->rectangles[0].kind, SCENE_COLOR_PIXELS);
	ck_assert_uint_eq(s->rectangles[0].width, 4);
	ck_assert_floats(2, s->rectangles[0].zoom, -2, 2);
	ck_assert_floats(2, s->meshes[s->instances[0].mesh]->position, 20, 10);
	ck_assert_uint_eq(s->materials[s->instances[0].material].blend, 0);
	ck_assert_mem_eq(s->textures[s->rectangles[0].texture]->texels, ((uint8_t[4]){ 10, 20, 30, 40 }), 4);
	ck_assert_uint_eq(gl_state(&gl)->a.color.blend, 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A texture drawn to in a skipped frame is missing: the replay must start again when it is used. */
START_TEST(test_object_skipped)
{
	struct painter p = { 0 };
	struct gl gl = open_object(&p, GL_RGBA);

	gl.x->want = 0;
	triangle(&gl);
	gl_call(&gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
	gls_frame_skip(gl.x);
	gl.x->want = 1;
	show(&gl);
	ck_assert_int_eq(gl.x->feedback.rewind, 1);
	gl_close(&gl);
	gl = open_object(&p, GL_RGBA);
	gl.x->want = 0;
	triangle(&gl);
	gls_frame_skip(gl.x);
	gl.x->want = 1;
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT); /* replaces everything */
	show(&gl);
	ck_assert_int_eq(gl.x->feedback.rewind, 0);
	gl_close(&gl);
}
END_TEST

/* If an object has no colours, cleared depths are all that can be seen of it. */
START_TEST(test_depths_skipped)
{
	for (int cleared = 0; cleared < 2; cleared++) {
		struct painter p = { .unknown = 1 };
		struct gl gl = open_object(&p, GL_RGBA);

		gl_call(&gl, "glFramebufferTexture2D", "eeeii", GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
		gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 16, 8, 0,
		        GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, (uint64_t)0);
		gl_call(&gl, "glFramebufferTexture2D", "eeeii", GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 5, 0);
		gl_call(&gl, "glDrawBuffer", "e", GL_NONE);
		gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
		gl.x->want = 0;
		triangle(&gl);
		gls_frame_skip(gl.x);
		gl.x->want = 1;
		if (cleared)
			gl_call(&gl, "glClear", "m", GL_DEPTH_BUFFER_BIT);
		triangle(&gl);
		show(&gl);
		ck_assert_uint_eq(p.asked, 1);
		ck_assert_int_eq(gl.x->feedback.rewind, !cleared);
		gl_close(&gl);
	}
}
END_TEST

/* Accum (sec. 4.2.4): sums of the screen, returned as pixels under scissor and mask. */
START_TEST(test_accum)
{
	struct painter p = { 0 };
	struct gl gl = gl_open();
	const struct scene_rectangle *r;
	struct scene *s;

	gl.x->feedback.supply = paint; /* 10 20 30 40 everywhere */
	gl.x->feedback.supply_user = &p;
	gl_call(&gl, "glAccum", "ef", GL_NONE, 1.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 24 8 0 0 1 0");
	gl_call(&gl, "glAccum", "ef", GL_LOAD, 1.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 24 8 0 0 1 16");
	gl_call(&gl, "glClearAccum", "ffff", 0.0, 0.0, 0.0, 0.5);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
	gl_call(&gl, "glAccum", "ef", GL_ACCUM, 2.0);
	gl_call(&gl, "glAccum", "ef", GL_ADD, 0.2);
	gl_call(&gl, "glAccum", "ef", GL_MULT, 0.5);
	gl_call(&gl, "glEnable", "e", GL_SCISSOR_TEST);
	gl_call(&gl, "glScissor", "iiii", 10, 60, 20, 20);
	gl_call(&gl, "glColorMask", "iiii", 1, 0, 1, 1);
	gl_call(&gl, "glAccum", "ef", GL_RETURN, 1.0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_rectangles, 1);
	r = &s->rectangles[0];
	ck_assert_uint_eq(r->width, 20);
	ck_assert_uint_eq(r->height, 4);
	ck_assert_floats(2, s->meshes[s->instances[0].mesh]->position, 10, 60);
	ck_assert_uint_eq(s->materials[s->instances[0].material].color_mask, 13);
	/* ((0 0 0 .5) + 2 (10 20 30 40) / 255 + .2) / 2; alpha exceeds 1 before it is halved, and wraps to -1 */
	for (int i = 0; i < 4; i++)
		ck_assert_int_le(abs(s->textures[r->texture]->texels[i] - ((int[4]){ 35, 45, 55, 0 })[i]), 1);
	scene_release(&s);

	gl.x->want = 0; /* sums of skipped frames are missing, until the buffer is loaded completely */
	gl_call(&gl, "glAccum", "ef", GL_ACCUM, 1.0);
	gls_frame_skip(gl.x);
	gl.x->want = 1;
	gl_call(&gl, "glDisable", "e", GL_SCISSOR_TEST);
	gl_call(&gl, "glColorMask", "iiii", 1, 1, 1, 1);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	gl_call(&gl, "glAccum", "ef", GL_LOAD, 1.0);
	gl_call(&gl, "glAccum", "ef", GL_RETURN, 1.0);
	ck_assert_int_eq(gl.x->feedback.rewind, 0);
	gl.x->want = 0;
	gl_call(&gl, "glAccum", "ef", GL_MULT, 0.5);
	gl.x->want = 1;
	gl_call(&gl, "glAccum", "ef", GL_RETURN, 1.0);
	ck_assert_int_eq(gl.x->feedback.rewind, 1);
	gl_close(&gl);
}
END_TEST

/* An accumulation buffer completely cleared to 0 takes no memory; cleared in part, or to other values, it does. */
START_TEST(test_accum_cleared)
{
	static const struct {
		double value;
		int scissor, is_there;
	} clears[] = { { 0, 0, 0 }, { 0.5, 0, 1 }, { 0, 1, 1 }, { 0, 0, 0 }, { 0, 1, 1 } };
	struct gl gl = gl_open();
	const struct gls_drawable *d = gls_drawable_of(gl.x, 7);

	gl.x->want = 1;
	for (size_t i = 0; i < sizeof(clears) / sizeof(clears[0]); i++) {
		gl_call(&gl, clears[i].scissor ? "glEnable" : "glDisable", "e", GL_SCISSOR_TEST);
		gl_call(&gl, "glScissor", "iiii", 0, 0, 5, 5);
		gl_call(&gl, "glClearAccum", "ffff", 0.0, 0.0, clears[i].value, 0.0);
		gl_call(&gl, "glClear", "m", GL_ACCUM_BUFFER_BIT);
		ck_assert_msg((d->accum != NULL) == clears[i].is_there, "clear %zu", i);
		if (clears[i].value > 0)
			ck_assert_int_eq(d->accum[4 * (d->width * d->height - 1) + 2], 16383);
		else if (d->accum)
			ck_assert_int_eq(d->accum[2], 0);
	}
	gl_close(&gl);
}
END_TEST

GL_TESTS("targets", test_bits_of_visuals, test_bits_of_marker, test_samples, test_render_to_texture, test_object_keeps,
         test_renderbuffers, test_blit, test_object_skipped, test_depths_skipped, test_accum, test_accum_cleared)
