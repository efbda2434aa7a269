#include "replay/glsl/meaning/builtins.h"

#include <string.h>

#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/meaning/fold_call.h"

#define MOST_ARGUMENTS 4
#define ROW(name, operation, forms) { #name, GLSL_##operation, 0, 0, forms }
#define LATER(name, operation, version, extensions, forms) { #name, GLSL_##operation, version, extensions, forms }

/*
 * The signature of a function is a letter for the result and one for each argument. F I U B: a scalar or vector of this
 * kind, V W X Y: a vector, all of the same size; f i u b: a scalar; 2 3 4: a vector of floats; M: a matrix, all of the
 * same size, Q: a square one, T: its transpose's type; p q: vectors of independent sizes, R: the matrix of their outer
 * product.
 */
static const struct row {
	const char *name;
	enum glsl_operator operation;
	uint16_t version, extensions; /* first version, or extensions, that have it */
	const char *forms; /* separated by spaces */
} rows[] = {
	ROW(radians, RADIANS, "FF"), ROW(degrees, DEGREES, "FF"), ROW(sin, SIN, "FF"), ROW(cos, COS, "FF"),
	ROW(tan, TAN, "FF"), ROW(asin, ASIN, "FF"), ROW(acos, ACOS, "FF"), ROW(atan, ATAN, "FF FFF"),
	LATER(sinh, SINH, 130, 0, "FF"), LATER(cosh, COSH, 130, 0, "FF"), LATER(tanh, TANH, 130, 0, "FF"),
	LATER(asinh, ASINH, 130, 0, "FF"), LATER(acosh, ACOSH, 130, 0, "FF"), LATER(atanh, ATANH, 130, 0, "FF"),
	ROW(pow, POW, "FFF"), ROW(exp, EXP, "FF"), ROW(log, LOG, "FF"), ROW(exp2, EXP2, "FF"), ROW(log2, LOG2, "FF"),
	ROW(sqrt, SQRT, "FF"), ROW(inversesqrt, INVERSE_SQRT, "FF"), ROW(abs, ABS, "FF"),
	LATER(abs, ABS, 130, PARSE_GPU_SHADER4, "II"), ROW(sign, SIGN, "FF"),
	LATER(sign, SIGN, 130, PARSE_GPU_SHADER4, "II"), ROW(floor, FLOOR, "FF"),
	LATER(trunc, TRUNC, 130, PARSE_GPU_SHADER4, "FF"), LATER(round, ROUND, 130, PARSE_GPU_SHADER4, "FF"),
	LATER(roundEven, ROUND_EVEN, 130, 0, "FF"), ROW(ceil, CEIL, "FF"), ROW(fract, FRACT, "FF"),
	ROW(mod, MODULO, "FFF FFf"), ROW(min, MIN, "FFF FFf"), ROW(max, MAX, "FFF FFf"),
	LATER(min, MIN, 130, PARSE_GPU_SHADER4, "III IIi UUU UUu"),
	LATER(max, MAX, 130, PARSE_GPU_SHADER4, "III IIi UUU UUu"), ROW(clamp, CLAMP, "FFFF FFff"),
	LATER(clamp, CLAMP, 130, PARSE_GPU_SHADER4, "IIII IIii UUUU UUuu"), ROW(mix, MIX, "FFFF FFFf"),
	LATER(mix, MIX, 130, 0, "FFFB"), ROW(step, STEP, "FFF FfF"), ROW(smoothstep, SMOOTH_STEP, "FFFF FffF"),
	LATER(isnan, IS_NAN, 130, 0, "BF"), LATER(isinf, IS_INF, 130, 0, "BF"), ROW(length, LENGTH, "fF"),
	ROW(distance, DISTANCE, "fFF"), ROW(dot, DOT, "fFF"), ROW(cross, CROSS, "333"),
	ROW(normalize, NORMALIZE, "FF"), ROW(faceforward, FACE_FORWARD, "FFFF"), ROW(reflect, REFLECT, "FFF"),
	ROW(refract, REFRACT, "FFFf"), ROW(matrixCompMult, MULTIPLY, "MMM"),
	LATER(outerProduct, OUTER_PRODUCT, 120, 0, "Rpq"), LATER(transpose, TRANSPOSE, 120, 0, "TM"),
	LATER(determinant, DETERMINANT, 150, 0, "fQ"), LATER(inverse, INVERSE, 140, 0, "QQ"),
	ROW(lessThan, LESS, "YVV YWW YXX"), ROW(lessThanEqual, LESS_EQUAL, "YVV YWW YXX"),
	ROW(greaterThan, GREATER, "YVV YWW YXX"), ROW(greaterThanEqual, GREATER_EQUAL, "YVV YWW YXX"),
	ROW(equal, VECTOR_EQUAL, "YVV YWW YXX YYY"), ROW(notEqual, VECTOR_NOT_EQUAL, "YVV YWW YXX YYY"),
	ROW(any, ANY, "bY"), ROW(all, ALL, "bY"), ROW(not, NOT, "YY"), ROW(noise1, NOISE, "fF"),
	ROW(noise2, NOISE, "2F"), ROW(noise3, NOISE, "3F"), ROW(noise4, NOISE, "4F"),
	LATER(floatBitsToInt, OTHER, 330, 0, "IF"), LATER(floatBitsToUint, OTHER, 330, 0, "UF"),
	LATER(intBitsToFloat, OTHER, 330, 0, "FI"), LATER(uintBitsToFloat, OTHER, 330, 0, "FU"),
	LATER(fma, OTHER, 400, PARSE_GPU_SHADER5, "FFFF"), LATER(modf, OTHER, 130, 0, "FFF"),
}, of_vertices[] = {
	ROW(ftransform, FTRANSFORM, "4"),
}, of_fragments[] = {
	ROW(dFdx, DPDX, "FF"), ROW(dFdy, DPDY, "FF"), ROW(fwidth, FWIDTH, "FF"),
}, of_three[] = { /* AMD_shader_trinary_minmax: each is made of functions of two arguments */
	LATER(min3, MIN, 999, PARSE_TRINARY, "FFFF IIII UUUU"),
	LATER(max3, MAX, 999, PARSE_TRINARY, "FFFF IIII UUUU"),
	LATER(mid3, CLAMP, 999, PARSE_TRINARY, "FFFF IIII UUUU"),
};

