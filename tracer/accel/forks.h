/*
 * Work that gives rise to more work, done by several threads: subtrees of a tree under construction.
 */
#ifndef TRACER_ACCEL_FORKS_H
#define TRACER_ACCEL_FORKS_H

#include <pthread.h>
#include <stddef.h>

/** Do one piece. May call forks_add. */
typedef void forks_do(void *arg, const void *task);

struct forks {
	pthread_mutex_t lock;
	pthread_cond_t changed;
	char *tasks; /* a ring of waiting ones, oldest first: the largest come first */
	size_t task_bytes, room, first, waiting;
	unsigned busy;
	forks_do *run;
	void *arg;
};

/**
 * @param task_bytes  size of a piece's description, copied about
 * @param room        most pieces that ever wait
 * @return 0 or ERR_SYSTEM (reported)
 */
int forks_init(struct forks *forks, size_t task_bytes, size_t room);
void forks_free(struct forks *forks);

/** Another piece. From any thread. */
void forks_add(struct forks *forks, const void *task);

/**
 * Do all pieces and what they give rise to; back when there are none.
 * @param threads  at most so many, the caller's own one of them; 0: as many as there are processors. Where a thread cannot be
 *                 had, the others do its work
 */
void forks_run(struct forks *forks, unsigned threads, forks_do *run, void *arg);

#endif
