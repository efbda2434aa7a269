#include "replay/build/known.h"

#include <string.h>

/* From x0, y0 up to, but excluding, x1, y1. */
struct box {
	int64_t x0, y0, x1, y1;
};

static struct box box_of(const int32_t part[4])
{
	return (struct box){ part[0], part[1], (int64_t)part[0] + part[2], (int64_t)part[1] + part[3] };
}

/* 1 if the first n parts together cover a box: the others must cover what the last one leaves uncovered. */
static int is_covered(const struct box *b, const int32_t (*parts)[4], uint32_t n)
{
	struct box p, left[4];

	if (b->x0 >= b->x1 || b->y0 >= b->y1)
		return 1;
	if (!n)
		return 0;
	p = box_of(parts[--n]);
	if (p.x0 >= b->x1 || p.x1 <= b->x0 || p.y0 >= b->y1 || p.y1 <= b->y0)
		return is_covered(b, parts, n);
	p.y0 = p.y0 > b->y0 ? p.y0 : b->y0;
	p.y1 = p.y1 < b->y1 ? p.y1 : b->y1;
	left[0] = (struct box){ b->x0, b->y0, b->x1, p.y0 };
	left[1] = (struct box){ b->x0, p.y1, b->x1, b->y1 };
	left[2] = (struct box){ b->x0, p.y0, p.x0, p.y1 };
	left[3] = (struct box){ p.x1, p.y0, b->x1, p.y1 };
	for (int i = 0; i < 4; i++)
		if (!is_covered(&left[i], parts, n))
			return 0;
	return 1;
}

void gls_known_clear(struct gls_known *k, uint32_t buffers, const uint32_t all[2], const int32_t part[4])
{
	const struct box whole = { 0, 0, all[0], all[1] };

	if (is_covered(&whole, (const int32_t(*)[4])part, 1))
		k->whole |= buffers;
	for (unsigned i = 0; i < 3; i++) {
		const struct box b = box_of(part);

		if (!(buffers & ~k->whole & 1u << i) || is_covered(&b, k->parts[i], k->n[i]) || k->n[i] == GLS_KNOWN_PARTS)
			continue;
		memcpy(k->parts[i][k->n[i]++], part, sizeof(k->parts[i][0]));
		if (is_covered(&whole, k->parts[i], k->n[i]))
			k->whole |= 1u << i;
	}
}

uint32_t gls_known_lacks(const struct gls_known *k, uint32_t buffers, const int32_t part[4])
{
	const struct box b = box_of(part);
	uint32_t lacks = buffers & ~k->whole;

	for (unsigned i = 0; i < 3; i++)
		if (lacks >> i & 1 && is_covered(&b, k->parts[i], k->n[i]))
			lacks &= ~(1u << i);
	return lacks;
}
