/* The same calls under later versions of Mesa: a marker names the version, and scenes follow it (scene/mesa.h). */
#include "scene/mesa.h"
#include "tests/gl/gl.h"

#define BEFORE "relume:gl 4.5 (Compatibility Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)"
#define AFTER "relume:gl 4.5 (Compatibility Profile) Mesa 25.0.7-2+deb13u1, llvmpipe (LLVM 19.1.7, 256 bits)"

static const char *const markers[2] = { BEFORE, AFTER };

static struct gl open_by(const char *marker)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, marker);
	return gl;
}

/* Bitmaps under COLOR_SUM: no sum, or that of the current secondary colour instead of the raster position's. */
START_TEST(test_bitmaps)
{
	static const uint8_t bits[8] = { 0xff, 0, 0, 0, 0xff, 0, 0, 0 };

	for (int i = 0; i < 2; i++) {
		struct gl gl = open_by(markers[i]);
		struct scene *s;

		gl_call(&gl, "glSecondaryColor3f", "fff", 0.5, 0.25, 0.0);
		gl_call(&gl, "glRasterPos2f", "ff", 0.0, 0.0);
		gl_call(&gl, "glSecondaryColor3f", "fff", 0.125, 0.75, 1.0);
		gl_call(&gl, "glEnable", "e", GL_COLOR_SUM);
		gl_call(&gl, "glBitmap", "iiffffb", 8, 2, 0.0, 0.0, 0.0, 0.0, sizeof(bits), bits);
		s = gl_swap(&gl);
		ck_assert_uint_eq(s->n_instances, 1);
		ck_assert_uint_eq(s->materials[s->instances[0].material].color_sum, (unsigned)i);
		ck_assert_float_eq(s->currents[s->instances[0].current].secondary[1], i ? 0.75f : 0.25f);
		ck_assert_uint_eq(s->mesa != 0, (unsigned)i);
		scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

/* Bitmaps of no pixels at NULL in lists: left out with an error, or kept. */
START_TEST(test_blanks)
{
	for (int i = 0; i < 2; i++) {
		struct gl gl = open_by(markers[i]);

		gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
		gl_call(&gl, "glBitmap", "iiffffp", 0, 0, 0.0, 0.0, 10.0, 0.0, (uint64_t)0);
		gl_call(&gl, "glEndList", "");
		ck_assert_uint_eq(gl_error(&gl), i ? GL_NO_ERROR : GL_OUT_OF_MEMORY);
		gl_close(&gl);
	}
}
END_TEST

/* Flat shading under an assembly program: by its own colours only; quads are split along the other diagonal if it
 * reads any. */
START_TEST(test_flat_programs)
{
	static const char *const texts[2] = { "!!ARBfp1.0\nMOV result.color, fragment.texcoord[0];\nEND\n",
		                              "!!ARBfp1.0\nMOV result.color, fragment.color;\nEND\n" };
	static const float corners[4][2] = { { -0.5f, -0.5f }, { 0.5f, -0.5f }, { 0.5f, 0.5f }, { -0.5f, 0.5f } };
	uint32_t third[2][2];

	for (int i = 0; i < 2; i++)
		for (int reads = 0; reads < 2; reads++) {
			struct gl gl = open_by(markers[i]);
			const struct scene_mesh *mesh;
			struct scene *s;

			gl_call(&gl, "glBindProgramARB", "eu", GL_FRAGMENT_PROGRAM_ARB, 1u);
			gl_call(&gl, "glProgramStringARB", "eeus", GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB,
			        (unsigned)strlen(texts[reads]), texts[reads]);
			gl_call(&gl, "glEnable", "e", GL_FRAGMENT_PROGRAM_ARB);
			gl_call(&gl, "glShadeModel", "e", GL_FLAT);
			gl_call(&gl, "glBegin", "e", GL_QUADS);
			for (int k = 0; k < 4; k++)
				gl_call(&gl, "glVertex2f", "ff", (double)corners[k][0], (double)corners[k][1]);
			gl_call(&gl, "glEnd", "");
			s = gl_swap(&gl);
			ck_assert_uint_eq(s->n_instances, 1);
			ck_assert_uint_eq(s->materials[s->instances[0].material].shade_model, i ? GL_FLAT : GL_SMOOTH);
			mesh = s->meshes[s->instances[0].mesh];
			ck_assert_uint_eq(mesh->primitive_count, 2);
			third[i][reads] = mesh->index[0] * 100 + mesh->index[1] * 10 + mesh->index[2];
			scene_release(&s);
			gl_close(&gl);
		}
	ck_assert_uint_eq(third[0][0], third[0][1]);
	ck_assert_uint_eq(third[1][0], third[0][0]);
	ck_assert_uint_ne(third[1][1], third[0][1]);
}
END_TEST

/* YCbCr textures: their format is refused, and the texture has no image. */
START_TEST(test_ycbcr)
{
	static const uint8_t texels[8] = { 200, 90, 60, 160, 30, 90, 120, 160 };

	for (int i = 0; i < 2; i++) {
		struct gl gl = open_by(markers[i]);

		gl_call(&gl, "glTexImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, GL_YCBCR_MESA, 2, 2, 0, GL_YCBCR_MESA,
		        GL_UNSIGNED_SHORT_8_8_MESA, sizeof(texels), texels);
		ck_assert_uint_eq(gl_error(&gl), i ? GL_INVALID_ENUM : 0);
		gl_call(&gl, "glTexSubImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RGB, GL_UNSIGNED_BYTE,
		        sizeof(texels), texels);
		ck_assert_uint_eq(gl_error(&gl), i ? GL_INVALID_OPERATION : 0);
		gl_call(&gl, "glTexImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, GL_YCBCR_MESA, 1, 1, 0, GL_RGB,
		        GL_UNSIGNED_BYTE, sizeof(texels), texels);
		ck_assert_uint_eq(gl_error(&gl), i ? GL_INVALID_VALUE : 0);
		gl_close(&gl);
	}
}
END_TEST

GL_TESTS("mesa", test_bitmaps, test_blanks, test_flat_programs, test_ycbcr)
