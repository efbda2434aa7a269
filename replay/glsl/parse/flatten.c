#include "replay/glsl/parse/flatten.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/glsl/meaning/functions.h"
#include "replay/glsl/parse/products.h"
#include "replay/glsl/text/type_names.h"

#define MAX_NODES 200000
#define N_KEPT 256

/* Numbers already in the tree. */
struct kept {
	struct kept *next;
	const double *numbers;
	uint32_t n, first;
};

struct flat {
	struct parse *p;
	struct glsl_tree tree; /* allocated from the arena */
	struct kept *kept[N_KEPT];
	uint32_t type_room, member_room, symbol_room, node_room, function_room, child_room, number_room, name_room;
	uint32_t depth;
};

/* Make room at the end of a list of the tree. */
#define GROW(f, list, room)                                                                                            \
	((f)->tree.list = parse_grow((f)->p, (f)->tree.list, (f)->tree.n_##list, &(f)->room, sizeof(*(f)->tree.list)))

static uint32_t flatten(struct flat *f, struct parse_node *node);

static uint32_t add_name(struct flat *f, const struct parse_name *name)
{
	const uint32_t at = f->tree.n_names;

	for (uint32_t i = 0; i <= name->n; i++) {
		GROW(f, names, name_room);
		f->tree.names[f->tree.n_names++] = name->text[i];
	}
	return at;
}

/* --- Types ------------------------------------------------------------------------------------------------------- */

static uint32_t type_of(struct flat *f, const struct parse_type *type);

static uint32_t add_members(struct flat *f, const struct parse_structure *s)
{
	struct glsl_member *own = parse_alloc(f->p, s->n * sizeof(*own));

	for (uint32_t i = 0; i < s->n; i++)
		own[i] = (struct glsl_member){ add_name(f, s->members[i].name), type_of(f, s->members[i].type) };
	for (uint32_t i = 0; i < s->n; i++) {
		GROW(f, members, member_room);
		f->tree.members[f->tree.n_members++] = own[i];
	}
	return f->tree.n_members - s->n;
}

static uint32_t type_of(struct flat *f, const struct parse_type *type)
{
	struct glsl_type t = { .kind = type->kind,
		               .rows = type->rows,
		               .columns = type->columns,
		               .numbers = type->numbers,
		               .length = type->length };
	const uint32_t dimension = type->texture & PARSE_DIMENSION;

	if (*type->number)
		return *type->number - 1;
	if (type->kind == GLSL_ARRAY)
		t.first = type_of(f, type->element);
	if (type->kind == GLSL_STRUCT) {
		t.length = type->structure->n;
		t.first = add_members(f, type->structure);
	}
	if (type->kind == GLSL_SAMPLER)
		t.texture = type->texture == (GLSL_TEXTURE_2D | PARSE_LAYERED) ? GLSL_TEXTURE_2D_ARRAY :
		            type->texture & (PARSE_LAYERED | PARSE_INT_TEXTURE | PARSE_UINT_TEXTURE) ?
		                    GLSL_TEXTURE_OTHER :
		                    dimension;
	GROW(f, types, type_room);
	f->tree.types[f->tree.n_types++] = t;
	*type->number = f->tree.n_types;
	return *type->number - 1;
}

/* --- Symbols and numbers ----------------------------------------------------------------------------------------- */

static uint32_t add_numbers(struct flat *f, const double *numbers, uint32_t n)
{
	struct kept **list = &f->kept[((uintptr_t)numbers / sizeof(double)) % N_KEPT], *k;
	const uint32_t first = f->tree.n_numbers;

	for (k = *list; k; k = k->next)
		if (k->numbers == numbers && k->n == n)
			return k->first;
	if (first + n > MAX_NODES)
		parse_refuse(f->p, "a shader has too many constants");
	for (uint32_t i = 0; i < n; i++) {
		GROW(f, numbers, number_room);
		f->tree.numbers[f->tree.n_numbers++] = (float)numbers[i];
	}
	k = parse_alloc(f->p, sizeof(*k));
	*k = (struct kept){ *list, numbers, n, first };
	*list = k;
	return first;
}

/* The final type of an array declared without a length. */
static const struct parse_type *whole_type(struct flat *f, const struct parse_symbol *s)
{
	if (s->type->kind != GLSL_ARRAY || s->type->length)
		return s->type;
	return parse_type_array(f->p, s->type->element, s->length ? s->length : 1);
}

static uint32_t symbol_of(struct flat *f, struct parse_symbol *s)
{
	const struct parse_type *type = whole_type(f, s);
	struct glsl_symbol made = {
		.type = type_of(f, type), .storage = s->storage, .first = GLSL_NONE, .flat = s->flat, .straight = s->straight,
		.location = s->location, .binding = s->binding, .declared = s->declared
	};

	if (s->number)
		return s->number - 1;
	made.name = add_name(f, s->name);
	if (s->numbers)
		made.first = add_numbers(f, s->numbers, type->numbers);
	GROW(f, symbols, symbol_room);
	f->tree.symbols[f->tree.n_symbols++] = made;
	s->number = f->tree.n_symbols;
	return s->number - 1;
}

/* --- Nodes ------------------------------------------------------------------------------------------------------- */

static uint32_t add(struct flat *f, enum glsl_operator operation, uint32_t type, const uint32_t *children, uint32_t n,
                    uint32_t value)
{
	const uint32_t first = f->tree.n_children;

	if (f->tree.n_nodes >= MAX_NODES)
		parse_refuse(f->p, "a shader is too large");
	for (uint32_t i = 0; i < n; i++) {
		GROW(f, children, child_room);
		f->tree.children[f->tree.n_children++] = children[i];
	}
	GROW(f, nodes, node_room);
	f->tree.nodes[f->tree.n_nodes++] = (struct glsl_node){ operation, type, first, n, value };
	return f->tree.n_nodes - 1;
}

static uint32_t function_of(struct flat *f, struct parse_function *function)
{
	if (!function->number) {
		GROW(f, functions, function_room);
		f->tree.functions[f->tree.n_functions++] = (struct glsl_function){ .name = add_name(f, function->name),
			                                                           .type = type_of(f, function->result),
			                                                           .body = GLSL_NONE };
		function->number = f->tree.n_functions;
	}
	return function->number - 1;
}

/* (A B) v becomes A (B v), as in Mesa: in 22.3.6 for any number of matrices, in 25.0.7 not again for the result. */
static uint32_t times_vector(struct flat *f, struct parse_node *matrix, uint32_t vector, const struct parse_type *type,
                             bool is_taken_apart)
{
	struct parse_node *product = matrix->operation == GLSL_SYMBOL && matrix->symbol->product ?
	                                     matrix->symbol->product :
	                                     matrix;
	uint32_t both[2], made;

	if (++f->depth > PARSE_MAX_DEPTH)
		parse_refuse(f->p, "a shader is nested too deeply");
	if (product->operation != GLSL_MATRIX_TIMES_MATRIX || !is_taken_apart) {
		both[0] = flatten(f, matrix);
		both[1] = vector;
		made = add(f, GLSL_MATRIX_TIMES_VECTOR, type_of(f, type), both, 2, 0);
	} else {
		const bool again = !f->p->products_once;

		vector = times_vector(f, product->children[1], vector,
		                      parse_type(f->p, GLSL_FLOAT, product->children[1]->type->rows, 0), again);
		made = times_vector(f, product->children[0], vector, type, again);
	}
	f->depth--;
	return made;
}

static uint32_t flatten_symbol(struct flat *f, struct parse_symbol *s)
{
	const uint32_t symbol = symbol_of(f, s);

	return add(f, GLSL_SYMBOL, f->tree.symbols[symbol].type, NULL, 0, symbol);
}

static uint32_t flatten_children(struct flat *f, struct parse_node *node)
{
	uint32_t *own = parse_alloc(f->p, (node->n + 1) * sizeof(*own)), value = node->value;

	for (uint32_t i = 0; i < node->n; i++) {
		struct parse_node *child = node->children[i];
		const bool is_array = child && child->operation == GLSL_SYMBOL && child->type->kind == GLSL_ARRAY &&
		                      !child->type->length;

		if (is_array && node->operation != GLSL_INDEX && !child->symbol->type->length)
			parse_refuse(f->p, "a shader uses an array without a length as a whole");
		own[i] = child ? flatten(f, child) : GLSL_NONE;
	}
	if (node->operation == GLSL_CALL)
		value = function_of(f, node->function);
	return add(f, node->operation, type_of(f, node->type), own, node->n, value);
}

static uint32_t flatten(struct flat *f, struct parse_node *node)
{
	uint32_t made;

	if (++f->depth > PARSE_MAX_DEPTH)
		parse_refuse(f->p, "a shader is nested too deeply");
	if (node->operation == GLSL_SYMBOL && node->symbol->product)
		made = flatten(f, node->symbol->product);
	else if (node->operation == GLSL_SYMBOL)
		made = flatten_symbol(f, node->symbol);
	else if (node->operation == GLSL_NUMBERS)
		made = add(f, GLSL_NUMBERS, type_of(f, node->type), NULL, 0,
		           add_numbers(f, node->numbers, node->type->numbers));
	else if (node->operation == GLSL_ASSIGN && node->children[0]->operation == GLSL_SYMBOL &&
	         node->children[0]->symbol->product)
		made = add(f, GLSL_SEQUENCE, type_of(f, parse_type(f->p, GLSL_VOID, 0, 0)), NULL, 0, 0);
	else if (node->operation == GLSL_MATRIX_TIMES_VECTOR)
		made = times_vector(f, node->children[0], flatten(f, node->children[1]), node->type, true);
	else
		made = flatten_children(f, node);
	f->depth--;
	return made;
}

static void flatten_function(struct flat *f, struct parse_function *function)
{
	const uint32_t number = function_of(f, function), n = function->n;
	uint32_t *own = parse_alloc(f->p, (n + 1) * sizeof(*own)), first, body;

	for (uint32_t i = 0; i < n; i++)
		own[i] = flatten_symbol(f, function->parameters[i]);
	first = f->tree.n_children;
	add(f, GLSL_SEQUENCE, type_of(f, parse_type(f->p, GLSL_VOID, 0, 0)), own, n, 0);
	body = flatten(f, function->body);
	f->tree.functions[number].first = first;
	f->tree.functions[number].count = n;
	f->tree.functions[number].body = body;
}

/* --- All of it --------------------------------------------------------------------------------------------------- */

static struct parse_function *main_of(struct parse *p)
{
	struct parse_function *main = parse_name(p, "main", 4)->all_functions;

	if (!main || !main->body)
		parse_link_error(p, "there is no main function");
	return main;
}

static bool is_assigned(struct parse *p, const char *name)
{
	const struct parse_symbol *s = parse_name(p, name, (uint32_t)strlen(name))->global;

	return s && s->is_assigned;
}

static void *owned(struct parse *p, const void *from, size_t n)
{
	void *to = malloc(n + 1);

	if (!to) {
		p->err = err_report(ERR_SYSTEM, NULL, "out of memory for a shader");
		longjmp(p->stop, 1);
	}
	if (n)
		memcpy(to, from, n);
	return to;
}

#define OWN(p, to, from, list)                                                                                         \
	((to)->n_##list = (from)->n_##list,                                                                            \
	 (to)->list = owned(p, (from)->list, (from)->n_##list * sizeof(*(from)->list)))

void parse_flatten(struct parse *p, struct glsl_tree *tree)
{
	struct flat *f = parse_alloc(p, sizeof(*f));
	uint32_t *own = parse_alloc(p, (p->root->n + 1) * sizeof(*own)), n = 0;

	f->p = p;
	parse_check_calls(p);
	if (is_assigned(p, "gl_FragColor") + is_assigned(p, "gl_FragData") + p->assigns_color > 1)
		parse_link_error(p, "colours are assigned through two kinds of output");
	parse_find_products(p);
	f->tree.main = function_of(f, main_of(p));
	for (uint32_t i = 0; i < p->root->n; i++)
		if (p->root->at[i]->operation == GLSL_CALL)
			flatten_function(f, p->root->at[i]->function);
		else
			own[n++] = flatten(f, p->root->at[i]);
	f->tree.root = add(f, GLSL_SEQUENCE, type_of(f, parse_type(p, GLSL_VOID, 0, 0)), own, n, 0);
	OWN(p, tree, &f->tree, types);
	OWN(p, tree, &f->tree, members);
	OWN(p, tree, &f->tree, symbols);
	OWN(p, tree, &f->tree, nodes);
	OWN(p, tree, &f->tree, functions);
	OWN(p, tree, &f->tree, children);
	OWN(p, tree, &f->tree, numbers);
	OWN(p, tree, &f->tree, names);
	tree->root = f->tree.root;
	tree->main = f->tree.main;
}
