#include "replay/glsl/parse/expression.h"

#include "replay/glsl/meaning/access.h"
#include "replay/glsl/meaning/construct.h"
#include "replay/glsl/meaning/functions.h"
#include "replay/glsl/meaning/operators.h"
#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/text/keywords.h"
#include "replay/glsl/text/type_names.h"

/* --- Types -------------------------------------------------------------------------------------------------------- */

bool parse_names_type(const struct parse *p, const struct parse_token *token)
{
	const uint32_t keyword = parse_keyword(p, token);

	if (token->kind != PARSE_NAME)
		return false;
	return keyword == PARSE_TYPE_NAME || (keyword == PARSE_UNSIGNED && p->extensions & PARSE_GPU_SHADER4) ||
	       (keyword == PARSE_NO_KEYWORD && token->name->binding && token->name->binding->type);
}

const struct parse_type *parse_named_type(struct parse *p)
{
	struct parse_name *name = p->now.name;
	struct parse_type_name found;

	if (!parse_names_type(p, &p->now))
		return NULL;
	parse_advance(p);
	if (name->keyword == PARSE_UNSIGNED) {
		if (!parse_is_word(&p->now, "int"))
			parse_unexpected(p);
		parse_advance(p);
		return parse_type(p, GLSL_UINT, 1, 0);
	}
	if (name->keyword != PARSE_TYPE_NAME || !parse_type_name(name->text, &found))
		return name->binding->type;
	return found.kind == GLSL_SAMPLER ? parse_type_sampler(p, found.texture) :
	                                    parse_type(p, found.kind, found.rows, found.columns);
}

uint32_t parse_constant_length(struct parse *p)
{
	const struct parse_node *node = parse_assignment(p);

	if (!parse_is_constant(node) || !parse_type_is_scalar(node->type) ||
	    (node->type->kind != GLSL_INT && node->type->kind != GLSL_UINT))
		parse_error(p, "an array's length is not a constant integer");
	if (!(node->numbers[0] > 0))
		parse_error(p, "an array's length is not above 0");
	if (node->numbers[0] > PARSE_MAX_NUMBERS)
		parse_refuse(p, "a shader has an array that is too large");
	return (uint32_t)node->numbers[0];
}

const struct parse_type *parse_array_lengths(struct parse *p, const struct parse_type *type)
{
	uint32_t length;

	if (!parse_accept(p, '['))
		return type;
	parse_enter(p);
	if (type->kind == GLSL_VOID)
		parse_error(p, "an array of void");
	length = parse_is_sign(&p->now, ']') ? 0 : parse_constant_length(p);
	parse_expect(p, ']');
	type = parse_array_lengths(p, type); /* the first bracket belongs to the outermost array */
	if (type->kind == GLSL_ARRAY && !parse_has(p, 430, PARSE_ARRAYS))
		parse_error(p, "an array of arrays needs GLSL 4.30");
	parse_leave(p);
	return parse_type_array(p, type, length);
}

/* --- Operands ----------------------------------------------------------------------------------------------------- */

/* Parse arguments after '(', up to ')'. */
static struct parse_nodes arguments_of(struct parse *p)
{
	struct parse_nodes list = { 0 };

	if (parse_keyword(p, &p->now) == PARSE_TYPE_NAME && parse_is_word(&p->now, "void") &&
	    parse_is_sign(parse_peek(p), ')'))
		parse_advance(p);
	if (parse_accept(p, ')'))
		return list;
	do {
		parse_nodes_add(p, &list, parse_assignment(p));
		if (list.at[list.n - 1]->type->kind == GLSL_VOID)
			parse_error(p, "an argument has no value");
	} while (parse_accept(p, ','));
	parse_expect(p, ')');
	return list;
}

static struct parse_node *variable(struct parse *p, struct parse_name *name)
{
	struct parse_symbol *s = name->binding ? name->binding->symbol : NULL;

	if (!s)
		parse_error(p, "'%s' is not declared", name->text);
	if (s->is_block)
		parse_refuse(p, "a shader has uniform or input blocks, which are not supported");
	return s->storage == GLSL_CONSTANT_VALUE ? parse_node_numbers(p, s->type, s->numbers) : parse_node_symbol(p, s);
}

static struct parse_node *literal(struct parse *p)
{
	const struct parse_literal number = parse_literal(p, &p->now);

	parse_advance(p);
	return parse_node_number(p, number.kind, number.value);
}

static struct parse_node *operand(struct parse *p)
{
	const struct parse_type *type = parse_named_type(p);
	struct parse_nodes arguments;
	struct parse_node *node;
	struct parse_name *name;

	if (type) {
		if (parse_is_sign(&p->now, '[') && p->version < 120)
			parse_error(p, "a constructor of an array needs GLSL 1.20");
		type = parse_array_lengths(p, type);
		parse_expect(p, '(');
		arguments = arguments_of(p);
		return parse_construct(p, type, &arguments);
	}
	if (p->now.kind == PARSE_NUMBER)
		return literal(p);
	if (parse_accept(p, '(')) {
		node = parse_expression(p);
		parse_expect(p, ')');
		return node;
	}
	if (parse_accept_word(p, PARSE_TRUE))
		return parse_node_number(p, GLSL_BOOL, 1);
	if (parse_accept_word(p, PARSE_FALSE))
		return parse_node_number(p, GLSL_BOOL, 0);
	name = parse_identifier(p);
	if (!parse_accept(p, '('))
		return variable(p, name);
	arguments = arguments_of(p);
	return parse_call(p, name, &arguments);
}

