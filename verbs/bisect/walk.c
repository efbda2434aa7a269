#include "verbs/bisect/walk.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "replay/machine/commands.h"
#include "replay/play/player.h"
#include "replay/trace/text.h"
#include "verbs/bisect/names.h"
#include "verbs/bisect/states.h"

/* Effects of a call that differs, besides state. */
enum { DRAWS = 1, FILLS_LIST = 2, CHANGES_OBJECT = 4, CHANGES_PROGRAM = 8, CHANGES_ARRAY = 16, N_EFFECTS = 5 };
static const char *const effects[N_EFFECTS] = { "the drawing", "a display list", "an object",
	                                        "programs or their inputs", "vertex arrays" };

struct side {
	struct player player;
	const struct recording *recording;
	size_t next;       /* index of its next call that counts */
	uint64_t read;     /* calls of the file so far */
	uint64_t number;   /* number of the last one that counts */
	unsigned effect;   /* effects of all calls taken since this was cleared */
};

struct walk {
	struct side sides[N_SIDES];
	struct names names;
	struct table known; /* members of the state that differ */
	struct partings *out;
	size_t most;
};

static unsigned effect_of(const struct side *s, const struct call *c)
{
	const struct gls_command *k = c->sig->command >= 0 ? &gls_commands[c->sig->command] : NULL;
	const struct gls_state *st = s->player.exec->st;

	if (!k)
		return 0;
	if (st && st->list && k->kind != GLS_KIND_WINDOW)
		return FILLS_LIST;
	if (k->drawing == GLS_DRAWS || k->kind == GLS_KIND_VERTEX || k->kind == GLS_KIND_ARRAY ||
	    k->role == GLS_ROLE_BEGIN || k->role == GLS_ROLE_END)
		return DRAWS;
	switch (k->kind) {
	case GLS_KIND_NONE: return CHANGES_PROGRAM;
	case GLS_KIND_OBJECT: return CHANGES_OBJECT;
	case GLS_KIND_CLIENT: return CHANGES_ARRAY;
	default: return 0;
	}
}

/* Execute the next call that counts, and all before it. @return 0 or ERR_* (reported) */
static int take(struct side *s, const struct call **call)
{
	const uint64_t at = s->recording->calls[s->next].at;

	while (s->read <= at) {
		const int rc = player_step(&s->player, call);

		if (rc != 1)
			return rc ? rc : err_report(ERR_INPUT, s->recording->path, "has changed while it was read");
		s->read++;
	}
	/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): s->read <= at on entry, so that a call has been read */
	s->number = (*call)->number;
	s->effect |= effect_of(s, *call);
	s->next++;
	return 0;
}

static int is_full(const struct walk *w)
{
	return w->out->n >= w->most;
}

/* Add a difference at the next calls. @return NULL: out of memory (reported) */
static struct parting *begin_parting(struct walk *w)
{
	struct parting *p;

	if (MEMORY_GROW(w->out->list, w->out->room, w->out->n + 1))
		return NULL;
	p = &w->out->list[w->out->n++];
	*p = (struct parting){ .argument = NULL };
	for (int s = 0; s < N_SIDES; s++) {
		const struct side *side = &w->sides[s];
		const struct recording *r = side->recording;

		p->frame[s] = recording_frame(r, side->next < r->n ? side->next : r->n - 1);
		p->number[s] = side->number;
	}
	return p;
}

