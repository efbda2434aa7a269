#include "base/queue.h"

#include <stdlib.h>

#include "base/err.h"

int queue_init(struct queue *q, size_t bound, size_t extra)
{
	*q = (struct queue){ .bound = bound, .room = bound + extra };
	q->items = calloc(q->room, sizeof(*q->items));
	if (!q->items)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	pthread_mutex_init(&q->lock, NULL);
	pthread_cond_init(&q->changed, NULL);
	return 0;
}

void queue_free(struct queue *q)
{
	if (!q->items)
		return;
	pthread_mutex_destroy(&q->lock);
	pthread_cond_destroy(&q->changed);
	free(q->items);
	q->items = NULL;
}

int queue_put(struct queue *q, void *item)
{
	int open;

	pthread_mutex_lock(&q->lock);
	while (q->n >= q->bound && !q->closed)
		pthread_cond_wait(&q->changed, &q->lock);
	open = !q->closed;
	if (open)
		q->items[(q->first + q->n++) % q->room] = item;
	pthread_cond_broadcast(&q->changed);
	pthread_mutex_unlock(&q->lock);
	return open;
}

void queue_put_back(struct queue *q, void *item)
{
	pthread_mutex_lock(&q->lock);
	q->first = (q->first + q->room - 1) % q->room;
	q->items[q->first] = item;
	q->n++;
	pthread_cond_broadcast(&q->changed);
	pthread_mutex_unlock(&q->lock);
}

void *queue_take(struct queue *q)
{
	void *item = NULL;

	pthread_mutex_lock(&q->lock);
	while (q->n == 0 && !q->closed)
		pthread_cond_wait(&q->changed, &q->lock);
	if (q->n) {
		item = q->items[q->first];
		q->first = (q->first + 1) % q->room;
		q->n--;
	}
	pthread_cond_broadcast(&q->changed);
	pthread_mutex_unlock(&q->lock);
	return item;
}

void queue_close(struct queue *q)
{
	pthread_mutex_lock(&q->lock);
	q->closed = 1;
	pthread_cond_broadcast(&q->changed);
	pthread_mutex_unlock(&q->lock);
}
