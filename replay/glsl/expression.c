#include "replay/glsl/expression.h"

#include <string.h>

#include "replay/glsl/function.h"
#include "replay/glsl/links.h"
#include "replay/glsl/operators.h"
#include "replay/glsl/state.h"

#define MAX_DEPTH 600 /* nesting of expressions and statements, including those of called functions */

static const struct glsl_node *node_of(const struct glsl_writer *w, uint32_t node)
{
	return &w->tree->nodes[node];
}

static uint32_t child(const struct glsl_writer *w, const struct glsl_node *n, uint32_t i)
{
	return i < n->count ? w->tree->children[n->first + i] : GLSL_NONE;
}

bool glsl_has_effects(const struct glsl_writer *w, uint32_t node)
{
	const struct glsl_node *n;

	if (node == GLSL_NONE)
		return false;
	n = node_of(w, node);
	if (n->operation == GLSL_ASSIGN || n->operation == GLSL_CALL || n->operation == GLSL_POST_INCREMENT ||
	    n->operation == GLSL_POST_DECREMENT || n->operation == GLSL_PRE_INCREMENT ||
	    n->operation == GLSL_PRE_DECREMENT)
		return true;
	for (uint32_t i = 0; i < n->count; i++)
		if (glsl_has_effects(w, child(w, n, i)))
			return true;
	return false;
}

/* A copy of a value in registers that no assignment changes. */
static struct glsl_value kept(struct glsl_writer *w, const struct glsl_value *v)
{
	struct glsl_value copy = glsl_fresh(w, v->type);

	if (copy.at)
		glsl_write(w, SCENE_OP_MOVE, 0, copy.at[0], v->n, v->at, NULL, NULL);
	return copy;
}

/* --- Variables --------------------------------------------------------------------------------------------------- */

static struct glsl_value of_numbers(struct glsl_writer *w, uint32_t type, uint32_t first)
{
	const uint32_t n = glsl_type_of(w, type)->numbers;
	struct glsl_value v = glsl_value_of(w, type, n);

	if (first + n > w->tree->n_numbers)
		glsl_fail(w, "a shader's constants are incomplete");
	else if (v.at)
		glsl_numbers(w, w->tree->numbers + first, n, v.at);
	return v;
}

struct glsl_value glsl_variable(struct glsl_writer *w, uint32_t symbol)
{
	const struct glsl_symbol *s = &w->tree->symbols[symbol];
	const char *name = w->tree->names + s->name;
	struct glsl_value *v = &w->variables[symbol];
	uint32_t first;

	if (v->at || glsl_stopped(w))
		return *v;
	if (strncmp(name, "gl_", 3) == 0) {
		*v = s->storage == GLSL_CONSTANT_VALUE && s->first != GLSL_NONE ? of_numbers(w, s->type, s->first) :
		                                                                  glsl_builtin(w, s);
	} else if (s->storage == GLSL_CONSTANT_VALUE && s->first != GLSL_NONE) {
		*v = of_numbers(w, s->type, s->first);
	} else if (s->storage == GLSL_UNIFORM) {
		first = glsl_uniforms_find(w->uniforms, name);
		if (first != GLSL_NONE)
			*v = glsl_row(w, s->type, SCENE_PROGRAM_CONSTANT + first);
	} else if (s->storage == GLSL_INPUT || s->storage == GLSL_OUTPUT) {
		*v = glsl_linked(w, s);
	} else {
		*v = glsl_fresh(w, s->type);
	}
	if (!v->at)
		glsl_fail_at(w, "a shader has the variable ", name, ", which is not supported");
	return *v;
}

/* --- Assignable places ------------------------------------------------------------------------------------------ */

static struct glsl_value slice(struct glsl_writer *w, const struct glsl_value *v, uint32_t type, uint32_t first)
{
	const uint32_t n = glsl_type_of(w, type)->numbers;

	if (first > v->n || n > v->n - first) {
		glsl_fail(w, "a shader reads beyond an array");
		return *v;
	}
	return (struct glsl_value){ type, n, v->at + first };
}

