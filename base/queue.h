/*
 * A bounded queue of pointers between threads: a full queue makes its writers wait.
 *
 * The caller owns the items. Any thread may call any function.
 */
#pragma once

#include <pthread.h>
#include <stddef.h>

struct queue {
	pthread_mutex_t lock;
	pthread_cond_t changed;
	void **items; /* a ring */
	size_t room, bound, first, n;
	int closed;
};

/**
 * @param bound   items held before queue_put waits; at least 1
 * @param extra   room beyond that for queue_put_back
 * @return 0 or ERR_SYSTEM (reported)
 */
int queue_init(struct queue *q, size_t bound, size_t extra);

/** The queue must be empty. */
void queue_free(struct queue *q);

/** Append; waits for room. @return 1; 0 if the queue is closed: the caller keeps the item */
int queue_put(struct queue *q, void *item);

/** Return a taken item to the front of the queue, even of a closed one. Never waits. */
void queue_put_back(struct queue *q, void *item);

/** Take the next item; waits for one. NULL once the queue is closed and empty. */
void *queue_take(struct queue *q);

/** No more items will come. Wakes all waiting threads. */
void queue_close(struct queue *q);
