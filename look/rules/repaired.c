#include "look/rules/repaired.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "look/draws/modelview.h"
#include "look/draws/solid.h"
#include "look/rules/rules.h"

/* Limit for all meshes in the store: programs that send new meshes in every frame would fill any memory. */
#define MOST_BYTES ((size_t)1 << 30)

enum { MOST_WARNINGS = 4 };

struct entry {
	uint64_t hash[2]; /* hash of the original */
	struct repair_wants wants;
	struct repair_found found;
	struct scene_mesh *mesh; /* NULL: nothing was repaired */
};

struct repaired {
	pthread_mutex_t lock;
	struct entry *entries;
	size_t n, room, bytes; /* bytes: an estimate for all entries */
	unsigned n_leaking;    /* meshes that still leak light after their repair */
	int is_full;           /* 1: MOST_BYTES are reached, and that was reported */
};

int repaired_create(struct repaired **store)
{
	*store = calloc(1, sizeof(**store));
	if (!*store)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	pthread_mutex_init(&(*store)->lock, NULL);
	return 0;
}

void repaired_destroy(struct repaired **store)
{
	struct repaired *s = *store;

	if (!s)
		return;
	for (size_t i = 0; i < s->n; i++)
		free(s->entries[i].mesh);
	free(s->entries);
	pthread_mutex_destroy(&s->lock);
	free(s);
	*store = NULL;
}

int repaired_wants(const struct repair_rule *rule, const struct scene *scene, const struct scene_instance *in,
                   const struct scene_material *m, struct repair_wants *wants)
{
	const enum modelview_kind kind = modelview_kind_of(in->modelview);

	*wants = (struct repair_wants){ .weld = rule->weld ? *rule->weld : REPAIR_WELD,
		                        .turn = rule->turn ? *rule->turn : m->surface.transmit > 0,
		                        .clockwise = (m->front_face == GL_CW) != (kind == MODELVIEW_MIRRORED),
		                        .merge = rule->merge && *rule->merge,
		                        .flat = m->shade_model == GL_FLAT };
	if (!wants->turn)
		wants->clockwise = 0;
	return solid_is(scene, in) && kind != MODELVIEW_SINGULAR && !m->vertex_program && m->polygon_mode_front == GL_FILL &&
	       m->polygon_mode_back == GL_FILL && !(m->surface.hidden & SCENE_LEFT_OUT);
}

/* Warn if light still leaks through a repaired mesh, for the first few of these. */
static void warn(struct repaired *s, const struct scene_mesh *mesh, const struct repair_found *found)
{
	const float *at = found->leak_at;
	char hash[33];

	s->n_leaking += found->leaks > 0;
	if (found->leaks && s->n_leaking == MOST_WARNINGS + 1)
		err_warn(NULL, "more meshes leak light; attributes relume:rule.N of the frames list them");
	hash_text(mesh->hash, hash);
	if (found->leaks && s->n_leaking <= MOST_WARNINGS)
		err_warn(NULL,
		         "mesh %s still leaks light at %u edges after its repair, the longest about %g %g %g (object space)",
		         hash, found->leaks, (double)at[0], (double)at[1], (double)at[2]);
}

static const struct entry *find(const struct repaired *s, const struct scene_mesh *mesh,
                                const struct repair_wants *wants)
{
	for (size_t i = 0; i < s->n; i++)
		if (memcmp(s->entries[i].hash, mesh->hash, sizeof(mesh->hash)) == 0 &&
		    memcmp(&s->entries[i].wants, wants, sizeof(*wants)) == 0)
			return &s->entries[i];
	return NULL;
}

static int add(struct repaired *s, const struct scene_mesh *of, const struct repair_wants *wants)
{
	struct entry made = { .hash = { of->hash[0], of->hash[1] }, .wants = *wants };
	int err = MEMORY_GROW(s->entries, s->room, s->n + 1);

	if (!err)
		err = repair_mesh(of, wants, &made.found, &made.mesh);
	if (err)
		return err;
	warn(s, of, &made.found);
	s->bytes += sizeof(made) +
	            (made.mesh ? 64 * (size_t)made.mesh->vertex_count + 16 * (size_t)made.mesh->primitive_count : 0);
	s->entries[s->n++] = made;
	return 0;
}

int repaired_find(struct repaired *s, const struct scene_mesh *of, const struct repair_wants *wants,
                  const struct scene_mesh **mesh, struct repair_found *found)
{
	const struct entry *entry;
	int err = 0;

	*mesh = NULL;
	*found = (struct repair_found){ .welded = 0 };
	pthread_mutex_lock(&s->lock);
	entry = find(s, of, wants);
	if (!entry && s->bytes < MOST_BYTES) {
		err = add(s, of, wants);
		entry = err ? NULL : &s->entries[s->n - 1];
	} else if (!entry && !s->is_full) {
		s->is_full = 1;
		err_warn(NULL, "repaired meshes exceed 1 GiB; further meshes are not repaired");
	}
	if (entry) {
		*mesh = entry->mesh;
		*found = entry->found;
	}
	pthread_mutex_unlock(&s->lock);
	return err;
}

void repaired_describe(const struct repair_found *f, char *out, size_t room)
{
	const int n = snprintf(
		out, room,
		"%u vertices welded, %u places set into edges, %u triangles dropped, %u turned, %u places merged; ",
		f->welded, f->junctions, f->dropped, f->turned, f->merged);

	if (!f->shells)
		snprintf(out, room, "not repaired");
	else if (f->closed)
		snprintf(out + n, room - (size_t)n, "closed");
	else
		snprintf(out + n, room - (size_t)n, "%u edges leak, the longest about %g %g %g, %u look two ways",
		         f->leaks, (double)f->leak_at[0], (double)f->leak_at[1], (double)f->leak_at[2], f->twisted);
}
