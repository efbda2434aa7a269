#include "tests/same/story.h"

#include <stdlib.h>

#include "base/err.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/geometry/array_read.h"
#include "replay/gl/surface/frames.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "tests/same/relations.h"

static struct story_run *run_copy(const struct story_run *run)
{
	struct story_run *copy = need(malloc(sizeof(*copy)));

	*copy = *run;
	copy->v = need(malloc((run->n + 1) * sizeof(*copy->v)));
	if (run->n)
		memcpy(copy->v, run->v, run->n * sizeof(*copy->v));
	copy->room = run->n;
	return copy;
}

/* ---- items ---- */

static void keep_values(struct arena *a, const struct trace_value **values, uint64_t n)
{
	struct trace_value *copy = need(arena_alloc(a, (n + 1) * sizeof(*copy)));

	if (n)
		memcpy(copy, *values, n * sizeof(*copy));
	*values = copy;
	for (uint64_t i = 0; i < n; i++) {
		if (copy[i].type == TRACE_BLOB || copy[i].type == TRACE_STRING) {
			uint8_t *bytes = need(arena_alloc(a, copy[i].count + 1));

			memcpy(bytes, copy[i].blob, copy[i].count);
			bytes[copy[i].count] = 0;
			copy[i].blob = bytes;
		} else if (copy[i].type == TRACE_ARRAY || copy[i].type == TRACE_STRUCT) {
			keep_values(a, &copy[i].items, copy[i].count);
		}
	}
}

static struct story_item *items_add(struct story_items *items, const struct call *c, const struct story_run *run)
{
	struct story_item *item;

	if (MEMORY_GROW(items->items, items->room, items->n + 1))
		exit(-ERR_SYSTEM);
	item = &items->items[items->n++];
	*item = (struct story_item){ .run = run ? run_copy(run) : NULL };
	if (c) {
		item->call = *c;
		keep_values(&items->arena, &item->call.args, c->n_args);
	}
	return item;
}

static void items_clear(struct story_items *items)
{
	for (size_t i = 0; i < items->n; i++)
		if (items->items[i].run) {
			free(items->items[i].run->v);
			free(items->items[i].run);
		}
	items->n = 0;
	arena_reset(&items->arena, (size_t)64 << 20);
}

static void items_free(struct story_items *items)
{
	items_clear(items);
	arena_free(&items->arena);
	free(items->items);
	free(items);
}

/* ---- draws and calls: held back, or passed to the relation ---- */

/* Called before a draw. */
static void before_draw(struct story *s)
{
	if (s->fresh && s->relation->first && !s->holds)
		s->relation->first(s);
	s->fresh = s->fresh_color = 0;
}

static void perform_run(struct story *s, const struct story_run *run)
{
	before_draw(s);
	for (unsigned a = 0; a < STORY_ATTRIBUTES; a++) /* set by Begin and End, also in earlier passes */
		if (s->pass && memcmp(s->x->st->a.current.attribute[a], run->after[a], sizeof(run->after[a])) != 0)
			put_attribute(s, a, run->after[a], 1);
	(s->relation->run ? s->relation->run : run_as_it_is)(s, run);
	say_current(s); /* even if the run itself comes later, or is dropped */
}

static void perform_call(struct story *s, const struct call *c, int foreign)
{
	if (foreign && s->relation->flags & RELATION_ALL)
		not_for(s, "it has draws with unknown vertices (programs, evaluators, pixels)");
	if (foreign)
		before_draw(s);
	if (s->relation->call)
		s->relation->call(s, c, foreign);
	else
		say_call(s, c);
	story_execute(s, c);
}

static void take_run(struct story *s, struct story_run *run)
{
	memcpy(run->after, s->x->st->a.current.attribute, sizeof(run->after));
	if (s->x->st->rasterizer_discard) { /* a frame that trim has omitted */
		say_current(s);
		return;
	}
	if (s->holds)
		items_add(&s->held, NULL, run);
	if (run->n)
		perform_run(s, run);
}

static void take_call(struct story *s, const struct call *c, int foreign)
{
	if (s->holds)
		items_add(&s->held, c, NULL)->foreign = foreign;
	perform_call(s, c, foreign);
}

/* ---- passes ---- */

static struct { float matrix[3][16]; unsigned depth[3]; uint32_t program, unit; } saved;

/* The current modelview, projection and texture matrices. */
static struct gls_matrix_stack *stack_of(struct story *s, unsigned i)
{
	struct gls_state *st = s->x->st;

	return i == 0 ? &st->modelview : i == 1 ? &st->projection : &st->texture[st->a.texturing.active];
}

