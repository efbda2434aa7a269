/*
 * An OpenCL device that fails, or has less than it seems: preloaded before the ICD loader, it
 *   FAIL_AFTER=N   refuses to run kernels from the N-th launch on, as a GPU does that fell off the bus
 *   FAIL_ONLY=1    the same on the first device used alone: others go on
 *   EDIT=THIS|THAT compiles kernels that have THAT where their text has THIS
 *   DIE=WORD       ends the process when such a kernel is to run
 *   HANG=WORD      never returns when such a kernel is to run
 *   SLOW_BUILD=1   compiles for a second and a half longer
 *   AS_TYPE=gpu    says that it is a GPU (accelerator: one of these)
 *   AS_DRIVER=TEXT says that its driver has this version
 *   AS_MEMORY=N    says that it has so many bytes of memory
 *   AS_BUFFER=N    says that no buffer may be larger
 * Everything else goes to the real device.
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static atomic_long launches;
static _Atomic(cl_device_id) first;

/* Whether launches on a queue's device may fail. */
static int is_chosen(cl_command_queue queue)
{
	cl_device_id device = NULL, none = NULL;

	if (!getenv("FAIL_ONLY"))
		return 1;
	clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof(device), &device, NULL);
	return atomic_compare_exchange_strong(&first, &none, device) || none == device;
}

/* Whether a kernel's name holds the word that a variable names. */
static int is_named(const char *variable, cl_kernel kernel)
{
	const char *word = getenv(variable);
	char name[128] = "";

	return word && clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof(name) - 1, name, NULL) == CL_SUCCESS && strstr(name, word);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint n, const cl_event *wait, cl_event *event)
{
	const char *after = getenv("FAIL_AFTER");

	if (is_named("DIE", kernel))
		abort();
	while (is_named("HANG", kernel))
		pause();
	if (after && is_chosen(queue) && atomic_fetch_add(&launches, 1) >= atol(after))
		return CL_OUT_OF_RESOURCES;
	return REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local, n, wait, event);
}

/* A text with its first `this` replaced; NULL: there is none. */
static char *edited(const char *text, const char *this, size_t n, const char *that)
{
	const char *at = memmem(text, strlen(text), this, n);
	char *out = at ? malloc(strlen(text) + strlen(that) + 1) : NULL;

	if (out)
		sprintf(out, "%.*s%s%s", (int)(at - text), text, that, at + n);
	return out;
}

/* Texts end with a 0, as ours do. */
cl_program clCreateProgramWithSource(cl_context context, cl_uint n, const char **texts, const size_t *lengths, cl_int *code)
{
	const char *edit = getenv("EDIT"), *that = edit ? strchr(edit, '|') : NULL, *changed[8];

	for (cl_uint i = 0; that && i < n && n <= 8; i++) {
		char *text = edited(texts[i], edit, (size_t)(that - edit), that + 1);

		changed[i] = text ? text : texts[i];
	}
	return REAL(clCreateProgramWithSource)(context, n, that && n <= 8 ? changed : texts, lengths, code);
}

cl_int clBuildProgram(cl_program program, cl_uint n, const cl_device_id *devices, const char *options,
                      void(CL_CALLBACK *notify)(cl_program, void *), void *user)
{
	if (getenv("SLOW_BUILD"))
		nanosleep(&(struct timespec){ 1, 500000000 }, NULL);
	return REAL(clBuildProgram)(program, n, devices, options, notify, user);
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void *value, size_t *needed)
{
	const cl_int code = REAL(clGetDeviceInfo)(device, what, size, value, needed);
	const char *type = getenv("AS_TYPE"), *memory = getenv("AS_MEMORY"), *buffer = getenv("AS_BUFFER"),
	           *driver = getenv("AS_DRIVER");
	cl_device_type as = type && strcmp(type, "gpu") == 0 ? CL_DEVICE_TYPE_GPU : CL_DEVICE_TYPE_ACCELERATOR;
	cl_ulong bytes;

	if (code != CL_SUCCESS || !value)
		return code;
	if (what == CL_DEVICE_TYPE && type)
		memcpy(value, &as, sizeof(as));
	if (what == CL_DRIVER_VERSION && driver)
		snprintf(value, size, "%s", driver);
	bytes = memory && what == CL_DEVICE_GLOBAL_MEM_SIZE ? strtoull(memory, NULL, 10) :
	        buffer && what == CL_DEVICE_MAX_MEM_ALLOC_SIZE ? strtoull(buffer, NULL, 10) : 0;
	if (bytes)
		memcpy(value, &bytes, sizeof(bytes));
	return code;
}
