#include "tracer/device/launch.h"

/* Flatten the arguments of a list, with groups expanded in place. @return end of the arguments */
#define LIST_BUFFER(element, name) *to++ = (struct device_arg){ .buffer = a->name.buffer };
#define LIST_VALUE(element, name) *to++ = (struct device_arg){ .value = &a->name, .bytes = sizeof(a->name) };
#define LIST_GROUP(list, name) to = list_##list(&a->name, to);
#define LIST(list) \
	static struct device_arg *list_##list(const struct list##_launch *a, struct device_arg *to) \
	{ \
		ARGUMENTS_##list(LIST_BUFFER, LIST_BUFFER, LIST_VALUE, LIST_GROUP, KERNEL_NOTHING) \
		return to; \
	}
KERNEL_GROUPS(LIST)
KERNEL_LISTS(LIST)

/* Number of arguments in a list. */
#define FLAT_GROUP(list, name) LAUNCH_COUNT_##list
#define LAUNCH_FUNCTION(name, list) \
	int launch_##name(struct device *dev, size_t n_items, const struct list##_launch *a) \
	{ \
		struct device_arg args[ARGUMENTS_##list(LAUNCH_ONE, LAUNCH_ONE, LAUNCH_ONE, FLAT_GROUP, LAUNCH_PLUS)]; \
\
		_Static_assert(sizeof(args) / sizeof(args[0]) <= DEVICE_MAX_ARGS, "a kernel has more arguments than devices take"); \
		return device_run(dev, KERNEL_##name, n_items, args, (size_t)(list_##list(a, args) - args)); \
	}
KERNELS(LAUNCH_FUNCTION)
