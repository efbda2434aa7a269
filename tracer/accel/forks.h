/*
 * A pool of threads whose tasks may add more tasks: subtrees of a tree under construction.
 */
#pragma once

#include <pthread.h>
#include <stddef.h>

/** Do one task. May call forks_add. */
typedef void forks_do(void *arg, const void *task);

struct forks {
	pthread_mutex_t lock;
	pthread_cond_t changed;
	char *tasks; /* ring of waiting tasks, oldest first, so the largest subtrees come first */
	size_t task_bytes, room, first, waiting;
	unsigned busy;
	forks_do *run;
	void *arg;
};

/**
 * @param task_bytes  size of a task's description, which is copied
 * @param room        most tasks that wait at any time
 * @return 0 or ERR_SYSTEM (reported)
 */
int forks_init(struct forks *forks, size_t task_bytes, size_t room);
void forks_free(struct forks *forks);

/** Add a task, from any thread. */
void forks_add(struct forks *forks, const void *task);

/**
 * Run all tasks and those that they add. Return when none is left.
 * @param threads  most threads to use, including the caller's own; 0: one per processor. If a thread cannot be started,
 *                 the others do its work
 */
void forks_run(struct forks *forks, unsigned threads, forks_do *run, void *arg);