/* Number of floats per element of an indexed type. */
static uint32_t stride_of(const struct glsl_writer *w, uint32_t type)
{
	const struct glsl_type *t = glsl_type_of(w, type);

	return t->kind == GLSL_ARRAY ? glsl_type_of(w, t->first)->numbers : t->columns ? t->rows : 1;
}

/* 1 if the elements of a value, every `stride` numbers, have operands at the same distance from one to the next. */
static int is_even(const struct glsl_value *v, uint32_t stride, uint32_t n)
{
	const uint32_t count = v->n / stride, step = count > 1 ? v->at[stride] - v->at[0] : 0;
	int even = step <= 4096;

	for (uint32_t i = 0; i < count; i++)
		for (uint32_t k = 0; k < n; k++)
			even &= v->at[i * stride + k] == v->at[k] + i * step;
	return even;
}

/* Copy a value into registers in a row. One that can be assigned, as it contains no constant, must stay where it is. */
static void align(struct glsl_writer *w, struct glsl_place *p)
{
	const struct glsl_value row = glsl_fresh(w, p->value.type);
	int is_fixed = 0;

	for (uint32_t i = 0; i < p->value.n; i++)
		is_fixed |= p->value.at[i] >= SCENE_PROGRAM_CONSTANT;
	if (!is_fixed || p->offset != GLSL_NONE)
		glsl_fail(w, "a shader indexes a value whose elements are not evenly spaced");
	if (glsl_stopped(w))
		return;
	glsl_copy(w, row.at, p->value.at, row.n);
	p->value = row;
}

/* Index an element at run time. */
static void choose_element(struct glsl_writer *w, struct glsl_place *p, uint32_t type, uint32_t index)
{
	const uint32_t stride = stride_of(w, p->value.type), n = glsl_type_of(w, type)->numbers;
	const uint32_t count = stride ? p->value.n / stride : 0;
	uint32_t step, offset;
	struct glsl_value first;

	if (glsl_stopped(w) || !count)
		return;
	if (!is_even(&p->value, stride, n))
		align(w, p);
	first = slice(w, &p->value, type, 0);
	if (glsl_stopped(w))
		return;
	step = count > 1 ? p->value.at[stride] - p->value.at[0] : 0;
	offset = glsl_one(w, SCENE_OP_MULTIPLY, index, glsl_number(w, (float)step), 0);
	if (p->offset != GLSL_NONE)
		offset = glsl_one(w, SCENE_OP_ADD, offset, p->offset, 0);
	p->limit = (p->offset == GLSL_NONE ? 1 : p->limit) + (count - 1) * step;
	p->offset = offset;
	p->value = first;
	if (p->limit > 0xffff)
		glsl_fail(w, "a shader has an array that is too large");
}

static struct glsl_place index_of(struct glsl_writer *w, const struct glsl_node *n)
{
	struct glsl_place p = glsl_place_of(w, child(w, n, 0));
	const struct glsl_node *at = node_of(w, child(w, n, 1));
	struct glsl_value index;

	if (at->operation == GLSL_NUMBERS && !glsl_stopped(w)) {
		const float number = w->tree->numbers[at->value];
		const uint32_t stride = stride_of(w, p.value.type), count = stride ? p.value.n / stride : 0;

		if (!(number >= 0 && number < (float)count))
			glsl_fail(w, "a shader reads beyond an array");
		else
			p.value = slice(w, &p.value, n->type, (uint32_t)number * stride);
		return p;
	}
	index = glsl_expression(w, child(w, n, 1));
	if (!glsl_stopped(w) && glsl_type_of(w, n->type)->kind == GLSL_SAMPLER)
		glsl_fail(w, "a shader indexes samplers dynamically");
	if (!glsl_stopped(w))
		choose_element(w, &p, n->type, index.at[0]);
	return p;
}

struct glsl_place glsl_place_of(struct glsl_writer *w, uint32_t node)
{
	const struct glsl_node *n = node_of(w, node);
	struct glsl_place p = { .offset = GLSL_NONE };
	struct glsl_value all;