static int put_text(const struct call *c, char **text)
{
	size_t size = 0;
	FILE *out = open_memstream(text, &size);

	if (out)
		text_call(out, c);
	return out && fclose(out) == 0 ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* Complete a difference after both recordings have executed its calls. */
static int end_parting(struct walk *w, struct parting *p)
{
	const unsigned effect = w->sides[GOOD].effect | w->sides[BAD].effect;

	for (int e = 0; e < N_EFFECTS && !p->effect; e++)
		p->effect = effect & 1u << e ? effects[e] : NULL;
	return states_compare(w->sides[GOOD].player.exec->st, w->sides[BAD].player.exec->st, &w->names, &w->known, &p->state);
}

static int take_both(struct walk *w, const struct call *calls[N_SIDES])
{
	int err = 0;

	for (int s = 0; s < N_SIDES && !err; s++) {
		w->sides[s].effect = 0;
		err = take(&w->sides[s], &calls[s]);
	}
	return err;
}

/* Execute one call of each recording, both of the same command, and compare them. */
static int pair(struct walk *w)
{
	const size_t at[N_SIDES] = { w->sides[GOOD].next, w->sides[BAD].next };
	const struct call *calls[N_SIDES];
	struct parting *p;
	uint32_t argument;
	int err = take_both(w, calls), same;

	if (err)
		return err;
	same = names_compare(&w->names, calls[GOOD], calls[BAD], &argument);
	if (same)
		return same < 0 ? same : 0;
	p = begin_parting(w);
	if (!p)
		return ERR_SYSTEM;
	for (int s = 0; s < N_SIDES && !err; s++) {
		p->frame[s] = recording_frame(w->sides[s].recording, at[s]);
		p->count[s] = 1;
		err = put_text(calls[s], &p->text[s]);
	}
	if (!err && argument < calls[GOOD]->sig->n_args)
		p->argument = strdup(calls[GOOD]->sig->arg_names[argument]);
	return err ? err : end_parting(w, p);
}

/* Execute calls that replace others or have no counterpart. */
static int replaced(struct walk *w, const size_t count[N_SIDES])
{
	struct parting *p = begin_parting(w);
	const struct call *call;
	int err = p ? 0 : ERR_SYSTEM;

	for (int s = 0; s < N_SIDES && !err; s++) {
		w->sides[s].effect = 0;
		p->count[s] = count[s];
		for (size_t i = 0; i < count[s] && !err; i++) {
			err = take(&w->sides[s], &call);
			if (!err && i == 0) {
				p->number[s] = call->number;
				err = put_text(call, &p->text[s]);
			}
		}
	}
	return err ? err : end_parting(w, p);
}

static uint64_t *names_of(const struct recording *r, size_t first, size_t end)
{
	uint64_t *out = malloc((end - first + 1) * sizeof(*out));

	for (size_t i = first; out && i < end; i++)
		out[i - first] = r->calls[i].name;
	return out;
}

/* Calls of the same commands in the same order are compared as one call each, with other arguments. */
static int walk_hunk(struct walk *w, const struct align_hunk *h)
{
	uint64_t *a = names_of(w->sides[GOOD].recording, h->a0, h->a1), *b = names_of(w->sides[BAD].recording, h->b0, h->b1);
	struct align_hunk *hunks = NULL;
	size_t n = 0;
	int err = a && b ? align_keys(a, h->a1 - h->a0, b, h->b1 - h->b0, &hunks, &n) :
	                   err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; i <= n && !err && !is_full(w); i++) {
		while (!err && !is_full(w) && w->sides[GOOD].next < (i < n ? h->a0 + hunks[i].a0 : h->a1))
			err = pair(w);
		if (!err && i < n && !is_full(w))
			err = replaced(w, (size_t[]){ hunks[i].a1 - hunks[i].a0, hunks[i].b1 - hunks[i].b0 });
	}
	free(hunks);
	free(a);
	free(b);
	return err;
}

int walk_both(const struct partners *partners, const struct recording *good, const struct recording *bad, size_t most,
              struct partings *out)
{
	struct walk w = { .sides = { { .recording = good }, { .recording = bad } }, .out = out, .most = most };
	int err = player_open(&w.sides[GOOD].player, good->path);

	if (!err)
		err = player_open(&w.sides[BAD].player, bad->path);
	for (size_t i = 0; i <= partners->n && !err && !is_full(&w); i++) {
		const struct align_hunk end = { good->n, good->n, bad->n, bad->n }, *h = i < partners->n ? &partners->hunks[i] : &end;

		while (!err && !is_full(&w) && w.sides[GOOD].next < h->a0)
			err = pair(&w);
		if (!err && !is_full(&w) && i < partners->n)
			err = walk_hunk(&w, h);
	}
	out->is_cut = is_full(&w);
	names_free(&w.names);
	table_free(&w.known);
	player_close(&w.sides[GOOD].player);
	player_close(&w.sides[BAD].player);
	return err;
}

void partings_free(struct partings *p)
{
	for (size_t i = 0; i < p->n; i++) {
		free(p->list[i].text[GOOD]);
		free(p->list[i].text[BAD]);
		free(p->list[i].argument);
		free(p->list[i].state);
	}
	free(p->list);
	*p = (struct partings){ .n = 0 };
}
