#include "tracer/device/cl_program.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/kept.h"
#include "kernels/embed.h"
#include "tracer/device/cl_error.h"
#include "tracer/device/fault.h"
#include "tracer/hook/hook.h"

/*
 * Prepended to every program. The C twins are also compiled without contraction, so that both make the same decisions.
 * Packets are wider than the registers of a machine without AVX-512. LLVM 21 (PoCL 7.1) reports the effect on calling
 * conventions as an error, although no call leaves the program.
 */
static const char prelude[] = "#pragma OPENCL FP_CONTRACT OFF\n"
                              "#ifdef __clang__\n"
                              "#pragma clang diagnostic ignored \"-Wpsabi\"\n"
                              "#endif\n";

/* No program is larger than this; a greater size from the driver is invalid. */
#define MOST_BINARY ((size_t)1 << 30)

/* Raise when the same source must be compiled in a different way. */
#define PROGRAM_VERSION 1

/* Build options: ask for correctly rounded (IEEE 754) division and square roots on devices that do not round them so by
 * default. */
static const char *options_for(cl_device_id device)
{
	cl_device_fp_config rounding = 0;
	cl_device_type type = 0;

	clGetDeviceInfo(device, CL_DEVICE_TYPE, sizeof(type), &type, NULL);
	clGetDeviceInfo(device, CL_DEVICE_SINGLE_FP_CONFIG, sizeof(rounding), &rounding, NULL);
	return !(type & CL_DEVICE_TYPE_CPU) && rounding & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT
		       ? "-cl-std=CL1.2 -cl-fp32-correctly-rounded-divide-sqrt" : "-cl-std=CL1.2";
}

/* Text before and after a file's source: for files that call hooks, that of the hook. */
struct around {
	const char *before, *after;
	const char *name; /* name of the source in messages */
};

static struct around around_of(const struct kernel_file *kernels, const struct hook *hook)
{
	if (!hook || strcmp(kernels->name, "kernels/frame/hook/hook.cl") != 0)
		return (struct around){ "", "", kernels->name };
	return (struct around){ hook->declarations, hook->text, hook->path };
}

/* --- Keeping ----------------------------------------------------------------------------------------------------- */

static void platform_text(cl_device_id device, cl_platform_info what, char *text, size_t size)
{
	cl_platform_id platform = NULL;

	memset(text, 0, size);
	clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof(platform), &platform, NULL);
	if (platform)
		clGetPlatformInfo(platform, what, size - 1, text, NULL);
}

int cl_program_is_pocl(cl_device_id device)
{
	char platform[128];

	platform_text(device, CL_PLATFORM_NAME, platform, sizeof(platform));
	return strcmp(platform, "Portable Computing Language") == 0;
}

void cl_program_keep(cl_device_id device, const char *folder, int always, struct cl_keeping *keeping)
{
	keeping->folder[0] = '\0';
	if (!always && cl_program_is_pocl(device))
		return;
	if (snprintf(keeping->folder, sizeof(keeping->folder), "%s", folder) >= (int)sizeof(keeping->folder))
		keeping->folder[0] = '\0';
}

/* Update two independent hashes. */
static void mix(uint64_t key[2], const void *bytes, size_t n)
{
	key[0] = XXH3_64bits_withSeed(bytes, n, key[0]);
	key[1] = XXH64(bytes, n, key[1]);
}

/* Hash everything that a compiled program depends on. The file is named after the kernels, the hook and the device, so
 * a new version of the kernels or the driver replaces the old file. */
