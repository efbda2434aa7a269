/*
 * An OpenCL device inside this process, preloaded before the ICD loader. Kernels are compiled by a command that the
 * caller chooses (with sanitizers, other rounding, no inlining: test_host.py), and work items run sequentially, the
 * last one first.
 *   HOST_CL_COMPILE  the command: "clang OPTIONS", followed by file names
 *   HOST_CL_FOLDER   folder for compiled programs
 *   HOST_CL_FLUSH=1  numbers below 2^-126 count as 0
 *   HOST_CL_WIDTH=N  reports vectors of N floats; default 8
 * New buffers are full of NaN; bytes after their end must not change. A finding of UndefinedBehaviorSanitizer ends the
 * process.
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xmmintrin.h>

#define MAX_ARGUMENTS 64
#define GUARD_BYTES 4096
#define ALIGNMENT 128 /* at least CL_DEVICE_MEM_BASE_ADDR_ALIGN, for a long16 */
#define FLUSH_TO_ZERO 0x8040u

/* All objects of the interface except memory and programs. */
static char platform, device, context, queue;
#define PLATFORM ((cl_platform_id)(void *)&platform)
#define DEVICE ((cl_device_id)(void *)&device)

struct _cl_mem {
	size_t bytes;
	unsigned char *at;
};

struct _cl_program {
	char *text, *entries; /* entries: HOST_ENTRY(name, list) for each kernel */
	void *library;
};

typedef void host_run(void **arguments, unsigned long first, unsigned long last);

struct _cl_kernel {
	host_run *run;
	struct {
		_Alignas(16) unsigned char value[256];
		cl_mem buffer;
	} arguments[MAX_ARGUMENTS];
};

static void fail(const char *what, const char *more)
{
	fprintf(stderr, "host_cl: %s%s\n", what, more);
	abort();
}

/* --- Functions called by kernels --------------------------------------------------------------------------------- */

static _Thread_local unsigned long item;

void host_begin(unsigned long i);
void host_begin(unsigned long i)
{
	item = i;
}

unsigned long host_item(void);
unsigned long host_item(void)
{
	return item;
}

/* UndefinedBehaviorSanitizer's minimal runtime. */
static void found(const char *what, void *at)
{
	Dl_info info = { 0 };
	char command[4400];

	fprintf(stderr, "host_cl: %s in work item %lu\n", what, item);
	if (dladdr(at, &info) && info.dli_fname) {
		snprintf(command, sizeof(command), "addr2line -pfie '%s' %#lx >&2", info.dli_fname,
		         (unsigned long)((char *)at - (char *)info.dli_fbase - 1));
		unsetenv("LD_PRELOAD");
		if (system(command) != 0)
			fprintf(stderr, "%s\n", info.dli_fname);
	}
	abort();
}

