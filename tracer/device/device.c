#include "tracer/device/device.h"

#include <ctype.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "tracer/device/cl.h"
#include "tracer/device/cl_pin.h"
#include "tracer/device/fault.h"
#include "tracer/hook/hook.h"

#define MAX_THREADS 64

struct device {
	struct cl_device *cl; /* NULL: the reference device */
	struct fault_place *place; /* or NULL */
	unsigned threads;     /* threads of the reference device */
	const struct hook *hook; /* hook of the reference device, or NULL */
	enum device_family family;
	atomic_int interrupted;
	struct device_profile *profile; /* or NULL */
	struct device_description description; /* description of an OpenCL device */
	char name[320];
};

struct device_buffer {
	struct cl_buffer *cl; /* buffer of an OpenCL device, or NULL */
	void *memory;         /* memory of the reference device, or NULL */
	size_t bytes;
};

/* Call the driver, on behalf of a place or of none (NULL). */
#define IN_DRIVER(place, call) (fault_enter(place), fault_leave(place, call))

int device_list(struct device_description **out, size_t *n)
{
	return cl_list(out, n);
}

static int contains(const char *text, const char *part)
{
	for (size_t n = strlen(part); *text; text++)
		if (strncasecmp(text, part, n) == 0)
			return 1;
	return 0;
}

const char *device_type_name(enum device_type type)
{
	static const char *const names[N_DEVICE_TYPES] = { "cpu", "gpu", "accelerator" };

	return names[type];
}

enum device_family device_type_family(enum device_type type)
{
	return type == DEVICE_CPU ? FAMILY_PACKETS : FAMILY_COMPRESSED;
}

/* Index of the first device of a type; n: there is none. */
static size_t find_type(const struct device_description *list, size_t n, const char *type)
{
	size_t i = 0;

	while (i < n && strcasecmp(device_type_name(list[i].type), type) != 0)
		i++;
	return i;
}

int device_find(const struct device_description *list, size_t n, const char *choice, size_t *number)
{
	char *end;

	*number = find_type(list, n, choice ? choice : "gpu");
	if (*number < n)
		return 0;
	*number = 0;
	if (!choice)
		return 0;
	if (isdigit((unsigned char)choice[0])) {
		unsigned long value = strtoul(choice, &end, 10);

		if (*end == '\0' && value < n) {
			*number = value;
			return 0;
		}
	}
	for (; *number < n && choice[0]; ++*number)
		if (contains(list[*number].name, choice))
			return 0;
	return err_report(ERR_USAGE, NULL, "there is no device '%s'; 'relume devices' lists them", choice);
}

/*
 * PoCL 7 runs its threads with TBB, and its devices do not support sub-devices (cl.c: limit_threads). It reads this
 * variable for its number of threads when a process first lists devices. PoCL 3 ignores it.
 */
static void limit_pocl(unsigned threads)
{
	char text[16];

	snprintf(text, sizeof(text), "%u", threads);
	if (threads)
		setenv("POCL_CPU_MAX_CU_COUNT", text, 1);
}

static int open_cl(struct device *dev, const char *choice, unsigned threads)
{
	struct device_description *list = NULL;
	struct fault_place *listing = fault_open(-1);
	struct cl_pin pin;
	size_t n, number;
	int err;

	limit_pocl(threads);
	if (threads == 0)
		cl_pin_begin(&pin);
	err = IN_DRIVER(listing, cl_list(&list, &n)); /* the first call loads the drivers */
	fault_arm();
	fault_close(&listing);
	if (threads == 0)
		cl_pin_end(&pin);
	if (err)
		return err;
	err = device_find(list, n, choice, &number);
	if (!err) {
		dev->place = fault_open((int)number);
		fault_set_family(dev->place, (int)device_type_family(list[number].type));
		err = IN_DRIVER(dev->place, cl_open(number, threads, dev->place, &dev->cl));
	}
	if (!err) {
		dev->description = list[number];
		device_choose_family(dev, device_type_family(list[number].type));
		snprintf(dev->name, sizeof(dev->name), "%s (%s %s)", list[number].name, list[number].platform,
		         list[number].driver);
	}
	free(list);
	return err;
}

int device_is_reference(const char *choice)
{
	return choice && strcmp(choice, "reference") == 0;
}

