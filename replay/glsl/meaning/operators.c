#include "replay/glsl/meaning/operators.h"

#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/meaning/fold.h"

/* A folded value, or a node. */
static struct parse_node *made(struct parse *p, enum glsl_operator operation, enum parse_bits bits,
                               const struct parse_type *type, struct parse_node *a, struct parse_node *b)
{
	if (parse_is_constant(a) && (!b || parse_is_constant(b)))
		return parse_fold(p, operation, bits, type, a, b);
	return parse_node(p, operation, type, b ? 2 : 1, a, b);
}

_Noreturn static void mismatch(struct parse *p, const struct parse_node *a, const struct parse_node *b)
{
	parse_error(p, "an operator does not take %s and %s", parse_type_text(p, a->type), parse_type_text(p, b->type));
}

/* Convert both operands to a common kind of number, if the language allows it. */
static void unify(struct parse *p, struct parse_node **a, struct parse_node **b)
{
	const struct parse_type *x = (*a)->type, *y = (*b)->type;

	if (x->kind == y->kind || x->kind > GLSL_BOOL || y->kind > GLSL_BOOL)
		return;
	if (parse_may_convert(p, parse_type(p, x->kind, 1, 0), parse_type(p, y->kind, 1, 0)))
		*a = parse_convert(p, *a, y->kind);
	else if (parse_may_convert(p, parse_type(p, y->kind, 1, 0), parse_type(p, x->kind, 1, 0)))
		*b = parse_convert(p, *b, x->kind);
	if ((*a)->type->kind != (*b)->type->kind)
		mismatch(p, *a, *b);
}

/* Matrix products. @return GLSL_MULTIPLY: the product is component-wise */
static enum glsl_operator product_of(struct parse *p, const struct parse_type *x, const struct parse_type *y,
                                     const struct parse_type **type)
{
	if (x->columns && y->columns && x->columns == y->rows) {
		*type = parse_type(p, GLSL_FLOAT, x->rows, y->columns);
		return GLSL_MATRIX_TIMES_MATRIX;
	}
	if (x->columns && !y->columns && y->rows == x->columns) {
		*type = parse_type(p, GLSL_FLOAT, x->rows, 0);
		return GLSL_MATRIX_TIMES_VECTOR;
	}
	if (y->columns && !x->columns && x->rows == y->rows) {
		*type = parse_type(p, GLSL_FLOAT, y->columns, 0);
		return GLSL_VECTOR_TIMES_MATRIX;
	}
	return GLSL_MULTIPLY;
}

static struct parse_node *arithmetic(struct parse *p, enum glsl_operator operation, enum parse_bits bits,
                                     struct parse_node *a, struct parse_node *b)
{
	const struct parse_type *x, *y, *type = NULL;

	if (!parse_type_is_number(a->type) || !parse_type_is_number(b->type))
		mismatch(p, a, b);
	unify(p, &a, &b);
	x = a->type;
	y = b->type;
	if (operation == GLSL_MULTIPLY && (x->columns || y->columns) && !parse_type_is_scalar(x) &&
	    !parse_type_is_scalar(y)) {
		operation = product_of(p, x, y, &type);
		if (operation == GLSL_MULTIPLY)
			mismatch(p, a, b);
		return made(p, operation, PARSE_NO_BITS, type, a, b);
	}
	if (x != y && !parse_type_is_scalar(x) && !parse_type_is_scalar(y))
		mismatch(p, a, b);
	return made(p, operation, bits, parse_type_is_scalar(x) ? y : x, a, b);
}

/* Integer operators, which not all versions have. */
static struct parse_node *of_whole_numbers(struct parse *p, uint32_t sign, struct parse_node *a, struct parse_node *b)
{
	static const struct {
		uint32_t sign;
		enum parse_bits bits;
	} all[] = { { '&', PARSE_BIT_AND },
		    { '|', PARSE_BIT_OR },
		    { '^', PARSE_BIT_XOR },
		    { PARSE_SIGN2('<', '<'), PARSE_SHIFT_LEFT },
		    { PARSE_SIGN2('>', '>'), PARSE_SHIFT_RIGHT } };
	enum parse_bits bits = PARSE_NO_BITS;

	if (!parse_has(p, 130, PARSE_GPU_SHADER4))
		parse_error(p, "an operator on bits or a modulo needs GLSL 1.30");
	if ((a->type->kind != GLSL_INT && a->type->kind != GLSL_UINT) ||
	    (b->type->kind != GLSL_INT && b->type->kind != GLSL_UINT))
		mismatch(p, a, b);
	for (unsigned i = 0; i < sizeof(all) / sizeof(all[0]); i++)
		bits = all[i].sign == sign ? all[i].bits : bits;
	if (bits < PARSE_SHIFT_LEFT)
		return arithmetic(p, bits ? GLSL_OTHER : GLSL_MODULO, bits, a, b);
	if (b->type->rows != 1 && b->type->rows != a->type->rows)
		mismatch(p, a, b);
	return made(p, GLSL_OTHER, bits, a->type, a, b);
}

static struct parse_node *equality(struct parse *p, enum glsl_operator operation, struct parse_node *a,
                                   struct parse_node *b)
{
	unify(p, &a, &b);
	if (a->type != b->type || a->type->kind == GLSL_VOID || a->type->holds_sampler ||
	    (a->type->holds_array && p->version < 120))
		mismatch(p, a, b);
	return made(p, operation, PARSE_NO_BITS, parse_type(p, GLSL_BOOL, 1, 0), a, b);
}

