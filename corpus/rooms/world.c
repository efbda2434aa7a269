/* Builds a world, writes its facts as JSON, and checks it. */
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

#include "bake.h"
#include "csg.h"
#include "draw.h"

void world_build(struct world *world, const struct level *level)
{
	csg_build(level, &world->mesh);
	mesh_merge(&world->mesh);
	portals_cut(level, &world->mesh);
	mesh_repair(&world->mesh);
	zones_find(&world->mesh, &world->zones);
	bsp_build(&world->bsp, &world->mesh);
	octree_build(&world->octree, &world->mesh);
}

struct view world_view(const struct level *level, double turned_deg)
{
	return (struct view){ level->start, level->start_yaw_deg + turned_deg, 0, 60, 4 / 3.0 };
}

struct view world_walk(const struct level *level, double metres, double turned_deg)
{
	struct view view = world_view(level, turned_deg);

	for (size_t i = 0; i + 1 < level->n_path; i++) {
		const struct vec way = vec_sub(level->path[i + 1], level->path[i]);
		const double length = sqrt(vec_dot(way, way));

		view.eye = vec_mad(level->path[i], way, length > 0 ? fmin(1, metres / length) : 0);
		metres -= length;
		if (metres < 0)
			break;
	}
	return view;
}

static void write_vec(FILE *out, struct vec v)
{
	fprintf(out, "[%.9g, %.9g, %.9g]", v.x, v.y, v.z);
}

static void write_lights(FILE *out, const struct level *level)
{
	fprintf(out, "  \"ambient\": %g,\n  \"lights\": [", BAKE_AMBIENT);
	for (size_t i = 0; i < level->n_lights; i++) {
		fprintf(out, "%s\n    {\"position\": ", i ? "," : "");
		write_vec(out, level->lights[i].at);
		fprintf(out, ", \"color\": [%g, %g, %g]}", level->lights[i].color[0], level->lights[i].color[1],
		        level->lights[i].color[2]);
	}
	fprintf(out, "\n  ],\n");
}

static void write_zones(FILE *out, const struct world *world)
{
	fprintf(out, "  \"zones\": [");
	for (size_t i = 0; i < world->zones.n; i++)
		fprintf(out, "%s\n    {\"volume\": %.6f, \"shells\": %zu, \"faces\": %zu}", i ? "," : "",
		        world->zones.items[i].volume, world->zones.items[i].n_shells, world->zones.items[i].n_faces);
	fprintf(out, "\n  ],\n  \"open_edges\": %zu,\n", world->zones.open_edges);
}

static void write_polygons(FILE *out, const struct world *world, const struct level *level)
{
	unsigned char *visible = malloc(world->mesh.n_faces + 1);
	struct view view = world_view(level, 0);

	fprintf(out, "  \"polygons\": {");
	for (int how = 0; visible && how < N_CULLINGS; how++)
		fprintf(out, "%s\"%s\": %zu", how ? ", " : "", culling_names[how], cull(world, &view, (enum culling)how, visible));
	fprintf(out, "}\n");
	free(visible);
}

static double largest_extent(struct box box)
{
	return fmax(fmax(box.max.x - box.min.x, box.max.y - box.min.y), box.max.z - box.min.z);
}

void world_write_truth(const struct world *world, const struct level *level, const char *path)
{
	const struct face *mirror = draw_mirror_of(&world->mesh);
	FILE *out = fopen(path, "w");

	if (!out) {
		perror(path);
		exit(2);
	}
	fprintf(out, "{\n");
	write_lights(out, level);
	fprintf(out, "  \"start\": ");
	write_vec(out, level->start);
	fprintf(out, ", \"start_yaw\": %g, \"size\": %.9g,\n", level->start_yaw_deg,
	        largest_extent(world->octree.nodes[0].box));
	if (mirror) {
		fprintf(out, "  \"mirror\": {\"normal\": ");
		write_vec(out, mirror->plane.n);
		fprintf(out, ", \"distance\": %.9g},\n", mirror->plane.d);
	}
	write_zones(out, world);
	write_polygons(out, world, level);
	fprintf(out, "}\n");
	fclose(out);
}

static double random_of(unsigned *state)
{
	*state = *state * 1664525u + 1013904223u;
	return (*state >> 8) / 16777216.0;
}

int world_check(const struct world *world, const struct level *level, unsigned seed)
{
	struct box box = world->octree.nodes[0].box;
	size_t t_junctions = mesh_count_t_junctions(&world->mesh), other_leaf = 0, other_matter = 0;
	unsigned state = seed;

	for (int i = 0; i < 10000; i++) {
		struct vec p = vec(box.min.x - 1 + (box.max.x - box.min.x + 2) * random_of(&state),
		                   box.min.y - 1 + (box.max.y - box.min.y + 2) * random_of(&state),
		                   box.min.z - 1 + (box.max.z - box.min.z + 2) * random_of(&state));
		unsigned leaf = bsp_find(&world->bsp, p);

		other_leaf += leaf != bsp_find_slowly(&world->bsp, p);
		other_matter += world->bsp.leaves[leaf].solid != level_is_solid(level, p);
	}
	printf("level %u: %zu polygons, %zu zones, %zu open edges, %zu T-junctions, %zu leaves, of 10000 points %zu in "
	       "another leaf, %zu of other matter\n",
	       seed, world->mesh.n_faces, world->zones.n, world->zones.open_edges, t_junctions, world->bsp.n_leaves,
	       other_leaf, other_matter);
	return world->zones.n && !world->zones.open_edges && !t_junctions && !other_leaf && !other_matter;
}

void world_free(struct world *world)
{
	mesh_free(&world->mesh);
	zones_free(&world->zones);
	bsp_free(&world->bsp);
	octree_free(&world->octree);
}
