/*
 * Statements (GLSL 1.20 sec. 6). The four pixels of a quad run in lockstep: if their control flow diverges, the
 * inactive ones are masked, and code that no pixel executes is jumped over. A mask is a register with 1 for each active
 * pixel; the masks of enclosing statements form levels. Break, continue and return remove pixels from the masks of all
 * levels that they leave.
 */
#include "replay/glsl/statement.h"

#include <string.h>

#include "replay/glsl/expression.h"

static uint32_t child(const struct glsl_writer *w, const struct glsl_node *n, uint32_t i)
{
	return i < n->count ? w->tree->children[n->first + i] : GLSL_NONE;
}

static uint32_t count_of(const struct glsl_writer *w, uint32_t node, uint32_t operation)
{
	const struct glsl_node *n;
	uint32_t count;

	if (node == GLSL_NONE)
		return 0;
	n = &w->tree->nodes[node];
	count = n->operation == operation;
	for (uint32_t i = 0; i < n->count; i++)
		count += count_of(w, child(w, n, i), operation);
	return count;
}

/* --- Masks ------------------------------------------------------------------------------------------------------- */

/* The operand that holds the current mask. */
static uint32_t mask_now(struct glsl_writer *w)
{
	return w->n_levels ? w->levels[w->n_levels - 1].mask : glsl_number(w, 1);
}

static void set_mask(struct glsl_writer *w)
{
	glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_MASK, .a = mask_now(w) });
	w->barrier = w->code->n_instructions;
}

/* Write a mask for all pixels, whichever are active. */
static void write_mask(struct glsl_writer *w, enum scene_operation operation, uint32_t to, uint32_t a, uint32_t b)
{
	glsl_append(w, &(struct scene_instruction){
			       .operation = operation, .n = 1, .flags = SCENE_UNMASKED, .to = to, .a = a, .b = b });
}

static uint32_t new_mask(struct glsl_writer *w, enum scene_operation operation, uint32_t a, uint32_t b)
{
	const uint32_t to = glsl_registers(w, 1);

	write_mask(w, operation, to, a, b);
	return to;
}

static void push_level(struct glsl_writer *w, enum glsl_level_kind kind, uint32_t mask)
{
	if (w->n_levels == GLSL_MAX_LEVELS)
		glsl_fail(w, "a shader is nested too deeply");
	else
		w->levels[w->n_levels++] = (struct glsl_level){ kind, mask };
}

/* @return index of a jump whose target is not set yet. none_of: jump if this mask is empty; GLSL_NONE: always */
static uint32_t jump(struct glsl_writer *w, uint32_t none_of)
{
	return glsl_append(
		w, &(struct scene_instruction){ .operation = none_of == GLSL_NONE ? SCENE_OP_JUMP : SCENE_OP_JUMP_NONE,
	                                        .a = none_of == GLSL_NONE ? 0 : none_of });
}

/* Set the target of a jump to the next instruction. */
static void land(struct glsl_writer *w, uint32_t jump)
{
	if (glsl_stopped(w))
		return;
	w->code->instructions[jump].to = w->code->n_instructions;
	w->barrier = w->code->n_instructions;
}

/* Remove the active pixels from all levels down to one of this kind. */
static void leave(struct glsl_writer *w, enum glsl_level_kind kind)
{
	const uint32_t zero = glsl_number(w, 0);
	uint32_t n = w->n_levels;

	while (n && !glsl_stopped(w)) {
		const struct glsl_level *level = &w->levels[--n];

		glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_MOVE, .n = 1, .to = level->mask, .a = zero });
		if (level->kind == kind)
			break;
	}
	set_mask(w);
}

/* --- If ---------------------------------------------------------------------------------------------------------- */

static int is_constant(uint32_t operand)
{
	return operand >= SCENE_PROGRAM_CONSTANT;
}

typedef void branch(struct glsl_writer *w, uint32_t node, const struct glsl_value *result);

static void branch_statement(struct glsl_writer *w, uint32_t node, const struct glsl_value *result)
{
	(void)result;
	if (node != GLSL_NONE)
		glsl_statement(w, node);
}

static void branch_value(struct glsl_writer *w, uint32_t node, const struct glsl_value *result)
{
	const struct glsl_value v = glsl_expression(w, node);

	if (!glsl_stopped(w) && v.n == result->n)
		glsl_copy(w, result->at, v.at, v.n);
}