static struct parse_node *relation(struct parse *p, enum glsl_operator operation, struct parse_node *a,
                                   struct parse_node *b)
{
	if (!parse_type_is_number(a->type) || !parse_type_is_number(b->type) || !parse_type_is_scalar(a->type) ||
	    !parse_type_is_scalar(b->type))
		mismatch(p, a, b);
	unify(p, &a, &b);
	return made(p, operation, PARSE_NO_BITS, parse_type(p, GLSL_BOOL, 1, 0), a, b);
}

static struct parse_node *logic(struct parse *p, enum glsl_operator operation, struct parse_node *a,
                                struct parse_node *b)
{
	parse_need_bool(p, a);
	parse_need_bool(p, b);
	return made(p, operation, PARSE_NO_BITS, a->type, a, b);
}

struct parse_node *parse_operate(struct parse *p, uint32_t sign, struct parse_node *a, struct parse_node *b)
{
	switch (sign) {
	case '+': return arithmetic(p, GLSL_ADD, PARSE_NO_BITS, a, b);
	case '-': return arithmetic(p, GLSL_SUBTRACT, PARSE_NO_BITS, a, b);
	case '*': return arithmetic(p, GLSL_MULTIPLY, PARSE_NO_BITS, a, b);
	case '/': return arithmetic(p, GLSL_DIVIDE, PARSE_NO_BITS, a, b);
	case '<': return relation(p, GLSL_LESS, a, b);
	case '>': return relation(p, GLSL_GREATER, a, b);
	case PARSE_SIGN2('<', '='): return relation(p, GLSL_LESS_EQUAL, a, b);
	case PARSE_SIGN2('>', '='): return relation(p, GLSL_GREATER_EQUAL, a, b);
	case PARSE_SIGN2('=', '='): return equality(p, GLSL_EQUAL, a, b);
	case PARSE_SIGN2('!', '='): return equality(p, GLSL_NOT_EQUAL, a, b);
	case PARSE_SIGN2('&', '&'): return logic(p, GLSL_AND, a, b);
	case PARSE_SIGN2('|', '|'): return logic(p, GLSL_OR, a, b);
	case PARSE_SIGN2('^', '^'): return logic(p, GLSL_XOR, a, b);
	default: return of_whole_numbers(p, sign, a, b);
	}
}

void parse_need_bool(struct parse *p, const struct parse_node *node)
{
	if (node->type->kind != GLSL_BOOL || !parse_type_is_scalar(node->type))
		parse_error(p, "a bool is expected, not %s", parse_type_text(p, node->type));
}

struct parse_node *parse_operate_before(struct parse *p, uint32_t sign, struct parse_node *a)
{
	const bool is_whole = a->type->kind == GLSL_INT || a->type->kind == GLSL_UINT;

	if (sign == '!') {
		parse_need_bool(p, a);
		return made(p, GLSL_NOT, PARSE_NO_BITS, a->type, a, NULL);
	}
	if (!parse_type_is_number(a->type) || (sign == '~' && (!is_whole || !parse_has(p, 130, PARSE_GPU_SHADER4))))
		parse_error(p, "'%c' does not take %s", (int)sign, parse_type_text(p, a->type));
	if (sign == '~')
		return made(p, GLSL_OTHER, PARSE_BIT_NOT, a->type, a, NULL);
	return sign == '-' ? made(p, GLSL_NEGATE, PARSE_NO_BITS, a->type, a, NULL) : a;
}

struct parse_node *parse_increment(struct parse *p, enum glsl_operator operation, struct parse_node *a)
{
	parse_need_place(p, a);
	if (!parse_type_is_number(a->type))
		parse_error(p, "++ and -- do not take %s", parse_type_text(p, a->type));
	return parse_node(p, operation, a->type, 1, a);
}

struct parse_node *parse_assign(struct parse *p, uint32_t sign, struct parse_node *to, struct parse_node *value)
{
	struct parse_node *node, *both;

	parse_need_place(p, to);
	if (to->type->holds_sampler || to->type->kind == GLSL_VOID ||
	    (to->type->kind == GLSL_ARRAY && (p->version < 120 || !to->type->length)))
		parse_error(p, "%s cannot be assigned", parse_type_text(p, to->type));
	if (!sign) {
		node = parse_node(p, GLSL_ASSIGN, to->type, 2, to, parse_convert_to(p, value, to->type));
		node->value = GLSL_ASSIGN;
		return node;
	}
	both = parse_operate(p, sign, to, value);
	if (both->type != to->type)
		mismatch(p, to, value);
	node = parse_node(p, both->operation == GLSL_OTHER ? GLSL_OTHER : GLSL_ASSIGN, to->type, 2, to,
	                  both->children[1]);
	node->value = both->operation;
	return node;
}

struct parse_node *parse_choose(struct parse *p, struct parse_node *condition, struct parse_node *a,
                                struct parse_node *b)
{
	parse_need_bool(p, condition);
	unify(p, &a, &b);
	if (a->type != b->type || a->type->holds_sampler || (a->type->kind == GLSL_ARRAY && p->version < 120))
		mismatch(p, a, b);
	if (parse_is_constant(condition) && parse_is_constant(a) && parse_is_constant(b))
		return condition->numbers[0] != 0 ? a : b;
	return parse_node(p, GLSL_SELECTION, a->type, 3, condition, a, b);
}
