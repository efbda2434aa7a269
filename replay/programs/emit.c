#include "replay/programs/emit.h"

#include <stddef.h>

struct emit_source emit_splat(const struct emit_source *from, uint32_t component)
{
	const uint32_t number = from->number[component];

	return (struct emit_source){ { number, number, number, number }, from->negated >> component & 1 ? 15 : 0 };
}

struct emit_source emit_four(uint32_t first)
{
	return (struct emit_source){ { first, first + 1, first + 2, first + 3 }, 0 };
}

static void append(struct emitter *e, const struct scene_instruction *in)
{
	if (!e->err)
		e->err = program_append(e->code, in);
}

/*
 * The stride of a source's components from `first` on: 1 consecutive, 0 all the same, -1 neither. count: number of
 * components
 */
static int step_of(const struct emit_source *s, uint32_t first, uint32_t count)
{
	int row = 1, same = 1;

	for (uint32_t i = 1; i < count; i++) {
		row &= s->number[first + i] == s->number[first] + i;
		same &= s->number[first + i] == s->number[first];
		if ((s->negated >> (first + i) & 1) != (s->negated >> first & 1))
			return -1;
	}
	return same ? 0 : row ? 1 : -1;
}

/* The largest number of components from `first` on that one instruction can process. */
static uint32_t run_of(const struct emit_target *to, const struct emit_source *const sources[3], uint32_t first)
{
	uint32_t n = 1;

	for (; first + n < 4 && to->mask >> (first + n) & 1; n++)
		for (unsigned k = 0; k < 3; k++)
			if (sources[k] && step_of(sources[k], first, n + 1) < 0)
				return n;
	return n;
}

/* 1 if a component is written before another one is computed from it. */
static int overlaps(const struct emit_target *to, const struct emit_source *const sources[3])
{
	for (unsigned k = 0; k < 3; k++)
		for (uint32_t i = 0; sources[k] && i < 4; i++)
			for (uint32_t before = 0; to->mask >> i & 1 && before < i; before++)
				if (to->mask >> before & 1 && sources[k]->number[i] == to->first + before)
					return 1;
	return 0;
}

static void emit_runs(struct emitter *e, enum scene_operation operation, const struct emit_target *to,
                      const struct emit_source *const sources[3])
{
	for (uint32_t i = 0, n; i < 4; i += n) {
		struct scene_instruction in = { .operation = operation,
			                        .to = to->first + i,
			                        .flags = to->saturates ? SCENE_SATURATE : 0 };
		uint32_t *operands[3] = { &in.a, &in.b, &in.c };

		n = 1;
		if (!(to->mask >> i & 1))
			continue;
		in.n = n = run_of(to, sources, i);
		for (unsigned k = 0; k < 3 && sources[k]; k++) {
			*operands[k] = sources[k]->number[i];
			in.flags |= step_of(sources[k], i, n) == 1 ? SCENE_STEP_A << k : 0;
			in.flags |= sources[k]->negated >> i & 1 ? SCENE_NEGATE_A << k : 0;
		}
		append(e, &in);
	}
}

void emit_vector(struct emitter *e, enum scene_operation operation, const struct emit_target *to,
                 const struct emit_source *a, const struct emit_source *b, const struct emit_source *c)
{
	const struct emit_source *const sources[3] = { a, b, c };
	const struct emit_target aside = { e->scratch, to->mask, to->saturates }, plain = { to->first, to->mask, 0 };
	const struct emit_source result = emit_four(e->scratch);

	if (!overlaps(to, sources)) {
		emit_runs(e, operation, to, sources);
		return;
	}
	emit_runs(e, operation, &aside, sources);
	emit_vector(e, SCENE_OP_MOVE, &plain, &result, NULL, NULL);
}

void emit_scalar(struct emitter *e, enum scene_operation operation, const struct emit_target *to,
                 const struct emit_source *a, const struct emit_source *b)
{
	const struct emit_target one = { e->scratch, 1, 0 };
	const struct emit_source four = emit_four(e->scratch), result = emit_splat(&four, 0);

	emit_vector(e, operation, &one, a, b, NULL);
	emit_vector(e, SCENE_OP_MOVE, to, &result, NULL, NULL);
}

void emit_dot(struct emitter *e, const struct emit_target *to, const struct emit_source *a, const struct emit_source *b,
              uint32_t n, int homogeneous)
{
	const struct emit_target sum = { e->scratch, 1, 0 };
	const struct emit_source four = emit_four(e->scratch), result = emit_splat(&four, 0), last = emit_splat(b, 3);

	for (uint32_t i = n; i-- > 0;) { /* Mesa (22.3.6) sums from the last component to the first */
		const struct emit_source x = emit_splat(a, i), y = emit_splat(b, i);

		emit_vector(e, i + 1 < n ? SCENE_OP_MAD : SCENE_OP_MULTIPLY, &sum, &x, &y, i + 1 < n ? &result : NULL);
	}
	if (homogeneous)
		emit_vector(e, SCENE_OP_ADD, &sum, &result, &last, NULL);
	emit_vector(e, SCENE_OP_MOVE, to, &result, NULL, NULL);
}

void emit_texture(struct emitter *e, const struct emit_target *to, const struct emit_source *coordinates, uint32_t unit,
                  uint32_t flags)
{
	const struct emit_target place = { e->scratch, 15, 0 };
	const struct emit_source sample = emit_four(e->scratch + 4);
	const struct scene_instruction in = {
		.operation = SCENE_OP_TEXTURE, .n = 1, .to = e->scratch + 4, .a = e->scratch, .b = unit, .c = flags
	};

	emit_vector(e, SCENE_OP_MOVE, &place, coordinates, NULL, NULL);
	append(e, &in);
	emit_vector(e, SCENE_OP_MOVE, to, &sample, NULL, NULL);
}

void emit_fetch(struct emitter *e, uint32_t to, uint32_t array, uint32_t elements, uint32_t address, uint32_t offset)
{
	const struct scene_instruction place = {
		.operation = SCENE_OP_ADD, .n = 1, .to = e->scratch, .a = address, .b = offset
	};
	const struct scene_instruction in = { .operation = SCENE_OP_FETCH,
		                              .n = 4,
		                              .to = to,
		                              .a = array,
		                              .b = e->scratch,
		                              .c = SCENE_ARRAY(elements, 4u) };

	append(e, &place);
	append(e, &in);
}

void emit_kill(struct emitter *e, const struct emit_source *a)
{
	const struct emit_target all = { 0, 15, 0 };
	const struct emit_source *const sources[3] = { a, NULL, NULL };

	e->code->kills = 1;
	emit_runs(e, SCENE_OP_KILL, &all, sources);
}