static void open_reference(struct device *dev, unsigned threads)
{
	long cores = sysconf(_SC_NPROCESSORS_ONLN);

	dev->threads = threads ? threads : cores > 0 ? (unsigned)cores : 1;
	if (dev->threads > MAX_THREADS)
		dev->threads = MAX_THREADS;
	dev->family = FAMILY_PACKETS;
	snprintf(dev->name, sizeof(dev->name), "reference (C)");
}

int device_open(const char *choice, unsigned threads, struct device **out)
{
	struct device *dev = calloc(1, sizeof(*dev));
	int err = 0;

	if (!dev)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (device_is_reference(choice))
		open_reference(dev, threads);
	else
		err = open_cl(dev, choice, threads);
	if (err) {
		fault_close(&dev->place);
		free(dev);
		return err;
	}
	*out = dev;
	return 0;
}

void device_close(struct device **dev)
{
	if (*dev && (*dev)->cl) {
		fault_enter((*dev)->place);
		cl_close(&(*dev)->cl);
		fault_leave((*dev)->place, 0);
		fault_close(&(*dev)->place);
	}
	free(*dev);
	*dev = NULL;
}

/* "0,1,2" for every OpenCL device. @return free with free(); NULL (reported) on failure */
static char *name_all(unsigned threads)
{
	struct device_description *list = NULL;
	size_t n, at = 0;
	char *text;

	limit_pocl(threads);
	if (cl_list(&list, &n))
		return NULL;
	free(list);
	text = malloc(8 * n + 8);
	for (size_t i = 0; text && i < n; i++)
		at += (size_t)sprintf(text + at, i ? ",%zu" : "%zu", i);
	if (!text)
		err_report(ERR_SYSTEM, NULL, "out of memory");
	return text;
}

int device_open_list(const char *choices, unsigned threads, struct device ***out, size_t *n)
{
	char *text = !choices ? NULL : strcmp(choices, "all") == 0 ? name_all(threads) : strdup(choices), *save = NULL;
	int err = choices && !text ? ERR_SYSTEM : 0;

	*n = 0;
	*out = calloc(1 + (choices ? strlen(text ? text : "") : 0), sizeof(**out));
	if (!*out)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err && !text)
		err = device_open(NULL, threads, &(*out)[(*n)++]);
	for (char *name = text ? strtok_r(text, ",", &save) : NULL; !err && name; name = strtok_r(NULL, ",", &save))
		err = device_open(name, threads, &(*out)[(*n)++]);
	if (!err && *n == 0)
		err = err_report(ERR_USAGE, NULL, "--device names none; 'relume devices' lists them");
	free(text);
	if (err)
		device_close_list(out, n);
	return err;
}

void device_close_list(struct device ***devices, size_t *n)
{
	for (size_t i = 0; *devices && i < *n; i++)
		device_close(&(*devices)[i]);
	free(*devices);
	*devices = NULL;
	*n = 0;
}

int device_share(struct device *dev, struct device **out)
{
	struct device *other = calloc(1, sizeof(*other));
	int err = 0;

	if (!other)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	other->threads = dev->threads;
	other->family = dev->family;
	other->description = dev->description;
	memcpy(other->name, dev->name, sizeof(other->name));
	if (dev->cl) {
		other->place = fault_open((int)dev->description.number);
		fault_set_family(other->place, (int)dev->family);
		err = IN_DRIVER(other->place, cl_share(dev->cl, other->place, &other->cl));
	}
	if (err) {
		fault_close(&other->place);
		free(other);
		return err;
	}
	*out = other;
	return 0;
}

void device_interrupt(struct device *dev)
{
	atomic_store(&dev->interrupted, 1);
}

void device_resume(struct device *dev)
{
	atomic_store(&dev->interrupted, 0);
}

int device_is_interrupted(const struct device *dev)
{
	return atomic_load(&dev->interrupted);
}

const char *device_name(const struct device *dev)
{
	return dev->name;
}

const struct device_description *device_describe(const struct device *dev)
{
	return dev->cl ? &dev->description : NULL;
}

void device_set_frame(struct device *dev, uint64_t frame)
{
	fault_set_frame(dev->place, (int64_t)frame);
}

enum device_family device_family(const struct device *dev)
{
	return dev->family;
}

void device_choose_family(struct device *dev, enum device_family family)
{
	dev->family = family;
	fault_set_family(dev->place, (int)family);
	if (dev->cl)
		cl_choose_family(dev->cl, family);
}

const char *const device_family_names[N_DEVICE_FAMILIES + 1] = {
#define FAMILY_NAME(name, word) #word,
	DEVICE_FAMILIES(FAMILY_NAME)
};