/* One of two branches, by a condition. If that is the same for all pixels, no mask is needed. */
static void write_if(struct glsl_writer *w, uint32_t condition, uint32_t yes, uint32_t no, branch *write,
                     const struct glsl_value *result)
{
	const uint32_t before = mask_now(w), has_no = no != GLSL_NONE;
	uint32_t masks[2] = { 0 }, over;

	if (is_constant(condition)) {
		over = jump(w, condition);
		write(w, yes, result);
		if (has_no) {
			const uint32_t end = jump(w, GLSL_NONE);

			land(w, over);
			write(w, no, result);
			over = end;
		}
		land(w, over);
		if (w->n_levels)
			set_mask(w);
		return;
	}
	masks[0] = new_mask(w, SCENE_OP_AND, before, condition);
	if (has_no)
		masks[1] = new_mask(w, SCENE_OP_AND_NOT, before, condition);
	for (uint32_t i = 0; i < 1 + has_no; i++) {
		over = jump(w, masks[i]);
		push_level(w, GLSL_LEVEL_IF, masks[i]);
		set_mask(w);
		write(w, i ? no : yes, result);
		w->n_levels -= !glsl_stopped(w);
		land(w, over);
	}
	set_mask(w);
}

struct glsl_value glsl_choose(struct glsl_writer *w, const struct glsl_node *n)
{
	const struct glsl_value condition = glsl_expression(w, child(w, n, 0)), result = glsl_fresh(w, n->type);
	uint32_t chosen;

	if (glsl_stopped(w))
		return result;
	if (n->operation == GLSL_SELECTION) {
		chosen = condition.at[0];
		if (!is_constant(chosen))
			chosen = glsl_one(w, SCENE_OP_MOVE, chosen, 0, 0);
		write_if(w, chosen, child(w, n, 1), child(w, n, 2), branch_value, &result);
		return result;
	}
	glsl_write(w, SCENE_OP_MOVE, 0, result.at[0], 1, condition.at, NULL, NULL);
	w->barrier = w->code->n_instructions;
	chosen = n->operation == GLSL_AND ? result.at[0] : glsl_one(w, SCENE_OP_EQUAL, result.at[0], glsl_number(w, 0), 0);
	write_if(w, chosen, child(w, n, 1), GLSL_NONE, branch_value, &result);
	return result;
}

/* --- Loops ------------------------------------------------------------------------------------------------------- */

/* Pixels that fail the test leave the loop. */
static void write_test(struct glsl_writer *w, uint32_t test, uint32_t running)
{
	const uint32_t top = w->top;
	const struct glsl_value v = test == GLSL_NONE ? (struct glsl_value){ 0 } : glsl_expression(w, test);

	if (!glsl_stopped(w) && test != GLSL_NONE)
		write_mask(w, SCENE_OP_AND, running, running, v.at[0]);
	w->top = top;
}

static void write_loop(struct glsl_writer *w, const struct glsl_node *n)
{
	const uint32_t test = child(w, n, 0), body = child(w, n, 1), terminal = child(w, n, 2),
		       continues = count_of(w, body, GLSL_CONTINUE) != 0;
	const uint32_t running = new_mask(w, SCENE_OP_MOVE, mask_now(w), 0), inside = continues ? glsl_registers(w, 1) : 0;
	uint32_t top, over;

	push_level(w, GLSL_LEVEL_BREAK, running);
	set_mask(w);
	top = w->code->n_instructions;
	if (n->value)
		write_test(w, test, running);
	over = jump(w, running);
	if (continues) {
		write_mask(w, SCENE_OP_MOVE, inside, running, 0);
		push_level(w, GLSL_LEVEL_CONTINUE, inside);
	}
	set_mask(w);
	if (body != GLSL_NONE)
		glsl_statement(w, body);
	if (glsl_stopped(w))
		return;
	w->n_levels -= continues;
	set_mask(w);
	if (terminal != GLSL_NONE)
		glsl_statement(w, terminal);
	if (!n->value) {
		write_test(w, test, running);
		set_mask(w);
	}
	glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_JUMP, .to = top });
	land(w, over);
	w->n_levels -= !glsl_stopped(w);
	set_mask(w);
}

/* Activate pixels whose value equals the label's, and those that fall through from the label before. */
static void write_label(struct glsl_writer *w, uint32_t running, uint32_t inside, uint32_t matches)
{
	const uint32_t in = new_mask(w, SCENE_OP_MAXIMUM, inside, matches);

	write_mask(w, SCENE_OP_AND, inside, running, in);
	set_mask(w);
}

