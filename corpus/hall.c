/*
 * A generated vaulted hall between two rows of fluted columns, with exactly 262,267 triangles, as many as the Sponza
 * model used for comparing ray tracers. Textured, mipmapped, two lights, indexed arrays (--vbo: in buffer objects).
 *
 *   cc -o hall corpus/hall.c -lglut -lGLU -lGL -lm
 */
#include "hall.h"
#include "program.h"

enum { TEXTURE_SIZE = 128 };

/** A pseudo-random number in [0,1], always the same for the same place. */
static float noise(unsigned x, unsigned y)
{
	unsigned h = x * 374761393u + y * 668265263u;

	h = (h ^ (h >> 13)) * 1274126177u;
	return (float)((h ^ (h >> 16)) & 0xffff) / 65535.0f;
}

static float texel_brightness(enum part where, unsigned x, unsigned y)
{
	unsigned row = y / 32, shifted = (x + (row & 1 ? 32 : 0)) % TEXTURE_SIZE;

	switch (where) {
	case PART_FLOOR:
		return (x / 64 + y / 64) & 1 ? 0.45f + 0.05f * noise(x, y) : 0.85f + 0.1f * noise(x, y);
	case PART_STONE: /* blocks with joints */
		if (y % 32 < 2 || shifted % 64 < 2)
			return 0.4f;
		return 0.65f + 0.1f * noise(shifted / 64, row) + 0.1f * noise(x, y);
	default: /* veins */
		return 0.8f + 0.12f * sinf(0.2f * (float)x + 4 * sinf(turn * (float)y / TEXTURE_SIZE)) + 0.05f * noise(x, y);
	}
}

static GLuint textures[N_PARTS], buffers[N_PARTS][2];

static void make_texture(enum part where)
{
	static const float tints[N_PARTS][3] = { { 0.9f, 0.8f, 0.7f }, { 0.95f, 0.88f, 0.75f }, { 1, 0.98f, 0.95f } };
	static GLubyte texels[TEXTURE_SIZE][TEXTURE_SIZE][3];

	for (unsigned y = 0; y < TEXTURE_SIZE; y++)
		for (unsigned x = 0; x < TEXTURE_SIZE; x++)
			for (int k = 0; k < 3; k++)
				texels[y][x][k] = (GLubyte)(255 * fminf(1, tints[where][k] * texel_brightness(where, x, y)));
	glGenTextures(1, &textures[where]);
	glBindTexture(GL_TEXTURE_2D, textures[where]);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, TEXTURE_SIZE, TEXTURE_SIZE, GL_RGB, GL_UNSIGNED_BYTE, texels);
}

static void fill_buffers(enum part where)
{
	const struct part_mesh *part = &parts[where];

	glGenBuffers(2, buffers[where]);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[where][0]);
	glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(part->n_vertices * sizeof(*part->vertices)), part->vertices,
	             GL_STATIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[where][1]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(part->n_indices * sizeof(*part->indices)), part->indices,
	             GL_STATIC_DRAW);
}

static void init(void)
{
	build_hall();
	for (int i = 0; i < N_PARTS; i++) {
		make_texture((enum part)i);
		if (program.vbo)
			fill_buffers(i);
	}
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHT1);
	glLightfv(GL_LIGHT0, GL_DIFFUSE, (const float[]){ 0.9f, 0.8f, 0.65f, 1 });
	glLightfv(GL_LIGHT1, GL_DIFFUSE, (const float[]){ 0.25f, 0.3f, 0.4f, 1 });
	glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.03f);
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 1, 1, 1, 1 });
	program_perspective(60, 0.2, 100);
}

static void draw_part(enum part where)
{
	const struct part_mesh *part = &parts[where];
	const char *base = program.vbo ? NULL : (const char *)part->vertices;

	if (program.vbo) {
		glBindBuffer(GL_ARRAY_BUFFER, buffers[where][0]);
		glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[where][1]);
	}
	glBindTexture(GL_TEXTURE_2D, textures[where]);
	glInterleavedArrays(GL_T2F_N3F_V3F, sizeof(struct vertex), base);
	glDrawElements(GL_TRIANGLES, (GLsizei)part->n_indices, GL_UNSIGNED_INT, program.vbo ? NULL : part->indices);
}

static void draw(void)
{
	float walk = program_moved(program.animate_camera, 0.05f), swing = program_moved(program.animate_light, 0.05f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(1.5 * sinf(walk), 2.2, 13 - 4 * walk, 0, 2.4, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 2 + 3 * sinf(swing), 6, 4, 1 });
	glLightfv(GL_LIGHT1, GL_POSITION, (const float[]){ 0, 4, 20, 1 });
	for (int i = 0; i < N_PARTS; i++)
		draw_part(i);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "hall", init, draw);
	return 0;
}
