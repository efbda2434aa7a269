/* Effects that replaced traced light: environment maps, a planar mirror, stencil shadows. */
#define GL_GLEXT_PROTOTYPES
#include <GL/glu.h>
#include <GL/glext.h>

#include "draw.h"

/* --- Environment maps -------------------------------------------------------------------------------------------- */

static GLuint cube_map, sphere_map;

static GLuint make_map(GLenum target, GLenum first, int n)
{
	GLuint name;

	glGenTextures(1, &name);
	glBindTexture(target, name);
	glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	for (int i = 0; i < n; i++)
		glTexImage2D(first + (GLenum)i, 0, GL_RGB, ENVIRONMENT_SIZE, ENVIRONMENT_SIZE, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
	return name;
}

/* Inverse of the view's rotation: from eye space to world directions. */
static void turn_texture_matrix(const float view[16])
{
	float m[16] = { 0 };

	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 3; k++)
			m[4 * i + k] = view[4 * k + i];
	m[15] = 1;
	glMatrixMode(GL_TEXTURE);
	glLoadMatrixf(m);
	glMatrixMode(GL_MODELVIEW);
}

/* Paint the cube map on the disc that GL_SPHERE_MAP samples, by the normals of a ball. */
static void paint_sphere_map(const float view[16])
{
	enum { RINGS = 24, SECTORS = 48 };

	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	turn_texture_matrix(view);
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_TEXTURE_CUBE_MAP);
	glBindTexture(GL_TEXTURE_CUBE_MAP, cube_map);
	for (int ring = 0; ring < RINGS; ring++) {
		glBegin(GL_TRIANGLE_STRIP);
		for (int i = 0; i <= SECTORS; i++)
			for (int side = 0; side < 2; side++) {
				double r = 0.999 * (ring + side) / RINGS, a = 6.28318530717958647692 * i / SECTORS;
				double x = r * cos(a), y = r * sin(a), z = sqrt(1 - r * r);

				glTexCoord3d(2 * z * x, 2 * z * y, 2 * z * z - 1);
				glVertex2d(x, y);
			}
		glEnd();
	}
	glDisable(GL_TEXTURE_CUBE_MAP);
	glEnable(GL_DEPTH_TEST);
	glMatrixMode(GL_TEXTURE);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glBindTexture(GL_TEXTURE_2D, sphere_map);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, ENVIRONMENT_SIZE, ENVIRONMENT_SIZE);
}

void trick_environment(struct drawing *d, const struct view *view, long frame)
{
	static const double ahead[6][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
	static const double up[6][3] = { { 0, -1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 }, { 0, -1, 0 }, { 0, -1, 0 } };
	struct vec at = d->level->objects[1];
	GLint viewport[4];
	float matrix[16];

	if (!cube_map) {
		cube_map = make_map(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_POSITIVE_X, 6);
		sphere_map = make_map(GL_TEXTURE_2D, GL_TEXTURE_2D, 1);
	}
	glGetIntegerv(GL_VIEWPORT, viewport);
	glViewport(0, 0, ENVIRONMENT_SIZE, ENVIRONMENT_SIZE);
	for (int i = 0; i < 6; i++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glMatrixMode(GL_PROJECTION);
		glLoadIdentity();
		gluPerspective(90, 1, 0.05, 200);
		glMatrixMode(GL_MODELVIEW);
		glLoadIdentity();
		gluLookAt(at.x, at.y, at.z, at.x + ahead[i][0], at.y + ahead[i][1], at.z + ahead[i][2], up[i][0], up[i][1], up[i][2]);
		draw_world(d, NULL, frame, 0);
		glBindTexture(GL_TEXTURE_CUBE_MAP, cube_map);
		glCopyTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)i, 0, 0, 0, 0, 0, ENVIRONMENT_SIZE, ENVIRONMENT_SIZE);
	}
	if (d->environment == ENVIRONMENT_SPHERE) {
		glLoadIdentity();
		glRotated(-view->pitch_deg, 1, 0, 0);
		glRotated(view->yaw_deg, 0, 1, 0);
		glGetFloatv(GL_MODELVIEW_MATRIX, matrix);
		paint_sphere_map(matrix);
	}
	glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
}

void trick_mirroring_object(struct drawing *d)
{
	GLUquadric *ball = gluNewQuadric();
	int is_cube = d->environment == ENVIRONMENT_CUBE;
	GLenum target = is_cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
	struct vec at = d->level->objects[1];
	float view[16];

	glGetFloatv(GL_MODELVIEW_MATRIX, view);
	glEnable(target);
	glBindTexture(target, is_cube ? cube_map : sphere_map);
	for (GLenum i = 0; i < (is_cube ? 3u : 2u); i++) {
		glTexGeni(GL_S + i, GL_TEXTURE_GEN_MODE, is_cube ? GL_REFLECTION_MAP : GL_SPHERE_MAP);
		glEnable(GL_TEXTURE_GEN_S + i);
	}
	if (is_cube)
		turn_texture_matrix(view);
	glPushMatrix();
	glTranslated(at.x, at.y, at.z);
	glColor3f(0.9f, 0.9f, 0.9f);
	gluSphere(ball, 0.5, 32, 16);
	glColor3f(1, 1, 1);
	glPopMatrix();
	for (GLenum i = 0; i < 3; i++)
		glDisable(GL_TEXTURE_GEN_S + i);
	glMatrixMode(GL_TEXTURE);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glDisable(target);
	gluDeleteQuadric(ball);
}

