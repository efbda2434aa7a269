/*
 * Launching kernels with arguments checked by name and type. Each kernel has a function launch_NAME(device, work items,
 * arguments).
 *
 *     err = launch_credit(dev, n, LAUNCH(credit, .paths = paths, .radiance = radiance, .n = n, .shaded = shaded));
 *
 * An argument of the wrong type does not compile; neither does a missing, superfluous or repeated one.
 */
#pragma once

#include "kernels/kernels.h"
#include "tracer/device/device.h"

/* A buffer of elements. All zero: not allocated yet. */
#define LAUNCH_BUFFER(word) \
	union buffer_##word { \
		struct device_buffer *buffer; \
		const element_##word *element; /* only for its type */ \
	};
KERNEL_STRUCTS(LAUNCH_BUFFER)
LAUNCH_BUFFER(uint)
LAUNCH_BUFFER(half)
LAUNCH_BUFFER(float)

/* Make a buffer (an lvalue) hold at least `count` elements; upload also fills it. As device_reserve and
 * device_upload. */
#define launch_reserve(dev, of, count) device_reserve(dev, &(of).buffer, (size_t)(count) * sizeof(*(of).element))
#define launch_upload(dev, of, data, count) \
	((void)sizeof((of).element = (data)), device_upload(dev, &(of).buffer, data, (size_t)(count) * sizeof(*(of).element)))

/* struct NAME_launch: the arguments that the host sets, for each list of kernels/kernels.h. */
#define LAUNCH_FIELD_BUFFER(element, name) union buffer_##element name;
#define LAUNCH_FIELD_VALUE(element, name) element_##element name;
#define LAUNCH_FIELD_GROUP(list, name) struct list##_launch name;
#define LAUNCH_ONE(element, name) 1
#define LAUNCH_PLUS() +
#define LAUNCH_STRUCT(list) \
	struct list##_launch { \
		ARGUMENTS_##list(LAUNCH_FIELD_BUFFER, LAUNCH_FIELD_BUFFER, LAUNCH_FIELD_VALUE, LAUNCH_FIELD_GROUP, KERNEL_NOTHING) \
	}; \
	enum { LAUNCH_COUNT_##list = ARGUMENTS_##list(LAUNCH_ONE, LAUNCH_ONE, LAUNCH_ONE, LAUNCH_ONE, LAUNCH_PLUS) };
KERNEL_GROUPS(LAUNCH_STRUCT)
KERNEL_LISTS(LAUNCH_STRUCT)

/* The arguments of a list, by name. Checks that all are given: as many initialisers as fields, none twice
 * (-Werror=override-init). */
#define LAUNCH(list, ...) \
	(&(const struct list##_launch){ __VA_ARGS__ } + 0 * LAUNCH_CHECK(list, LAUNCH_COUNT(__VA_ARGS__)))
#define LAUNCH_CHECK(list, n) \
	sizeof(struct { int unused; \
	_Static_assert((n) == LAUNCH_COUNT_##list, "an argument of this kernel is missing or too many"); })
#define LAUNCH_COUNT(...) \
	LAUNCH_COUNTED(__VA_ARGS__, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10, \
	               9, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define LAUNCH_COUNTED(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, a1, a2, a3, a4, \
                       count, ...) \
	count

/**
 * Queue a kernel. Kernels of a device run one at a time, in the order queued.
 * @param n_items  work items; 0: nothing is queued
 * @param a        copied
 * @return 0, ERR_MEMORY, or ERR_SYSTEM (reported with the kernel and the OpenCL error)
 */
#define LAUNCH_DECLARE(name, list) int launch_##name(struct device *dev, size_t n_items, const struct list##_launch *a);
KERNELS(LAUNCH_DECLARE)
