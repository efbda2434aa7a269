/*
 * Measures OpenCL compilation. Preloaded before the ICD loader, it writes a line per program into the file named by
 * BUILD_LOG when the process ends:
 *
 *     source|binary SECONDS KERNELS
 *     launch SECONDS KERNEL
 *
 * Seconds are processor time of the whole process spent on building, on creating kernels, and on the first launch of
 * each kernel, because some implementations compile then. KERNELS are separated by ';'. PoCL compiles a kernel in a
 * separate thread once the launch is queued: with BUILD_FINISH, a first launch counts until it has finished, including
 * its execution, and has a line of its own. Run one frame at a time: the time of other threads counts, too.
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

enum { MOST = 64, MOST_KERNELS = 512 };

static struct program {
	cl_program program;
	int is_binary;
	double seconds;
	char kernels[2048];
} programs[MOST];
static cl_kernel launched[MOST_KERNELS];
static struct {
	double seconds;
	char kernel[64];
} launches[MOST_KERNELS]; /* first launch of each, with BUILD_FINISH */
static int n_programs, n_launched;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static double clock_s(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Add to a program's account, creating it if necessary. */
static void spend(cl_program program, int is_binary, double seconds)
{
	int i = 0;

	pthread_mutex_lock(&lock);
	while (i < n_programs && programs[i].program != program)
		i++;
	if (i == n_programs && i < MOST)
		programs[n_programs++] = (struct program){ program, is_binary, 0, "" };
	if (i < MOST)
		programs[i].seconds += seconds;
	pthread_mutex_unlock(&lock);
}

cl_program clCreateProgramWithSource(cl_context context, cl_uint n, const char **texts, const size_t *lengths,
                                     cl_int *code)
{
	const double begin = clock_s();
	cl_program program = REAL(clCreateProgramWithSource)(context, n, texts, lengths, code);

	spend(program, 0, clock_s() - begin);
	return program;
}

cl_program clCreateProgramWithBinary(cl_context context, cl_uint n, const cl_device_id *devices, const size_t *lengths,
                                     const unsigned char **bytes, cl_int *status, cl_int *code)
{
	const double begin = clock_s();
	cl_program program = REAL(clCreateProgramWithBinary)(context, n, devices, lengths, bytes, status, code);

	spend(program, 1, clock_s() - begin);
	return program;
}

cl_int clBuildProgram(cl_program program, cl_uint n, const cl_device_id *devices, const char *options,
                      void(CL_CALLBACK *notify)(cl_program, void *), void *user)
{
	const double begin = clock_s();
	const cl_int code = REAL(clBuildProgram)(program, n, devices, options, notify, user);

	spend(program, 0, clock_s() - begin);
	for (int i = 0; i < n_programs; i++)
		if (programs[i].program == program)
			clGetProgramInfo(program, CL_PROGRAM_KERNEL_NAMES, sizeof(programs[i].kernels) - 1, programs[i].kernels, NULL);
	return code;
}

cl_kernel clCreateKernel(cl_program program, const char *name, cl_int *code)
{
	const double begin = clock_s();
	cl_kernel kernel = REAL(clCreateKernel)(program, name, code);

	spend(program, 0, clock_s() - begin);
	return kernel;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint n, const cl_event *wait,
                              cl_event *event)
{
	cl_program program = NULL;
	double begin, seconds;
	cl_int code;
	int i = 0;

	pthread_mutex_lock(&lock);
	while (i < n_launched && launched[i] != kernel)
		i++;
	if (i == n_launched && i < MOST_KERNELS)
		launched[n_launched++] = kernel;
	else
		i = MOST_KERNELS;
	pthread_mutex_unlock(&lock);
	if (i < MOST_KERNELS && getenv("BUILD_FINISH"))
		clFinish(queue); /* exclude earlier work */
	begin = clock_s();
	code = REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local, n, wait, event);
	if (i < MOST_KERNELS && getenv("BUILD_FINISH")) {
		clFinish(queue);
		launches[i].seconds = clock_s() - begin;
		clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof(launches[i].kernel), launches[i].kernel, NULL);
		return code;
	}
	seconds = clock_s() - begin;
	if (i < MOST_KERNELS && clGetKernelInfo(kernel, CL_KERNEL_PROGRAM, sizeof(program), &program, NULL) == CL_SUCCESS)
		spend(program, 0, seconds);
	return code;
}

__attribute__((destructor)) static void tell(void)
{
	const char *name = getenv("BUILD_LOG");
	FILE *log = name ? fopen(name, "a") : NULL;

	for (int i = 0; log && i < n_programs; i++)
		fprintf(log, "%s %.3f %s\n", programs[i].is_binary ? "binary" : "source", programs[i].seconds, programs[i].kernels);
	for (int i = 0; log && i < n_launched && getenv("BUILD_FINISH"); i++)
		fprintf(log, "launch %.3f %s\n", launches[i].seconds, launches[i].kernel);
	if (log)
		fclose(log);
}