/* Sizes and types bound to a signature's letters by the arguments so far. */
struct form {
	uint32_t size;                  /* for vectors and scalars; 0: unknown */
	const struct parse_type *given; /* the last matrix */
	uint32_t sizes[2];              /* for p and q */
};

/* The next row with this name; `list` says which table the search is in. */
static const struct row *next_row(const struct parse *p, const char *name, const struct row *row, unsigned *list)
{
	static const struct {
		const struct row *at;
		size_t n;
	} lists[] = { { rows, sizeof(rows) / sizeof(*rows) },
		      { of_three, sizeof(of_three) / sizeof(*of_three) },
		      { of_vertices, sizeof(of_vertices) / sizeof(*of_vertices) },
		      { of_fragments, sizeof(of_fragments) / sizeof(*of_fragments) } };

	for (; *list < 3; row = NULL, *list += 1) {
		const unsigned which = *list == 2 && p->stage == GLSL_FRAGMENT_STAGE ? 3 : *list;

		for (row = row ? row + 1 : lists[which].at; row < lists[which].at + lists[which].n; row++)
			if (row->name[0] == name[0] && strcmp(row->name, name) == 0 &&
			    parse_has(p, row->version, row->extensions))
				return row;
	}
	return NULL;
}

bool parse_is_builtin(const struct parse *p, const char *name)
{
	unsigned list = 0;

	return next_row(p, name, NULL, &list) != NULL;
}

/* --- Signatures --------------------------------------------------------------------------------------------------- */

static enum glsl_kind kind_of(char letter)
{
	static const char letters[] = "FVfIWiUXuBYb";
	static const enum glsl_kind kinds[] = { GLSL_FLOAT, GLSL_INT, GLSL_UINT, GLSL_BOOL };
	const char *at = strchr(letters, letter);

