/* Front and back buffer of a window (GL 2.1 sec. 4.2.1, 4.3.2; GLX 1.4 sec. 3.3.10): the buffer that each event
 * applies to, and the effect of a swap. */
#include "tests/gl/gl.h"
#include "replay/build/frame.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/frames.h"
#include "replay/gl/surface/screen.h"

#define ALL (GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)

/* A supplier whose pictures consist only of clears. */
static int apply_clears(void *user, const struct scene *s, struct scene_picture *p)
{
	(void)user;
	p->unknown = !s->start;
	for (size_t i = 0; i < (size_t)s->width * s->height; i++) {
		if (s->start) {
			memcpy(p->rgba + 4 * i, s->start->rgba + 4 * i, 4);
			p->depth[i] = s->start->depth[i];
		}
		for (uint32_t k = 0; k < s->n_clears; k++) {
			const struct scene_clear *clear = &s->clears[k];

			if (clear->buffers & 2)
				p->depth[i] = (uint32_t)(clear->depth * (float)((1u << p->depth_bits) - 1));
			if (!(clear->buffers & 1) || !clear->color_mask)
				continue;
			p->unknown = 0;
			for (int j = 0; j < 4; j++)
				p->rgba[4 * i + (size_t)j] = (uint8_t)(clear->color[j] * 255);
		}
	}
	return 0;
}

static struct gl open_with_pictures(void)
{
	struct gl gl = gl_open();

	gl.x->feedback.supply = apply_clears;
	return gl;
}

/* Clear to a shade of red. */
static void clear(struct gl *gl, unsigned buffers, double red, double depth)
{
	gl_call(gl, "glClearColor", "ffff", red, 0.0, 0.0, 1.0);
	gl_call(gl, "glClearDepth", "d", depth);
	gl_call(gl, "glClear", "m", buffers);
}

static void triangle(struct gl *gl)
{
	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	gl_call(gl, "glVertex2f", "ff", 0.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 1.0, 0.0);
	gl_call(gl, "glVertex2f", "ff", 0.0, 1.0);
	gl_call(gl, "glEnd", "");
}

static void swap(struct gl *gl)
{
	struct scene *s = gl_swap(gl);

	ck_assert_ptr_nonnull(s);
	scene_release(&s);
}

/* Ends a frame without a swap. */
static struct scene *terminate(struct gl *gl)
{
	struct scene *s;

	gl_call(gl, "glFrameTerminatorGREMEDY", "");
	gl->x->frame_ended = 0;
	s = gls_frame_finish(gl->x);
	gl->x->frame++;
	return s;
}

static const struct scene_picture *read_buffer(struct gl *gl, uint32_t buffer)
{
	gl_call(gl, "glReadBuffer", "e", buffer);
	return gls_read_screen(gl->x, gl_state(gl), NULL);
}

/* A swap shows the back buffer; later drawing to the back buffer does not reach the front. */
START_TEST(test_swap)
{
	struct gl gl = open_with_pictures();
	const struct scene_picture *p;

	gl.x->feedback.fronts = 1;
	clear(&gl, ALL, 0.2, 0.5);
	swap(&gl);
	ck_assert_uint_eq(read_buffer(&gl, GL_FRONT)->rgba[0], 51);
	clear(&gl, ALL, 0.4, 0.25);
	p = read_buffer(&gl, GL_FRONT_LEFT);
	ck_assert_uint_eq(p->rgba[0], 51);
	ck_assert_uint_eq(p->depth[0], ((1u << 24) - 1) / 4); /* both share one depth buffer */
	ck_assert_uint_eq(read_buffer(&gl, GL_BACK)->rgba[0], 102);
	swap(&gl);
	ck_assert_uint_eq(read_buffer(&gl, GL_FRONT)->rgba[0], 102);
	gl_close(&gl);
}
END_TEST

/* The same if the front buffer is drawn to only after the back buffer: the replay has to start again. */
START_TEST(test_known_too_late)
{
	for (int fronts = 0; fronts < 2; fronts++) {
		struct gl gl = open_with_pictures();
		const struct scene_picture *p;

		gl.x->feedback.fronts = fronts;
		clear(&gl, ALL, 0.2, 0.5);
		swap(&gl);
		clear(&gl, ALL, 0.4, 0.25);
		p = read_buffer(&gl, GL_FRONT);
		ck_assert_int_eq(gl.x->feedback.rewind, !fronts);
		ck_assert_int_eq(gl.x->feedback.fronts, 1);
		ck_assert_int_eq(p != NULL, fronts);
		if (p) {
			ck_assert_uint_eq(p->rgba[0], 51);
			ck_assert_uint_eq(p->depth[0], ((1u << 24) - 1) / 4);
		}
		gl_close(&gl);
	}
}
END_TEST

