#include "tracer/image/pack.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "tracer/image/exr_pack.h"

#define MAX_HELPERS 63

/* State shared by the threads of one call of pack_until. */
struct work {
	struct pack *pack;
	const struct image *img;
	struct exr_plane *planes;
	uint32_t first;   /* first row in planes */
	atomic_uint next; /* next chunk that no thread has taken */
	uint32_t last;    /* end of the chunks, exclusive */
	atomic_int failed;
};

struct helper {
	struct work *work;
	struct exr_packer *tools;
	pthread_t thread;
};

static void pack_chunk(struct work *w, struct exr_packer *tools, uint32_t number)
{
	struct exr_rows rows = { w->planes, w->pack->n_channels, w->img->width, number * PACK_ROWS - w->first, PACK_ROWS };
	struct pack_chunk *chunk = &w->pack->chunks[number];

	if (number * PACK_ROWS + rows.count > w->img->height)
		rows.count = w->img->height - number * PACK_ROWS;
	if (!exr_pack(tools, &rows))
		chunk->bytes = malloc(tools->n_packed);
	if (chunk->bytes)
		memcpy(chunk->bytes, tools->packed, chunk->n = tools->n_packed);
	else
		w->failed = 1;
}

/* Pack chunks until none is left; run by each thread. */
static void *help(void *arg)
{
	struct helper *helper = arg;
	struct work *w = helper->work;

	for (uint32_t i = w->next++; i < w->last && !w->failed; i = w->next++)
		pack_chunk(w, helper->tools, i);
	return NULL;
}

static int compare_channels(const void *a, const void *b)
{
	return strcmp((*(const struct image_channel *const *)a)->name, (*(const struct image_channel *const *)b)->name);
}

int pack_create(const struct image *img, unsigned threads, struct pack **out)
{
	struct pack *p = *out = calloc(1, sizeof(*p));

	if (!p)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	p->threads = threads < 1 ? 1 : threads > MAX_HELPERS ? MAX_HELPERS : threads;
	p->n_chunks = (img->height + PACK_ROWS - 1) / PACK_ROWS;
	p->chunks = calloc(p->n_chunks, sizeof(*p->chunks));
	p->tools = calloc(p->threads, sizeof(*p->tools));
	p->sorted = malloc((img->n_channels + 1) * sizeof(*p->sorted));
	if (!p->chunks || !p->tools || !p->sorted) {
		pack_destroy(out);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	p->n_channels = img->n_channels;
	for (size_t i = 0; i < img->n_channels; i++)
		p->sorted[i] = &img->channels[i];
	qsort(p->sorted, img->n_channels, sizeof(*p->sorted), compare_channels);
	return 0;
}

void pack_destroy(struct pack **pack)
{
	struct pack *p = *pack;

	*pack = NULL;
	if (!p)
		return;
	for (uint32_t i = 0; p->chunks && i < p->n_chunks; i++)
		free(p->chunks[i].bytes);
	for (unsigned i = 0; p->tools && i < p->threads; i++)
		exr_packer_free(&p->tools[i]);
	free(p->chunks);
	free(p->tools);
	free(p->sorted);
	free(p);
}

int pack_until(struct pack *p, const struct image *img, const void *const *planes, uint32_t first, uint32_t end)
{
	struct work w = { .pack = p,
		          .img = img,
		          .first = planes ? first : img->first,
		          .next = p->n_packed,
		          .last = end == img->height ? p->n_chunks : end / PACK_ROWS };
	struct helper helpers[MAX_HELPERS];
	unsigned n = 1;

	if (w.last <= p->n_packed)
		return 0;
	w.planes = calloc(p->n_channels, sizeof(*w.planes));
	if (!w.planes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < p->n_channels; i++) {
		const struct image_channel *c = p->sorted[i];
		const void *plane = planes ? planes[c - img->channels] : c->halves ? (const void *)c->halves : c->values;

		w.planes[i] = (struct exr_plane){ c->halves ? plane : NULL, c->halves ? NULL : plane, c->full_float };
	}
	for (unsigned i = 0; i < p->threads; i++)
		helpers[i] = (struct helper){ &w, &p->tools[i], 0 };
	while (n < p->threads && n < w.last - p->n_packed && pthread_create(&helpers[n].thread, NULL, help, &helpers[n]) == 0)
		n++;
	help(&helpers[0]);
	while (n > 1)
		pthread_join(helpers[--n].thread, NULL);
	free(w.planes);
	p->n_packed = w.last;
	return w.failed ? err_report(ERR_SYSTEM, NULL, "out of memory for rows of a picture") : 0;
}
