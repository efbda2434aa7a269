/* Draws a level: textures, walls in each kind of lighting, frames. */
#define GL_GLEXT_PROTOTYPES
#include "draw.h"

#include <GL/glu.h>
#include <GL/glext.h>
#include <math.h>
#include <stdlib.h>

enum { TEXELS = 64 };
/* Largest distance in metres between vertices whose colours hold light. */
#define COLORS_APART 1.0

static GLuint textures[N_TEXTURES + 1], *map_names;

/* --- Textures ---------------------------------------------------------------------------------------------------- */

/* A pseudo-random number in [0,1], always the same for the same place. */
static double noise(unsigned x, unsigned y)
{
	unsigned h = x * 374761393u + y * 668265263u;

	h = (h ^ (h >> 13)) * 1274126177u;
	return (double)((h ^ (h >> 16)) & 0xffff) / 65535;
}

static double brightness_of(int texture, unsigned x, unsigned y)
{
	switch (texture) {
	case 0: /* bricks */
		return y % 16 < 2 || (x + y / 16 % 2 * 16) % 32 < 2 ? 0.45 : 0.7 + 0.2 * noise((x + y / 16 % 2 * 16) / 32, y / 16);
	case 1: /* tiles */
		return (x / 32 + y / 32) % 2 ? 0.9 : 0.5;
	case 2: /* planks */
		return x % 16 < 1 ? 0.3 : 0.6 + 0.15 * noise(x / 16, 0) + 0.1 * noise(x, y / 8);
	case 3: /* plaster */
		return 0.8 + 0.1 * noise(x / 2, y / 2);
	default:
		return 1;
	}
}

static void make_texture(int which)
{
	static const double tints[N_TEXTURES + 1][3] = {
		{ 0.95, 0.55, 0.4 }, { 0.75, 0.8, 0.9 }, { 0.9, 0.7, 0.4 }, { 0.9, 0.9, 0.8 }, { 0.8, 0.85, 0.9 }
	};
	static GLubyte texels[TEXELS][TEXELS][3];

	for (unsigned y = 0; y < TEXELS; y++)
		for (unsigned x = 0; x < TEXELS; x++)
			for (int k = 0; k < 3; k++)
				texels[y][x][k] = (GLubyte)(255 * tints[which][k] * brightness_of(which, x, y));
	glBindTexture(GL_TEXTURE_2D, textures[which]);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, TEXELS, TEXELS, GL_RGB, GL_UNSIGNED_BYTE, texels);
}

static void make_lightmap(struct drawing *d, size_t face)
{
	struct lightmap *map = &d->maps[face];

	bake_face(map, d->level, &d->world->mesh, &d->world->bsp, &d->world->mesh.faces[face]);
	glBindTexture(GL_TEXTURE_2D, map_names[face]);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, (GLsizei)map->width, (GLsizei)map->height, 0, GL_RGB, GL_UNSIGNED_BYTE,
	             map->texels);
}

void draw_init(struct drawing *d)
{
	const struct mesh *mesh = &d->world->mesh;

	d->maps = calloc(mesh->n_faces, sizeof(*d->maps));
	d->visible = calloc(mesh->n_faces, 1);
	map_names = calloc(mesh->n_faces, sizeof(*map_names));
	if (!d->maps || !d->visible || !map_names)
		exit(1);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glGenTextures(N_TEXTURES + 1, textures);
	for (int i = 0; i <= N_TEXTURES; i++)
		make_texture(i);
	glGenTextures((GLsizei)mesh->n_faces, map_names);
	for (size_t i = 0; i < mesh->n_faces && (d->lighting == LIGHTING_MULTITEXTURE || d->lighting == LIGHTING_PASS); i++)
		if (mesh->faces[i].portal == NO_PORTAL)
			make_lightmap(d, i);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glDepthFunc(GL_LEQUAL);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (const float[]){ BAKE_AMBIENT, BAKE_AMBIENT, BAKE_AMBIENT, 1 });
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 1, 1, 1, 1 });
}

/* --- Walls ------------------------------------------------------------------------------------------------------- */

void draw_face_plain(const struct mesh *mesh, const struct face *face)
{
	glBegin(GL_POLYGON);
	for (unsigned k = 0; k < face->n; k++)
		glVertex3dv(&mesh->points[face->v[k]].x);
	glEnd();
}

