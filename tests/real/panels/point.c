/* Points (OpenGL 2.1 sec. 3.3): distance attenuation, fading below the threshold, smooth rims, sprites. */
#include "panels.h"

static void draw_points(int i)
{
	(void)i;
	glBegin(GL_POINTS);
	for (int k = 0; k < 4; k++) {
		glColor4f(0.9f - 0.2f * (float)k, 0.3f + 0.2f * (float)k, 0.5f, 0.9f - 0.15f * (float)k);
		glVertex3f(0.45f * (float)k - 0.63f, 0.37f * (float)(k % 3) - 0.31f, 0.4f - 0.6f * (float)k);
	}
	glEnd();
}

/* Smooth or not, each attenuation with each size and threshold. */
static void attenuated(int i)
{
	static const float attenuations[4][3] = { { 1, 0, 0 }, { 0, 0.5f, 0 }, { 0.3f, 0.1f, 0.15f }, { 0.02f, 0, 0.4f } };
	static const float sizes[4] = { 1, 2.5f, 5, 9 };
	const int attenuation = choose(&i, 4), size = choose(&i, 4), smooth = choose(&i, 2), limit = choose(&i, 3);

	glPointSize(sizes[size]);
	glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, attenuations[attenuation]);
	glPointParameterf(GL_POINT_SIZE_MIN, limit == 1 ? 3 : 0);
	glPointParameterf(GL_POINT_SIZE_MAX, limit == 2 ? 4 : 60);
	if (smooth)
		glEnable(GL_POINT_SMOOTH);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

int main(void)
{
	static const struct table tables[] = { { 96, attenuated, draw_points } };

	DRAW_TABLES(tables, NULL);
	return 0;
}
