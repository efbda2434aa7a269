/*
 * An OpenCL device that fails or has limited resources: preloaded before the ICD loader, on top of a real device.
 *   FAIL_CALL=N      the N-th call (from 1) fails; FAIL_NAME=clName: the N-th call of this function
 *   FAIL_GONE=1      all later calls fail, too
 *   FAIL_CODE=-N     error code; default CL_OUT_OF_RESOURCES
 *   FAIL_ONLY=1      only on the first device used; others work. For launches only
 *   COUNT_CALLS=FILE receives the number of calls, the peak memory, and the size of the largest buffer
 *   EDIT=THIS|THAT   replaces THIS by THAT in the text of kernels
 *   DIE=WORD         ends the process when a kernel with WORD in its name is launched
 *   HANG=WORD        never returns when such a kernel is launched
 *   FAULT=HOW,WHERE,WORD,N  the N-th (from 1) call of a kind goes wrong in this process. WHERE: build (of programs
 *                    whose text contains WORD), create or launch (of kernels whose name contains
 *                    it), thread (as launch,
 *                    in a thread of the driver's own). HOW: abort, segv, exit, hang, spin (hangs and
 *                    computes), code
 *                    (returns an error that OpenCL does not define). Separate several faults by ';'
 *   FAULT_MET=FILE   receives a line for each of these
 *   FAULT_WITH=WORD  only in processes that have created a kernel whose name contains WORD
 *   SLOW_BUILD=N     compiling takes N and a half seconds longer
 *   AS_TYPE=gpu      the device claims to be a GPU (accelerator: likewise)
 *   AS_PLATFORM=NAME, AS_DRIVER=VERSION  reported instead of the real ones
 *   AS_MEMORY=N      reports N bytes of memory
 *   AS_BUFFER=N      refuses larger buffers
 *   MOST_ITEMS=N     refuses launches of more work items
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static atomic_long calls, all_calls;
static atomic_int killed;
static atomic_ullong used_bytes, most_bytes, largest_bytes;
static _Atomic(cl_device_id) first;

static unsigned long long number(const char *name)
{
	const char *text = getenv(name);

	return text ? strtoull(text, NULL, 10) : 0;
}

/* Whether calls on a queue's device may fail. */
static int is_chosen(cl_command_queue queue)
{
	cl_device_id device = NULL, none = NULL;

	if (!getenv("FAIL_ONLY"))
		return 1;
	REAL(clGetCommandQueueInfo)(queue, CL_QUEUE_DEVICE, sizeof(device), &device, NULL);
	return atomic_compare_exchange_strong(&first, &none, device) || none == device;
}

/* The error of a call that must fail, or CL_SUCCESS. */
static cl_int fate(const char *name)
{
	const char *only = getenv("FAIL_NAME"), *code = getenv("FAIL_CODE");
	const long which = (long)number("FAIL_CALL");
	long n;

	atomic_fetch_add(&all_calls, 1);
	if (atomic_load(&killed))
		return CL_INVALID_COMMAND_QUEUE;
	if (!which || (only && strcmp(only, name) != 0))
		return CL_SUCCESS;
	n = atomic_fetch_add(&calls, 1) + 1;
	return n == which || (n > which && getenv("FAIL_GONE")) ? code ? atoi(code) : CL_OUT_OF_RESOURCES : CL_SUCCESS;
}

__attribute__((destructor)) static void leave_count(void)
{
	const char *path = getenv("COUNT_CALLS");
	FILE *file = path ? fopen(path, "w") : NULL;

	if (file) {
		fprintf(file, "%ld %llu %llu\n", atomic_load(&all_calls), atomic_load(&most_bytes), atomic_load(&largest_bytes));
		fclose(file);
	}
}

/* --- Calls that only fail --------------------------------------------------------------------------------------- */

