#include "tracer/frame/picture/ended.h"

#include <stdlib.h>

#include "base/err.h"
#include "scene/draw_list.h"
#include "scene/program.h"

/* user: the scene's programs, as updated by kernels */
static int is_ended(const void *user, const struct scene *scene, uint32_t i)
{
	const struct scene_material *m = &scene->materials[scene->instances[i].material];
	const uint32_t programs[2] = { m->vertex_program, m->fragment_program };

	for (int k = 0; k < 2; k++)
		if (programs[k] && ((const struct scene_program *)((const uint32_t *)user + (programs[k] - 1)))->ended)
			return 1;
	return 0;
}

int ended_count(const struct frame *frame, struct image *img, uint64_t *ended)
{
	const struct scene *scene = frame->scene;
	const size_t bytes = scene->n_programs * sizeof(uint32_t);
	uint64_t n = 0;
	uint32_t *programs;
	char *draws;
	int err;

	if (!frame->prepared.has_vertex_programs && !frame->prepared.has_fragment_programs)
		return 0;
	programs = malloc(bytes);
	if (!programs)
		return err_report(ERR_SYSTEM, NULL, "out of memory for programs");
	err = device_read(frame->tr->dev, frame->tr->placed.programs.buffer, 0, programs, bytes);
	for (uint32_t i = 0; i < scene->n_instances && !err; i++)
		n += (uint64_t)is_ended(programs, scene, i);
	*ended += n;
	if (!err && n && img) {
		draws = scene_draw_list(scene, is_ended, programs);
		err = draws ? image_set_attribute(img, "relume:ended", "%s", draws) :
		              err_report(ERR_SYSTEM, NULL, "out of memory for an attribute");
		free(draws);
	}
	free(programs);
	return err;
}
