/* Converts arguments passed one by one, as in kernel_twin, to the structs that twins read: take_LIST for each list of
 * kernels.h. */
#pragma once

#include "kernels/kernels.h"

/* Each takes its arguments from the front of the remaining ones. */
#define TAKE_BUFFER(element, name) a->name = (GLOBAL element_##element *)(size_t)*(*from)++;
#define TAKE_VALUE(element, name) a->name = *(const element_##element *)*(*from)++;
#define TAKE_GROUP(list, name) take_##list(&a->name, from);
#define TAKE(list, type) \
	static void take_##list(type *a, void *const **from) \
	{ \
		ARGUMENTS_##list(TAKE_BUFFER, TAKE_BUFFER, TAKE_VALUE, TAKE_GROUP, KERNEL_NOTHING) \
	}
#define TAKE_GROUP_LIST(list) TAKE(list, struct list)
#define TAKE_KERNEL_LIST(list) TAKE(list, struct list##_arguments)