/* CODE is for functions that return a code, OBJECT for those that return an object and pass the code last. */
#define CODE(name, parameters, ...) \
	cl_int name parameters \
	{ \
		const cl_int code = fate(#name); \
\
		return code ? code : REAL(name)(__VA_ARGS__); \
	}
#define OBJECT(type, name, parameters, ...) \
	type name parameters \
	{ \
		const cl_int failed = fate(#name); \
\
		*code = failed; \
		return failed ? NULL : REAL(name)(__VA_ARGS__, code); \
	}

CODE(clGetPlatformIDs, (cl_uint n, cl_platform_id *out, cl_uint *found), n, out, found)
CODE(clGetDeviceIDs, (cl_platform_id p, cl_device_type type, cl_uint n, cl_device_id *out, cl_uint *found), p, type, n,
     out, found)
CODE(clCreateSubDevices,
     (cl_device_id d, const cl_device_partition_property *how, cl_uint n, cl_device_id *out, cl_uint *made), d, how, n,
     out, made)
CODE(clGetProgramInfo, (cl_program p, cl_program_info what, size_t size, void *value, size_t *needed), p, what, size,
     value, needed)
CODE(clGetProgramBuildInfo,
     (cl_program p, cl_device_id d, cl_program_build_info what, size_t size, void *value, size_t *needed), p, d, what,
     size, value, needed)
CODE(clSetKernelArg, (cl_kernel k, cl_uint i, size_t size, const void *value), k, i, size, value)
CODE(clGetEventInfo, (cl_event e, cl_event_info what, size_t size, void *value, size_t *needed), e, what, size, value,
     needed)
CODE(clFinish, (cl_command_queue q), q)
CODE(clEnqueueWriteBuffer,
     (cl_command_queue q, cl_mem m, cl_bool wait, size_t at, size_t size, const void *data, cl_uint n,
      const cl_event *events, cl_event *event),
     q, m, wait, at, size, data, n, events, event)
CODE(clEnqueueReadBuffer,
     (cl_command_queue q, cl_mem m, cl_bool wait, size_t at, size_t size, void *data, cl_uint n, const cl_event *events,
      cl_event *event),
     q, m, wait, at, size, data, n, events, event)
OBJECT(cl_context, clCreateContext,
       (const cl_context_properties *properties, cl_uint n, const cl_device_id *d,
        void(CL_CALLBACK *notify)(const char *, const void *, size_t, void *), void *user, cl_int *code),
       properties, n, d, notify, user)
OBJECT(cl_command_queue, clCreateCommandQueue,
       (cl_context c, cl_device_id d, cl_command_queue_properties properties, cl_int *code), c, d, properties)
OBJECT(cl_program, clCreateProgramWithBinary,
       (cl_context c, cl_uint n, const cl_device_id *d, const size_t *lengths, const unsigned char **binaries,
        cl_int *status, cl_int *code),
       c, n, d, lengths, binaries, status)
CODE(clEnqueueUnmapMemObject,
     (cl_command_queue q, cl_mem m, void *mapped, cl_uint n, const cl_event *events, cl_event *event), q, m, mapped, n,
     events, event)
OBJECT(void *, clEnqueueMapBuffer,
       (cl_command_queue q, cl_mem m, cl_bool wait, cl_map_flags how, size_t at, size_t size, cl_uint n,
        const cl_event *events, cl_event *event, cl_int *code),
       q, m, wait, how, at, size, n, events, event)

/* --- Calls with changed results --------------------------------------------------------------------------------- */

/* Whether a kernel's name contains the word in an environment variable. */
static int is_named(const char *variable, cl_kernel kernel)
{
	const char *word = getenv(variable);
	char name[128] = "";

	return word && clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof(name) - 1, name, NULL) == CL_SUCCESS &&
	       strstr(name, word);
}

/* --- FAULT ------------------------------------------------------------------------------------------------------- */

#define MOST_FAULTS 8
#define RUBBISH (-12345)

static atomic_int has_kernel; /* for FAULT_WITH */
static int met_file = -1;     /* for FAULT_MET */
static atomic_long met[MOST_FAULTS];

/* Opened before the sandbox is set up. */
__attribute__((constructor)) static void open_met(void)
{
	if (getenv("FAULT_MET"))
		met_file = open(getenv("FAULT_MET"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
}

/* Apply the fault. @return the code that the call returns */
static cl_int go_wrong(const char *how)
{
	static int *volatile nowhere;

	if (met_file >= 0)
		dprintf(met_file, "%s\n", how);

	if (strcmp(how, "abort") == 0)
		abort();
	if (strcmp(how, "segv") == 0)
		*nowhere = 0;
	if (strcmp(how, "exit") == 0)
		exit(1);
	while (strcmp(how, "hang") == 0)
		pause();
	while (strcmp(how, "spin") == 0)
		;
	return RUBBISH;
}

static void *go_wrong_apart(void *how)
{
	go_wrong(how);
	return NULL;
}

/* Check a call against FAULT. text: name or source of its object */
static cl_int meet(const char *where, const char *text)
{
	const char *all = getenv("FAULT");
	char how[16], at[16], word[64];
	pthread_t thread;

	for (int i = 0; all && i < MOST_FAULTS; i++, all = strchr(all, ';') ? strchr(all, ';') + 1 : NULL) {
		long n = 1;
		int is_apart;

		word[0] = '\0';
		if (sscanf(all, "%15[^,;],%15[^,;],%63[^,;],%ld", how, at, word, &n) < 3)
			sscanf(all, "%15[^,;],%15[^,;],,%ld", how, at, &n);
		is_apart = strcmp(at, "thread") == 0;
		if (strcmp(is_apart ? "launch" : at, where) != 0 || !strstr(text, word) || atomic_fetch_add(&met[i], 1) + 1 != n ||
		    (getenv("FAULT_WITH") && !atomic_load(&has_kernel)))
			continue;
		if (!is_apart)
			return go_wrong(how);
		pthread_create(&thread, NULL, go_wrong_apart, strdup(how));
		pause();
	}
	return CL_SUCCESS;
}

cl_kernel clCreateKernel(cl_program program, const char *name, cl_int *code)
{
	*code = fate("clCreateKernel");
	if (getenv("FAULT_WITH") && strstr(name, getenv("FAULT_WITH")))
		atomic_store(&has_kernel, 1);
	if (!*code)
		*code = meet("create", name);
	return *code ? NULL : REAL(clCreateKernel)(program, name, code);
}

/* The most recent launches with profiling events. */
#define N_LAUNCHES 256
static struct launch {
	cl_event event;
	size_t items;
} launches[N_LAUNCHES];
static atomic_ulong n_launches;

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint n, const cl_event *wait,
                              cl_event *event)
{
	cl_int code = is_chosen(queue) ? fate("clEnqueueNDRangeKernel") : CL_SUCCESS;
	char name[128] = "";

	if (is_named("DIE", kernel))
		abort();
	while (is_named("HANG", kernel))
		pause();
	if (!code && getenv("FAULT") &&
	    clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof(name) - 1, name, NULL) == CL_SUCCESS)
		code = meet("launch", name);
	if (code)
		return code;
	if (getenv("MOST_ITEMS") && *global > number("MOST_ITEMS"))
		return CL_OUT_OF_RESOURCES;
	if (*global * number("ITEM_NS") > 1000000000u)
		atomic_store(&killed, 1);
	code = REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local, n, wait, event);
	if (!code && event)
		launches[atomic_fetch_add(&n_launches, 1) % N_LAUNCHES] = (struct launch){ *event, *global };
	return code;
}

