/*
 * Faults of OpenCL drivers. A driver may end the process, hang in a call, or return an error code that does not exist.
 * This file tracks which device and family is running, decides whether the driver is at fault, and notes such faults in
 * memory shared with a parent process (verbs/render/guard.h). The parent then starts a new process with the next family
 * of kernels.
 *
 * The cause of a signal:
 *   - A thread between fault_enter and fault_leave is in the driver: the driver is at fault.
 *   - A thread outside these calls, with a frame of this program on its stack: this program is at fault. Nothing is
 *     noted.
 *   - Any other thread belongs to the driver. It works for the devices that have launches in progress.
 * A signal sent by another process is not a fault.
 */
#pragma once

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/kernels.h"

#define FAULT_NO_FRAME (-1)

enum fault_kind {
	FAULT_NONE,
	FAULT_SIGNAL,  /* code: signal number */
	FAULT_EXIT,    /* the driver called exit() */
	FAULT_HUNG,
	FAULT_REFUSED, /* code: OpenCL's error */
	N_FAULT_KINDS
};

struct fault {
	int32_t kind;     /* enum fault_kind */
	int32_t code;
	int32_t device;   /* number in device_list; -1: none is open yet */
	int32_t family;   /* enum device_family */
	int64_t frame;    /* frame in progress on the device; FAULT_NO_FRAME: none, or one of several */
	int32_t is_build; /* 1: a program was being built, which does not depend on a frame */
	char what[80];    /* the program, or the kernels being compiled or run: "camera_packet, plain" */
};

/** "SIGABRT in camera_packet, plain" and the like. @return text */
const char *fault_words(const struct fault *fault, char *text, size_t size);

#define FAULT_PLACES 512 /* most open devices, counting shared ones separately */
#define FAULT_NEW 4      /* most kernels that a fault names */

/* Activity of one device, or of one shared from it. Used only by fault.c. */
struct fault_place {
	atomic_int is_taken;
	int device, family;
	atomic_llong frame;
	const char *_Atomic program; /* program being built; NULL: none */
	atomic_uint calls;    /* odd: a thread is in the driver */
	atomic_uint launched; /* launches that have not been waited for */
	atomic_uint n_new;    /* launched kernels never waited for so far: the driver may still be compiling them */
	enum kernel new[FAULT_NEW];
	unsigned char known[N_KERNELS];
	/* For fault_look: */
	unsigned seen; /* `calls` at the last look */
	double age_s, begun_cpu_s;
};

/* Journal from a process to its parent, in shared memory. All zero is valid. */
struct fault_journal {
	struct fault fault; /* kind FAULT_NONE: none */
	atomic_int is_judged; /* a signal handler has decided whether the signal is a fault */
	atomic_uint n_places; /* places that were ever taken */
	struct fault_place places[FAULT_PLACES];
};

/** Register an open device. @param device number in device_list @return close with fault_close; NULL if too many are
 * open: all functions accept NULL */
struct fault_place *fault_open(int device);
void fault_close(struct fault_place **place);
void fault_set_family(struct fault_place *place, int family);
void fault_set_frame(struct fault_place *place, int64_t frame);

/** Mark that this thread enters or leaves the driver. fault_leave returns err. Calls do not nest. */
void fault_enter(struct fault_place *place);
int fault_leave(struct fault_place *place, int err);

/** Within these calls, mark that a program is being built (NULL: no longer), that a kernel is launched, or that all
 * launches are done. */
void fault_build(struct fault_place *place, const char *program);
void fault_launch(struct fault_place *place, enum kernel kernel);
void fault_done(struct fault_place *place);

/**
 * Note the first fault of this process from now on. Call before the first device is opened.
 * @param journal  kept until the process ends
 * @param refusals 1: a refusal by a driver also ends the process (fault_refuse)
 */
void fault_begin(struct fault_journal *journal, int refusals);

/** Put our signal handlers before those that drivers install. Call after drivers have been loaded. */
void fault_arm(void);

/**
 * Called in the parent when a signal ended the process and nothing was noted, for instance because a driver installed
 * its own handlers while compiling. If a compilation was in progress, note that as the fault.
 */
void fault_guess(struct fault_journal *journal, int number);

/** Mark that the process ends on purpose from now on. */
void fault_end(void);

/**
 * Note that the driver refused a program or kernel, and end the process with exit code 5. Returns if refusals do not
 * end the process, or if a build (is_build) failed because a resource ran out or the device was lost.
 */
void fault_refuse(struct fault_place *place, int code, int is_build, const char *what);

/**
 * Look for a call that hangs: it has taken most_s, and either the process was idle for the last fifth of that time, or
 * the call compiles and the process has used most_s of processor time. Call often, from one thread.
 * @param passed_s  most time to count since the last call: time while the process was stopped does not count
 * @return 1: a fault was noted, and the process must end
 */
int fault_look(double most_s, double passed_s);

/** Note that a device hangs, with the longest call in progress. @return 0: no call is in progress */
int fault_hang(void);
