#include "replay/gl/surface/drawable.h"

#include <stdlib.h>

#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

struct gls_drawable *gls_drawable_of(struct gls_exec *x, uint64_t name)
{
	struct gls_drawable *d = table_find(&x->drawables, name);

	if (d)
		return d;
	d = calloc(1, sizeof(*d));
	if (!d || table_set(&x->drawables, name, d)) {
		free(d);
		gls_out_of_memory(x, sizeof(*d));
		return NULL;
	}
	d->front.is_front = 1;
	return d;
}