static void name_program(cl_device_id device, const struct kernel_file *kernels, struct around around,
                         const struct cl_keeping *keeping, char path[PATH_MAX], uint64_t key[2])
{
	static const cl_device_info of_device[] = { CL_DEVICE_NAME, CL_DEVICE_VENDOR, CL_DEVICE_VERSION, CL_DRIVER_VERSION };
	static const cl_platform_info of_platform[] = { CL_PLATFORM_NAME, CL_PLATFORM_VERSION };
	const char *slash = strrchr(kernels->name, '/'), *base = slash ? slash + 1 : kernels->name;
	const char *options = options_for(device);
	uint64_t name = PROGRAM_VERSION;
	char text[256];

	key[0] = key[1] = PROGRAM_VERSION;
	mix(key, prelude, sizeof(prelude));
	mix(key, kernels->text, strlen(kernels->text) + 1);
	if (*around.after) {
		mix(key, around.before, strlen(around.before) + 1);
		mix(key, around.after, strlen(around.after) + 1);
		name = XXH3_64bits_withSeed(around.after, strlen(around.after), name);
	}
	mix(key, options, strlen(options) + 1);
	for (size_t i = 0; i < sizeof(of_platform) / sizeof(of_platform[0]); i++) {
		platform_text(device, of_platform[i], text, sizeof(text));
		mix(key, text, sizeof(text));
		if (of_platform[i] == CL_PLATFORM_NAME)
			name = XXH3_64bits_withSeed(text, sizeof(text), name);
	}
	for (size_t i = 0; i < sizeof(of_device) / sizeof(of_device[0]); i++) {
		memset(text, 0, sizeof(text));
		clGetDeviceInfo(device, of_device[i], sizeof(text) - 1, text, NULL);
		mix(key, text, sizeof(text));
		if (of_device[i] == CL_DEVICE_NAME)
			name = XXH3_64bits_withSeed(text, sizeof(text), name);
	}
	snprintf(path, PATH_MAX, "%s/%.*s-%016llx.program", keeping->folder, (int)strcspn(base, "."), base,
	         (unsigned long long)name);
}

/* Load the program that an earlier run kept. @return NULL: nothing that the driver accepts */
static cl_program find_program(cl_context context, cl_device_id device, const char *path, const uint64_t key[2])
{
	cl_program program = NULL;
	cl_int code, status;
	void *bytes;
	size_t n;

	if (!kept_read(path, key, &bytes, &n))
		return NULL;
	program = clCreateProgramWithBinary(context, 1, &device, &n, (const unsigned char **)&bytes, &status, &code);
	free(bytes);
	if (program && (status != CL_SUCCESS ||
	                clBuildProgram(program, 1, &device, options_for(device), NULL, NULL) != CL_SUCCESS)) {
		clReleaseProgram(program);
		program = NULL;
	}
	return program;
}

static void leave_program(cl_program program, const char *path, const uint64_t key[2], struct cl_keeping *keeping)
{
	unsigned char *bytes = NULL;
	size_t n = 0;
	int failed = 0;

	if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof(n), &n, NULL) != CL_SUCCESS || n == 0 || n > MOST_BINARY)
		return;
	bytes = malloc(n);
	if (bytes && clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof(bytes), &bytes, NULL) == CL_SUCCESS)
		failed = kept_write(path, key, bytes, n);
	free(bytes);
	if (failed > 0)
		err_warn(keeping->folder, "compiled kernels are not kept there: %s", strerror(failed));
	if (failed)
		keeping->folder[0] = '\0';
}

/* --- Building ---------------------------------------------------------------------------------------------------- */

/* is_hook: 1 if the failing source is a user's hook. @return ERR_INPUT or ERR_SYSTEM */
static int report_build_log(cl_program program, cl_device_id device, const char *name, int is_hook)
{
	size_t bytes = 0;
	char *log;

	clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, NULL, &bytes);
	log = calloc(1, bytes + 1);
	if (log && clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, bytes, log, NULL) == CL_SUCCESS)
		fprintf(stderr, "%s\n", log);
	free(log);
	return err_report(is_hook ? ERR_INPUT : ERR_SYSTEM, name,
	                  "the device's compiler refuses this file; its words are above");
}

/* A compilation that a thread waits for. */
struct waiting {
	pthread_mutex_t lock;
	pthread_cond_t changed;
	int done, is_terminal;
	const char *name;
	struct cl_keeping *keeping;
};

#define TERMINAL_S 1
#define LINES_S 5

/* Print what is compiling if it takes more than some seconds: for each program on a terminal, overwriting any progress
 * bar; otherwise once. */