	switch (n->operation) {
	case GLSL_INDEX: return index_of(w, n);
	case GLSL_MEMBER: {
		const struct glsl_type *t;
		uint32_t first = 0;

		p = glsl_place_of(w, child(w, n, 0));
		t = glsl_type_of(w, p.value.type);
		for (uint32_t i = 0; i < n->value && i < t->length && t->kind == GLSL_STRUCT; i++)
			first += glsl_type_of(w, w->tree->members[t->first + i].type)->numbers;
		if (!glsl_stopped(w))
			p.value = slice(w, &p.value, n->type, first);
		return p;
	}
	case GLSL_SWIZZLE:
		p = glsl_place_of(w, child(w, n, 0));
		all = p.value;
		p.value = glsl_value_of(w, n->type, glsl_type_of(w, n->type)->numbers);
		for (uint32_t i = 0; p.value.at && !glsl_stopped(w) && i < p.value.n; i++) {
			const uint32_t from = n->value >> 3 * i & 7;

			p.value.at[i] = all.at[from < all.n ? from : 0];
		}
		return p;
	case GLSL_SYMBOL:
		p.value = glsl_variable(w, n->value);
		return p;
	default:
		p.value = glsl_expression(w, node);
		return p;
	}
}

/* A place with a run-time index is accessed one row at a time. @return number of consecutive numbers from `first` on */
static uint32_t row_of(const struct glsl_value *v, uint32_t first)
{
	uint32_t n = 1;

	while (first + n < v->n && v->at[first + n] == v->at[first] + n)
		n++;
	return n;
}

struct glsl_value glsl_load(struct glsl_writer *w, const struct glsl_place *p)
{
	struct glsl_value v;

	if (p->offset == GLSL_NONE || glsl_stopped(w))
		return p->value;
	v = glsl_fresh(w, p->value.type);
	for (uint32_t i = 0, n; i < p->value.n && !glsl_stopped(w); i += n) {
		n = row_of(&p->value, i);
		glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_FETCH,
		                                            .n = n,
		                                            .to = v.at[i],
		                                            .a = p->value.at[i],
		                                            .b = p->offset,
		                                            .c = SCENE_ARRAY(p->limit, 1) });
	}
	return v;
}

void glsl_store(struct glsl_writer *w, const struct glsl_place *p, const struct glsl_value *v)
{
	if (glsl_stopped(w))
		return;
	if (p->value.n != v->n || p->value.at[0] >= SCENE_PROGRAM_CONSTANT) {
		glsl_fail(w, "a shader assigns to something that is not a variable");
		return;
	}
	if (p->offset == GLSL_NONE) {
		glsl_copy(w, p->value.at, v->at, v->n);
		w->barrier = w->code->n_instructions; /* later code may read the variable, so its last write must not be redirected */
		return;
	}
	for (uint32_t i = 0; i < v->n; i++)
		glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_STORE,
		                                            .n = 1,
		                                            .to = p->value.at[i],
		                                            .a = v->at[i],
		                                            .b = p->offset,
		                                            .c = SCENE_ARRAY(p->limit, 1) });
}

/* --- Conversions and constructors -------------------------------------------------------------------------------- */

/* Convert numbers of one kind to another. */
static struct glsl_value converted(struct glsl_writer *w, const struct glsl_value *v, uint32_t kind)
{
	const struct glsl_type *from = glsl_type_of(w, v->type);
	struct glsl_value to;
	uint32_t zero;

	if (glsl_stopped(w) || kind == from->kind || from->kind > GLSL_BOOL || kind > GLSL_BOOL || (kind == GLSL_FLOAT) ||
	    (kind != GLSL_BOOL && from->kind != GLSL_FLOAT))
		return *v;
	to = glsl_fresh(w, v->type);
	if (glsl_stopped(w))
		return *v;
	zero = glsl_number(w, 0);
	for (uint32_t i = 0; kind == GLSL_BOOL && i < v->n; i++)
		glsl_write(w, SCENE_OP_NOT_EQUAL, 0, to.at[i], 1, &v->at[i], &zero, NULL);
	if (kind != GLSL_BOOL)
		glsl_write(w, SCENE_OP_TRUNCATE, 0, to.at[0], v->n, v->at, NULL, NULL);
	return to;
}

