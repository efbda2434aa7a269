/*
 * Damaged checkpoints: numbers that serve as indices of arrays are refused if out of range (replay/index/snapshot.h).
 */
#include "replay/index/snapshot.h"
#include "base/bytes.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/frames.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/programs/program.h"
#include "tests/gl/gl.h"

static int keep_none(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data, (void)n;
	return 0;
}

static uint8_t *find_none(void *user, const uint64_t name[2], size_t n)
{
	(void)user, (void)name, (void)n;
	return NULL;
}

static const struct snapshot_blobs blobs = { .put = keep_none, .get = find_none };

static int load(const struct bytes *saved)
{
	struct gl other = { 0 };
	int err;

	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	err = snapshot_load(other.x, &blobs, saved->data, saved->n);
	gls_exec_destroy(&other.x);
	return err;
}

/* The state of a texture unit, found by its unique colour. */
static struct scene_unit *unit_with(struct bytes *saved, const float color[4], unsigned nth)
{
	const size_t at = offsetof(struct scene_unit, env_color);

	for (size_t i = at; i + sizeof(struct scene_unit) - at <= saved->n; i++)
		if (memcmp(saved->data + i, color, 16) == 0 && nth-- == 0)
			return (struct scene_unit *)(void *)(saved->data + i - at);
	ck_abort_msg("no such unit");
}

/* A unit's own number, in the current state and on the attribute stack. */
START_TEST(units_with_other_numbers)
{
	static const float color[4] = { 0.123f, 0.456f, 0.789f, 0.321f };
	struct gl gl = gl_open();
	struct bytes saved = { 0 };

	gl_call(&gl, "glActiveTexture", "e", GL_TEXTURE2);
	gl_call(&gl, "glTexEnvfv", "eeF", GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, 4, color);
	gl_call(&gl, "glPushAttrib", "m", GL_TEXTURE_BIT);
	ck_assert_int_eq(snapshot_save(gl.x, &blobs, &saved), 0);
	ck_assert_int_eq(load(&saved), 0);
	for (unsigned nth = 0; nth < 2; nth++) {
		uint8_t *number = (uint8_t *)unit_with(&saved, color, nth) + offsetof(struct scene_unit, unit), was[4];

		memcpy(was, number, 4);
		memcpy(number, "\xcd\x0d\xf6\xc6", 4);
		ck_assert_int_ne(load(&saved), 0);
		memcpy(number, was, 4);
		ck_assert_int_eq(load(&saved), 0);
	}
	free(saved.data);
	gl_close(&gl);
}
END_TEST

/* A program's parameters and their count. */
START_TEST(parameters_of_programs)
{
	static const float four[4] = { 0.123f, 0.456f, 0.789f, 0.321f };
	struct gl gl = gl_open(), other = { 0 };
	const struct gls_program *p;
	struct bytes saved = { 0 };
	uint8_t *at;

	gl_call(&gl, "glBindProgramARB", "eu", GL_VERTEX_PROGRAM_ARB, 5u);
	gl_call(&gl, "glProgramLocalParameter4fvARB", "euF", GL_VERTEX_PROGRAM_ARB, 1020u, 4, four);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	ck_assert_int_eq(snapshot_save(gl.x, &blobs, &saved), 0);
	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	ck_assert_int_eq(snapshot_load(other.x, &blobs, saved.data, saved.n), 0);
	p = gls_program_bound(gl_state(&other), GL_VERTEX_PROGRAM_ARB);
	ck_assert_uint_eq(p->n_locals, 1021);
	ck_assert_floats(4, p->local[1020], four[0], four[1], four[2], four[3]);
	ck_assert_floats(4, p->local[1019], 0, 0, 0, 0);
	gls_exec_destroy(&other.x);
	at = memmem(saved.data, saved.n, four, sizeof(four));
	ck_assert_ptr_nonnull(at);
	at -= 1020 * sizeof(four) + 8;
	memcpy(at, &(uint64_t){ GLS_MAX_PROGRAM_LOCALS + 1 }, 8);
	ck_assert_int_ne(load(&saved), 0);
	free(saved.data);
	gl_close(&gl);
}
END_TEST

/* The recorded library's way of rounding sums, one of two. */
START_TEST(ways_to_sum)
{
	static const float four[4] = { 0.123f, 0.456f, 0.789f, 0.321f };
	struct gl gl = gl_open();
	struct bytes saved = { 0 };
	uint8_t *at;

	gl_call(&gl, "glProgramEnvParameter4fvARB", "euF", GL_VERTEX_PROGRAM_ARB, 0u, 4, four);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	ck_assert_int_eq(snapshot_save(gl.x, &blobs, &saved), 0);
	at = memmem(saved.data, saved.n, four, sizeof(four));
	ck_assert_ptr_nonnull(at);
	at += offsetof(struct gls_state, x87) - offsetof(struct gls_state, program_env[1]);
	for (uint32_t way = 0; way < 4; way++) {
		memcpy(at, &way, sizeof(way));
		ck_assert_int_eq(load(&saved) == 0, way < 2);
	}
	free(saved.data);
	gl_close(&gl);
}
END_TEST

