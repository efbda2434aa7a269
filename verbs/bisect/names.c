#include "verbs/bisect/names.h"

#include <string.h>
#include <xxhash.h>

#include "base/err.h"

/* Below: an offset in a buffer object, or a number in a pointer's clothes. Above: an address in the program. */
#define LEAST_ADDRESS 0x10000

enum { MOST_NAMES = 65536 /* most names of one glGenLists */ };

/* --- Which arguments are names ----------------------------------------------------------------------------------- */

/* By the registry's names of arguments; an argument of type ENUM is none. */
static const struct {
	const char *argument;
	enum names_kind kind;
} kinds[] = {
	{ "texture", NAMES_TEXTURE }, { "textures", NAMES_TEXTURE }, { "list", NAMES_LIST }, { "base", NAMES_LIST_BASE },
	{ "buffer", NAMES_BUFFER }, { "buffers", NAMES_BUFFER }, { "framebuffer", NAMES_FRAMEBUFFER },
	{ "framebuffers", NAMES_FRAMEBUFFER }, { "renderbuffer", NAMES_RENDERBUFFER },
	{ "renderbuffers", NAMES_RENDERBUFFER }, { "program", NAMES_PROGRAM }, { "programs", NAMES_PROGRAM },
	{ "shader", NAMES_PROGRAM }, { "sampler", NAMES_SAMPLER }, { "samplers", NAMES_SAMPLER },
	{ "array", NAMES_VERTEX_ARRAY }, { "arrays", NAMES_VERTEX_ARRAY }, { "id", NAMES_QUERY }, { "ids", NAMES_QUERY },
};
static const char *const windows[] = { "drawable", "draw", "read", "win", "window", "pbuf", "pixmap", "glxpixmap" };

static int is_of_gl(const char *command)
{
	return command[0] == 'g' && command[1] == 'l' && command[2] != 'X';
}

static enum names_kind kind_of(const struct call *c, uint32_t argument)
{
	const char *name;

	if (argument >= c->sig->n_args)
		return NAMES_NONE;
	name = c->sig->arg_names[argument];
	if (!is_of_gl(c->sig->name)) {
		for (size_t i = 0; i < sizeof(windows) / sizeof(windows[0]); i++)
			if (strcmp(name, windows[i]) == 0)
				return NAMES_WINDOW;
		return c->args[argument].type == TRACE_OPAQUE ? NAMES_WINDOW : NAMES_NONE;
	}
	if (c->args[argument].type != TRACE_UINT && c->args[argument].type != TRACE_SINT &&
	    c->args[argument].type != TRACE_ARRAY)
		return NAMES_NONE;
	for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++)
		if (strcmp(name, kinds[i].argument) == 0)
			return kinds[i].kind;
	return NAMES_NONE;
}

/* The kind of name that a call returns, and whether it is new: for glGen*, in arguments, too. */
static enum names_kind kind_of_result(const struct call *c)
{
	const char *name = c->sig->name;

	if (strcmp(name, "glGenLists") == 0)
		return NAMES_LIST;
	if (strncmp(name, "glCreate", 8) == 0)
		return NAMES_PROGRAM;
	return is_of_gl(name) || c->ret.type != TRACE_OPAQUE ? NAMES_NONE : NAMES_WINDOW;
}

/* --- Pairs ------------------------------------------------------------------------------------------------------- */

void names_free(struct names *names)
{
	for (int k = 0; k < N_NAMES_KINDS; k++) {
		table_free(&names->to[k]);
		table_free(&names->from[k]);
	}
}

static uint64_t other(const struct table *t, uint64_t name)
{
	return (uint64_t)(uintptr_t)table_find(t, name);
}

static void forget(struct names *names, enum names_kind kind, uint64_t good, uint64_t bad)
{
	const uint64_t was_bad = (uint64_t)(uintptr_t)table_remove(&names->to[kind], good);
	const uint64_t was_good = (uint64_t)(uintptr_t)table_remove(&names->from[kind], bad);

	if (was_bad)
		table_remove(&names->from[kind], was_bad - 1);
	if (was_good)
		table_remove(&names->to[kind], was_good - 1);
}

int names_pair(struct names *names, enum names_kind kind, uint64_t good, uint64_t bad)
{
	const uint64_t to = other(&names->to[kind], good), from = other(&names->from[kind], bad);

	if (kind == NAMES_NONE || good == 0 || bad == 0 || good == UINT64_MAX || bad == UINT64_MAX)
		return good == bad;
	if (to || from)
		return to == bad + 1;
	if (table_set(&names->to[kind], good, (void *)(uintptr_t)(bad + 1)) ||
	    table_set(&names->from[kind], bad, (void *)(uintptr_t)(good + 1)))
		return ERR_SYSTEM;
	return 1;
}

/* --- Values ------------------------------------------------------------------------------------------------------ */

/* The type of a value, however a recorder wrote it. */
enum form { NOTHING, NUMBER, REAL, TEXT, BYTES, LIST, ADDRESS };

static enum form form_of(const struct trace_value *v)
{
	switch (v->type) {
	case TRACE_FALSE:
	case TRACE_TRUE:
	case TRACE_SINT:
	case TRACE_UINT:
	case TRACE_ENUM:
	case TRACE_BITMASK:
		return NUMBER;
	case TRACE_FLOAT: case TRACE_DOUBLE: return REAL;
	case TRACE_STRING: return TEXT;
	case TRACE_BLOB: case TRACE_WSTRING: return BYTES;
	case TRACE_ARRAY: case TRACE_STRUCT: return LIST;
	case TRACE_NULL: case TRACE_OPAQUE: return ADDRESS;
	default: return NOTHING;
	}
}

