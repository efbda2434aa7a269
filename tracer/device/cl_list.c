#include "tracer/device/cl_list.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/caches.h"
#include "base/err.h"
#include "tracer/device/cl.h"
#include "tracer/device/cl_error.h"

#define MAX_PLATFORMS 16

/*
 * PoCL gets cores and memory from hwloc, which reads /sys. In a chroot or container without /sys, PoCL 3.1 ends the
 * process ("Not enough memory to run on this device"). There, pass the values of sysconf to hwloc.
 */
static void describe_machine(void)
{
	long cores = sysconf(_SC_NPROCESSORS_ONLN), pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGESIZE);
	char text[96];

	if (access("/sys/devices/system/cpu", F_OK) == 0 || cores < 1 || pages < 1 || page_bytes < 1)
		return;
	snprintf(text, sizeof(text), "numa:1(memory=%lld) core:%ld pu:1", (long long)pages * page_bytes, cores);
	setenv("HWLOC_SYNTHETIC", text, 0);
}

int cl_list_find(cl_device_id ids[CL_LIST_MOST], size_t *n)
{
	cl_platform_id platforms[MAX_PLATFORMS];
	cl_uint n_platforms = 0, n_found;
	cl_int code, said = CL_SUCCESS; /* last error of a platform */

	describe_machine();
	caches_find();
	code = clGetPlatformIDs(MAX_PLATFORMS, platforms, &n_platforms);

	*n = 0;
	if (code != CL_SUCCESS)
		n_platforms = 0;
	if (n_platforms > MAX_PLATFORMS)
		n_platforms = MAX_PLATFORMS;
	for (cl_uint i = 0; i < n_platforms; i++) {
		n_found = 0;
		code = clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_CPU | CL_DEVICE_TYPE_GPU | CL_DEVICE_TYPE_ACCELERATOR,
		                      (cl_uint)(CL_LIST_MOST - *n), ids + *n, &n_found);
		if (code == CL_SUCCESS)
			*n = *n + n_found < CL_LIST_MOST ? *n + n_found : CL_LIST_MOST;
		else
			said = code;
	}
	if (*n == 0 && n_platforms)
		return err_report(ERR_SYSTEM, "OpenCL",
		                  "%u driver%s installed, without a device here (%s); repair %s, or use --device "
		                  "reference (slow)",
		                  n_platforms, n_platforms == 1 ? " is" : "s are", cl_error_name(said),
		                  n_platforms == 1 ? "it" : "them");
	if (*n == 0)
		return err_report(ERR_SYSTEM, "OpenCL",
		                  "there is no driver here (%s); install the Debian package pocl-opencl-icd (CPU) or your "
		                  "GPU's OpenCL driver, or use --device reference (slow)", cl_error_name(code));
	return 0;
}

uint64_t cl_list_bytes(cl_device_id id, cl_device_info what)
{
	cl_ulong bytes = 0;

	clGetDeviceInfo(id, what, sizeof(bytes), &bytes, NULL);
	return bytes;
}

enum device_type cl_list_type(cl_device_id id)
{
	cl_device_type type = 0;

	clGetDeviceInfo(id, CL_DEVICE_TYPE, sizeof(type), &type, NULL);
	return type & CL_DEVICE_TYPE_CPU ? DEVICE_CPU : type & CL_DEVICE_TYPE_GPU ? DEVICE_GPU : DEVICE_ACCELERATOR;
}

/* Vector width of a CPU; for a GPU, the number of work items in lockstep, which two vendors report
 * (cl_nv_device_attribute_query, cl_amd_device_attribute_query). */
static unsigned width_of(cl_device_id id)
{
	const cl_device_info of_gpu[] = { 0x4003 /* WARP_SIZE_NV */, 0x4043 /* WAVEFRONT_WIDTH_AMD */ };
	cl_uint width = 0;

	for (size_t i = 0; cl_list_type(id) != DEVICE_CPU && i < sizeof(of_gpu) / sizeof(of_gpu[0]); i++)
		if (clGetDeviceInfo(id, of_gpu[i], sizeof(width), &width, NULL) == CL_SUCCESS && width)
			return width;
	width = 0;
	if (cl_list_type(id) == DEVICE_CPU)
		clGetDeviceInfo(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof(width), &width, NULL);
	return width;
}

int cl_list(struct device_description **out, size_t *n)
{
	cl_device_id ids[CL_LIST_MOST];
	struct device_description *list;
	int err = cl_list_find(ids, n);

	if (err)
		return err;
	list = calloc(*n, sizeof(*list));
	if (!list)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < *n; i++) {
		cl_platform_id platform = NULL;
		cl_uint units = 0;

		clGetDeviceInfo(ids[i], CL_DEVICE_NAME, sizeof(list[i].name) - 1, list[i].name, NULL);
		clGetDeviceInfo(ids[i], CL_DRIVER_VERSION, sizeof(list[i].driver) - 1, list[i].driver, NULL);
		clGetDeviceInfo(ids[i], CL_DEVICE_VERSION, sizeof(list[i].version) - 1, list[i].version, NULL);
		clGetDeviceInfo(ids[i], CL_DEVICE_MAX_COMPUTE_UNITS, sizeof(units), &units, NULL);
		clGetDeviceInfo(ids[i], CL_DEVICE_PLATFORM, sizeof(platform), &platform, NULL);
		if (platform)
			clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof(list[i].platform) - 1, list[i].platform, NULL);
		list[i].number = (unsigned)i;
		list[i].type = cl_list_type(ids[i]);
		list[i].units = units;
		list[i].width = width_of(ids[i]);
		list[i].memory_bytes = cl_list_bytes(ids[i], CL_DEVICE_GLOBAL_MEM_SIZE);
		list[i].buffer_bytes = cl_list_bytes(ids[i], CL_DEVICE_MAX_MEM_ALLOC_SIZE);
	}
	*out = list;
	return 0;
}
