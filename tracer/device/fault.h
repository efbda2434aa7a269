/*
 * Faults of OpenCL drivers. A driver may end the process, hang in a call, or return an error code that does not exist.
 * This file knows which device and family is at work, blames the driver only where the driver is at fault, and notes it
 * in memory that a parent process shares (verbs/render/guard.h). The parent then starts a new process, with the next
 * family of kernels.
 *
 * Who is to blame for a signal:
 *   - A thread between fault_enter and fault_leave is in the driver: the driver.
 *   - A thread with a frame of this program on its stack, outside these: this program. Nothing is noted.
 *   - Any other thread belongs to the driver. It works for the devices whose launches are not waited for yet.
 * A signal that another process sent is nobody's fault.
 */
#pragma once

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

#include "kernels/kernels.h"

#define FAULT_NO_FRAME (-1)

enum fault_kind {
	FAULT_NONE,
	FAULT_SIGNAL,  /* code: its number */
	FAULT_EXIT,    /* the driver called exit() */
	FAULT_HUNG,
	FAULT_REFUSED, /* code: what OpenCL returned */
	N_FAULT_KINDS
};

struct fault {
	int32_t kind;     /* enum fault_kind */
	int32_t code;
	int32_t device;   /* its number in device_list; -1: none is open yet */
	int32_t family;   /* enum device_family */
	int64_t frame;    /* that was under way on the device; FAULT_NO_FRAME: none, or one of several */
	int32_t is_build; /* 1: a program was being built. No frame has a part in that. */
	char what[80];    /* the program, or the kernels that were compiled or run: "camera_packet, plain" */
};

/** "SIGABRT in camera_packet, plain" and the like. @return text */
const char *fault_words(const struct fault *fault, char *text, size_t size);

#define FAULT_PLACES 512 /* devices at once, all that share one counted */
#define FAULT_NEW 4      /* kernels that a fault names */

/* Where one device (or one that shares it) is at work. For fault.c alone. */
struct fault_place {
	atomic_int is_taken;
	int device, family;
	atomic_llong frame;
	const char *_Atomic program; /* being built; NULL: none */
	atomic_uint calls;    /* odd: a thread is in the driver */
	atomic_uint launched; /* and not waited for */
	atomic_uint n_new;    /* of these, kernels that have never been waited for: the driver may compile them at their
	                         first launch */
	enum kernel new[FAULT_NEW];
	unsigned char known[N_KERNELS];
	/* Of fault_look: */
	unsigned seen; /* calls */
	double age_s, begun_cpu_s;
};

/* What a process leaves to its parent, in memory that both share. All 0 is valid. */
struct fault_journal {
	struct fault fault; /* kind FAULT_NONE: none */
	atomic_int is_judged; /* a signal's handler knew whether it is a fault */
	atomic_uint n_places; /* that were ever taken */
	struct fault_place places[FAULT_PLACES];
};

/** @param device  its number. @return NULL: too many are open, which all functions take; fault_close */
struct fault_place *fault_open(int device);
void fault_close(struct fault_place **place);
void fault_set_family(struct fault_place *place, int family);
void fault_set_frame(struct fault_place *place, int64_t frame);

/** This thread goes into the driver, or comes back. fault_leave returns err. Calls do not nest. */
void fault_enter(struct fault_place *place);
int fault_leave(struct fault_place *place, int err);

/** Within: a program is being built (NULL: no longer); a kernel is launched; all that was launched is done. */
void fault_build(struct fault_place *place, const char *program);
void fault_launch(struct fault_place *place, enum kernel kernel);
void fault_done(struct fault_place *place);

/**
 * From now on, note the first fault of this process. Before the first device is opened.
 * @param journal  kept until the process ends
 * @param refusals 1: what a driver refuses ends the process, too (fault_refuse)
 */
void fault_begin(struct fault_journal *journal, int refusals);

/** Drivers have signal handlers of their own: have ours come first again. Call it after drivers were loaded. */
void fault_arm(void);

/**
 * In the parent: the process was ended by a signal, and nothing is noted, as where a driver put its own handlers before
 * ours while it compiled. Where a compilation was under way, note that.
 */
void fault_guess(struct fault_journal *journal, int number);

/** The process ends because it wants to, from now on. */
void fault_end(void);

/**
 * The driver refuses a program or kernel: note it, and end the process with exit code 5. Returns where refusals do not
 * end it, and where the driver says of a build (is_build) that it is short of something, or that the device is lost.
 */
void fault_refuse(struct fault_place *place, int code, int is_build, const char *what);

/**
 * Look for a call that hangs: it has taken most_s, and either the process has used no processor time for the last fifth
 * of that, or the call compiles and the process has used most_s of processor time. Call it often, from one thread.
 * @param passed_s  since the last call, at most: time in which the process was stopped does not count
 * @return 1: a fault is noted, and the process must end
 */
int fault_look(double most_s, double passed_s);

/** A device that does not come back: note the longest call under way. @return 0: there is none */
int fault_hang(void);
