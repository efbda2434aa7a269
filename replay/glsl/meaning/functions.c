#include "replay/glsl/meaning/functions.h"

#include <string.h>

#include "replay/glsl/meaning/builtins.h"
#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/meaning/textures.h"

/* --- Declarations ------------------------------------------------------------------------------------------------- */

static bool has_parameters(const struct parse_function *f, struct parse_symbol **parameters, uint32_t n)
{
	bool same = f->n == n;

	for (uint32_t i = 0; same && i < n; i++)
		same = f->parameters[i]->type == parameters[i]->type;
	return same;
}

static struct parse_function *find(struct parse *p, struct parse_name *name, struct parse_symbol **parameters,
                                   uint32_t n)
{
	struct parse_function *f = name->all_functions;

	while (f && !has_parameters(f, parameters, n))
		f = f->next_of_stage;
	if (f)
		return f;
	f = parse_alloc(p, sizeof(*f));
	f->name = name;
	f->n = n;
	f->parameters = parameters;
	f->next_of_stage = name->all_functions;
	f->before = p->functions;
	name->all_functions = p->functions = f;
	return f;
}

struct parse_function *parse_declare_function(struct parse *p, struct parse_name *name, const struct parse_type *result,
                                              struct parse_symbol **parameters, uint32_t n, bool defines)
{
	struct parse_function *f = find(p, name, parameters, n);

	if (p->scope != 1 && (p->version >= 120 || defines))
		parse_error(p, "a function is declared inside another one");
	if (strncmp(name->text, "gl_", 3) == 0 || (p->version >= 120 && name->binding && name->binding->scope == 1))
		parse_error(p, "'%s' cannot be a function's name", name->text);
	if (strcmp(name->text, "main") == 0 && (n || result->kind != GLSL_VOID))
		parse_error(p, "main has parameters or returns a value");
	f->result = f->result ? f->result : result;
	if (f->result != result)
		parse_error(p, "'%s' is already declared with another type", name->text);
	for (uint32_t i = 0; i < n; i++)
		if (f->parameters[i]->storage != parameters[i]->storage ||
		    f->parameters[i]->is_fixed != parameters[i]->is_fixed)
			parse_error(p, "'%s' is already declared with other parameters", name->text);
	if (defines && f->body) {
		if (f->unit == p->n_units)
			parse_error(p, "'%s' is defined twice", name->text);
		parse_link_error(p, "'%s' is defined twice", name->text);
	}
	if (defines)
		f->parameters = parameters;
	if (f->unit != p->n_units) {
		f->unit = p->n_units;
		f->next = name->functions;
		name->functions = f;
	}
	return f;
}

/* --- Calls -------------------------------------------------------------------------------------------------------- */

static bool takes(const struct parse *p, const struct parse_function *f, const struct parse_nodes *arguments,
                  bool exactly)
{
	bool good = f->n == arguments->n;

	for (uint32_t i = 0; good && i < f->n; i++) {
		const struct parse_type *from = arguments->at[i]->type, *to = f->parameters[i]->type;
		const enum glsl_storage storage = f->parameters[i]->storage;

		good = from == to || (!exactly && storage == GLSL_IN && parse_may_convert(p, from, to)) ||
		       (!exactly && storage == GLSL_OUT && parse_may_convert(p, to, from));
	}
	return good;
}

static struct parse_function *choose(struct parse *p, struct parse_name *name, const struct parse_nodes *arguments)
{
	struct parse_function *found = NULL;

	for (struct parse_function *f = name->functions; f; f = f->next)
		if (takes(p, f, arguments, true))
			return f;
	for (struct parse_function *f = name->functions; f; f = f->next)
		if (takes(p, f, arguments, false)) {
			if (found)
				parse_error(p, "a call of '%s' is ambiguous", name->text);
			found = f;
		}
	if (!found)
		parse_error(p, "no function '%s' takes these arguments", name->text);
	return found;
}

static struct parse_node *temporary(struct parse *p, const struct parse_type *type)
{
	return parse_node_symbol(p, parse_symbol(p, parse_name(p, "", 0), type, GLSL_LOCAL));
}

static struct parse_node *assignment(struct parse *p, struct parse_node *to, struct parse_node *value)
{
	struct parse_node *node = parse_node(p, GLSL_ASSIGN, to->type, 2, to, parse_convert_to(p, value, to->type));

	node->value = GLSL_ASSIGN;
	return node;
}

/* A call, followed by the conversion of its output parameters. */
static struct parse_node *call(struct parse *p, struct parse_function *f, const struct parse_nodes *arguments)
{
	struct parse_nodes given = { 0 }, all = { 0 };
	struct parse_node *node, *result = NULL;

	for (uint32_t i = 0; i < f->n; i++) {
		struct parse_node *argument = arguments->at[i];

		if (f->parameters[i]->storage != GLSL_IN)
			parse_need_place(p, argument);
		if (f->parameters[i]->storage == GLSL_IN)
			argument = parse_convert_to(p, argument, f->parameters[i]->type);
		else if (argument->type != f->parameters[i]->type)
			argument = temporary(p, f->parameters[i]->type);
		parse_nodes_add(p, &given, argument);
	}
	node = parse_node_of(p, GLSL_CALL, f->result, &given);
	node->function = f;
	for (uint32_t i = 0; i < f->n; i++) {
		if (f->parameters[i]->storage == GLSL_IN || given.at[i] == arguments->at[i])
			continue;
		if (!all.n && f->result->kind != GLSL_VOID)
			result = temporary(p, f->result);
		if (!all.n)
			parse_nodes_add(p, &all, result ? assignment(p, result, node) : node);
		parse_nodes_add(p, &all, assignment(p, arguments->at[i], given.at[i]));
	}
	if (result)
		parse_nodes_add(p, &all, result);
	return all.n ? parse_node_of(p, GLSL_COMMA, f->result, &all) : node;
}

static void note_call(struct parse *p, struct parse_function *to)
{
	struct parse_function *from = p->inside;

	if (!from || (from->n_calls && from->calls[from->n_calls - 1] == to))
		return;
	from->calls = parse_grow(p, from->calls, from->n_calls, &from->call_room, sizeof(struct parse_function *));
	from->calls[from->n_calls++] = to;
}

struct parse_node *parse_call(struct parse *p, struct parse_name *name, const struct parse_nodes *arguments)
{
	struct parse_node *node = NULL;

	if (name->binding && p->version >= 120)
		parse_error(p, "'%s' is not a function", name->text);
	if (name->functions) { /* these hide built-in functions */
		struct parse_function *f = choose(p, name, arguments);

		note_call(p, f);
		return call(p, f, arguments);
	}
	if (parse_is_builtin(p, name->text))
		node = parse_builtin_call(p, name->text, arguments);
	else if (parse_is_texture_call(p, name->text))
		node = parse_texture_call(p, name->text, arguments);
	else
		parse_error(p, "'%s' is not declared", name->text);
	if (!node)
		parse_error(p, "no function '%s' takes these arguments", name->text);
	return node;
}

/*
 * --- Recursion -----------------------------------------------------------------------------------------------------
 */

static void check(struct parse *p, struct parse_function *f)
{
	if (f->is_checked)
		return;
	if (f->is_open)
		parse_link_error(p, "the function '%s' calls itself", f->name->text);
	f->is_open = true;
	parse_enter(p);
	for (uint32_t i = 0; i < f->n_calls; i++)
		check(p, f->calls[i]);
	parse_leave(p);
	f->is_checked = true;
}

void parse_check_calls(struct parse *p)
{
	for (struct parse_function *f = p->functions; f; f = f->before)
		check(p, f);
}
