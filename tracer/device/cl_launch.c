#include "tracer/device/cl_launch.h"

#define PART_NS 1e8                   /* time that a part of a divided launch should take */
#define FIRST_ITEMS ((size_t)1 << 14) /* work items in the first launch of a kernel that is not measured yet */
#define LEAST_ITEMS ((size_t)1 << 8)  /* in the smallest part */
#define MOST_GROWTH 8                 /* a part is at most this many times as large as the one before */

#define WIDTH ((size_t)65528) /* work items in the narrowest launches: below 65535, PoCL compiles for small ones */
#define WIDER 8               /* each wider launch is this many times as wide, as are its groups */
#define MOST_GROUP 4096

/* Release the event of the measured launch, if any. */
static void forget(struct cl_pace *pace)
{
	if (pace->measured)
		clReleaseEvent(pace->measured);
	pace->measured = NULL;
}

void cl_pace_free(struct cl_pace *pace)
{
	forget(pace);
}

/* Learn the pace from the measured launch if it is done. Does not wait. */
static void learn(struct cl_pace *pace)
{
	cl_ulong start = 0, end = 0;
	cl_int status = CL_QUEUED;
	double items;

	if (!pace->measured ||
	    clGetEventInfo(pace->measured, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof(status), &status, NULL) != CL_SUCCESS ||
	    status > CL_COMPLETE)
		return;
	if (clGetEventProfilingInfo(pace->measured, CL_PROFILING_COMMAND_START, sizeof(start), &start, NULL) ==
	            CL_SUCCESS &&
	    clGetEventProfilingInfo(pace->measured, CL_PROFILING_COMMAND_END, sizeof(end), &end, NULL) == CL_SUCCESS &&
	    end > start) {
		items = PART_NS * (double)pace->n_measured / (double)(end - start);
		if (items > MOST_GROWTH * (double)pace->most_items)
			items = MOST_GROWTH * (double)pace->most_items;
		pace->most_items = items < (double)LEAST_ITEMS ? LEAST_ITEMS : items < 4e9 ? (size_t)items : (size_t)4000000000u;
	}
	forget(pace);
}

cl_int cl_launch(cl_command_queue queue, cl_kernel kernel, size_t n_items, size_t group, struct cl_pace *pace)
{
	struct cl_pace whole = { .most_items = n_items };
	cl_int code = CL_SUCCESS;

	if (!pace)
		pace = &whole;
	else if (pace->most_items == 0)
		pace->most_items = FIRST_ITEMS;
	for (size_t first = 0; first < n_items && code == CL_SUCCESS;) {
		size_t part = n_items - first, global;
		int measure;

		learn(pace);
		measure = pace != &whole && !pace->measured;
		if (part > pace->most_items)
			part = pace->most_items / group * group;
		global = (part + group - 1) / group * group;
		code = clEnqueueNDRangeKernel(queue, kernel, 1, &first, &global, &group, 0, NULL, measure ? &pace->measured : NULL);
		if (code == CL_SUCCESS) {
			pace->n_measured = measure ? part : pace->n_measured;
			first += part;
		} else if (code == CL_OUT_OF_RESOURCES && pace != &whole && part > LEAST_ITEMS) {
			/* Too many work items at once. */
			pace->most_items = part / 2;
			code = CL_SUCCESS;
		}
	}
	return code;
}

cl_int cl_launch_wide(cl_command_queue queue, cl_kernel kernel, size_t n_items, size_t group, unsigned char *widened)
{
	const size_t first = 0;
	size_t widest = WIDTH / group * group, global;
	unsigned char this_wide = 1;
	cl_int code;

	while (n_items > widest && group * WIDER <= MOST_GROUP) {
		group *= WIDER;
		widest *= WIDER;
		this_wide = (unsigned char)(this_wide << 1);
	}
	global = (n_items + group - 1) / group * group;
	if (!(*widened & this_wide) && global < widest)
		global = widest;
	code = clEnqueueNDRangeKernel(queue, kernel, 1, &first, &global, &group, 0, NULL, NULL);
	if (code == CL_SUCCESS)
		*widened |= this_wide;
	return code;
}
