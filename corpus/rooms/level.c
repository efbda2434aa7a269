/* Reads levels from files, or generates them from a seed. */
#include "level.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "array.h"

static const double turn = 6.28318530717958647692;

/* --- Brushes ----------------------------------------------------------------------------------------------------- */

static void add_plane(struct brush *b, struct vec n, double d)
{
	double length = vec_length(n);

	b->planes[b->n_planes++] = (struct plane){ vec_scale(n, 1 / length), d / length };
}

/* Add a brush, bounded by its corners. */
static void add_brush(struct level *level, struct brush b)
{
	b.box = box_empty();
	for (int i = 0; i < b.n_planes; i++) {
		struct winding w = winding_of_plane(b.planes[i]);

		for (int k = 0; k < b.n_planes && w.n; k++)
			if (k != i)
				winding_split(&w, b.planes[k], NULL, &w);
		for (int k = 0; k < w.n; k++)
			box_add(&b.box, w.p[k]);
	}
	ARRAY_PUSH(level->brushes, level->n_brushes, b);
}

static struct brush brush_box(int adds, const double v[6], int texture)
{
	struct brush b = { .adds = adds, .texture = texture };

	add_plane(&b, vec(-1, 0, 0), -v[0]);
	add_plane(&b, vec(0, -1, 0), -v[1]);
	add_plane(&b, vec(0, 0, -1), -v[2]);
	add_plane(&b, vec(1, 0, 0), v[3]);
	add_plane(&b, vec(0, 1, 0), v[4]);
	add_plane(&b, vec(0, 0, 1), v[5]);
	return b;
}

/* v: x, z, radius, y0, y1. The sides of a cone lean inwards and meet at y1. */
static struct brush brush_round(int adds, int is_cone, const double v[5], int sides, int texture)
{
	struct brush b = { .adds = adds, .texture = texture };
	double apothem = v[2] * cos(turn / (2 * sides)), height = v[4] - v[3], lean = is_cone ? apothem / height : 0;

	add_plane(&b, vec(0, -1, 0), -v[3]);
	if (!is_cone)
		add_plane(&b, vec(0, 1, 0), v[4]);
	for (int i = 0; i < sides; i++) {
		struct vec n = vec(cos(turn * (i + 0.5) / sides), lean, sin(turn * (i + 0.5) / sides));

		add_plane(&b, n, vec_dot(n, vec(v[0], v[3], v[1])) + apothem);
	}
	return b;
}

int level_is_solid(const struct level *level, struct vec p)
{
	for (size_t i = level->n_brushes; i-- > 0;) {
		const struct brush *b = &level->brushes[i];
		int k = 0;

		while (k < b->n_planes && plane_distance(b->planes[k], p) < 0)
			k++;
		if (k == b->n_planes)
			return b->adds;
	}
	return 1;
}

static void add_portal(struct level *level, const double v[6])
{
	int axis = v[0] == v[3] ? 0 : v[1] == v[4] ? 1 : 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
	struct winding w = { .n = 4 };

	for (int i = 0; i < 4; i++) {
		double p[3];

		p[axis] = v[axis];
		p[a] = v[i == 1 || i == 2 ? a + 3 : a];
		p[b] = v[i >= 2 ? b + 3 : b];
		w.p[i] = vec(p[0], p[1], p[2]);
	}
	ARRAY_PUSH(level->portals, level->n_portals, w);
}

/* --- Files ------------------------------------------------------------------------------------------------------- */

static const char *read_brush(struct level *level, int adds, const char *kind, const double *v, int n)
{
	if (n == 0 || v[n - 1] < 0 || v[n - 1] > TEXTURE_MIRROR)
		return "no such texture";
	if (strcmp(kind, "box") == 0 && n == 7) {
		add_brush(level, brush_box(adds, v, (int)v[6]));
	} else if ((strcmp(kind, "cylinder") == 0 || strcmp(kind, "cone") == 0) && n == 7) {
		if (v[5] < 3 || v[5] > BRUSH_MAX_PLANES - 2)
			return "3 to 32 sides, please";
		add_brush(level, brush_round(adds, kind[2] == 'n', v, (int)v[5], (int)v[6]));
	} else if (strcmp(kind, "plane") == 0 && n == 11) {
		struct brush b = brush_box(adds, v + 4, (int)v[10]);

		add_plane(&b, vec(v[0], v[1], v[2]), v[3]);
		add_brush(level, b);
	} else {
		return "no such brush, or not its numbers";
	}
	return NULL;
}

