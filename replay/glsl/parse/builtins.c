#include "replay/glsl/parse/builtins.h"

#include <string.h>

#include "replay/glsl/parse/convert.h"
#include "replay/glsl/parse/fold_call.h"

#define MOST_ARGUMENTS 4
#define FORMS 4

/*
 * Forms are a letter for the result and one for each argument. F I U B: a number or vector of this kind, V W X Y: a vector, all of one size;
 * f i u b: a number; 2 3 4: a vector of floats; M: a matrix, all of one size, Q: a square one, T: one with rows and columns turned; p q: vectors of
 * sizes of their own, R: the matrix that they make.
 */
static const struct row {
	const char *name;
	enum glsl_operator operation;
	uint16_t version, extensions; /* from which on, or with which it is there */
	const char *forms[FORMS];
} rows[] = {
	{ "radians", GLSL_RADIANS, 0, 0, { "FF" } }, { "degrees", GLSL_DEGREES, 0, 0, { "FF" } }, { "sin", GLSL_SIN, 0, 0, { "FF" } },
	{ "cos", GLSL_COS, 0, 0, { "FF" } }, { "tan", GLSL_TAN, 0, 0, { "FF" } }, { "asin", GLSL_ASIN, 0, 0, { "FF" } },
	{ "acos", GLSL_ACOS, 0, 0, { "FF" } }, { "atan", GLSL_ATAN, 0, 0, { "FF", "FFF" } }, { "sinh", GLSL_SINH, 130, 0, { "FF" } },
	{ "cosh", GLSL_COSH, 130, 0, { "FF" } }, { "tanh", GLSL_TANH, 130, 0, { "FF" } }, { "asinh", GLSL_ASINH, 130, 0, { "FF" } },
	{ "acosh", GLSL_ACOSH, 130, 0, { "FF" } }, { "atanh", GLSL_ATANH, 130, 0, { "FF" } }, { "pow", GLSL_POW, 0, 0, { "FFF" } },
	{ "exp", GLSL_EXP, 0, 0, { "FF" } }, { "log", GLSL_LOG, 0, 0, { "FF" } }, { "exp2", GLSL_EXP2, 0, 0, { "FF" } },
	{ "log2", GLSL_LOG2, 0, 0, { "FF" } }, { "sqrt", GLSL_SQRT, 0, 0, { "FF" } }, { "inversesqrt", GLSL_INVERSE_SQRT, 0, 0, { "FF" } },
	{ "abs", GLSL_ABS, 0, 0, { "FF" } }, { "abs", GLSL_ABS, 130, PARSE_GPU_SHADER4, { "II" } }, { "sign", GLSL_SIGN, 0, 0, { "FF" } },
	{ "sign", GLSL_SIGN, 130, PARSE_GPU_SHADER4, { "II" } }, { "floor", GLSL_FLOOR, 0, 0, { "FF" } },
	{ "trunc", GLSL_TRUNC, 130, PARSE_GPU_SHADER4, { "FF" } }, { "round", GLSL_ROUND, 130, PARSE_GPU_SHADER4, { "FF" } },
	{ "roundEven", GLSL_ROUND_EVEN, 130, 0, { "FF" } }, { "ceil", GLSL_CEIL, 0, 0, { "FF" } }, { "fract", GLSL_FRACT, 0, 0, { "FF" } },
	{ "mod", GLSL_MODULO, 0, 0, { "FFF", "FFf" } }, { "min", GLSL_MIN, 0, 0, { "FFF", "FFf" } }, { "max", GLSL_MAX, 0, 0, { "FFF", "FFf" } },
	{ "min", GLSL_MIN, 130, PARSE_GPU_SHADER4, { "III", "IIi", "UUU", "UUu" } }, { "max", GLSL_MAX, 130, PARSE_GPU_SHADER4, { "III", "IIi", "UUU", "UUu" } },
	{ "clamp", GLSL_CLAMP, 0, 0, { "FFFF", "FFff" } }, { "clamp", GLSL_CLAMP, 130, PARSE_GPU_SHADER4, { "IIII", "IIii", "UUUU", "UUuu" } },
	{ "mix", GLSL_MIX, 0, 0, { "FFFF", "FFFf" } }, { "mix", GLSL_MIX, 130, 0, { "FFFB" } }, { "step", GLSL_STEP, 0, 0, { "FFF", "FfF" } },
	{ "smoothstep", GLSL_SMOOTH_STEP, 0, 0, { "FFFF", "FffF" } }, { "isnan", GLSL_IS_NAN, 130, 0, { "BF" } },
	{ "isinf", GLSL_IS_INF, 130, 0, { "BF" } }, { "length", GLSL_LENGTH, 0, 0, { "fF" } }, { "distance", GLSL_DISTANCE, 0, 0, { "fFF" } },
	{ "dot", GLSL_DOT, 0, 0, { "fFF" } }, { "cross", GLSL_CROSS, 0, 0, { "333" } }, { "normalize", GLSL_NORMALIZE, 0, 0, { "FF" } },
	{ "faceforward", GLSL_FACE_FORWARD, 0, 0, { "FFFF" } }, { "reflect", GLSL_REFLECT, 0, 0, { "FFF" } },
	{ "refract", GLSL_REFRACT, 0, 0, { "FFFf" } }, { "matrixCompMult", GLSL_MULTIPLY, 0, 0, { "MMM" } },
	{ "outerProduct", GLSL_OUTER_PRODUCT, 120, 0, { "Rpq" } }, { "transpose", GLSL_TRANSPOSE, 120, 0, { "TM" } },
	{ "determinant", GLSL_DETERMINANT, 150, 0, { "fQ" } }, { "inverse", GLSL_INVERSE, 140, 0, { "QQ" } },
	{ "lessThan", GLSL_LESS, 0, 0, { "YVV", "YWW", "YXX" } }, { "lessThanEqual", GLSL_LESS_EQUAL, 0, 0, { "YVV", "YWW", "YXX" } },
	{ "greaterThan", GLSL_GREATER, 0, 0, { "YVV", "YWW", "YXX" } },
	{ "greaterThanEqual", GLSL_GREATER_EQUAL, 0, 0, { "YVV", "YWW", "YXX" } },
	{ "equal", GLSL_VECTOR_EQUAL, 0, 0, { "YVV", "YWW", "YXX", "YYY" } },
	{ "notEqual", GLSL_VECTOR_NOT_EQUAL, 0, 0, { "YVV", "YWW", "YXX", "YYY" } }, { "any", GLSL_ANY, 0, 0, { "bY" } },
	{ "all", GLSL_ALL, 0, 0, { "bY" } }, { "not", GLSL_NOT, 0, 0, { "YY" } }, { "noise1", GLSL_NOISE, 0, 0, { "fF" } },
	{ "noise2", GLSL_NOISE, 0, 0, { "2F" } }, { "noise3", GLSL_NOISE, 0, 0, { "3F" } }, { "noise4", GLSL_NOISE, 0, 0, { "4F" } },
	{ "floatBitsToInt", GLSL_OTHER, 330, 0, { "IF" } }, { "floatBitsToUint", GLSL_OTHER, 330, 0, { "UF" } },
	{ "intBitsToFloat", GLSL_OTHER, 330, 0, { "FI" } }, { "uintBitsToFloat", GLSL_OTHER, 330, 0, { "FU" } },
	{ "fma", GLSL_OTHER, 400, PARSE_GPU_SHADER5, { "FFFF" } }, { "modf", GLSL_OTHER, 130, 0, { "FFF" } },
}, of_vertices[] = {
	{ "ftransform", GLSL_FTRANSFORM, 0, 0, { "4" } },
}, of_fragments[] = {
	{ "dFdx", GLSL_DPDX, 0, 0, { "FF" } }, { "dFdy", GLSL_DPDY, 0, 0, { "FF" } }, { "fwidth", GLSL_FWIDTH, 0, 0, { "FF" } },
}, of_three[] = { /* AMD_shader_trinary_minmax: of two, twice or more */
	{ "min3", GLSL_MIN, 999, PARSE_TRINARY, { "FFFF", "IIII", "UUUU" } }, { "max3", GLSL_MAX, 999, PARSE_TRINARY, { "FFFF", "IIII", "UUUU" } },
	{ "mid3", GLSL_CLAMP, 999, PARSE_TRINARY, { "FFFF", "IIII", "UUUU" } },
};

