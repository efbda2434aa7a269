#include "replay/gl/surface/drawable.h"

#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

struct gls_drawable *gls_drawable_of(struct gls_exec *x, uint64_t name)
{
	struct gls_drawable *d = table_find(&x->drawables, name);

	if (d)
		return d;
	d = gls_object_create(x, &x->drawables, name, sizeof(*d));
	if (d)
		d->front.is_front = 1;
	return d;
}
