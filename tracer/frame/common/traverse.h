/*
 * Trees on a device, and rays traced through them by the kernels of any family.
 */
#pragma once

#include "tracer/accel/accel.h"
#include "tracer/device/launch.h"

/* X(element, name): pools of BLASes, and TLASes, by their names in struct accel. */
#define TRAVERSE_POOLS(X) \
	X(node2, nodes2) X(node8, nodes8) X(node8c, nodes8c) X(triangle, triangles) X(triangle8, triangles8) \
	X(triangle, triangles8c) \
	X(face8, faces8)
#define TRAVERSE_TLASES(X) X(node2, top2) X(node8, top8) X(uint, instance_list)

/* Trees on the device. A kernel needs only those that its family traverses. */
struct traverse_trees {
#define TRAVERSE_FIELD(element, name) union buffer_##element name;
	TRAVERSE_POOLS(TRAVERSE_FIELD)
	TRAVERSE_TLASES(TRAVERSE_FIELD)
	union buffer_instance instances;
	union buffer_uint opacity; /* the instances' words (kernels/rays/opacity.h); borrowed; NULL: none has any */
};

/** Upload all pools; upload TLASes and instances, which change every frame. @return 0 or ERR_SYSTEM (reported) */
int traverse_upload_pools(struct device *dev, const struct accel *accel, struct traverse_trees *trees);
int traverse_upload_tlases(struct device *dev, const struct accel *accel, const struct instance *instances, size_t n,
                         struct traverse_trees *trees);
void traverse_release(struct device *dev, struct traverse_trees *trees);

/* The kernels of a family, and the trees that they traverse besides the binary ones. */
struct traverse_family {
	enum kernel camera, occlude, intersect;
	unsigned wide; /* as accel.wide */
};
extern const struct traverse_family traverse_families[N_DEVICE_FAMILIES];

/**
 * Trace camera rays.
 * @param kernel  KERNEL_camera_*
 * @param r       the view's camera_rectangle
 * @return 0 or ERR_SYSTEM (reported)
 */
int traverse_camera(struct device *dev, enum kernel kernel, const struct traverse_trees *trees,
                    struct camera_rectangle r, const struct camera_pass_launch *pass);

/* Rays through a space that is not empty, and the buffer for the results: one of occluded and hits. */
struct traverse_rays {
	const struct accel_space *space;
	uint32_t n, to_lights;      /* to_lights: 1: KERNEL_occlude_* ignores the sides that transmit light */
	union buffer_ray rays;
	union buffer_uint occluded; /* KERNEL_occlude_* */
	union buffer_hit last;      /* KERNEL_intersect_*: hits that the rays continue behind; NULL: none */
	union buffer_hit hits;      /* KERNEL_intersect_* */
};

/** @return as traverse_camera */
int traverse_rays(struct device *dev, enum kernel kernel, const struct traverse_trees *trees,
                  const struct traverse_rays *r);