static void write_switch(struct glsl_writer *w, const struct glsl_node *n)
{
	const struct glsl_node *body = &w->tree->nodes[child(w, n, 1)];
	const struct glsl_value v = glsl_expression(w, child(w, n, 0));
	const uint32_t zero = glsl_number(w, 0), running = new_mask(w, SCENE_OP_MOVE, mask_now(w), 0),
		       inside = new_mask(w, SCENE_OP_MOVE, zero, 0);
	uint32_t value, none = glsl_number(w, 1);

	if (glsl_stopped(w))
		return;
	value = glsl_one(w, SCENE_OP_MOVE, v.at[0], 0, 0);
	/* pixels that match no label become active at the default */
	for (uint32_t i = 0; i < body->count && !glsl_stopped(w); i++) {
		const struct glsl_node *label = &w->tree->nodes[child(w, body, i)];

		if (label->operation == GLSL_CASE) {
			const struct glsl_value with = glsl_expression(w, child(w, label, 0));

			if (!glsl_stopped(w))
				none = glsl_one(w, SCENE_OP_AND, none, glsl_one(w, SCENE_OP_NOT_EQUAL, value, with.at[0], 0), 0);
		}
	}
	push_level(w, GLSL_LEVEL_BREAK, running);
	push_level(w, GLSL_LEVEL_IF, inside);
	set_mask(w);
	for (uint32_t i = 0; i < body->count && !glsl_stopped(w); i++) {
		const uint32_t node = child(w, body, i);
		const struct glsl_node *label = &w->tree->nodes[node];

		if (label->operation == GLSL_CASE) {
			const struct glsl_value with = glsl_expression(w, child(w, label, 0));

			if (!glsl_stopped(w))
				write_label(w, running, inside, new_mask(w, SCENE_OP_EQUAL, value, with.at[0]));
		} else if (label->operation == GLSL_DEFAULT) {
			write_label(w, running, inside, none);
		} else {
			glsl_statement(w, node);
		}
	}
	if (!glsl_stopped(w))
		w->n_levels -= 2;
	set_mask(w);
}

/* --- Functions --------------------------------------------------------------------------------------------------- */

/* Allocate registers for a function's variables, before its first statement. */
static void place_variables(struct glsl_writer *w, uint32_t node)
{
	const struct glsl_node *n;

	if (node == GLSL_NONE || glsl_stopped(w))
		return;
	n = &w->tree->nodes[node];
	if (n->operation == GLSL_SYMBOL && w->tree->symbols[n->value].storage == GLSL_LOCAL && !w->variables[n->value].at)
		w->variables[n->value] = glsl_fresh(w, w->tree->symbols[n->value].type);
	for (uint32_t i = 0; i < n->count; i++)
		place_variables(w, child(w, n, i));
}

static void forget_variables(struct glsl_writer *w, uint32_t node)
{
	const struct glsl_node *n;

	if (node == GLSL_NONE)
		return;
	n = &w->tree->nodes[node];
	if (n->operation == GLSL_SYMBOL && w->tree->symbols[n->value].storage == GLSL_LOCAL)
		w->variables[n->value] = (struct glsl_value){ 0 };
	for (uint32_t i = 0; i < n->count; i++)
		forget_variables(w, child(w, n, i));
}

/* The return at the end of a function, if it is the only one; NULL: there is none, or there are others. */
static const struct glsl_node *last_return(const struct glsl_writer *w, uint32_t body)
{
	const struct glsl_node *last = &w->tree->nodes[body];

	while (last->operation == GLSL_SEQUENCE && last->count)
		last = &w->tree->nodes[child(w, last, last->count - 1)];
	return last->operation == GLSL_RETURN && count_of(w, body, GLSL_RETURN) == 1 ? last : NULL;
}

void glsl_body(struct glsl_writer *w, const struct glsl_function *f)
{
	const struct glsl_node *outer = w->last_return;

	place_variables(w, f->body);
	w->last_return = last_return(w, f->body);
	if (!w->last_return && count_of(w, f->body, GLSL_RETURN)) {
		push_level(w, GLSL_LEVEL_RETURN, new_mask(w, SCENE_OP_MOVE, mask_now(w), 0));
		set_mask(w);
		glsl_statement(w, f->body);
		w->n_levels -= !glsl_stopped(w);
		set_mask(w);
	} else {
		glsl_statement(w, f->body);
	}
	w->last_return = outer;
	forget_variables(w, f->body);
}

static void write_return(struct glsl_writer *w, const struct glsl_node *n)
{
	const uint32_t with = child(w, n, 0);

	if (with != GLSL_NONE) {
		const struct glsl_value v = glsl_expression(w, with);

		if (!glsl_stopped(w) && v.n == w->result.n)
			glsl_copy(w, w->result.at, v.at, v.n);
	}
	if (n != w->last_return)
		leave(w, GLSL_LEVEL_RETURN);
}

/* 1 if a value can be used as the parameter without a copy, because nothing can change it while the function runs. */
static int may_stand(const struct glsl_writer *w, const struct glsl_value *v, uint32_t symbol, uint32_t argument)
{
	const uint32_t operation = w->tree->nodes[argument].operation;
	int all_constant = 1;

	if (w->written[symbol])
		return 0;
	for (uint32_t i = 0; i < v->n; i++)
		all_constant &= is_constant(v->at[i]);
	return all_constant || (operation != GLSL_SYMBOL && operation != GLSL_INDEX && operation != GLSL_MEMBER &&
	                        operation != GLSL_SWIZZLE && operation != GLSL_CONSTRUCT && operation != GLSL_COMMA &&
	                        operation != GLSL_ASSIGN && operation != GLSL_CONVERT && operation != GLSL_TRANSPOSE);
}