#define HANDLER(what) \
	void __ubsan_handle_##what##_minimal(void); \
	void __ubsan_handle_##what##_minimal(void) \
	{ \
		found(#what, __builtin_return_address(0)); \
	}
HANDLER(type_mismatch)
HANDLER(alignment_assumption)
HANDLER(add_overflow)
HANDLER(sub_overflow)
HANDLER(mul_overflow)
HANDLER(negate_overflow)
HANDLER(divrem_overflow)
HANDLER(shift_out_of_bounds)
HANDLER(out_of_bounds)
HANDLER(builtin_unreachable)
HANDLER(missing_return)
HANDLER(vla_bound_not_positive)
HANDLER(float_cast_overflow)
HANDLER(load_invalid_value)
HANDLER(invalid_builtin)
HANDLER(nonnull_arg)
HANDLER(nonnull_return)
HANDLER(pointer_overflow)

/* --- Devices ----------------------------------------------------------------------------------------------------- */

static cl_int tell(const void *what, size_t bytes, size_t size, void *value, size_t *needed)
{
	if (needed)
		*needed = bytes;
	if (!value)
		return CL_SUCCESS;
	if (size < bytes)
		return CL_INVALID_VALUE;
	memcpy(value, what, bytes);
	return CL_SUCCESS;
}

static cl_int tell_text(const char *text, size_t size, void *value, size_t *needed)
{
	return tell(text, strlen(text) + 1, size, value, needed);
}

cl_int clGetPlatformIDs(cl_uint n, cl_platform_id *out, cl_uint *found_n)
{
	if (n && out)
		out[0] = PLATFORM;
	if (found_n)
		*found_n = 1;
	return CL_SUCCESS;
}

cl_int clGetPlatformInfo(cl_platform_id p, cl_platform_info what, size_t size, void *value, size_t *needed)
{
	(void)p;
	return tell_text(what == CL_PLATFORM_NAME ? "this process" : "OpenCL 1.2", size, value, needed);
}

cl_int clGetDeviceIDs(cl_platform_id p, cl_device_type type, cl_uint n, cl_device_id *out, cl_uint *found_n)
{
	(void)p;
	if (!(type & CL_DEVICE_TYPE_CPU))
		return CL_DEVICE_NOT_FOUND;
	if (n && out)
		out[0] = DEVICE;
	if (found_n)
		*found_n = 1;
	return CL_SUCCESS;
}

cl_int clGetDeviceInfo(cl_device_id d, cl_device_info what, size_t size, void *value, size_t *needed)
{
	const char *width = getenv("HOST_CL_WIDTH");
	const cl_device_type type = CL_DEVICE_TYPE_CPU;
	const cl_platform_id p = PLATFORM;
	const cl_ulong bytes = (cl_ulong)1 << 32;
	const cl_uint one = 1, lanes = width ? (cl_uint)atoi(width) : 8;
	const cl_device_fp_config rounding = CL_FP_INF_NAN | CL_FP_ROUND_TO_NEAREST;

	(void)d;
	switch (what) {
	case CL_DEVICE_TYPE:
		return tell(&type, sizeof(type), size, value, needed);
	case CL_DEVICE_PLATFORM:
		return tell(&p, sizeof(p), size, value, needed);
	case CL_DEVICE_GLOBAL_MEM_SIZE:
	case CL_DEVICE_MAX_MEM_ALLOC_SIZE:
		return tell(&bytes, sizeof(bytes), size, value, needed);
	case CL_DEVICE_MAX_COMPUTE_UNITS:
		return tell(&one, sizeof(one), size, value, needed);
	case CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT:
	case CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT:
		return tell(&lanes, sizeof(lanes), size, value, needed);
	case CL_DEVICE_SINGLE_FP_CONFIG:
		return tell(&rounding, sizeof(rounding), size, value, needed);
	case CL_DEVICE_NAME:
	case CL_DEVICE_VENDOR:
	case CL_DEVICE_VERSION:
	case CL_DRIVER_VERSION:
		return tell_text(what == CL_DEVICE_NAME ? "this processor" : "1", size, value, needed);
	default:
		return CL_INVALID_VALUE;
	}
}

cl_int clCreateSubDevices(cl_device_id d, const cl_device_partition_property *how, cl_uint n, cl_device_id *out,
                          cl_uint *made)
{
	(void)d, (void)how, (void)n, (void)out, (void)made;
	return CL_DEVICE_PARTITION_FAILED;
}

cl_int clReleaseDevice(cl_device_id d)
{
	(void)d;
	return CL_SUCCESS;
}

cl_context clCreateContext(const cl_context_properties *properties, cl_uint n, const cl_device_id *devices,
                           void(CL_CALLBACK *notify)(const char *, const void *, size_t, void *), void *user,
                           cl_int *code)
{
	(void)properties, (void)n, (void)devices, (void)notify, (void)user;
	*code = CL_SUCCESS;
	return (cl_context)(void *)&context;
}

cl_int clReleaseContext(cl_context c)
{
	(void)c;
	return CL_SUCCESS;
}

cl_command_queue clCreateCommandQueue(cl_context c, cl_device_id d, cl_command_queue_properties properties,
                                      cl_int *code)
{
	(void)c, (void)d, (void)properties;
	*code = CL_SUCCESS;
	return (cl_command_queue)(void *)&queue;
}

cl_int clReleaseCommandQueue(cl_command_queue q)
{
	(void)q;
	return CL_SUCCESS;
}

cl_int clFlush(cl_command_queue q)
{
	(void)q;
	return CL_SUCCESS;
}

cl_int clFinish(cl_command_queue q)
{
	(void)q;
	return CL_SUCCESS;
}

/* --- Buffers ----------------------------------------------------------------------------------------------------- */

cl_mem clCreateBuffer(cl_context c, cl_mem_flags flags, size_t bytes, void *host, cl_int *code)
{
	cl_mem mem = malloc(sizeof(*mem));

	(void)c, (void)flags, (void)host;
	mem->bytes = bytes;
	mem->at = aligned_alloc(ALIGNMENT, (bytes + GUARD_BYTES + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
	memset(mem->at, 0xff, bytes);
	memset(mem->at + bytes, 0xa5, GUARD_BYTES);
	*code = CL_SUCCESS;
	return mem;
}

cl_int clReleaseMemObject(cl_mem mem)
{
	free(mem->at);
	free(mem);
	return CL_SUCCESS;
}

/* Only CL_MEM_SIZE. */
cl_int clGetMemObjectInfo(cl_mem mem, cl_mem_info what, size_t size, void *value, size_t *needed)
{
	return what == CL_MEM_SIZE ? tell(&mem->bytes, sizeof(mem->bytes), size, value, needed) : CL_INVALID_VALUE;
}

static int is_whole(cl_mem mem)
{
	for (size_t i = 0; i < GUARD_BYTES; i++)
		if (mem->at[mem->bytes + i] != 0xa5)
			return 0;
	return 1;
}

cl_int clEnqueueWriteBuffer(cl_command_queue q, cl_mem mem, cl_bool wait, size_t offset, size_t bytes, const void *data,
                            cl_uint n, const cl_event *events, cl_event *event)
{
	(void)q, (void)wait, (void)n, (void)events, (void)event;
	if (offset > mem->bytes || bytes > mem->bytes - offset)
		return CL_INVALID_VALUE;
	memcpy(mem->at + offset, data, bytes);
	return CL_SUCCESS;
}

cl_int clEnqueueReadBuffer(cl_command_queue q, cl_mem mem, cl_bool wait, size_t offset, size_t bytes, void *data,
                           cl_uint n, const cl_event *events, cl_event *event)
{
	(void)q, (void)wait, (void)n, (void)events, (void)event;
	if (offset > mem->bytes || bytes > mem->bytes - offset)
		return CL_INVALID_VALUE;
	memcpy(data, mem->at + offset, bytes);
	return CL_SUCCESS;
}

void *clEnqueueMapBuffer(cl_command_queue q, cl_mem mem, cl_bool wait, cl_map_flags how, size_t offset, size_t bytes,
                         cl_uint n, const cl_event *events, cl_event *event, cl_int *code)
{
	(void)q, (void)wait, (void)how, (void)n, (void)events, (void)event;
	*code = offset > mem->bytes || bytes > mem->bytes - offset ? CL_INVALID_VALUE : CL_SUCCESS;
	return *code == CL_SUCCESS ? mem->at + offset : NULL;
}

cl_int clEnqueueUnmapMemObject(cl_command_queue q, cl_mem mem, void *mapped, cl_uint n, const cl_event *events,
                               cl_event *event)
{
	(void)q, (void)mem, (void)mapped, (void)n, (void)events, (void)event;
	return CL_SUCCESS;
}

/* --- Programs ---------------------------------------------------------------------------------------------------- */

cl_program clCreateProgramWithSource(cl_context c, cl_uint n, const char **texts, const size_t *lengths, cl_int *code)
{
	cl_program program = calloc(1, sizeof(*program));
	size_t bytes = 1;

	(void)c, (void)lengths;
	for (cl_uint i = 0; i < n; i++)
		bytes += strlen(texts[i]);
	program->text = calloc(1, bytes);
	for (cl_uint i = 0; i < n; i++)
		strcat(program->text, texts[i]);
	*code = CL_SUCCESS;
	return program;
}

cl_program clCreateProgramWithBinary(cl_context c, cl_uint n, const cl_device_id *devices, const size_t *lengths,
                                     const unsigned char **binaries, cl_int *status, cl_int *code)
{
	(void)c, (void)n, (void)devices, (void)lengths, (void)binaries;
	*status = *code = CL_INVALID_BINARY;
	return NULL;
}

/* HOST_ENTRY(name, list) for each line that starts a kernel: "... void name(KERNEL_ARGUMENTS(list))". */
static char *entries_of(const char *text)
{
	static const char arguments[] = "(KERNEL_ARGUMENTS(";
	char *out = calloc(1, strlen(text) + 64), *to = out;

	for (const char *at = strstr(text, arguments); at; at = strstr(at + 1, arguments)) {
		const char *name = at, *line = at, *list = at + sizeof(arguments) - 1;

		while (name > text && name[-1] != ' ')
			name--;
		while (line > text && line[-1] != '\n')
			line--;
		if (strncmp(line, "__kernel", 8) == 0 || strncmp(line, "KERNEL_OF", 9) == 0)
			to += sprintf(to, "HOST_ENTRY(%.*s, %.*s)\n", (int)(at - name), name, (int)strcspn(list, ")"), list);
	}
	return out;
}

static uint64_t hash_of(const char *text, uint64_t hash)
{
	for (; *text; text++)
		hash = (hash ^ (unsigned char)*text) * 0x100000001b3u;
	return hash;
}

/* Compile a program to a file. @return 0 or the compiler's exit code */
static int compile(const cl_program program, const char *compiler, const char *to)
{
	char source[1024], command[8192], *preloaded = strdup(getenv("LD_PRELOAD"));
	FILE *file;
	int code;

	snprintf(source, sizeof(source), "%s.%d.cl", to, (int)getpid());
	file = fopen(source, "w");
	if (!file)
		fail("cannot write ", source);
	fprintf(file, "#include \"kernels/ref/host_builtins.h\"\n%s%s", program->text, program->entries);
	fclose(file);
	snprintf(command, sizeof(command), "s='%s'; %s -o \"$s.so\" \"$s\" && mv \"$s.so\" '%s'", source, compiler, to);
	unsetenv("LD_PRELOAD");
	code = system(command);
	setenv("LD_PRELOAD", preloaded, 1);
	free(preloaded);
	remove(source);
	return code;
}

cl_int clBuildProgram(cl_program program, cl_uint n, const cl_device_id *devices, const char *options,
                      void(CL_CALLBACK *notify)(cl_program, void *), void *user)
{
	static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
	const char *compiler = getenv("HOST_CL_COMPILE"), *folder = getenv("HOST_CL_FOLDER");
	char path[512];
	int failed = 0;

	(void)n, (void)devices, (void)options, (void)notify, (void)user;
	if (!compiler || !folder)
		fail("HOST_CL_COMPILE and HOST_CL_FOLDER are not set", "");
	program->entries = entries_of(program->text);
	snprintf(path, sizeof(path), "%s/%016llx.so", folder,
	         (unsigned long long)hash_of(program->text, hash_of(compiler, 0xcbf29ce484222325u)));
	pthread_mutex_lock(&lock);
	if (access(path, R_OK) != 0)
		failed = compile(program, compiler, path);
	pthread_mutex_unlock(&lock);
	if (failed)
		return CL_BUILD_PROGRAM_FAILURE;
	program->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
	if (!program->library)
		fail("incomplete program: ", dlerror());
	return CL_SUCCESS;
}

cl_int clGetProgramBuildInfo(cl_program program, cl_device_id d, cl_program_build_info what, size_t size, void *value,
                             size_t *needed)
{
	(void)program, (void)d, (void)what;
	return tell_text("", size, value, needed);
}

cl_int clGetProgramInfo(cl_program program, cl_program_info what, size_t size, void *value, size_t *needed)
{
	(void)program, (void)what, (void)size, (void)value, (void)needed;
	return CL_INVALID_VALUE;
}

cl_int clReleaseProgram(cl_program program)
{
	free(program->text);
	free(program->entries);
	free(program);
	return CL_SUCCESS;
}

/* --- Kernels ----------------------------------------------------------------------------------------------------- */

cl_kernel clCreateKernel(cl_program program, const char *name, cl_int *code)
{
	cl_kernel kernel = calloc(1, sizeof(*kernel));
	char symbol[128];

	snprintf(symbol, sizeof(symbol), "host_run_%s", name);
	*(void **)&kernel->run = dlsym(program->library, symbol);
	*code = kernel->run ? CL_SUCCESS : CL_INVALID_KERNEL_NAME;
	return kernel->run ? kernel : NULL;
}

cl_int clReleaseKernel(cl_kernel kernel)
{
	free(kernel);
	return CL_SUCCESS;
}

cl_int clSetKernelArg(cl_kernel kernel, cl_uint i, size_t bytes, const void *value)
{
	cl_mem buffer = NULL;

	if (i >= MAX_ARGUMENTS || bytes > sizeof(kernel->arguments[0].value))
		return CL_INVALID_ARG_SIZE;
	/* A buffer: no value has that size (kernels/shared.h). */
	if (bytes == sizeof(buffer) && value)
		memcpy(&buffer, value, sizeof(buffer));
	kernel->arguments[i].buffer = buffer;
	if (buffer)
		memcpy(kernel->arguments[i].value, &buffer->at, sizeof(buffer->at));
	else if (value)
		memcpy(kernel->arguments[i].value, value, bytes);
	return CL_SUCCESS;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue q, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint n, const cl_event *wait,
                              cl_event *event)
{
	const size_t first = offset ? offset[0] : 0;
	const unsigned before = _mm_getcsr();
	void *arguments[MAX_ARGUMENTS];

	(void)q, (void)n, (void)wait, (void)event;
	if (dimensions != 1 || (local && (local[0] == 0 || global[0] % local[0] != 0)))
		return CL_INVALID_WORK_GROUP_SIZE;
	for (size_t i = 0; i < MAX_ARGUMENTS; i++)
		arguments[i] = kernel->arguments[i].value;
	if (getenv("HOST_CL_FLUSH"))
		_mm_setcsr(before | FLUSH_TO_ZERO);
	kernel->run(arguments, first, first + global[0]);
	_mm_setcsr(before);
	for (size_t i = 0; i < MAX_ARGUMENTS; i++)
		if (kernel->arguments[i].buffer && !is_whole(kernel->arguments[i].buffer))
			fail("a kernel writes behind a buffer's end", "");
	return CL_SUCCESS;
}
