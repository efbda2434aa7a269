/* OpenGL ES 1: fixed-point arguments (OpenGL ES 1.1 sec. 2.3), and extensions of its time. */
#include "tests/gl/gl.h"

#define X(v) ((int)((v) * 65536))

static struct gls_attribs *attribs(struct gl *gl)
{
	return &gl_state(gl)->a;
}

/* Numbers are 16.16 fixed point; enumerants and booleans in their place are not. */
START_TEST(test_fixed)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glFogx", "ei", GL_FOG_MODE, GL_LINEAR);
	gl_call(&gl, "glFogx", "ei", GL_FOG_START, X(2.5));
	ck_assert_uint_eq(attribs(&gl)->fog.mode, GL_LINEAR);
	ck_assert_floats(1, &attribs(&gl)->fog.start, 2.5);
	gl_call(&gl, "glColor4x", "iiii", X(0.25), X(0.5), X(0.75), X(-1));
	ck_assert_floats(4, attribs(&gl)->current.attribute[GLS_ATTR_COLOR], 0.25, 0.5, 0.75, -1);
	gl_call(&gl, "glLightModelx", "ei", GL_LIGHT_MODEL_TWO_SIDE, 1);
	ck_assert_uint_eq(attribs(&gl)->lighting.two_side, 1);
	gl_call(&gl, "glTexEnvxOES", "eei", GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_DECAL);
	ck_assert_uint_eq(attribs(&gl)->texturing.units[0].value.env_mode, GL_DECAL);
	gl_call(&gl, "glPointSizex", "i", X(3.5));
	ck_assert_floats(1, &attribs(&gl)->point.size, 3.5);
	gl_call(&gl, "glDepthRangex", "ii", X(0.25), X(0.5));
	ck_assert_floats(2, attribs(&gl)->viewport.depth_range, 0.25, 0.5);
	gl_call(&gl, "glAlphaFuncx", "ei", GL_LESS, X(0.5));
	ck_assert_floats(1, &attribs(&gl)->color.alpha_ref, 0.5);
	gl_call(&gl, "glTranslatex", "iii", X(1), X(-2), X(0.5));
	ck_assert_floats(3, gl_state(&gl)->modelview.matrices[0] + 12, 1, -2, 0.5);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_close(&gl);
}
END_TEST

/* OES_texture_cube_map: STR stands for three coordinates. */
START_TEST(test_generation)
{
	struct gl gl = gl_open();
	const struct gls_unit *unit = &attribs(&gl)->texturing.units[0];

	gl_call(&gl, "glTexGeniOES", "eei", GL_TEXTURE_GEN_STR_OES, GL_TEXTURE_GEN_MODE, GL_NORMAL_MAP);
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_GEN_STR_OES);
	ck_assert_uint_eq(unit->gen_enabled, 7);
	for (unsigned i = 0; i < 3; i++)
		ck_assert_uint_eq(unit->value.gen_mode[i], GL_NORMAL_MAP);
	ck_assert_uint_eq(unit->value.gen_mode[3], GL_EYE_LINEAR);
	gl_call(&gl, "glDisable", "e", GL_TEXTURE_GEN_STR_OES);
	ck_assert_uint_eq(unit->gen_enabled, 0);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_close(&gl);
}
END_TEST

/* OES_draw_texture: a rectangle in window coordinates, regardless of the matrices. */
START_TEST(test_draw_texture)
{
	struct gl gl = gl_open();
	const uint8_t texels[4 * 4 * 3] = { 0 };
	struct scene *s;

	gl_call(&gl, "glTexImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE,
	        sizeof(texels), texels);
	gl_call(&gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(&gl, "glTexParameteriv", "eeU", GL_TEXTURE_2D, GL_TEXTURE_CROP_RECT_OES, 4, (const uint32_t[]){ 1, 2, 2, 1 });
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glRotatef", "ffff", 30.0, 0.0, 0.0, 1.0);
	gl_call(&gl, "glDrawTexiOES", "iiiii", 8, 16, 1, 20, 10);
	gl_call(&gl, "glDrawTexxOES", "iiiii", X(8.5), 0, 0, X(1), X(1));
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_call(&gl, "glDrawTexiOES", "iiiii", 8, 16, 1, 0, 10);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_floats(3, s->meshes[s->instances[0].mesh]->position + 8, 28, 26, 1);
	ck_assert_floats(2, s->meshes[s->instances[0].mesh]->texcoord[0] + 8, 0.75, 0.75);
	ck_assert_floats(3, s->meshes[s->instances[1].mesh]->position, 8.5, 0, 0);
	ck_assert_floats(4, s->views[s->instances[0].view].viewport, 0, 0, 64, 64);
	ck_assert_uint_eq(s->materials[s->instances[0].material].lighting, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A base level that the texture lacks (GL 2.1 sec. 3.8.10: the texture is incomplete) leaves the rectangle
 * untextured. */
START_TEST(test_rectangle_without_level)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 100000000);
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glDrawTexiOES", "iiiii", 8, 16, 1, 20, 10);
	ck_assert_uint_eq(gl_error(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	ck_assert_ptr_null(s->meshes[s->instances[0].mesh]->texcoord[0]);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* OES_point_size_array: consecutive points of one size are one draw. */
START_TEST(test_point_sizes)
{
	const float at[4][2] = { { 0, 0 }, { 0.1f, 0 }, { 0.2f, 0 }, { 0.3f, 0 } }, sizes[4] = { 2, 2, 5, 2 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
	gl_call(&gl, "glEnableClientState", "e", GL_POINT_SIZE_ARRAY_OES);
	gl_call(&gl, "glVertexPointer", "ieib", 2, GL_FLOAT, 0, sizeof(at), at);
	gl_call(&gl, "glPointSizePointerOES", "eib", GL_FLOAT, 0, sizeof(sizes), sizes);
	gl_call(&gl, "glDrawArrays", "eii", GL_POINTS, 0, 4);
	gl_call(&gl, "glDrawArrays", "eii", GL_LINES, 0, 4);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 4);
	for (unsigned i = 0; i < 4; i++)
		ck_assert_floats(1, &s->materials[s->instances[i].material].point_size, i == 3 ? 1 : sizes[i + (i > 0)]);
	ck_assert_uint_eq(s->meshes[s->instances[0].mesh]->primitive_count, 2);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* OES_compressed_paletted_texture: all levels after one palette; each level starts at a whole byte. */
START_TEST(test_palette)
{
	uint8_t image[16 * 4 + 2 + 1 + 1] = { 0 };
	struct gl gl = gl_open();
	struct scene *s;

	for (int i = 0; i < 16; i++)
		image[4 * i] = (uint8_t)(10 * i);
	memcpy(image + 64, (const uint8_t[]){ 0x12, 0x34, 0x56, 0x70 }, 4); /* 2 x 2 takes two bytes; then 1 x 1 */
	gl_call(&gl, "glCompressedTexImage2D", "eieiiiib", GL_TEXTURE_2D, -1, GL_PALETTE4_RGBA8_OES, 2, 2, 0, 67,
	        sizeof(image) - 1, image);
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	ck_assert_uint_eq(gl_error(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_uint_eq(s->textures[0]->n_levels, 2);
	for (unsigned i = 0; i < 4; i++)
		ck_assert_uint_eq(s->textures[0]->texels[4 * i], 10 * (i + 1));
	ck_assert_uint_eq(s->textures[0]->texels[16], 50);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

GL_TESTS("es", test_fixed, test_generation, test_draw_texture, test_rectangle_without_level, test_point_sizes,
         test_palette)
