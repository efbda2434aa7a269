#include "look/apply/meshes.h"

#include "base/mat4.h"
#include "gl_tokens.h"
#include "look/apply/crease.h"
#include "look/apply/match.h"
#include "look/draws/drawn.h"
#include "look/rules/repaired.h"
#include "scene/repair/holds.h"

/* The largest angle of edges that look round on an instance, in degrees. */
static float crease_of(const struct applying *a, const struct scene_instance *in)
{
	float angle = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		if (a->rules->surfaces[k].crease && match_applies(a, in, k))
			angle = *a->rules->surfaces[k].crease;
	return angle;
}

int meshes_smooth(const struct applying *a, uint32_t i, struct scene_instance *placed, struct scene_material *m)
{
	const struct scene_instance *in = &a->scene->instances[i];
	const float angle = a->lights_change & LIGHTS_CREASES && m->lighting && !(m->surface.hidden & SCENE_UNSHADED) ?
	                            crease_of(a, in) :
	                            0;
	struct scene_mesh *mesh = NULL;
	int err = angle > 0 ? crease_smooth(a->out->meshes[placed->mesh], m->shade_model == GL_FLAT, angle, &mesh) : 0;

	if (!mesh)
		return err;
	m->surface.hidden |= SCENE_CREASED;
	placed->mesh = a->out->n_meshes;
	a->out->meshes[a->out->n_meshes++] = mesh;
	return 0;
}

int meshes_wants_repair(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                        struct repair_wants *wants)
{
	const struct repair_rule *rule = NULL;

	for (uint32_t k = 0; k < a->rules->surfaces_count && a->look && a->look->repaired; k++)
		if (a->rules->surfaces[k].repair && match_applies(a, in, k))
			rule = a->rules->surfaces[k].repair;
	return rule && repaired_wants(rule, a->scene, in, m, wants);
}

/*
 * 1 if the viewer is outside a body, or has no place (parallel projection, singular modelview).
 * @param mesh  the instance's, repaired and closed
 */
static int is_outside(const struct scene *s, const struct scene_instance *in, const struct scene_mesh *mesh)
{
	float obj_from_eye[16], viewer[4];

	if (drawn_in_parallel(&s->views[in->view]) || !mat4_invert(obj_from_eye, in->modelview))
		return 1;
	mat4_transform(viewer, obj_from_eye, (const float[4]){ 0, 0, 0, 1 });
	return !holds_place(mesh, viewer);
}

int meshes_repair(const struct applying *a, uint32_t i)
{
	struct scene *out = a->out;
	struct scene_instance *own = &out->instances[i], *added = &out->instances[out->n_instances];
	struct scene_material *m = &out->materials[out->n_materials];
	const struct scene_mesh *mesh;
	struct repair_wants wants;
	struct repair_found found;
	int err;

	m[0] = m[1] = out->materials[own->material]; /* [0]: for the program's mesh; [1]: for the repaired one */
	if (!meshes_wants_repair(a, &a->scene->instances[i], m, &wants))
		return 0;
	err = repaired_find(a->look->repaired, a->scene->meshes[a->scene->instances[i].mesh], &wants, &mesh, &found);
	if (err || !mesh)
		return err;
	m[0].surface.hidden |=
		SCENE_HIDDEN_FROM_LIGHTS | SCENE_HIDDEN_FROM_MIRRORS |
		(found.closed && found.turned && !m->cull_face && is_outside(a->scene, own, mesh) ? SCENE_ENTERED : 0);
	*added = a->scene->instances[i];
	added->mesh = out->n_meshes;
	added->view += a->scene->n_views;
	added->draw = out->n_draws;
	added->first_primitive = out->n_primitives;
	own->material = out->n_materials;
	added->material = out->n_materials + 1;
	out->n_materials += 2;
	out->meshes[out->n_meshes++] = mesh;
	out->n_primitives += mesh->primitive_count;
	out->n_instances++;
	out->n_views = 2 * a->scene->n_views;
	return m[1].surface.hidden & SCENE_CREASED ? meshes_smooth(a, i, added, &m[1]) : 0;
}