/* A texture covers two metres of wall; unit 1, or the only unit in a second pass, has the lightmap. */
static void draw_face(const struct drawing *d, size_t which, int base, int lightmap)
{
	const struct mesh *mesh = &d->world->mesh;
	const struct face *face = &mesh->faces[which];
	struct vec u, v;

	vec_frame(face->plane.n, &u, &v);
	glBegin(GL_POLYGON);
	glNormal3dv(&face->plane.n.x);
	for (unsigned k = 0; k < face->n; k++) {
		struct vec p = mesh->points[face->v[k]];
		float st[2];

		if (base)
			glTexCoord2d(0.5 * vec_dot(u, p), 0.5 * vec_dot(v, p));
		if (lightmap) {
			bake_coordinates(&d->maps[which], p, st);
			if (base)
				glMultiTexCoord2fv(GL_TEXTURE1, st);
			else
				glTexCoord2fv(st);
		}
		glVertex3dv(&p.x);
	}
	glEnd();
}

/* A corner of a wall with the light there as colour. */
static void draw_lit_corner(const struct drawing *d, const struct face *face, struct vec p)
{
	GLubyte color[3];
	struct vec u, v;

	vec_frame(face->plane.n, &u, &v);
	bake_point(d->level, &d->world->mesh, &d->world->bsp, face, p, color);
	for (int k = 0; k < 3 && d->lighting != LIGHTING_COLORS; k++)
		color[k] = d->lighting == LIGHTING_WHITE ? 255 : (GLubyte)(140 + 110 * sin(1.7 * p.x + 2.3 * p.y + 1.1 * p.z + k));
	glColor3ubv(color);
	glTexCoord2d(0.5 * vec_dot(u, p), 0.5 * vec_dot(v, p));
	glVertex3dv(&p.x);
}

/* A triangle, halved across its longest edge until that is short enough. */
static void draw_halves(const struct drawing *d, const struct face *face, struct vec a, struct vec b, struct vec c)
{
	const struct vec ab = vec_sub(b, a), bc = vec_sub(c, b), ca = vec_sub(a, c);
	const double x = vec_dot(ab, ab), y = vec_dot(bc, bc), z = vec_dot(ca, ca);

	if (x >= y && x >= z && x > COLORS_APART * COLORS_APART) {
		const struct vec middle = vec_mad(a, ab, 0.5);

		draw_halves(d, face, a, middle, c);
		draw_halves(d, face, middle, b, c);
	} else if (fmax(x, fmax(y, z)) > COLORS_APART * COLORS_APART) {
		draw_halves(d, face, b, c, a);
	} else {
		draw_lit_corner(d, face, a);
		draw_lit_corner(d, face, b);
		draw_lit_corner(d, face, c);
	}
}

static void draw_in_colors(const struct drawing *d, const struct face *face)
{
	const struct mesh *mesh = &d->world->mesh;

	glBegin(GL_TRIANGLES);
	for (unsigned k = 2; k < face->n; k++)
		draw_halves(d, face, mesh->points[face->v[0]], mesh->points[face->v[k - 1]], mesh->points[face->v[k]]);
	glEnd();
	glColor3f(1, 1, 1);
}

/* Draw all visible walls, texture by texture. */
static void draw_walls(const struct drawing *d, const unsigned char *visible, int base, int lightmap)
{
	const struct mesh *mesh = &d->world->mesh;
	const struct face *mirror = d->has_mirror ? draw_mirror_of(mesh) : NULL;

	for (int texture = 0; texture <= N_TEXTURES; texture++) {
		if (base) {
			glActiveTexture(GL_TEXTURE0);
			glBindTexture(GL_TEXTURE_2D, textures[texture]);
		}
		for (size_t i = 0; i < mesh->n_faces; i++) {
			if (mesh->faces[i].portal != NO_PORTAL || mesh->faces[i].texture != texture || (visible && !visible[i]) ||
			    &mesh->faces[i] == mirror)
				continue;
			if (lightmap) {
				glActiveTexture(base ? GL_TEXTURE1 : GL_TEXTURE0);
				glBindTexture(GL_TEXTURE_2D, map_names[i]);
			}
			if (d->lighting == LIGHTING_COLORS || d->lighting == LIGHTING_PAINT || d->lighting == LIGHTING_WHITE)
				draw_in_colors(d, &mesh->faces[i]);
			else
				draw_face(d, i, base, lightmap);
		}
	}
	glActiveTexture(GL_TEXTURE0);
}