static uint64_t number_of(const struct trace_value *v)
{
	return v->type == TRACE_FALSE || v->type == TRACE_NULL ? 0 : v->type == TRACE_TRUE ? 1 : v->u;
}

static double real_of(const struct trace_value *v)
{
	return v->type == TRACE_FLOAT ? (double)v->f : v->d;
}

static const struct trace_value *plain(const struct trace_value *v)
{
	return v->type == TRACE_REPR ? &v->items[1] : v;
}

static uint64_t bytes_of(const struct trace_value *v)
{
	return v->type == TRACE_WSTRING ? 4 * v->count : v->count;
}

static uint64_t hash_value(const struct trace_value *v, enum names_kind kind, uint64_t hash)
{
	uint64_t word;
	double real;

	v = plain(v);
	word = form_of(v);
	switch (form_of(v)) {
	case NUMBER: word = kind ? (number_of(v) != 0) : number_of(v); break;
	case ADDRESS: word = kind || number_of(v) >= LEAST_ADDRESS ? (number_of(v) != 0) : number_of(v); break;
	case REAL:
		real = real_of(v) + 0.0; /* -0 is 0 */
		memcpy(&word, &real, sizeof(word));
		break;
	case TEXT:
	case BYTES:
		return XXH3_64bits_withSeed(v->type == TRACE_STRING ? (const void *)v->str : v->blob, bytes_of(v),
		                            hash);
	case LIST:
		for (uint64_t i = 0; i < v->count; i++)
			hash = hash_value(&v->items[i], kind, hash);
		break;
	case NOTHING: break;
	}
	return XXH64(&word, sizeof(word), hash);
}

uint64_t names_hash(const struct call *c)
{
	uint64_t hash = XXH3_64bits(c->sig->name, strlen(c->sig->name));

	for (uint32_t i = 0; i < c->n_args; i++)
		hash = hash_value(&c->args[i], kind_of(c, i), hash);
	return hash;
}

/* A comparison of two values. */
struct comparison {
	struct names *names;
	enum names_kind kind;
	int is_new; /* 1: the names begin here */
};

static int compare_values(const struct comparison *k, const struct trace_value *g, const struct trace_value *b)
{
	int same = 1;

	g = plain(g);
	b = plain(b);
	if (form_of(g) != form_of(b))
		return 0;
	switch (form_of(g)) {
	case NOTHING: return 1;
	case NUMBER: case ADDRESS:
		if (form_of(g) == ADDRESS && !k->kind && number_of(g) >= LEAST_ADDRESS && number_of(b) >= LEAST_ADDRESS)
			return 1;
		if (k->kind && k->is_new)
			forget(k->names, k->kind, number_of(g), number_of(b));
		return names_pair(k->names, k->kind, number_of(g), number_of(b));
	case REAL: return real_of(g) == real_of(b) || (real_of(g) != real_of(g) && real_of(b) != real_of(b));
	case TEXT: return g->count == b->count && memcmp(g->str, b->str, g->count) == 0;
	case BYTES: return bytes_of(g) == bytes_of(b) && memcmp(g->blob, b->blob, bytes_of(g)) == 0;
	case LIST: break;
	}
	if (g->count != b->count)
		return 0;
	for (uint64_t i = 0; i < g->count && same == 1; i++)
		same = compare_values(k, &g->items[i], &b->items[i]);
	return same;
}

static int compare_result(struct names *names, const struct call *g, const struct call *b)
{
	struct comparison k = { names, kind_of_result(g), 1 };
	uint64_t n = strcmp(g->sig->name, "glGenLists") == 0 && g->n_args ? number_of(&g->args[0]) : 1;
	int err = 1;

	if (!k.kind || form_of(&g->ret) != form_of(&b->ret) || !number_of(&g->ret) || !number_of(&b->ret))
		return 1;
	k.is_new = k.kind != NAMES_WINDOW || strstr(g->sig->name, "Create") != NULL;
	n = n < MOST_NAMES ? n : MOST_NAMES;
	for (uint64_t i = 0; i < n && err >= 0; i++) {
		if (k.is_new)
			forget(names, k.kind, number_of(&g->ret) + i, number_of(&b->ret) + i);
		err = names_pair(names, k.kind, number_of(&g->ret) + i, number_of(&b->ret) + i);
	}
	return err < 0 ? err : 1;
}

static void forget_deleted(struct names *names, const struct call *g, const struct call *b)
{
	for (uint32_t i = 0; i < g->n_args && i < b->n_args; i++) {
		const enum names_kind kind = kind_of(g, i);
		const struct trace_value *x = &g->args[i], *y = &b->args[i];

		for (uint64_t k = 0; kind && x->type == TRACE_ARRAY && y->type == TRACE_ARRAY && k < x->count && k < y->count; k++)
			forget(names, kind, number_of(&x->items[k]), number_of(&y->items[k]));
	}
}

int names_compare(struct names *names, const struct call *g, const struct call *b, uint32_t *argument)
{
	struct comparison k = { .names = names, .is_new = strncmp(g->sig->name, "glGen", 5) == 0 };
	int same = 1;

	for (*argument = 0; *argument < g->n_args && *argument < b->n_args; (*argument)++) {
		k.kind = kind_of(g, *argument);
		same = compare_values(&k, &g->args[*argument], &b->args[*argument]);
		if (same != 1)
			return same;
	}
	if (g->n_args != b->n_args)
		return 0;
	same = compare_result(names, g, b);
	if (strncmp(g->sig->name, "glDelete", 8) == 0)
		forget_deleted(names, g, b);
	return same;
}
