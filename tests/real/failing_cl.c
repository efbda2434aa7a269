/*
 * An OpenCL device that fails: preloaded before the ICD loader, it refuses to run kernels from the FAIL_AFTER-th launch on, as
 * a GPU does that fell off the bus. Everything else goes to the real device.
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdlib.h>

static atomic_long launches;

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint n, const cl_event *wait, cl_event *event)
{
	__typeof__(&clEnqueueNDRangeKernel) real = (__typeof__(&clEnqueueNDRangeKernel))dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
	const char *after = getenv("FAIL_AFTER");

	if (after && atomic_fetch_add(&launches, 1) >= atol(after))
		return CL_OUT_OF_RESOURCES;
	return real(queue, kernel, dimensions, offset, global, local, n, wait, event);
}
