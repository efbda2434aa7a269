/* The table of twins: converts arguments passed one by one to the structs that twins read. */
#include "kernels/ref/take.h"

KERNEL_GROUPS(TAKE_GROUP_LIST)
KERNEL_LISTS(TAKE_KERNEL_LIST)

#define RUN(name, list) \
	static void run_##name(void *const *arguments, size_t first, size_t last) \
	{ \
		struct list##_arguments a; \
\
		take_##list(&a, &arguments); \
		name##_c(&a, first, last); \
	}
KERNELS(RUN)

const struct kernel_entry kernel_entries[N_KERNELS] = {
#define ENTRY(name, list) { #name, run_##name },
	KERNELS(ENTRY)
};
