#include "replay/glsl/parse/statement.h"

#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/meaning/functions.h"
#include "replay/glsl/meaning/operators.h"
#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/parse/declaration.h"
#include "replay/glsl/parse/expression.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/parse/specifier.h"
#include "replay/glsl/text/keywords.h"

#define MOST_COMPARED 4096 /* maximum number of labels in a switch */

static struct parse_node *statement(struct parse *p);

static struct parse_node *sequence(struct parse *p, const struct parse_nodes *list)
{
	return parse_node_of(p, GLSL_SEQUENCE, parse_type(p, GLSL_VOID, 0, 0), list);
}

static struct parse_node *of_type_void(struct parse *p, enum glsl_operator operation, uint32_t n, struct parse_node *a,
                                       struct parse_node *b, struct parse_node *c)
{
	return parse_node(p, operation, parse_type(p, GLSL_VOID, 0, 0), n, a, b, c);
}

/* A statement in a scope of its own. */
static struct parse_node *scoped_statement(struct parse *p)
{
	struct parse_node *node;

	parse_scope_open(p);
	node = statement(p);
	parse_scope_close(p);
	return node;
}

/* The body of a loop, whose variables are in the same scope as those of the loop's head. */
static struct parse_node *loop_body(struct parse *p)
{
	struct parse_node *node;

	p->loops++;
	node = parse_accept(p, '{') ? parse_statements(p) : statement(p);
	p->loops--;
	return node;
}

static struct parse_node *condition(struct parse *p, bool may_declare)
{
	struct parse_node *node = may_declare && parse_begins_declaration(p) ? parse_condition_variable(p) :
	                                                                       parse_expression(p);

	parse_need_bool(p, node);
	return node;
}

static struct parse_node *read_if(struct parse *p)
{
	struct parse_node *test, *yes, *no = NULL;

	parse_expect(p, '(');
	test = condition(p, false);
	parse_expect(p, ')');
	yes = scoped_statement(p);
	if (parse_accept_word(p, PARSE_ELSE))
		no = scoped_statement(p);
	return of_type_void(p, GLSL_SELECTION, 3, test, yes, no);
}

static struct parse_node *read_loop(struct parse *p, struct parse_node *test, struct parse_node *body,
                                    struct parse_node *terminal, bool tests_first)
{
	struct parse_node *node = of_type_void(p, GLSL_LOOP, 3, test, body, terminal);

	node->value = tests_first;
	return node;
}

static struct parse_node *read_while(struct parse *p)
{
	struct parse_node *test, *node;

	parse_scope_open(p);
	parse_expect(p, '(');
	test = condition(p, true);
	parse_expect(p, ')');
	node = read_loop(p, test, loop_body(p), NULL, true);
	parse_scope_close(p);
	return node;
}

static struct parse_node *read_do(struct parse *p)
{
	struct parse_node *test, *body;

	parse_scope_open(p);
	body = loop_body(p);
	parse_scope_close(p);
	if (!parse_accept_word(p, PARSE_WHILE))
		parse_unexpected(p);
	parse_expect(p, '(');
	test = condition(p, false);
	parse_expect(p, ')');
	parse_expect(p, ';');
	return read_loop(p, test, body, NULL, false);
}

static struct parse_node *read_for(struct parse *p)
{
	struct parse_nodes list = { 0 };
	struct parse_node *test = NULL, *terminal = NULL;

	parse_scope_open(p);
	parse_expect(p, '(');
	if (parse_begins_declaration(p)) {
		parse_local_declaration(p, &list);
	} else if (!parse_accept(p, ';')) {
		parse_nodes_add(p, &list, parse_expression(p));
		parse_expect(p, ';');
	}
	if (!parse_is_sign(&p->now, ';'))
		test = condition(p, true);
	parse_expect(p, ';');
	if (!parse_is_sign(&p->now, ')'))
		terminal = parse_expression(p);
	parse_expect(p, ')');
	parse_nodes_add(p, &list, read_loop(p, test, loop_body(p), terminal, true));
	parse_scope_close(p);
	return sequence(p, &list);
}

static struct parse_node *read_label(struct parse *p, bool is_case, const struct parse_type *type)
{
	struct parse_node *value = is_case ? parse_expression(p) : NULL;

	if (value && (!parse_is_constant(value) || !parse_type_is_scalar(value->type) ||
	              (value->type->kind != GLSL_INT && value->type->kind != GLSL_UINT)))
		parse_error(p, "a case label is not a constant integer");
	if (value)
		value = parse_convert(p, value, type->kind);
	parse_expect(p, ':');
	return of_type_void(p, is_case ? GLSL_CASE : GLSL_DEFAULT, is_case, value, NULL, NULL);
}

