/* Matches deforming draws by the cheapest alignment of both frames' orders. */
#include "look/between/deforming.h"

#include <math.h>
#include <stdlib.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "base/table.h"
#include "look/between/place.h"
#include "look/draws/followed.h"
#include "look/draws/matrix.h"
#include "scene/box.h"

#define ALONE 0.5 /* cost of a draw without a partner, if one frame has more of them */
#define MOST_COMPARED (1u << 26) /* edges, over all pairs of a kind; beyond, only the n-th draws of both are compared */

/* --- Kinds ------------------------------------------------------------------------------------------------------- */

/* Keys of the points (followed_points) that occur in each frame. */
struct points {
	const struct scene *base;
	struct table of[2]; /* base and other frame: keys -> any value */
};

/* @return 0 or ERR_SYSTEM (reported) */
static int gather_points(struct table *t, const struct scene *s)
{
	int err = 0;

	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		err = table_set(t, followed_points(s->meshes[s->instances[i].mesh]), t);
	return err;
}

/* The kind of a draw: a hash of triangles and texture coordinates. 0: it does not deform, as the other frame has its
 * points */
static uint64_t kind_of(const struct scene *s, uint32_t instance, const void *with)
{
	const struct points *points = with;
	const struct scene_mesh *mesh = s->meshes[s->instances[instance].mesh];
	uint64_t key = followed_triangles(mesh);

	if (table_find(&points->of[s == points->base], followed_points(mesh)))
		return 0;
	for (int u = 0; u < SCENE_MAX_UNITS; u++)
		if (mesh->texcoord[u])
			key = XXH3_64bits_withSeed(mesh->texcoord[u], mesh->vertex_count * 4 * sizeof(float), key);
	return key ? key : 1;
}

/* --- Edges ------------------------------------------------------------------------------------------------------- */

static size_t edge_count(const struct scene *s, uint32_t i)
{
	const struct scene_mesh *mesh = s->meshes[s->instances[i].mesh];

	return (size_t)mesh->primitive_count * mesh->kind;
}

/* The lengths of edges in eye space, which motions do not change. */
static void measure_edges(const struct scene *s, uint32_t i, float *out)
{
	const struct scene_mesh *mesh = s->meshes[s->instances[i].mesh];
	const size_t n = edge_count(s, i), corners = mesh->kind;
	double to[16];

	matrix_from_floats(to, s->instances[i].modelview);
	for (size_t k = 0; k < n; k++) {
		const float *a = mesh->position + 4 * (size_t)mesh->index[k];
		const float *b = mesh->position + 4 * (size_t)mesh->index[(k + 1) % corners ? k + 1 : k + 1 - corners];
		double along[4] = { 0 }, moved[4];

		for (int c = 0; c < 3; c++)
			along[c] = (double)b[c] - (double)a[c];
		matrix_transform(moved, to, along);
		out[k] = (float)hypot(hypot(moved[0], moved[1]), moved[2]);
	}
}

/* The sum of differences of edge lengths, as a share of the sum of the longer ones: 0 to 1. */
static double stretch(const float *a, const float *b, size_t n)
{
	double off = 0, all = 0;

	for (size_t k = 0; k < n; k++) {
		off += fabs((double)a[k] - (double)b[k]);
		all += fmax((double)a[k], (double)b[k]);
	}
	return all > 0 ? off / all : 0;
}

/* --- Costs ------------------------------------------------------------------------------------------------------- */

/* A kind, with the places and edges of its draws in the other frame's eye space: members, then rivals. */
struct kind {
	struct bridge *b;
	struct group *g;
	size_t n_edges;       /* per draw */
	double alone;         /* cost of a draw without a partner */
	struct place *places; /* [n + n_rivals] */
	float *edges;         /* [n + n_rivals][n_edges] */
};

/* Fill in the rest of a kind. @return 0 or ERR_SYSTEM (reported) */
static int measure(struct kind *kind)
{
	const struct bridge *b = kind->b;
	const size_t all = (size_t)kind->g->n + kind->g->n_rivals;

	kind->n_edges = edge_count(b->base, kind->g->members[0]);
	kind->places = calloc(all, sizeof(*kind->places));
	kind->edges = calloc(all * kind->n_edges + 1, sizeof(*kind->edges));
	if (!kind->places || !kind->edges)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t k = 0; k < all; k++) {
		const int is_member = k < kind->g->n;
		const uint32_t i = is_member ? kind->g->members[k] : kind->g->rivals[k - kind->g->n];
		const struct scene *s = is_member ? b->base : b->other;
		const double *way = is_member && bridge_is_filmed(b, i) ? bridge_way(b, b->camera) : NULL;
		float box[2][3];

		scene_box(s->meshes[s->instances[i].mesh], box[0], box[1]);
		place_find(&s->instances[i], (const float (*)[3])box, way, &kind->places[k]);
		if (edge_count(s, i) == kind->n_edges)
			measure_edges(s, i, kind->edges + k * kind->n_edges);
	}
	return 0;
}

/* The distance between a member and a rival. */
static double way_of(const struct kind *kind, uint32_t member, uint32_t rival)
{
	return place_way(&kind->places[member], &kind->places[kind->g->n + rival]);
}

/* The size of the larger one. */
static double size_of(const struct kind *kind, uint32_t member, uint32_t rival)
{
	return fmax(kind->places[member].size, kind->places[kind->g->n + rival].size);
}

/* The cost of a couple, as in deforming.h. INFINITY: they cannot be one */
static double price(const struct kind *kind, uint32_t member, uint32_t rival)
{
	const struct group *g = kind->g;
	const double way = way_of(kind, member, rival), size = size_of(kind, member, rival);
	const float *edges = kind->edges + member * kind->n_edges, *others = kind->edges + (g->n + rival) * kind->n_edges;
	const double cost = way / (way + size) + stretch(edges, others, kind->n_edges);

	return cost <= 2 * kind->alone && bridge_may_be_one(kind->b, g->members[member], g->rivals[rival]) ?
	               cost :
	               INFINITY;
}

