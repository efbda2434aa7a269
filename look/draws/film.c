#include "look/draws/film.h"

#include <math.h>

#include "base/mat4.h"
#include "gl_tokens.h"

#define MOST_ALPHA 0.5f /* a shell's alpha is below this */
enum { LABEL_PRIMITIVES = 64 }; /* triangles of a label, at most */
#define ACROSS 1e-4f /* tolerance for the depths of a label's points, which must be equal; as a share */

/* 1 for lit draws without texture that let more than half of the background through. */
static int is_shell(const struct scene_material *m, const struct scene_mesh *mesh)
{
	return m->lighting && !m->unit_count && !m->color_material && !mesh->face && m->front.diffuse[3] < MOST_ALPHA;
}

/* 1 for unlit, textured draws perpendicular to the view. */
static int is_label(const struct scene_material *m, const struct scene_mesh *mesh,
                    const struct scene_instance *instance)
{
	float first[4];

	if (m->lighting || !m->unit_count || mesh->kind != SCENE_TRIANGLES ||
	    mesh->primitive_count > LABEL_PRIMITIVES || !mesh->vertex_count)
		return 0;
	mat4_transform(first, instance->modelview, mesh->position);
	for (uint32_t v = 1; v < mesh->vertex_count; v++) {
		float at[4];

		mat4_transform(at, instance->modelview, mesh->position + 4 * (size_t)v);
		if (!(fabsf(at[2] - first[2]) <= ACROSS * fabsf(first[2])))
			return 0;
	}
	return 1;
}

int film_is(const struct scene *scene, const struct scene_instance *instance)
{
	const struct scene_material *m = &scene->materials[instance->material];
	const struct scene_mesh *mesh = scene->meshes[instance->mesh];

	if (!m->blend || m->blend_src_rgb != GL_SRC_ALPHA || m->blend_dst_rgb != GL_ONE_MINUS_SRC_ALPHA)
		return 0;
	return is_shell(m, mesh) || is_label(m, mesh, instance);
}
