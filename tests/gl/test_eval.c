/* Evaluators: curves, surfaces, grids and meshes (GL 2.1 sec. 5.1). */
#include "base/err.h"
#include "replay/index/snapshot.h"
#include "tests/gl/gl.h"
#include "base/bytes.h"

static const float arc[9] = { 0, 0, 0, 1, 2, 0, 2, 0, 0 };

/* A curve's points follow its Bernstein polynomials over [u1, u2], strides skip numbers, and current values are
 * unchanged. */
START_TEST(test_curve)
{
	static const float spaced[15] = { 0, 0, 0, 9, 9, 1, 2, 0, 9, 9, 2, 0, 0, 9, 9 };

	for (int how = 0; how < 2; how++) {
		struct gl gl = gl_open();
		struct scene *s;
		const float *p;

		if (how)
			gl_call(&gl, "glMap1f", "effuuF", GL_MAP1_VERTEX_3, 2.0, 4.0, 5, 3, 15, spaced);
		else
			gl_call(&gl, "glMap1d", "edduuF", GL_MAP1_VERTEX_3, 2.0, 4.0, 3, 3, 9, arc);
		gl_call(&gl, "glEnable", "e", GL_MAP1_VERTEX_3);
		gl_call(&gl, "glEnable", "e", GL_MAP1_COLOR_4);
		gl_call(&gl, "glColor3f", "fff", 0.5, 0.25, 0.125);
		gl_call(&gl, "glBegin", "e", GL_LINE_STRIP);
		gl_call(&gl, "glEvalCoord1f", "f", 2.0);
		gl_call(&gl, "glEvalCoord1d", "d", 3.0);
		gl_call(&gl, "glEvalCoord1f", "f", 4.0);
		gl_call(&gl, "glEnd", "");
		ck_assert_floats(3, gl_state(&gl)->a.current.attribute[GLS_ATTR_COLOR], 0.5f, 0.25f, 0.125f);
		s = gl_swap(&gl);
		p = s->meshes[0]->position;
		ck_assert_floats(4, p, 0, 0, 0, 1);
		ck_assert_floats(4, p + 4, 1, 1, 0, 1);
		ck_assert_floats(4, p + 8, 2, 0, 0, 1);
		ck_assert_floats(4, s->currents[s->instances[0].current].color, 1, 1, 1, 1); /* the map's initial constant */
		ck_assert_uint_eq(gl_unsupported(&gl), 0);
		scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

/* A mesh over a grid: triangle strips, generated normals, texture coordinates by the map with most components. */
START_TEST(test_surface)
{
	static const float plane[12] = { 0, 0, 1, 0, 2, 1, 2, 0, 1, 2, 2, 1 }, coordinates[8] = { 0, 0, 0, 1, 1, 0, 1, 1 };
	struct gl gl = gl_open();
	const struct scene_mesh *m;
	struct scene *s;

	gl_call(&gl, "glMap2f", "effuuffuuF", GL_MAP2_VERTEX_3, 0.0, 1.0, 6, 2, 0.0, 1.0, 3, 2, 12, plane);
	gl_call(&gl, "glMap2f", "effuuffuuF", GL_MAP2_TEXTURE_COORD_2, 0.0, 1.0, 4, 2, 0.0, 1.0, 2, 2, 8, coordinates);
	gl_call(&gl, "glEnable", "e", GL_MAP2_VERTEX_3);
	gl_call(&gl, "glEnable", "e", GL_MAP2_TEXTURE_COORD_1);
	gl_call(&gl, "glEnable", "e", GL_MAP2_TEXTURE_COORD_2);
	gl_call(&gl, "glEnable", "e", GL_AUTO_NORMAL);
	gl_call(&gl, "glNormal3f", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glMapGrid2f", "iffiff", 4, 0.0, 1.0, 2, 0.0, 1.0);
	gl_call(&gl, "glEvalMesh2", "eiiii", GL_FILL, 1, 4, 0, 2);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	m = s->meshes[0];
	ck_assert_uint_eq(m->vertex_count, 16);
	ck_assert_uint_eq(m->primitive_count, 12);
	ck_assert_floats(4, m->position, 0.5f, 0, 1, 1);
	ck_assert_floats(4, m->position + 4, 0.5f, 1, 1, 1);
	ck_assert_floats(4, m->position + 60, 2, 2, 1, 1);
	ck_assert_floats(3, s->currents[s->instances[0].current].normal, 0, 0, 1);
	ck_assert_floats(4, m->texcoord[0] + 60, 1, 1, 0, 1);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

START_TEST(test_errors)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glMap1f", "effuuF", GL_MAP2_VERTEX_3, 0.0, 1.0, 3, 3, 9, arc);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glMap1f", "effuuF", GL_MAP1_VERTEX_3, 1.0, 1.0, 3, 3, 9, arc);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glMap1f", "effuuF", GL_MAP1_VERTEX_3, 0.0, 1.0, 2, 3, 9, arc);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glMap1f", "effuuF", GL_MAP1_VERTEX_3, 0.0, 1.0, 3, 31, 9, arc);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glMapGrid1f", "iff", 0, 0.0, 1.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glEvalMesh1", "eii", GL_FILL, 0, 1);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	for (int i = 0; i < 6; i++) /* four times 2^20 points is the maximum */
		gl_call(&gl, "glEvalMesh2", "eiiii", GL_LINE, 1, 1024, 1, 1024);
	ck_assert_uint_eq(gl_unsupported(&gl), 2);
	/* as in a damaged recording: must end */
	gl_call(&gl, "glEvalMesh1", "epp", GL_LINE, (uint64_t)INT64_MAX - 1, (uint64_t)INT64_MAX);
	gl_call(&gl, "glEvalMesh2", "epppp", GL_LINE, (uint64_t)INT64_MAX, (uint64_t)INT64_MAX, (uint64_t)INT64_MAX,
	        (uint64_t)INT64_MAX);
	gl_close(&gl);
}
END_TEST