/* What the arguments that were looked at make of a form's letters. */
struct form {
	uint32_t size;                  /* of vectors and numbers; 0: not known */
	const struct parse_type *given; /* the last matrix */
	uint32_t sizes[2];              /* of p and q */
};

/* The row behind another one that has a name; `list` says which table the search is in. */
static const struct row *next_row(const struct parse *p, const char *name, const struct row *row, unsigned *list)
{
	static const struct { const struct row *at; size_t n; } lists[] = {
		{ rows, sizeof(rows) / sizeof(*rows) }, { of_three, sizeof(of_three) / sizeof(*of_three) },
		{ of_vertices, sizeof(of_vertices) / sizeof(*of_vertices) }, { of_fragments, sizeof(of_fragments) / sizeof(*of_fragments) } };

	for (; *list < 3; row = NULL, *list += 1) {
		const unsigned which = *list == 2 && p->stage == GLSL_FRAGMENT_STAGE ? 3 : *list;

		for (row = row ? row + 1 : lists[which].at; row < lists[which].at + lists[which].n; row++)
			if (row->name[0] == name[0] && strcmp(row->name, name) == 0 && parse_has(p, row->version, row->extensions))
				return row;
	}
	return NULL;
}

bool parse_is_builtin(const struct parse *p, const char *name)
{
	unsigned list = 0;

	return next_row(p, name, NULL, &list) != NULL;
}

