/* Makes pieces in threads, and writes each as soon as all before it are written. */
#include "diff/report/ordered.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"

struct piece {
	char *text;
	size_t size, cost;
	int is_made;
};

struct ordered {
	ordered_make *make;
	void *context;
	FILE *out;
	size_t n;

	pthread_mutex_t lock; /* guards all members below */
	pthread_cond_t moved; /* a piece was written, or the run has ended */
	struct piece pieces[ORDERED_AHEAD]; /* piece i at i % ORDERED_AHEAD */
	size_t taken, written;
	size_t spent[ORDERED_AHEAD]; /* total cost of all pieces up to i, at i % ORDERED_AHEAD */
	int err;
};

/** Write finished pieces up to the first missing one. The lock must be held. */
static void write_ready(struct ordered *o)
{
	while (o->written < o->n && o->pieces[o->written % ORDERED_AHEAD].is_made) {
		struct piece *p = &o->pieces[o->written % ORDERED_AHEAD];
		size_t before = o->written ? o->spent[(o->written - 1) % ORDERED_AHEAD] : 0;

		fwrite(p->text, 1, p->size, o->out);
		o->spent[o->written % ORDERED_AHEAD] = before + p->cost;
		free(p->text);
		*p = (struct piece){ 0 };
		o->written++;
	}
	pthread_cond_broadcast(&o->moved);
}

static int make_piece(struct ordered *o, size_t i, size_t spent, struct piece *p)
{
	FILE *stream = open_memstream(&p->text, &p->size);
	int err;

	if (!stream)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = o->make(o->context, i, spent, stream, &p->cost);
	if (fclose(stream) != 0 && !err)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (err)
		free(p->text);
	p->is_made = 1;
	return err;
}

static void *make_pieces(void *arg)
{
	struct ordered *o = arg;

	pthread_mutex_lock(&o->lock);
	while (!o->err && o->taken < o->n) {
		size_t i = o->taken;
		struct piece p = { 0 };
		int err;

		if (i >= o->written + ORDERED_AHEAD) {
			pthread_cond_wait(&o->moved, &o->lock);
			continue;
		}
		o->taken++;
		/* piece i - ORDERED_AHEAD is written, and nothing has replaced its cost yet */
		size_t spent = i < ORDERED_AHEAD ? 0 : o->spent[i % ORDERED_AHEAD];

		pthread_mutex_unlock(&o->lock);
		err = make_piece(o, i, spent, &p);
		pthread_mutex_lock(&o->lock);
		if (err)
			o->err = o->err ? o->err : err;
		else
			o->pieces[i % ORDERED_AHEAD] = p;
		write_ready(o);
	}
	pthread_cond_broadcast(&o->moved);
	pthread_mutex_unlock(&o->lock);
	return NULL;
}

int ordered_write(size_t n, ordered_make *make, void *context, FILE *out)
{
	struct ordered o = { .make = make, .context = context, .out = out, .n = n, .lock = PTHREAD_MUTEX_INITIALIZER,
	                     .moved = PTHREAD_COND_INITIALIZER };
	pthread_t threads[ORDERED_AHEAD];
	long cores = sysconf(_SC_NPROCESSORS_ONLN);
	int n_threads = 0;

	/* this thread works as well; if another does not start, only time is lost */
	while (n_threads + 1 < ORDERED_AHEAD && n_threads + 1 < cores &&
	       pthread_create(&threads[n_threads], NULL, make_pieces, &o) == 0)
		n_threads++;
	make_pieces(&o);
	while (n_threads > 0)
		pthread_join(threads[--n_threads], NULL);
	for (int i = 0; i < ORDERED_AHEAD; i++)
		free(o.pieces[i].text);
	return o.err;
}