/* Pictures have a window's size, so a size that is too large is refused. */
START_TEST(sizes_of_windows)
{
	static const uint64_t size[2] = { 1234, 567 };
	struct gl gl = gl_open();
	struct bytes saved = { 0 };
	uint8_t *at;

	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:drawable 1234 567");
	ck_assert_int_eq(snapshot_save(gl.x, &blobs, &saved), 0);
	ck_assert_int_eq(load(&saved), 0);
	at = memmem(saved.data, saved.n, size, sizeof(size));
	ck_assert_ptr_nonnull(at);
	memcpy(at + 8, &(uint64_t){ 1u << 31 }, 8);
	ck_assert_int_ne(load(&saved), 0);
	free(saved.data);
	gl_close(&gl);
}
END_TEST

/* Blobs in memory. */
struct store {
	struct {
		uint64_t name[2];
		uint8_t *data;
		size_t n;
	} blobs[64];
	int n;
};

static int keep(void *user, const uint64_t name[2], const void *data, size_t n)
{
	struct store *s = user;

	for (int i = 0; i < s->n; i++)
		if (memcmp(s->blobs[i].name, name, 16) == 0)
			return 0;
	ck_assert_int_lt(s->n, 64);
	memcpy(s->blobs[s->n].name, name, 16);
	s->blobs[s->n].data = memcpy(malloc(n + 1), data, n);
	s->blobs[s->n++].n = n;
	return 0;
}

static uint8_t *find_kept(void *user, const uint64_t name[2], size_t n)
{
	struct store *s = user;

	for (int i = 0; i < s->n; i++)
		if (memcmp(s->blobs[i].name, name, 16) == 0 && s->blobs[i].n == n)
			return memcpy(malloc(n + 1), s->blobs[i].data, n);
	return NULL;
}

static void drop(struct store *s)
{
	for (int i = 0; i < s->n; i++)
		free(s->blobs[i].data);
}

/* A texture's texels must have one of the known formats. */
START_TEST(formats_of_levels)
{
	const uint32_t level[] = { 3, 5, 1, 0, GL_RGBA8 };
	const uint8_t texels[3 * 5 * 4] = { 0 };
	struct store store = { 0 };
	const struct snapshot_blobs in_memory = { .put = keep, .get = find_kept, .user = &store };
	struct gl gl = gl_open();
	struct bytes saved = { 0 };
	uint8_t *at;

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGBA8, 3, 5, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        sizeof(texels), texels);
	ck_assert_int_eq(snapshot_save(gl.x, &in_memory, &saved), 0);
	at = memmem(saved.data, saved.n, level, sizeof(level));
	ck_assert_ptr_nonnull(at);
	for (uint32_t i = 0; i < 2; i++) {
		struct gl other = { 0 };

		ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
		ck_assert_int_eq(snapshot_load(other.x, &in_memory, saved.data, saved.n) == 0, i == 0);
		gls_exec_destroy(&other.x);
		memcpy(at + 16, &(uint32_t){ GL_TEXTURE_2D }, 4);
	}
	drop(&store);
	free(saved.data);
	gl_close(&gl);
}
END_TEST

/* A program whose only text was refused has none; one whose text the GL accepted after all has a reason. */
START_TEST(refused_programs)
{
	static const char text[] = "!!ARBvp1.0";
	struct store store = { 0 };
	const struct snapshot_blobs in_memory = { .put = keep, .get = find_kept, .user = &store };
	struct gl gl = gl_open(), other = { 0 };
	const struct gls_program *p;
	struct bytes saved = { 0 };

	gl_call(&gl, "glBindProgramARB", "eu", GL_VERTEX_PROGRAM_ARB, 5u);
	gl_call(&gl, "glProgramStringARB", "eeus", GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB,
	        (unsigned)strlen(text), text);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glBindProgramARB", "eu", GL_FRAGMENT_PROGRAM_ARB, 6u);
	gl_call(&gl, "glProgramStringARB", "eeus", GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB,
	        (unsigned)strlen(text), text);
	gl_answered(&gl, GL_NO_ERROR, "glGetError", "");
	ck_assert_int_eq(snapshot_save(gl.x, &in_memory, &saved), 0);
	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	ck_assert_int_eq(snapshot_load(other.x, &in_memory, saved.data, saved.n), 0);
	p = gls_program_bound(gl_state(&other), GL_VERTEX_PROGRAM_ARB);
	ck_assert_ptr_nonnull(p);
	ck_assert_ptr_null(p->source);
	ck_assert_ptr_null(p->why);
	p = gls_program_bound(gl_state(&other), GL_FRAGMENT_PROGRAM_ARB);
	ck_assert_uint_eq(p->source_bytes, strlen(text));
	ck_assert_str_eq(p->why, gls_program_bound(gl_state(&gl), GL_FRAGMENT_PROGRAM_ARB)->why);
	gls_exec_destroy(&other.x);
	drop(&store);
	free(saved.data);
	gl_close(&gl);
}
END_TEST