cl_int clGetEventProfilingInfo(cl_event event, cl_profiling_info what, size_t size, void *value, size_t *needed)
{
	const cl_int code = fate("clGetEventProfilingInfo");
	cl_ulong ns = 1;

	if (code || !getenv("ITEM_NS"))
		return code ? code : REAL(clGetEventProfilingInfo)(event, what, size, value, needed);
	for (size_t i = 0; what == CL_PROFILING_COMMAND_END && i < N_LAUNCHES; i++)
		if (launches[i].event == event)
			ns += launches[i].items * number("ITEM_NS");
	memcpy(value, &ns, sizeof(ns));
	return CL_SUCCESS;
}

static void raise_to(atomic_ullong *most, unsigned long long value)
{
	unsigned long long seen = atomic_load(most);

	while (seen < value && !atomic_compare_exchange_weak(most, &seen, value))
		;
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host, cl_int *code)
{
	cl_mem mem = NULL;

	*code = fate("clCreateBuffer");
	if (!*code && getenv("AS_BUFFER") && bytes > number("AS_BUFFER"))
		*code = CL_INVALID_BUFFER_SIZE;
	if (!*code && getenv("AS_MEMORY") && atomic_load(&used_bytes) + bytes > number("AS_MEMORY"))
		*code = CL_MEM_OBJECT_ALLOCATION_FAILURE;
	if (!*code)
		mem = REAL(clCreateBuffer)(context, flags, bytes, host, code);
	if (mem) {
		raise_to(&most_bytes, atomic_fetch_add(&used_bytes, bytes) + bytes);
		raise_to(&largest_bytes, bytes);
	}
	return mem;
}