void device_keep_programs(struct device *dev, const char *folder, int always)
{
	if (dev->cl)
		cl_keep_programs(dev->cl, folder, always);
}

void device_tell_compiling(struct device *dev)
{
	if (dev->cl)
		cl_tell_compiling(dev->cl);
}

void device_build_early(struct device *dev)
{
	struct fault_place *place = dev->cl ? fault_open((int)dev->description.number) : NULL;

	fault_set_family(place, (int)dev->family);
	if (dev->cl)
		cl_build_early(dev->cl, place);
}

void device_leave_programs(struct device *dev)
{
	if (dev->cl)
		cl_leave_programs(dev->cl);
}

int device_take_hook(struct device *dev, const struct hook *hook)
{
	if (!hook)
		return 0;
	if (dev->cl)
		cl_take_hook(dev->cl, hook);
	else if (!hook->library)
		return err_report(ERR_SYSTEM, hook->path, "was not compiled for the reference device");
	else
		dev->hook = hook;
	return 0;
}

unsigned device_programs_found(const struct device *dev)
{
	return dev->cl ? cl_programs_found(dev->cl) : 0;
}

int device_report_lack(struct device *dev)
{
	return dev->cl ? cl_report_lack(dev->cl) : ERR_SYSTEM;
}

int device_reserve(struct device *dev, struct device_buffer **buffer, size_t bytes)
{
	struct device_buffer *b = *buffer;

	if (bytes == 0)
		bytes = 16;
	if (!b)
		b = *buffer = calloc(1, sizeof(*b));
	if (!b)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (dev->cl)
		return IN_DRIVER(dev->place, cl_reserve(dev->cl, &b->cl, bytes));
	if (b->bytes >= bytes)
		return 0;
	free(b->memory);
	b->bytes = 0;
	b->memory = calloc(1, bytes);
	if (!b->memory)
		return err_report(ERR_SYSTEM, NULL, "a buffer of %zu bytes: out of memory", bytes);
	b->bytes = bytes;
	return 0;
}

void device_release(struct device *dev, struct device_buffer **buffer)
{
	if (*buffer && dev->cl)
		cl_release(dev->cl, &(*buffer)->cl);
	if (*buffer)
		free((*buffer)->memory);
	free(*buffer);
	*buffer = NULL;
}

/* --- Profile ----------------------------------------------------------------------------------------------------- */