/* --- A planar mirror --------------------------------------------------------------------------------------------- */

/* p' = p - 2 (n . p - d) n, column-major. */
static void reflect(struct plane plane)
{
	double n[3] = { plane.n.x, plane.n.y, plane.n.z }, m[16] = { 0 };

	for (int column = 0; column < 3; column++)
		for (int row = 0; row < 3; row++)
			m[4 * column + row] = (row == column) - 2 * n[row] * n[column];
	for (int row = 0; row < 3; row++)
		m[12 + row] = 2 * plane.d * n[row];
	m[15] = 1;
	glMultMatrixd(m);
}

void trick_planar_mirror(struct drawing *d, long frame)
{
	const struct face *mirror = draw_mirror_of(&d->world->mesh);

	if (!mirror)
		return;
	/* mark the mirror's pixels */
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	glDepthMask(GL_FALSE);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_ALWAYS, 1, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
	draw_face_plain(&d->world->mesh, mirror);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glDepthMask(GL_TRUE);

	/* the reflected world in those pixels, clipped to the mirror's front */
	glStencilFunc(GL_EQUAL, 1, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
	glPushMatrix();
	reflect(mirror->plane);
	glClipPlane(GL_CLIP_PLANE0,
	            (const double[]){ mirror->plane.n.x, mirror->plane.n.y, mirror->plane.n.z, -mirror->plane.d });
	glEnable(GL_CLIP_PLANE0);
	glFrontFace(GL_CW);
	draw_world(d, NULL, frame, 1);
	glFrontFace(GL_CCW);
	glDisable(GL_CLIP_PLANE0);
	glPopMatrix();
	glDisable(GL_STENCIL_TEST);

	/* blend the mirror over it, and restore its depth for later draws */
	glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0.6f, 0.7f, 0.8f, 0.2f);
	draw_face_plain(&d->world->mesh, mirror);
	glColor3f(1, 1, 1);
	glDisable(GL_BLEND);
}

/* --- Shadow volumes ---------------------------------------------------------------------------------------------- */

static const struct light *nearest_light(const struct level *level, struct vec p)
{
	const struct light *best = level->lights;

	for (size_t i = 1; i < level->n_lights; i++)
		if (vec_length(vec_sub(level->lights[i].at, p)) < vec_length(vec_sub(best->at, p)))
			best = &level->lights[i];
	return best;
}

/* Transform a world point into the space of a rotation and a translation. */
static struct vec into_object(const float m[16], struct vec p)
{
	struct vec q = vec(p.x - m[12], p.y - m[13], p.z - m[14]);

	return vec(m[0] * q.x + m[1] * q.y + m[2] * q.z, m[4] * q.x + m[5] * q.y + m[6] * q.z,
	           m[8] * q.x + m[9] * q.y + m[10] * q.z);
}

/* Count back faces up and front faces down where they fail the depth test. */
static void draw_volume(struct vec light, GLenum culled, GLenum counts)
{
	glCullFace(culled);
	glStencilOp(GL_KEEP, counts, GL_KEEP);
	torus_draw_shadow_volume(light, 60);
}

static void darken(void)
{
	glMatrixMode(GL_PROJECTION);
	glPushMatrix();
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glPushMatrix();
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0, 0, 0, 0.5f);
	glRectf(-1, -1, 1, 1);
	glColor3f(1, 1, 1);
	glDisable(GL_BLEND);
	glEnable(GL_DEPTH_TEST);
	glPopMatrix();
	glMatrixMode(GL_PROJECTION);
	glPopMatrix();
	glMatrixMode(GL_MODELVIEW);
}

void trick_shadow(struct drawing *d, long frame)
{
	float matrix[16];
	struct vec light;

	torus_matrix(d->level, frame, matrix);
	light = into_object(matrix, nearest_light(d->level, d->level->objects[0])->at);
	glPushMatrix();
	glMultMatrixf(matrix);
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
	glDepthMask(GL_FALSE);
	glDepthFunc(GL_LESS);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_ALWAYS, 0, ~0u);
	draw_volume(light, GL_FRONT, GL_INCR_WRAP);
	draw_volume(light, GL_BACK, GL_DECR_WRAP);
	glCullFace(GL_BACK);
	glDepthFunc(GL_LEQUAL);
	glDepthMask(GL_TRUE);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glPopMatrix();
	glStencilFunc(GL_NOTEQUAL, 0, ~0u);
	glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
	darken();
	glDisable(GL_STENCIL_TEST);
}