/* --- Forms -------------------------------------------------------------------------------------------------------------- */

static enum glsl_kind kind_of(char letter)
{
	static const char letters[] = "FVfIWiUXuBYb";
	static const enum glsl_kind kinds[] = { GLSL_FLOAT, GLSL_INT, GLSL_UINT, GLSL_BOOL };
	const char *at = strchr(letters, letter);

	return at ? kinds[(at - letters) / 3] : GLSL_FLOAT;
}

/* The type that a letter asks for, by what an argument has; NULL: it cannot be. */
static const struct parse_type *wanted(struct parse *p, struct form *form, char letter, const struct parse_type *given)
{
	const bool is_matrix = given->kind == GLSL_FLOAT && given->columns;

	switch (letter) {
	case 'M': case 'Q':
		if (!is_matrix || (letter == 'Q' && given->rows != given->columns))
			return NULL;
		form->given = form->given ? form->given : given;
		return form->given;
	case 'p': case 'q':
		if (given->columns || given->rows < 2)
			return NULL;
		form->sizes[letter - 'p'] = given->rows;
		return parse_type(p, GLSL_FLOAT, given->rows, 0);
	case '2': case '3': case '4': return parse_type(p, GLSL_FLOAT, (uint32_t)(letter - '0'), 0);
	case 'f': case 'i': case 'u': case 'b': return parse_type(p, kind_of(letter), 1, 0);
	default:
		if (given->columns || (given->rows < 2 && strchr("VWXY", letter)))
			return NULL;
		form->size = form->size ? form->size : given->rows;
		return parse_type(p, kind_of(letter), form->size, 0);
	}
}