static void *say_when_late(void *user)
{
	struct waiting *w = user;
	struct timespec end;

	clock_gettime(CLOCK_REALTIME, &end);
	end.tv_sec += w->is_terminal ? TERMINAL_S : LINES_S;
	pthread_mutex_lock(&w->lock);
	while (!w->done && pthread_cond_timedwait(&w->changed, &w->lock, &end) == 0)
		;
	if (!w->done && w->is_terminal)
		fprintf(stderr, "\r\033[Kcompiling kernels for this device, once: %s\n", w->name);
	else if (!w->done)
		fprintf(stderr, "compiling kernels for this device, once; this may take a minute\n");
	if (!w->done && !w->is_terminal)
		w->keeping->tells = 2;
	pthread_mutex_unlock(&w->lock);
	return NULL;
}

static cl_int compile(cl_program program, cl_device_id device, const char *name, struct cl_keeping *keeping)
{
	struct waiting w = { PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, 0, isatty(STDERR_FILENO), name, keeping };
	pthread_t thread;
	const int watched = (w.is_terminal || keeping->tells == 1) && pthread_create(&thread, NULL, say_when_late, &w) == 0;
	const cl_int code = clBuildProgram(program, 1, &device, options_for(device), NULL, NULL);

	if (!watched)
		return code;
	pthread_mutex_lock(&w.lock);
	w.done = 1;
	pthread_cond_signal(&w.changed);
	pthread_mutex_unlock(&w.lock);
	pthread_join(thread, NULL);
	return code;
}

static int build_program(cl_context context, cl_device_id device, const struct kernel_file *kernels,
                         struct around around, struct cl_keeping *keeping, struct fault_place *place, int *said,
                         cl_program *out)
{
	const char *texts[] = { prelude, around.before, kernels->text, around.after };
	cl_int code;
	int err;

	*out = clCreateProgramWithSource(context, *around.after ? 4 : 3, texts, NULL, &code);
	if (!*out)
		return cl_report(said, code, kernels->name);
	code = compile(*out, device, kernels->name, keeping);
	if (code == CL_SUCCESS)
		return 0;
	if (!*around.after)
		fault_refuse(place, code, 1, kernels->name);
	if (code == CL_BUILD_PROGRAM_FAILURE)
		err = report_build_log(*out, device, around.name, *around.after != '\0');
	else
		err = cl_report(said, code, around.name);
	clReleaseProgram(*out);
	*out = NULL;
	return err;
}

size_t cl_program_gathered(cl_device_id device, const struct cl_keeping *keeping, enum device_family family)
{
	static const char *const gathered[N_DEVICE_FAMILIES] = {
		[FAMILY_PACKETS] = "kernels/frame/whole_packet.cl", [FAMILY_BINARY] = "kernels/frame/whole_single.cl",
		[FAMILY_COMPRESSED] = "kernels/frame/whole_single.cl",
	};
	const char *whole = !keeping->folder[0] && cl_program_is_pocl(device) ? gathered[family] : NULL;
	size_t file = 0;

	while (file < n_kernel_files && !(whole && strcmp(kernel_files[file].name, whole) == 0))
		file++;
	return file;
}

size_t cl_program_of(cl_device_id device, const struct cl_keeping *keeping, enum device_family family,
                     const char *kernel)
{
	const size_t whole = cl_program_gathered(device, keeping, family);
	size_t file = n_kernel_files;

	for (size_t i = 0; i < n_kernel_places; i++) {
		const size_t next = kernel_places[i].file;

		if (strcmp(kernel_places[i].kernel, kernel) != 0)
			continue;
		if (kernel_files[next].gathers ? next == whole : file == n_kernel_files)
			file = next;
	}
	return file;
}

int cl_program_make(cl_context context, cl_device_id device, size_t file, const struct hook *hook,
                    struct cl_keeping *keeping, struct fault_place *place, int *said, cl_program *out)
{
	const struct kernel_file *kernels = &kernel_files[file];
	const struct around around = around_of(kernels, hook);
	char path[PATH_MAX];
	uint64_t key[2];
	int err = 0;

	*out = NULL;
	fault_build(place, around.name);
	if (keeping->folder[0]) {
		name_program(device, kernels, around, keeping, path, key);
		*out = find_program(context, device, path, key);
	}
	if (*out) {
		keeping->found++;
	} else {
		err = build_program(context, device, kernels, around, keeping, place, said, out);
		if (!err && keeping->folder[0])
			leave_program(*out, path, key, keeping);
	}
	fault_build(place, NULL);
	return err;
}