static struct glsl_value construct_matrix(struct glsl_writer *w, uint32_t type, const struct glsl_value *from)
{
	const struct glsl_type *t = glsl_type_of(w, type), *f = glsl_type_of(w, from->type);
	struct glsl_value v = glsl_value_of(w, type, t->numbers);
	const uint32_t zero = glsl_number(w, 0), one = glsl_number(w, 1);

	for (uint32_t c = 0; c < t->columns && v.at && !glsl_stopped(w); c++)
		for (uint32_t r = 0; r < t->rows; r++) {
			const uint32_t plain = c != r ? zero : f->columns ? one : from->at[0];

			v.at[c * t->rows + r] = f->columns && c < f->columns && r < f->rows ? from->at[c * f->rows + r] : plain;
		}
	return v;
}

static struct glsl_value construct(struct glsl_writer *w, uint32_t type, struct glsl_value *a, uint32_t n)
{
	const struct glsl_type *t = glsl_type_of(w, type);
	struct glsl_value v;
	uint32_t at = 0;

	for (uint32_t i = 0; i < n; i++)
		a[i] = converted(w, &a[i], t->kind);
	if (n == 1 && t->columns && (a[0].n == 1 || glsl_type_of(w, a[0].type)->columns))
		return construct_matrix(w, type, &a[0]);
	v = glsl_value_of(w, type, t->numbers);
	if (!v.at || glsl_stopped(w))
		return v;
	if (n == 1 && a[0].n == 1) {
		for (; at < v.n; at++)
			v.at[at] = a[0].at[0];
		return v;
	}
	for (uint32_t i = 0; i < n; i++)
		for (uint32_t k = 0; k < a[i].n && at < v.n; k++)
			v.at[at++] = a[i].at[k];
	if (at < v.n)
		glsl_fail(w, "a shader has a constructor with too few values");
	return v;
}

/* --- Nodes ------------------------------------------------------------------------------------------------------- */

static struct glsl_value assign(struct glsl_writer *w, const struct glsl_node *n)
{
	struct glsl_place to = glsl_place_of(w, child(w, n, 0));
	struct glsl_value v = glsl_expression(w, child(w, n, 1)), before;

	if (glsl_stopped(w))
		return v;
	if (n->value != GLSL_ASSIGN) {
		before = glsl_load(w, &to);
		v = glsl_binary(w, n->value, to.value.type, &before, &v);
	}
	glsl_store(w, &to, &v);
	return glsl_load(w, &to);
}

static struct glsl_value increment(struct glsl_writer *w, const struct glsl_node *n)
{
	const bool down = n->operation == GLSL_POST_DECREMENT || n->operation == GLSL_PRE_DECREMENT;
	const bool after = n->operation == GLSL_POST_DECREMENT || n->operation == GLSL_POST_INCREMENT;
	struct glsl_place place = glsl_place_of(w, child(w, n, 0));
	struct glsl_value before = glsl_load(w, &place), old = before, one, v;
	uint32_t number;

	if (glsl_stopped(w))
		return before;
	if (after)
		old = kept(w, &before);
	number = glsl_number(w, down ? -1 : 1);
	one = (struct glsl_value){ before.type, 1, &number };
	v = glsl_by_component(w, SCENE_OP_ADD, 0, before.type, &before, &one);
	glsl_store(w, &place, &v);
	return after ? old : glsl_load(w, &place);
}

static struct glsl_value choice(struct glsl_writer *w, const struct glsl_node *n)
{
	struct glsl_value a[3], v;

	if (glsl_has_effects(w, child(w, n, 1)) || glsl_has_effects(w, child(w, n, 2)))
		return w->choose(w, n);
	for (uint32_t i = 0; i < 3; i++)
		a[i] = glsl_expression(w, child(w, n, i));
	v = glsl_fresh(w, n->type);
	if (glsl_stopped(w) || a[1].n != v.n || a[2].n != v.n) {
		glsl_fail(w, "a shader has operands of different sizes");
		return v;
	}
	glsl_write(w, SCENE_OP_CHOOSE, 0, v.at[0], v.n, glsl_spread(w, &a[0], v.n), a[1].at, a[2].at);
	return v;
}

