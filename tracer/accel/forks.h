/*
 * Tasks that add more tasks, done by several threads: subtrees of a tree under construction.
 */
#pragma once

#include <pthread.h>
#include <stddef.h>

/** Do one task. May call forks_add. */
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
 * @param task_bytes  size of a task's description, which is copied
 * @param room        most tasks that ever wait
 * @return 0 or ERR_SYSTEM (reported)
 */
int forks_init(struct forks *forks, size_t task_bytes, size_t room);
void forks_free(struct forks *forks);

/** Add a task, from any thread. */
void forks_add(struct forks *forks, const void *task);

/**
 * Do all tasks and those that they add; return when there are none.
 * @param threads  at most so many, the caller's own included; 0: as many as there are processors. Where a thread does
 *                 not start, the others do its work
 */
void forks_run(struct forks *forks, unsigned threads, forks_do *run, void *arg);
