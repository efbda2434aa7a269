#include "replay/draw_names.h"

#include <xxhash.h>

#include "gl_tokens.h"
#include "replay/replay.h"
#include "scene/mesa.h"
#include "scene/release.h"
#include "scene/scene.h"

/* Names draws for reports, and points out where references made by Mesa depart from OpenGL. */
static const char *known_of(const struct scene *scene, const struct scene_instance *drawn)
{
	const struct scene_material *m = &scene->materials[drawn->material];

	if (scene->mesa & SCENE_MESA_LATE_BITMAPS && m->fog && drawn->rectangle &&
	    scene->rectangles[drawn->rectangle - 1].kind == SCENE_BITMAP)
		return "Mesa 25 draws bitmaps late, with the fog that is set then";
	if (!(scene->mesa & SCENE_MESA_BACK_COLORS) && m->lighting && m->two_side && m->color_material == GL_BACK)
		return "Mesa 22 leaves green and blue of back sides unknown whose colours alone are the vertices'";
	return NULL;
}

/* Describe a draw from the scene: its program object, the texels of its first texture, and any known departure. */
static void describe_draw(const struct scene *scene, struct draw_name *name)
{
	const struct scene_instance *found = NULL;
	const struct scene_material *m;

	for (uint32_t i = 0; i < scene->n_instances; i++)
		if (scene->instances[i].draw <= name->draw && (!found || scene->instances[i].draw >= found->draw))
			found = &scene->instances[i];
	if (!found)
		return;
	m = &scene->materials[found->material];
	name->has_program = m->program != 0;
	name->known = known_of(scene, found);
	if (m->unit_count) {
		const struct scene_texture *t = scene->textures[scene->units[m->unit_first].texture];

		name->texture = XXH64(t->texels, t->n_bytes, 0);
	}
}

static void name_draw(const struct scene *scene, struct draw_name *name)
{
	if (!name->draw || name->draw > scene->n_draws || !scene->draws)
		return;
	name->call = scene->draws[name->draw].call;
	name->call_number = scene->draws[name->draw].call_number;
	name->list = scene->draws[name->draw].list;
	describe_draw(scene, name);
}

void replay_name_draws(const char *trace, struct draw_name *names, size_t n)
{
	struct replay *rp = NULL;
	struct scene *scene;

	if (n == 0 || replay_open(&rp, trace) != 0)
		return;
	for (size_t i = 0; i < n;) {
		const uint64_t frame = replay_frame(rp);
		const int want = frame == names[i].frame;

		if (replay_next_frame(rp, want, &scene) <= 0)
			break;
		for (; want && i < n && names[i].frame == frame; i++)
			name_draw(scene, &names[i]);
		if (want)
			scene_release(&scene);
	}
	replay_close(&rp);
}