static void save(struct story *s)
{
	saved.program = s->x->st->program;
	saved.unit = s->x->st->a.texturing.active;
	for (unsigned i = 0; i < 3; i++) {
		saved.depth[i] = stack_of(s, i)->depth;
		memcpy(saved.matrix[i], stack_of(s, i)->matrices[saved.depth[i]], sizeof(saved.matrix[i]));
	}
	tell(s, "glPushAttrib", "u", 0xfffffu);
}

static void restore(struct story *s)
{
	static const uint32_t modes[3] = { GL_MODELVIEW, GL_PROJECTION, GL_TEXTURE };

	tell(s, "glActiveTexture", "u", GL_TEXTURE0 + saved.unit);
	for (unsigned i = 0; i < 3; i++) {
		if (stack_of(s, i)->depth < saved.depth[i])
			not_for(s, "it pops matrices that were pushed before a clear");
		tell(s, "glMatrixMode", "u", modes[i]);
		while (stack_of(s, i)->depth > saved.depth[i])
			tell(s, "glPopMatrix", "");
		tell(s, "glLoadMatrixf", "m", saved.matrix[i]);
	}
	if (s->x->st->program != saved.program)
		tell(s, "glUseProgram", "u", saved.program);
	tell(s, "glPopAttrib", "");
}

static void hold(struct story *s)
{
	if (!(s->relation->flags & RELATION_PASSES) || s->holds)
		return;
	s->holds = s->mute = 1;
	s->pass = s->step = 0;
	s->n_passes = 1;
	save(s);
}

/* Calls that create objects are made only once. */
static int is_done_once(const struct call *c)
{
	static const char *const names[] = { "glGen", "glDelete", "glCreate",     "glRead",
		                             "glIs",  "glGet",    "glBeginQuery", "glEndQuery" };

	for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++)
		if (begins(c, names[i]))
			return 1;
	return c->ret.type != TRACE_NONE;
}

/* The first pass, number 0, has inspected everything; now the passes are written. */
static void release(struct story *s)
{
	if (!s->holds)
		return;
	s->holds = 0;
	restore(s);
	s->mute = 0;
	for (s->pass = 1; s->pass <= s->n_passes && !s->why_not; s->pass++) {
		if (s->pass < s->n_passes)
			save(s);
		for (size_t i = 0; i < s->held.n; i++) {
			const struct story_item *item = &s->held.items[i];

			if (item->run)
				perform_run(s, item->run);
			else if (s->pass == 1 || !is_done_once(&item->call))
				perform_call(s, &item->call, item->foreign);
		}
		if (s->pass < s->n_passes)
			restore(s);
	}
	s->pass = 0;
	items_clear(&s->held);
}

/* ---- Begin and End ---- */

static void add_current(struct story *s, const float position[4])
{
	struct story_vertex *v = run_add(&s->open);

	memcpy(v->position, position, sizeof(v->position));
	memcpy(v->attribute, s->x->st->a.current.attribute, sizeof(v->attribute));
	s->open_is_foreign |= !s->x->st->a.current.edge_flag;
}

static void play_inside(struct story *s, const struct call *c)
{
	const struct gls_command *k = &gls_commands[c->sig->command];
	float p[4] = { 0, 0, 0, 1 };

	items_add(&s->raw, c, NULL);
	if (begins(c, "glVertex") && !begins(c, "glVertexA")) {
		for (unsigned i = 0; i < k->suffix.n && !k->suffix.array; i++)
			p[i] = arg_f(c, i);
		if (k->suffix.array)
			arg_floats(c, 0, p, k->suffix.n);
		add_current(s, p);
	} else if (k->role == GLS_ROLE_END) {
		story_execute(s, c);
		s->is_open = 0;
		if (!s->open_is_foreign)
			take_run(s, &s->open);
		for (size_t i = 0; i < s->raw.n && s->open_is_foreign; i++)
			take_call(s, &s->raw.items[i].call, 1);
		items_clear(&s->raw);
	} else {
		s->open_is_foreign |= k->kind != GLS_KIND_VERTEX || k->role == GLS_ROLE_VERTEX_ATTRIB;
		story_execute(s, c);
	}
}

static void open_run(struct story *s, const struct call *c)
{
	s->open.mode = arg_u(c, 0);
	s->open.n = 0;
	s->open.listed = s->list_depth > 0;
	s->open_is_foreign = 0;
	s->is_open = 1;
	items_add(&s->raw, c, NULL);
	story_execute(s, c);
}

/* ---- arrays ---- */

