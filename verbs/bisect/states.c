#include "verbs/bisect/states.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "replay/index/members.h"

enum { MOST_PATH = 256, MOST_SHOWN = 16 /* elements of an array */ };

/* Members that hold objects' names, or are not part of the state. */
static const struct {
	const char *owner, *name;
	enum names_kind kind;
	int is_passed;
} special[] = {
	{ "gls_unit", "bound", NAMES_TEXTURE, 0 }, { "gls_unit", "sampler", NAMES_SAMPLER, 0 },
	{ "gls_attribs", "list_base", NAMES_LIST_BASE, 0 }, { "gls_array", "buffer", NAMES_BUFFER, 0 },
	{ "gls_pixel_store", "buffer", NAMES_BUFFER, 0 }, { "gls_client_attribs", "array_buffer", NAMES_BUFFER, 0 },
	{ "gls_client_attribs", "element_buffer", NAMES_BUFFER, 0 },
	{ "gls_client_attribs", "vertex_array", NAMES_VERTEX_ARRAY, 0 }, { "gls_state", "program", NAMES_PROGRAM, 0 },
	{ "gls_state", "arb_vertex", NAMES_PROGRAM, 0 }, { "gls_state", "arb_fragment", NAMES_PROGRAM, 0 },
	{ "gls_state", "draw_framebuffer", NAMES_FRAMEBUFFER, 0 }, { "gls_state", "read_framebuffer", NAMES_FRAMEBUFFER, 0 },
	{ "gls_state", "renderbuffer", NAMES_RENDERBUFFER, 0 }, { "gls_state", "list_name", NAMES_LIST, 0 },
	{ "gls_state", "drawable", NAMES_WINDOW, 0 }, { "gls_state", "read_drawable", NAMES_WINDOW, 0 },
	{ "gls_state", "dirty", NAMES_NONE, 1 }, { "gls_state", "vertex_arrays", NAMES_NONE, 1 },
	{ "gls_array", "offset", NAMES_NONE, 1 }, { "gls_array", "version", NAMES_NONE, 1 },
	{ "gls_array", "client_bytes", NAMES_NONE, 1 }, { "gls_array", "client_room", NAMES_NONE, 1 },
};

struct comparison {
	const struct member *members;
	size_t n;
	const struct names *names;
	struct table *known;
	FILE *out;
	int err;
	char path[MOST_PATH];
};

static void print_element(FILE *out, const struct member *m, const uint8_t *at)
{
	uint64_t word = 0;
	float f;
	double d;

	if (strcmp(m->type, "float") == 0) {
		memcpy(&f, at, sizeof(f));
		fprintf(out, "%g", (double)f);
	} else if (strcmp(m->type, "double") == 0) {
		memcpy(&d, at, sizeof(d));
		fprintf(out, "%g", d);
	} else {
		memcpy(&word, at, m->each < sizeof(word) ? m->each : sizeof(word));
		if (strncmp(m->type, "int", 3) == 0)
			fprintf(out, "%" PRId32, (int32_t)word);
		else
			fprintf(out, word > 255 ? "0x%04" PRIx64 : "%" PRIu64, word);
	}
}

static void print_member(FILE *out, const struct member *m, const uint8_t *at)
{
	const size_t n = m->bytes / m->each;

	if (n > 1)
		fputc('{', out);
	for (size_t i = 0; i < n && i < MOST_SHOWN; i++) {
		fputs(i ? ", " : "", out);
		print_element(out, m, at + i * m->each);
	}
	fputs(n > MOST_SHOWN ? ", ...}" : n > 1 ? "}" : "", out);
}

/* Report that a member differs, once. */
static void tell(struct comparison *c, const struct member *m, const uint8_t *good, const uint8_t *bad)
{
	const uint64_t hash = XXH3_64bits(c->path, strlen(c->path));

	if (table_find(c->known, hash))
		return;
	if (table_set(c->known, hash, c->known))
		c->err = ERR_SYSTEM;
	fprintf(c->out, "%s: ", c->path);
	print_member(c->out, m, good);
	fputs(", ", c->out);
	print_member(c->out, m, bad);
	fputc('\n', c->out);
}

