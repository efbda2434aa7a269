/*
 * A framebuffer object's picture that reaches the window unchanged becomes the window's scene
 * (replay/gl/surface/shown.h): through a quad with unit 0, or with programs that look up one texture, at coordinates
 * from vertices or from a vertex program. Also cases that prevent it.
 */
#include "replay/play/player.h"
#include "tests/gl/gl.h"

static int paint(void *user, const struct scene *s, struct scene_picture *picture)
{
	(void)user;
	for (size_t i = 0; i < (size_t)s->width * s->height; i++)
		memcpy(picture->rgba + 4 * i, (uint8_t[4]){ 10, 20, 30, 40 }, 4);
	picture->unknown = 0;
	return 0;
}

/* How a quad shows texture 5, which has the window's size and contains a triangle. */
struct showing {
	uint32_t unit;
	const char *vertices, *fragments; /* programs, or NULL */
	float right, most_s;      /* the quad's right side, and its coordinate there: 1, 1 if it shows everything */
	void (*set)(struct gl *); /* sets further state, or NULL */
};

static void begin_to_draw(struct gl *gl)
{
	*gl = gl_open();
	gl->x->feedback.supply = paint;
	gl_call(gl, "glStringMarkerGREMEDY", "is", 0, "relume:bits 8 0 0"); /* like the object: no depth */
	gl_call(gl, "glBindTexture", "ei", GL_TEXTURE_2D, 5);
	gl_call(gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA, 64, 64, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	gl_call(gl, "glBindFramebuffer", "ei", GL_FRAMEBUFFER, 3);
	gl_call(gl, "glFramebufferTexture2D", "eeeii", GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 5, 0);
	gl_call(gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	gl_call(gl, "glBegin", "e", GL_TRIANGLES);
	for (int i = 0; i < 3; i++)
		gl_call(gl, "glVertex2f", "ff", i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0);
	gl_call(gl, "glEnd", "");
	gl_call(gl, "glBindFramebuffer", "ei", GL_FRAMEBUFFER, 0);
}

static void use(struct gl *gl, uint32_t target, const char *program)
{
	if (!program)
		return;
	gl_call(gl, "glProgramStringARB", "eeus", target, GL_PROGRAM_FORMAT_ASCII_ARB, (unsigned)strlen(program), program);
	gl_call(gl, "glEnable", "e", target);
}

/* 1 if the window's scene is the triangle, 0 if it is the quad. */
static int is_shown(const struct showing *how)
{
	const uint32_t unit = GL_TEXTURE0 + how->unit;
	struct scene *s;
	struct gl gl;
	int shown;

	begin_to_draw(&gl);
	gl_call(&gl, "glActiveTexture", "e", unit);
	gl_call(&gl, "glBindTexture", "ei", GL_TEXTURE_2D, 5);
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glTexEnvi", "eee", GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	use(&gl, GL_VERTEX_PROGRAM_ARB, how->vertices);
	use(&gl, GL_FRAGMENT_PROGRAM_ARB, how->fragments);
	if (how->set)
		how->set(&gl);
	gl_call(&gl, "glBegin", "e", GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const int right = i == 1 || i == 2, high = i >= 2;

		gl_call(&gl, "glMultiTexCoord2f", "eff", unit, right ? (double)how->most_s : 0.0, (double)high);
		gl_call(&gl, "glVertex2f", "ff", right ? (double)how->right : -1.0, high ? 1.0 : -1.0);
	}
	gl_call(&gl, "glEnd", "");
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 1);
	shown = s->meshes[s->instances[0].mesh]->vertex_count == 3;
	ck_assert_uint_eq(s->materials[s->instances[0].material].unit_count, !shown);
	scene_release(&s);
	gl_close(&gl);
	return shown;
}

static void blend(struct gl *gl)
{
	gl_call(gl, "glEnable", "e", GL_BLEND);
}

static void generate(struct gl *gl)
{
	gl_call(gl, "glTexGeni", "eee", GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
	gl_call(gl, "glEnable", "e", GL_TEXTURE_GEN_S);
}

static void halve(struct gl *gl)
{
	gl_call(gl, "glMatrixMode", "e", GL_TEXTURE);
	gl_call(gl, "glScalef", "fff", 0.5, 1.0, 1.0);
	gl_call(gl, "glMatrixMode", "e", GL_MODELVIEW);
}

static void keep_targets(struct gl *gl)
{
	struct player player = { .exec = gl->x };

	player_keep_targets(&player);
	ck_assert_int_eq(player.keeps_targets, 1);
}

#define SAME "!!ARBvp1.0 MOV result.position, vertex.position; MOV result.texcoord[0], vertex.texcoord[0]; END"
#define TWICE \
	"!!ARBvp1.0 MOV result.position, vertex.position; ADD result.texcoord[0], vertex.texcoord[0], vertex.texcoord[0]; " \
	"END"
#define LOOK(unit) "!!ARBfp1.0 TEX result.color, fragment.texcoord[" #unit "], texture[" #unit "], 2D; END"
#define PAINT "!!ARBfp1.0 TEMP r; TEX r, fragment.texcoord[0], texture[0], 2D; MUL result.color, r, 0.5; END"

START_TEST(test_quads)
{
	static const struct { struct showing how; int shown; } rows[] = {
		{ { 0, NULL, NULL, 1, 1, NULL }, 1 },
		{ { 0, NULL, LOOK(0), 1, 1, NULL }, 1 },
		{ { 1, NULL, LOOK(1), 1, 1, NULL }, 1 },
		{ { 3, NULL, LOOK(3), 1, 1, NULL }, 1 },
		{ { 0, SAME, LOOK(0), 1, 1, NULL }, 1 },
		{ { 0, TWICE, LOOK(0), 1, 0.5f, NULL }, 0 }, /* both of its coordinates are doubled */
		{ { 0, NULL, PAINT, 1, 1, NULL }, 0 },
		{ { 0, NULL, NULL, 0.5f, 1, NULL }, 0 },
		{ { 0, NULL, NULL, 0.5f, 0.75f, NULL }, 0 },
		{ { 1, NULL, LOOK(1), 1, 0.5f, NULL }, 0 },
		{ { 0, NULL, NULL, 1, 1, blend }, 0 },
		{ { 0, NULL, NULL, 1, 1, generate }, 0 },
		{ { 0, NULL, NULL, 1, 1, halve }, 0 },
		{ { 0, NULL, NULL, 1, 2, halve }, 1 },
		{ { 0, NULL, NULL, 1, 1, keep_targets }, 0 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		ck_assert_msg(is_shown(&rows[i].how) == rows[i].shown, "row %zu: the window's scene is %s", i,
		              rows[i].shown ? "the quad" : "the triangle");
}
END_TEST

/* An object's pixels remain its own, not those of the blit that showed it. */
START_TEST(test_pixels)
{
	static const uint8_t rgba[3][4] = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 } };
	const struct scene_instance *in;
	struct scene *s;
	struct gl gl;

	begin_to_draw(&gl);
	gl_call(&gl, "glBindFramebuffer", "ei", GL_FRAMEBUFFER, 3);
	gl_call(&gl, "glDrawPixels", "iieeb", 3, 1, GL_RGBA, GL_UNSIGNED_BYTE, sizeof(rgba), rgba);
	gl_call(&gl, "glBindFramebuffer", "ei", GL_DRAW_FRAMEBUFFER, 0);
	gl_call(&gl, "glBlitFramebuffer", "iiiiiiiime", 0, 0, 64, 64, 0, 0, 64, 64, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	in = &s->instances[1];
	ck_assert(in->rectangle && in->rectangle <= s->n_rectangles);
	ck_assert_uint_eq(s->rectangles[in->rectangle - 1].width, 3);
	ck_assert_uint_eq(s->textures[s->rectangles[in->rectangle - 1].texture]->width, 3);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

GL_TESTS("shown", test_quads, test_pixels)