/* Operations whose arguments are the values of their children. */
static struct glsl_value of_children(struct glsl_writer *w, const struct glsl_node *n)
{
	struct glsl_value *a = glsl_alloc(w, (n->count + 1) * sizeof(*a)), none = { n->type, 0, NULL }, v;
	const uint32_t top = w->top;
	uint32_t zero;

	if (n->count > 65536 || !a)
		return none;
	for (uint32_t i = 0; i < n->count && !glsl_stopped(w); i++) {
		bool changes = false;

		a[i] = glsl_expression(w, child(w, n, i));
		for (uint32_t k = i + 1; k < n->count; k++)
			changes |= glsl_has_effects(w, child(w, n, k));
		if (changes && !glsl_stopped(w) && a[i].n)
			a[i] = kept(w, &a[i]);
	}
	if (glsl_stopped(w))
		return none;
	switch (n->operation) {
	case GLSL_CONSTRUCT: return construct(w, n->type, a, n->count);
	case GLSL_CONVERT:
		a[0] = converted(w, &a[0], glsl_type_of(w, n->type)->kind);
		a[0].type = n->type;
		return a[0];
	case GLSL_NEGATE: return glsl_by_component(w, SCENE_OP_MOVE, SCENE_NEGATE_A, n->type, &a[0], NULL);
	case GLSL_NOT:
		zero = glsl_number(w, 0);
		return glsl_by_component(w, SCENE_OP_EQUAL, 0, n->type, &a[0], &(struct glsl_value){ n->type, 1, &zero });
	case GLSL_COMMA: return n->count ? a[n->count - 1] : none;
	case GLSL_TEXTURE:
	case GLSL_TEXTURE_PROJ:
	case GLSL_TEXTURE_LOD:
	case GLSL_TEXTURE_PROJ_LOD: return glsl_sample(w, n, a, n->count);
	default: break;
	}
	if (n->operation >= GLSL_ADD && n->operation <= GLSL_AND && n->count == 2) {
		v = glsl_binary(w, n->operation, n->type, &a[0], &a[1]);
		if (!glsl_has_effects(w, child(w, n, 0)) && !glsl_has_effects(w, child(w, n, 1)))
			glsl_settle(w, top, &v);
		return v;
	}
	return glsl_call_builtin(w, n, a, n->count);
}

static struct glsl_value expression(struct glsl_writer *w, uint32_t node)
{
	const struct glsl_node *n = node_of(w, node);
	struct glsl_place p;

	switch (n->operation) {
	case GLSL_SYMBOL: return glsl_variable(w, n->value);
	case GLSL_NUMBERS: return of_numbers(w, n->type, n->value);
	case GLSL_INDEX:
	case GLSL_MEMBER:
	case GLSL_SWIZZLE:
		p = glsl_place_of(w, node);
		return glsl_load(w, &p);
	case GLSL_ASSIGN: return assign(w, n);
	case GLSL_POST_INCREMENT:
	case GLSL_POST_DECREMENT:
	case GLSL_PRE_INCREMENT:
	case GLSL_PRE_DECREMENT: return increment(w, n);
	case GLSL_SELECTION: return choice(w, n);
	case GLSL_AND:
	case GLSL_OR:
		if (glsl_has_effects(w, child(w, n, 1)))
			return w->choose(w, n);
		return of_children(w, n);
	case GLSL_CALL: return w->call(w, n);
	default: return of_children(w, n);
	}
}

struct glsl_value glsl_expression(struct glsl_writer *w, uint32_t node)
{
	struct glsl_value v = { 0 };

	if (node == GLSL_NONE || w->depth == MAX_DEPTH)
		glsl_fail(w, "a shader is nested too deeply");
	if (glsl_stopped(w))
		return v;
	w->depth++;
	v = expression(w, node);
	w->depth--;
	if (!glsl_stopped(w) && !v.at && glsl_type_of(w, w->tree->nodes[node].type)->numbers)
		glsl_fail(w, "a shader has an unsupported expression");
	return v;
}