/* Do names of objects differ? */
static int names_differ(const struct comparison *c, enum names_kind kind, const struct member *m, const uint8_t *good,
                        const uint8_t *bad)
{
	for (size_t i = 0; i < m->bytes; i += m->each) {
		uint64_t g = 0, b = 0, to;

		memcpy(&g, good + i, m->each);
		memcpy(&b, bad + i, m->each);
		to = (uint64_t)(uintptr_t)table_find(&c->names->to[kind], g);
		if (to ? to != b + 1 : g != b)
			return 1;
	}
	return 0;
}

static void compare_struct(struct comparison *c, const char *owner, const uint8_t *good, const uint8_t *bad);

static void compare_member(struct comparison *c, const struct member *m, const uint8_t *good, const uint8_t *bad)
{
	if (strncmp(m->type, "struct ", 7) == 0) {
		const size_t length = strlen(c->path);

		for (size_t i = 0; i < m->bytes / m->each; i++) {
			if (m->bytes > m->each)
				snprintf(c->path + length, MOST_PATH - length, "[%zu]", i);
			compare_struct(c, m->type + 7, good + i * m->each, bad + i * m->each);
		}
		c->path[length] = '\0';
		return;
	}
	if (memcmp(good, bad, m->bytes) == 0)
		return;
	for (size_t i = 0; i < sizeof(special) / sizeof(special[0]); i++)
		if (strcmp(special[i].owner, m->owner) == 0 && strcmp(special[i].name, m->name) == 0 &&
		    (special[i].is_passed || !names_differ(c, special[i].kind, m, good, bad)))
			return;
	tell(c, m, good, bad);
}

/* Compare a stack's depth and current entry; entries above it are meaningless. */
static void compare_stack(struct comparison *c, const struct gls_matrix_stack *good, const struct gls_matrix_stack *bad)
{
	static const struct member current = { "", "", "float", 0, 16 * sizeof(float), sizeof(float) },
				   depth = { "", "", "unsigned", 0, sizeof(unsigned), sizeof(unsigned) };
	const size_t length = strlen(c->path);

	if (memcmp(good->matrices[good->depth], bad->matrices[bad->depth], current.bytes) != 0)
		tell(c, &current, (const uint8_t *)good->matrices[good->depth], (const uint8_t *)bad->matrices[bad->depth]);
	snprintf(c->path + length, MOST_PATH - length, ".depth");
	if (good->depth != bad->depth)
		tell(c, &depth, (const uint8_t *)&good->depth, (const uint8_t *)&bad->depth);
	c->path[length] = '\0';
}

static void compare_struct(struct comparison *c, const char *owner, const uint8_t *good, const uint8_t *bad)
{
	const size_t length = strlen(c->path);

	if (strcmp(owner, "gls_matrix_stack") == 0) {
		compare_stack(c, (const struct gls_matrix_stack *)good, (const struct gls_matrix_stack *)bad);
		return;
	}
	for (size_t i = 0; i < c->n; i++) {
		const struct member *m = &c->members[i];

		if (strcmp(m->owner, owner) != 0 || strcmp(m->type, "void *") == 0)
			continue;
		/* gls_state.a is what PushAttrib saves: its groups have names of their own */
		snprintf(c->path + length, MOST_PATH - length, "%s%s", length ? "." : "",
		         strcmp(m->type, "struct gls_attribs") == 0 ? "" : m->name);
		compare_member(c, m, good + m->offset, bad + m->offset);
		c->path[length] = '\0';
	}
}

int states_compare(const struct gls_state *good, const struct gls_state *bad, const struct names *names,
                   struct table *known, char **text)
{
	struct comparison c = { .names = names, .known = known };
	size_t size = 0;

	*text = NULL;
	if (!good || !bad)
		return 0;
	c.members = members_all(&c.n);
	c.out = open_memstream(text, &size);
	if (c.out)
		compare_struct(&c, "gls_state", (const uint8_t *)good, (const uint8_t *)bad);
	if (!c.out || fclose(c.out) || c.err)
		return c.err ? c.err : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!size) {
		free(*text);
		*text = NULL;
	}
	return 0;
}