static const struct parse_type *result_of(struct parse *p, const struct form *form, char letter)
{
	switch (letter) {
	case 'M': case 'Q': return form->given;
	case 'T': return parse_type(p, GLSL_FLOAT, form->given->columns, form->given->rows);
	case 'R': return parse_type(p, GLSL_FLOAT, form->sizes[0], form->sizes[1]);
	case '2': case '3': case '4': return parse_type(p, GLSL_FLOAT, (uint32_t)(letter - '0'), 0);
	case 'f': case 'i': case 'u': case 'b': return parse_type(p, kind_of(letter), 1, 0);
	default: return parse_type(p, kind_of(letter), form->size, 0);
	}
}

/* types: receives those of the arguments. @return whether the arguments are of them, or can become so */
static bool takes(struct parse *p, const char *letters, const struct parse_nodes *arguments, bool exactly, struct form *form,
		  const struct parse_type *types[MOST_ARGUMENTS])
{
	*form = (struct form){ 0 };
	if (strlen(letters) != arguments->n + 1)
		return false;
	for (uint32_t i = 0; i < arguments->n; i++) {
		const struct parse_type *given = arguments->at[i]->type;

		types[i] = given->kind <= GLSL_BOOL && given->kind != GLSL_VOID ? wanted(p, form, letters[i + 1], given) : NULL;
		if (!types[i] || (exactly ? types[i] != given : !parse_may_convert(p, given, types[i])))
			return false;
	}
	return true;
}

/* --- Calls -------------------------------------------------------------------------------------------------------------- */

static struct parse_node *made(struct parse *p, enum glsl_operator operation, const struct parse_type *type, const struct parse_nodes *arguments)
{
	struct parse_node *folded = parse_are_constant(arguments) ? parse_fold_call(p, operation, type, arguments) : NULL;

	return folded ? folded : parse_node_of(p, operation, type, arguments);
}

static struct parse_node *of_two(struct parse *p, enum glsl_operator operation, struct parse_node *a, struct parse_node *b)
{
	struct parse_nodes both = { 0 };

	parse_nodes_add(p, &both, a);
	parse_nodes_add(p, &both, b);
	return made(p, operation, a->type, &both);
}

static struct parse_node *of_three_numbers(struct parse *p, enum glsl_operator operation, const struct parse_nodes *arguments)
{
	struct parse_node *const a = arguments->at[0], *const b = arguments->at[1], *const c = arguments->at[2];

	if (operation != GLSL_CLAMP)
		return of_two(p, operation, of_two(p, operation, a, b), c);
	return of_two(p, GLSL_MAX, of_two(p, GLSL_MIN, a, b), of_two(p, GLSL_MIN, of_two(p, GLSL_MAX, a, b), c));
}

static struct parse_node *call(struct parse *p, const struct row *row, const char *letters, const struct parse_nodes *arguments)
{
	const struct parse_type *types[MOST_ARGUMENTS];
	struct parse_nodes converted = { 0 };
	struct form form;

	takes(p, letters, arguments, false, &form, types);
	for (uint32_t i = 0; i < arguments->n; i++)
		parse_nodes_add(p, &converted, parse_convert_to(p, arguments->at[i], types[i]));
	if (row >= of_three && row < of_three + sizeof(of_three) / sizeof(*of_three))
		return of_three_numbers(p, row->operation, &converted);
	return made(p, row->operation, result_of(p, &form, letters[0]), &converted);
}

struct parse_node *parse_builtin_call(struct parse *p, const char *name, const struct parse_nodes *arguments)
{
	const struct parse_type *types[MOST_ARGUMENTS];
	struct form form;

	if (arguments->n > MOST_ARGUMENTS)
		return NULL;
	for (int exactly = 1; exactly >= 0; exactly--) {
		const struct row *row = NULL;
		unsigned list = 0;

		while ((row = next_row(p, name, row, &list)) != NULL)
			for (unsigned i = 0; i < FORMS && row->forms[i]; i++)
				if (takes(p, row->forms[i], arguments, exactly, &form, types))
					return call(p, row, row->forms[i], arguments);
	}
	return NULL;
}