static double clock_of(clockid_t clock)
{
	struct timespec t;

	clock_gettime(clock, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Times at the start of an operation; zeros without a profile. */
static struct device_spent begin(const struct device *dev)
{
	struct device_spent s = { 0, 0, 0, 0 };

	if (dev->profile)
		s = (struct device_spent){ clock_of(CLOCK_MONOTONIC), clock_of(CLOCK_PROCESS_CPUTIME_ID), 0, 0 };
	return s;
}

static void end(struct device_spent *sum, const struct device_spent *begun, uint64_t amount)
{
	sum->wall_s += clock_of(CLOCK_MONOTONIC) - begun->wall_s;
	sum->cpu_s += clock_of(CLOCK_PROCESS_CPUTIME_ID) - begun->cpu_s;
	sum->count++;
	sum->amount += amount;
}

void device_set_profile(struct device *dev, struct device_profile *profile)
{
	dev->profile = profile;
}

const char *device_kernel_name(enum kernel kernel)
{
	return kernel_entries[kernel].name;
}

/* --- Copies and launches ----------------------------------------------------------------------------------------- */

int device_write(struct device *dev, struct device_buffer *buffer, size_t offset, const void *data, size_t bytes)
{
	struct device_spent begun = begin(dev);
	int err = 0;

	if (device_is_interrupted(dev))
		return ERR_SYSTEM;
	if (dev->cl)
		err = IN_DRIVER(dev->place, cl_write(dev->cl, buffer->cl, offset, data, bytes));
	else if (bytes)
		memcpy((char *)buffer->memory + offset, data, bytes);
	if (dev->profile)
		end(&dev->profile->writes, &begun, bytes);
	return err;
}

int device_read(struct device *dev, const struct device_buffer *buffer, size_t offset, void *data, size_t bytes)
{
	struct device_spent begun = begin(dev);
	int err = 0;

	if (device_is_interrupted(dev))
		return ERR_SYSTEM;
	if (dev->cl)
		err = IN_DRIVER(dev->place, cl_read(dev->cl, buffer->cl, offset, data, bytes));
	else if (bytes)
		memcpy(data, (const char *)buffer->memory + offset, bytes);
	if (dev->profile)
		end(&dev->profile->reads, &begun, bytes);
	return err;
}

int device_map(struct device *dev, const struct device_buffer *buffer, size_t bytes, int wait, const void **out)
{
	struct device_spent begun = begin(dev);
	int err = 0;

	if (device_is_interrupted(dev))
		return ERR_SYSTEM;
	if (dev->cl)
		err = IN_DRIVER(dev->place, cl_map(dev->cl, buffer->cl, bytes, wait, out));
	else
		*out = buffer->memory;
	if (dev->profile)
		end(&dev->profile->reads, &begun, bytes);
	return err;
}

int device_unmap(struct device *dev, const struct device_buffer *buffer, const void *mapped)
{
	return dev->cl ? IN_DRIVER(dev->place, cl_unmap(dev->cl, buffer->cl, mapped)) : 0;
}

int device_upload(struct device *dev, struct device_buffer **buffer, const void *data, size_t bytes)
{
	int err = device_reserve(dev, buffer, bytes);

	return err || bytes == 0 ? err : device_write(dev, *buffer, 0, data, bytes);
}

/* A share of a launch on the reference device. Work items do not depend on each other. */
struct share {
	kernel_twin *twin;
	void *const *args;
	size_t first, last;
	pthread_t thread;
};

static void *run_share(void *arg)
{
	struct share *share = arg;

	share->twin(share->args, share->first, share->last);
	return NULL;
}

/* The C twin of a kernel: the hook's, if it has one. */
static kernel_twin *twin_of(const struct device *dev, enum kernel kernel)
{
	char name[64];
	void *own = NULL;

	if (dev->hook) {
		snprintf(name, sizeof(name), "host_%s", kernel_entries[kernel].name);
		own = dlsym(dev->hook->library, name);
	}
	return own ? (kernel_twin *)own : kernel_entries[kernel].twin;
}

static int run_reference(struct device *dev, enum kernel kernel, size_t n_items, const struct device_arg *args,
                         size_t n_args)
{
	kernel_twin *twin = twin_of(dev, kernel);
	void *pointers[DEVICE_MAX_ARGS];
	struct share shares[MAX_THREADS];
	unsigned n_started = 0;

	for (size_t i = 0; i < n_args; i++)
		pointers[i] = args[i].buffer ? args[i].buffer->memory : (void *)args[i].value;
	for (unsigned i = 0; i < dev->threads; i++) {
		shares[i] = (struct share){ twin, pointers, n_items * i / dev->threads,
			                    n_items * (i + 1) / dev->threads, 0 };
		/* The last share, and any whose thread cannot be started, runs here. */
		if (i + 1 < dev->threads && pthread_create(&shares[n_started].thread, NULL, run_share, &shares[i]) == 0)
			n_started++;
		else
			run_share(&shares[i]);
	}
	for (unsigned i = 0; i < n_started; i++)
		pthread_join(shares[i].thread, NULL);
	return 0;
}

static int run_cl(struct device *dev, enum kernel kernel, size_t n_items, const struct device_arg *args, size_t n_args)
{
	struct cl_arg cl_args[DEVICE_MAX_ARGS];

	for (size_t i = 0; i < n_args; i++)
		cl_args[i] = (struct cl_arg){ args[i].buffer ? args[i].buffer->cl : NULL, args[i].value, args[i].bytes };
	return IN_DRIVER(dev->place, cl_run(dev->cl, kernel, n_items, cl_args, n_args));
}

int device_run(struct device *dev, enum kernel kernel, size_t n_items, const struct device_arg *args, size_t n_args)
{
	struct device_spent begun;
	int err;

	if (device_is_interrupted(dev))
		return ERR_SYSTEM;
	if (n_items == 0)
		return 0;
	begun = begin(dev);
	err = dev->cl ? run_cl(dev, kernel, n_items, args, n_args) : run_reference(dev, kernel, n_items, args, n_args);
	if (!err && dev->profile)
		err = device_finish(dev);
	if (dev->profile)
		end(&dev->profile->kernels[kernel], &begun, n_items);
	return err;
}

int device_finish(struct device *dev)
{
	return dev->cl ? IN_DRIVER(dev->place, cl_finish(dev->cl)) : 0;
}