struct glsl_value glsl_call(struct glsl_writer *w, const struct glsl_node *n)
{
	const struct glsl_function *f = &w->tree->functions[n->value];
	const struct glsl_value outer = w->result, result = glsl_fresh(w, n->type);
	struct glsl_place *places = glsl_alloc(w, (n->count + 1) * sizeof(*places));
	struct glsl_value *old = glsl_alloc(w, (n->count + 1) * sizeof(*old)),
			  *in = glsl_alloc(w, (n->count + 1) * sizeof(*in));
	uint32_t top;

	if (f->body == GLSL_NONE || f->count != n->count || w->running[n->value])
		glsl_fail(w, w->running[n->value] ? "a shader's function calls itself" :
		                                    "a shader calls a function that it does not have");
	if (glsl_stopped(w))
		return result;
	for (uint32_t i = 0; i < n->count && !glsl_stopped(w); i++) {
		const uint32_t symbol = w->tree->nodes[w->tree->children[f->first + i]].value, argument = child(w, n, i);
		const uint32_t storage = w->tree->symbols[symbol].storage;

		if (storage == GLSL_OUT || storage == GLSL_INOUT) {
			places[i] = glsl_place_of(w, argument);
			if (storage == GLSL_INOUT)
				in[i] = glsl_load(w, &places[i]);
		} else {
			in[i] = glsl_expression(w, argument);
		}
		if (glsl_stopped(w))
			break;
		if (storage == GLSL_OUT || storage == GLSL_INOUT || !may_stand(w, &in[i], symbol, argument)) {
			const struct glsl_value own = glsl_fresh(w, w->tree->symbols[symbol].type);

			if (glsl_stopped(w))
				break;
			if (storage != GLSL_OUT && in[i].n == own.n)
				glsl_copy(w, own.at, in[i].at, own.n);
			in[i] = own;
			w->barrier = w->code->n_instructions;
		}
	}
	for (uint32_t i = 0; i < n->count && !glsl_stopped(w); i++) {
		const uint32_t symbol = w->tree->nodes[w->tree->children[f->first + i]].value;

		old[i] = w->variables[symbol];
		w->variables[symbol] = in[i];
	}
	top = w->top;
	w->running[n->value] = 1;
	w->result = result;
	glsl_body(w, f);
	w->result = outer;
	w->running[n->value] = 0;
	for (uint32_t i = 0; i < n->count && !glsl_stopped(w); i++) {
		const uint32_t symbol = w->tree->nodes[w->tree->children[f->first + i]].value,
			       storage = w->tree->symbols[symbol].storage;

		if (storage == GLSL_OUT || storage == GLSL_INOUT)
			glsl_store(w, &places[i], &w->variables[symbol]);
		w->variables[symbol] = old[i];
	}
	w->top = top;
	w->barrier = w->code->n_instructions;
	return result;
}

/* --- All of them ------------------------------------------------------------------------------------------------- */

static void write_discard(struct glsl_writer *w)
{
	const uint32_t below = glsl_number(w, -1);

	w->code->kills = 1;
	glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_KILL, .n = 1, .a = below });
	w->barrier = w->code->n_instructions;
}

static void statement(struct glsl_writer *w, uint32_t node)
{
	const struct glsl_node *n = &w->tree->nodes[node];
	struct glsl_value v;

	switch (n->operation) {
	case GLSL_SEQUENCE:
		for (uint32_t i = 0; i < n->count && !glsl_stopped(w); i++)
			glsl_statement(w, child(w, n, i));
		return;
	case GLSL_SELECTION:
		v = glsl_expression(w, child(w, n, 0));
		if (!glsl_stopped(w))
			write_if(w, v.at[0], child(w, n, 1), child(w, n, 2), branch_statement, NULL);
		return;
	case GLSL_LOOP: write_loop(w, n); return;
	case GLSL_SWITCH: write_switch(w, n); return;
	case GLSL_BREAK: leave(w, GLSL_LEVEL_BREAK); return;
	case GLSL_CONTINUE: leave(w, GLSL_LEVEL_CONTINUE); return;
	case GLSL_RETURN: write_return(w, n); return;
	case GLSL_DISCARD: write_discard(w); return;
	default: glsl_expression(w, node);
	}
}

void glsl_statement(struct glsl_writer *w, uint32_t node)
{
	const uint32_t top = w->top;

	if (glsl_stopped(w))
		return;
	if (w->depth >= 600) {
		glsl_fail(w, "a shader is nested too deeply");
		return;
	}
	w->depth++;
	statement(w, node);
	w->depth--;
	w->top = top;
}