/* A different colour for each pixel. */
static int paint(void *user, const struct scene *scene, struct scene_picture *picture)
{
	const uint32_t n = scene->width * scene->height;

	(void)user;
	for (uint32_t i = 0; i < n; i++) {
		memcpy(picture->rgba + 4 * i, &i, 4);
		picture->depth[i] = i;
		picture->stencil[i] = (uint8_t)i;
	}
	return 0;
}

static struct gls_surface *window(struct gl *gl)
{
	return &((struct gls_drawable *)gls_drawable_of(gl->x, 7))->surface;
}

/* A window and a renderbuffer with their pixels. The planes have their sizes. */
START_TEST(pixels)
{
	struct store store = { 0 };
	const struct snapshot_blobs in_memory = { .put = keep, .get = find_kept, .user = &store };
	struct gl gl = gl_open(), other = { 0 };
	const struct gls_renderbuffer *r;
	struct bytes saved = { 0 };
	uint32_t size;

	gl.x->feedback.supply = paint;
	gl.x->want = 1;
	gl_call(&gl, "glStringMarkerGREMEDY", "is", 0, "relume:drawable 16 8");
	gl_call(&gl, "glBindRenderbufferEXT", "eu", GL_RENDERBUFFER_EXT, 3u);
	gl_call(&gl, "glRenderbufferStorageEXT", "eeii", GL_RENDERBUFFER_EXT, GL_RGBA8, 16, 8);
	gl_call(&gl, "glBindFramebufferEXT", "eu", GL_FRAMEBUFFER_EXT, 4u);
	gl_call(&gl, "glFramebufferRenderbufferEXT", "eeeu", GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT,
	        GL_RENDERBUFFER_EXT, 3u);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	ck_assert_int_eq(gls_frame_settle(gl.x), 0); /* pending */
	gl_call(&gl, "glCopyTexImage2D", "eieiiiii", GL_TEXTURE_2D, 0, GL_RGBA, 0, 0, 16, 8, 0);
	gl_call(&gl, "glBindFramebufferEXT", "eu", GL_FRAMEBUFFER_EXT, 0u);
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	ck_assert_int_eq(gls_frame_settle(gl.x), 0); /* the frame continues */
	gl_call(&gl, "glXSwapBuffers", "pu", (uint64_t)1, 7u);
	gls_frame_defer(gl.x);
	ck_assert_int_eq(gls_frame_settle(gl.x), 1);
	ck_assert_int_eq(snapshot_save_pixels(gl.x, &in_memory, &saved), 0);
	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	ck_assert_int_eq(snapshot_load(other.x, &in_memory, saved.data, saved.n), 0);
	ck_assert_int_eq(window(&other)->skipped, 0);
	ck_assert_mem_eq(window(&other)->picture->picture.depth, window(&gl)->picture->picture.depth, 16 * 8 * 4);
	memcpy(&size, window(&other)->picture->picture.rgba + 4 * 77, 4);
	ck_assert_uint_eq(size, 77);
	r = table_find(&gl_state(&other)->share->renderbuffers, 3);
	ck_assert_ptr_nonnull(r->content);
	memcpy(&size, r->content->picture.rgba + 4 * 77, 4);
	ck_assert_uint_eq(size, 77);
	gls_exec_destroy(&other.x);
	for (int i = 0; i < store.n; i++) { /* each plane is requested */
		const size_t n = store.blobs[i].n;

		store.blobs[i].n--;
		ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
		ck_assert_int_ne(snapshot_load(other.x, &in_memory, saved.data, saved.n), 0);
		gls_exec_destroy(&other.x);
		store.blobs[i].n = n;
	}
	/* Without its pixels the frame counts as skipped. */
	free(saved.data);
	saved = (struct bytes){ 0 };
	ck_assert_int_eq(snapshot_save(gl.x, &in_memory, &saved), 0);
	ck_assert_int_eq(gls_exec_create(&other.x, "other"), 0);
	ck_assert_int_eq(snapshot_load(other.x, &in_memory, saved.data, saved.n), 0);
	ck_assert_int_eq(window(&other)->skipped, 1);
	gls_exec_destroy(&other.x);
	drop(&store);
	free(saved.data);
	gl_close(&gl);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("snapshots");

	tcase_add_test(tcase, units_with_other_numbers);
	tcase_add_test(tcase, parameters_of_programs);
	tcase_add_test(tcase, ways_to_sum);
	tcase_add_test(tcase, sizes_of_windows);
	tcase_add_test(tcase, formats_of_levels);
	tcase_add_test(tcase, refused_programs);
	tcase_add_test(tcase, pixels);
	return run_case(tcase, "snapshots");
}