/* Report an error if the last label's value is a duplicate. */
static void check_label(struct parse *p, const struct parse_nodes *list)
{
	const struct parse_node *last = list->at[list->n - 1];

	for (uint32_t i = 0; last->operation == GLSL_CASE && i + 1 < list->n && i < MOST_COMPARED; i++)
		if (list->at[i]->operation == GLSL_CASE &&
		    list->at[i]->children[0]->numbers[0] == last->children[0]->numbers[0])
			parse_error(p, "a switch has two cases with the same value");
}

static struct parse_node *read_switch(struct parse *p)
{
	struct parse_nodes list = { 0 };
	struct parse_node *value;
	bool has_default = false;

	parse_expect(p, '(');
	value = parse_expression(p);
	if (!parse_type_is_scalar(value->type) || (value->type->kind != GLSL_INT && value->type->kind != GLSL_UINT))
		parse_error(p, "a switch has a value of type %s", parse_type_text(p, value->type));
	parse_expect(p, ')');
	parse_expect(p, '{');
	parse_scope_open(p);
	p->switches++;
	while (!parse_accept(p, '}')) {
		const bool is_case = parse_accept_word(p, PARSE_CASE);

		if (is_case || parse_accept_word(p, PARSE_DEFAULT)) {
			if (!is_case && has_default)
				parse_error(p, "a switch has two defaults");
			has_default |= !is_case;
			parse_nodes_add(p, &list, read_label(p, is_case, value->type));
			check_label(p, &list);
		} else if (!list.n) {
			parse_error(p, "a switch begins without a case");
		} else {
			parse_nodes_add(p, &list, statement(p));
		}
	}
	p->switches--;
	parse_scope_close(p);
	return of_type_void(p, GLSL_SWITCH, 2, value, sequence(p, &list), NULL);
}

static struct parse_node *read_return(struct parse *p)
{
	const struct parse_type *type = p->inside->result;
	struct parse_node *value = NULL;

	if (!parse_is_sign(&p->now, ';')) {
		if (type->kind == GLSL_VOID)
			parse_error(p, "'%s' is void, but returns a value here", p->inside->name->text);
		value = parse_convert_to(p, parse_expression(p), type);
	} else if (type->kind != GLSL_VOID) {
		parse_error(p, "'%s' does not return a value here", p->inside->name->text);
	}
	p->returns = true;
	parse_expect(p, ';');
	return of_type_void(p, GLSL_RETURN, 1, value, NULL, NULL);
}

static struct parse_node *read_jump(struct parse *p, enum glsl_operator operation, bool may_stand)
{
	if (!may_stand)
		parse_error(p, "a break, continue or discard is not allowed here");
	parse_expect(p, ';');
	return of_type_void(p, operation, 0, NULL, NULL, NULL);
}

static struct parse_node *simple_statement(struct parse *p)
{
	struct parse_nodes list = { 0 };
	struct parse_node *node;

	if (parse_accept(p, ';'))
		return sequence(p, &list);
	if (parse_begins_declaration(p)) {
		parse_local_declaration(p, &list);
		return list.n == 1 ? list.at[0] : sequence(p, &list);
	}
	node = parse_expression(p);
	parse_expect(p, ';');
	return node;
}

static struct parse_node *any_statement(struct parse *p)
{
	struct parse_node *node;

	if (parse_accept(p, '{')) {
		parse_scope_open(p);
		node = parse_statements(p);
		parse_scope_close(p);
		return node;
	}
	if (parse_accept_word(p, PARSE_IF))
		return read_if(p);
	if (parse_accept_word(p, PARSE_FOR))
		return read_for(p);
	if (parse_accept_word(p, PARSE_WHILE))
		return read_while(p);
	if (parse_accept_word(p, PARSE_DO))
		return read_do(p);
	if (parse_accept_word(p, PARSE_SWITCH))
		return read_switch(p);
	if (parse_accept_word(p, PARSE_RETURN))
		return read_return(p);
	if (parse_accept_word(p, PARSE_BREAK))
		return read_jump(p, GLSL_BREAK, p->loops || p->switches);
	if (parse_accept_word(p, PARSE_CONTINUE))
		return read_jump(p, GLSL_CONTINUE, p->loops);
	if (parse_accept_word(p, PARSE_DISCARD))
		return read_jump(p, GLSL_DISCARD, p->stage == GLSL_FRAGMENT_STAGE);
	return simple_statement(p);
}

static struct parse_node *statement(struct parse *p)
{
	struct parse_node *node;

	parse_enter(p);
	node = any_statement(p);
	parse_leave(p);
	return node;
}

struct parse_node *parse_statements(struct parse *p)
{
	struct parse_nodes list = { 0 };

	while (!parse_accept(p, '}')) {
		if (p->now.kind == PARSE_END)
			parse_unexpected(p);
		parse_nodes_add(p, &list, statement(p));
	}
	return sequence(p, &list);
}
