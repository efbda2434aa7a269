#include "tracer/device/cl_error.h"

#include "base/err.h"

/* Not in the core header: returned by the ICD loader when no driver is installed. */
#define CL_PLATFORM_NOT_FOUND (-1001)

const char *cl_error_name(cl_int code)
{
	static const struct {
		cl_int code;
		const char *name;
	} names[] = {
#define NAME(x) { x, #x }
		NAME(CL_DEVICE_NOT_FOUND), NAME(CL_DEVICE_NOT_AVAILABLE), NAME(CL_COMPILER_NOT_AVAILABLE),
		NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE), NAME(CL_OUT_OF_RESOURCES), NAME(CL_OUT_OF_HOST_MEMORY),
		NAME(CL_BUILD_PROGRAM_FAILURE), NAME(CL_DEVICE_PARTITION_FAILED), NAME(CL_INVALID_VALUE),
		NAME(CL_INVALID_PLATFORM), NAME(CL_INVALID_DEVICE), NAME(CL_INVALID_CONTEXT),
		NAME(CL_INVALID_COMMAND_QUEUE), NAME(CL_INVALID_MEM_OBJECT), NAME(CL_INVALID_BUILD_OPTIONS),
		NAME(CL_INVALID_PROGRAM), NAME(CL_INVALID_PROGRAM_EXECUTABLE), NAME(CL_INVALID_KERNEL_NAME),
		NAME(CL_INVALID_KERNEL), NAME(CL_INVALID_ARG_INDEX), NAME(CL_INVALID_ARG_VALUE),
		NAME(CL_INVALID_ARG_SIZE), NAME(CL_INVALID_KERNEL_ARGS), NAME(CL_INVALID_WORK_GROUP_SIZE),
		NAME(CL_INVALID_GLOBAL_WORK_SIZE), NAME(CL_INVALID_BUFFER_SIZE), NAME(CL_INVALID_OPERATION),
		NAME(CL_INVALID_DEVICE_PARTITION_COUNT), NAME(CL_PLATFORM_NOT_FOUND),
#undef NAME
	};

	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (names[i].code == code)
			return names[i].name;
	return "an unnamed OpenCL error";
}

/* OpenCL 1.2 defines -1 to -19 and -30 to -68, later versions up to -72. Extensions use -1000 and below. */
int cl_error_exists(cl_int code)
{
	return (code <= -1 && code >= -19) || (code <= -30 && code >= -72) || (code <= -1000 && code >= -1200) ||
	       (code <= -2000 && code >= -2100) || code == -9999; /* NVIDIA's code for an access outside a buffer */
}

int cl_report(int *said, cl_int code, const char *what)
{
	return __atomic_exchange_n(said, 1, __ATOMIC_RELAXED) ? ERR_SYSTEM :
	       err_report(ERR_SYSTEM, "OpenCL", "%s: %s (%d)", what, cl_error_name(code), code);
}