static int read_elements(struct story *s, struct story_run *run, int64_t first, int64_t count, uint32_t type,
                         const struct trace_value *indices)
{
	struct gls_state *st = s->x->st;
	struct gls_buffer *b = gls_buffer_find(st, st->client.element_buffer);
	const size_t size = indices ? gls_type_bytes(type) : 0;
	const uint8_t *bytes = NULL;
	struct gls_sources sources;
	size_t n = 0;

	if (count <= 0 || st->client.restart || !gls_sources_open(s->x, st, &sources) || sources.has_edges ||
	    sources.present >> STORY_ATTRIBUTES)
		return 0;
	if (indices && indices->type == TRACE_BLOB) {
		bytes = indices->blob;
		n = indices->count;
	} else if (indices && b) {
		const uint64_t offset = (uint64_t)gls_value_int(indices);

		bytes = offset < b->bytes ? b->data + offset : NULL;
		n = bytes ? b->bytes - offset : 0;
	}
	if (indices && (!bytes || n / size < (uint64_t)count))
		return 0;
	for (int64_t i = 0; i < count; i++) {
		uint32_t element = (uint32_t)(first + i);
		struct story_vertex *v;

		if (size) {
			element = 0;
			memcpy(&element, bytes + (size_t)i * size, size);
		}
		if (element >= gls_sources_count(&sources))
			return 0;
		v = run_add(run);
		memcpy(v->attribute, st->a.current.attribute, sizeof(v->attribute));
		gls_source_read(&sources.vertex, element, v->position);
		for (unsigned a = 0; a < STORY_ATTRIBUTES; a++)
			if (sources.present >> a & 1)
				gls_source_read(&sources.attributes[a], element, v->attribute[a]);
	}
	run->given = sources.present;
	run->listed |= indices != NULL;
	return 1;
}

/* An array draw or a rectangle as a run. @return 1; 0: it is neither, or cannot be read */
static int read_draw(struct story *s, const struct call *c, struct story_run *run)
{
	run->n = run->given = 0;
	run->listed = s->list_depth > 0 || s->list;
	run->mode = arg_u(c, 0);
	if (is(c, "glDrawArrays") || is(c, "glDrawArraysEXT"))
		return read_elements(s, run, arg_i(c, 1), arg_i(c, 2), 0, NULL);
	if (is(c, "glDrawElements"))
		return read_elements(s, run, 0, arg_i(c, 1), arg_u(c, 2), arg(c, 3));
	if (is(c, "glDrawRangeElements"))
		return read_elements(s, run, 0, arg_i(c, 3), arg_u(c, 4), arg(c, 5));
	if (!begins(c, "glRect") || gls_commands[c->sig->command].suffix.array)
		return 0;
	run->mode = GL_QUADS;
	for (unsigned i = 0; i < 4; i++) {
		struct story_vertex *v = run_add(run);

		memcpy(v->attribute, s->x->st->a.current.attribute, sizeof(v->attribute));
		memcpy(v->position, (float[]){ arg_f(c, i == 1 || i == 2 ? 2 : 0), arg_f(c, i > 1 ? 3 : 1), 0, 1 },
		       sizeof(v->position));
	}
	return 1;
}

/* ---- display lists ---- */

static void play(struct story *s, const struct call *c);

static void play_list(struct story *s, uint32_t name)
{
	const struct story_items *list = table_find(&s->lists, name);

	if (!list || s->list_depth == 64)
		return;
	s->list_depth++;
	for (size_t i = 0; i < list->n && !s->why_not; i++) {
		struct story_run *run = list->items[i].run;

		if (!run) {
			play(s, &list->items[i].call);
			continue;
		}
		for (uint32_t k = 0; k < run->n; k++)
			for (unsigned a = 0; a < STORY_ATTRIBUTES; a++)
				if (!(run->given >> a & 1))
					memcpy(run->v[k].attribute[a], s->x->st->a.current.attribute[a], 16);
		take_run(s, run);
	}
	s->list_depth--;
}

static void play_lists(struct story *s, const struct call *c)
{
	static const uint8_t sizes[] = { 1, 1, 2, 2, 4, 4 };
	const uint32_t type = arg_u(c, 1) - GL_BYTE;
	size_t n;
	const uint8_t *bytes = arg_blob(c, 2, &n);

	if (type >= sizeof(sizes) || !bytes)
		not_for(s, "display lists are called by names of an unsupported type");
	for (int64_t i = 0; !s->why_not && i < arg_i(c, 0) && (size_t)(i + 1) * sizes[type] <= n; i++) {
		uint32_t name = 0;

		memcpy(&name, bytes + (size_t)i * sizes[type], sizes[type]);
		play_list(s, s->x->st->a.list_base + name);
	}
}