static struct parse_node *postfix(struct parse *p)
{
	struct parse_node *node = operand(p);

	for (;;) {
		if (parse_accept(p, '[')) {
			node = parse_index(p, node, parse_expression(p));
			parse_expect(p, ']');
		} else if (parse_accept(p, '.')) {
			struct parse_name *name = p->now.name;

			if (p->now.kind != PARSE_NAME)
				parse_unexpected(p);
			parse_advance(p);
			if (parse_is_sign(&p->now, '(') && node->type->kind != GLSL_STRUCT) {
				parse_advance(p);
				parse_expect(p, ')');
				node = parse_length(p, node);
			} else {
				node = parse_member(p, node, name);
			}
		} else if (parse_accept(p, PARSE_SIGN2('+', '+'))) {
			node = parse_increment(p, GLSL_POST_INCREMENT, node);
		} else if (parse_accept(p, PARSE_SIGN2('-', '-'))) {
			node = parse_increment(p, GLSL_POST_DECREMENT, node);
		} else {
			return node;
		}
	}
}

/* --- Operators ---------------------------------------------------------------------------------------------------- */

static struct parse_node *unary(struct parse *p)
{
	const uint32_t sign = p->now.kind == PARSE_SIGN ? p->now.sign : 0;
	struct parse_node *node;

	parse_enter(p);
	if (sign == PARSE_SIGN2('+', '+') || sign == PARSE_SIGN2('-', '-')) {
		parse_advance(p);
		node = parse_increment(p, sign == PARSE_SIGN2('+', '+') ? GLSL_PRE_INCREMENT : GLSL_PRE_DECREMENT,
		                       unary(p));
	} else if (sign == '+' || sign == '-' || sign == '!' || sign == '~') {
		parse_advance(p);
		node = parse_operate_before(p, sign, unary(p));
	} else {
		node = postfix(p);
	}
	parse_leave(p);
	return node;
}

/* Precedence of a binary operator; 0: not one. */
static uint32_t strength(const struct parse_token *token)
{
	switch (token->kind == PARSE_SIGN ? token->sign : 0) {
	case '*':
	case '/':
	case '%': return 11;
	case '+':
	case '-': return 10;
	case PARSE_SIGN2('<', '<'):
	case PARSE_SIGN2('>', '>'): return 9;
	case '<':
	case '>':
	case PARSE_SIGN2('<', '='):
	case PARSE_SIGN2('>', '='): return 8;
	case PARSE_SIGN2('=', '='):
	case PARSE_SIGN2('!', '='): return 7;
	case '&': return 6;
	case '^': return 5;
	case '|': return 4;
	case PARSE_SIGN2('&', '&'): return 3;
	case PARSE_SIGN2('^', '^'): return 2;
	case PARSE_SIGN2('|', '|'): return 1;
	default: return 0;
	}
}

static struct parse_node *binary(struct parse *p, uint32_t lowest)
{
	struct parse_node *node = unary(p);

	while (strength(&p->now) >= lowest) {
		const uint32_t sign = p->now.sign, own = strength(&p->now);

		parse_advance(p);
		node = parse_operate(p, sign, node, binary(p, own + 1));
	}
	return node;
}

static struct parse_node *conditional(struct parse *p)
{
	struct parse_node *node = binary(p, 1), *yes;

	if (!parse_accept(p, '?'))
		return node;
	yes = parse_expression(p);
	parse_expect(p, ':');
	return parse_choose(p, node, yes, parse_assignment(p));
}

/* The operator of a compound assignment; 0: none. */
static uint32_t operator_of(uint32_t sign)
{
	return sign > 0xffff ? sign & 0xffff : sign & 0xff;
}

static bool assigns(const struct parse_token *token)
{
	static const uint32_t signs[] = { '=',
		                          PARSE_SIGN2('+', '='),
		                          PARSE_SIGN2('-', '='),
		                          PARSE_SIGN2('*', '='),
		                          PARSE_SIGN2('/', '='),
		                          PARSE_SIGN2('%', '='),
		                          PARSE_SIGN2('&', '='),
		                          PARSE_SIGN2('|', '='),
		                          PARSE_SIGN2('^', '='),
		                          PARSE_SIGN3('<', '<', '='),
		                          PARSE_SIGN3('>', '>', '=') };

	for (unsigned i = 0; token->kind == PARSE_SIGN && i < sizeof(signs) / sizeof(signs[0]); i++)
		if (token->sign == signs[i])
			return true;
	return false;
}

struct parse_node *parse_assignment(struct parse *p)
{
	struct parse_node *node;

	parse_enter(p);
	node = conditional(p);
	if (assigns(&p->now)) {
		const uint32_t sign = p->now.sign;

		parse_advance(p);
		node = parse_assign(p, sign == '=' ? 0 : operator_of(sign), node, parse_assignment(p));
	}
	parse_leave(p);
	return node;
}

struct parse_node *parse_expression(struct parse *p)
{
	struct parse_node *node = parse_assignment(p);

	while (parse_accept(p, ',')) {
		struct parse_node *last = parse_assignment(p);

		node = parse_node(p, GLSL_COMMA, last->type, 2, node, last);
	}
	return node;
}