static void draw_lit_walls(const struct drawing *d, const unsigned char *visible)
{
	if (d->lighting == LIGHTING_MULTITEXTURE) {
		glActiveTexture(GL_TEXTURE1);
		glEnable(GL_TEXTURE_2D);
		draw_walls(d, visible, 1, 1);
		glActiveTexture(GL_TEXTURE1);
		glDisable(GL_TEXTURE_2D);
		glActiveTexture(GL_TEXTURE0);
	} else if (d->lighting == LIGHTING_PASS) {
		draw_walls(d, visible, 1, 0);
		glEnable(GL_BLEND);
		glBlendFunc(GL_DST_COLOR, GL_ZERO);
		glDepthMask(GL_FALSE);
		glDepthFunc(GL_EQUAL);
		draw_walls(d, visible, 0, 1);
		glDepthFunc(GL_LEQUAL);
		glDepthMask(GL_TRUE);
		glDisable(GL_BLEND);
	} else if (d->lighting != LIGHTING_OPENGL) {
		draw_walls(d, visible, 1, 0);
	} else {
		glEnable(GL_LIGHTING);
		draw_walls(d, visible, 1, 0);
		glDisable(GL_LIGHTING);
	}
}

const struct face *draw_mirror_of(const struct mesh *mesh)
{
	const struct face *mirror = NULL;
	double largest = 0;

	for (size_t i = 0; i < mesh->n_faces; i++) {
		struct winding w = mesh_winding(mesh, &mesh->faces[i]);

		if (mesh->faces[i].portal == NO_PORTAL && mesh->faces[i].texture == TEXTURE_MIRROR && winding_area(&w) > largest) {
			largest = winding_area(&w);
			mirror = &mesh->faces[i];
		}
	}
	return mirror;
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

/* Use the level's lights as OpenGL's, with 1 / d^2 as in the lightmaps. */
static void place_lights(const struct level *level)
{
	for (unsigned i = 0; i < level->n_lights && i < 8; i++) {
		const struct light *l = &level->lights[i];

		glEnable(GL_LIGHT0 + i);
		glLightfv(GL_LIGHT0 + i, GL_POSITION, (const float[]){ (float)l->at.x, (float)l->at.y, (float)l->at.z, 1 });
		glLightfv(GL_LIGHT0 + i, GL_DIFFUSE,
		          (const float[]){ (float)l->color[0], (float)l->color[1], (float)l->color[2], 1 });
		glLightfv(GL_LIGHT0 + i, GL_SPECULAR, (const float[]){ 0, 0, 0, 1 });
		glLightf(GL_LIGHT0 + i, GL_CONSTANT_ATTENUATION, 0);
		glLightf(GL_LIGHT0 + i, GL_QUADRATIC_ATTENUATION, 1);
	}
}

void draw_world(struct drawing *d, const unsigned char *visible, long frame, int with_mirroring_object)
{
	float matrix[16];

	place_lights(d->level);
	glEnable(GL_TEXTURE_2D);
	draw_lit_walls(d, visible);
	if (d->level->n_objects) {
		torus_matrix(d->level, frame, matrix);
		glPushMatrix();
		glMultMatrixf(matrix);
		if (d->lighting != LIGHTING_NONE && d->lighting != LIGHTING_WHITE)
			glEnable(GL_LIGHTING);
		glBindTexture(GL_TEXTURE_2D, textures[1]);
		torus_draw();
		glDisable(GL_LIGHTING);
		glPopMatrix();
	}
	glDisable(GL_TEXTURE_2D);
	if (with_mirroring_object && d->environment != ENVIRONMENT_NONE && d->level->n_objects > 1)
		trick_mirroring_object(d);
}

static void look(const struct view *view)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	gluPerspective(view->field_deg, view->aspect, 0.05, 200);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glRotated(-view->pitch_deg, 1, 0, 0);
	glRotated(view->yaw_deg, 0, 1, 0);
	glTranslated(-view->eye.x, -view->eye.y, -view->eye.z);
}

void draw_frame(struct drawing *d, const struct view *view, long frame)
{
	if (d->environment != ENVIRONMENT_NONE && d->level->n_objects > 1)
		trick_environment(d, view, frame);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	look(view);
	cull(d->world, view, d->culling, d->visible);
	if (d->has_mirror)
		trick_planar_mirror(d, frame);
	draw_world(d, d->visible, frame, 1);
	if (d->has_shadow && d->level->n_objects && d->level->n_lights)
		trick_shadow(d, frame);
}
