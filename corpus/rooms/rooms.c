/*
 * Rooms, doorways and furniture made of brushes, drawn as engines of about 2000 drew such levels. See README.md.
 *
 *   cd corpus/rooms && cc -o rooms *.c -lglut -lGLU -lGL -lm
 */
#include "../program.h"

#include "draw.h"
#include "world.h"

static struct level level;
static struct world world;
static int walks;
static struct drawing drawing = { .level = &level, .world = &world };

static void usage(void)
{
	fputs("usage: rooms [--level FILE | --seed N] [--lights N] [--cull none|frustum|portal|bsp|octree]\n"
	      "             [--lighting multitexture|pass|opengl|colors|paint|none|white] [--environment cube|sphere] "
	      "[--mirror] [--shadow]\n"
	      "             [--truth FILE.json] [--frames N] [--animate camera|--walk]\n"
	      "       rooms --check N    make levels 0 to N - 1 and see whether they are sound; no window\n",
	      stderr);
	exit(2);
}

/* Index of a word in a list that ends with NULL. */
static int choice(const char *word, const char *const *words)
{
	for (int i = 0; words[i]; i++)
		if (strcmp(word, words[i]) == 0)
			return i;
	usage();
	return 0;
}

static int check_levels(unsigned n)
{
	unsigned sound = 0;

	for (unsigned seed = 0; seed < n; seed++) {
		struct level made = { .n_brushes = 0 };
		struct world of_it = { .mesh = { .n_faces = 0 } };

		level_generate(&made, seed, 1);
		world_build(&of_it, &made);
		sound += (unsigned)world_check(&of_it, &made, seed);
		world_free(&of_it);
		level_free(&made);
	}
	printf("%u of %u levels are sound\n", sound, n);
	return sound == n ? 0 : 1;
}

/* Parse and remove this program's options; program.h parses the rest. @return the file for --truth, or NULL */
static const char *parse(int *argc, char **argv)
{
	static const char *const lightings[] = { "multitexture", "pass", "opengl", "colors", "paint", "none", "white", NULL };
	static const char *const environments[] = { "none", "cube", "sphere", NULL };
	const char *const cullings[] = { culling_names[0], culling_names[1], culling_names[2],
		                         culling_names[3], culling_names[4], NULL };
	const char *file = NULL, *truth = NULL;
	unsigned seed = 0, n_lights = 3;
	int left = 1;

	for (int i = 1; i < *argc; i++) {
		const char *value = i + 1 < *argc ? argv[i + 1] : NULL;

		if (strcmp(argv[i], "--mirror") == 0 || strcmp(argv[i], "--shadow") == 0) {
			*(argv[i][2] == 'm' ? &drawing.has_mirror : &drawing.has_shadow) = 1;
			continue;
		}
		if (strcmp(argv[i], "--walk") == 0) {
			walks = 1;
			continue;
		}
		if (strcmp(argv[i], "--frames") == 0 || strcmp(argv[i], "--animate") == 0) {
			argv[left++] = argv[i++];
			if (value)
				argv[left++] = argv[i];
			continue;
		}
		if (!value)
			usage();
		if (strcmp(argv[i], "--level") == 0)
			file = value;
		else if (strcmp(argv[i], "--truth") == 0)
			truth = value;
		else if (strcmp(argv[i], "--seed") == 0)
			seed = (unsigned)atol(value);
		else if (strcmp(argv[i], "--lights") == 0)
			n_lights = (unsigned)atol(value);
		else if (strcmp(argv[i], "--cull") == 0)
			drawing.culling = (enum culling)choice(value, cullings);
		else if (strcmp(argv[i], "--lighting") == 0)
			drawing.lighting = (enum lighting)choice(value, lightings);
		else if (strcmp(argv[i], "--environment") == 0)
			drawing.environment = (enum environment)choice(value, environments);
		else if (strcmp(argv[i], "--check") == 0)
			exit(check_levels((unsigned)atol(value)));
		else
			usage();
		i++;
	}
	*argc = left;
	argv[left] = NULL;
	if (file)
		level_read(&level, file);
	else
		level_generate(&level, seed, n_lights);
	return truth;
}

static void init(void)
{
	draw_init(&drawing);
}

static void draw(void)
{
	struct view view = world_view(&level, program.animate_camera ? 4 * (double)program_frame : 0);

	if (walks)
		view = world_walk(&level, 2 * (double)program_frame, 12 * (double)program_frame);

	draw_frame(&drawing, &view, program_frame);
}

int main(int argc, char **argv)
{
	const char *truth = parse(&argc, argv);

	world_build(&world, &level);
	if (truth)
		world_write_truth(&world, &level, truth);
	program.stencil = 1;
	program_run(argc, argv, "rooms", init, draw);
	return 0;
}
