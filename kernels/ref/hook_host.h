/*
 * A hook's kernels for the reference device, if clang is available: OpenCL C compiled for this processor, after
 * host_builtins.h and the hook's declarations, before its text (tracer/hook/host.h). host_NAME is a kernel_twin.
 */
#pragma once

#include "kernels/frame/hook/hook.h"
#include "kernels/frame/hook/hook_object.h"
#include "kernels/ref/take.h"

KERNEL_GROUPS(TAKE_GROUP_LIST)
HOOK_LISTS(TAKE_KERNEL_LIST)

#define HOST_TWIN(name) \
	void host_##name(void *const *arguments, size_t first, size_t last); \
	void host_##name(void *const *arguments, size_t first, size_t last) \
	{ \
		struct name##_arguments a; \
\
		take_##name(&a, &arguments); \
		for (size_t i = first; i < last; i++) \
			name##_item(&a, (uint32_t)i); \
	}
HOOK_LISTS(HOST_TWIN)