/* --- Alignment --------------------------------------------------------------------------------------------------- */

/*
 * The cheapest alignment of members and rivals (Needleman and Wunsch 1970), from the last ones to the first.
 * @param steps  [n + 1][n_rivals + 1]: receives the next step from each position in both: 0 couples them, 1 skips the
 *               member, 2 skips the rival
 * @param row    [n_rivals + 1]: working memory
 */
static void align(const struct kind *kind, unsigned char *steps, double *row)
{
	const uint32_t n = kind->g->n, m = kind->g->n_rivals;

	for (uint32_t j = 0; j <= m; j++) {
		row[j] = kind->alone * (m - j);
		steps[(size_t)n * (m + 1) + j] = 2;
	}
	for (uint32_t i = n; i-- > 0;) {
		double after = row[m]; /* the cost from the next member and the next rival on */

		row[m] += kind->alone;
		steps[(size_t)i * (m + 1) + m] = 1;
		for (uint32_t j = m; j-- > 0;) {
			const double both = after + price(kind, i, j);
			const double one = row[j] + kind->alone, other = row[j + 1] + kind->alone;

			after = row[j];
			row[j] = fmin(both, fmin(one, other));
			steps[(size_t)i * (m + 1) + j] = both <= row[j] ? 0 : one <= row[j] ? 1 : 2;
		}
	}
}

/* @param partners  [n]: receives each member's rival, or SCENE_NONE
 * @return 0 or ERR_SYSTEM (reported) */
static int find_partners(const struct kind *kind, uint32_t *partners)
{
	const uint32_t n = kind->g->n, m = kind->g->n_rivals;
	unsigned char *steps = malloc((n + (size_t)1) * (m + (size_t)1));
	double *row = malloc((m + (size_t)1) * sizeof(*row));
	const int err = steps && row ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		align(kind, steps, row);
	for (uint32_t i = 0, j = 0; !err && i < n && j < m;) {
		const int step = steps[(size_t)i * (m + 1) + j];

		if (!step)
			partners[i] = j;
		i += step != 2;
		j += step != 1;
	}
	free(steps);
	free(row);
	return err;
}

/*
 * Couple a member if that is cheap, or if it stays close to the cheap one before it in this direction.
 * @param reach  how far that one moved, and its size
 */
static void couple_partner(const struct kind *kind, uint32_t member, uint32_t rival, double *reach)
{
	const double way = rival == SCENE_NONE ? INFINITY : way_of(kind, member, rival);

	if (rival != SCENE_NONE && price(kind, member, rival) <= 2 * ALONE)
		*reach = way + size_of(kind, member, rival);
	if (way <= *reach && !group_is_coupled(kind->b, kind->g, member))
		group_couple(kind->b, kind->g, member, rival);
}

static void couple_partners(const struct kind *kind, const uint32_t *partners)
{
	double forth = 0, back = 0;

	for (uint32_t i = 0; i < kind->g->n; i++)
		/* NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): couple_kind has set them all */
		couple_partner(kind, i, partners[i], &forth);
	for (uint32_t i = kind->g->n; i-- > 0;)
		couple_partner(kind, i, partners[i], &back);
}

/* Undo the couples of a kind. */
static void part(struct bridge *b, const struct group *g)
{
	for (uint32_t k = 0; k < g->n; k++)
		group_part(b, g->members[k]);
}

/* Couple the draws of a kind. @return 0 or ERR_SYSTEM (reported) */
static int couple_kind(struct bridge *b, struct group *g)
{
	struct kind kind = { .b = b, .g = g, .alone = g->n == g->n_rivals ? 2 * ALONE : ALONE };
	uint32_t *partners = malloc((g->n + (size_t)1) * sizeof(*partners));
	int err = partners ? measure(&kind) : err_report(ERR_SYSTEM, NULL, "out of memory");
	const int is_small = (uint64_t)g->n * g->n_rivals * (kind.n_edges + 1) <= MOST_COMPARED;

	for (uint32_t i = 0; !err && i < g->n; i++)
		partners[i] = !is_small && i < g->n_rivals && price(&kind, i, i) < INFINITY ? i : SCENE_NONE;
	if (!err && is_small)
		err = find_partners(&kind, partners);
	if (!err)
		couple_partners(&kind, partners);
	free(partners);
	free(kind.places);
	free(kind.edges);
	return err;
}

/* --- All kinds --------------------------------------------------------------------------------------------------- */

int deforming_couple(struct bridge *b, const struct groups *kinds)
{
	int err = 0;

	for (uint32_t i = 0; i < kinds->n && !err; i++) {
		part(b, &kinds->all[i]);
		if (kinds->all[i].n_rivals)
			err = couple_kind(b, &kinds->all[i]);
	}
	return err;
}

int deforming_find(struct bridge *b, struct groups *kinds)
{
	struct points points = { .base = b->base };
	int err = gather_points(&points.of[0], b->base);

	if (!err)
		err = gather_points(&points.of[1], b->other);
	if (!err)
		err = groups_find(kinds, b, kind_of, &points);
	table_free(&points.of[0]);
	table_free(&points.of[1]);
	for (uint32_t i = 0; i < kinds->n && !err; i++) {
		struct group *g = &kinds->all[i];

		part(b, g);
		if (g->n != 1 || g->n_rivals != 1)
			continue;
		err = couple_kind(b, g);
		b->couples[g->members[0]].is_sure = 1;
	}
	return err;
}