static int no_blob(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data;
	ck_abort_msg("%zu bytes kept apart", n);
	return 0;
}

/* Maps are part of a checkpoint: after restoring, evaluation is the same; invalid bytes are refused. */
START_TEST(test_checkpoint)
{
	const struct snapshot_blobs blobs = { .put = no_blob };
	struct gl gl = gl_open(), other = { 0 };
	struct bytes saved = { 0 }, again = { 0 };
	struct scene *s;

	gl_call(&gl, "glMap1f", "effuuF", GL_MAP1_VERTEX_3, 2.0, 4.0, 3, 3, 9, arc);
	gl_call(&gl, "glMap2f", "effuuffuuF", GL_MAP2_INDEX, 0.0, 1.0, 1, 1, 0.0, 1.0, 1, 1, 1, arc);
	gl_call(&gl, "glEnable", "e", GL_MAP1_VERTEX_3);
	s = gl_swap(&gl);
	scene_release(&s);
	ck_assert_int_eq(snapshot_save(gl.x, &blobs, &saved), 0);
	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	ck_assert_int_eq(snapshot_load(other.x, &blobs, saved.data, saved.n), 0);
	ck_assert_int_eq(snapshot_save(other.x, &blobs, &again), 0);
	ck_assert_uint_eq(saved.n, again.n);
	ck_assert_int_eq(memcmp(saved.data, again.data, saved.n), 0);
	other.x->want = 1;
	gl_call(&other, "glBegin", "e", GL_POINTS);
	gl_call(&other, "glEvalCoord1f", "f", 3.0);
	gl_call(&other, "glEnd", "");
	s = gl_swap(&other);
	ck_assert_uint_eq(s->n_meshes, 1);
	ck_assert_floats(4, s->meshes[0]->position, 1, 1, 0, 1);
	scene_release(&s);
	gl_close(&other);
	for (size_t n = saved.n - 200; n < saved.n; n += 7) { /* truncated within the maps and after them */
		ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
		ck_assert_int_eq(snapshot_load(other.x, &blobs, saved.data, n), ERR_INPUT);
		gl_close(&other);
	}
	free(saved.data);
	free(again.data);
	gl_close(&gl);
}
END_TEST

GL_TESTS("eval", test_curve, test_surface, test_errors, test_checkpoint)