/* @return what is wrong with a line, or NULL */
static const char *read_line(struct level *level, char *line)
{
	char *word = strtok(line, " \t\r\n"), *kind = NULL;
	double v[12];
	int n = 0, is_brush;

	if (!word || word[0] == '#')
		return NULL;
	is_brush = strcmp(word, "add") == 0 || strcmp(word, "subtract") == 0;
	if (is_brush && !(kind = strtok(NULL, " \t\r\n")))
		return "a brush needs a kind";
	for (char *number; n < 12 && (number = strtok(NULL, " \t\r\n")) && number[0] != '#'; n++)
		v[n] = strtod(number, NULL);
	if (is_brush)
		return read_brush(level, word[0] == 'a', kind, v, n);
	if (strcmp(word, "portal") == 0 && n == 6)
		add_portal(level, v);
	else if (strcmp(word, "light") == 0 && n == 6)
		ARRAY_PUSH(level->lights, level->n_lights, ((struct light){ vec(v[0], v[1], v[2]), { v[3], v[4], v[5] } }));
	else if (strcmp(word, "object") == 0 && n == 3)
		ARRAY_PUSH(level->objects, level->n_objects, vec(v[0], v[1], v[2]));
	else if (strcmp(word, "start") == 0 && n == 4) {
		level->start = vec(v[0], v[1], v[2]);
		level->start_yaw_deg = v[3];
	} else
		return "no such thing, or not its numbers";
	return NULL;
}

void level_read(struct level *level, const char *path)
{
	FILE *in = fopen(path, "r");
	char line[512];

	if (!in) {
		perror(path);
		exit(2);
	}
	for (unsigned number = 1; fgets(line, sizeof(line), in); number++) {
		const char *wrong = read_line(level, line);

		if (wrong) {
			fprintf(stderr, "%s:%u: %s\n", path, number, wrong);
			exit(2);
		}
	}
	fclose(in);
}

/* --- Generated levels --------------------------------------------------------------------------------------------- */

enum { GRID_X = 4, GRID_Z = 3, CELL = 12 };
#define EYE_HEIGHT 1.7

/* A number in [0, n), from a 32-bit generator (Marsaglia 2003, "Xorshift RNGs"). */
static unsigned pick(unsigned *state, unsigned n)
{
	*state ^= *state << 13;
	*state ^= *state >> 17;
	*state ^= *state << 5;
	return (*state >> 8) % n;
}

/* Furnish a room: a pillar, a floating block, a cone, a ramp, or nothing. */
static void furnish(struct level *level, unsigned *state, const double room[6])
{
	double x = 0.5 * (room[0] + room[3]), z = 0.5 * (room[2] + room[5]);
	int texture = (int)pick(state, N_TEXTURES);

	switch (pick(state, 5)) {
	case 0:
		add_brush(level, brush_round(1, 0, (double[]){ x, z, 0.75, room[1], room[4] }, 8, texture));
		break;
	case 1:
		add_brush(level, brush_box(1, (double[]){ x - 1, room[1] + 1, z - 0.5, x + 1, room[1] + 2, z + 0.5 }, texture));
		break;
	case 2:
		add_brush(level, brush_round(1, 1, (double[]){ x, z, 1, room[1], room[1] + 2 }, 6, texture));
		break;
	case 3: {
		struct brush ramp = brush_box(1, (double[]){ x - 1.5, room[1], z - 1, x + 1.5, room[1] + 1.5, z + 1 }, texture);

		add_plane(&ramp, vec(-1, 2, 0), -x + 2 * room[1] + 1.5);
		add_brush(level, ramp);
		break;
	}
	}
}

/* Add a doorway between two neighbours along x (axis 0) or z (axis 2), and a portal across its middle. */
static void join(struct level *level, const double a[6], const double b[6], int axis)
{
	int across = 2 - axis;
	double low = fmax(a[across], b[across]), high = fmin(a[across + 3], b[across + 3]), at = floor(2 * (low + high)) / 4;
	double door[6], portal[6];

	door[axis] = a[axis + 3];
	door[axis + 3] = b[axis];
	door[across] = at - 1;
	door[across + 3] = at + 1;
	door[1] = 0;
	door[4] = 2.5;
	add_brush(level, brush_box(0, door, 0));
	memcpy(portal, door, sizeof(portal));
	portal[axis] = portal[axis + 3] = 0.5 * (door[axis] + door[axis + 3]);
	portal[across] -= 0.5;
	portal[across + 3] += 0.5;
	portal[1] -= 0.5;
	portal[4] += 0.5;
	add_portal(level, portal);
}