/* The picture of a swap includes draws to the front buffer only if they affect depth or stencil, and without their
 * colours. */
START_TEST(test_picture_of_back)
{
	struct gl gl = open_with_pictures();
	struct scene *s;

	clear(&gl, ALL, 0, 1);
	gl_call(&gl, "glDrawBuffer", "e", GL_FRONT);
	triangle(&gl);
	gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
	triangle(&gl);
	clear(&gl, GL_COLOR_BUFFER_BIT, 1, 1);
	gl_call(&gl, "glDrawBuffer", "e", GL_FRONT_AND_BACK);
	triangle(&gl);
	gl_call(&gl, "glDrawBuffer", "e", GL_BACK);
	triangle(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->materials[s->instances[0].material].color_mask, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].color_mask, 15);
	ck_assert_uint_eq(s->materials[s->instances[2].material].color_mask, 15);
	ck_assert_uint_eq(s->n_clears, 1);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A frame that ends without a swap shows the draw buffer, on top of the last swap's picture. */
START_TEST(test_picture_of_front)
{
	struct gl gl = open_with_pictures();
	struct scene *s;

	clear(&gl, ALL, 0.2, 1);
	swap(&gl);
	gl_call(&gl, "glDrawBuffer", "e", GL_FRONT);
	triangle(&gl);
	s = terminate(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->materials[s->instances[0].material].color_mask, 15);
	ck_assert_ptr_nonnull(s->start);
	ck_assert_uint_eq(s->start->rgba[0], 51);
	scene_release(&s);
	gl_call(&gl, "glDrawBuffer", "e", GL_BACK);
	clear(&gl, ALL, 0.4, 1);
	triangle(&gl);
	s = terminate(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->n_clears, 1);
	ck_assert_float_eq_tol(s->clears[0].color[0], 0.4, 1e-6);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* In a program that does not use the back buffer, events without colours do not accumulate there. */
START_TEST(test_front_alone)
{
	struct gl gl = open_with_pictures();
	struct gls_drawable *d = gls_drawable_of(gl.x, gl_state(&gl)->drawable);

	gl_call(&gl, "glEnable", "e", GL_DEPTH_TEST);
	gl_call(&gl, "glDrawBuffer", "e", GL_FRONT);
	for (int i = 0; i < 100; i++) {
		struct scene *s;

		clear(&gl, ALL, 0.2, 1);
		triangle(&gl);
		s = terminate(&gl);
		ck_assert_uint_eq(s->n_instances, 1);
		scene_release(&s);
		ck_assert_uint_eq(gls_frame_events(&d->surface), 2);
	}
	ck_assert_int_eq(gl.x->feedback.rewind, 0);
	gl_close(&gl);
}
END_TEST

/* A single-buffered window shows its buffer, under any name. */
START_TEST(test_single_buffered)
{
	struct gl gl = open_with_pictures();
	struct scene *s;

	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 0 24 8 0 0 0");
	clear(&gl, ALL, 0.2, 1);
	gl_call(&gl, "glDrawBuffer", "e", GL_FRONT);
	triangle(&gl);
	ck_assert_uint_eq(read_buffer(&gl, GL_FRONT)->rgba[0], 51);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_uint_eq(s->n_clears, 1);
	ck_assert_uint_eq(s->materials[s->instances[0].material].color_mask, 15);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* DrawBuffers of both is FRONT_AND_BACK; a framebuffer object's second colour is counted. */
START_TEST(test_draw_buffers)
{
	static const uint32_t both[] = { GL_FRONT_LEFT, GL_BACK_LEFT }, one[] = { GL_NONE, GL_BACK_LEFT };
	struct gl gl = open_with_pictures();

	gl_call(&gl, "glDrawBuffers", "iU", 2, 2, both);
	ck_assert_uint_eq(gl_state(&gl)->a.color.draw_buffer, GL_FRONT_AND_BACK);
	gl_call(&gl, "glDrawBuffers", "iU", 2, 2, one);
	ck_assert_uint_eq(gl_state(&gl)->a.color.draw_buffer, GL_BACK_LEFT);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_close(&gl);
}
END_TEST

GL_TESTS("front", test_swap, test_known_too_late, test_picture_of_back, test_picture_of_front, test_front_alone,
         test_single_buffered, test_draw_buffers)
