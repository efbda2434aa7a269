/* Five ways of culling. */
#include "cull.h"

#include <math.h>
#include <string.h>

const char *const culling_names[N_CULLINGS] = { "none", "frustum", "portal", "bsp", "octree" };

enum { MAX_PORTALS_AWAY = 24 }; /* most portals between the eye and a zone */

/* --- Frusta ------------------------------------------------------------------------------------------------------ */

/* The plane through the eye and two directions; its front is on the side of a x b. */
static struct plane plane_through(struct vec eye, struct vec a, struct vec b)
{
	struct vec n = vec_unit(vec_cross(a, b));

	return (struct plane){ n, vec_dot(n, eye) };
}

struct frustum frustum_of(const struct view *view)
{
	const double degree = 0.01745329251994329577;
	double yaw = view->yaw_deg * degree, pitch = view->pitch_deg * degree, t = tan(0.5 * view->field_deg * degree);
	struct vec ahead = vec(sin(yaw) * cos(pitch), sin(pitch), -cos(yaw) * cos(pitch));
	struct vec right = vec(cos(yaw), 0, sin(yaw)), up = vec_cross(right, ahead), corner[4];
	struct frustum f = { .n_planes = 4 };

	for (int i = 0; i < 4; i++)
		corner[i] = vec_mad(vec_mad(ahead, right, i == 1 || i == 2 ? t * view->aspect : -t * view->aspect), up,
		                    i >= 2 ? t : -t);
	for (int i = 0; i < 4; i++)
		f.planes[i] = plane_through(view->eye, corner[(i + 1) % 4], corner[i]);
	return f;
}

static int box_is_outside(struct box box, const struct frustum *f)
{
	for (int i = 0; i < f->n_planes; i++) {
		struct vec n = f->planes[i].n;
		struct vec farthest = vec(n.x > 0 ? box.max.x : box.min.x, n.y > 0 ? box.max.y : box.min.y,
		                          n.z > 0 ? box.max.z : box.min.z);

		if (plane_distance(f->planes[i], farthest) < 0)
			return 1;
	}
	return 0;
}

/* The part of a face inside a frustum; may be empty. */
static struct winding clip_to_frustum(const struct mesh *mesh, const struct face *face, const struct frustum *f)
{
	struct winding w = mesh_winding(mesh, face);

	for (int i = 0; i < f->n_planes && w.n; i++)
		winding_split(&w, f->planes[i], &w, NULL);
	return w;
}

/* Mark a wall as visible if any of it is inside the frustum. */
static void show(const struct world *world, unsigned face, const struct frustum *f, unsigned char *visible)
{
	if (world->mesh.faces[face].portal == NO_PORTAL && !visible[face])
		visible[face] = clip_to_frustum(&world->mesh, &world->mesh.faces[face], f).n != 0;
}

/* --- Methods ----------------------------------------------------------------------------------------------------- */

static void cull_frustum(const struct world *world, const struct frustum *f, unsigned char *visible)
{
	for (unsigned i = 0; i < world->mesh.n_faces; i++)
		show(world, i, f, visible);
}

static void cull_bsp(const struct world *world, const struct frustum *f, unsigned char *visible)
{
	for (size_t i = 0; i < world->bsp.n_leaves; i++) {
		const struct bsp_leaf *leaf = &world->bsp.leaves[i];

		for (size_t k = 0; k < leaf->n_faces && !box_is_outside(leaf->box, f); k++)
			visible[leaf->faces[k]] = 1;
	}
}

static void cull_octree(const struct world *world, unsigned node, const struct frustum *f, unsigned char *visible)
{
	const struct octree_node *n = &world->octree.nodes[node];

	if (box_is_outside(n->box, f))
		return;
	for (size_t k = 0; k < n->n_faces; k++)
		visible[n->faces[k]] = 1;
	for (unsigned i = 0; n->first_child && i < 8; i++)
		cull_octree(world, n->first_child + i, f, visible);
}

/* The frustum from the eye through the visible part of a portal. */
static struct frustum frustum_through(struct vec eye, const struct winding *hole)
{
	struct frustum f = { .n_planes = 0 };

	for (int i = 0; i < hole->n; i++) {
		struct vec a = vec_sub(hole->p[i], eye), b = vec_sub(hole->p[(i + 1) % hole->n], eye);

		if (vec_length(vec_cross(a, b)) > 1e-12)
			f.planes[f.n_planes++] = plane_through(eye, b, a);
	}
	return f;
}

/* The other face of a portal. */
static const struct face *back_of(const struct mesh *mesh, const struct face *portal)
{
	struct winding w = mesh_winding(mesh, portal);

	for (size_t i = 0; i < mesh->n_faces; i++)
		if (mesh->faces[i].portal == portal->portal && vec_dot(mesh->faces[i].plane.n, portal->plane.n) < 0) {
			struct winding other = mesh_winding(mesh, &mesh->faces[i]);

			if (vec_length(vec_sub(winding_centre(&w), winding_centre(&other))) < WELD)
				return &mesh->faces[i];
		}
	return NULL;
}

/* Mark the visible faces of a zone, and of the zones behind its portals. away: portals between the eye and the zone */
static void cull_zone(const struct world *world, struct vec eye, unsigned zone, const struct frustum *f, int away,
                      unsigned char *visible)
{
	const struct mesh *mesh = &world->mesh;

	for (unsigned i = 0; i < mesh->n_faces; i++) {
		const struct face *face = &mesh->faces[i], *back;
		struct winding hole;
		struct frustum through;

		if (face->zone != zone)
			continue;
		show(world, i, f, visible);
		if (face->portal == NO_PORTAL || away == MAX_PORTALS_AWAY || plane_distance(face->plane, eye) < -ON_PLANE ||
		    !(back = back_of(mesh, face)))
			continue;
		if (plane_distance(face->plane, eye) < 0.01) { /* the eye is in the portal, which does not narrow the frustum */
			cull_zone(world, eye, back->zone, f, MAX_PORTALS_AWAY, visible);
			continue;
		}
		hole = clip_to_frustum(mesh, face, f);
		if (!hole.n)
			continue;
		through = frustum_through(eye, &hole);
		cull_zone(world, eye, back->zone, &through, away + 1, visible);
	}
}

size_t cull(const struct world *world, const struct view *view, enum culling how, unsigned char *visible)
{
	struct frustum f = frustum_of(view);
	size_t n = 0, zone;

	memset(visible, 0, world->mesh.n_faces);
	zone = how == CULL_PORTAL ? zones_at(&world->zones, &world->mesh, view->eye) : world->zones.n;
	if (how == CULL_FRUSTUM)
		cull_frustum(world, &f, visible);
	else if (how == CULL_BSP)
		cull_bsp(world, &f, visible);
	else if (how == CULL_OCTREE)
		cull_octree(world, 0, &f, visible);
	else if (zone < world->zones.n)
		cull_zone(world, view->eye, (unsigned)zone, &f, 0, visible);
	else /* by choice, or because the eye is in a wall */
		for (size_t i = 0; i < world->mesh.n_faces; i++)
			visible[i] = world->mesh.faces[i].portal == NO_PORTAL;
	for (size_t i = 0; i < world->mesh.n_faces; i++)
		n += visible[i];
	return n;
}
