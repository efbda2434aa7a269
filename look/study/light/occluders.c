#include "look/study/light/occluders.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

enum { LEAF = 4, DEEPEST = 64 };

/* Median split along the longest axis; the left child follows its parent. */
struct occluder_node {
	double low[3], high[3];
	uint32_t first, count; /* triangles of a leaf; count 0: inner */
	uint32_t right;
};

int occluders_put(struct occluders *o, const double corners[9])
{
	if (MEMORY_GROW(o->corners, o->room, o->n + 1))
		return ERR_SYSTEM;
	memcpy(o->corners[o->n++], corners, sizeof(o->corners[0]));
	return 0;
}

static int compare_x(const void *a, const void *b)
{
	double x = ((const double *)a)[0] + ((const double *)a)[3], y = ((const double *)b)[0] + ((const double *)b)[3];

	return x < y ? -1 : x > y;
}

static int compare_y(const void *a, const void *b)
{
	return compare_x((const double *)a + 1, (const double *)b + 1);
}

static int compare_z(const void *a, const void *b)
{
	return compare_x((const double *)a + 2, (const double *)b + 2);
}

static uint32_t build(struct occluders *o, uint32_t first, uint32_t count, uint32_t *n_nodes)
{
	static int (*const compare[3])(const void *, const void *) = { compare_x, compare_y, compare_z };
	uint32_t at = (*n_nodes)++;
	struct occluder_node *node = &o->nodes[at];
	int axis = 0;

	for (int k = 0; k < 3; k++) {
		node->low[k] = HUGE_VAL;
		node->high[k] = -HUGE_VAL;
		for (uint32_t i = first; i < first + count; i++)
			for (int c = k; c < 9; c += 3) {
				node->low[k] = fmin(node->low[k], o->corners[i][c]);
				node->high[k] = fmax(node->high[k], o->corners[i][c]);
			}
		axis = node->high[k] - node->low[k] > node->high[axis] - node->low[axis] ? k : axis;
	}
	node->first = first;
	node->count = count <= LEAF ? count : 0;
	node->right = 0;
	if (count <= LEAF)
		return at;
	qsort(o->corners + first, count, sizeof(o->corners[0]), compare[axis]);
	build(o, first, count / 2, n_nodes);
	o->nodes[at].right = build(o, first + count / 2, count - count / 2, n_nodes);
	return at;
}

int occluders_build(struct occluders *o)
{
	uint32_t n = 0;

	o->nodes = malloc((2 * o->n + 1) * sizeof(*o->nodes));
	if (!o->nodes)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	build(o, 0, (uint32_t)o->n, &n);
	return 0;
}

void occluders_free(struct occluders *o)
{
	free(o->corners);
	free(o->nodes);
	*o = (struct occluders){ .n = 0 };
}

/* Moeller and Trumbore 1997. */
static int crosses(const double c[9], const double from[3], const double d[3])
{
	double e[3], f[3], p[3], s[3], q[3], det = 0, u = 0, v = 0, t = 0;

	for (int k = 0; k < 3; k++) {
		e[k] = c[3 + k] - c[k];
		f[k] = c[6 + k] - c[k];
		s[k] = from[k] - c[k];
	}
	for (int k = 0; k < 3; k++) {
		int a = (k + 1) % 3, b = (k + 2) % 3;

		p[k] = d[a] * f[b] - d[b] * f[a];
		q[k] = s[a] * e[b] - s[b] * e[a];
		det += e[k] * p[k];
		u += s[k] * p[k];
	}
	if (det == 0)
		return 0;
	for (int k = 0; k < 3; k++) {
		v += d[k] * q[k];
		t += f[k] * q[k];
	}
	u /= det;
	v /= det;
	t /= det;
	return u >= 0 && v >= 0 && u + v <= 1 && t > 1e-3 && t < 1 - 1e-3;
}

static int enters(const struct occluder_node *n, const double from[3], const double inverse[3])
{
	double begin = 0, end = 1;

	for (int k = 0; k < 3; k++) { /* fmin and fmax would be function calls */
		double a = (n->low[k] - from[k]) * inverse[k], b = (n->high[k] - from[k]) * inverse[k];
		double near = (a < b ? a : b) - 1e-9, far = (a < b ? b : a) + 1e-9;

		begin = near > begin ? near : begin;
		end = far < end ? far : end;
	}
	return begin <= end;
}

int occluders_sees(const struct occluders *o, const double from[3], const double to[3], uint32_t *blocker)
{
	double d[3], inverse[3];
	uint32_t stack[DEEPEST], n = 1;

	for (int k = 0; k < 3; k++) {
		d[k] = to[k] - from[k];
		inverse[k] = 1 / (fabs(d[k]) > 1e-12 ? d[k] : 1e-12);
	}
	if (*blocker < o->n && crosses(o->corners[*blocker], from, d))
		return 0;
	stack[0] = 0;
	while (n && o->n) {
		const struct occluder_node *node = &o->nodes[stack[--n]];

		if (!enters(node, from, inverse))
			continue;
		for (uint32_t i = node->first; i < node->first + node->count; i++)
			if (crosses(o->corners[i], from, d)) {
				*blocker = i;
				return 0;
			}
		if (!node->count && n + 2 <= DEEPEST) {
			stack[n++] = node->right;
			stack[n++] = (uint32_t)(node - o->nodes) + 1;
		}
	}
	return 1;
}
