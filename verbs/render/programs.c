#include "verbs/render/programs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "scene/draw_list.h"

struct seen {
	struct scene_draw_program *list;
	size_t n, room;
};

static int is_same(const struct scene_draw_program *a, const struct scene_draw_program *b)
{
	return a->name == b->name && strcmp(a->kind, b->kind) == 0;
}

static int add(struct seen *seen, const struct scene_draw_program *program)
{
	for (size_t i = 0; i < seen->n; i++)
		if (is_same(&seen->list[i], program))
			return 0;
	if (MEMORY_GROW(seen->list, seen->room, seen->n + 1))
		return err_report(ERR_SYSTEM, NULL, "out of memory for programs");
	seen->list[seen->n++] = *program;
	return 0;
}

/* user: the program */
static int is_run_by(const void *user, const struct scene *scene, uint32_t i)
{
	const struct scene_draw *draw = &scene->draws[scene->instances[i].draw];

	for (int k = 0; k < SCENE_DRAW_PROGRAMS && draw->programs[k].kind; k++)
		if (is_same(&draw->programs[k], user))
			return 1;
	return 0;
}

int programs_tell(const struct scene *scene, struct image *img)
{
	struct seen seen = { .list = NULL };
	char *text = NULL;
	size_t size;
	FILE *out;
	int err = 0;

	for (uint32_t i = 0; i < scene->n_instances && scene->draws && !err; i++)
		for (int k = 0; k < SCENE_DRAW_PROGRAMS && scene->draws[scene->instances[i].draw].programs[k].kind && !err; k++)
			err = add(&seen, &scene->draws[scene->instances[i].draw].programs[k]);
	if (err || !seen.n) {
		free(seen.list);
		return err;
	}
	out = open_memstream(&text, &size);
	for (size_t i = 0; i < seen.n && out && !err; i++) {
		char *draws = scene_draw_list(scene, is_run_by, &seen.list[i]);

		if (draws)
			fprintf(out, "%s%s %u=%s", i ? ";" : "", seen.list[i].kind, seen.list[i].name, draws);
		else
			err = ERR_SYSTEM;
		free(draws);
	}
	if (!out || fclose(out) || err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory for programs");
	else
		err = image_set_attribute(img, "relume:programs", "%s", text);
	free(text);
	free(seen.list);
	return err;
}
