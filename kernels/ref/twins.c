/* The twins' table: arguments one by one become the structs that twins read. */
#include "kernels/kernels.h"

/* Each takes its arguments from the front of what is left of them. */
#define TAKE_BUFFER(element, name) a->name = *(*from)++;
#define TAKE_VALUE(element, name) a->name = *(const element_##element *)*(*from)++;
#define TAKE_GROUP(list, name) take_##list(&a->name, from);
#define TAKE(list, type) \
	static void take_##list(type *a, void *const **from) \
	{ \
		ARGUMENTS_##list(TAKE_BUFFER, TAKE_BUFFER, TAKE_VALUE, TAKE_GROUP, KERNEL_NOTHING) \
	}
#define TAKE_GROUP_LIST(list) TAKE(list, struct list)
#define TAKE_KERNEL_LIST(list) TAKE(list, struct list##_arguments)
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