cl_int clReleaseMemObject(cl_mem mem)
{
	size_t bytes = 0;

	REAL(clGetMemObjectInfo)(mem, CL_MEM_SIZE, sizeof(bytes), &bytes, NULL);
	atomic_fetch_sub(&used_bytes, bytes);
	return REAL(clReleaseMemObject)(mem);
}

/* A text with its first `this` replaced, or NULL if it has none. */
static char *edited(const char *text, const char *this, size_t n, const char *that)
{
	const char *at = memmem(text, strlen(text), this, n);
	char *out = at ? malloc(strlen(text) + strlen(that) + 1) : NULL;

	if (out)
		sprintf(out, "%.*s%s%s", (int)(at - text), text, that, at + n);
	return out;
}

/* Relume passes texts that end with a 0. */
cl_program clCreateProgramWithSource(cl_context context, cl_uint n, const char **texts, const size_t *lengths,
                                     cl_int *code)
{
	const char *edit = getenv("EDIT"), *that = edit ? strchr(edit, '|') : NULL, *changed[8];

	*code = fate("clCreateProgramWithSource");
	if (*code)
		return NULL;
	for (cl_uint i = 0; that && i < n && n <= 8; i++) {
		char *text = edited(texts[i], edit, (size_t)(that - edit), that + 1);

		changed[i] = text ? text : texts[i];
	}
	return REAL(clCreateProgramWithSource)(context, n, that && n <= 8 ? changed : texts, lengths, code);
}

cl_int clBuildProgram(cl_program program, cl_uint n, const cl_device_id *devices, const char *options,
                      void(CL_CALLBACK *notify)(cl_program, void *), void *user)
{
	static char text[4 << 20];
	cl_int code = fate("clBuildProgram");

	if (getenv("FAULT") &&
	    REAL(clGetProgramInfo)(program, CL_PROGRAM_SOURCE, sizeof(text) - 1, text, NULL) == CL_SUCCESS && !code)
		code = meet("build", text);
	if (getenv("SLOW_BUILD"))
		nanosleep(&(struct timespec){ (time_t)number("SLOW_BUILD"), 500000000 }, NULL);
	return code ? code : REAL(clBuildProgram)(program, n, devices, options, notify, user);
}

/* Return a text in place of the real one. */
static void say(const char *text, size_t size, void *value, size_t *needed)
{
	if (value && size)
		snprintf(value, size, "%s", text);
	if (needed)
		*needed = strlen(text) + 1;
}

cl_int clGetPlatformInfo(cl_platform_id platform, cl_platform_info what, size_t size, void *value, size_t *needed)
{
	cl_int code = fate("clGetPlatformInfo");

	if (!code)
		code = REAL(clGetPlatformInfo)(platform, what, size, value, needed);
	if (!code && what == CL_PLATFORM_NAME && getenv("AS_PLATFORM"))
		say(getenv("AS_PLATFORM"), size, value, needed);
	return code;
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void *value, size_t *needed)
{
	const cl_int code = fate("clGetDeviceInfo");
	const cl_int real = code ? code : REAL(clGetDeviceInfo)(device, what, size, value, needed);
	const char *type = getenv("AS_TYPE");
	const cl_device_type as = type && strcmp(type, "gpu") == 0 ? CL_DEVICE_TYPE_GPU : CL_DEVICE_TYPE_ACCELERATOR;
	const cl_ulong bytes = what == CL_DEVICE_GLOBAL_MEM_SIZE ? number("AS_MEMORY") :
	                       what == CL_DEVICE_MAX_MEM_ALLOC_SIZE ? number("AS_BUFFER") : 0;

	if (real || !value)
		return real;
	if (what == CL_DEVICE_TYPE && type)
		memcpy(value, &as, sizeof(as));
	if (what == CL_DRIVER_VERSION && getenv("AS_DRIVER"))
		say(getenv("AS_DRIVER"), size, value, needed);
	if (bytes)
		memcpy(value, &bytes, sizeof(bytes));
	return real;
}