/* Position of a doorway, at a viewer's height. */
static struct vec doorway_of(const double a[6], const double b[6], int axis)
{
	int across = 2 - axis;
	double at = floor(2 * (fmax(a[across], b[across]) + fmin(a[across + 3], b[across + 3]))) / 4,
	       along = 0.5 * (a[axis + 3] + b[axis]);

	return axis ? vec(at, EYE_HEIGHT, along) : vec(along, EYE_HEIGHT, at);
}

/* Walk through a doorway and to the corner beyond it, which is always free. */
static void walk_on(struct level *level, struct vec doorway, const double room[6])
{
	ARRAY_PUSH(level->path, level->n_path, doorway);
	ARRAY_PUSH(level->path, level->n_path, vec(room[0] + 1.2, EYE_HEIGHT, room[2] + 1.2));
}

/* Walk along the first row, from each of its rooms to the last row and back. */
static void walk_rooms(struct level *level, double rooms[GRID_Z][GRID_X][6])
{
	ARRAY_PUSH(level->path, level->n_path, level->start);
	for (int x = 0; x < GRID_X; x++) {
		if (x)
			walk_on(level, doorway_of(rooms[0][x - 1], rooms[0][x], 0), rooms[0][x]);
		for (int z = 1; z < GRID_Z; z++)
			walk_on(level, doorway_of(rooms[z - 1][x], rooms[z][x], 2), rooms[z][x]);
		for (int z = GRID_Z - 1; z > 0; z--)
			walk_on(level, doorway_of(rooms[z - 1][x], rooms[z][x], 2), rooms[z - 1][x]);
	}
}

/* Hang a panel on the wall of greatest z in a room, facing the start. */
static void hang_mirror(struct level *level, const double room[6])
{
	add_brush(level, brush_box(1, (double[]){ room[0] + 1, 0.5, room[5] - 0.125, room[0] + 3.5, 2.5, room[5] },
	                           TEXTURE_MIRROR));
}

void level_generate(struct level *level, unsigned seed, unsigned n_lights)
{
	unsigned state = seed * 2654435761u + 12345;
	double rooms[GRID_Z][GRID_X][6];

	for (int warm = 0; warm < 8; warm++)
		pick(&state, 2);
	for (int z = 0; z < GRID_Z; z++)
		for (int x = 0; x < GRID_X; x++) {
			double *r = rooms[z][x];

			r[0] = CELL * x + 0.5 + 0.25 * pick(&state, 8);
			r[1] = 0;
			r[2] = CELL * z + 0.5 + 0.25 * pick(&state, 8);
			r[3] = CELL * (x + 1) - 0.5 - 0.25 * pick(&state, 8);
			r[4] = 3 + 0.5 * pick(&state, 5);
			r[5] = CELL * (z + 1) - 0.5 - 0.25 * pick(&state, 8);
			add_brush(level, brush_box(0, r, (int)pick(&state, N_TEXTURES)));
		}
	for (int z = 0; z < GRID_Z; z++)
		for (int x = 0; x < GRID_X; x++) {
			if (x + 1 < GRID_X && (z == 0 || pick(&state, 2)))
				join(level, rooms[z][x], rooms[z][x + 1], 0);
			if (z + 1 < GRID_Z)
				join(level, rooms[z][x], rooms[z + 1][x], 2);
		}
	for (int z = 0; z < GRID_Z; z++)
		for (int x = 0; x < GRID_X; x++)
			if (x || z)
				furnish(level, &state, rooms[z][x]);
	for (unsigned i = 0; i < n_lights; i++) {
		const double *r = rooms[i / GRID_X % GRID_Z][i % GRID_X];
		struct light light = { vec(r[0] + 1.5, r[4] - 0.75, r[2] + 1.5 + 0.25 * pick(&state, 8)), { 0, 0, 0 } };

		for (int k = 0; k < 3; k++)
			light.color[k] = 10 + pick(&state, 9);
		ARRAY_PUSH(level->lights, level->n_lights, light);
	}
	ARRAY_PUSH(level->objects, level->n_objects, vec(rooms[0][0][0] + 4, 1.25, rooms[0][0][2] + 3.5));
	ARRAY_PUSH(level->objects, level->n_objects, vec(rooms[0][0][0] + 2.5, 0.75, rooms[0][0][2] + 5));
	hang_mirror(level, rooms[0][0]);
	level->start = vec(rooms[0][0][0] + 1, EYE_HEIGHT, rooms[0][0][2] + 1);
	level->start_yaw_deg = 135;
	walk_rooms(level, rooms);
}

void level_free(struct level *level)
{
	free(level->brushes);
	free(level->portals);
	free(level->lights);
	free(level->objects);
	free(level->path);
	*level = (struct level){ .n_brushes = 0 };
}
