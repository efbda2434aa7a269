/*
 * A queue of pointers between threads that holds so many at most: who is ahead waits.
 *
 * Items are the caller's. All functions may be called from any thread.
 */
#ifndef BASE_QUEUE_H
#define BASE_QUEUE_H

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
 * @param bound   items that it holds before queue_put waits; 1 at least
 * @param extra   room beyond that for queue_put_back
 * @return 0 or ERR_SYSTEM (reported)
 */
int queue_init(struct queue *q, size_t bound, size_t extra);

/** Every item must have been taken. */
void queue_free(struct queue *q);

/** Append, waiting for room. @return 1, or 0 where the queue is closed: the item stays the caller's */
int queue_put(struct queue *q, void *item);

/** Put an item back that was taken, in front of all others, even into a closed queue; never waits. */
void queue_put_back(struct queue *q, void *item);

/** The next item, waiting for one; NULL once the queue is closed and empty. */
void *queue_take(struct queue *q);

/** No more items will come: wakes who waits. */
void queue_close(struct queue *q);

#endif