	return at ? kinds[(at - letters) / 3] : GLSL_FLOAT;
}

/* The type that a letter requires, given the type of the argument; NULL: no match. */
static const struct parse_type *wanted(struct parse *p, struct form *form, char letter, const struct parse_type *given)
{
	const bool is_matrix = given->kind == GLSL_FLOAT && given->columns;

	switch (letter) {
	case 'M':
	case 'Q':
		if (!is_matrix || (letter == 'Q' && given->rows != given->columns))
			return NULL;
		form->given = form->given ? form->given : given;
		return form->given;
	case 'p':
	case 'q':
		if (given->columns || given->rows < 2)
			return NULL;
		form->sizes[letter - 'p'] = given->rows;
		return parse_type(p, GLSL_FLOAT, given->rows, 0);
	case '2':
	case '3':
	case '4': return parse_type(p, GLSL_FLOAT, (uint32_t)(letter - '0'), 0);
	case 'f':
	case 'i':
	case 'u':
	case 'b': return parse_type(p, kind_of(letter), 1, 0);
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
	case 'M':
	case 'Q': return form->given;
	case 'T': return parse_type(p, GLSL_FLOAT, form->given->columns, form->given->rows);
	case 'R': return parse_type(p, GLSL_FLOAT, form->sizes[0], form->sizes[1]);
	case '2':
	case '3':
	case '4': return parse_type(p, GLSL_FLOAT, (uint32_t)(letter - '0'), 0);
	case 'f':
	case 'i':
	case 'u':
	case 'b': return parse_type(p, kind_of(letter), 1, 0);
	default: return parse_type(p, kind_of(letter), form->size, 0);
	}
}

/*
 * types: receives the types of the parameters. @return true if the arguments have these types or can be converted to
 * them
 */
static bool takes(struct parse *p, const char *letters, const struct parse_nodes *arguments, bool exactly,
                  struct form *form, const struct parse_type *types[MOST_ARGUMENTS])
{
	*form = (struct form){ 0 };
	if (strcspn(letters, " ") != arguments->n + 1)
		return false;
	for (uint32_t i = 0; i < arguments->n; i++) {
		const struct parse_type *given = arguments->at[i]->type;

		types[i] = given->kind <= GLSL_BOOL && given->kind != GLSL_VOID ?
		                   wanted(p, form, letters[i + 1], given) :
		                   NULL;
		if (!types[i] || (exactly ? types[i] != given : !parse_may_convert(p, given, types[i])))
			return false;
	}
	return true;
}

/* --- Calls -------------------------------------------------------------------------------------------------------- */

static struct parse_node *made(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                               const struct parse_nodes *arguments)
{
	struct parse_node *folded = parse_are_constant(arguments) ? parse_fold_call(p, operation, type, arguments) :
	                                                            NULL;

	return folded ? folded : parse_node_of(p, operation, type, arguments);
}

static struct parse_node *of_two(struct parse *p, enum glsl_operator operation, struct parse_node *a,
                                 struct parse_node *b)
{
	struct parse_nodes both = { 0 };

	parse_nodes_add(p, &both, a);
	parse_nodes_add(p, &both, b);
	return made(p, operation, a->type, &both);
}

static struct parse_node *of_three_numbers(struct parse *p, enum glsl_operator operation,
                                           const struct parse_nodes *arguments)
{
	struct parse_node *const a = arguments->at[0], *const b = arguments->at[1], *const c = arguments->at[2];

	if (operation != GLSL_CLAMP)
		return of_two(p, operation, of_two(p, operation, a, b), c);
	return of_two(p, GLSL_MAX, of_two(p, GLSL_MIN, a, b), of_two(p, GLSL_MIN, of_two(p, GLSL_MAX, a, b), c));
}

static struct parse_node *call(struct parse *p, const struct row *row, const char *letters,
                               const struct parse_nodes *arguments)
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
			for (const char *letters = row->forms; *letters; letters += strspn(letters, " ")) {
				if (takes(p, letters, arguments, exactly, &form, types))
					return call(p, row, letters, arguments);
				letters += strcspn(letters, " ");
			}
	}
	return NULL;
}