/* A call while a list is compiled. It is not written: each call of the list writes its contents. */
static void keep_in_list(struct story *s, const struct call *c)
{
	const struct gls_command *k = &gls_commands[c->sig->command];
	struct story_items *old;
	struct story_run run = { 0 };

	if (is(c, "glEndList")) {
		old = table_remove(&s->lists, s->list_name);
		if (old)
			items_free(old);
		if (table_set(&s->lists, s->list_name, s->list))
			exit(-ERR_SYSTEM);
		s->list = NULL;
		if (s->list_runs)
			play_list(s, s->list_name);
		return;
	}
	if (begins(c, "glBitmap") || begins(c, "glDrawPixels") || begins(c, "glTexImage") || begins(c, "glTexSubImage"))
		not_for(s, "display lists contain pixels");
	if (k->kind == GLS_KIND_ARRAY && read_draw(s, c, &run))
		items_add(s->list, NULL, &run);
	else if (k->kind == GLS_KIND_ARRAY)
		not_for(s, "display lists contain unsupported draws");
	else if (k->kind == GLS_KIND_VERTEX || k->kind == GLS_KIND_INSIDE || k->kind == GLS_KIND_STATE ||
	         k->kind == GLS_KIND_MATRIX)
		items_add(s->list, c, NULL);
	else
		take_call(s, c, 0);
	free(run.v);
}

/* ---- the recording ---- */

static int draws(const struct call *c)
{
	const struct gls_command *k = &gls_commands[c->sig->command];

	return k->kind == GLS_KIND_ARRAY ||
	       (k->drawing == GLS_DRAWS && !is(c, "glClear") && !begins(c, "glRead") && !begins(c, "glAccum")) ||
	       k->role == GLS_ROLE_CALL_LIST || k->role == GLS_ROLE_BEGIN || begins(c, "glBitmap") ||
	       begins(c, "glCallList");
}

static void clear(struct story *s, const struct call *c)
{
	const struct gls_attribs *a = &s->x->st->a;
	const uint32_t mask = arg_u(c, 0);

	release(s);
	take_call(s, c, 0);
	if (a->scissor.enabled && mask & GL_COLOR_BUFFER_BIT)
		s->fresh_color = 0;
	if (a->scissor.enabled)
		return;
	s->fresh |= (mask & GL_DEPTH_BUFFER_BIT) && a->depth.write;
	s->fresh_color |= (mask & GL_COLOR_BUFFER_BIT) && (a->color.mask & 7) == 7;
	if (s->fresh && s->fresh_color && s->relation->cleared)
		s->relation->cleared(s);
	if (s->fresh)
		hold(s);
}

/* A call that is executed now. */
static void play(struct story *s, const struct call *c)
{
	const int32_t command = c->sig->command;
	const int runs = s->relation->flags & RELATION_RUNS && s->x->st && command >= 0;
	struct story_run run = { 0 };

	if (command >= 0 && gls_commands[command].drawing == GLS_ENDS) {
		release(s);
		if (s->relation->frame && s->x->st)
			s->relation->frame(s);
	}
	if (s->list && command >= 0)
		keep_in_list(s, c);
	else if (runs && is(c, "glNewList")) {
		s->list = need(calloc(1, sizeof(*s->list)));
		s->list_name = arg_u(c, 0);
		s->list_runs = arg_u(c, 1) == GL_COMPILE_AND_EXECUTE;
	} else if (runs && !s->is_open && gls_commands[command].role == GLS_ROLE_BEGIN)
		open_run(s, c);
	else if (runs && is(c, "glCallList"))
		play_list(s, arg_u(c, 0));
	else if (runs && is(c, "glCallLists"))
		play_lists(s, c);
	else if (s->is_open && command >= 0)
		play_inside(s, c);
	else if (runs && draws(c) && read_draw(s, c, &run)) {
		take_run(s, &run);
		free(run.v);
	} else if (command >= 0 && s->x->st && is(c, "glClear"))
		clear(s, c);
	else {
		if (begins(c, "glBindFramebuffer") || begins(c, "glXMake") || begins(c, "eglMake"))
			release(s);
		take_call(s, c, command >= 0 && s->x->st && draws(c));
	}
}

int story_tell(struct story *s, const char *from, const char *to)
{
	const struct call *c;
	int rc = trace_reader_open(&s->reader, from, gls_command_find);

	rc = rc ? rc : gls_exec_create(&s->x, from);
	rc = rc ? rc : trace_out_open(&s->out, to, from, s->reader);
	while (!rc && !s->why_not && (rc = trace_reader_next(s->reader, &c)) == 1) {
		rc = 0;
		if (c->thread != s->thread && s->x->st)
			not_for(s, "several threads draw");
		s->thread = c->thread;
		play(s, c);
		if (s->x->frame_ended) {
			s->x->frame_ended = 0;
			gls_frame_skip(s->x);
			s->x->frame++;
			s->fresh = s->fresh_color = 0;
		}
	}
	if (!rc && !s->why_not && !s->n_changes)
		s->why_not = s->relation->idle;
	if (!rc && !s->why_not)
		return trace_out_finish(&s->out, NULL);
	trace_out_drop(&s->out);
	return rc ? rc : 1;
}
