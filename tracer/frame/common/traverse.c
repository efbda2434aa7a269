#include "tracer/frame/common/traverse.h"

#include "base/err.h"
#include "kernels/camera/camera.h"
#include "kernels/rays/rays.h"

const struct traverse_family traverse_families[N_DEVICE_FAMILIES] = {
	[FAMILY_PACKETS] = { KERNEL_camera_packet, KERNEL_occlude_packet, KERNEL_intersect_packet, ACCEL_ROWS },
	[FAMILY_BINARY] = { KERNEL_camera_wide, KERNEL_occlude_binary, KERNEL_intersect_binary, 0 },
	[FAMILY_COMPRESSED] = { KERNEL_camera_compressed, KERNEL_occlude_compressed, KERNEL_intersect_compressed,
	                        ACCEL_COMPRESSED },
};

#define UPLOAD(element, name) \
	if (!err) \
		err = launch_upload(dev, trees->name, accel->name, accel->n_##name);

int traverse_upload_pools(struct device *dev, const struct accel *accel, struct traverse_trees *trees)
{
	int err = 0;

	TRAVERSE_POOLS(UPLOAD)
	return err;
}

int traverse_upload_tlases(struct device *dev, const struct accel *accel, const struct instance *instances, size_t n,
                         struct traverse_trees *trees)
{
	int err = launch_upload(dev, trees->instances, instances, n);

	TRAVERSE_TLASES(UPLOAD)
	return err;
}

void traverse_release(struct device *dev, struct traverse_trees *trees)
{
#define RELEASE(element, name) device_release(dev, &trees->name.buffer);
	TRAVERSE_POOLS(RELEASE)
	TRAVERSE_TLASES(RELEASE)
	device_release(dev, &trees->instances.buffer);
}

static int no_such_kernel(enum kernel kernel)
{
	return err_report(ERR_SYSTEM, device_kernel_name(kernel), "this kernel takes no such rays");
}

int traverse_camera(struct device *dev, enum kernel kernel, const struct traverse_trees *t, struct camera_rectangle r,
                    const struct camera_pass_launch *pass)
{
#define CAMERA(list, nodes_of, triangles_of) \
	LAUNCH(list, .pass = *pass, .instances = t->instances, .top = t->top2, .instance_list = t->instance_list, \
	       .nodes = t->nodes_of, .triangles = t->triangles_of)

	switch (kernel) {
	case KERNEL_camera_packet:
		return launch_camera_packet(dev, camera_packet_items(r), CAMERA(camera_packet, nodes8, faces8));
	case KERNEL_camera_wide:
		return launch_camera_wide(dev, camera_wide_items(r), CAMERA(camera_wide, nodes2, triangles));
	case KERNEL_camera_compressed:
		return launch_camera_compressed(dev, camera_wide_items(r),
		                                CAMERA(camera_compressed, nodes8c, triangles8c));
	default:
		return no_such_kernel(kernel);
	}
}

int traverse_rays(struct device *dev, enum kernel kernel, const struct traverse_trees *t, const struct traverse_rays *r)
{
	const uint32_t packets = (r->n + RAYS_PER_ITEM - 1) / RAYS_PER_ITEM;
	const union buffer_uint opacity = t->opacity.buffer ? t->opacity : t->instance_list;
	const uint32_t after = r->last.buffer != NULL;

#define RAYS(list, top_of, nodes_of, triangles_of, ...) \
	LAUNCH(list, .n_rays = r->n, .rays = r->rays, .top_first = r->space->top_of##_first, .top = t->top_of, \
	       .instance_list = t->instance_list, .instances = t->instances, .nodes = t->nodes_of, \
	       .triangles = t->triangles_of, \
	       __VA_ARGS__)
#define OCCLUDE(list, top_of, nodes_of, triangles_of) \
	RAYS(list, top_of, nodes_of, triangles_of, .to_lights = r->to_lights, .occluded = r->occluded)
#define OCCLUDE_WIDE \
	RAYS(occlude_wide, top8, nodes8, triangles8, .opacity = opacity, .to_lights = r->to_lights, .occluded = r->occluded)
#define INTERSECT(list, top_of, nodes_of, triangles_of) \
	RAYS(list, top_of, nodes_of, triangles_of, .after = after, .last = after ? r->last : r->hits, .hits = r->hits)

	switch (kernel) {
	case KERNEL_occlude_packet:
		return launch_occlude_packet(dev, packets, OCCLUDE_WIDE);
	case KERNEL_occlude_wide:
		return launch_occlude_wide(dev, r->n, OCCLUDE_WIDE);
	case KERNEL_occlude_binary:
		return launch_occlude_binary(dev, r->n, OCCLUDE(occlude_binary, top2, nodes2, triangles));
	case KERNEL_occlude_compressed:
		return launch_occlude_compressed(dev, r->n, OCCLUDE(occlude_compressed, top2, nodes8c, triangles8c));
	case KERNEL_intersect_packet:
		return launch_intersect_packet(dev, packets, INTERSECT(intersect_wide, top8, nodes8, triangles8));
	case KERNEL_intersect_wide:
		return launch_intersect_wide(dev, r->n, INTERSECT(intersect_wide, top8, nodes8, triangles8));
	case KERNEL_intersect_binary:
		return launch_intersect_binary(dev, r->n, INTERSECT(intersect_binary, top2, nodes2, triangles));
	case KERNEL_intersect_compressed:
		return launch_intersect_compressed(dev, r->n,
		                                   INTERSECT(intersect_compressed, top2, nodes8c, triangles8c));
	default:
		return no_such_kernel(kernel);
	}
}
